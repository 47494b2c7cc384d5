//! Values at sample points.

use robot_symbolic::Function;

use crate::program::{DoubleDouble, Operation, Program, Source, Value};

/// Points that share the values of parameters.
const POINTS_PER_SET: usize = 2;
/// Sets of values of parameters.
const SETS: usize = 3;
/// All points.
const POINTS: usize = SETS * POINTS_PER_SET;

/// The unit of rounding of `f64`.
const UNIT: f64 = f64::EPSILON / 2.0;

/// How far an evaluation may round, in the measure of what it adds up, for agreement to within that
/// rounding to be evidence: beyond it, as after dozens of joints, everything would agree.
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

    /// Samples for angles that nothing relates.
    #[cfg(test)]
    pub(super) fn unrelated() -> Samples {
        let [compared, checked] =
            [Use::Compare, Use::Check].map(|used| Points { used, angles: None });
        Samples { compared, checked }
    }

    /// Samples that lie: at the points that are compared all of `count` angles are one.
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

    /// Whether two programs have the same results at points that were not compared, as far as there are
    /// results: the root of a number below 0 is none.
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

/// What points are for.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    /// To find values that agree. The values of functions are unrelated numbers here: see the first
    /// lines of `resubstitution`.
    Compare,
    /// To check what was made of them.
    Check,
}

/// What loads read at the points: parameters and inputs of either sign and sizes near 1, and the
/// sines and cosines of a function's angles, which may depend on each other.
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

    /// The samples of all values of a program.
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

/// Numbers between 1/2 and 2 of either sign (SplitMix64, Steele, Lea, Flood 2014).
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

