//! The single-precision functions against those of double precision, which are exact beside them.

use robot_runtime::{FUSED, Scalar, root::software_sqrt_f32, sin_cos_array};

/// Worst absolute error of sine and cosine that the documentation states for |x| ≤ 10⁴.
const SIN_COS_ERROR: f64 = if FUSED { 7.2e-8 } else { 8.8e-8 };

/// Every `step`-th number from 0 to `limit`.
fn numbers(limit: f32, step: usize) -> impl Iterator<Item = f32> {
    (0..=limit.to_bits()).step_by(step).map(f32::from_bits)
}

fn last_places(error: f64, exact: f64) -> f64 {
    let rounded = exact.abs() as f32;
    error.abs() / f64::from(rounded.next_up() - rounded)
}

#[test]
fn sin_cos_is_accurate_over_the_stated_range() {
    let mut worst = 0f64;
    for x in numbers(1e4, 997).flat_map(|x| [x, -x]) {
        let (sine, cosine) = Scalar::sin_cos(x);
        let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
        worst = worst.max((f64::from(sine) - exact_sine).abs());
        worst = worst.max((f64::from(cosine) - exact_cosine).abs());
    }
    println!("worst error {worst:e}");
    assert!(worst < SIN_COS_ERROR);
}

#[test]
fn sin_cos_is_accurate_next_to_every_multiple_of_a_right_angle() {
    let mut worst = 0f64;
    for k in 0..=6366 {
        let multiple = (f64::from(k) * std::f64::consts::FRAC_PI_2) as f32;
        for x in [multiple.next_down(), multiple, multiple.next_up()] {
            let (sine, cosine) = Scalar::sin_cos(x);
            let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
            worst = worst.max((f64::from(sine) - exact_sine).abs());
            worst = worst.max((f64::from(cosine) - exact_cosine).abs());
        }
    }
    assert!(worst < SIN_COS_ERROR);
}

#[test]
fn sin_cos_of_an_acute_half_angle_is_accurate_in_last_places() {
    let mut worst = 0f64;
    for x in numbers(std::f32::consts::FRAC_PI_4, 997) {
        let (sine, cosine) = Scalar::sin_cos(x);
        let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
        worst = worst.max(last_places(f64::from(sine) - exact_sine, exact_sine));
        worst = worst.max(last_places(f64::from(cosine) - exact_cosine, exact_cosine));
    }
    println!("worst error {worst} last places");
    assert!(worst < 1.2);
}

#[test]
fn sin_cos_beyond_the_range_errs_like_a_rounded_angle() {
    for x in numbers(1e6, 997).skip_while(|x| *x < 1e4) {
        let (sine, cosine) = Scalar::sin_cos(x);
        let (exact_sine, exact_cosine) = f64::sin_cos(f64::from(x));
        let allowed = 2.0 * f64::from(x.next_up() - x);
        assert!((f64::from(sine) - exact_sine).abs() < allowed, "{x}");
        assert!((f64::from(cosine) - exact_cosine).abs() < allowed, "{x}");
    }
}

#[test]
fn sin_cos_of_what_is_no_number_is_no_number() {
    for x in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let (sine, cosine) = Scalar::sin_cos(x);
        assert!(sine.is_nan() && cosine.is_nan());
    }
    for x in [1e6, 8e9, 1e30, f32::MAX] {
        std::hint::black_box(Scalar::sin_cos(x));
    }
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
