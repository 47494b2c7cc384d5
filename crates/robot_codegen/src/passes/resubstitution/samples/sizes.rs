//! Sizes of loads at which no term of a sum is lost beside another.
//!
//! The torques of a robot of micrograms are far below 10⁻¹⁶ N·m. At torques of size one, τ − 2·10⁻¹⁷ cos q and τ
//! round to the same number, and the term of gravity would count as rounding. So at one set of points for each
//! [`Resizing`] the loads are of the size of the terms beside them.

use std::collections::BTreeMap;

use super::{POINTS_PER_SET, Sample};
use crate::program::{Operation, Program, Source, Value};

/// The number of ways in which loads are resized.
pub(super) const RESIZINGS: usize = 2;

/// How loads are resized.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Resizing {
    /// What only the larger term of a sum depends on is made smaller.
    Smaller,
    /// Likewise; if nothing is, what only the smaller term depends on is made larger, since gravity can be a number.
    Either,
}

impl Resizing {
    /// All of them. Each has points of its own, since sizes that let the terms of one sum be noticed can hide those of
    /// another.
    pub(super) const ALL: [Resizing; RESIZINGS] = [Resizing::Smaller, Resizing::Either];

    /// The points at which loads have these sizes.
    fn points(self) -> [usize; POINTS_PER_SET] {
        let set = 1 + self as usize;
        std::array::from_fn(|point| set * POINTS_PER_SET + point)
    }
}

/// A term of a sum is noticed if it is larger than the rounding error of the sum by this factor, so that as many digits
/// of it are compared.
const NOTICED: f64 = 1e6;
/// The most adjustments: each reveals the sums that the one before made unbalanced.
const ROUNDS: usize = 10;
/// The relative change of a load from which the share of that load in a value is computed.
const STEP: f64 = 1e-9;
/// The least share of a load in a value that depends on it.
const SHARE: f64 = 1e-3;

/// The least degree of a term for which a size is computed from it.
const HOMOGENEOUS: f64 = 0.5;

/// The sizes of loads at one set of points; 1 for those that are not listed.
#[derive(Clone)]
pub(super) struct Sizes {
    how: Resizing,
    factors: BTreeMap<Source, f64>,
    /// Whether the values of functions have the size of their arguments at these points.
    is_used: bool,
}

impl Sizes {
    /// All loads of size one.
    pub(super) fn one(how: Resizing) -> Sizes {
        Sizes { how, factors: BTreeMap::new(), is_used: false }
    }

    /// Chooses sizes at which the terms of each sum are noticed, as far as this is possible. `evaluate` returns the
    /// samples of the program at given sizes.
    pub(super) fn balancing(
        how: Resizing,
        program: &Program,
        evaluate: impl Fn(&Sizes) -> Vec<Sample>,
    ) -> Sizes {
        let mut sizes = Sizes { is_used: true, ..Sizes::one(how) };
        for _ in 0..ROUNDS {
            let samples = evaluate(&sizes);
            let mut sums = unbalanced_sums(how, program, &samples);
            if sums.is_empty() {
                break;
            }
            for source in program.sources().into_iter().filter(is_free) {
                let changed = evaluate(&sizes.times(source, 1.0 + STEP));
                sums.iter_mut().for_each(|sum| sum.note(source, &samples, &changed));
            }
            if !sizes.adjust(&sums) {
                break;
            }
        }
        if sizes.factors.is_empty() { Sizes::one(how) } else { sizes }
    }

    /// The size of a load at a point, if the point is one of these.
    pub(super) fn at(&self, source: Source, point: usize) -> Option<f64> {
        self.factors.get(&source).copied().filter(|_| self.how.points().contains(&point))
    }

    /// Whether loads have sizes of their own at a point.
    pub(super) fn are_used_at(&self, point: usize) -> bool {
        self.is_used && self.how.points().contains(&point)
    }

    fn times(&self, source: Source, factor: f64) -> Sizes {
        let mut sizes = self.clone();
        *sizes.factors.entry(source).or_insert(1.0) *= factor;
        sizes
    }

