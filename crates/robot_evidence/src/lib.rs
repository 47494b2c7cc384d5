//! Evidence from the compiled form of generated code.
//!
//! [`prove`] compiles a robot's functions with the user's own `rustc`, in the way Cargo's profiles do, reads the
//! object file and compares it with the claim of the generator: **no conditional jump, no panic, and no call except
//! that of the sines and cosines**. The jumps by which a function chooses its copy for the processor are counted
//! apart. Each violation of the claim is a [`Violation`].
//!
//! | | dev | release |
//! |---|---|---|
//! | generated code and the functions of `core` that it calls | flat | flat |
//! | the runtime's sines and cosines | a call that is not checked: it loops over the angles | flat |
//! | sines and cosines of the standard library | calls of `sin`, `cos` | calls of `sincos` or similar |
//! | copies of arrays | may call `memcpy` | none |
//! | zeros of large results, such as the regressor's | may call `memset` | may call `memset` |
//! | the choice between copies of a kernel, each for a different processor | one or two jumps on x86-64; each copy is flat | the same |
//! | functions of several states: batches, columns, blocks | shown, nothing claimed | a loop over the states, no panic |
//!
//! Apart from `robot_languages`, which tests code in other languages, this is the only crate that starts another
//! program. Everything except [`prove`] and [`Compiler`] works on bytes:
//! [`Module::read`] reads an object file from any source.

mod claim;
mod compile;
mod error;
mod listing;
mod object_file;
mod probe;
mod thumb;
mod x86;

pub use claim::{Evidence, Measurements, Violation};
pub use compile::{Compiler, Profile, remove_temporary_folders};
pub use error::Error;
pub use probe::{Probe, Root};

use object_file::Object;
use robot_build::budget::max_stack;
use robot_build::{Options, Programs, Source, names};

/// The evidence about the functions of one object file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module {
    /// The profile under which it was compiled.
    pub profile: Profile,
    /// The evidence about each public function, in the order of the source.
    pub functions: Vec<Evidence>,
    /// The evidence about the runtime's functions for sines and cosines in the object file; nothing is claimed about
    /// them.
    pub trigonometry: Vec<Evidence>,
}

impl Module {
    /// Reads the functions `roots` of an object file.
    ///
    /// # Errors
    ///
    /// If the object file cannot be read, is for an unsupported processor, or does not contain exactly these functions.
    pub fn read(bytes: &[u8], roots: &[Root], profile: Profile) -> Result<Module, Error> {
        let object = Object::parse(bytes)?;
        claim::module(&object, roots, profile)
    }

    /// All violations of the claim, with the names of the functions in which they were found.
    pub fn violations(&self) -> impl Iterator<Item = (&str, &Violation)> {
        self.functions.iter().flat_map(|function| {
            function.violations.iter().map(|violation| (function.name.as_str(), violation))
        })
    }
}

/// Compiles the functions of a robot under each profile and examines the compiled code.
///
/// # Errors
///
/// All errors in the robot file or the options; a missing or failing compiler; a processor whose code cannot be read.
pub fn prove(
    source: &Source,
    options: &Options,
    compiler: &Compiler,
    profiles: &[Profile],
) -> Result<Vec<Module>, Error> {
    let programs = robot_build::programs(source, options)?;
    let probe = Probe::new(&programs, source, options)?;
    let compiled = |profile: &Profile| {
        let object = compiler.compile(&probe, *profile)?;
        let mut module = Module::read(&object, &probe.roots, *profile)?;
        if *profile == Profile::Release {
            check_stack(&mut module, &programs, options);
        }
        Ok(module)
    };
    profiles.iter().map(compiled).collect()
}

/// Compares the stack of each function with its budget.
fn check_stack(module: &mut Module, programs: &Programs, options: &Options) {
    for (function, name) in programs.module.functions.iter().zip(names(programs).functions) {
        let limit = max_stack(programs, options, &function.name);
        let path = format!("Model::{name}");
        let found = module.functions.iter_mut().find(|found| found.name == path);
        if let (Some(limit), Some(found)) = (limit, found)
            && found.measurements.stack > limit
        {
            found.violations.push(Violation::Stack { bytes: found.measurements.stack, limit });
        }
    }
}
