//! The rewriting of coefficients in the angles that make them shortest, by the addition theorems in both directions.

use rustc_hash::FxHashMap;

use super::angles::{Angle, Basis, Group};
use super::terms::{Powers, Term, Terms, Variable, term_length};
use super::variables::Variables;
use crate::rational::Rational;

/// The sine and cosine of an angle.
type Circle = [Terms; 2];

impl Group {
    /// Rewrites the coefficient of every product of variables outside the group in the basis that makes it shortest.
    pub(super) fn shortest(&self, terms: &Terms, variables: &Variables<'_>) -> Terms {
        let mut rewriters: Vec<Rewriter<'_, '_>> =
            self.bases.iter().map(|basis| Rewriter::new(self, basis, variables)).collect();
        let mut all: Vec<Term> = vec![];
        for (cofactor, coefficient) in self.by_cofactor(terms) {
            let sum = Terms::sum(coefficient);
            let forms = rewriters.iter_mut().map(|rewriter| self.fused(rewriter.rewritten(&sum)));
            let best = forms.min_by_key(|form| self.cost(form, &cofactor));
            let best = best.unwrap_or(sum);
            all.extend(best.times(&(cofactor, Rational::ONE)).as_slice().iter().cloned());
        }
        Terms::sum(all)
    }

    /// The terms in each basis, with all coefficients in the same basis. Such a sum is longer than [`Group::shortest`],
    /// but its factors can include sums of sines and cosines.
    pub(super) fn in_bases(
        &self,
        terms: &Terms,
        variables: &Variables<'_>,
    ) -> impl Iterator<Item = Terms> {
        let bases = self.bases.iter().enumerate();
        let distinct = bases.filter(|(place, basis)| !self.bases[..*place].contains(basis));
        distinct.map(|(_, basis)| Rewriter::new(self, basis, variables).rewritten(terms))
    }

    /// The number of printed symbols, then the number of coordinates in the angles.
    fn cost(&self, form: &Terms, cofactor: &Powers) -> (usize, usize) {
        let joints = |variable: Variable| {
            let edge = self.edge_of(variable);
            edge.map_or(0, |edge| edge.signs.iter().filter(|sign| **sign != 0).count())
        };
        let terms = form.as_slice().iter();
        let lengths = terms.clone().map(|term| term_length(term) + cofactor.length() + 1).sum();
        let angles = terms.flat_map(|(powers, _)| powers.iter());
        (lengths, angles.map(|(variable, exponent)| joints(variable) * usize::from(exponent)).sum())
    }

    /// Replaces cos a cos b ∓ sin a sin b by one cosine, and sin a cos b ± cos a sin b by one sine, if a ± b is an
    /// angle of the group.
    fn fused(&self, mut terms: Terms) -> Terms {
        while let Some((places, term)) = self.fusible(terms.as_slice()) {
            let rest = terms.without(&places);
            terms = Terms::sum(rest.as_slice().iter().cloned().chain([term]));
        }
        terms
    }

    /// The places of the first two terms that can be merged into one, and the merged term.
    fn fusible(&self, terms: &[Term]) -> Option<([usize; 2], Term)> {
        for (i, (a, x)) in terms.iter().enumerate() {
            for (j, (b, y)) in terms.iter().enumerate().skip(i + 1) {
                if x.abs() != y.abs() {
                    continue;
                }
                let [common, a, b] = a.split(b);
                if let Some((variable, negative)) = self.sum_of([&a, &b], x == y) {
                    let number = if negative { -x } else { x.clone() };
                    return Some(([i, j], (common.product(&Powers::of(variable)), number)));
                }
            }
        }
        None
    }

    /// The sine or cosine that equals the sum (if `same`) or difference of two products of two factors, and whether it
    /// must be negated.
    fn sum_of(&self, products: [&Powers; 2], same: bool) -> Option<(Variable, bool)> {
        let [first, second] = products.map(|product| self.two(product));
        let ([a, b], [c, d]) = (first?, second?);
        // Both products must contain the same two angles.
        let (c, d) = if a.0 == c.0 { (c, d) } else { (d, c) };
        if a.0 != c.0 || b.0 != d.0 || a.0 == b.0 {
            return None;
        }
        let (x, y) = (&self.edges.get(a.0)?.signs, &self.edges.get(b.0)?.signs);
        let combined = |minus: bool| -> Option<(Angle, bool)> {
            let sum = |(x, y): (&i8, &i8)| if minus { x - y } else { x + y };
            self.angle_of(&x.iter().zip(y).map(sum).collect::<Vec<_>>())
        };
        match (a.1, b.1, c.1, d.1) {
            // cos x cos y ± sin x sin y = cos(x ∓ y)
            (false, false, true, true) => Some((combined(same)?.0.cosine, false)),
            // ±(cos x cos y ± sin x sin y)
            (true, true, false, false) => Some((combined(same)?.0.cosine, !same)),
            // sin x cos y ± cos x sin y = sin(x ± y)
            (true, false, false, true) => {
                let (angle, negative) = combined(!same)?;
                Some((angle.sine, negative))
            }
            // cos x sin y ± sin x cos y = ±sin(x ± y)
            (false, true, true, false) => {
                let (angle, negative) = combined(!same)?;
                Some((angle.sine, negative == same))
            }
            _ => None,
        }
    }

