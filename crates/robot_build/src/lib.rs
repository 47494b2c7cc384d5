//! Generates Rust from a robot file: the driver that connects the reader, the derivation and the backend, and the
//! builder that a `build.rs` calls.
//!
//! The common case is one line in `build.rs`
//!
//! ```no_run
//! fn main() -> Result<(), robot_build::Errors> {
//!     robot_build::compile("robots/trttr1.toml")
//! }
//! ```
//!
//! and one in the crate, which then has a module `trttr1`:
//!
//! ```ignore
//! include!(concat!(env!("OUT_DIR"), "/trttr1.rs"));
//! ```
//!
//! The module has the robot's name in lower case; the file can be included under that name or under the name of the
//! robot file. Generated code calls the crate `robot_runtime`, which must be a dependency (with its feature `std` if
//! [`Builder::trigonometry`] chooses the standard library's sine and cosine). The file is written only if it
//! changes, and Cargo runs the build script again only if a robot file or its pinned plan has changed. [`Builder`] has
//! the options.
//!
//! The driver itself is pure: [`generate`] takes a text and returns a text. It does not access files, the environment
//! or the terminal, so the builder, the macro `include_robot!` and the command `robot-symbolic` generate the same
//! code for the same options and the same plan. Without a pinned plan the command searches for one, and the builder and
//! the macro take a default plan.

mod driver;
mod entry;
mod error;

pub use driver::angles::too_large_angle;
pub use driver::conventions::CONVENTIONS;
pub use driver::counted::{counted, search_code};
pub use driver::file::File;
pub use driver::generate::{Generated, generate, names};
#[cfg(feature = "languages")]
pub use driver::languages;
pub use driver::options::{
    Commands, DEFAULT_BATCH, DEFAULT_FUNCTIONS, Group, Kind, Limbs, OPTIONS, OptionSpec, Options,
    Value, functions_named, kinds_named,
};
pub use driver::pivots::{Pivot, Pivots};
pub use driver::problems::Problem;
pub use driver::programs::{Programs, planned, programs, programs_of, read, read_with};
pub use driver::singular::{Unsolvable, unsolvable};
pub use driver::snapping::{Snapping, snapping};
pub use driver::{ablation, budget, check, package, snapping};
pub use entry::builder::{Builder, compile};
pub use entry::files::{
    MARKER, Output, Ownership, Pending, Staleness, Writer, is_stream, remaining, sealed, staleness,
};
pub use entry::paths::{RobotFile, missing};
pub use entry::pin::{pin_path, pin_text, robot_inputs};
pub use entry::system::system_reason;
pub use error::{Error, Errors, shown};
pub use robot_codegen::backend::rust::{Names, check_runtime_path, identifier};
pub use robot_codegen::{Scalar, Trigonometry};
pub use robot_dynamics::economical::Plan;
pub use robot_model::diagnostic::{Source, visible};
pub use robot_model::functions::{
    self, ALL_FUNCTIONS, Bundle, Effects, FrameRef, FunctionKind, Functions, WrongName,
};
pub use robot_model::robot::{BaseFrames, Robot};
