//! Terms in the order of published equations.

use std::collections::{BTreeMap, BTreeSet};

use robot_symbolic::formula::Step;
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Formula, Graph, Id};
use rustc_hash::FxHashMap;

/// The terms of quantities in a published text, in the order of the text, with the factors of each in the text's order.
///
/// A derived term that the text lacks because of a mistake takes the place of the text's term that is most similar to
/// it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TermOrder {
    terms: BTreeMap<String, Vec<Formula>>,
    numbers: BTreeMap<String, String>,
    /// The quantities for which the text has no terms to order.
    named: BTreeSet<String>,
}

/// The number of published equations that have nothing in common with the derived ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Differences {
    /// The number of equations without any term in common with the derived ones.
    pub without_common_terms: usize,
    /// The number of all equations of the text, with each quantity counted once.
    pub compared: usize,
}

/// Atoms with their exponents, in the order in which they are written.
type Product<'g> = Vec<(Expr<'g>, i32)>;

/// The largest number of pairs of terms that are compared for one quantity, which takes less than a second.
const MAX_PAIRS: usize = 1_000_000;

impl TermOrder {
    /// Sets the terms of a quantity, such as `F_l5.x`.
    pub fn insert(&mut self, quantity: &str, terms: Vec<Formula>) {
        self.terms.insert(quantity.to_owned(), terms);
    }

    /// Sets the number of a quantity's equation in the text, without parentheses. A number with other characters than
    /// ASCII letters, digits, points and hyphens is ignored.
    pub fn set_number(&mut self, quantity: &str, number: &str) {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-');
        if !number.is_empty() && number.chars().all(is_plain) {
            self.numbers.insert(quantity.to_owned(), number.to_owned());
        }
    }

    /// Records that the text has an equation for a quantity without terms to order.
    pub fn insert_name(&mut self, quantity: &str) {
        self.named.insert(quantity.to_owned());
    }

    /// Whether there are no quantities with terms.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// The numbers in the text by the names of equations: those of components, and those of columns whose components
    /// all have the same number.
    pub(super) fn numbers(&self) -> BTreeMap<String, String> {
        let mut columns: BTreeMap<String, Option<&String>> = BTreeMap::new();
        for (quantity, number) in &self.numbers {
            if let Some((column, _)) = quantity.split_once('.') {
                let known = columns.entry(column.to_owned()).or_insert(Some(number));
                *known = known.filter(|known| *known == number);
            }
        }
        let columns =
            columns.into_iter().filter_map(|(name, number)| Some((name, number?.clone())));
        self.numbers.clone().into_iter().chain(columns).collect()
    }

    /// Counts an equation of the robot if the text has it.
    pub(super) fn count<'g>(
        &self,
        differences: &mut Differences,
        quantity: &str,
        terms: &[ArrangedTerm<'g>],
        graph: &'g Graph,
    ) {
        let Some(printed) = self.terms.get(quantity) else {
            differences.compared += usize::from(self.named.contains(quantity));
            return;
        };
        differences.compared += 1;
        let printed = printed.iter().map(|term| product(term, graph));
        // Equations with parentheses are not compared.
        if let (Some(printed), Some(own)) = (printed.collect::<Option<Vec<_>>>(), products(terms)) {
            let printed: BTreeSet<_> = printed.iter().map(key).collect();
            let is_shared = own.iter().any(|term| printed.contains(&key(term)));
            differences.without_common_terms += usize::from(!is_shared);
        }
    }

    /// The terms of a quantity in the order of the text; `None` if the text does not have the quantity, or if the text
    /// or the terms have parentheses.
    pub(super) fn arranged<'g>(
        &self,
        quantity: &str,
        terms: &[ArrangedTerm<'g>],
        graph: &'g Graph,
    ) -> Option<Vec<ArrangedTerm<'g>>> {
        let printed = self.terms.get(quantity)?.iter().map(|term| product(term, graph));
        let printed: Vec<Product<'g>> = printed.collect::<Option<_>>()?;
        let own = products(terms)?;
        let places = places(&own, &printed);
        let mut order: Vec<usize> = (0..own.len()).collect();
        // The sort is stable, so terms without a place follow in their own order.
        order.sort_by_key(|index| places.get(*index).copied().flatten().unwrap_or(usize::MAX));
        let one = |index: usize| {
            let (term, factors) = (terms.get(index)?, own.get(index)?);
            let like = places.get(index).copied().flatten().and_then(|place| printed.get(place));
            let factors = match like {
                Some(like) => ordered(factors, like),
                None => factors.clone(),
            };
            let atom = |(atom, exponent)| (ArrangedFactor::Atom(atom), exponent);
            Some(ArrangedTerm { factors: factors.into_iter().map(atom).collect(), ..term.clone() })
        };
        order.into_iter().map(one).collect()
    }
}

