//! The single-precision functions, compared with those of double precision, which are exact in comparison.
#![expect(clippy::duplicate_mod, reason = "the functions with either rounding")]
#![allow(clippy::incompatible_msrv, reason = "the Rust of the project runs the tests")]

use robot_runtime::trig::single::LIMIT;
use robot_runtime::{FUSED, Scalar, root::software_sqrt_f32, sin_cos_array};

mod digest;
mod rounding;

/// The functions with multiply-adds that round once or twice, and their errors.
struct Rounding {
    sin_cos: fn(f32) -> (f32, f32),
    fused: bool,
    /// The worst absolute error over the samples below.
    absolute: f64,
    /// The worst error in last places for |x| ≤ π/4.
    last_places: f64,
}
const ROUNDINGS: [Rounding; 2] = [
    Rounding {
        sin_cos: rounding::once::trig::single::sin_cos,
        fused: true,
        absolute: 6.67e-8,
        last_places: 0.781,
    },
    Rounding {
        sin_cos: rounding::twice::trig::single::sin_cos,
        fused: false,
        absolute: 8.13e-8,
        last_places: 1.015,
    },
];

/// The worst absolute error at `angles` and at their negatives.
fn worst_error(rounding: &Rounding, angles: impl Iterator<Item = f32>) -> f64 {
    let mut worst = 0f64;
    for x in angles.flat_map(|x| [x, -x]) {
        let (sine, cosine) = (rounding.sin_cos)(x);
        assert!(sine.abs() <= 1.0 && cosine.abs() <= 1.0, "{sine} and {cosine} at {x:e}");
        let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
        worst = worst.max((f64::from(sine) - exact_sine).abs());
        worst = worst.max((f64::from(cosine) - exact_cosine).abs());
    }
    println!("fused {}: worst error {worst:e}", rounding.fused);
    worst
}

/// Every `step`-th number from 0 to `limit`.
fn numbers(limit: f32, step: usize) -> impl Iterator<Item = f32> {
    (0..=limit.to_bits()).step_by(step).map(f32::from_bits)
}

fn last_places(error: f64, exact: f64) -> f64 {
    let rounded = exact.abs() as f32;
    error.abs() / f64::from(rounded.next_up() - rounded)
}

/// The functions of this build are those for its [`FUSED`].
#[test]
fn sin_cos_is_one_of_the_two() {
    let built = ROUNDINGS.iter().find(|rounding| rounding.fused == FUSED).unwrap();
    for x in numbers(LIMIT, 9973) {
        assert_eq!(Scalar::sin_cos(x), (built.sin_cos)(x));
    }
}

#[test]
fn sin_cos_is_accurate_over_the_stated_range() {
    for rounding in ROUNDINGS {
        let angles = numbers(LIMIT.next_down(), 997);
        assert!(worst_error(&rounding, angles) <= rounding.absolute);
    }
}

#[test]
fn sin_cos_is_accurate_next_to_every_multiple_of_a_right_angle() {
    for rounding in ROUNDINGS {
        let angles = (0..=83_442).flat_map(|k| {
            let multiple = (f64::from(k) * std::f64::consts::FRAC_PI_2) as f32;
            [multiple.next_down(), multiple, multiple.next_up()]
        });
        assert!(worst_error(&rounding, angles) <= 2.981e-8);
    }
}

#[test]
fn sin_cos_of_an_acute_half_angle_is_accurate_in_last_places() {
    for rounding in ROUNDINGS {
        let mut worst = 0f64;
        for x in numbers(std::f32::consts::FRAC_PI_4, 997) {
            let (sine, cosine) = (rounding.sin_cos)(x);
            let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
            worst = worst.max(last_places(f64::from(sine) - exact_sine, exact_sine));
            worst = worst.max(last_places(f64::from(cosine) - exact_cosine, exact_cosine));
        }
        println!("fused {}: worst error {worst} last places", rounding.fused);
        assert!(worst <= rounding.last_places);
    }
}

