//! The double-precision functions, compared with values exact to about 30 digits.
#![expect(clippy::duplicate_mod, reason = "the functions with either rounding")]
#![allow(clippy::incompatible_msrv, reason = "the Rust of the project runs the tests")]

use std::f64::consts::FRAC_PI_2;

use robot_runtime::trig::double::LIMIT;
use robot_runtime::{FUSED, Scalar, sin_cos_array, trig};

mod digest;
mod exact;
mod multiples;
mod random;
mod rounding;

/// The functions with multiply-adds that round once or twice, and their errors.
struct Rounding {
    sin_cos: fn(f64) -> (f64, f64),
    fused: bool,
    /// The worst absolute error over the samples below.
    absolute: f64,
    /// The angle up to which last places are also accurate close to multiples of π/2.
    last_places_to: f64,
}
const ROUNDINGS: [Rounding; 2] = [
    Rounding {
        sin_cos: rounding::once::trig::double::sin_cos,
        fused: true,
        absolute: 1.275e-16,
        last_places_to: LIMIT,
    },
    Rounding {
        sin_cos: rounding::twice::trig::double::sin_cos,
        fused: false,
        absolute: 1.553e-16,
        last_places_to: 2e5,
    },
];

/// The worst error in last places over the samples below.
const LAST_PLACES: f64 = 1.495;

/// Values of functions that were computed with 500 bits: x, then each value as a sum of two doubles.
type Sum = (f64, f64);
const KNOWN_SIN_COS: [(f64, Sum, Sum); 7] = [
    (
        0.7,
        (0.644217687237691, 2.8740567927338755e-18),
        (0.7648421872844885, -4.013780434022238e-17),
    ),
    (
        1.0,
        (0.8414709848078965, 1.776845092935536e-18),
        (0.5403023058681398, -4.760954612604417e-17),
    ),
    (
        22.0,
        (-0.008851309290403876, 2.8485303089220057e-19),
        (-0.9999608263946371, -8.51603380017413e-19),
    ),
    (
        -355.0,
        (3.014435335948845e-05, -1.3012643991046347e-21),
        (-0.999999999545659, 1.0574612846643521e-17),
    ),
    (
        100000.0,
        (0.03574879797201651, 1.5429743706109861e-18),
        (-0.9993608074382124, -2.3447088905187402e-17),
    ),
    (FRAC_PI_2, (1.0, -1.874699728327322e-33), (6.123233995736766e-17, -1.4973848991e-33)),
    (1e-9, (1e-9, -1.6666666666666669e-28), (1.0, -5e-19)),
];
const KNOWN_TANH: [(f64, Sum); 6] = [
    (1e-8, (1e-8, -3.3333333333333335e-25)),
    (0.1, (0.09966799462495582, 3.542433877641546e-18)),
    (0.34657359027997264, (0.3333333333333333, 8.196842348880167e-18)),
    (1.0, (0.7615941559557649, 3.7090214482164924e-17)),
    (5.5, (0.9999665971563038, 4.933089545428797e-17)),
    (18.7, (0.9999999999999999, -3.3751550837457984e-18)),
];

#[test]
fn reference_agrees_with_known_values() {
    let close = |value: exact::Exact, (high, low): Sum| {
        let error = (value.high - high) + (value.low - low);
        assert!(error.abs() < 1e-28, "{value:?} is not {high:?} + {low:?}");
    };
    for (x, sine, cosine) in KNOWN_SIN_COS {
        close(exact::sin_cos(x).0, sine);
        close(exact::sin_cos(x).1, cosine);
    }
    for (x, value) in KNOWN_TANH {
        close(exact::tanh(x), value);
    }
}

/// The error of a value, in last places of the exact value.
fn last_places(error: f64, exact: f64) -> f64 {
    let ulp = exact.abs().next_up() - exact.abs();
    error.abs() / ulp
}

/// The worst absolute error, and the worst error in last places, of sine and cosine.
#[derive(Default, Debug)]
struct Worst {
    absolute: f64,
    last_places: f64,
}

impl Worst {
    fn update(&mut self, sin_cos: fn(f64) -> (f64, f64), x: f64) {
        let (sine, cosine) = sin_cos(x);
        let (exact_sine, exact_cosine) = exact::sin_cos(x);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            assert!(value.abs() <= 1.0, "{value} at {x:e}");
            let error = exact.error_of(value);
            assert!(!error.is_nan(), "{value} at {x:e}");
            self.absolute = self.absolute.max(error.abs());
            self.last_places = self.last_places.max(last_places(error, exact.high));
        }
    }
}

