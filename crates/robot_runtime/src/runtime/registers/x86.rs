//! Registers of x86-64: of 128 bits on all targets, of 256 bits with AVX2, of 512 bits with AVX-512.

#![allow(unsafe_code)]

use core::arch::x86_64::*;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::super::number::Number;
use super::super::scalar::Scalar;
use super::super::trig::block::copy;
use super::super::trig::{double, single};
use super::Register;
use super::register::register;

register!(
    /// Two `f64`.
    F64x2: [f64; 2] as __m128d, __m128i by i64,
    polynomials double,
    load _mm_loadu_pd, store _mm_storeu_pd, splat _mm_set1_pd, splat_bits _mm_set1_epi64x,
    arithmetic _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd _mm_fmadd_pd,
    casts _mm_castpd_si128 _mm_castsi128_pd,
    bits _mm_and_si128 _mm_or_si128 _mm_xor_si128 _mm_add_epi64 _mm_sub_epi64,
    shift _mm_slli_epi64 by 62,
    not_below |a, b| _mm_castpd_si128(_mm_cmpnlt_pd(a, b))
);

register!(
    /// Four `f32`.
    F32x4: [f32; 4] as __m128, __m128i by i32,
    polynomials single,
    load _mm_loadu_ps, store _mm_storeu_ps, splat _mm_set1_ps, splat_bits _mm_set1_epi32,
    arithmetic _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_sqrt_ps _mm_fmadd_ps,
    casts _mm_castps_si128 _mm_castsi128_ps,
    bits _mm_and_si128 _mm_or_si128 _mm_xor_si128 _mm_add_epi32 _mm_sub_epi32,
    shift _mm_slli_epi32 by 30,
    not_below |a, b| _mm_castps_si128(_mm_cmpnlt_ps(a, b))
);

register!(
    /// Four `f64`; AVX2.
    F64x4: [f64; 4] as __m256d, __m256i by i64,
    polynomials double,
    load _mm256_loadu_pd, store _mm256_storeu_pd, splat _mm256_set1_pd, splat_bits _mm256_set1_epi64x,
    arithmetic _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_fmadd_pd,
    casts _mm256_castpd_si256 _mm256_castsi256_pd,
    bits _mm256_and_si256 _mm256_or_si256 _mm256_xor_si256 _mm256_add_epi64 _mm256_sub_epi64,
    shift _mm256_slli_epi64 by 62,
    not_below |a, b| _mm256_castpd_si256(_mm256_cmp_pd::<_CMP_NLT_UQ>(a, b))
);

register!(
    /// Eight `f32`; AVX2.
    F32x8: [f32; 8] as __m256, __m256i by i32,
    polynomials single,
    load _mm256_loadu_ps, store _mm256_storeu_ps, splat _mm256_set1_ps, splat_bits _mm256_set1_epi32,
    arithmetic _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_sqrt_ps _mm256_fmadd_ps,
    casts _mm256_castps_si256 _mm256_castsi256_ps,
    bits _mm256_and_si256 _mm256_or_si256 _mm256_xor_si256 _mm256_add_epi32 _mm256_sub_epi32,
    shift _mm256_slli_epi32 by 30,
    not_below |a, b| _mm256_castps_si256(_mm256_cmp_ps::<_CMP_NLT_UQ>(a, b))
);

#[cfg(target_feature = "avx512f")]
register!(
    /// Eight `f64`; AVX-512.
    F64x8: [f64; 8] as __m512d, __m512i by i64,
    polynomials double,
    load _mm512_loadu_pd, store _mm512_storeu_pd, splat _mm512_set1_pd, splat_bits _mm512_set1_epi64,
    arithmetic _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_fmadd_pd,
    casts _mm512_castpd_si512 _mm512_castsi512_pd,
    bits _mm512_and_si512 _mm512_or_si512 _mm512_xor_si512 _mm512_add_epi64 _mm512_sub_epi64,
    shift _mm512_slli_epi64 by 62,
    not_below |a, b| _mm512_maskz_set1_epi64(_mm512_cmp_pd_mask::<_CMP_NLT_UQ>(a, b), -1)
);

#[cfg(target_feature = "avx512f")]
register!(
    /// Sixteen `f32`; AVX-512.
    F32x16: [f32; 16] as __m512, __m512i by i32,
    polynomials single,
    load _mm512_loadu_ps, store _mm512_storeu_ps, splat _mm512_set1_ps, splat_bits _mm512_set1_epi32,
    arithmetic _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_sqrt_ps _mm512_fmadd_ps,
    casts _mm512_castps_si512 _mm512_castsi512_ps,
    bits _mm512_and_si512 _mm512_or_si512 _mm512_xor_si512 _mm512_add_epi32 _mm512_sub_epi32,
    shift _mm512_slli_epi32 by 30,
    not_below |a, b| _mm512_maskz_set1_epi32(_mm512_cmp_ps_mask::<_CMP_NLT_UQ>(a, b), -1)
);

macro_rules! of_one_state {
    ($name:ident: $float:ident in $register:ident of $lanes:literal, $($index:literal)*) => {
        /// Sines and cosines of angles with AVX2, with multiply-adds that round once if `ONCE`. Up to 64 angles, as
        /// many as a robot can have joints, are computed without a loop, further ones one after the other.
        #[inline(always)]
        pub(in super::super) fn $name<const ONCE: bool, const N: usize>(
            angles: &[$float; N],
        ) -> ([$float; N], [$float; N]) {
            let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
            let mut rest = (&angles[..], &mut sines[..], &mut cosines[..]);
            $(
                if N > $index * $lanes {
                    let count = (N - $index * $lanes).min($lanes);
                    let (mut padded, mut sine, mut cosine) =
                        ([0.0; $lanes], [0.0; $lanes], [0.0; $lanes]);
                    copy(rest.0, &mut padded);
                    let (s, c) = $name::compute::<ONCE, _>($register::<ONCE>::load(&padded));
                    s.store(&mut sine);
                    c.store(&mut cosine);
                    copy(&sine, rest.1);
                    copy(&cosine, rest.2);
                    rest = (
                        rest.0.get(count..).unwrap_or_default(),
                        rest.1.get_mut(count..).unwrap_or_default(),
                        rest.2.get_mut(count..).unwrap_or_default(),
                    );
                }
            )*
            for (angle, (sine, cosine)) in rest.0.iter().zip(rest.1.iter_mut().zip(rest.2)) {
                (*sine, *cosine) = $name::compute::<ONCE, _>(*angle);
            }
            (sines, cosines)
        }
    };
}

of_one_state!(double: f64 in F64x4 of 4, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
of_one_state!(single: f32 in F32x8 of 8, 0 1 2 3 4 5 6 7);
