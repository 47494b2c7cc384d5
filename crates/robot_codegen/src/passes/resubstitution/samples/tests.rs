use super::*;
use crate::program::Builder;

/// 10⁶ x (1 + 10⁻¹² p) divided by 10⁶ x is not a constant, because the rounding errors of both are far below 10⁻¹².
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
    // The numbers of functions too, because functions are compared as unrelated numbers.
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

/// To first order, the error is that of the operands plus half a unit in the last place of the result.
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
    for (first, second, trusted) in [(&a, &b, true), (&doubted, &b, false), (&b, &doubted, false)] {
        for found in [
            first.plus(second),
            first.minus(second, false),
            first.times(second),
            first.over(second),
        ] {
            assert_eq!(found.is_trusted, trusted);
        }
    }
    // 4e-10 is a billionth of 0.4.
    for (size, trusted) in [(0.41, true), (0.39, false)] {
        let (small, other) = (sample([size; POINTS], rough), sample([-0.1; POINTS], fine));
        assert_eq!(small.plus(&other).is_trusted, trusted, "{size}");
        assert_eq!(other.plus(&small).is_trusted, trusted, "{size}");
        // One such point is enough.
        let mut sizes = [2.0; POINTS];
        sizes[4] = size;
        assert_eq!(sample(sizes, rough).minus(&other, true).is_trusted, trusted, "{size}");
    }
    // A sum of two values that are both within their rounding errors is 0 and is trusted.
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

/// Results may differ by a billionth of themselves or, if they are far below the largest result, by a billionth of a
/// billionth of that result.
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
        // Relative to 10⁶, 10⁻¹² is negligible.
        assert!(agree([1e6, 1e-10 * sign], [1e6, 1e-10 * sign + 0.9e-12]));
        assert!(!agree([1e6, 1e-10 * sign], [1e6, 1e-10 * sign + 1.1e-12]));
    }
}

/// Functions have their own values if results are checked, and are unrelated numbers if values are compared.
#[test]
fn functions_are_checked() {
    let program = |function: Function| {
        let mut b = Builder::new();
        let x = b.load(Source::Input(0));
        let value = b.call(function, x);
        b.finish(vec![value])
    };
    let samples = Samples::unrelated();
    let agree = |a, b| samples.agree(&program(a), &program(b));
    assert!(agree(Function::Tanh, Function::Tanh) && !agree(Function::Tanh, Function::Sin));
    assert!(!agree(Function::Abs, Function::Sign));
    let [a, b] = [Function::Tanh, Function::Sin].map(|function| samples.of(&program(function))[1]);
    assert_eq!(a.equals(&b), Some(false));
}
