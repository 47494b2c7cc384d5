//! Why there is no evidence.

use std::path::PathBuf;

/// Why there is no evidence.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The robot file, or what was asked of it.
    #[error("{0}")]
    Robot(#[from] robot_build::Errors),
    /// No compiler.
    #[error(
        "cannot start the compiler {}: {reason}; prove compiles the generated code and needs `rustc`: \
         install Rust (https://rustup.rs), or name the compiler by --rustc or the variable RUSTC",
        path.display()
    )]
    NoCompiler {
        /// What was started.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A compiler that gives no object file.
    #[error(
        "{} refuses the generated code for {target}; a target is installed by `rustup target add`, and \
         one without a standard library needs the polynomials, `--trigonometry polynomial`:\n{messages}",
        path.display()
    )]
    Compiler {
        /// The compiler.
        path: PathBuf,
        /// The target.
        target: String,
        /// What it says.
        messages: String,
    },
    /// A folder for temporary files that cannot be used.
    #[error("cannot write temporary files: {0}; TMPDIR names another folder")]
    Folder(#[from] std::io::Error),
    /// What the compiler wrote is not what was expected.
    #[error("cannot read the object file: {0}")]
    Object(String),
    /// A processor whose instructions are not known here.
    #[error(
        "cannot read instructions of {architecture}; x86-64 and Thumb (such as thumbv7em-none-eabihf) are read"
    )]
    Architecture {
        /// The processor.
        architecture: String,
    },
}