    /// Changes the loads that only one term of a sum depends on; returns whether there are any. Where sums differ in
    /// what they want, the smallest size counts: a load is made larger only if no sum needs it smaller.
    fn adjust(&mut self, sums: &[Unbalanced]) -> bool {
        let mut factors: BTreeMap<Source, f64> = BTreeMap::new();
        for (source, wanted) in sums.iter().flat_map(Unbalanced::factors) {
            let factor = factors.entry(source).or_insert(wanted);
            *factor =
                if *factor < 1.0 || wanted < 1.0 { factor.min(wanted) } else { factor.max(wanted) };
        }
        for (source, factor) in &factors {
            *self.factors.entry(*source).or_insert(1.0) *= factor;
        }
        !factors.is_empty()
    }
}

/// A sum in which one term can be lost.
struct Unbalanced {
    how: Resizing,
    larger: Value,
    smaller: Value,
    /// The size of the smaller term relative to the larger one.
    ratio: f64,
    /// The loads that only the larger term depends on, with their shares in it: (x/v) ∂v/∂x.
    of_larger: Vec<(Source, f64)>,
    /// The same of the smaller term.
    of_smaller: Vec<(Source, f64)>,
}

impl Unbalanced {
    /// Notes a load, from the values before and after it has changed.
    fn note(&mut self, source: Source, before: &[Sample], after: &[Sample]) {
        let share = |value: Value| {
            let [before, after] = [before, after].map(|samples| &samples[value.index()]);
            let share = |point: usize| {
                let change = after.values[point] - before.values[point];
                (change / before.values[point]).to_f64() / STEP
            };
            let shares = self.how.points().map(share);
            shares
                .into_iter()
                .fold(0.0, |most: f64, share| if share.abs() > most.abs() { share } else { most })
        };
        let [larger, smaller] = [self.larger, self.smaller].map(share);
        match (larger.abs() > SHARE, smaller.abs() > SHARE) {
            (true, false) => self.of_larger.push((source, larger)),
            (false, true) => self.of_smaller.push((source, smaller)),
            _ => {}
        }
    }

    /// The factors of loads at which both terms are of one size. The shares in a homogeneous function add up to its
    /// degree (Euler).
    fn factors(&self) -> impl Iterator<Item = (Source, f64)> {
        let degree = |shares: &[(Source, f64)]| shares.iter().map(|(_, share)| share).sum::<f64>();
        let [larger, smaller] = [&self.of_larger, &self.of_smaller].map(|shares| degree(shares));
        let (loads, factor) = if larger > HOMOGENEOUS {
            (&self.of_larger, self.ratio.powf(1.0 / larger.max(1.0)))
        } else if self.how == Resizing::Either && smaller > HOMOGENEOUS {
            (&self.of_smaller, self.ratio.powf(-1.0 / smaller.max(1.0)))
        } else {
            (&self.of_larger, 1.0)
        };
        let changes = factor.is_finite() && factor > 0.0 && factor != 1.0;
        let changed = loads.iter().filter(move |_| changes);
        changed.map(move |(source, _)| (*source, factor))
    }
}

/// The sums with a term that is not noticed although it is different from 0.
fn unbalanced_sums(how: Resizing, program: &Program, samples: &[Sample]) -> Vec<Unbalanced> {
    let largest = |value: Value| {
        let sample = &samples[value.index()];
        how.points().map(|point| sample.value(point).abs()).into_iter().fold(0.0, f64::max)
    };
    let sums = program.values().filter_map(|(sum, operation)| {
        let (Operation::Add(a, b) | Operation::Sub(a, b)) = operation else { return None };
        let (larger, smaller) = if largest(a) < largest(b) { (b, a) } else { (a, b) };
        let ratio = largest(smaller) / largest(larger);
        let [sum, term] = [sum, smaller].map(|value| &samples[value.index()]);
        let is_lost = sum.is_trusted
            && how.points().into_iter().all(|point| {
                let rounding = sum.errors[point];
                !term.vanishes_at(point) && term.value(point).abs() <= NOTICED * rounding
            });
        is_lost.then_some(Unbalanced {
            how,
            larger,
            smaller,
            ratio,
            of_larger: vec![],
            of_smaller: vec![],
        })
    });
    sums.collect()
}

/// Whether the size of what is read is for the user to choose. Sines and cosines are of size one.
fn is_free(source: &Source) -> bool {
    !matches!(source, Source::Sin(_) | Source::Cos(_))
}
