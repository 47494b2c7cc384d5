//! The functions that can be generated: their kinds, their names, and selections of them.

mod bundle;
mod coupled;
mod kind;
mod named;
mod reach;

pub use bundle::{ALL_FUNCTIONS, Bundle, Functions};
pub use coupled::coupled;
pub use kind::{Effects, FunctionKind};
pub use named::{FrameRef, WrongName, is_of_frame, named, names};
pub use reach::{has_shared_coordinates, out_of_reach};
