//! What is generated, and how.

use robot_codegen::Trigonometry;
use robot_codegen::backend::rust::{RustOptions, Scalar};
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

/// What is generated, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The functions; `None` for those of [`DEFAULT_FUNCTIONS`] that the robot has.
    pub functions: Option<Vec<FunctionKind>>,
    /// The number type of the functions.
    pub scalar: Scalar,
    /// Where sines and cosines come from.
    pub trigonometry: Trigonometry,
    /// Constant angles within this many radians of a multiple of π/2 become that multiple.
    pub snap: f64,
    /// The path of the runtime crate or module in generated code.
    pub runtime: String,
    /// The form of the economical recursion; `None` for one that suits most arms, or is searched.
    pub plan: Option<Plan>,
    /// Whether to search the cheapest form where none is given: a second or so for an arm of seven
    /// joints in an optimised build, and tens of seconds in a build script, which is not.
    pub search: bool,
}

/// All functions, `f64`, the standard library's sine and cosine, angles snapped within 10⁻⁹ rad.
impl Default for Options {
    fn default() -> Options {
        let rust = RustOptions::default();
        Options {
            functions: None,
            scalar: rust.scalar,
            trigonometry: rust.trigonometry,
            snap: MechanismOptions::SNAP,
            runtime: rust.runtime,
            plan: None,
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
        let Some(chosen) = &self.functions else {
            let all = DEFAULT_FUNCTIONS.into_iter();
            return Ok(all.filter(|kind| kind.missing_in(robot).is_none()).collect());
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

    /// How the robot becomes expressions.
    pub(crate) fn mechanism(&self) -> MechanismOptions {
        MechanismOptions { snap: self.snap, ..MechanismOptions::ROUNDED }
    }
}

/// The functions of those names.
///
/// # Errors
///
/// Each name that is no function's, and an empty list.
pub(crate) fn functions_named(names: &[String]) -> Result<Vec<FunctionKind>, Errors> {
    if names.is_empty() {
        return Err(Errors::from(Error::NoFunctions));
    }
    let (mut kinds, mut errors) = (vec![], vec![]);
    for name in names {
        match FunctionKind::from_name(name) {
            Some(kind) => kinds.push(kind),
            None => errors.push(Error::UnknownFunction { function: name.clone() }),
        }
    }
    Errors::check(errors, kinds)
}
