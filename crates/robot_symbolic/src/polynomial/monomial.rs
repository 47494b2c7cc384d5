//! Products of powers of atoms.

use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

use smallvec::SmallVec;

use crate::graph::Id;

/// The bit that marks atoms whose square is replaced (sines, roots and absolute values), so that a product immediately
/// shows whether it must be reduced. A graph of 2³¹ nodes, whose ids would need this bit, does not fit into memory.
const REDUCIBLE: u32 = 1 << 31;

/// A power of an atom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    key: u32,
    exponent: i32,
}

impl Factor {
    pub(super) fn new(atom: Id, reducible: bool, exponent: i32) -> Factor {
        Factor { key: atom.0 | if reducible { REDUCIBLE } else { 0 }, exponent }
    }

    /// The atom: a node of the polynomial's graph.
    #[must_use]
    pub fn atom(self) -> Id {
        Id(self.key & !REDUCIBLE)
    }

    /// The exponent: never 0, and negative in a denominator.
    #[must_use]
    pub fn exponent(self) -> i32 {
        self.exponent
    }

    pub(super) fn key(self) -> u32 {
        self.key
    }

    pub(super) fn is_reducible(self) -> bool {
        self.key & REDUCIBLE != 0
    }

    pub(super) fn with_exponent(self, exponent: i32) -> Factor {
        Factor { exponent, ..self }
    }
}

/// A product of powers of distinct atoms, without a coefficient; the empty product is 1.
///
/// Monomials are ordered as they are listed: by the power of the first atom, higher powers first, then by that of the
/// next (x² before x y before x before y before 1 before 1/x).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Monomial(SmallVec<[Factor; 8]>);

impl Monomial {
    /// The monomial 1.
    pub(super) fn one() -> Monomial {
        Monomial::default()
    }

    pub(super) fn from_factor(factor: Factor) -> Monomial {
        Monomial(SmallVec::from_slice(&[factor]))
    }

    /// The monomial of factors that are already sorted.
    pub(super) fn from_sorted(factors: impl Iterator<Item = Factor>) -> Monomial {
        Monomial(factors.collect())
    }

    /// The factors in a fixed order; each atom occurs once.
    #[must_use]
    pub fn factors(&self) -> &[Factor] {
        &self.0
    }

    /// Whether this is the monomial 1.
    #[must_use]
    pub fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    /// The exponent of an atom; 0 if it does not occur.
    #[must_use]
    pub fn exponent(&self, atom: Id) -> i32 {
        let factor = self.0.iter().find(|factor| factor.atom() == atom);
        factor.map_or(0, |factor| factor.exponent)
    }

    /// The product, and whether it contains a square that must be replaced; `None` if an exponent overflows.
    pub(super) fn product(&self, other: &Monomial) -> Option<(Monomial, bool)> {
        let (a, b) = (self.0.as_slice(), other.0.as_slice());
        let mut factors = SmallVec::new();
        let mut reducible = false;
        let (mut i, mut j) = (0, 0);
        while let (Some(x), Some(y)) = (a.get(i), b.get(j)) {
            match x.key.cmp(&y.key) {
                Ordering::Less => {
                    factors.push(*x);
                    i += 1;
                }
                Ordering::Greater => {
                    factors.push(*y);
                    j += 1;
                }
                Ordering::Equal => {
                    let exponent = x.exponent.checked_add(y.exponent)?;
                    if exponent != 0 {
                        factors.push(x.with_exponent(exponent));
                        reducible |= x.is_reducible() && exponent >= 2;
                    }
                    i += 1;
                    j += 1;
                }
            }
        }
        factors.extend_from_slice(a.get(i..).unwrap_or_default());
        factors.extend_from_slice(b.get(j..).unwrap_or_default());
        Some((Monomial(factors), reducible))
    }

    /// The first factor whose square must be replaced, and the monomial without that square.
    pub(super) fn split_square(&self) -> Option<(Factor, Monomial)> {
        let place =
            self.0.iter().position(|factor| factor.is_reducible() && factor.exponent >= 2)?;
        let factor = self.0[place];
        let mut rest = self.0.clone();
        if factor.exponent == 2 {
            rest.remove(place);
        } else {
            rest[place].exponent -= 2;
        }
        Some((factor, Monomial(rest)))
    }

    /// The factors that `chosen` selects, and the others.
    pub(super) fn partition(&self, chosen: impl Fn(Id) -> bool) -> (Monomial, Monomial) {
        let (mut inside, mut outside) = (Monomial::one(), Monomial::one());
        for factor in &self.0 {
            if chosen(factor.atom()) {
                inside.0.push(*factor);
            } else {
                outside.0.push(*factor);
            }
        }
        (inside, outside)
    }

