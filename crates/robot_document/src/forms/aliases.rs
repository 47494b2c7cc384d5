//! Coefficients that equal an earlier one and therefore have no equation of their own.

use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Expr, Number, Polynomial};

use super::Writer;
use super::coefficients::{LIMITS, Section, Shown, Sum};
use crate::error::Error;

/// Replaces each coefficient that equals an earlier one of its section, possibly with the opposite sign, by the earlier
/// one: the joint torques contain b₂₃₃ (q̇₃ + q̇₄) q̇₃, and there is no equation b₂₃₄ = b₂₃₃.
///
/// Coefficients of one or two printed symbols, such as a mass, keep their equations, unless they contain a long number;
/// so do those that are not in the sums, such as joint forces, which occur in functions.
pub(super) fn replace<'g>(
    sections: &[Section<'g>],
    shown: &mut [Vec<Shown<'g>>],
    sums: &mut [Sum<'g>],
) {
    for (section, shown) in sections.iter().zip(shown).filter(|(section, _)| !section.by_symbols) {
        let mut earlier: Vec<(&str, Polynomial<'g>)> = vec![];
        for (coefficient, shown) in section.coefficients.iter().zip(shown) {
            let Some(value) = shown.comparable() else { continue };
            let opposite = value.scale(&Number::integer(-1));
            let same = earlier.iter().find_map(|(name, known)| match () {
                () if is_equal(known, value) => Some((*name, false)),
                () if is_equal(known, &opposite) => Some((*name, true)),
                () => None,
            });
            let is_term = || sums.iter().flatten().any(|(name, _)| *name == coefficient.name);
            match same {
                Some((name, is_opposite)) if is_term() => {
                    rename(sums, &coefficient.name, name, is_opposite);
                    *shown = Shown::Earlier;
                }
                _ => earlier.push((&coefficient.name, value.clone())),
            }
        }
    }
}

/// Replaces each coefficient that is only a symbol by the symbol: Q₁ = q̈₁ β₁, and there is no equation Y₁₁ = q̈₁.
pub(super) fn replace_symbols<'g>(
    section: Option<&Section<'g>>,
    shown: Option<&mut Vec<Shown<'g>>>,
    sums: &mut [Sum<'g>],
) {
    for (coefficient, shown) in
        section.iter().flat_map(|one| &one.coefficients).zip(shown.into_iter().flatten())
    {
        let Shown::Short { terms, .. } = shown else { continue };
        if let [term] = terms.as_slice()
            && term.coefficient.is_one()
            && let [(ArrangedFactor::Atom(atom), 1)] = term.factors.as_slice()
            && let Some(symbol) = atom.as_symbol()
        {
            let name = atom.graph().symbol_name(symbol);
            rename(sums, &coefficient.name, &name, term.negative);
            *shown = Shown::Earlier;
        }
    }
}

fn is_equal(one: &Polynomial<'_>, other: &Polynomial<'_>) -> bool {
    one.len() == other.len() && one.sub(other).is_ok_and(|rest| rest.is_zero())
}

fn rename(sums: &mut [Sum<'_>], from: &str, to: &str, is_opposite: bool) {
    for (name, factor) in sums.iter_mut().flatten().filter(|(name, _)| name == from) {
        to.clone_into(name);
        if is_opposite {
            *factor = -*factor;
        }
    }
}

/// The terms of a sum of coefficients times factors, in the order of the coefficients. A coefficient that occurs
/// several times is written once, before the sum of its factors.
pub(super) fn terms<'g>(
    writer: &Writer<'_, 'g>,
    sum: &[(String, Expr<'g>)],
) -> Result<Vec<ArrangedTerm<'g>>, Error> {
    let graph = writer.graph;
    let mut terms: Vec<ArrangedTerm<'g>> = vec![];
    for (place, (name, _)) in sum.iter().enumerate() {
        if sum.iter().take(place).any(|(before, _)| before == name) {
            continue;
        }
        let symbol = graph.symbol(name);
        let all = sum.iter().filter(|(one, _)| one == name);
        let factors = all.clone().fold(graph.zero(), |sum, (_, factor)| sum + *factor);
        let product = Polynomial::of(symbol * factors, &LIMITS)
            .map_err(|error| writer.too_long(error.to_string()))?;
        match all.count() {
            1 => terms.extend(product.arranged(|atom| writer.order.rank(atom))),
            _ => terms.extend(writer.collected(&product).into_iter().map(|term| led(term, symbol))),
        }
    }
    Ok(terms)
}

/// Moves a factor of a term before all others.
fn led<'g>(mut term: ArrangedTerm<'g>, first: Expr<'g>) -> ArrangedTerm<'g> {
    let is_first = |(factor, _): &(ArrangedFactor<'g>, i32)| matches!(factor, ArrangedFactor::Atom(atom) if *atom == first);
    if let Some(place) = term.factors.iter().position(is_first) {
        term.factors[..=place].rotate_right(1);
    }
    term
}
