//! The gravity terms of the joint torques.

use robot_model::variable::JointVariable;

use super::{Derivation, Function, FunctionKind};

/// The function for the gravity terms g(q).
pub(super) fn gravity<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let torques = match &derivation.recursion {
        Some(recursion) => recursion.gravity(),
        None => {
            derivation.paper_torques(false, &[JointVariable::Velocity, JointVariable::Acceleration])
        }
    };
    derivation.of_kind(
        FunctionKind::Gravity,
        &["The gravity terms g(q): the joint torques that hold the robot at rest against \
            gravity, the gradient of the potential energy."],
        vec![derivation.torque_output(torques)],
    )
}
