//! The functions that generated robot code calls at run time.
//!
//! These files only require that the crate around them declares a feature `std`. With it,
//! [`FUSED`] multiply-add, the processor's square root and `StdTrig` come from the standard
//! library; without it, only `core` is used, and `StdTrig` cannot be called.

mod batch;
mod field;
mod fused;
mod lanes;
mod lanes_on;
mod lanewise;
#[cfg(not(feature = "std"))]
mod no_std_trig;
mod number;
mod processor;
mod real;
mod reciprocal;
mod registers;
pub mod root;
mod scalar;
mod state;
#[cfg(feature = "std")]
mod std_trig;
pub mod tanh;
pub mod trig;

pub use self::batch::{lanes_from_states, padded_states, states_from_lanes};
pub use self::field::Field;
pub use self::fused::FUSED;
pub use self::lanes::{F32x8, F32x16, F64x4, F64x8, Lanes};
pub use self::lanes_on::LanesOn;
#[cfg(not(feature = "std"))]
pub use self::no_std_trig::{StdTrig, std_sin_cos_array};
pub use self::processor::{
    Arithmetic, Compiled, Kernel, anywhere, dispatch, dispatch_apart, dispatch_block,
};
pub use self::real::Real;
pub use self::reciprocal::{recip_positive_f32, recip_positive_f64};
pub use self::scalar::Scalar;
pub use self::state::{
    State, chunks, column_length, lane, padded_chunks, set_state, side_by_side, state,
};
#[cfg(feature = "std")]
pub use self::std_trig::{StdTrig, std_sin_cos_array};
pub use self::trig::{PolyTrig, Trig, sin_cos_array, sin_cos_each};
