//! Robots whose mass matrix is singular in every configuration: the functions that they do not have, and the message.

use std::fmt;

use robot_codegen::Error as CodeError;
use robot_dynamics::functions::undetermined;
use robot_model::functions::{Bundle, Effects, FunctionKind, Functions};
use robot_model::robot::Robot;

use crate::driver::options::Options;
use crate::driver::programs::programs_of;
use crate::error::{Error, Errors, quoted};

/// The functions that a robot does not have because its mass matrix is singular in every configuration, for all values
/// of its parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsolvable {
    /// The missing functions, which solve with the mass matrix.
    pub functions: Vec<FunctionKind>,
    /// The joints whose accelerations no joint torques determine.
    pub joints: Vec<String>,
}

/// Prints the missing functions and the reason on one line.
impl fmt::Display for Unsolvable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = self.functions.iter().map(|kind| kind.name()).collect();
        write!(
            formatter,
            "the robot has no {}: the mass matrix is singular in every configuration, and the joint \
             torques do not determine the accelerations of {}",
            names.join(", "),
            quoted(&self.joints)
        )
    }
}

/// Finds the functions that a robot does not have because its mass matrix is singular in every configuration; `None` if
/// it is not.
#[must_use]
pub fn unsolvable(robot: &Robot, options: &Options) -> Option<Unsolvable> {
    // At the nominal values it could be singular by chance, so the derivation decides.
    if undetermined(robot).is_empty() {
        return None;
    }
    let functions = Functions::Chosen(vec![FunctionKind::ForwardDynamics(Effects::NONE)]);
    let (bundles, search) = (vec![], false);
    let options = Options { functions, bundles, search, ..options.clone() };
    let errors = programs_of(robot.clone(), &robot.name, &options).err()?;
    let joints = errors.as_slice().iter().find_map(|error| match error {
        Error::Singular { joints, .. } => Some(joints.clone()),
        _ => None,
    })?;
    let mut functions = FunctionKind::of_robot(robot);
    functions.retain(|kind| kind.divides_by_mass_matrix());
    Some(Unsolvable { functions, joints })
}

/// Converts errors of the code generator; a division by zero is explained by its cause.
pub(crate) fn by_cause(
    name: &str,
    robot: &Robot,
    functions: &[FunctionKind],
    bundles: &[Bundle],
    errors: &robot_codegen::Errors,
) -> Errors {
    let mut all = functions.iter().chain(bundles.iter().flat_map(|bundle| &bundle.functions));
    let divides = all.any(|kind| kind.divides_by_mass_matrix());
    let infinite = |error: &CodeError| matches!(error, CodeError::NotFinite { .. });
    if !divides || !errors.as_slice().iter().any(infinite) {
        return Errors::of_code(name, errors);
    }
    let joint = |index: &usize| Some(robot.coordinates.get(*index)?.joint.clone());
    let joints: Vec<String> = undetermined(robot).iter().filter_map(joint).collect();
    if joints.is_empty() {
        return Errors::of_code(name, errors);
    }
    Errors::from(Error::Singular { name: name.to_owned(), joints })
}
