#![no_std]
//! What generated robot code calls at run time.

mod runtime;
#[cfg(feature = "sources")]
mod sources;

pub use self::runtime::*;
#[cfg(feature = "sources")]
pub use self::sources::SOURCES;
