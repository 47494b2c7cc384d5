//! Errors of gathering evidence.

use std::path::PathBuf;

use robot_build::shown;

/// Why there is no evidence.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The robot file, or what was asked of it.
    #[error("{0}")]
    Robot(#[from] robot_build::Errors),
    /// No compiler.
    #[error(
        "cannot start the compiler {}: {reason}; the generated code is compiled with `rustc`: \
         install Rust (https://rustup.rs), or set the compiler's path with the option `rustc` or \
         the variable RUSTC",
        shown(path)
    )]
    NoCompiler {
        /// The command.
        path: PathBuf,
        /// The system's message.
        reason: String,
    },
    /// A program that is not a Rust compiler.
    #[error(
        "{} is not a Rust compiler: asked for its version, it {answer}; set the compiler's path \
         with the option `rustc` or the variable RUSTC",
        shown(path)
    )]
    OtherProgram {
        /// The command.
        path: PathBuf,
        /// Its exit, and its first line.
        answer: String,
    },
    /// A compiler that gives no object file, or not the one that was asked for.
    #[error(
        "{} does not compile the generated code for {target}: {first}{}\n{messages}",
        shown(path), advice.as_ref().map(|advice| format!("; {advice}")).unwrap_or_default()
    )]
    Compiler {
        /// The compiler.
        path: PathBuf,
        /// The target.
        target: String,
        /// The first line of what it says is wrong.
        first: String,
        /// The remedy, if the cause is known.
        advice: Option<String>,
        /// The compiler's message.
        messages: String,
    },
    /// A folder for temporary files that cannot be used.
    #[error("cannot write temporary files: {0}; set the variable TMPDIR to another folder")]
    Folder(#[from] std::io::Error),
    /// The compiler's output is not as expected.
    #[error("cannot read the object file: {0}")]
    Object(String),
    /// A processor whose instructions are not known here.
    #[error(
        "cannot read instructions of {architecture}; x86-64 and Thumb (such as \
         thumbv7em-none-eabihf) are supported"
    )]
    Architecture {
        /// The processor.
        architecture: String,
    },
}