/// The functions of this build are those for its [`FUSED`].
#[test]
fn sin_cos_is_one_of_the_two() {
    let built = ROUNDINGS.iter().find(|rounding| rounding.fused == FUSED).unwrap();
    let mut random = random::uniform(5);
    let portable = rounding::twice::trig::double::sin_cos;
    for _ in 0..10_000 {
        let x = 2f64.powf(31.0 * random());
        let (sine, cosine) = trig::double::portable_sin_cos(x);
        let (other_sine, other_cosine) = portable(x);
        assert_eq!([sine, cosine].map(f64::to_bits), [other_sine, other_cosine].map(f64::to_bits));
        let (sine, cosine) = Scalar::sin_cos(x);
        let (other_sine, other_cosine) = (built.sin_cos)(x);
        assert_eq!([sine, cosine].map(f64::to_bits), [other_sine, other_cosine].map(f64::to_bits));
    }
}

#[test]
fn sin_cos_is_accurate_over_the_stated_range() {
    for rounding in ROUNDINGS {
        let mut random = random::uniform(1);
        let (mut near, mut far) = (Worst::default(), Worst::default());
        for limit in [1e-3, 0.8, 4.0, 100.0, 1e5, 1e7, LIMIT] {
            for _ in 0..60_000 {
                let x = limit * (2.0 * random() - 1.0);
                let worst = if x.abs() < rounding.last_places_to { &mut near } else { &mut far };
                worst.update(rounding.sin_cos, x);
            }
        }
        for _ in 0..60_000 {
            near.update(rounding.sin_cos, rounding.last_places_to.powf(2.0 * random() - 1.0));
        }
        println!("fused {}: near {near:?}, far {far:?}", rounding.fused);
        assert!(near.absolute <= rounding.absolute && far.absolute <= rounding.absolute);
        assert!(near.last_places <= LAST_PLACES);
    }
}

/// Reduction loses the most digits close to multiples of π/2: tests all of these up to 10⁵.
#[test]
fn sin_cos_is_accurate_next_to_every_multiple_of_a_right_angle() {
    for rounding in ROUNDINGS {
        let mut worst = Worst::default();
        for k in 0..=63_661 {
            let multiple = f64::from(k) * FRAC_PI_2;
            let mut x = multiple.next_down();
            for _ in 0..3 {
                worst.update(rounding.sin_cos, x);
                worst.update(rounding.sin_cos, -x);
                x = x.next_up();
            }
        }
        println!("fused {}: {worst:?}", rounding.fused);
        assert!(worst.absolute < 4e-22);
        assert!(worst.last_places < 1.0);
    }
}

/// The angles of every magnitude in the range that are closest to a multiple of π/2.
#[test]
fn sin_cos_is_accurate_at_the_hardest_angles() {
    let angles = multiples::nearest_angles();
    let smallest = angles.iter().map(|x| {
        let (sine, cosine) = exact::sin_cos(*x);
        sine.high.abs().min(cosine.high.abs())
    });
    assert!(smallest.fold(1.0, f64::min) < 1e-18);
    for rounding in ROUNDINGS {
        let (mut near, mut far) = (Worst::default(), Worst::default());
        for x in angles.iter().flat_map(|x| [*x, -*x]) {
            let worst = if x.abs() < rounding.last_places_to { &mut near } else { &mut far };
            worst.update(rounding.sin_cos, x);
        }
        println!("fused {}: near {near:?}, far {far:?}", rounding.fused);
        assert!(near.last_places < 1.0);
        assert!(near.absolute < 1.1e-23 && far.absolute < 4.3e-22);
    }
}

#[test]
fn sin_cos_of_every_magnitude_is_exact_near_zero() {
    for exponent in -1074..-27 {
        let x = 2f64.powi(exponent);
        assert_eq!(Scalar::sin_cos(x), (x, 1.0));
        assert_eq!(Scalar::sin_cos(-x), (-x, 1.0));
    }
    assert_eq!(Scalar::sin_cos(0.0f64).0.to_bits(), 0);
    assert_eq!(Scalar::sin_cos(-0.0f64).0.to_bits(), 0);
}

