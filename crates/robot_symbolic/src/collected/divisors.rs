//! Candidates for common factors of a sum f: f = K Q + R.

use std::cmp::Reverse;

use indexmap::{IndexMap, IndexSet};
use rustc_hash::{FxBuildHasher, FxHashMap, FxHashSet};

use super::terms::{Powers, Term, Terms, is_unit, term_length};
use crate::rational::Rational;

/// Sums of more terms are searched for single variables alone, not for what pairs of terms share.
const MAX_PAIRED: usize = 160;

/// The common powers by which sums of several terms are sought, those first that shorten most.
const MAX_KERNELS: usize = 48;

/// Integers up to this may be made as coefficients though no term has them.
const MAX_INTEGER: i64 = 16;

/// Longer sums are not squared: their brackets could not be broken over lines.
const MAX_SQUARED: usize = 5;

/// A way to write a sum f as K Q + R.
#[derive(Debug)]
pub(super) struct Candidate {
    /// K.
    pub(super) factor: Terms,
    /// Q; for a square, K.
    pub(super) quotient: Terms,
    /// The places of the terms of K Q, in order: R is the other terms.
    used: Vec<usize>,
    /// The printed symbols that it saves, by lengths of parts that are not yet factored.
    gain: isize,
}

impl Candidate {
    /// Whether a square is taken apart: x (x + y).
    fn splits_power(&self) -> bool {
        let [(factor, _)] = self.factor.as_slice() else { return false };
        let quotient = self.quotient.as_slice();
        factor.iter().any(|(one, _)| quotient.iter().any(|(powers, _)| powers.exponent(one) > 0))
    }

    /// R, of the terms of f.
    pub(super) fn rest(&self, terms: &Terms) -> Terms {
        terms.without(&self.used)
    }
}

/// The candidates of a sum, best first. `figures` are the absolute values of coefficients that may be printed.
pub(super) fn candidates(terms: &Terms, figures: &FxHashSet<Rational>) -> Vec<Candidate> {
    let seeker = Seeker::new(terms, figures);
    let mut found = seeker.squares();
    let (powers, kernels) = seeker.powers();
    found.extend(powers);
    found.extend(kernels);
    found.extend(seeker.pairs());
    found.extend(seeker.numbers());
    found.retain(|candidate| candidate.gain >= 0);
    // The sort is stable: of equal gains the first kind, but x (x + y) after others.
    found.sort_by_key(|candidate| (Reverse(candidate.gain), candidate.splits_power()));
    found
}

/// Two terms of a sum, divided by what they have in common, the lesser one first.
struct Pair<'t> {
    common: Powers,
    numbers: [&'t Rational; 2],
    places: [usize; 2],
}

struct Seeker<'t> {
    terms: &'t Terms,
    figures: &'t FxHashSet<Rational>,
    places: FxHashMap<&'t Powers, usize>,
    /// The variables of each term, by [`Powers::bits`].
    bits: Vec<u64>,
    /// The printed symbols of each term without its sign.
    lengths: Vec<usize>,
    /// The printed symbols of all.
    length: usize,
}

