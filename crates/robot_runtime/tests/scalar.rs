//! Properties of every scalar: numbers, lanes, blocks of states.

use robot_runtime::root::software_sqrt_f64;
use robot_runtime::{
    F32x8, F32x16, F64x4, F64x8, FUSED, Lanes, PolyTrig, Scalar, Trig, lanes_from_states,
    padded_states, states_from_lanes,
};

mod random;

#[test]
fn double_software_square_root_has_the_bits_of_the_processors() {
    let mut random = random::uniform(5);
    let special = [0.0, -0.0, f64::from_bits(1), f64::MIN_POSITIVE, f64::MAX, f64::INFINITY];
    let magnitudes = (-1074..1024).map(|exponent| 2f64.powi(exponent));
    let mut check = |x: f64| {
        assert_eq!(software_sqrt_f64(x).to_bits(), x.sqrt().to_bits(), "{x:e}");
    };
    special.into_iter().for_each(&mut check);
    for magnitude in magnitudes {
        check(magnitude);
        (0..100).for_each(|_| check(magnitude * (1.0 + random())));
    }
    for x in [-1e-310, -1.0, f64::NEG_INFINITY, f64::NAN, -f64::NAN] {
        assert!(software_sqrt_f64(x).is_nan());
    }
}

#[test]
fn roots_of_squares_are_exact() {
    for number in [0.0, 1.0, 3.0, 0.375, 1234.0] {
        assert_eq!(Scalar::sqrt(number * number), number);
        let number = number as f32;
        assert_eq!(Scalar::sqrt(number * number), number);
    }
    assert!(Scalar::sqrt(-1.0_f64).is_nan() && Scalar::sqrt(-1.0_f32).is_nan());
}

#[test]
fn multiply_add_rounds_once_where_it_says_so() {
    let x = 1.0 + 2f64.powi(-30);
    let rest = Scalar::mul_add(x, x, -(1.0 + 2f64.powi(-29)));
    assert_eq!(rest != 0.0, FUSED);
    let x = 1.0 + 2f32.powi(-15);
    let rest = Scalar::mul_add(x, x, -(1.0 + 2f32.powi(-14)));
    assert_eq!(rest != 0.0, FUSED);
}

#[test]
fn sign_of_zero_is_zero() {
    for zero in [0.0, -0.0] {
        assert_eq!(f64::signum0(zero).to_bits(), 0);
        assert_eq!(f32::signum0(zero as f32).to_bits(), 0);
    }
    for positive in [f64::from_bits(1), 3.5, f64::MAX, f64::INFINITY] {
        assert_eq!((positive.signum0(), (-positive).signum0()), (1.0, -1.0));
    }
    assert_eq!((2.5f32.signum0(), (-2.5f32).signum0()), (1.0, -1.0));
    assert!(f64::NAN.signum0().is_nan() && (-f32::NAN).signum0().is_nan());
}

#[test]
fn only_what_is_positive_and_finite_has_a_positive_reciprocal() {
    for positive in [1.0, 3.5, 0.1, 1e300, f64::MIN_POSITIVE, f64::MAX] {
        assert_eq!(positive.recip_positive(), 1.0 / positive);
        assert!((-positive).recip_positive().is_nan());
    }
    for positive in [1.0, 3.5, 0.1, 1e30, f32::MIN_POSITIVE, f32::MAX] {
        assert_eq!(positive.recip_positive(), 1.0 / positive);
        assert!((-positive).recip_positive().is_nan());
    }
    let least = f64::from_bits(1);
    assert_eq!(
        (least.recip_positive(), f32::from_bits(1).recip_positive()),
        (f64::INFINITY, f32::INFINITY)
    );
    for none in [0.0, -0.0, -least, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::NAN] {
        assert!(none.recip_positive().is_nan(), "{none}");
        assert!((none as f32).recip_positive().is_nan(), "{none}");
    }
    const HALF: f64 = robot_runtime::recip_positive_f64(2.0);
    assert_eq!(HALF, 0.5);
}

#[test]
fn numbers_convert_and_compare() {
    assert_eq!((f64::from_f64(0.1), f32::from_f64(0.1)), (0.1, 0.1));
    assert_eq!(F64x4::from_f64(0.1), Lanes::splat(0.1));
    assert_eq!((F32x8::ZERO, F32x8::ONE), (Lanes::splat(0.0), Lanes::splat(1.0)));
    assert_eq!((-2.5f64).abs(), Scalar::abs(-2.5));
    assert_ne!(F64x4::from([1.0, 2.0, 3.0, 4.0]), F64x4::from([1.0, 2.0, 3.0, 5.0]));
    assert_eq!(<[f64; 4]>::from(F64x4::from([1.0, 2.0, 3.0, 4.0])), [1.0, 2.0, 3.0, 4.0]);
}

