//! Errors of compilation.

use robot_codegen::Errors;

/// The reason why there is no machine code.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The processor does not have the registers for which code is made.
    #[error(
        "machine code needs {needed}, which this machine does not have; the interpreter computes the same results"
    )]
    Processor {
        /// The required processor and its extensions.
        needed: &'static str,
    },
    /// The options choose sines and cosines of the standard library.
    #[error(
        "machine code has only the polynomial sines and cosines; choose these, or use the interpreter, which has the \
         standard library's"
    )]
    Trigonometry,
    /// A function that was not compiled.
    #[error("function `{function}` was not compiled: name it in the options")]
    NotCompiled {
        /// The function.
        function: String,
    },
    /// A function that loads an entry that it does not declare.
    #[error(
        "function `{function}` loads an entry that it does not have; compile it from a specification"
    )]
    Load {
        /// The function.
        function: String,
    },
    /// A function whose values do not fit into 2 GiB.
    #[error("function `{function}` has {values} values, more than {most}; split it")]
    Size {
        /// The function.
        function: String,
        /// The number of its values.
        values: usize,
        /// The largest permitted number.
        most: usize,
    },
    /// A function whose values do not fit into the stack of a thread.
    #[error(
        "function `{function}` would take {bytes} bytes of the stack as machine code; the interpreter computes the same results"
    )]
    Stack {
        /// The function.
        function: String,
        /// The size of its stack, in bytes.
        bytes: u32,
    },
    /// An instruction that could not be encoded, which is a bug in this crate.
    #[error(
        "an instruction of function `{function}` has no encoding ({reason}); please report this"
    )]
    Encoding {
        /// The function.
        function: String,
        /// The message of the encoder.
        reason: String,
    },
    /// The system does not provide memory, or does not allow it to be executable.
    #[error(
        "the system provides no memory for code ({0}); the interpreter computes the same results"
    )]
    Memory(#[from] std::io::Error),
    /// Errors in the parameters, or an unknown function.
    #[error(transparent)]
    Module(#[from] Errors),
}