impl<'t> Seeker<'t> {
    fn new(terms: &'t Terms, figures: &'t FxHashSet<Rational>) -> Seeker<'t> {
        let places = terms.as_slice().iter().enumerate();
        let places = places.map(|(place, (powers, _))| (powers, place)).collect();
        let bits = terms.as_slice().iter().map(|(powers, _)| powers.bits()).collect();
        let lengths = terms.as_slice().iter().map(term_length).collect();
        Seeker { terms, figures, places, bits, lengths, length: terms.unsigned_length() }
    }

    /// f = K Q + R from the places of the terms of K Q.
    fn candidate(&self, factor: Terms, quotient: Terms, mut used: Vec<usize>) -> Candidate {
        used.sort_unstable();
        let taken: usize = used.iter().filter_map(|place| self.lengths.get(*place)).sum();
        // A sign less for each term that is taken, and none within K Q.
        let rest = (self.length - taken).saturating_sub(used.len());
        let square = factor == quotient && factor.len() > 1;
        let product = match square {
            true => part(&factor) + 1,
            false => part(&factor) + part(&quotient),
        };
        let length = product + rest + usize::from(used.len() < self.terms.len());
        let gain = self.length.cast_signed() - length.cast_signed();
        Candidate { factor, quotient, used, gain }
    }

    /// Whether a coefficient may be printed.
    fn allows(&self, number: &Rational) -> bool {
        let number = number.abs();
        number.to_integer().is_some_and(|integer| integer <= MAX_INTEGER)
            || self.figures.contains(&number)
    }

    /// Single variables and the common powers of pairs of terms, and the sums that they are multiplied by as factors
    /// themselves (co-kernels and kernels).
    fn powers(&self) -> (Vec<Candidate>, Vec<Candidate>) {
        let mut seeds: IndexSet<Powers, FxBuildHasher> = IndexSet::default();
        seeds.extend(self.terms.variables().into_iter().map(Powers::of));
        let all = self.terms.as_slice();
        if all.len() <= MAX_PAIRED {
            for (place, (a, _)) in all.iter().enumerate() {
                seeds.extend(all[place + 1..].iter().map(|(b, _)| a.common(b)));
            }
        }
        let mut divided: IndexMap<Powers, (Terms, Vec<usize>), FxBuildHasher> = IndexMap::default();
        for seed in seeds.iter().filter(|seed| !seed.is_one()) {
            if let Some((powers, quotient, used)) = self.divided(seed) {
                divided.entry(powers).or_insert((quotient, used));
            }
        }
        let mut candidates: Vec<Candidate> = divided
            .into_iter()
            .map(|(powers, (quotient, used))| {
                self.candidate(Terms::single(powers, Rational::ONE), quotient, used)
            })
            .collect();
        candidates.sort_by_key(|candidate| Reverse(candidate.gain));
        let mut tried: FxHashSet<&Terms> = FxHashSet::default();
        let kernels = candidates.iter().take(MAX_KERNELS);
        let kernels: Vec<Candidate> = kernels
            .filter(|candidate| tried.insert(&candidate.quotient))
            .filter_map(|candidate| self.by_sum(&candidate.quotient))
            .collect();
        (candidates, kernels)
    }

    /// The terms that some powers divide, two at least, divided by all that these have in common.
    fn divided(&self, seed: &Powers) -> Option<(Powers, Terms, Vec<usize>)> {
        let mut used = vec![];
        let mut quotient: Vec<Term> = vec![];
        let needed = seed.bits();
        let has_variables =
            |place: &usize| self.bits.get(*place).is_some_and(|bits| bits & needed == needed);
        let all = self.terms.as_slice().iter().enumerate();
        for (place, (powers, number)) in all.filter(|(place, _)| has_variables(place)) {
            if let Some(left) = powers.quotient(seed) {
                quotient.push((left, number.clone()));
                used.push(place);
            }
        }
        if used.len() < 2 {
            return None;
        }
        let quotient = Terms::sum(quotient);
        let more = quotient.content();
        if more.is_one() {
            return Some((seed.clone(), quotient, used));
        }
        Some((seed.product(&more), quotient.over(&more), used))
    }

    /// The weak division by a sum of several terms, if it is a factor of several products.
    fn by_sum(&self, divisor: &Terms) -> Option<Candidate> {
        let (first, inverse) = divisor
            .as_slice()
            .first()
            .and_then(|(powers, number)| Some((powers, number.recip()?)))?;
        let mut used: Vec<usize> = vec![];
        let mut quotient: Vec<Term> = vec![];
        for (powers, number) in self.terms.as_slice() {
            let Some(left) = powers.quotient(first) else { continue };
            if !divisor.as_slice().iter().all(|(own, _)| self.has(&own.product(&left))) {
                continue;
            }
            let ratio = number * &inverse;
            if !self.allows(&ratio) {
                continue;
            }
            if let Some(mut places) = self.places_of(divisor, &left, &ratio, &used) {
                used.append(&mut places);
                quotient.push((left, ratio));
            }
        }
        let quotient = Terms::sum(quotient);
        (quotient.len() > 1).then(|| self.candidate(divisor.clone(), quotient, used))
    }

    /// Whether a term has these powers.
    fn has(&self, powers: &Powers) -> bool {
        self.places.contains_key(powers)
    }

    /// The places of the terms of a product of a sum with one term, all of them unused.
    fn places_of(
        &self,
        sum: &Terms,
        powers: &Powers,
        number: &Rational,
        used: &[usize],
    ) -> Option<Vec<usize>> {
        let place = |(own, coefficient): &Term| {
            let place = *self.places.get(&own.product(powers))?;
            let known = &self.terms.as_slice().get(place)?.1;
            (*known == coefficient * number && !used.contains(&place)).then_some(place)
        };
        sum.as_slice().iter().map(place).collect()
    }

    /// Sums of two terms that are factors of several products (double-cube divisors).
    fn pairs(&self) -> Vec<Candidate> {
        let all = self.terms.as_slice();
        if all.len() > MAX_PAIRED {
            return vec![];
        }
        let mut alike: IndexMap<(Powers, Powers), Vec<Pair<'t>>, FxBuildHasher> =
            IndexMap::default();
        for (i, (a, x)) in all.iter().enumerate() {
            for (j, (b, y)) in all.iter().enumerate().skip(i + 1) {
                let [common, a, b] = a.split(b);
                let (a, b, numbers) = if a <= b { (a, b, [x, y]) } else { (b, a, [y, x]) };
                alike.entry((a, b)).or_default().push(Pair { common, numbers, places: [i, j] });
            }
        }
        // Most pairs occur once: only of the others the numbers are compared.
        let mut found: Vec<(Powers, Powers, Rational, Vec<Pair<'t>>)> = vec![];
        for ((a, b), pairs) in alike.into_iter().filter(|(_, pairs)| pairs.len() > 1) {
            let mut by_ratio: IndexMap<Rational, Vec<Pair<'t>>, FxBuildHasher> =
                IndexMap::default();
            for pair in pairs {
                let [x, y] = pair.numbers;
                let Some(inverse) = x.recip() else { continue };
                by_ratio.entry(y * &inverse).or_default().push(pair);
            }
            let several = by_ratio.into_iter().filter(|(_, pairs)| pairs.len() > 1);
            found.extend(several.map(|(ratio, pairs)| (a.clone(), b.clone(), ratio, pairs)));
        }
        // In the order of the first pair of each.
        found.sort_by_key(|(.., pairs)| pairs.first().map(|pair| pair.places));
        let candidate = |(a, b, ratio, pairs): (Powers, Powers, Rational, Vec<Pair<'t>>)| {
            self.by_pair(&a, &b, &ratio, &pairs)
        };
        found.into_iter().filter_map(candidate).collect()
    }

    fn by_pair(
        &self,
        a: &Powers,
        b: &Powers,
        ratio: &Rational,
        pairs: &[Pair<'t>],
    ) -> Option<Candidate> {
        // Of the ways to share numbers between the two factors the first that makes no new ones.
        let first = |pair: &Pair<'t>| pair.numbers[0];
        let mut scales =
            std::iter::once(Rational::ONE).chain(pairs.iter().map(|pair| first(pair).abs()));
        let fits = |scale: &Rational| {
            let inverse = scale.recip();
            self.allows(&(ratio * scale))
                && inverse.is_some_and(|inverse| {
                    pairs.iter().all(|pair| self.allows(&(first(pair) * &inverse)))
                })
        };
        let scale = scales.find(fits)?;
        let inverse = scale.recip()?;
        let mut used: Vec<usize> = vec![];
        let mut quotient: Vec<Term> = vec![];
        for pair in pairs {
            if pair.places.iter().any(|place| used.contains(place)) {
                continue;
            }
            used.extend(pair.places);
            quotient.push((pair.common.clone(), first(pair) * &inverse));
        }
        let factor = Terms::sum([(a.clone(), scale.clone()), (b.clone(), ratio * &scale)]);
        let quotient = Terms::sum(quotient);
        (quotient.len() > 1).then(|| self.candidate(factor, quotient, used))
    }

    /// Numbers that several terms have.
    fn numbers(&self) -> Vec<Candidate> {
        let mut by_number: IndexMap<Rational, Vec<usize>, FxBuildHasher> = IndexMap::default();
        for (place, (_, number)) in self.terms.as_slice().iter().enumerate() {
            if !is_unit(number) {
                by_number.entry(number.abs()).or_default().push(place);
            }
        }
        let several = by_number.into_iter().filter(|(_, places)| places.len() > 1);
        let candidate = |(number, used): (Rational, Vec<usize>)| {
            let inverse = number.recip()?;
            let terms = used.iter().filter_map(|place| self.terms.as_slice().get(*place));
            let quotient = Terms::sum(terms.map(|(powers, own)| (powers.clone(), own * &inverse)));
            Some(self.candidate(Terms::single(Powers::default(), number), quotient, used))
        };
        several.filter_map(candidate).collect()
    }

    /// Complete squares of sums.
    fn squares(&self) -> Vec<Candidate> {
        let all = self.terms.as_slice();
        let root = |(powers, number): &Term| number.is_one().then(|| powers.root()).flatten();
        let roots: Vec<Powers> =
            all.iter().filter_map(root).filter(|root| !root.is_one()).collect();
        let mut found = vec![];
        for (place, first) in roots.iter().enumerate() {
            let mut sum = vec![(first.clone(), Rational::ONE)];
            for other in &roots[place + 1..] {
                if let Some(sign) = self.sign_of(&sum, other) {
                    sum.push((other.clone(), sign));
                }
            }
            let sum = Terms::sum(sum);
            if sum.len() > 1
                && sum.length() <= MAX_SQUARED
                && let Some(used) = self.places_of_square(&sum)
            {
                found.push(self.candidate(sum.clone(), sum, used));
            }
        }
        found
    }

    /// The sign of a further term of a sum, by the double products of a square.
    fn sign_of(&self, sum: &[Term], other: &Powers) -> Option<Rational> {
        let sign = |(powers, own): &Term| {
            let number = &self.terms.as_slice().get(*self.places.get(&powers.product(other))?)?.1;
            match number.to_integer()? {
                2 => Some(own.clone()),
                -2 => Some(-own),
                _ => None,
            }
        };
        let mut signs = sum.iter().map(sign);
        let first = signs.next()??;
        signs.all(|sign| sign.as_ref() == Some(&first)).then_some(first)
    }

    fn places_of_square(&self, sum: &Terms) -> Option<Vec<usize>> {
        let square = Terms::sum(
            sum.as_slice()
                .iter()
                .flat_map(|(x, m)| sum.as_slice().iter().map(move |(y, n)| (x.product(y), m * n))),
        );
        self.places_of(&square, &Powers::default(), &Rational::ONE, &[])
    }
}

/// The printed symbols of a factor, in brackets if it is a sum.
fn part(terms: &Terms) -> usize {
    match terms.as_slice() {
        [(powers, number)] if powers.is_one() && is_unit(number) => 0,
        [single] => term_length(single),
        _ => estimate(terms) + 1,
    }
}

/// The length of a sum that has not been factored: less if it is a complete square.
fn estimate(terms: &Terms) -> usize {
    let content = terms.content();
    if content.is_one() {
        return flat_or_square(terms);
    }
    let inner = flat_or_square(&terms.over(&content));
    terms.unsigned_length().min(content.length() + inner + 1)
}

/// The length of a sum, or that of the power that it is.
fn flat_or_square(terms: &Terms) -> usize {
    let roots = terms.as_slice().iter();
    let roots = roots.filter(|(powers, number)| number.is_one() && powers.root().is_some());
    let count = roots.clone().count();
    if count < 2 || terms.len() != count * (count + 1) / 2 {
        return terms.unsigned_length();
    }
    let root: usize = roots.filter_map(|(powers, _)| powers.root()).map(|it| it.length() + 1).sum();
    // As long as the signs of the double products agree, which the search for squares looks at.
    terms.unsigned_length().min(root + 1)
}
