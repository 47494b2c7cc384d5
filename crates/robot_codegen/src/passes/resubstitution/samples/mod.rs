//! Values at sample points.

use robot_symbolic::Function;

use super::parts::{self, Parts};
use crate::program::{DoubleDouble, Operation, Program, Source, Value};

/// The number of points that have the same values of parameters.
const POINTS_PER_SET: usize = 2;
/// The number of sets of values of the parameters.
const SETS: usize = 3;
/// The number of all points.
const POINTS: usize = SETS * POINTS_PER_SET;

/// The unit of rounding of `f64`.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// The largest rounding error of an evaluation, relative to the terms that it adds, for which agreement to within that
/// error is evidence. Beyond it, for example after dozens of joints, all values would agree.
const TRUST: f64 = 1e-9;

/// The points at which values are compared, and others at which the result is checked.
pub(crate) struct Samples {
    compared: Points,
    checked: Points,
}

impl Samples {
    /// The samples for a function with these angles.
    pub(crate) fn new(angles: &Program) -> Samples {
        Samples {
            compared: Points::new(Use::Compare, angles),
            checked: Points::new(Use::Check, angles),
        }
    }

    /// Samples for unrelated angles.
    #[cfg(test)]
    pub(super) fn unrelated() -> Samples {
        let [compared, checked] =
            [Use::Compare, Use::Check].map(|used| Points { used, angles: None });
        Samples { compared, checked }
    }

    /// Misleading samples: at the points of comparison, all `count` angles are equal.
    #[cfg(test)]
    pub(super) fn of_equal_angles(count: usize) -> Samples {
        let Samples { compared, checked } = Samples::unrelated();
        let angles = Some(vec![compared.angle(0); count]);
        Samples { compared: Points { angles, ..compared }, checked }
    }

    /// The samples of all values of a program, for comparison.
    pub(super) fn of(&self, program: &Program) -> Vec<Sample> {
        self.compared.of(program)
    }

    /// The parts of all values of a program.
    pub(super) fn parts(&self, program: &Program) -> Parts {
        Parts::of(program, |value, operation| {
            let numbers = match operation {
                Operation::Load(source) => self.compared.load(source),
                _ => self.compared.numbers(3, value.0, false),
            };
            std::array::from_fn::<f64, { parts::POINTS }, _>(|point| numbers[point].to_f64())
        })
    }

    /// Whether two programs have the same results at points that were not used for the comparison, as far as the
    /// results exist: the root of a negative number does not.
    pub(super) fn agree(&self, before: &Program, after: &Program) -> bool {
        let results = |program: &Program| -> Vec<Sample> {
            let samples = self.checked.of(program);
            program.results().iter().map(|value| samples[value.index()]).collect()
        };
        let (before, after) = (results(before), results(after));
        (0..POINTS).all(|point| {
            let sizes = before.iter().map(|sample| sample.value(point).abs());
            let largest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
            before.iter().zip(&after).all(|(before, after)| {
                let size = before.value(point).abs();
                let difference = (after.values[point] - before.values[point]).to_f64().abs();
                !size.is_finite() || difference <= TRUST * size.max(TRUST * largest)
            })
        })
    }
}

/// The purpose of points.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    /// To find values that agree. The values of functions are then unrelated numbers; see the module documentation of
    /// `resubstitution`.
    Compare,
    /// To check the replacements.
    Check,
}

/// The values that loads read at the points: parameters and inputs of either sign and of a size near 1, and the sines
/// and cosines of a function's angles, which can depend on each other.
struct Points {
    used: Use,
    angles: Option<Vec<[DoubleDouble; POINTS]>>,
}

impl Points {
    fn new(used: Use, angles: &Program) -> Points {
        let samples = Points { used, angles: None }.of(angles);
        let results = angles.results().iter();
        let angles = results.map(|value| samples[value.index()].values).collect();
        Points { used, angles: Some(angles) }
    }