/// Every operation on lanes has the same results as on their numbers.
fn check_lanes<T: Scalar, const N: usize>() {
    let mut random = random::uniform(N as u64);
    let mut draw = || -> [T; N] { std::array::from_fn(|_| T::from_f64(4.0 * random() - 2.0)) };
    for _ in 0..50 {
        let (a, b, c) = (draw(), draw(), draw());
        let (x, y, z) = (Lanes::from(a), Lanes::from(b), Lanes::from(c));
        let each = |f: &dyn Fn(T, T, T) -> T| {
            Lanes::from_array(std::array::from_fn::<T, N, _>(|i| f(a[i], b[i], c[i])))
        };
        assert_eq!(x + y, each(&|a, b, _| a + b));
        assert_eq!(x - y, each(&|a, b, _| a - b));
        assert_eq!(x * y, each(&|a, b, _| a * b));
        assert_eq!(x / y, each(&|a, b, _| a / b));
        assert_eq!(-x, each(&|a, _, _| -a));
        assert_eq!(x.mul_add(y, z), each(&|a, b, c| a.mul_add(b, c)));
        assert_eq!((x * x).sqrt(), each(&|a, _, _| (a * a).sqrt()));
        assert_eq!(x.abs(), each(&|a, _, _| a.abs()));
        assert_eq!(x.signum0(), each(&|a, _, _| a.signum0()));
        assert_eq!((x * x).recip_positive(), each(&|a, _, _| (a * a).recip_positive()));
        assert_eq!(x.tanh(), each(&|a, _, _| a.tanh()));
        assert_eq!(x.sin_cos().0, each(&|a, _, _| a.sin_cos().0));
        assert_eq!(PolyTrig::sin_cos(x).1, each(&|a, _, _| a.sin_cos().1));
        let (sines, cosines) = PolyTrig::sin_cos_array(&[x, y]);
        assert_eq!((sines[1], cosines[1]), y.sin_cos());
    }
}

#[test]
fn lanes_act_lane_by_lane() {
    check_lanes::<f64, 1>();
    check_lanes::<f64, 3>();
    check_lanes::<f64, 4>();
    check_lanes::<f64, 8>();
    check_lanes::<f32, 8>();
    check_lanes::<f32, 16>();
    check_lanes::<f32, 24>();
    assert_eq!((size_of::<F64x8>(), size_of::<F32x16>()), (64, 64));
}

#[test]
fn states_pass_through_lanes_and_back() {
    let states: [[f64; 3]; 8] =
        std::array::from_fn(|n| std::array::from_fn(|d| (10 * n + d) as f64));
    let lanes: [F64x8; 3] = lanes_from_states(&states);
    assert_eq!(lanes[2].to_array(), [2.0, 12.0, 22.0, 32.0, 42.0, 52.0, 62.0, 72.0]);
    assert_eq!(states_from_lanes(&lanes), states);

    let some: [[f64; 3]; 4] = padded_states(&states[..3]);
    assert_eq!((&some[..3], some[3]), (&states[..3], [0.0; 3]));
    let first: [[f64; 3]; 4] = padded_states(&states);
    assert_eq!(first, states[..4]);
}

#[cfg(feature = "std")]
#[test]
fn the_standard_library_is_a_source_of_sines() {
    use robot_runtime::{StdTrig, std_sin_cos_array};
    let angles = [0.3, -40.0, 1e9];
    assert_eq!(std_sin_cos_array(&angles), (angles.map(f64::sin), angles.map(f64::cos)));
    let angles = [0.3f32, -40.0, 1e9];
    assert_eq!(std_sin_cos_array(&angles), (angles.map(f32::sin), angles.map(f32::cos)));
    let lanes = F64x4::from([0.1, 0.2, 0.3, 1e9]);
    assert_eq!(StdTrig::sin_cos(lanes), (lanes.map(f64::sin), lanes.map(f64::cos)));
    assert_eq!(std_sin_cos_array(&[lanes]).0, [lanes.map(f64::sin)]);
}
