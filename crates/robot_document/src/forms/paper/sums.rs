//! Sums of products that keep the order in which they are written. The terms of a product of sums are the products of
//! their terms in order, and like terms are merged at the place of the first.
//!
//! The paper's equations come out in its order if its relations are carried out in this way: (24), (31) to (34), (39)
//! and the equations that follow from them.

use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Function, Id, Number, View};
use rustc_hash::FxHashMap;

/// A product of powers in the order in which they are written.
#[derive(Clone, Debug)]
struct Term<'g> {
    coefficient: Number,
    factors: Vec<(Expr<'g>, i32)>,
}

/// The factors of a term in a fixed order.
type Key = Vec<(Id, i32)>;

/// A sum of products.
#[derive(Clone, Debug, Default)]
pub(super) struct Sum<'g> {
    terms: Vec<Term<'g>>,
    /// The places of terms by their factors.
    places: FxHashMap<Key, usize>,
}

impl<'g> Sum<'g> {
    /// Converts the terms of an expanded expression, in their order.
    pub(super) fn of_terms(terms: &[ArrangedTerm<'g>]) -> Sum<'g> {
        let mut sum = Sum::default();
        for term in terms {
            let atom = |(factor, exponent): &(ArrangedFactor<'g>, i32)| {
                factor.as_atom().map(|atom| (atom, *exponent))
            };
            let coefficient = match term.negative {
                true => -&term.coefficient,
                false => term.coefficient.clone(),
            };
            let factors = term.factors.iter().filter_map(atom).collect();
            sum.add_term(Term { coefficient, factors });
        }
        sum
    }

    pub(super) fn plus(mut self, other: Sum<'g>) -> Sum<'g> {
        for term in other.terms {
            self.add_term(term);
        }
        self
    }

    pub(super) fn negative(mut self) -> Sum<'g> {
        for term in &mut self.terms {
            term.coefficient = -&term.coefficient;
        }
        self
    }

    pub(super) fn times(&self, other: &Sum<'g>) -> Sum<'g> {
        let mut product = Sum::default();
        for a in &self.terms {
            for b in &other.terms {
                product.add_term(a.times(b));
            }
        }
        product
    }

    /// The terms in the form in which they are printed.
    pub(super) fn arranged(&self) -> Vec<ArrangedTerm<'g>> {
        let one = |term: &Term<'g>| {
            let negative = term.coefficient.is_negative();
            let coefficient = if negative { -&term.coefficient } else { term.coefficient.clone() };
            let atom =
                |(atom, exponent): &(Expr<'g>, i32)| (ArrangedFactor::Atom(*atom), *exponent);
            ArrangedTerm { negative, coefficient, factors: term.factors.iter().map(atom).collect() }
        };
        self.terms.iter().filter(|term| !term.coefficient.is_zero()).map(one).collect()
    }

    /// Adds a term, in which s² is replaced by 1 − c².
    fn add_term(&mut self, term: Term<'g>) {
        let mut pending = vec![term];
        while let Some(mut term) = pending.pop() {
            match term.square_of_a_sine() {
                Some((place, argument)) => {
                    term.factors[place].1 -= 2;
                    term.factors.retain(|(_, exponent)| *exponent != 0);
                    let mut other = term.clone();
                    other.coefficient = -&other.coefficient;
                    other.append(argument.cos(), 2);
                    pending.extend([other, term]);
                }
                None => self.merge(term),
            }
        }
    }

    fn merge(&mut self, term: Term<'g>) {
        let key = term.key();
        match self.places.get(&key).and_then(|place| self.terms.get_mut(*place)) {
            // A term that has canceled is appended at the end when it occurs again.
            Some(known) if !known.coefficient.is_zero() => {
                known.coefficient = &known.coefficient + &term.coefficient;
            }
            _ => {
                self.places.insert(key, self.terms.len());
                self.terms.push(term);
            }
        }
    }
}

impl<'g> Term<'g> {
    /// The factors of the first term and then those of the other; equal ones become a power at the place of the first.
    /// If the first term is a single factor that the other contains too, it joins the power there: `l_5 M_5 q̈_2 l_5`
    /// is `M_5 q̈_2 l_5²`.
    fn times(&self, other: &Term<'g>) -> Term<'g> {
        let coefficient = &self.coefficient * &other.coefficient;
        if let [(single, exponent)] = self.factors.as_slice()
            && other.factors.iter().any(|(atom, _)| atom == single)
        {
            let mut product = Term { coefficient, factors: other.factors.clone() };
            product.append(*single, *exponent);
            return product;
        }
        let mut product = Term { coefficient, factors: self.factors.clone() };
        for (atom, exponent) in &other.factors {
            product.append(*atom, *exponent);
        }
        product
    }

    fn append(&mut self, atom: Expr<'g>, exponent: i32) {
        match self.factors.iter_mut().find(|(known, _)| *known == atom) {
            Some((_, known)) => *known += exponent,
            None => self.factors.push((atom, exponent)),
        }
        self.factors.retain(|(_, exponent)| *exponent != 0);
    }

    /// The place of a sine with an exponent of at least 2, and the angle of the sine.
    fn square_of_a_sine(&self) -> Option<(usize, Expr<'g>)> {
        self.factors.iter().enumerate().find_map(|(place, (atom, exponent))| match atom.view() {
            View::Call(Function::Sin, argument) if *exponent >= 2 => Some((place, argument)),
            _ => None,
        })
    }

    fn key(&self) -> Key {
        let mut key: Key =
            self.factors.iter().map(|(atom, exponent)| (atom.id(), *exponent)).collect();
        key.sort_unstable();
        key
    }
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Graph;
    use robot_symbolic::print::arranged_text;

    use super::*;

    fn term<'g>(graph: &'g Graph, text: &str) -> Sum<'g> {
        let mut term = Term { coefficient: Number::integer(1), factors: vec![] };
        text.split('*').for_each(|factor| term.append(graph.parse(factor).unwrap(), 1));
        let mut sum = Sum::default();
        sum.add_term(term);
        sum
    }

    #[test]
    fn terms_stay_in_the_order_of_writing() {
        let graph = Graph::new();
        let sum = |terms: &[&str]| {
            terms.iter().fold(Sum::default(), |sum, text| sum.plus(term(&graph, text)))
        };
        let shown = |sum: &Sum<'_>| arranged_text(&sum.arranged()).unwrap();
        let (a, b) = (sum(&["z", "a*y"]), sum(&["m*x", "b"]));
        assert_eq!(shown(&a.times(&b)), "z*m*x + z*b + a*y*m*x + a*y*b");
        assert_eq!(shown(&sum(&["l"]).times(&sum(&["m*l", "n"]))), "m*l^2 + l*n");
        assert_eq!(shown(&sum(&["c*v"]).times(&sum(&["J*s*v"]))), "c*v^2*J*s");
        let square = sum(&["sin(q)*y"]).times(&sum(&["sin(q)"]));
        assert_eq!(shown(&square), "y - y*cos(q)^2");
        assert_eq!(shown(&square.plus(sum(&["y*cos(q)*cos(q)", "x"]))), "y + x");
        let canceled = sum(&["x", "y"]).plus(sum(&["x"]).negative()).plus(sum(&["x"]));
        assert_eq!(shown(&canceled), "y + x");
    }
}
