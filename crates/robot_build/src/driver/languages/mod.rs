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
use crate::driver::programs::Programs;
use crate::error::{Error, Errors};

/// Declares the languages, each in one place: its variant, its name on the command line, and its description in a list.
macro_rules! languages {
    ($($(#[$attribute:meta])* $variant:ident, $name:literal, $title:literal;)*) => {
        /// A language of generated code.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Language {
            $($(#[$attribute])* $variant,)*
        }

        impl Language {
            /// All languages, in the order in which lists show them.
            pub const ALL: &'static [Language] = &[$(Language::$variant,)*];

            /// The name on the command line.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Language::$variant => $name,)*
                }
            }

            /// The description of the language in a list of languages.
            #[must_use]
            pub fn title(self) -> &'static str {
                match self {
                    $(Language::$variant => $title,)*
                }
            }
        }
    };
}

languages! {
    /// Rust, with the runtime crate or a copy of it.
    #[default]
    Rust, "rust", "Rust, also without the standard library";
    /// C99: a header that needs only `<math.h>`.
    C, "c", "C99, one header";
    /// C++17: a header on top of the C header.
    Cpp, "cpp", "C++17, a header with a namespace, on top of the C header";
    /// The C header as an Arduino library, in single precision.
    Arduino, "arduino", "C99 as an Arduino library, only in single precision";
    /// CUDA C++: a header of functions for host and device, and kernels.
    Cuda, "cuda", "CUDA C++, a header with a kernel for each function";
    /// MATLAB and Octave: a folder of functions over columns of states.
    Matlab, "matlab", "MATLAB and Octave, one file for each function";
    /// Python: a module of numbers, or of NumPy arrays.
    Python, "python", "Python, for numbers and for NumPy arrays";
    /// JavaScript: an ES module with TypeScript declarations.
    JavaScript, "javascript", "JavaScript, an ES module with TypeScript declarations";
    /// WebAssembly: a module with an ES module that loads it.
    Wasm, "wasm", "WebAssembly, with an ES module that loads it";
    /// WGSL: WebGPU compute kernels, in single precision.
    Wgsl, "wgsl", "WGSL, WebGPU compute kernels, only in single precision";
}

impl Language {
    /// Finds the language with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Language> {
        Language::ALL.iter().copied().find(|language| language.name() == name)
    }

    /// Whether code in the language multiplies and adds in one instruction if the processor has it.
    #[must_use]
    pub fn has_multiply_add(self) -> bool {
        match self {
            Language::Rust
            | Language::C
            | Language::Arduino
            | Language::Cpp
            | Language::Cuda
            | Language::Wgsl => true,
            Language::Matlab | Language::Python | Language::JavaScript | Language::Wasm => false,
        }
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
    let programs = budget::programs(source, options)?;
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
        Language::Arduino => Box::new(backend::c::Arduino { options: flat() }),
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
