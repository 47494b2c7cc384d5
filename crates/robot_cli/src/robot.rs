//! The robot file of a command, and how code is made of it.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::{
    ALL_FUNCTIONS, DEFAULT_BATCH, FunctionKind, Functions, Options, RobotFile, Scalar, Source,
    Trigonometry,
};
use robot_dynamics::description::Described;

use crate::Terminal;
use crate::failure::Failure;
use crate::text;

/// The robot file.
#[derive(Args)]
pub(crate) struct RobotArgument {
    /// The robot file
    file: PathBuf,
    /// Constant angles this near to a multiple of π/2, in radians, become that multiple; without this
    /// what the robot file says, or 1e-9
    #[arg(long, value_name = "RAD")]
    snap: Option<f64>,
}

impl RobotArgument {
    /// The text of the file.
    pub(crate) fn source(&self) -> Result<Source, Failure> {
        Ok(RobotFile::read(&self.file)?.source)
    }

    /// The robot; warnings are shown.
    pub(crate) fn read(&self, terminal: &mut Terminal<'_>) -> Result<Described, Failure> {
        let described = robot_build::read(&self.source()?)?;
        text::warnings(&described.warnings, terminal)?;
        Ok(described)
    }

    /// The snapping tolerance, rad, where one is given.
    pub(crate) fn snap(&self) -> Option<f64> {
        self.snap
    }

    /// The default options with the snapping tolerance and the pinned plan; where none is pinned,
    /// the cheapest form is searched.
    pub(crate) fn options(&self) -> Result<Options, Failure> {
        let options = Options { snap: self.snap, search: true, ..Options::default() };
        Ok(RobotFile::read(&self.file)?.with_pin(&options)?)
    }

    /// The path of the file.
    pub(crate) fn path(&self) -> &std::path::Path {
        &self.file
    }
}

/// What code is made.
#[derive(Args)]
pub(crate) struct CodeArguments {
    /// Functions to generate, several with commas between; `all` for all that the robot has. Without
    /// this inverse dynamics in its forms and the wrenches in the joints
    #[arg(long = "function", value_name = "NAME", value_delimiter = ',')]
    functions: Vec<String>,
    /// The number type of the functions
    #[arg(long, value_enum, default_value_t = ScalarName::F64)]
    scalar: ScalarName,
    /// Add to each function a form `…_generic` over any scalar of the runtime: f64, f32 and lanes
    #[arg(long)]
    generic: bool,
    /// Add to each function a form `…_batch` over slices of states, computed in blocks of so many
    #[arg(long, value_name = "STATES", require_equals = true)]
    batch: Option<Option<usize>>,
    /// Add to each batch a form `…_batch_parallel` over the threads of the crate rayon
    #[arg(long, requires = "batch")]
    parallel: bool,
    /// Multiply and add in one instruction where the target has it: it rounds once
    #[arg(long)]
    fused: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum ScalarName {
    F64,
    F32,
}

/// Where sines and cosines come from.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum TrigonometryName {
    /// The standard library
    Standard,
    /// The runtime's branch-free polynomials
    Polynomial,
}

impl From<TrigonometryName> for Trigonometry {
    fn from(name: TrigonometryName) -> Trigonometry {
        match name {
            TrigonometryName::Standard => Trigonometry::Standard,
            TrigonometryName::Polynomial => Trigonometry::Polynomial,
        }
    }
}

impl CodeArguments {
    /// The options for code.
    pub(crate) fn options(
        &self,
        robot: &RobotArgument,
        trigonometry: TrigonometryName,
    ) -> Result<Options, Failure> {
        let scalar = match self.scalar {
            ScalarName::F64 => Scalar::F64,
            ScalarName::F32 => Scalar::F32,
        };
        let functions = match self.functions.as_slice() {
            [] => Functions::Usual,
            names => functions(names)?,
        };
        let &CodeArguments { generic, batch, parallel, fused, .. } = self;
        let batch = batch.map(|states| states.unwrap_or(DEFAULT_BATCH));
        let trigonometry = trigonometry.into();
        Ok(Options {
            functions,
            scalar,
            generic,
            batch,
            parallel,
            fused,
            trigonometry,
            ..robot.options()?
        })
    }
}

/// The functions of those names.
pub(crate) fn functions(names: &[String]) -> Result<Functions, Failure> {
    let (mut kinds, mut wrong) = (vec![], vec![]);
    for name in names.iter().filter(|name| *name != ALL_FUNCTIONS) {
        match FunctionKind::from_name(name) {
            Some(kind) => kinds.push(kind),
            None => wrong.push(unknown_function(name, &[ALL_FUNCTIONS])),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Usage(wrong));
    }
    let all = names.iter().any(|name| name == ALL_FUNCTIONS);
    Ok(if all { Functions::All } else { Functions::Chosen(kinds) })
}

/// What is said of a name that is no function's nor one of some further words.
pub(crate) fn unknown_function(name: &str, more: &[&str]) -> String {
    let known: Vec<&str> = FunctionKind::ALL.iter().map(|kind| kind.name()).collect();
    text::unknown("function", name, &[&known[..], more].concat())
}
