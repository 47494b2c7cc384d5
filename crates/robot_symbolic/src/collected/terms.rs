//! Sums of products of numbered variables: the polynomials in which common factors are searched for.

use std::cmp::Ordering;

use smallvec::SmallVec;

use crate::polynomial::compare_powers;
use crate::rational::Rational;

/// The number of a variable. Variables are numbered in the order in which they are printed.
pub(super) type Variable = u16;

/// A product of powers of variables, sorted by variable; the exponents are positive.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Powers(SmallVec<[(Variable, u16); 7]>);

impl Powers {
    /// The first power of a variable.
    pub(super) fn of(variable: Variable) -> Powers {
        Powers(SmallVec::from_slice(&[(variable, 1)]))
    }

    /// The product of powers that are in any order, with no variable twice.
    pub(super) fn from_unsorted(powers: impl Iterator<Item = (Variable, u16)>) -> Powers {
        let mut powers: SmallVec<_> = powers.filter(|(_, exponent)| *exponent > 0).collect();
        powers.sort_unstable();
        Powers(powers)
    }

    pub(super) fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (Variable, u16)> + '_ {
        self.0.iter().copied()
    }

    pub(super) fn exponent(&self, variable: Variable) -> u16 {
        let place = self.0.binary_search_by_key(&variable, |power| power.0);
        place.map_or(0, |place| self.0[place].1)
    }

    pub(super) fn product(&self, other: &Powers) -> Powers {
        let mut product = SmallVec::new();
        let (mut a, mut b) = (self.0.iter().peekable(), other.0.iter().peekable());
        loop {
            match (a.peek(), b.peek()) {
                (Some(x), Some(y)) => match x.0.cmp(&y.0) {
                    Ordering::Less => product.extend(a.next().copied()),
                    Ordering::Greater => product.extend(b.next().copied()),
                    Ordering::Equal => {
                        product.push((x.0, x.1.saturating_add(y.1)));
                        a.next();
                        b.next();
                    }
                },
                (Some(_), None) => product.extend(a.next().copied()),
                (None, Some(_)) => product.extend(b.next().copied()),
                (None, None) => return Powers(product),
            }
        }
    }

    /// The quotient; `None` if the divisor does not divide the product.
    pub(super) fn quotient(&self, divisor: &Powers) -> Option<Powers> {
        let mut quotient = SmallVec::new();
        let mut divisors = divisor.0.iter().peekable();
        for (variable, exponent) in self.iter() {
            let mut left = exponent;
            if let Some((_, by)) = divisors.next_if(|power| power.0 == variable) {
                left = exponent.checked_sub(*by)?;
            }
            if left > 0 {
                quotient.push((variable, left));
            }
        }
        divisors.peek().is_none().then_some(Powers(quotient))
    }

    /// The largest product that divides both.
    pub(super) fn common(&self, other: &Powers) -> Powers {
        let shared = |(variable, exponent): (Variable, u16)| {
            let exponent = exponent.min(other.exponent(variable));
            (exponent > 0).then_some((variable, exponent))
        };
        Powers(self.iter().filter_map(shared).collect())
    }

    /// The largest product that divides both, and the quotients of both by it.
    pub(super) fn split(&self, other: &Powers) -> [Powers; 3] {
        let (mut common, mut own, mut others) = (SmallVec::new(), SmallVec::new(), SmallVec::new());
        let (mut a, mut b) = (self.iter().peekable(), other.iter().peekable());
        loop {
            match (a.peek().copied(), b.peek().copied()) {
                (Some(x), Some(y)) if x.0 == y.0 => {
                    let shared = x.1.min(y.1);
                    common.push((x.0, shared));
                    own.extend((x.1 > shared).then(|| (x.0, x.1 - shared)));
                    others.extend((y.1 > shared).then(|| (y.0, y.1 - shared)));
                    a.next();
                    b.next();
                }
                (Some(x), y) if y.is_none_or(|y| x.0 < y.0) => own.extend(a.next()),
                (_, Some(_)) => others.extend(b.next()),
                _ => return [Powers(common), Powers(own), Powers(others)],
            }
        }
    }

    /// The set of variables of the product, as bits; variables whose numbers are equal modulo 64 share a bit.
    pub(super) fn bits(&self) -> u64 {
        self.iter().fold(0, |bits, (variable, _)| bits | 1 << (variable % 64))
    }

    /// The square root; `None` unless all exponents are even.
    pub(super) fn root(&self) -> Option<Powers> {
        let halved = |(variable, exponent): (Variable, u16)| {
            (exponent % 2 == 0).then_some((variable, exponent / 2))
        };
        Some(Powers(self.iter().map(halved).collect::<Option<_>>()?))
    }

    /// The number of printed symbols: a variable counts one, and an exponent above 1 counts one.
    pub(super) fn length(&self) -> usize {
        self.iter().map(|(_, exponent)| 1 + usize::from(exponent > 1)).sum()
    }
}

