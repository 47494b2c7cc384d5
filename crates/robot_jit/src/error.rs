//! What may go wrong before there is code.

use robot_codegen::Errors;

/// Why there is no code.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The processor has no registers that code is made for.
    #[error(
        "machine code needs {needed}, which this machine does not have; the interpreter computes the same"
    )]
    Processor {
        /// The processor, and its extensions.
        needed: &'static str,
    },
    /// Sines and cosines of the standard library.
    #[error(
        "machine code has only the polynomial sines and cosines; the interpreter has the standard library's"
    )]
    Trigonometry,
    /// A function that was left out.
    #[error("function `{function}` was not compiled: name it in the options")]
    NotCompiled {
        /// The function.
        function: String,
    },
    /// A function that loads what it does not declare.
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
        /// The most that there may be.
        most: usize,
    },
    /// A function whose values do not fit into the stack of a thread.
    #[error(
        "function `{function}` would take {bytes} bytes of the stack as machine code; the interpreter computes the same"
    )]
    Stack {
        /// The function.
        function: String,
        /// The bytes.
        bytes: u32,
    },
    /// An instruction that could not be encoded: a fault of this crate.
    #[error(
        "an instruction of function `{function}` has no encoding ({reason}); please report this"
    )]
    Encoding {
        /// The function.
        function: String,
        /// What the encoder says.
        reason: String,
    },
    /// Memory that the system does not give, or not for code.
    #[error("the system provides no memory for code ({0}); the interpreter computes the same")]
    Memory(#[from] std::io::Error),
    /// What is wrong with the parameters, or an unknown function.
    #[error(transparent)]
    Module(#[from] Errors),
}
