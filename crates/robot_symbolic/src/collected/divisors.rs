//! Candidates K for common factors of a sum f = K Q + R.

use std::cmp::Reverse;

use indexmap::{IndexMap, IndexSet};
use rustc_hash::{FxBuildHasher, FxHashMap, FxHashSet};

use super::factoring::Kinds;
use super::terms::{Powers, Term, Terms, Variable, is_unit, term_length};
use crate::rational::Rational;

/// The largest number of terms of a sum in which pairs of terms are compared.
const MAX_PAIRED: usize = 160;

/// The number of common powers whose quotients are tried as factors themselves; those that shorten the sum most are
/// used.
const MAX_KERNELS: usize = 48;

/// The largest integer that is allowed as a coefficient even if no term has it.
const MAX_INTEGER: i64 = 16;

/// The largest length of a sum that is written as a square: the parentheses of longer sums could not be broken over
/// lines.
const MAX_SQUARED: usize = 5;

/// A way to write a sum f as K Q + R.
#[derive(Debug)]
pub(super) struct Candidate {
    /// K.
    pub(super) factor: Terms,
    /// Q; equal to K for a square.
    pub(super) quotient: Terms,
    /// The sorted places of the terms of K Q; the other terms are R.
    used: Vec<usize>,
    /// The number of printed symbols that it saves, estimated from K, Q and R before they are factored.
    gain: isize,
}

impl Candidate {
    /// Whether the candidate splits a square, as in x (x + y).
    fn splits_power(&self) -> bool {
        let [(factor, _)] = self.factor.as_slice() else { return false };
        let quotient = self.quotient.as_slice();
        factor.iter().any(|(one, _)| quotient.iter().any(|(powers, _)| powers.exponent(one) > 0))
    }

    /// Returns R, given the terms of f.
    pub(super) fn rest(&self, terms: &Terms) -> Terms {
        terms.without(&self.used)
    }
}

/// Returns the candidates of a sum, best first. `allowed` are the absolute values of coefficients that are allowed in
/// the result, besides small integers.
pub(super) fn candidates(
    terms: &Terms,
    allowed: &FxHashSet<Rational>,
    kinds: &Kinds,
) -> Vec<Candidate> {
    let seeker = Seeker::new(terms, allowed, kinds);
    let mut found = seeker.squares();
    let (powers, kernels) = seeker.powers();
    found.extend(powers);
    found.extend(kernels);
    found.extend(seeker.pairs());
    found.extend(seeker.numbers());
    found.retain(|candidate| candidate.gain >= 0);
    // The sort is stable: equal gains stay in the order of the kinds above, but candidates like x (x + y) come last.
    found.sort_by_key(|candidate| (Reverse(candidate.gain), candidate.splits_power()));
    found
}

/// Two terms of a sum, divided by their common powers; the numbers are in the order of the remaining powers.
struct Pair<'t> {
    common: Powers,
    numbers: [&'t Rational; 2],
    places: [usize; 2],
}

struct Seeker<'t> {
    terms: &'t Terms,
    allowed: &'t FxHashSet<Rational>,
    kinds: &'t Kinds,
    places: FxHashMap<&'t Powers, usize>,
    /// The variables of each term, as given by [`Powers::bits`].
    bits: Vec<u64>,
    /// The number of printed symbols of each term, without its sign.
    lengths: Vec<usize>,
    /// The number of printed symbols of the sum.
    length: usize,
}

