//! Coefficients in terms of earlier ones: b₁₂₂ = ½ b₁₁₂.

use robot_symbolic::collected::length;
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm};
use robot_symbolic::{Monomial, Number, Polynomial, Rational};
use rustc_hash::FxHashMap;

use super::Writer;
use super::coefficients::{MAX_TERMS, MIN_LENGTH, Section, Shown};

/// The possible factors of an earlier coefficient, as numerator and denominator.
const FACTORS: [(i64, i64); 6] = [(1, 1), (-1, 1), (2, 1), (-2, 1), (1, 2), (-1, 2)];

/// The largest number of names that a reader must follow from a coefficient to one that is written out.
const MAX_DEPTH: usize = 2;

/// The number of differences from earlier coefficients that are written out to find the shortest.
const MAX_TRIED: usize = 3;

/// A coefficient in terms of which others can be written.
struct Earlier<'g> {
    name: String,
    value: Polynomial<'g>,
    numbers: FxHashMap<Monomial, Number>,
    depth: usize,
}

/// A way to write a coefficient: the place of an earlier one, its factor, and the number of terms that remain.
struct Way {
    place: usize,
    factor: Rational,
    left: usize,
}

/// The largest number of printed symbols of a coefficient that is written by an earlier one instead of named parts.
const MAX_BY_EARLIER: usize = 60;

/// Writes coefficients as a multiple of an earlier one of their section, plus a remainder, if that is at most two
/// thirds as long, or if it is short and the coefficient would otherwise need named parts.
pub(super) fn refer<'g>(
    writer: &Writer<'_, 'g>,
    sections: &[Section<'g>],
    shown: &mut [Vec<Shown<'g>>],
) {
    for (section, shown) in sections.iter().zip(shown) {
        if section.by_symbols {
            continue;
        }
        let mut earlier: Vec<Earlier<'g>> = vec![];
        for (coefficient, shown) in section.coefficients.iter().zip(shown) {
            let (value, most) = match shown {
                Shown::Short { value, terms } => (value.clone(), 2 * length(terms) / 3),
                Shown::Long { value: Some(value) } => (value.clone(), MAX_BY_EARLIER),
                Shown::Long { value: None } | Shown::Zero | Shown::Earlier => continue,
            };
            let mut depth = 0;
            if most >= 2 * MIN_LENGTH / 3
                && let Some((terms, below)) = shortest(writer, &value, &earlier)
                && length(&terms) <= most
            {
                *shown = Shown::Short { value: value.clone(), terms };
                depth = below + 1;
            }
            if depth < MAX_DEPTH {
                let numbers =
                    value.terms().map(|(monomial, number)| (monomial.clone(), number.clone()));
                let numbers = numbers.collect();
                let name = coefficient.name.clone();
                earlier.push(Earlier { name, value, numbers, depth });
            }
        }
    }
}

/// The shortest way to write a value by an earlier one, and the depth of the earlier one.
fn shortest<'g>(
    writer: &Writer<'_, 'g>,
    value: &Polynomial<'g>,
    earlier: &[Earlier<'g>],
) -> Option<(Vec<ArrangedTerm<'g>>, usize)> {
    let of_like_length =
        |(_, earlier): &(usize, &Earlier<'g>)| earlier.value.len() < 2 * value.len();
    let mut ways: Vec<Way> = earlier
        .iter()
        .enumerate()
        .filter(of_like_length)
        .filter_map(|(place, earlier)| best_way(place, value, earlier))
        .collect();
    ways.sort_by_key(|way| way.left);
    let written = ways.into_iter().take(MAX_TRIED).filter_map(|way| {
        let earlier = earlier.get(way.place)?;
        let factor = Number::from(way.factor);
        let rest = value.sub(&earlier.value.scale(&factor)).ok()?;
        let mut terms = vec![ArrangedTerm {
            negative: factor.is_negative(),
            coefficient: if factor.is_negative() { -&factor } else { factor },
            factors: vec![(ArrangedFactor::Atom(writer.graph.symbol(&earlier.name)), 1)],
        }];
        if rest.len() > MAX_TERMS {
            return None;
        }
        if !rest.is_zero() {
            terms.extend(writer.collected(&rest));
        }
        Some((terms, earlier.depth))
    });
    written.min_by_key(|(terms, _)| length(terms))
}

/// The factor with which the fewest terms remain; `None` if there are not fewer than the value has.
fn best_way<'g>(place: usize, value: &Polynomial<'g>, earlier: &Earlier<'g>) -> Option<Way> {
    let (mut common, mut matched) = (0, [0; FACTORS.len()]);
    let factors: Vec<Rational> =
        FACTORS.iter().filter_map(|(above, below)| Rational::new(*above, *below)).collect();
    for (monomial, number) in value.terms() {
        let Some(other) = earlier.numbers.get(monomial) else { continue };
        common += 1;
        for (factor, matched) in factors.iter().zip(&mut matched) {
            *matched += usize::from(*number == other * &Number::from(factor.clone()));
        }
    }
    let most = matched.iter().max()?;
    let factor = factors.get(matched.iter().position(|count| count == most)?)?.clone();
    let left = value.len() + earlier.value.len() - common - most;
    (left < value.len()).then_some(Way { place, factor, left })
}
