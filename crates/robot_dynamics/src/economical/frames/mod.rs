//! The frames that the recursion works in, and the mechanism in them.

pub(crate) mod chain;
pub(crate) mod joint_frame;
pub(crate) mod reframed;
pub(crate) mod working;
