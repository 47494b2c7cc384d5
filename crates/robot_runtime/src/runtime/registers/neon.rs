//! Registers of 64-bit ARM, of 128 bits (Advanced SIMD, Neon), for targets that have them.

#![allow(unsafe_code)]

use core::arch::aarch64::*;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::super::number::Number;
use super::super::scalar::Scalar;
use super::super::trig::{double, single};
use super::Register;
use super::register::register;

/// `a · b + c`, rounded once: the instruction takes the addend first.
#[inline(always)]
unsafe fn mul_add_f64(a: float64x2_t, b: float64x2_t, c: float64x2_t) -> float64x2_t {
    unsafe { vfmaq_f64(c, a, b) }
}

/// `a · b + c`, rounded once.
#[inline(always)]
unsafe fn mul_add_f32(a: float32x4_t, b: float32x4_t, c: float32x4_t) -> float32x4_t {
    unsafe { vfmaq_f32(c, a, b) }
}

register!(
    /// Two `f64`.
    F64x2: [f64; 2] as float64x2_t, int64x2_t by i64,
    polynomials double,
    load vld1q_f64, store vst1q_f64, splat vdupq_n_f64, splat_bits vdupq_n_s64,
    arithmetic vaddq_f64 vsubq_f64 vmulq_f64 vdivq_f64 vsqrtq_f64 mul_add_f64,
    casts vreinterpretq_s64_f64 vreinterpretq_f64_s64,
    bits vandq_s64 vorrq_s64 veorq_s64 vaddq_s64 vsubq_s64,
    shift vshlq_n_s64 by 62,
    not_below |a, b| veorq_s64(vreinterpretq_s64_u64(vcltq_f64(a, b)), vdupq_n_s64(-1))
);

register!(
    /// Four `f32`.
    F32x4: [f32; 4] as float32x4_t, int32x4_t by i32,
    polynomials single,
    load vld1q_f32, store vst1q_f32, splat vdupq_n_f32, splat_bits vdupq_n_s32,
    arithmetic vaddq_f32 vsubq_f32 vmulq_f32 vdivq_f32 vsqrtq_f32 mul_add_f32,
    casts vreinterpretq_s32_f32 vreinterpretq_f32_s32,
    bits vandq_s32 vorrq_s32 veorq_s32 vaddq_s32 vsubq_s32,
    shift vshlq_n_s32 by 30,
    not_below |a, b| veorq_s32(vreinterpretq_s32_u32(vcltq_f32(a, b)), vdupq_n_s32(-1))
);
