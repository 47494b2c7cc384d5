//! The choice between the squares of a sine and those of the cosine, whichever is shorter.

use super::terms::{Powers, Term, Terms, Variable};
use super::variables::Variables;

/// The largest number of angles whose squares are chosen together; the cosines of further angles keep their squares.
const MAX_ANGLES: usize = 4;

/// Replaces squares of cosines by squares of sines for the angles for which this gives shorter terms.
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
        merged(canceled(form, variables), variables)
    });
    forms.min_by_key(Terms::length).unwrap_or_else(|| terms.clone())
}

/// Replaces the square of a cosine by 1 − sin².
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

/// Cancels sines with their reciprocals, which are variables of their own: sin² x/sin² x is 1.
fn canceled(terms: Terms, variables: &Variables<'_>) -> Terms {
    if !variables.have_reciprocals() {
        return terms;
    }
    let common = |powers: &Powers| {
        let both = |(variable, exponent): (Variable, u16)| {
            let below = variables.reciprocal(variable)?;
            let shared = exponent.min(powers.exponent(below));
            Some([(variable, shared), (below, shared)])
        };
        Powers::from_unsorted(powers.iter().filter_map(both).flatten())
    };
    let quotient = |(powers, number): &Term| {
        let rest = powers.quotient(&common(powers)).unwrap_or_else(|| powers.clone());
        (rest, number.clone())
    };
    Terms::sum(terms.as_slice().iter().map(quotient))
}

fn square(variable: Variable) -> Powers {
    Powers::from_unsorted([(variable, 2)].into_iter())
}

/// Replaces k m − k m cos² by k m sin², and the same with sines and cosines exchanged.
fn merged(mut terms: Terms, variables: &Variables<'_>) -> Terms {
    while let Some((places, term)) = mergeable(terms.as_slice(), variables) {
        let rest = terms.without(&places);
        terms = Terms::sum(rest.as_slice().iter().cloned().chain([term]));
    }
    terms
}

/// The sorted places of two terms that can be merged into one, and the merged term.
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
