//! What is generated, and how.

use robot_codegen::backend::rust::{RustOptions, Scalar};
use robot_codegen::{Cost, Fused, Trigonometry};
use robot_dynamics::economical::Plan;
use robot_dynamics::functions::FunctionKind;
use robot_dynamics::mechanism::MechanismOptions;
use robot_dynamics::model::Robot;

use crate::error::{Error, Errors};

/// The functions that are generated where none are chosen, as far as the robot has them.
pub const DEFAULT_FUNCTIONS: [FunctionKind; 5] = [
    FunctionKind::InverseDynamics,
    FunctionKind::InverseDynamicsWrench,
    FunctionKind::InverseDynamicsFriction,
    FunctionKind::InverseDynamicsWrenchFriction,
    FunctionKind::LinkWrenches,
];

/// The word for all functions where functions are named.
pub const ALL_FUNCTIONS: &str = "all";

/// The states that a block of a batch holds where no other number is given: two or four vector
/// registers of `f64` on most processors.
pub const DEFAULT_BATCH: usize = 8;

/// The most states that a block of a batch holds: its arrays lie on the stack.
const MAX_BATCH: usize = 64;

/// Which functions are generated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Functions {
    /// Those of [`DEFAULT_FUNCTIONS`] that the robot has.
    #[default]
    Usual,
    /// All that the robot has.
    All,
    /// These; one that the robot lacks is an error.
    Chosen(Vec<FunctionKind>),
}

/// What is generated, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The functions.
    pub functions: Functions,
    /// The number type of the functions.
    pub scalar: Scalar,
    /// Whether each function has a second form `…_generic` over any `Scalar` of the runtime: `f64`,
    /// `f32` and lanes of either.
    pub generic: bool,
    /// The number of states in a block of the forms `…_batch` over slices of states; `None` for no
    /// such forms.
    pub batch: Option<usize>,
    /// Whether each batch has a form `…_batch_parallel` too, over the threads of the crate `rayon`: a
    /// dependency of the crate around the code, an optional one of a whole generated crate.
    pub parallel: bool,
    /// Whether products and sums become multiply-adds, which round once on a target that has the
    /// instruction (the runtime's `FUSED`) and are a product and a sum elsewhere. Without this the
    /// code gives the same bits on every target.
    pub fused: bool,
    /// Where sines and cosines come from.
    pub trigonometry: Trigonometry,
    /// Constant angles within this many radians of a multiple of π/2 become that multiple; `None`
    /// for what the robot file says, which is 10⁻⁹ where it says nothing.
    pub snap: Option<f64>,
    /// The path of the runtime crate or module in generated code.
    pub runtime: String,
    /// The form of the economical recursion; `None` for one that suits most arms, or is searched.
    pub plan: Option<Plan>,
    /// The most operations that a call of any of the functions may take; those of the robot file's
    /// budgets hold beside it.
    pub max_operations: Option<u64>,
    /// The most bytes of stack that a call of any of the functions may take, as
    /// [`budget`](crate::budget) estimates it.
    pub max_stack: Option<u64>,
    /// Whether to search the cheapest form where none is given: a second or so for an arm of seven
    /// joints in an optimised build, and tens of seconds in a build script, which is not.
    pub search: bool,
}

/// The usual functions at one state, `f64`, plain operations, the standard library's sine and cosine,
/// angles snapped within 10⁻⁹ rad.
impl Default for Options {
    fn default() -> Options {
        let rust = RustOptions::default();
        Options {
            functions: Functions::Usual,
            scalar: rust.scalar,
            generic: rust.generic,
            batch: rust.batch,
            parallel: false,
            fused: false,
            trigonometry: rust.trigonometry,
            snap: None,
            runtime: rust.runtime,
            plan: None,
            max_operations: None,
            max_stack: None,
            search: false,
        }
    }
}

impl Options {
    /// The functions to generate for a robot.
    ///
    /// # Errors
    ///
    /// Each chosen function that the robot lacks, with the reason.
    pub(crate) fn functions_of(&self, robot: &Robot) -> Result<Vec<FunctionKind>, Errors> {
        let chosen = match &self.functions {
            Functions::Usual => {
                let usual = DEFAULT_FUNCTIONS.into_iter();
                return Ok(usual.filter(|kind| kind.missing_in(robot).is_none()).collect());
            }
            Functions::All => return Ok(FunctionKind::of(robot)),
            Functions::Chosen(chosen) => chosen,
        };
        let missing = chosen.iter().filter_map(|kind| {
            let why = kind.missing_in(robot)?;
            Some(Error::MissingFunction { function: kind.name(), robot: robot.name.clone(), why })
        });
        Errors::check(missing.collect(), ())?;
        let mut functions: Vec<FunctionKind> = vec![];
        for kind in chosen {
            if !functions.contains(kind) {
                functions.push(*kind);
            }
        }
        Ok(functions)
    }

    /// What is wrong with the figures among the options.
    pub(crate) fn check(&self) -> Result<(), Errors> {
        let mut errors = vec![];
        let possible = 0.0..=MechanismOptions::MAX_SNAP;
        if let Some(snap) = self.snap.filter(|snap| !possible.contains(snap)) {
            errors.push(Error::Snap { snap: snap.to_string() });
        }
        if let Some(states) = self.batch.filter(|states| !(1..=MAX_BATCH).contains(states)) {
            errors.push(Error::Batch { states, most: MAX_BATCH });
        }
        if self.parallel && self.batch.is_none() {
            errors.push(Error::ParallelWithoutBatch);
        }
        Errors::check(errors, ())
    }

    /// How expressions become programs.
    pub(crate) fn codegen(&self) -> robot_codegen::Options {
        let options = robot_codegen::Options::default();
        if self.fused {
            robot_codegen::Options {
                fused: Fused::WhereTarget,
                cost: Cost::Instructions,
                ..options
            }
        } else {
            options
        }
    }

    /// How the robot becomes expressions.
    pub(crate) fn mechanism(&self, robot: &Robot) -> MechanismOptions {
        MechanismOptions::ROUNDED.with_snap(self.snap, robot)
    }
}

/// The functions of those names; [`ALL_FUNCTIONS`] among them means all.
///
/// # Errors
///
/// Each name that is no function's, and an empty list.
pub(crate) fn functions_named(names: &[String]) -> Result<Functions, Errors> {
    if names.is_empty() {
        return Err(Errors::from(Error::NoFunctions));
    }
    let (mut kinds, mut errors) = (vec![], vec![]);
    for name in names {
        match FunctionKind::from_name(name) {
            Some(kind) => kinds.push(kind),
            None if name == ALL_FUNCTIONS => {}
            None => errors.push(Error::UnknownFunction { function: name.clone() }),
        }
    }
    let all = names.iter().any(|name| name == ALL_FUNCTIONS);
    Errors::check(errors, if all { Functions::All } else { Functions::Chosen(kinds) })
}
