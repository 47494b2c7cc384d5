//! The tolerance within which a constant angle is taken as a multiple of π/2.

/// The tolerance if neither a caller nor the robot file gives one, rad.
pub const DEFAULT: f64 = 1e-9;

/// The largest tolerance, rad.
pub const MAX: f64 = 0.1;

/// Checks a tolerance.
///
/// # Errors
///
/// An error if the tolerance is below 0, above [`MAX`], or NaN.
pub fn check(tolerance: f64) -> Result<f64, InvalidSnap> {
    if (0.0..=MAX).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(InvalidSnap(tolerance.to_string()))
    }
}

/// An invalid snapping tolerance, as given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the snapping tolerance {0} is not an angle in radians between 0 and {MAX}")]
pub struct InvalidSnap(String);