    /// The two factors of a product, each with the index of its edge and whether it is the sine.
    fn two(&self, product: &Powers) -> Option<[(usize, bool); 2]> {
        let mut factors = product.iter();
        let (Some((a, 1)), Some((b, 1)), None) = (factors.next(), factors.next(), factors.next())
        else {
            return None;
        };
        let of = |variable: Variable| {
            let is = |angle: Angle| angle.sine == variable || angle.cosine == variable;
            let place = self.edges.iter().position(|edge| is(edge.angle))?;
            Some((place, self.edges.get(place)?.angle.sine == variable))
        };
        Some([of(a)?, of(b)?])
    }
}

/// Rewrites sines and cosines of coordinates in the angles of a basis.
struct Rewriter<'a, 'g> {
    circles: FxHashMap<Variable, Terms>,
    known: FxHashMap<Powers, Terms>,
    variables: &'a Variables<'g>,
}

impl<'a, 'g> Rewriter<'a, 'g> {
    fn new(group: &Group, basis: &Basis, variables: &'a Variables<'g>) -> Rewriter<'a, 'g> {
        let mut circles = FxHashMap::default();
        for (coordinate, sum) in group.coordinates.iter().zip(basis) {
            let one = Terms::single(Powers::default(), Rational::ONE);
            let mut circle: Circle = [Terms::default(), one];
            for (edge, negative) in sum {
                if let Some(edge) = group.edges.get(*edge) {
                    circle = turned(&circle, edge.angle, *negative, variables);
                }
            }
            let [sine, cosine] = circle;
            circles.insert(coordinate.sine, sine);
            circles.insert(coordinate.cosine, cosine);
        }
        Rewriter { circles, known: FxHashMap::default(), variables }
    }

    fn rewritten(&mut self, terms: &Terms) -> Terms {
        let mut all: Vec<Term> = vec![];
        for (powers, number) in terms.as_slice() {
            all.extend(self.of_powers(powers).scaled(number).as_slice().iter().cloned());
        }
        Terms::sum(all)
    }

    fn of_powers(&mut self, powers: &Powers) -> Terms {
        if let Some(known) = self.known.get(powers) {
            return known.clone();
        }
        let mut product = Terms::single(Powers::default(), Rational::ONE);
        for (variable, exponent) in powers.iter() {
            let own = Terms::single(Powers::of(variable), Rational::ONE);
            let factor = self.circles.get(&variable).unwrap_or(&own);
            for _ in 0..exponent {
                product = multiplied(&product, factor, self.variables);
            }
        }
        self.known.insert(powers.clone(), product.clone());
        product
    }
}

/// The sine and cosine of the sum or, if `negative`, the difference of an angle and one of the group's angles.
fn turned([s, c]: &Circle, by: Angle, negative: bool, variables: &Variables<'_>) -> Circle {
    let sign = Rational::integer(if negative { -1 } else { 1 });
    let sine = (Powers::of(by.sine), sign.clone());
    let cosine = (Powers::of(by.cosine), Rational::ONE);
    let minus_sine = (Powers::of(by.sine), -&sign);
    let sum = |a: Terms, b: Terms| {
        reduced(a.as_slice().iter().chain(b.as_slice()).cloned().collect(), variables)
    };
    [sum(s.times(&cosine), c.times(&sine)), sum(c.times(&cosine), s.times(&minus_sine))]
}

fn multiplied(a: &Terms, b: &Terms, variables: &Variables<'_>) -> Terms {
    let products = a
        .as_slice()
        .iter()
        .flat_map(|(x, m)| b.as_slice().iter().map(move |(y, n)| (x.product(y), m * n)));
    reduced(products.collect(), variables)
}

/// The sum of the terms, with each square of a sine replaced by 1 − cos².
pub(super) fn reduced(terms: Vec<Term>, variables: &Variables<'_>) -> Terms {
    let mut pending = terms;
    let mut done = vec![];
    while let Some((powers, number)) = pending.pop() {
        let square = powers.iter().find_map(|(variable, exponent)| {
            let cosine = variables.cosine_of(variable)?;
            (exponent > 1).then_some((variable, cosine))
        });
        let Some((sine, cosine)) = square else {
            done.push((powers, number));
            continue;
        };
        let squared = |variable| Powers::from_unsorted([(variable, 2)].into_iter());
        let Some(rest) = powers.quotient(&squared(sine)) else { continue };
        pending.push((rest.product(&squared(cosine)), -&number));
        pending.push((rest, number));
    }
    Terms::sum(done)
}
