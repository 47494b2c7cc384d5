//! What is said where code cannot be made as the mass matrix is singular in every posture.

use robot_codegen::Error as CodeError;
use robot_dynamics::functions::undetermined;
use robot_model::functions::{Bundle, FunctionKind};
use robot_model::robot::Robot;

use crate::error::{Error, Errors};

/// The errors of the code generator, with a division by zero told by its cause.
pub(crate) fn told(
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
