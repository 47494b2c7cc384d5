//! The double-precision functions against values exact to some 30 digits.

use std::f64::consts::FRAC_PI_2;

use robot_runtime::{FUSED, Scalar, sin_cos_array};

mod exact;
mod random;

/// Worst absolute error of sine and cosine that the documentation states for |x| ≤ 10⁵.
const SIN_COS_ERROR: f64 = if FUSED { 1.4e-16 } else { 1.7e-16 };

/// Functions at numbers where their values were computed with 500 bits: x, then each value as a
/// sum of two doubles.
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

/// The units between a value and the exact one, in last places of the exact one.
fn last_places(error: f64, exact: f64) -> f64 {
    let ulp = exact.abs().next_up() - exact.abs();
    error.abs() / ulp
}

/// Worst absolute error, and worst error in last places, of sine and cosine.
#[derive(Default)]
struct Worst {
    absolute: f64,
    last_places: f64,
}

impl Worst {
    fn update(&mut self, x: f64) {
        let (sine, cosine) = Scalar::sin_cos(x);
        let (exact_sine, exact_cosine) = exact::sin_cos(x);
        for (value, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = exact.error_of(value);
            self.absolute = self.absolute.max(error.abs());
            self.last_places = self.last_places.max(last_places(error, exact.high));
        }
    }
}

#[test]
fn sin_cos_is_accurate_over_the_stated_range() {
    let mut random = random::uniform(1);
    let mut worst = Worst::default();
    for limit in [1e-3, 0.8, 4.0, 100.0, 1e5] {
        for _ in 0..100_000 {
            worst.update(limit * (2.0 * random() - 1.0));
        }
    }
    println!("worst error {:e}, {} last places", worst.absolute, worst.last_places);
    assert!(worst.absolute < SIN_COS_ERROR);
    assert!(worst.last_places < 1.7);
}

/// Reduction loses most where the angle is nearly a multiple of π/2: all of them up to 10⁵.
#[test]
fn sin_cos_is_accurate_next_to_every_multiple_of_a_right_angle() {
    let mut worst = Worst::default();
    for k in 0..=63_661 {
        let multiple = f64::from(k) * FRAC_PI_2;
        let mut x = multiple.next_down();
        for _ in 0..3 {
            worst.update(x);
            worst.update(-x);
            x = x.next_up();
        }
    }
    println!("worst error {:e}, {} last places", worst.absolute, worst.last_places);
    assert!(worst.absolute < 1e-21);
    assert!(worst.last_places < 1.0);
}

#[test]
fn sin_cos_of_every_magnitude_is_exact_near_zero() {
    for exponent in -1074..-27 {
        let x = 2f64.powi(exponent);
        assert_eq!(Scalar::sin_cos(x), (x, 1.0));
        assert_eq!(Scalar::sin_cos(-x), (-x, 1.0));
    }
    assert_eq!(Scalar::sin_cos(0.0f64).0.to_bits(), 0);
}

#[test]
fn sin_cos_beyond_the_range_errs_like_a_rounded_angle() {
    let mut random = random::uniform(2);
    for _ in 0..100_000 {
        let x = 10f64.powf(5.0 + 7.0 * random());
        let (sine, cosine) = Scalar::sin_cos(x);
        let allowed = 1e-15 + 2.0 * (x.next_up() - x);
        assert!((sine - f64::sin(x)).abs() < allowed, "{x}");
        assert!((cosine - f64::cos(x)).abs() < allowed, "{x}");
    }
}

#[test]
fn sin_cos_of_what_is_no_number_is_no_number() {
    for x in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (sine, cosine) = Scalar::sin_cos(x);
        assert!(sine.is_nan() && cosine.is_nan());
    }
    for x in [1e15, 4.6e18, 1e300, f64::MAX] {
        std::hint::black_box(Scalar::sin_cos(x));
    }
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
