//! Sums of products in which each monomial is packed into a few machine words. Each atom has a field of bits for its
//! exponent, so a product of monomials is a sum of words (Monagan and Pearce, "Sparse polynomial multiplication and
//! division in Maple 14", 2009).

use std::collections::HashMap;
use std::hash::{Hash, Hasher};

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::PolynomialError;
use super::accumulator::{Budget, Part, Terms};
use super::monomial::{Factor, Monomial};
use crate::graph::{Graph, Id};
use crate::number::Number;

/// The largest number of words of a packed monomial; longer monomials are multiplied unpacked.
const MAX_WORDS: usize = 4;
/// The largest number of bits of an exponent; monomials with larger exponents are multiplied unpacked.
const MAX_BITS: u32 = 16;

/// The field of an atom: the bits of one word that hold the atom's exponent minus its lowest possible value.
struct Field {
    factor: Factor,
    word: usize,
    shift: u32,
    bits: u32,
    range: Range,
}

/// The bounds of an atom's exponents in the left and in the right factors of all products; both ranges include 0.
#[derive(Clone, Copy, Default)]
struct Range {
    low: [i32; 2],
    high: [i32; 2],
    /// The largest increase of a cosine's exponent when the square of its sine is replaced.
    raise: i64,
}

impl Range {
    fn include(&mut self, side: usize, exponent: i32) {
        self.low[side] = self.low[side].min(exponent);
        self.high[side] = self.high[side].max(exponent);
    }

    fn low(&self) -> i64 {
        i64::from(self.low[0]) + i64::from(self.low[1])
    }

    fn bits(&self) -> u32 {
        let high = i64::from(self.high[0]) + i64::from(self.high[1]) + self.raise;
        u64::BITS - (high - self.low()).unsigned_abs().leading_zeros()
    }
}

/// A sine and its cosine, by the indices of their fields.
struct Sine {
    sine: usize,
    cosine: usize,
}

/// The position of each atom's exponent in the packed words. The fields are in the order of the atoms, starting with
/// the highest bits, so larger words stand for monomials that are listed earlier.
pub(super) struct Layout {
    fields: Vec<Field>,
    places: FxHashMap<Id, usize>,
    sines: Vec<Sine>,
    words: usize,
}