    /// Computes the samples of all values of a program.
    fn of(&self, program: &Program) -> Vec<Sample> {
        let mut samples: Vec<Sample> = Vec::with_capacity(program.operations().len());
        for (value, operation) in program.values() {
            let at = |operand: Value| &samples[operand.index()];
            let sample = match operation {
                Operation::Constant(constant) => Sample::exact([constant.get().into(); POINTS]),
                Operation::Load(source) => Sample::exact(self.load(source)),
                Operation::Add(a, b) => at(a).plus(at(b)),
                Operation::Sub(a, b) => at(a).minus(at(b), false),
                Operation::Mul(a, b) => at(a).times(at(b)),
                Operation::Div(a, b) => at(a).over(at(b)),
                Operation::Neg(a) => Sample { values: at(a).values.map(|x| -x), ..*at(a) },
                Operation::MulAdd(a, b, c) => at(a).times(at(b)).plus(at(c)),
                Operation::Call(Function::RecipPositive, a) => {
                    Sample::exact([1.0.into(); POINTS]).over(at(a))
                }
                Operation::Call(function, a) if self.used == Use::Check => {
                    Sample::exact(at(a).values.map(|x| x.apply(function)))
                }
                Operation::Call(..) => Sample::exact(self.numbers(3, value.0, false)),
            };
            samples.push(sample);
        }
        samples
    }

    fn load(&self, source: Source) -> [DoubleDouble; POINTS] {
        match source {
            Source::Parameter(index) => self.numbers(0, index, true),
            Source::Field(index) => self.numbers(1, index, true),
            Source::Input(index) => self.numbers(2, index, false),
            Source::Sin(index) => self.angle(index).map(|angle| angle.apply(Function::Sin)),
            Source::Cos(index) => self.angle(index).map(|angle| angle.apply(Function::Cos)),
        }
    }

    fn angle(&self, index: u32) -> [DoubleDouble; POINTS] {
        let known = self.angles.as_ref().and_then(|angles| angles.get(index as usize));
        known.copied().unwrap_or_else(|| self.numbers(4, index, false))
    }

    fn numbers(&self, kind: u64, index: u32, same_in_set: bool) -> [DoubleDouble; POINTS] {
        let kind = if self.used == Use::Check { kind + 8 } else { kind };
        unrelated_numbers(kind, index, same_in_set)
    }
}

/// Returns numbers of either sign with sizes between 1/2 and 2 (SplitMix64; Steele, Lea, Flood 2014).
fn unrelated_numbers(kind: u64, index: u32, same_in_set: bool) -> [DoubleDouble; POINTS] {
    std::array::from_fn(|point| {
        let point = if same_in_set { point / POINTS_PER_SET } else { point };
        let seed = (kind << 40) + (u64::from(index) << 4) + point as u64 + 1;
        let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let size = (z >> 11) as f64 / (1_u64 << 53) as f64 * 1.5 + 0.5;
        (if z & 1 == 0 { size } else { -size }).into()
    })
}

/// A value at each sample point, in double-double arithmetic, with bounds on the rounding errors that an evaluation in
/// `f64` would have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    values: [DoubleDouble; POINTS],
    errors: [f64; POINTS],
    /// Whether the bounds are far below the terms of the evaluation at every step.
    is_trusted: bool,
}

impl Sample {
    fn exact(values: [DoubleDouble; POINTS]) -> Sample {
        Sample { values, errors: [0.0; POINTS], is_trusted: true }
    }

    fn new(value: impl Fn(usize) -> DoubleDouble, inherited: impl Fn(usize) -> f64) -> Sample {
        let values: [DoubleDouble; POINTS] = std::array::from_fn(value);
        let error = |point: usize| inherited(point) + UNIT * values[point].to_f64().abs();
        Sample { values, errors: std::array::from_fn(error), is_trusted: true }
    }

    fn plus(&self, other: &Sample) -> Sample {
        let sum = Sample::new(
            |point| self.values[point] + other.values[point],
            |point| self.errors[point] + other.errors[point],
        );
        sum.trusted_as_sum_of(self, other)
    }

    /// Returns the difference of two samples, or their sum if `negative` is set.
    pub(super) fn minus(&self, other: &Sample, negative: bool) -> Sample {
        let sign = if negative { -1.0 } else { 1.0 };
        let difference = Sample::new(
            |point| self.values[point] - other.values[point] * sign.into(),
            |point| self.errors[point] + other.errors[point],
        );
        difference.trusted_as_sum_of(self, other)
    }

