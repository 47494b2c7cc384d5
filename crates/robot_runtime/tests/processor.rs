//! Results of kernels on the current processor.
#![allow(clippy::duplicate_mod, reason = "the runtime's files are there for either rounding")]

use robot_runtime::{
    Arithmetic, Compiled, FUSED, Kernel, Real, Scalar, State, chunks, column_length, dispatch,
    dispatch_apart, dispatch_block, lane, padded_chunks,
};

mod random;
mod rounding;
use rounding::once::trig::{double, single};

/// Whether multiply-adds round once in a kernel that is dispatched.
fn rounds_once() -> bool {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    return is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    FUSED
}

/// A kernel of sines and cosines of angles by both functions, and a multiply-add.
#[derive(Clone, Copy)]
struct Sines<T, const N: usize>([T; N]);

impl<T: Real, const N: usize> Kernel for Sines<T, N> {
    type Output = [([T; N], [T; N]); 2];

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Self::Output {
        [A::sin_cos_array(&self.0), A::sin_cos_each(&self.0)]
    }
}

#[derive(Clone, Copy)]
struct Product<T>(T, T, T);

impl<T: Real> Kernel for Product<T> {
    type Output = T;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> T {
        A::mul_add(self.0, self.1, self.2)
    }
}

#[test]
fn multiply_adds_follow_the_processor() {
    let x = 1.0 + 2f64.powi(-30);
    let product = || Product(x, x, -(1.0 + 2f64.powi(-29)));
    let once = 2f64.powi(-60);
    let expected = |is_once: bool| if is_once { once } else { 0.0 };
    for _ in 0..3 {
        assert_eq!(dispatch(product()), expected(rounds_once()));
        assert_eq!(dispatch_block(product()), expected(rounds_once()));
        assert_eq!(dispatch_apart(product()), expected(rounds_once()));
        assert_eq!(product().run::<Compiled>(), expected(FUSED));
    }
    let x = 1.0 + 2f32.powi(-15);
    let product = Product(x, x, -(1.0 + 2f32.powi(-14)));
    assert_eq!(dispatch(product), if rounds_once() { 2f32.powi(-30) } else { 0.0 });
}

fn check<const N: usize>() {
    let mut random = random::uniform(N as u64);
    let mut angles: [f64; N] = std::array::from_fn(|_| 2e5 * (random() - 0.5));
    if let Some(last) = angles.last_mut() {
        *last = 1e10;
    }
    for [whole, each] in [dispatch(Sines(angles)), dispatch_block(Sines(angles))] {
        for (i, angle) in angles.into_iter().enumerate() {
            let (sine, cosine) =
                if rounds_once() { double::sin_cos(angle) } else { Scalar::sin_cos(angle) };
            let bits = |pair: &([f64; N], [f64; N])| (pair.0[i].to_bits(), pair.1[i].to_bits());
            assert_eq!(whole.0[i].is_nan(), angle == 1e10);
            if angle != 1e10 {
                assert_eq!(bits(&whole), (sine.to_bits(), cosine.to_bits()), "{angle} of {N}");
            }
            assert_eq!(each.0[i].is_nan(), angle == 1e10);
            if angle != 1e10 {
                assert_eq!(bits(&each), (sine.to_bits(), cosine.to_bits()), "{angle} of {N}");
            }
        }
    }
    let angles = angles.map(|angle| angle as f32 / 1e2);
    let [whole, each] = dispatch(Sines(angles));
    for (i, angle) in angles.into_iter().enumerate().take(N.saturating_sub(1)) {
        let expected = if rounds_once() { single::sin_cos(angle) } else { Scalar::sin_cos(angle) };
        assert_eq!(((whole.0[i], whole.1[i]), (each.0[i], each.1[i])), (expected, expected));
    }
}

#[test]
fn sines_of_kernels_are_those_of_single_angles() {
    check::<0>();
    check::<1>();
    check::<2>();
    check::<4>();
    check::<5>();
    check::<7>();
    check::<8>();
    check::<12>();
    check::<13>();
    check::<16>();
    check::<17>();
    check::<32>();
    check::<33>();
    check::<40>();
}

#[test]
fn columns_become_lanes_and_come_back() {
    let columns: [Vec<f64>; 3] =
        std::array::from_fn(|d| (0..11).map(|i| f64::from(i) + 100.0 * d as f64).collect());
    let slices = columns.each_ref().map(Vec::as_slice);
    assert_eq!(column_length(&slices), 11);
    assert_eq!(column_length::<f64, 0>(&[]), usize::MAX);
    let whole: [&[f64; 4]; 3] = chunks(&slices, 4);
    assert_eq!(lane(whole, 1), [5.0, 105.0, 205.0]);
    // Beyond the end there are zeros, for whole chunks or for the remainder.
    assert_eq!(chunks::<f64, 4, 3>(&slices, 8), [&[0.0; 4]; 3]);
    let padded: [[f64; 4]; 3] = padded_chunks(&slices, 8);
    assert_eq!(padded[1], [108.0, 109.0, 110.0, 0.0]);

    let mut lanes = [[[0.0; 4]; 3]; 2];
    for lane in 0..5 {
        let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        rows.map(|row| row.map(|entry| entry + 10.0 * lane as f64)).set_lane(&mut lanes, lane);
    }
    assert_eq!(lanes[1][2], [6.0, 16.0, 26.0, 36.0]);
    let mut written: [[Vec<f64>; 3]; 2] = Default::default();
    written.iter_mut().flatten().for_each(|column| column.resize(6, -1.0));
    let mut columns = written.each_mut().map(|row| row.each_mut().map(Vec::as_mut_slice));
    assert_eq!(<[[f64; 3]; 2] as State>::column_length(&columns), 6);
    <[[f64; 3]; 2]>::to_columns(&lanes, &mut columns, 0, 4);
    <[[f64; 3]; 2]>::to_columns(&lanes, &mut columns, 4, 4);
    assert_eq!(written[1][2], [6.0, 16.0, 26.0, 36.0, 6.0, 16.0]);
    let mut columns = written.each_mut().map(|row| row.each_mut().map(Vec::as_mut_slice));
    <[[f64; 3]; 2]>::to_columns(&lanes, &mut columns, 1, 1);
    assert_eq!(written[0][0], [1.0, 1.0, 21.0, 31.0, 1.0, 11.0]);
}
