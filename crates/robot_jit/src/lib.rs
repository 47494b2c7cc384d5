//! Straight-line programs as machine code in memory.
//!
//! [`compile`] makes code for the functions of a module, for one state and for several states in the lanes of
//! vector registers. It takes between a tenth of a millisecond and, for the longest functions, about twenty
//! milliseconds. A [`Function`] is called like the interpreter's [`Callable`](robot_codegen::Callable) and returns the
//! same bits, with two exceptions: multiply-adds of the program round once, as in code compiled for the processor, and
//! so do those in sines and cosines if [`Options::fused`] is set; and NaN can have other bits.
//!
//! The code is for x86-64 with AVX2 and FMA, or with AVX-512 F, DQ and VL, chosen at run time; for 64-bit ARM,
//! cranelift makes the code. On other processors [`compile`] returns an error, and an [`Executable`] uses the
//! interpreter.

mod compiled;
mod cranelift;
mod emit;
mod error;
mod executable;
mod list;
mod memory;
mod processor;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

pub use compiled::{Compiled, Function, Options, compile, compile_owned, compile_with};
pub use error::Error;
pub use executable::{Executable, Handle};
pub use processor::Registers;