impl<'t> Seeker<'t> {
    fn new(terms: &'t Terms, allowed: &'t FxHashSet<Rational>, kinds: &'t Kinds) -> Seeker<'t> {
        let places = terms.as_slice().iter().enumerate();
        let places = places.map(|(place, (powers, _))| (powers, place)).collect();
        let bits = terms.as_slice().iter().map(|(powers, _)| powers.bits()).collect();
        let lengths = terms.as_slice().iter().map(term_length).collect();
        Seeker { terms, allowed, kinds, places, bits, lengths, length: terms.unsigned_length() }
    }

    /// Creates the candidate f = K Q + R from K, Q and the places of the terms of K Q.
    fn candidate(&self, factor: Terms, quotient: Terms, mut used: Vec<usize>) -> Candidate {
        used.sort_unstable();
        let taken: usize = used.iter().filter_map(|place| self.lengths.get(*place)).sum();
        // Each term of K Q also takes its sign with it; the sign of K Q as a whole is added below.
        let rest = (self.length - taken).saturating_sub(used.len());
        let square = factor == quotient && factor.len() > 1;
        let product = match square {
            true => part(&factor) + 1,
            false => part(&factor) + part(&quotient) - self.units(&[&factor, &quotient]),
        };
        let length = product + rest + usize::from(used.len() < self.terms.len());
        let gain = self.length.cast_signed() - length.cast_signed();
        Candidate { factor, quotient, used, gain }
    }

    /// The number of sums without sines and cosines in which one term is 1 or −1; this term is not counted in the
    /// length.
    fn units(&self, factors: &[&Terms]) -> usize {
        let is_circular = |(one, _): (Variable, u16)| self.kinds.is_circular(one);
        let has_unit = |sum: &&&Terms| {
            let mut terms = sum.as_slice().iter();
            sum.len() > 1
                && terms.any(|(powers, number)| powers.is_one() && is_unit(number))
                && !sum.as_slice().iter().any(|(powers, _)| powers.iter().any(is_circular))
        };
        factors.iter().filter(has_unit).count()
    }

    /// Whether a coefficient is allowed in the result.
    fn allows(&self, number: &Rational) -> bool {
        let number = number.abs();
        number.to_integer().is_some_and(|integer| integer <= MAX_INTEGER)
            || self.allowed.contains(&number)
    }

    /// Candidates whose factor is a variable or the common powers of two terms (co-kernels), and candidates whose
    /// factor is the quotient of one of these (kernels).
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

    /// Divides the terms that `seed` divides by all that these terms have in common; `None` if there are fewer than
    /// two.
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

    /// Divides weakly by a sum of several terms; `None` unless it is a factor of several products.
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

    /// Whether one of the terms has these powers.
    fn has(&self, powers: &Powers) -> bool {
        self.places.contains_key(powers)
    }

    /// The places of the terms of the product of a sum and one term; `None` if a term is missing or already used.
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

    /// Candidates whose factor is a sum of two terms that occurs in several products (double-cube divisors).
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
        // Most pairs occur only once, so the numbers are compared only for the others.
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
        // Each is sorted by its first pair.
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
        // Numbers can be shared between the two factors in several ways; the first way that makes no new numbers is
        // used.
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

    /// Candidates whose factor is a number that several terms have.
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

    /// Candidates that are complete squares of sums.
    fn squares(&self) -> Vec<Candidate> {
        let roots: Vec<Term> = self.terms.as_slice().iter().filter_map(root).collect();
        let mut found = vec![];
        for (place, first) in roots.iter().enumerate() {
            let mut sum = vec![first.clone()];
            for other in &roots[place + 1..] {
                if let Some(sign) = self.sign_of(&sum, other) {
                    sum.push((other.0.clone(), &other.1 * &sign));
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

    /// The sign of a further term of a sum, from the double products of the square; `None` if these do not fit.
    fn sign_of(&self, sum: &[Term], (other, root): &Term) -> Option<Rational> {
        let sign = |(powers, own): &Term| {
            let number = &self.terms.as_slice().get(*self.places.get(&powers.product(other))?)?.1;
            let double = &(own * root) + &(own * root);
            let ratio = number * &double.recip()?;
            matches!(ratio.to_integer()?, 1 | -1).then_some(ratio)
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

/// The number of printed symbols of a factor, with parentheses if it is a sum.
fn part(terms: &Terms) -> usize {
    match terms.as_slice() {
        [(powers, number)] if powers.is_one() && is_unit(number) => 0,
        [single] => term_length(single),
        _ => estimate(terms) + 1,
    }
}

/// Estimates the length of a sum that is not yet factored; a common factor or a complete square makes it shorter.
fn estimate(terms: &Terms) -> usize {
    let content = terms.content();
    if content.is_one() {
        return flat_or_square(terms);
    }
    let inner = flat_or_square(&terms.over(&content));
    terms.unsigned_length().min(content.length() + inner + 1)
}

/// The length of a sum, or of its square root with an exponent if it can be a complete square.
fn flat_or_square(terms: &Terms) -> usize {
    let roots: Vec<Term> = terms.as_slice().iter().filter_map(root).collect();
    let count = roots.len();
    if count < 2 || terms.len() != count * (count + 1) / 2 {
        return terms.unsigned_length();
    }
    let length: usize = roots.iter().map(|root| term_length(root) + 1).sum();
    // The signs of the double products are not checked here; the search for squares does that.
    terms.unsigned_length().min(length + 1)
}

/// The square root of a term: of a product of even powers, or of a number, which stands beside a symbol in a square such as
/// (q + 0.4)².
fn root((powers, square): &Term) -> Option<Term> {
    let number = match powers.is_one() {
        true => {
            let (above, below) = square.to_small()?;
            Rational::new(above.checked_isqrt()?, below.checked_isqrt()?)?
        }
        false => Rational::ONE,
    };
    (&number * &number == *square).then_some((powers.root()?, number))
}
