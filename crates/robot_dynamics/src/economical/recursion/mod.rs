//! The recursion itself: motions from the base outward, forces from the tips inward, and the quantities
//! that come from the outward part alone.

mod energy;
pub(crate) mod inward;
pub(crate) mod kinematics;
pub(crate) mod outward;