    fn trusted_as_sum_of(self, a: &Sample, b: &Sample) -> Sample {
        let is_small = |point: usize| {
            let size = a.value(point).abs().max(b.value(point).abs());
            let nothing = a.vanishes_at(point) && b.vanishes_at(point);
            nothing || self.errors[point] <= TRUST * size
        };
        self.trusted_as_product_of(a, b, (0..POINTS).all(is_small))
    }

    fn trusted_as_product_of(self, a: &Sample, b: &Sample, is_small: bool) -> Sample {
        Sample { is_trusted: a.is_trusted && b.is_trusted && is_small, ..self }
    }

    fn times(&self, other: &Sample) -> Sample {
        let product = Sample::new(
            |point| self.values[point] * other.values[point],
            |point| {
                self.errors[point] * other.value(point).abs()
                    + self.value(point).abs() * other.errors[point]
            },
        );
        product.trusted_as_product_of(self, other, true)
    }

    pub(super) fn over(&self, other: &Sample) -> Sample {
        let quotient = Sample::new(
            |point| self.values[point] / other.values[point],
            |point| {
                let quotient = (self.value(point) / other.value(point)).abs();
                (self.errors[point] + quotient * other.errors[point]) / other.value(point).abs()
            },
        );
        quotient.trusted_as_product_of(self, other, true)
    }

    /// Whether the value at a point is not larger than its rounding error.
    fn vanishes_at(&self, point: usize) -> bool {
        self.value(point).abs() <= self.errors[point]
    }

    /// The value at a point.
    pub(super) fn value(&self, point: usize) -> f64 {
        self.values[point].to_f64()
    }

    /// The largest bound on the rounding error at any point.
    pub(super) fn rounding(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }

    /// Whether agreement with the value is evidence, and the value is finite and, up to rounding, different from 0
    /// at every point.
    pub(super) fn is_regular(&self) -> bool {
        self.is_trusted
            && (0..POINTS).all(|point| {
                let size = self.value(point).abs();
                size.is_finite() && size > 1e3 * self.errors[point]
            })
    }

    /// Whether the value is, up to rounding, the same at all points.
    pub(super) fn is_constant(&self) -> bool {
        self.is_trusted
            && (1..POINTS).all(|point| {
                let difference = (self.values[point] - self.values[0]).to_f64().abs();
                difference <= self.errors[point].min(self.errors[0])
            })
    }

    /// The value at the point where its evaluation rounds least, or 0 if it is not larger than its rounding error
    /// there.
    pub(super) fn mean(&self) -> f64 {
        let errors = self.errors.iter().copied().enumerate();
        let least = errors.min_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(point, _)| point);
        let value = self.value(least);
        if self.vanishes_at(least) { 0.0 } else { value }
    }

    /// Returns `Some(false)` if the value equals another and `Some(true)` if it equals its negative, to within the
    /// rounding error of this value's evaluation.
    pub(super) fn equals(&self, other: &Sample) -> Option<bool> {
        let agree = |sign: f64| {
            (0..POINTS).all(|point| {
                let difference = self.values[point] - other.values[point] * sign.into();
                difference.to_f64().abs() <= self.errors[point]
            })
        };
        if agree(1.0) { Some(false) } else { agree(-1.0).then_some(true) }
    }

    /// Returns this value divided by another, or `None` if the quotient varies within a set of parameters.
    pub(super) fn ratio(&self, other: &Sample) -> Option<Sample> {
        let ratio = self.over(other);
        let first = |point: usize| point / POINTS_PER_SET * POINTS_PER_SET;
        let steady = (0..POINTS).all(|point| {
            // The multiple must agree with this value to within the value's rounding error.
            let expected = ratio.values[first(point)] * other.values[point];
            (self.values[point] - expected).to_f64().abs() <= self.errors[point]
        });
        let errors = self.relative_errors(other);
        steady.then_some(Sample { errors, ..ratio })
    }

    /// The largest errors of a factor for which its product with another value stays within this value's rounding
    /// error.
    fn relative_errors(&self, other: &Sample) -> [f64; POINTS] {
        std::array::from_fn(|point| self.errors[point] / other.value(point).abs())
    }
}

#[cfg(test)]
mod tests;