/// A value at the points, with bounds of what rounding does to its evaluation in `f64`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    values: [DoubleDouble; POINTS],
    errors: [f64; POINTS],
    /// Whether the bounds are far below what the evaluation adds up, all the way.
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

    /// The difference, or the sum where the sign of the other is changed.
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

    /// Whether the value at a point is all rounding.
    fn vanishes_at(&self, point: usize) -> bool {
        self.value(point).abs() <= self.errors[point]
    }

    /// The value at a point.
    pub(super) fn value(&self, point: usize) -> f64 {
        self.values[point].to_f64()
    }

    /// The largest rounding at any point.
    pub(super) fn rounding(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }

    /// Whether agreement with the value is evidence, and the value finite and, up to rounding, not 0 at
    /// every point.
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

    /// The constant that the value is: where its evaluation rounds least; 0 where rounding is all.
    pub(super) fn mean(&self) -> f64 {
        let errors = self.errors.iter().copied().enumerate();
        let least = errors.min_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(point, _)| point);
        let value = self.value(least);
        if self.vanishes_at(least) { 0.0 } else { value }
    }

    /// Whether the value is another's (`Some(false)`) or its negative (`Some(true)`), to within the
    /// rounding of this value's evaluation.
    pub(super) fn equals(&self, other: &Sample) -> Option<bool> {
        let agree = |sign: f64| {
            (0..POINTS).all(|point| {
                let difference = self.values[point] - other.values[point] * sign.into();
                difference.to_f64().abs() <= self.errors[point]
            })
        };
        if agree(1.0) { Some(false) } else { agree(-1.0).then_some(true) }
    }

    /// The quotient by another value where it is the same within each set of parameters.
    pub(super) fn ratio(&self, other: &Sample) -> Option<Sample> {
        let ratio = self.over(other);
        let first = |point: usize| point / POINTS_PER_SET * POINTS_PER_SET;
        let steady = (0..POINTS).all(|point| {
            // Within the rounding of this value, as the multiple would have it.
            let expected = ratio.values[first(point)] * other.values[point];
            (self.values[point] - expected).to_f64().abs() <= self.errors[point]
        });
        let errors = self.relative_errors(other);
        steady.then_some(Sample { errors, ..ratio })
    }

    /// How far off a factor of another value may be before this value leaves its own rounding.
    fn relative_errors(&self, other: &Sample) -> [f64; POINTS] {
        std::array::from_fn(|point| self.errors[point] / other.value(point).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Builder;

    /// 10⁶ x (1 + 10⁻¹² p) by 10⁶ x: no constant, for rounding is far below 10⁻¹² of either.
    #[test]
    fn the_ratio_of_large_values_is_as_exact_as_that_of_small_ones() {
        let is_constant = |difference: f64| {
            let mut b = Builder::new();
            let (x, p) = (b.load(Source::Input(0)), b.load(Source::Parameter(0)));
            let [million, one, small] = [1e6, 1.0, difference].map(|value| b.constant(value));
            let large = b.mul(million, x);
            let part = b.mul(small, p);
            let factor = b.add(one, part);
            let other = b.mul(large, factor);
            let program = b.finish(vec![large, other]);
            let samples = Samples::unrelated().of(&program);
            let [large, other] = [large, other].map(|value| &samples[value.index()]);
            other.ratio(large).unwrap().is_constant()
        };
        assert!(is_constant(1e-18) && !is_constant(1e-12));
    }

    #[test]
    fn unrelated_numbers_are_of_size_one_and_of_either_sign() {
        let numbers = (0..100).flat_map(|index| unrelated_numbers(1, index, false));
        let numbers: Vec<f64> = numbers.map(DoubleDouble::to_f64).collect();
        assert!(numbers.iter().all(|number| (0.5..2.0).contains(&number.abs())), "{numbers:?}");
        let positive = numbers.iter().filter(|number| **number > 0.0).count();
        assert!((100..numbers.len() - 100).contains(&positive), "{positive}");
    }

    /// The first numbers of SplitMix64 from 0, as its authors publish them.
    #[test]
    fn unrelated_numbers_are_those_of_the_generator() {
        let published: [u64; 5] = [
            0xe220_a839_7b1d_cdaf,
            0x6e78_9e6a_a1b9_65f4,
            0x06c4_5d18_8009_454f,
            0xf88b_b8a8_724c_81ec,
            0x1b39_896a_51a8_749b,
        ];
        let numbers = unrelated_numbers(0, 0, false).map(DoubleDouble::to_f64);
        for (bits, number) in published.into_iter().zip(numbers) {
            let size = 0.5 + 1.5 * ((bits >> 11) as f64 / 2f64.powi(53));
            assert_eq!(number, if bits % 2 == 0 { size } else { -size });
        }
    }

    #[test]
    fn no_two_loads_read_the_same_numbers() {
        let sources = (0..200).flat_map(|index| {
            [Source::Parameter, Source::Field, Source::Input, Source::Sin, Source::Cos]
                .map(|source| source(index))
        });
        let samples = Samples::unrelated();
        let mut numbers: Vec<u64> = vec![];
        for (source, points) in
            sources.flat_map(|source| [(source, &samples.compared), (source, &samples.checked)])
        {
            let read = points.load(source).map(|number| number.to_f64().to_bits());
            let shared = matches!(source, Source::Parameter(_) | Source::Field(_));
            for pair in read.chunks(2) {
                assert_eq!(pair[0] == pair[1], shared, "{source:?}");
            }
            let step = if shared { POINTS_PER_SET } else { 1 };
            numbers.extend(read.iter().step_by(step));
        }
        // Of functions too; they are compared as unrelated numbers.
        for index in 0..200 {
            numbers.extend(samples.compared.numbers(3, index, false).map(|x| x.to_f64().to_bits()));
        }
        let all = numbers.len();
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!((numbers.len(), POINTS), (all, 6));
    }

    fn sample(values: [f64; POINTS], errors: [f64; POINTS]) -> Sample {
        Sample { values: values.map(Into::into), errors, is_trusted: true }
    }

    /// To first order: what the operands bring, and half a unit in the last place of the result.
    #[test]
    fn rounding_grows_as_the_operations_say() {
        let (x, y) = ([0.5, -0.75, 1.25, 2.0, -3.0, 0.625], [1.5, 0.25, -0.5, 4.0, -1.0, 0.125]);
        let (dx, dy) =
            ([3e-16, 1e-15, 2e-16, 0.0, 5e-15, 1e-16], [1e-16, 4e-16, 0.0, 2e-15, 7e-16, 3e-16]);
        let (a, b) = (sample(x, dx), sample(y, dy));
        let check =
            |found: Sample, value: fn(f64, f64) -> f64, error: fn(f64, f64, f64, f64) -> f64| {
                for point in 0..POINTS {
                    let (x, y, dx, dy) = (x[point], y[point], dx[point], dy[point]);
                    let expected = error(x, y, dx, dy) + value(x, y).abs() * 2f64.powi(-53);
                    assert!((found.value(point) - value(x, y)).abs() <= 1e-15 * value(x, y).abs());
                    assert!((found.errors[point] - expected).abs() <= 1e-12 * expected, "{point}");
                }
                assert_eq!(found.rounding(), found.errors.into_iter().reduce(f64::max).unwrap());
            };
        check(a.plus(&b), |x, y| x + y, |_, _, dx, dy| dx + dy);
        check(a.minus(&b, false), |x, y| x - y, |_, _, dx, dy| dx + dy);
        check(a.minus(&b, true), |x, y| x + y, |_, _, dx, dy| dx + dy);
        check(a.times(&b), |x, y| x * y, |x, y, dx, dy| dx * y.abs() + dy * x.abs());
        check(a.over(&b), |x, y| x / y, |x, y, dx, dy| dx / y.abs() + dy * x.abs() / (y * y));
        let relative = a.relative_errors(&b);
        for point in 0..POINTS {
            assert_eq!(relative[point], dx[point] / y[point].abs());
        }
    }

    #[test]
    fn trust_is_inherited_and_lost_where_little_is_left_of_much_rounding() {
        let (one, fine, rough) = ([1.0; POINTS], [1e-16; POINTS], [4e-10; POINTS]);
        let (a, b) = (sample(one, fine), sample(one.map(|x| 2.0 * x), rough));
        let doubted = Sample { is_trusted: false, ..a };
        for (first, second, trusted) in
            [(&a, &b, true), (&doubted, &b, false), (&b, &doubted, false)]
        {
            for found in [
                first.plus(second),
                first.minus(second, false),
                first.times(second),
                first.over(second),
            ] {
                assert_eq!(found.is_trusted, trusted);
            }
        }
        // 4e-10 is a part in a billion of 0.4.
        for (size, trusted) in [(0.41, true), (0.39, false)] {
            let (small, other) = (sample([size; POINTS], rough), sample([-0.1; POINTS], fine));
            assert_eq!(small.plus(&other).is_trusted, trusted, "{size}");
            assert_eq!(other.plus(&small).is_trusted, trusted, "{size}");
            // At one point it is enough.
            let mut sizes = [2.0; POINTS];
            sizes[4] = size;
            assert_eq!(sample(sizes, rough).minus(&other, true).is_trusted, trusted, "{size}");
        }
        // What is all rounding on both sides is 0, and not in doubt.
        let nothing = sample([1e-10; POINTS], rough);
        assert!(nothing.plus(&nothing).is_trusted && nothing.vanishes_at(0));
        assert!(!nothing.plus(&sample([0.3; POINTS], rough)).is_trusted);
        assert!(sample([-4e-10; POINTS], rough).vanishes_at(3));
        assert!(!sample([-4.1e-10; POINTS], rough).vanishes_at(3));
    }

    #[test]
    fn values_are_compared_to_within_their_own_rounding() {
        let values = [0.5, -0.75, 1.25, 2.0, -3.0, 0.625];
        let (a, rough) = (sample(values, [1e-12; POINTS]), sample(values, [1e-9; POINTS]));
        let moved = |by: f64, at: usize| {
            let mut moved = values;
            moved[at] += by;
            sample(moved, [0.0; POINTS])
        };
        let negative = sample(values.map(|x| -x), [0.0; POINTS]);
        for at in 0..POINTS {
            for sign in [1.0, -1.0] {
                assert_eq!(a.equals(&moved(0.9e-12 * sign, at)), Some(false));
                assert_eq!(a.equals(&moved(1.1e-12 * sign, at)), None);
                assert_eq!(rough.equals(&moved(1.1e-12 * sign, at)), Some(false));
            }
        }
        assert_eq!((a.equals(&negative), negative.equals(&negative)), (Some(true), Some(false)));

        // 3 times in one set of parameters, −2 times in the next, 5 times in the last.
        let factors = [3.0, 3.0, -2.0, -2.0, 5.0, 5.0];
        let product =
            sample(std::array::from_fn(|point| factors[point] * values[point]), [1e-12; POINTS]);
        let other = sample(values, [0.0; POINTS]);
        let ratio = product.ratio(&other).unwrap();
        for point in 0..POINTS {
            assert!((ratio.value(point) - factors[point]).abs() < 1e-15);
            assert_eq!(ratio.errors[point], 1e-12 / values[point].abs());
            let mut values = product.values.map(DoubleDouble::to_f64);
            values[point] += 2e-11;
            assert!(sample(values, [1e-12; POINTS]).ratio(&other).is_none(), "{point}");
        }
        assert!(!ratio.is_constant());
    }

    #[test]
    fn what_is_regular_and_what_is_constant() {
        let regular = |value: f64, error: f64| {
            let (mut values, mut errors) = ([1.0; POINTS], [0.0; POINTS]);
            (values[5], errors[5]) = (value, error);
            sample(values, errors).is_regular()
        };
        assert!(regular(-1e-3, 0.9e-6) && regular(1e-3, 0.9e-6) && regular(1e300, 1e-9));
        assert!(!regular(1e-3, 1.1e-6) && !regular(0.0, 0.0) && !regular(f64::INFINITY, 0.0));
        let constant = |difference: f64, first: f64, last: f64| {
            let (mut values, mut errors) = ([3.0; POINTS], [1.0; POINTS]);
            (values[5], errors[0], errors[5]) = (3.0 + difference, first, last);
            let sample = sample(values, errors);
            assert!(!Sample { is_trusted: false, ..sample }.is_constant());
            (sample.is_constant(), sample.mean())
        };
        assert_eq!(constant(0.25, 0.5, 0.375), (true, 3.25));
        assert_eq!(constant(-0.25, 0.375, 0.5), (true, 3.0));
        assert!(!constant(0.25, 0.5, 0.125).0 && !constant(-0.25, 0.125, 0.5).0);
        assert_eq!(sample([1e-9; POINTS], [1e-8; POINTS]).mean(), 0.0);
    }

    /// Results may differ by a part in a billion of themselves, or, far below the largest result, by a part
    /// in a billion of a billionth of that.
    #[test]
    fn results_agree_to_a_part_in_a_billion() {
        let program = |factors: [f64; 2]| {
            let mut b = Builder::new();
            let x = b.load(Source::Input(0));
            let results = factors.map(|factor| {
                let constant = b.constant(factor);
                b.mul(constant, x)
            });
            b.finish(results.to_vec())
        };
        let agree = |before: [f64; 2], after: [f64; 2]| {
            Samples::unrelated().agree(&program(before), &program(after))
        };
        for sign in [1.0, -1.0] {
            assert!(agree([3.0 * sign, 7.0], [3.0 * sign + 2.7e-9, 7.0 - 6.3e-9]));
            assert!(!agree([3.0 * sign, 7.0], [3.0 * sign, 7.0 - 7.7e-9]));
            assert!(!agree([3.0 * sign, 7.0], [3.0 * sign - 3.3e-9, 7.0]));
            // Beside 10⁶, 10⁻¹² of 10⁻³ is nothing.
            assert!(agree([1e6, 1e-10 * sign], [1e6, 1e-10 * sign + 0.9e-12]));
            assert!(!agree([1e6, 1e-10 * sign], [1e6, 1e-10 * sign + 1.1e-12]));
        }
    }
}