/// The factors of terms, without numbers; `None` if a term has parentheses.
fn products<'g>(terms: &[ArrangedTerm<'g>]) -> Option<Vec<Product<'g>>> {
    let of_atoms = |term: &ArrangedTerm<'g>| {
        let factors = term.factors.iter();
        factors.map(|(factor, exponent)| Some((factor.as_atom()?, *exponent))).collect()
    };
    terms.iter().map(of_atoms).collect()
}

/// The factors of a term, without numbers; `None` if it has parentheses.
fn product<'g>(term: &Formula, graph: &'g Graph) -> Option<Product<'g>> {
    let of = |atom: Expr<'g>| (Some(vec![(atom, 1)]), atom);
    let (factors, _) = term.fold(|step: Step<'_, (Option<Product<'g>>, Expr<'g>)>| {
        Some(match step {
            Step::Number(value) => (Some(vec![]), graph.number(value.clone())),
            Step::Pi => of(graph.pi()),
            Step::Symbol(name, _) => of(graph.symbol(name)),
            Step::Add((_, a), (_, b)) => (None, a + b),
            Step::Sub((_, a), (_, b)) => (None, a - b),
            Step::Mul((one, a), (other, b)) => (joined(one, other, 1), a * b),
            Step::Div((one, a), (other, b)) => (joined(one, other, -1), a / b),
            Step::Neg((factors, a)) => (factors, -a),
            Step::Power((factors, a), exponent) => {
                (joined(Some(vec![]), factors, exponent), a.powi(exponent))
            }
            Step::Call(function, (_, a)) => of(a.apply(function)),
            Step::Tan((_, a)) => (Some(vec![(a.sin(), 1), (a.cos(), -1)]), a.sin() / a.cos()),
        })
    })?;
    factors
}

/// The factors of a product times those of a power; equal ones are combined at the place of the first.
fn joined<'g>(
    one: Option<Product<'g>>,
    other: Option<Product<'g>>,
    exponent: i32,
) -> Option<Product<'g>> {
    let (mut all, other) = (one?, other?);
    for (atom, own) in other {
        let own = own.checked_mul(exponent)?;
        match all.iter_mut().find(|(known, _)| *known == atom) {
            Some((_, known)) => *known = known.checked_add(own)?,
            None => all.push((atom, own)),
        }
    }
    Some(all)
}

/// For each term, the place of the printed term with the same factors, or else of the most similar printed term that
/// has no counterpart.
fn places(own: &[Product<'_>], printed: &[Product<'_>]) -> Vec<Option<usize>> {
    let mut free: FxHashMap<Vec<(Id, i32)>, Vec<usize>> = FxHashMap::default();
    for (place, term) in printed.iter().enumerate().rev() {
        free.entry(key(term)).or_default().push(place);
    }
    let mut places: Vec<Option<usize>> =
        own.iter().map(|term| free.get_mut(&key(term)).and_then(Vec::pop)).collect();
    let mut taken = vec![false; printed.len()];
    for place in places.iter().flatten() {
        if let Some(taken) = taken.get_mut(*place) {
            *taken = true;
        }
    }
    let wanting: Vec<usize> =
        (0..own.len()).filter(|index| places.get(*index) == Some(&None)).collect();
    let left: Vec<usize> =
        (0..printed.len()).filter(|place| taken.get(*place) == Some(&false)).collect();
    if wanting.len().saturating_mul(left.len()) > MAX_PAIRS {
        return places;
    }
    let pairs = wanting.iter().flat_map(|index| left.iter().map(move |place| (*index, *place)));
    let mut near: Vec<(u32, usize, usize)> = pairs
        .filter_map(|(index, place)| {
            Some((distance(own.get(index)?, printed.get(place)?), index, place))
        })
        .collect();
    near.sort_unstable();
    for (_, index, place) in near {
        if let (Some(own @ None), Some(taken @ false)) =
            (places.get_mut(index), taken.get_mut(place))
        {
            (*own, *taken) = (Some(place), true);
        }
    }
    places
}

fn key(term: &Product<'_>) -> Vec<(Id, i32)> {
    let mut key: Vec<(Id, i32)> =
        term.iter().map(|(atom, exponent)| (atom.id(), *exponent)).collect();
    key.sort_unstable();
    key
}

fn exponent(term: &Product<'_>, atom: Expr<'_>) -> i32 {
    term.iter().find(|(known, _)| known.id() == atom.id()).map_or(0, |(_, exponent)| *exponent)
}