impl Ord for Powers {
    /// The order in which terms are listed: higher powers of the first variable first.
    fn cmp(&self, other: &Powers) -> Ordering {
        let power = |power: &(Variable, u16)| (u32::from(power.0), i32::from(power.1));
        compare_powers(&self.0, &other.0, power)
    }
}

impl PartialOrd for Powers {
    fn partial_cmp(&self, other: &Powers) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A product of powers with its coefficient, which is not 0.
pub(super) type Term = (Powers, Rational);

/// A sum of terms in the order in which they are listed; no product of powers occurs twice.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Terms(Vec<Term>);

impl Terms {
    /// The sum of terms in any order; terms with the same powers are merged.
    pub(super) fn sum(terms: impl IntoIterator<Item = Term>) -> Terms {
        let mut all: Vec<Term> = terms.into_iter().collect();
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        let mut merged: Vec<Term> = Vec::with_capacity(all.len());
        for (powers, coefficient) in all {
            match merged.last_mut() {
                Some(last) if last.0 == powers => last.1 = &last.1 + &coefficient,
                _ => merged.push((powers, coefficient)),
            }
        }
        merged.retain(|(_, coefficient)| !coefficient.is_zero());
        Terms(merged)
    }

    /// The sum that consists of one term.
    pub(super) fn single(powers: Powers, coefficient: Rational) -> Terms {
        Terms(vec![(powers, coefficient)])
    }

    pub(super) fn as_slice(&self) -> &[Term] {
        &self.0
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// The terms except those at `places`, which must be sorted.
    pub(super) fn without(&self, places: &[usize]) -> Terms {
        let kept = self.0.iter().enumerate();
        let kept = kept.filter(|(place, _)| places.binary_search(place).is_err());
        Terms(kept.map(|(_, term)| term.clone()).collect())
    }

    /// The product of the sum and a number that is not 0.
    pub(super) fn scaled(&self, factor: &Rational) -> Terms {
        let scaled = |(powers, number): &Term| (powers.clone(), number * factor);
        Terms(self.0.iter().map(scaled).collect())
    }

    /// The product of the sum and one term.
    pub(super) fn times(&self, (powers, number): &Term) -> Terms {
        let times = |(own, coefficient): &Term| (own.product(powers), coefficient * number);
        Terms::sum(self.0.iter().map(times))
    }

    /// The terms divided by a product of powers that divides all of them.
    pub(super) fn over(&self, divisor: &Powers) -> Terms {
        let quotient = |(powers, number): &Term| Some((powers.quotient(divisor)?, number.clone()));
        Terms::sum(self.0.iter().filter_map(quotient))
    }

    /// The largest product of powers that divides all terms.
    pub(super) fn content(&self) -> Powers {
        let mut powers = self.0.iter().map(|(powers, _)| powers);
        let first = powers.next().cloned().unwrap_or_default();
        powers.fold(first, |common, powers| common.common(powers))
    }

    /// The number of printed symbols of the sum as it is: factors, exponents, coefficients, signs.
    pub(super) fn length(&self) -> usize {
        let leading = self.0.first().is_some_and(|(_, number)| number.is_negative());
        self.unsigned_length() + usize::from(leading)
    }

    /// The length without a minus sign at the beginning, which the term that contains the sum in parentheses can
    /// absorb.
    pub(super) fn unsigned_length(&self) -> usize {
        self.0.iter().map(term_length).sum::<usize>() + self.0.len().saturating_sub(1)
    }

    /// The variables that occur, in order.
    pub(super) fn variables(&self) -> Vec<Variable> {
        let powers = self.0.iter().flat_map(|(powers, _)| powers.iter());
        let mut variables: Vec<Variable> = powers.map(|(variable, _)| variable).collect();
        variables.sort_unstable();
        variables.dedup();
        variables
    }
}

/// The number of printed symbols of a term, without its sign.
pub(super) fn term_length((powers, number): &Term) -> usize {
    powers.length() + usize::from(powers.is_one() || !is_unit(number))
}

/// Whether a number is 1 or −1.
pub(super) fn is_unit(number: &Rational) -> bool {
    matches!(number.to_integer(), Some(1 | -1))
}