#[test]
fn sin_cos_beyond_the_range_is_no_number() {
    let mut random = random::uniform(2);
    let beyond = (0..10_000).map(|_| 2f64.powf(30.0 + 994.0 * random()).min(f64::MAX));
    let stated = [LIMIT, LIMIT.next_up(), 4503599627370496.0, 1e16, 4.6e18, 1e300, f64::MAX];
    let none = [f64::INFINITY, f64::NAN];
    for x in beyond.chain(stated).chain(none).flat_map(|x| [x, -x]) {
        for rounding in ROUNDINGS {
            let (sine, cosine) = (rounding.sin_cos)(x);
            assert!(sine.is_nan() && cosine.is_nan(), "{sine} and {cosine} at {x:e}");
        }
    }
    for x in [LIMIT.next_down(), -LIMIT.next_down()] {
        for rounding in ROUNDINGS {
            let (sine, cosine) = (rounding.sin_cos)(x);
            let (exact_sine, exact_cosine) = exact::sin_cos(x);
            assert!(exact_sine.error_of(sine).abs() <= rounding.absolute);
            assert!(exact_cosine.error_of(cosine).abs() <= rounding.absolute);
        }
    }
}

/// Compares to the last bit, so that no constant changes by accident.
#[test]
fn sin_cos_has_the_bits_that_it_had() {
    for (rounding, expected) in ROUNDINGS.iter().zip([0xcc84_285d_871c_e337, 0xa6bc_bb27_e077_b183])
    {
        let mut random = random::uniform(6);
        let mut digest = digest::EMPTY;
        for _ in 0..20_000 {
            let x = 2f64.powf(50.0 * random() - 20.0);
            let (sine, cosine) = (rounding.sin_cos)(x);
            digest = digest::with(digest::with(digest, sine.to_bits()), cosine.to_bits());
        }
        assert_eq!(digest, expected, "{digest:#x}, fused {}", rounding.fused);
    }
}

/// Compares the constants, because the last digit of some does not change any bit of a tested result.
#[test]
fn constants_are_those_of_the_fit() {
    let source = include_str!("../src/runtime/trig/double.rs");
    let bits: Vec<u64> = digest::numbers(source, "const SINE")
        .chain(digest::numbers(source, "const COSINE"))
        .chain(digest::numbers(source, "const HALF_PI"))
        .chain(digest::numbers(source, "const SHORT_HALF_PI"))
        .map(|number| number.parse::<f64>().unwrap().to_bits())
        .collect();
    assert_eq!(bits.len(), 18);
    assert_eq!(bits.iter().copied().fold(digest::EMPTY, digest::with), 0xd303_e1d1_b84e_09e5);
}

#[test]
fn an_array_has_the_values_of_its_angles() {
    fn check<const N: usize>() {
        let mut random = random::uniform(N as u64);
        let angles: [f64; N] = std::array::from_fn(|_| 20.0 * random() - 10.0);
        let (sines, cosines) = sin_cos_array(&angles);
        for ((angle, sine), cosine) in angles.iter().zip(sines).zip(cosines) {
            let alone = Scalar::sin_cos(*angle);
            assert_eq!((sine, cosine), alone, "{N} angles");
        }
    }
    check::<0>();
    check::<1>();
    check::<2>();
    check::<5>();
    check::<6>();
    check::<7>();
    check::<8>();
    check::<9>();
    check::<15>();
    check::<16>();
    check::<23>();
}

#[test]
fn tanh_is_accurate_everywhere() {
    let mut random = random::uniform(3);
    let mut worst = 0f64;
    for limit in [1e-300, 1e-9, 0.1, 0.5, 3.0, 25.0] {
        for _ in 0..20_000 {
            let x = limit * (2.0 * random() - 1.0);
            let exact = exact::tanh(x);
            worst = worst.max(last_places(exact.error_of(Scalar::tanh(x)), exact.high));
        }
    }
    println!("worst error {worst} last places");
    assert!(worst < 3.0);
    for x in [20.0, 1e3, f64::MAX, f64::INFINITY] {
        assert_eq!((Scalar::tanh(x), Scalar::tanh(-x)), (1.0, -1.0));
    }
    assert_eq!(Scalar::tanh(-0.0f64).to_bits(), (-0.0f64).to_bits());
    assert!(Scalar::tanh(f64::NAN).is_nan());
}