/// The number of factors that differ, with every factor of a power counted.
fn distance(one: &Product<'_>, other: &Product<'_>) -> u32 {
    let beyond = |(atom, own): &(Expr<'_>, i32)| own.abs_diff(exponent(other, *atom));
    let missing = other.iter().filter(|(atom, _)| exponent(one, *atom) == 0);
    one.iter().map(beyond).chain(missing.map(|(_, own)| own.unsigned_abs())).sum()
}

/// The factors of a term in the order of another term. Factors that the other does not have take the places of those
/// that only the other has.
fn ordered<'g>(term: &Product<'g>, like: &Product<'g>) -> Product<'g> {
    let mut others = term.iter().filter(|(atom, _)| exponent(like, *atom) == 0);
    let mut all: Product<'g> = vec![];
    for (atom, _) in like {
        match term.iter().find(|(known, _)| known == atom) {
            Some(own) => all.push(*own),
            None => all.extend(others.next()),
        }
    }
    all.extend(others);
    all
}

#[cfg(test)]
mod tests {
    use robot_symbolic::print::arranged_text;
    use robot_symbolic::{Polynomial, PolynomialOptions};

    use super::*;

    /// The sum in the order of the published terms.
    fn shown(sum: &str, published: &[&str]) -> Option<String> {
        let graph = Graph::new();
        let sum = graph.parse(sum).unwrap();
        let terms = Polynomial::of(sum, &PolynomialOptions::default()).unwrap();
        let mut order = TermOrder::default();
        order.insert("Q1", published.iter().map(|term| Formula::parse(term).unwrap()).collect());
        let arranged = order.arranged("Q1", &terms.arranged(Expr::id), &graph)?;
        Some(arranged_text(&arranged).unwrap())
    }

    #[test]
    fn terms_and_factors_have_the_order_of_the_text() {
        let of = |published: &[&str]| shown("m*g*cos(q) + 2*m*l^2*v - f", published);
        assert_eq!(of(&["-f", "l^2*2*v*m", "cos(q)*m*g"]).unwrap(), "-f + 2*l^2*v*m + cos(q)*m*g");
        // Parts of a sum that are printed separately are merged at the place of the first.
        assert_eq!(of(&["l*v*l*m", "-f", "m*l^2*v"]).unwrap(), "2*l^2*v*m - f + m*g*cos(q)");
        assert_eq!(of(&["f*(m + g)"]), None);
        assert_eq!(TermOrder::default().arranged("Q1", &[], &Graph::new()), None);
    }

    #[test]
    fn columns_have_the_number_that_their_components_share() {
        let mut order = TermOrder::default();
        for (quantity, number) in
            [("F1.x", "14"), ("F1.y", "14"), ("M_l2.x", "42"), ("M_l2.y", "43"), ("Q1", "53\\")]
        {
            order.set_number(quantity, number);
        }
        let numbers = order.numbers();
        let found = ["F1", "F1.x", "M_l2", "M_l2.y", "Q1"].map(|name| numbers.get(name));
        let found = found.map(|number| number.map(String::as_str));
        assert_eq!(found, [Some("14"), Some("14"), None, Some("43"), None]);
    }

    #[test]
    fn equations_without_a_counterpart_are_counted() {
        let graph = Graph::new();
        let terms = |sum: &str| {
            let sum = Polynomial::of(graph.parse(sum).unwrap(), &PolynomialOptions::default());
            sum.unwrap().arranged(Expr::id)
        };
        let printed = |terms: &[&str]| -> Vec<Formula> {
            terms.iter().map(|term| Formula::parse(term).unwrap()).collect()
        };
        let mut order = TermOrder::default();
        order.insert("Q1", printed(&["m*v", "a*b"]));
        order.insert("Q2", printed(&["m*v", "-f"]));
        order.insert_name("Q3");
        let mut differences = Differences::default();
        order.count(&mut differences, "Q1", &terms("a*k - 3*b*k"), &graph);
        assert_eq!(differences, Differences { without_common_terms: 1, compared: 1 });
        // Q2 has one term in common, with another coefficient; Q3 is only named, and Q4 is not in the text.
        order.count(&mut differences, "Q2", &terms("7*f + k"), &graph);
        order.count(&mut differences, "Q3", &terms("k"), &graph);
        order.count(&mut differences, "Q4", &terms("f"), &graph);
        assert_eq!(differences, Differences { without_common_terms: 1, compared: 3 });
    }

    #[test]
    fn what_the_text_has_wrong_stands_where_it_has_it() {
        let of = |published: &[&str]| shown("m*g*cos(q) + 2*m*l^2*v - f", published);
        // The text has a wrong index and a wrong sign; a term that it lacks is at the end.
        assert_eq!(of(&["v*l^2*k", "f"]).unwrap(), "2*v*l^2*m - f + m*g*cos(q)");
        assert_eq!(of(&["cos(p)*m*g", "f", "l*v"]).unwrap(), "cos(q)*m*g - f + 2*l^2*v*m");
    }
}