    /// The monomial with the exponent of an atom lowered by one; `None` if the atom does not occur.
    pub(super) fn lowered(&self, atom: Id) -> Option<Monomial> {
        let place = self.0.iter().position(|factor| factor.atom() == atom)?;
        let mut factors = self.0.clone();
        let exponent = factors[place].exponent.checked_sub(1)?;
        if exponent == 0 {
            factors.remove(place);
        } else {
            factors[place].exponent = exponent;
        }
        Some(Monomial(factors))
    }

    /// `1 / self`; `None` if an exponent overflows.
    pub(super) fn inverse(&self) -> Option<Monomial> {
        let mut factors = self.0.clone();
        for factor in &mut factors {
            factor.exponent = factor.exponent.checked_neg()?;
        }
        Some(Monomial(factors))
    }

    /// The largest monomial that divides both: each atom has the smaller of its two exponents.
    pub(super) fn common(&self, other: &Monomial) -> Monomial {
        let mut factors: SmallVec<[Factor; 8]> = SmallVec::new();
        for factor in &self.0 {
            let exponent = factor.exponent.min(other.exponent(factor.atom()));
            if exponent != 0 {
                factors.push(factor.with_exponent(exponent));
            }
        }
        for factor in &other.0 {
            if factor.exponent < 0 && self.exponent(factor.atom()) == 0 {
                factors.push(*factor);
            }
        }
        factors.sort_unstable_by_key(|factor| factor.key);
        Monomial(factors)
    }
}

impl Hash for Monomial {
    fn hash<H: Hasher>(&self, state: &mut H) {
        for factor in &self.0 {
            // The key and the exponent are in the low bits, which affect all bits of the hash.
            let exponent = i64::from(factor.exponent).cast_unsigned();
            state.write_u64(u64::from(factor.key) ^ exponent.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        }
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Monomial) -> Ordering {
        compare_powers(&self.0, &other.0, |factor| (factor.key, factor.exponent))
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Monomial) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The order in which two products of powers are listed. Both must be sorted by rank; `power` gives the rank of an atom
/// and its exponent.
pub(crate) fn compare_powers<T>(a: &[T], b: &[T], power: impl Fn(&T) -> (u32, i32)) -> Ordering {
    // At the first atom that only one product has, that product comes first if the power is positive, otherwise second.
    let alone = |exponent: i32| exponent.cmp(&0).reverse();
    for (x, y) in a.iter().map(&power).zip(b.iter().map(&power)) {
        let order = match x.0.cmp(&y.0) {
            Ordering::Less => alone(x.1),
            Ordering::Greater => alone(y.1).reverse(),
            Ordering::Equal => x.1.cmp(&y.1).reverse(),
        };
        if order != Ordering::Equal {
            return order;
        }
    }
    match (a.get(b.len()), b.get(a.len())) {
        (Some(x), _) => alone(power(x).1),
        (_, Some(y)) => alone(power(y).1).reverse(),
        _ => Ordering::Equal,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial(powers: &[(u32, i32)]) -> Monomial {
        let mut result = Monomial::one();
        for (atom, exponent) in powers {
            let factor = Factor::new(Id(*atom), false, *exponent);
            result = result.product(&Monomial::from_factor(factor)).unwrap().0;
        }
        result
    }

    #[test]
    fn monomials_are_listed_by_falling_powers() {
        let listed = [
            monomial(&[(0, 2)]),
            monomial(&[(0, 1), (1, 1)]),
            monomial(&[(0, 1)]),
            monomial(&[(0, 1), (1, -1)]),
            monomial(&[(1, 3)]),
            monomial(&[(2, 1)]),
            Monomial::one(),
            monomial(&[(2, -1)]),
            monomial(&[(0, -1), (1, 2)]),
            monomial(&[(0, -1)]),
        ];
        for (i, a) in listed.iter().enumerate() {
            for (j, b) in listed.iter().enumerate() {
                assert_eq!(a.cmp(b), i.cmp(&j), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn powers_add_and_cancel() {
        let a = monomial(&[(3, 2), (1, -1)]);
        let b = monomial(&[(1, 1), (2, 1), (3, 1)]);
        assert_eq!(a.product(&b).unwrap().0, monomial(&[(2, 1), (3, 3)]));
        assert_eq!(a.product(&a.inverse().unwrap()).unwrap().0, Monomial::one());
        assert_eq!(a.common(&b), monomial(&[(1, -1), (3, 1)]));
        assert_eq!(b.common(&a), a.common(&b));
        let huge = monomial(&[(0, i32::MAX)]);
        assert_eq!(huge.product(&huge), None);
    }
}
