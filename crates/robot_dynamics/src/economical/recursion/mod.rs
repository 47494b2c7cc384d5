//! The recursion itself: motions from the base outward, forces from the tips inward, and the quantities that only need
//! the outward part.

mod energy;
pub(crate) mod inward;
pub(crate) mod kinematics;
pub(crate) mod outward;
