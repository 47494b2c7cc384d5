//! Straight-line programs as machine code in memory.
//!
//! [`compile`] makes code for the functions of a module, for one state and for several side by side in the lanes of
//! vector registers, in a tenth of a millisecond to about twenty milliseconds for the longest. A [`Function`] is
//! called like the interpreter's [`Callable`](robot_codegen::Callable) and gives the same bits, with two exceptions:
//! a multiply-add of the program rounds once, as in code compiled for the processor, as do those in sines if
//! [`Options::fused`] asks for it; and a NaN may have other bits.
//!
//! The code is for x86-64 with AVX2 and FMA, or with AVX-512 F, DQ and VL, chosen at run time, and by cranelift for 64-bit
//! ARM. On other processors [`compile`] returns an error; an [`Executable`] then runs the interpreter.

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
