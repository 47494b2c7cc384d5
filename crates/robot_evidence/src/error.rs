//! The errors in gathering evidence.

use std::path::PathBuf;

use robot_build::shown;

/// The reason why there is no evidence.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Errors in the robot file or in the options.
    #[error("{0}")]
    Robot(#[from] robot_build::Errors),
    /// The compiler cannot be started.
    #[error(
        "cannot start the compiler {}: {reason}; the generated code is compiled with `rustc`: \
         install Rust (https://rustup.rs), or set the compiler's path with the option `rustc` or \
         the variable RUSTC",
        shown(path)
    )]
    NoCompiler {
        /// The command.
        path: PathBuf,
        /// The message of the system.
        reason: String,
    },
    /// The program is not a Rust compiler.
    #[error(
        "{} is not a Rust compiler: asked for its version, it {answer}; set the compiler's path \
         with the option `rustc` or the variable RUSTC",
        shown(path)
    )]
    OtherProgram {
        /// The command.
        path: PathBuf,
        /// The exit status of the program and its first line.
        answer: String,
    },
    /// The compiler does not produce an object file, or not the requested one.
    #[error(
        "{} does not compile the generated code for {target}: {first}{}\n{messages}",
        shown(path), advice.as_ref().map(|advice| format!("; {advice}")).unwrap_or_default()
    )]
    Compiler {
        /// The compiler.
        path: PathBuf,
        /// The target.
        target: String,
        /// The first line of its error message.
        first: String,
        /// The remedy, if the cause is known.
        advice: Option<String>,
        /// The messages of the compiler.
        messages: String,
    },
    /// The folder for temporary files cannot be used.
    #[error("cannot write temporary files: {0}; set the variable TMPDIR to another folder")]
    Folder(#[from] std::io::Error),
    /// The object file is not as expected.
    #[error("cannot read the object file: {0}")]
    Object(String),
    /// The object file is for a processor whose instructions cannot be read.
    #[error(
        "cannot read instructions of {architecture}; x86-64 and Thumb (such as \
         thumbv7em-none-eabihf) are supported"
    )]
    Architecture {
        /// The architecture.
        architecture: String,
    },
}
