//! Evidence from the compiled form of generated code.
//!
//! [`prove`] compiles a robot's functions with the user's own `rustc`, in the way Cargo's profiles do, reads the
//! object file and compares it with the claim of the generator: **no conditional jump, no panic, and no call except
//! that of the sines and cosines**. Each violation of the claim is a [`Violation`].
//!
//! | | dev | release |
//! |---|---|---|
//! | generated code and the functions of `core` that it calls | flat | flat |
//! | the runtime's sines and cosines | a call that is not checked: it loops over the angles | flat |
//! | sines and cosines of the standard library | calls of `sin`, `cos` | calls of `sincos` or similar |
//! | copies of arrays | may call `memcpy` | none |
//! | zeros of large results, such as the regressor's | may call `memset` | may call `memset` |
//! | the choice between copies of a kernel, each for a different processor | one or two jumps on x86-64; each copy is flat | the same |
//! | batches, which take slices | shown, nothing claimed | a loop over the states, no panic |
//!
//! This is the only part of the project that starts another program. Everything except [`prove`] works on bytes:
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
pub use compile::{Compiler, Profile};
pub use error::Error;
pub use probe::{Probe, Root};

use object_file::Object;
use robot_build::budget::max_stack;
use robot_build::{Options, Programs, Source, names};

/// The functions of one object file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module {
    /// The profile under which it was compiled.
    pub profile: Profile,
    /// Each public function, in the order of the source.
    pub functions: Vec<Evidence>,
    /// The runtime's functions of sine and cosine that are in the object, whatever is claimed of
    /// them.
    pub trigonometry: Vec<Evidence>,
}

impl Module {
    /// Reads the functions `roots` of an object file.
    ///
    /// # Errors
    ///
    /// An object file that cannot be read or is for another processor; one without a root.
    pub fn read(bytes: &[u8], roots: &[Root], profile: Profile) -> Result<Module, Error> {
        let object = Object::parse(bytes)?;
        claim::module(&object, roots, profile)
    }

    /// Every violation of the claim, with the function it was found in.
    pub fn violations(&self) -> impl Iterator<Item = (&str, &Violation)> {
        self.functions.iter().flat_map(|function| {
            function.violations.iter().map(|violation| (function.name.as_str(), violation))
        })
    }
}

/// Compiles a robot's functions under each profile and reads what the compiler made of them.
///
/// # Errors
///
/// Everything that is wrong with the robot file or the options; no compiler, or one that refuses;
/// a processor that this crate cannot read.
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
            hold_stack(&mut module, &programs, options);
        }
        Ok(module)
    };
    profiles.iter().map(compiled).collect()
}

/// Holds the stack of each function against its budget.
fn hold_stack(module: &mut Module, programs: &Programs, options: &Options) {
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
