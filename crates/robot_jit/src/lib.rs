//! Straight-line programs as machine code in memory.
//!
//! [`compile`] makes code of the functions of a module, for one state and for several side by side in the lanes of
//! vector registers, in a tenth of a millisecond to two. A [`Function`] is called as the interpreter's
//! [`Callable`](robot_codegen::Callable) is, and gives its bits, but for two things: a multiply-add of the program
//! rounds once, as in code that is compiled for the processor, and a NaN may have other bits.
//!
//! For x86-64 with AVX2 and FMA, or AVX-512 F, DQ and VL, chosen when it runs. Elsewhere there is an error, and the
//! interpreter does the same: [`Engine`] takes whichever of the two there is.

mod compiled;
mod emit;
mod engine;
mod error;
mod list;
mod memory;
mod processor;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

pub use compiled::{Compiled, Function, Options, compile, compile_owned, compile_with};
pub use engine::{Engine, Handle};
pub use error::Error;
pub use processor::Registers;
