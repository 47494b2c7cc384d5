//! The square of a sine or that of a cosine: whichever is shorter.

use super::terms::{Powers, Term, Terms, Variable};
use super::variables::Variables;

/// The most angles whose squares are chosen together; of further ones the cosine's stays.
const MAX_ANGLES: usize = 4;

/// The terms, with squares of cosines, by squares of sines where that is shorter.
pub(super) fn chosen(terms: &Terms, variables: &Variables<'_>) -> Terms {
    let mut squared: Vec<Variable> = vec![];
    for (powers, _) in terms.as_slice() {
        let squares = powers.iter().filter(|(_, exponent)| *exponent > 1).map(|power| power.0);
        squared.extend(squares.filter(|variable| variables.is_cosine(*variable)));
    }
    squared.sort_unstable();
    squared.dedup();
    squared.truncate(MAX_ANGLES);
    let forms = (0..1_usize << squared.len()).map(|choice| {
        let places = squared.iter().enumerate();
        let chosen = places.filter(|(place, _)| choice & (1 << place) != 0);
        let form =
            chosen.fold(terms.clone(), |terms, (_, cosine)| by_sine(&terms, *cosine, variables));
        merged(form, variables)
    });
    forms.min_by_key(Terms::length).unwrap_or_else(|| terms.clone())
}

/// The terms with 1 − sin² for the square of a cosine.
fn by_sine(terms: &Terms, cosine: Variable, variables: &Variables<'_>) -> Terms {
    let Some(sine) = variables.partner(cosine) else { return terms.clone() };
    let mut pending: Vec<Term> = terms.as_slice().to_vec();
    let mut done = vec![];
    while let Some((powers, number)) = pending.pop() {
        match powers.quotient(&square(cosine)) {
            None => done.push((powers, number)),
            Some(rest) => {
                pending.push((rest.product(&square(sine)), -&number));
                pending.push((rest, number));
            }
        }
    }
    Terms::sum(done)
}

fn square(variable: Variable) -> Powers {
    Powers::from_unsorted([(variable, 2)].into_iter())
}

/// The terms with k m − k m cos² as k m sin², and with sines and cosines the other way round.
fn merged(mut terms: Terms, variables: &Variables<'_>) -> Terms {
    while let Some((places, term)) = mergeable(terms.as_slice(), variables) {
        let rest = terms.without(&places);
        terms = Terms::sum(rest.as_slice().iter().cloned().chain([term]));
    }
    terms
}

/// The places, in order, of two terms that are one, and that one.
fn mergeable(terms: &[Term], variables: &Variables<'_>) -> Option<([usize; 2], Term)> {
    for (place, (powers, number)) in terms.iter().enumerate() {
        for (variable, exponent) in powers.iter() {
            let Some(partner) = variables.partner(variable).filter(|_| exponent > 1) else {
                continue;
            };
            let Some(rest) = powers.quotient(&square(variable)) else { continue };
            let opposite = -number;
            let other =
                terms.iter().position(|(known, other)| *known == rest && *other == opposite);
            if let Some(other) = other {
                let term = (rest.product(&square(partner)), opposite);
                return Some(([place.min(other), place.max(other)], term));
            }
        }
    }
    None
}
