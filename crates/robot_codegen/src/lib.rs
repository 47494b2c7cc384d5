//! Straight-line programs from expressions, and the source code that is printed from them.
//!
//! A [`ModuleSpec`] names expressions over parameters and inputs; [`Module::compile`] turns it into
//! straight-line [`Program`]s, the [`interpreter`] runs them and a [`backend`] prints them.

pub mod backend;
pub mod code_size;
mod cost;
pub mod counts;
mod error;
pub mod interpreter;
pub mod limbs;
mod lower;
pub mod module;
pub mod passes;
pub mod program;
mod rounding;
pub mod spec;
mod stage;
mod trigonometry;

pub use backend::common::Scalar;
pub use code_size::CodeSize;
pub use cost::Cost;
pub use counts::{Counts, FunctionCounts, PassCounts};
pub use error::{Error, Errors};
pub use interpreter::{Callable, Interpreter, OutputValues};
pub use limbs::{LimbKind, Limbs};
pub use module::Module;
pub use passes::{Fused, Options, Resubstitution, Schedule};
pub use program::Program;
pub use rounding::Rounded;
pub use spec::{Function, Input, ModuleSpec, Output, ParameterSpec};
pub use trigonometry::Trigonometry;
