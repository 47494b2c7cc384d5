//! The weight's share in the driving forces.

use super::{Derivation, Function, FunctionKind};

/// g(q).
pub(super) fn gravity<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let torques = match &derivation.recursion {
        Some(recursion) => recursion.gravity(),
        None => derivation.paper_torques(false, &["qd", "qdd"]),
    };
    Function {
        kind: FunctionKind::Gravity,
        doc: vec![
            "The driving forces that hold the robot at rest against its weight, g(q): the gradient \
             of the potential energy."
                .to_owned(),
        ],
        inputs: derivation.coordinate_inputs(["q"]),
        outputs: vec![derivation.torque_output(torques)],
    }
}
