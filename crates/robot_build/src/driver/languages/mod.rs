//! Code in Rust and other languages: the source files of a module, and whole packages.

mod package;
mod printing;

use robot_codegen::Scalar;
use robot_codegen::backend::{self, Target};
pub use robot_codegen::backend::{Contents, SourceFile};
use robot_model::diagnostic::Source;

pub use self::package::{package, package_of};
use crate::driver::budget;
use crate::driver::options::Options;
use crate::driver::programs::{Programs, programs};
use crate::error::{Error, Errors};

/// A language of generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Language {
    /// Rust, with the runtime crate or a copy of it.
    #[default]
    Rust,
    /// C99: a header that needs only `<math.h>`.
    C,
    /// C++17: a header on top of the C header.
    Cpp,
    /// The C header as an Arduino library, in single precision.
    Arduino,
    /// CUDA C++: a header of functions for host and device, and kernels.
    Cuda,
    /// MATLAB and Octave: a folder of functions over columns of states.
    Matlab,
    /// Python: a module of numbers, or of NumPy arrays.
    Python,
    /// JavaScript: an ES module with TypeScript declarations.
    JavaScript,
    /// WebAssembly: a module with an ES module that loads it.
    Wasm,
    /// WGSL: WebGPU compute kernels, in single precision.
    Wgsl,
}

impl Language {
    /// All languages, in the order in which lists show them.
    pub const ALL: &'static [Language] = &[
        Language::Rust,
        Language::C,
        Language::Cpp,
        Language::Arduino,
        Language::Cuda,
        Language::Matlab,
        Language::Python,
        Language::JavaScript,
        Language::Wasm,
        Language::Wgsl,
    ];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::C => "c",
            Language::Cpp => "cpp",
            Language::Arduino => "arduino",
            Language::Cuda => "cuda",
            Language::Matlab => "matlab",
            Language::Python => "python",
            Language::JavaScript => "javascript",
            Language::Wasm => "wasm",
            Language::Wgsl => "wgsl",
        }
    }

    /// The description of the language in a list of languages.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Language::Rust => "Rust, also without the standard library",
            Language::C => "C99, one header",
            Language::Cpp => "C++17, a header with a namespace, on top of the C header",
            Language::Arduino => "C99 as an Arduino library, only in single precision",
            Language::Cuda => "CUDA C++, a header with a kernel for each function",
            Language::Matlab => "MATLAB and Octave, one file for each function",
            Language::Python => "Python, for numbers and for NumPy arrays",
            Language::JavaScript => "JavaScript, an ES module with TypeScript declarations",
            Language::Wasm => "WebAssembly, with an ES module that loads it",
            Language::Wgsl => "WGSL, WebGPU compute kernels, only in single precision",
        }
    }

    /// Finds the language with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Language> {
        Language::ALL.iter().copied().find(|language| language.name() == name)
    }
}

/// Generates the source files of a robot's module in a language, for use in a project of the user.
///
/// # Errors
///
/// All errors in the file or the options, and options that the language does not have.
pub fn sources(
    source: &Source,
    options: &Options,
    language: Language,
) -> Result<Vec<SourceFile>, Errors> {
    check(options, language)?;
    let programs = programs(source, options)?;
    budget::check(&programs, source, options)?;
    sources_of(&programs, source, options, language)
}

/// Does the same as [`sources`] for existing programs; budgets are not checked.
///
/// # Errors
///
/// Options that the language does not have, and numbers outside the range of single precision.
pub fn sources_of(
    programs: &Programs,
    source: &Source,
    options: &Options,
    language: Language,
) -> Result<Vec<SourceFile>, Errors> {
    check(options, language)?;
    let flat = || printing::flat_options(programs, source, options);
    let target: Box<dyn Target> = match language {
        Language::Rust => Box::new(printing::rust_options(programs, source, options)),
        Language::C => Box::new(backend::c::C { options: flat() }),
        Language::Arduino if options.scalar != Scalar::F32 => {
            let errors = robot_codegen::Error::Single { language: "the library of Arduino" };
            return Err(Errors::of_code(&source.name, &errors.into()));
        }
        Language::Arduino => Box::new(backend::c::C { options: flat() }),
        Language::Cpp => Box::new(backend::c::Cpp { options: flat() }),
        Language::Cuda => Box::new(backend::c::Cuda { options: flat() }),
        Language::Matlab => Box::new(backend::matlab::Matlab { options: flat() }),
        Language::Python => Box::new(backend::python::Python { options: flat() }),
        Language::JavaScript => Box::new(backend::javascript::JavaScript { options: flat() }),
        Language::Wasm => Box::new(backend::wasm::Wasm { options: flat(), batch: true }),
        Language::Wgsl => Box::new(backend::wgsl::Wgsl { options: flat() }),
    };
    let module = match language {
        Language::Rust => programs.module.clone(),
        _ => printing::described(programs),
    };
    target.files(&module).map_err(|errors| Errors::of_code(&source.name, &errors))
}

/// Returns an error for each option that only Rust supports, if the language is another one.
fn check(options: &Options, language: Language) -> Result<(), Errors> {
    let usual = Options::default();
    let of_rust = [
        ("generic", options.generic),
        ("batch", options.batch.is_some()),
        ("parallel", options.parallel),
        ("runtime", options.runtime != usual.runtime),
    ];
    let given = of_rust.into_iter().filter(|(_, given)| language != Language::Rust && *given);
    let errors = given.map(|(option, _)| Error::OfRust { option, language: language.name() });
    Errors::check(errors.collect(), ())
}
