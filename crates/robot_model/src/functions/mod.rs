//! The functions that can be asked for: their kinds, their names, and which of them are wanted.

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