#[test]
fn sin_cos_beyond_the_range_is_no_number() {
    let beyond = (LIMIT.to_bits()..=f32::NAN.to_bits()).step_by(997).map(f32::from_bits);
    let stated = [LIMIT, LIMIT.next_up(), 4194304.0, 8e9, 1e30, f32::MAX, f32::INFINITY, f32::NAN];
    for x in beyond.chain(stated).flat_map(|x| [x, -x]) {
        for rounding in ROUNDINGS {
            let (sine, cosine) = (rounding.sin_cos)(x);
            assert!(sine.is_nan() && cosine.is_nan(), "{sine} and {cosine} at {x:e}");
        }
    }
}

/// Compares to the last bit, so that no constant changes by accident.
#[test]
fn sin_cos_has_the_bits_that_it_had() {
    for (rounding, expected) in ROUNDINGS.iter().zip([0x9a3b_658a_37f3_07a5, 0xa51d_1b07_47ca_c00d])
    {
        let digest = numbers(LIMIT, 997).skip(700_000).fold(digest::EMPTY, |digest, x| {
            let (sine, cosine) = (rounding.sin_cos)(x);
            digest::with(digest::with(digest, sine.to_bits().into()), cosine.to_bits().into())
        });
        assert_eq!(digest, expected, "{digest:#x}, fused {}", rounding.fused);
    }
}

/// Compares the constants, because the last digit of some changes only few bits.
#[test]
fn constants_are_those_of_the_fit() {
    let source = include_str!("../src/runtime/trig/single.rs");
    let bits: Vec<u64> = digest::numbers(source, "const SINE")
        .chain(digest::numbers(source, "const COSINE"))
        .chain(digest::numbers(source, "const HALF_PI"))
        .chain(digest::numbers(source, "const SHORT_HALF_PI"))
        .map(|number| number.parse::<f32>().unwrap().to_bits().into())
        .collect();
    assert_eq!(bits.len(), 13);
    assert_eq!(bits.iter().copied().fold(digest::EMPTY, digest::with), 0xdaf2_0401_74eb_60cc);
}

#[test]
fn an_array_has_the_values_of_its_angles() {
    fn check<const N: usize>() {
        let angles: [f32; N] = std::array::from_fn(|i| 0.7 * i as f32 - 5.0);
        let (sines, cosines) = sin_cos_array(&angles);
        for ((angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
            assert_eq!((sine, cosine), Scalar::sin_cos(*angle), "{N} angles");
        }
    }
    check::<0>();
    check::<1>();
    check::<6>();
    check::<8>();
    check::<15>();
    check::<16>();
    check::<17>();
    check::<39>();
}

#[test]
fn tanh_is_accurate_everywhere() {
    let mut worst = 0f64;
    for x in numbers(30.0, 997).skip(1) {
        let exact = f64::tanh(f64::from(x));
        worst = worst.max(last_places(f64::from(Scalar::tanh(x)) - exact, exact));
        assert_eq!(Scalar::tanh(-x), -Scalar::tanh(x));
    }
    println!("worst error {worst} last places");
    assert!(worst < 3.0);
    for x in [10.0, 1e3, f32::MAX, f32::INFINITY] {
        assert_eq!((Scalar::tanh(x), Scalar::tanh(-x)), (1.0, -1.0));
    }
    assert!(Scalar::tanh(f32::NAN).is_nan());
}

#[test]
fn software_square_root_has_the_bits_of_the_processors() {
    for x in numbers(f32::INFINITY, 997) {
        assert_eq!(software_sqrt_f32(x).to_bits(), x.sqrt().to_bits(), "{x:e}");
    }
    for x in [0.0, -0.0, f32::from_bits(1), f32::MIN_POSITIVE, f32::MAX, f32::INFINITY] {
        assert_eq!(software_sqrt_f32(x).to_bits(), x.sqrt().to_bits(), "{x:e}");
    }
    for x in [-1e-40, -1.0, f32::NEG_INFINITY, f32::NAN, -f32::NAN] {
        assert!(software_sqrt_f32(x).is_nan());
    }
}
