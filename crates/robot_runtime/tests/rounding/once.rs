//! Multiply-adds that round once.

#[allow(dead_code, reason = "a test uses one of the two precisions")]
pub(crate) mod fused {
    pub(crate) const FUSED: bool = true;

    pub(crate) fn mul_add_f64(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    pub(crate) fn mul_add_f32(a: f32, b: f32, c: f32) -> f32 {
        a.mul_add(b, c)
    }
}

#[path = "trig.rs"]
pub(crate) mod trig;