impl Layout {
    /// The layout for a sum of products. Returns `None` if the monomials are too wide, or if squares of atoms other
    /// than sines could arise.
    pub(super) fn new(graph: &Graph, parts: &[Part<'_>]) -> Option<Layout> {
        let mut ranges = ranges(parts);
        let pairs = sines(graph, &mut ranges)?;
        let mut ranges: Vec<(Factor, Range)> = ranges.into_values().collect();
        ranges.sort_unstable_by_key(|(factor, _)| factor.key());
        let (mut word, mut free) = (0, u64::BITS);
        let mut fields = Vec::with_capacity(ranges.len());
        for (factor, range) in ranges {
            let bits = range.bits();
            if bits > MAX_BITS {
                return None;
            }
            if bits > free {
                (word, free) = (word + 1, u64::BITS);
            }
            free -= bits;
            fields.push(Field { factor, word, shift: free, bits, range });
        }
        let places: FxHashMap<Id, usize> =
            fields.iter().enumerate().map(|(place, field)| (field.factor.atom(), place)).collect();
        let sine = |(sine, cosine)| {
            Some(Sine { sine: *places.get(&sine)?, cosine: *places.get(&cosine)? })
        };
        let sines = pairs.into_iter().map(sine).collect::<Option<Vec<_>>>()?;
        let words = word + 1;
        (words <= MAX_WORDS).then_some(Layout { fields, places, sines, words })
    }

    /// Computes the sum of the products.
    pub(super) fn sum(
        &self,
        parts: &[Part<'_>],
        budget: &mut Budget,
    ) -> Result<Terms, PolynomialError> {
        match self.words {
            1 => Sum::<1>::new(self, budget).run(parts),
            2 => Sum::<2>::new(self, budget).run(parts),
            _ => Sum::<MAX_WORDS>::new(self, budget).run(parts),
        }
    }

    #[cfg(test)]
    pub(super) fn sine_count(&self) -> usize {
        self.sines.len()
    }

    fn unit<const W: usize>(&self, place: usize) -> Key<W> {
        let mut key = Key([0; W]);
        let field = &self.fields[place];
        key.0[field.word] = 1 << field.shift;
        key
    }

    /// The packed monomial 1 as a left (0) or right (1) factor: every field holds the offset of its exponent.
    fn one<const W: usize>(&self, side: usize) -> Key<W> {
        let mut key = Key([0; W]);
        for field in &self.fields {
            let offset = u64::from(field.range.low[side].unsigned_abs());
            key.0[field.word] += offset << field.shift;
        }
        key
    }

    fn pack<const W: usize>(&self, one: Key<W>, monomial: &Monomial) -> Key<W> {
        let mut key = one;
        for factor in monomial.factors() {
            if let Some(field) = self.places.get(&factor.atom()).map(|place| &self.fields[*place]) {
                // The addition is modulo 2⁶⁴; the field itself ends within its range.
                let exponent = i64::from(factor.exponent()).cast_unsigned();
                key.0[field.word] = key.0[field.word].wrapping_add(exponent << field.shift);
            }
        }
        key
    }

    fn unpack<const W: usize>(&self, key: Key<W>) -> Monomial {
        let factors = self.fields.iter().filter_map(|field| {
            let value = (key.0[field.word] >> field.shift) & ((1 << field.bits) - 1);
            // The value has at most 16 bits, and the lowest exponent is a sum of two `i32`, so the sum cannot overflow.
            let exponent = value.cast_signed() + field.range.low();
            (exponent != 0).then(|| field.factor.with_exponent(exponent as i32))
        });
        Monomial::from_sorted(factors)
    }
}

/// The bounds of the exponents of all atoms.
fn ranges(parts: &[Part<'_>]) -> FxHashMap<Id, (Factor, Range)> {
    let mut ranges: FxHashMap<Id, (Factor, Range)> = FxHashMap::default();
    for part in parts {
        for (side, terms) in [part.a, part.b.unwrap_or_default()].into_iter().enumerate() {
            for factor in terms.iter().flat_map(|(monomial, _)| monomial.factors()) {
                let entry = ranges.entry(factor.atom());
                let (_, range) = entry.or_insert((*factor, Range::default()));
                range.include(side, factor.exponent());
            }
        }
    }
    ranges
}

/// The sines whose squares can arise, with their cosines, whose ranges are added or widened. Returns `None` if the
/// square of another atom can arise.
fn sines(graph: &Graph, ranges: &mut FxHashMap<Id, (Factor, Range)>) -> Option<Vec<(Id, Id)>> {
    let mut squares: Vec<(Id, Range)> = ranges
        .values()
        .filter(|(factor, range)| factor.is_reducible() && range.high == [1, 1])
        .map(|(factor, range)| (factor.atom(), *range))
        .collect();
    squares.sort_unstable_by_key(|(atom, _)| *atom);
    let mut pairs = vec![];
    for (sine, range) in squares {
        let cosine = graph.cosine_of(sine).filter(|_| range.low == [0, 0])?;
        let factor = Factor::new(cosine, false, 1);
        let (_, range) = ranges.entry(cosine).or_insert((factor, Range::default()));
        range.raise = 2;
        pairs.push((sine, cosine));
    }
    Some(pairs)
}

/// A packed monomial.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key<const W: usize>([u64; W]);

impl<const W: usize> Key<W> {
    fn plus(mut self, other: Key<W>) -> Key<W> {
        for (word, other) in self.0.iter_mut().zip(other.0) {
            *word += other;
        }
        self
    }

    fn minus(mut self, other: Key<W>) -> Key<W> {
        for (word, other) in self.0.iter_mut().zip(other.0) {
            *word -= other;
        }
        self
    }

    fn meets(self, mask: Key<W>) -> bool {
        let bits = self.0.iter().zip(mask.0).map(|(word, mask)| word & mask);
        bits.fold(0, |all, bits| all | bits) != 0
    }
}

/// Multiplies the words one after the other and folds the two halves of each product, because packed monomials can
/// differ in any bits of a word and the hash table uses only a few bits of the hash.
impl<const W: usize> Hash for Key<W> {
    #[inline]
    fn hash<H: Hasher>(&self, state: &mut H) {
        const MULTIPLIER: u64 = 0x9e37_79b9_7f4a_7c15;
        let fold = |hash: u64, word: &u64| {
            let product = u128::from(hash ^ word) * u128::from(MULTIPLIER);
            (product >> 64) as u64 ^ product as u64
        };
        state.write_u64(self.0.iter().fold(MULTIPLIER.rotate_left(32), fold));
    }
}

/// A sine that can be squared: the keys of its square and of the cosine's square. Only the square of the sine sets the
/// bit of the former.
struct Square<const W: usize> {
    sines: Key<W>,
    cosines: Key<W>,
}

struct Sum<'a, const W: usize> {
    layout: &'a Layout,
    budget: &'a mut Budget,
    terms: HashMap<Key<W>, Number, FxBuildHasher>,
    squares: Vec<Square<W>>,
    /// The bits that are set exactly if a sine is squared.
    mask: Key<W>,
}

impl<'a, const W: usize> Sum<'a, W> {
    fn new(layout: &'a Layout, budget: &'a mut Budget) -> Sum<'a, W> {
        let double = |place| {
            let unit = layout.unit::<W>(place);
            unit.plus(unit)
        };
        let squares: Vec<Square<W>> = layout
            .sines
            .iter()
            .map(|pair| Square { sines: double(pair.sine), cosines: double(pair.cosine) })
            .collect();
        // Of the exponents 0, 1 and 2, only 2 has the second bit set, which is twice the field's unit.
        let mask = squares.iter().fold(Key([0; W]), |mask, square| mask.plus(square.sines));
        Sum { layout, budget, terms: HashMap::default(), squares, mask }
    }

    fn run(mut self, parts: &[Part<'_>]) -> Result<Terms, PolynomialError> {
        let (left, right) = (self.layout.one::<W>(0), self.layout.one::<W>(1));
        for part in parts {
            let Some(b) = part.b else {
                for (monomial, number) in part.a {
                    let key = self.layout.pack(left, monomial).plus(right);
                    self.insert(key, number * part.factor)?;
                }
                continue;
            };
            self.budget.multiply(part.a, b)?;
            let pack = |(monomial, number)| (self.layout.pack(right, monomial), number);
            let b: Vec<(Key<W>, &Number)> = b.iter().map(|(m, n)| pack((m, n))).collect();
            for (monomial, number) in part.a {
                let key = self.layout.pack(left, monomial);
                let scaled = number * part.factor;
                for (other, number) in &b {
                    self.add(key.plus(*other), &scaled * number)?;
                }
            }
        }
        Ok(self.finish())
    }

    fn add(&mut self, key: Key<W>, coefficient: Number) -> Result<(), PolynomialError> {
        if !key.meets(self.mask) {
            return self.insert(key, coefficient);
        }
        // Replaces s² by 1 − c² for each squared sine.
        let mut pending = vec![(key, coefficient)];
        for square in &self.squares {
            if key.meets(square.sines) {
                for place in 0..pending.len() {
                    let (key, coefficient) = &mut pending[place];
                    *key = key.minus(square.sines);
                    let other = (key.plus(square.cosines), -&*coefficient);
                    pending.push(other);
                }
            }
        }
        pending.into_iter().try_for_each(|(key, coefficient)| self.insert(key, coefficient))
    }

    fn insert(&mut self, key: Key<W>, coefficient: Number) -> Result<(), PolynomialError> {
        match self.terms.entry(key) {
            std::collections::hash_map::Entry::Occupied(mut known) => {
                let sum = known.get() + &coefficient;
                known.insert(sum);
                Ok(())
            }
            std::collections::hash_map::Entry::Vacant(free) => {
                free.insert(coefficient);
                self.budget.hold(self.terms.len())
            }
        }
    }

    fn finish(self) -> Terms {
        let mut terms: Vec<(Key<W>, Number)> =
            self.terms.into_iter().filter(|(_, coefficient)| !coefficient.is_zero()).collect();
        terms.sort_unstable_by(|(a, _), (b, _)| b.cmp(a));
        let unpack = |(key, number)| (self.layout.unpack(key), number);
        terms.into_iter().map(unpack).collect()
    }
}
