//! Straight-line programs as machine code in memory.
//!
//! [`compile`] makes code of the functions of a module, for one state and for several side by side in the lanes of
//! vector registers, in a tenth of a millisecond to some twenty for the longest. A [`Function`] is called as the
//! interpreter's [`Callable`](robot_codegen::Callable) is, and gives its bits, but for two things: a multiply-add of the
//! program rounds once, as in code that is compiled for the processor, and those of sines if [`Options::fused`] asks for
//! it; and a NaN may have other bits.
//!
//! For x86-64 with AVX2 and FMA, or AVX-512 F, DQ and VL, chosen when it runs; for a 64-bit ARM by cranelift. Elsewhere
//! there is an error; an [`Executable`] then runs the interpreter.

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
