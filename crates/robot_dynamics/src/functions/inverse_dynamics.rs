//! Inverse dynamics, with and without wrenches and friction, and the wrenches that the joints transmit.

use robot_model::variable::JointVariable;
use robot_symbolic::Expr;

use super::{Derivation, Effects, Function, FunctionKind, Output};
use crate::mechanism::Mechanism;
use crate::newton_euler::{self, NewtonEuler};
use crate::vector::Vector;

/// The function for the joint torques Q, equation (3).
pub(super) fn inverse_dynamics<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Function<'g> {
    let Effects { wrench, friction } = kind.effects();
    let friction_doc = match friction {
        true => "Includes joint friction, viscous and dry.",
        false => "Without friction.",
    };
    let sum_doc = match wrench {
        true => {
            "Inverse dynamics: the joint torques τ (generalized forces Q) that produce the \
             accelerations `qdd`: M q̈ + C q̇ + g, plus the torques for the wrenches that the \
             tips exert."
        }
        false => {
            "Inverse dynamics: the joint torques τ (generalized forces Q) that produce the \
             accelerations `qdd`: M q̈ + C q̇ + g."
        }
    };
    let doc = [sum_doc, friction_doc];
    let tau = derivation.torque_output(joint_torques(derivation, wrench, friction));
    derivation.of_kind(kind, &doc, vec![tau])
}

/// The bias torques C(q, q̇) q̇ + g(q).
pub(super) fn bias_torques<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    match &derivation.recursion {
        Some(recursion) => recursion.bias(false),
        None => derivation.paper_torques(false, &[JointVariable::Acceleration]),
    }
}

/// The function [`FunctionKind::Bias`].
pub(super) fn bias<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let torques = bias_torques(derivation);
    derivation.of_kind(
        FunctionKind::Bias,
        &["The bias torques C(q, q̇) q̇ + g(q): the joint torques at zero acceleration, for \
            Coriolis, centrifugal and gravity terms. Without wrenches and friction."],
        vec![derivation.torque_output(torques)],
    )
}

/// The joint torques Q by the economical recursion, plus friction.
fn joint_torques<'g>(
    derivation: &Derivation<'_, 'g>,
    wrench: bool,
    friction: bool,
) -> Vec<Expr<'g>> {
    let mechanism = &derivation.mechanism;
    let iterations = |friction| newton_euler::newton_euler(mechanism, Effects { wrench, friction });
    let Some(recursion) = &derivation.recursion else {
        return iterations(friction).joint_torques;
    };
    let mut forces = recursion.inverse_dynamics(wrench);
    if friction {
        for (force, contribution) in forces.iter_mut().zip(friction_forces(mechanism, wrench)) {
            *force += contribution;
        }
    }
    forces
}

/// The friction torques Q_f, equations (4) and (5), for the symbols of q, q̇ and q̈: N m or N.
pub(super) fn friction_forces<'g>(mechanism: &Mechanism<'g>, wrench: bool) -> Vec<Expr<'g>> {
    let effects = Effects { wrench, friction: false };
    let NewtonEuler { wrenches, .. } = newton_euler::newton_euler(mechanism, effects);
    let mut forces = vec![mechanism.graph.zero(); mechanism.degrees_of_freedom];
    for (link, contact) in mechanism.links.iter().zip(&wrenches) {
        let contribution = newton_euler::friction(
            &link.friction,
            link.kind,
            link.axis,
            contact.force,
            link.velocity,
        );
        forces[link.coordinate] += contribution * link.ratio;
    }
    forces
}

/// The function for F_l and M_l of every joint, equations (26) and (36).
pub(super) fn link_wrenches<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let effects = Effects { wrench: true, friction: false };
    let NewtonEuler { wrenches, .. } = newton_euler::newton_euler(&derivation.mechanism, effects);
    let shape = vec![wrenches.len(), 3];
    let rows = |part: fn(&newton_euler::LinkWrench<'g>) -> Vector<'g>| {
        wrenches.iter().flat_map(|wrench| part(wrench).0).collect()
    };
    let output = |name: &str, doc: &str, unit: &str, values| {
        Output::new(name, doc, unit, shape.clone(), values)
    };
    derivation.of_kind(
        FunctionKind::LinkWrenches,
        &["The wrench in every joint: the contact force F_l and the contact moment M_l that each \
            link receives through its joint, one row per link, in the link's own frame."],
        vec![
            output("force", "Contact forces F_l", "N", rows(|wrench| wrench.force)),
            output(
                "moment",
                "Contact moments M_l about the origins of the link frames",
                "N m",
                rows(|wrench| wrench.moment),
            ),
        ],
    )
}
