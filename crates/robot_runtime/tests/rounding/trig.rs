//! The files of the runtime themselves.
#![allow(unreachable_pub, dead_code, reason = "a test uses one of the two precisions")]

#[path = "../../src/runtime/trig/double.rs"]
pub(crate) mod double;
#[path = "../../src/runtime/trig/single.rs"]
pub(crate) mod single;
