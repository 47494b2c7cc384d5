//! Multiply-adds that round once.

pub(crate) mod fused {
    pub(crate) const FUSED: bool = true;

    pub(crate) fn once_f64(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    pub(crate) fn once_f32(a: f32, b: f32, c: f32) -> f32 {
        a.mul_add(b, c)
    }
}

#[allow(dead_code, reason = "a test uses one of the two precisions")]
#[path = "../../src/runtime/number.rs"]
pub(crate) mod number;

#[path = "trig.rs"]
pub(crate) mod trig;
