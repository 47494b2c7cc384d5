//! The regressor: driving forces as linear functions of the robot's parameters.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, plain};
use crate::economical::{Column, RegressorColumns};
use crate::mechanism::MechanismLink;
use crate::numeric::LINK_PARAMETERS;

/// Y with Y π = τ.
pub(super) fn regressor<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let recursion = derivation.recursion.as_ref();
    let RegressorColumns { links: mut columns, rotors } = recursion
        .and_then(|recursion| recursion.regressor(&derivation.mechanism))
        .unwrap_or_else(|| plain::regressor(derivation));
    let mut meanings = vec![];
    let mechanism = &derivation.mechanism;
    for ((link, rotor), model) in mechanism.links.iter().zip(rotors).zip(&derivation.robot.links) {
        for (meaning, column) in drive_columns(link, rotor, mechanism.degrees_of_freedom) {
            meanings.push(format!("{} {meaning} of `{}`", columns.len(), model.joint.name));
            columns.push(column);
        }
    }
    let rows = mechanism.degrees_of_freedom;
    let values = (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
    let doc: Vec<String> = paragraphs(derivation, &meanings);
    let doc: Vec<&str> = doc.iter().map(String::as_str).collect();
    derivation.of_kind(
        FunctionKind::Regressor,
        &doc,
        derivation.coordinate_inputs(["q", "qd", "qdd"]),
        vec![Output::new(
            "regressor",
            "The regressor, row by row: a row per driving force, a column per parameter",
            "the unit of tau per unit of the parameter",
            vec![rows, columns.len()],
            values,
        )],
    )
}

fn paragraphs(derivation: &Derivation<'_, '_>, drives: &[String]) -> Vec<String> {
    let names: Vec<String> =
        derivation.robot.links.iter().map(|link| format!("`{}`", link.name)).collect();
    let mut paragraphs = vec![
        "The regressor Y: the driving forces are Y π, linear in the parameters π. Without wrenches, \
         and without the dry friction that grows with the contact force."
            .to_owned(),
        format!(
            "{LINK_PARAMETERS} columns per link, in the order {}: mass m (kg), first moment m c_x, \
             m c_y, m c_z (kg m), and the inertia tensor I_xx, I_xy, I_yy, I_xz, I_yz, I_zz (kg m²), \
             entries of the tensor with their signs. First moment and tensor are about the origin \
             of the link's frame, in its axes.",
            names.join(", ")
        ),
    ];
    if !drives.is_empty() {
        paragraphs.push(format!(
            "Columns of the drives, reflected inertia in kg m² or kg, viscous friction in N m s/rad \
             or N s/m, constant friction and offset in N m or N, and the coupling of a gyroscopic \
             rotor with the link that carries it, its inertia times the gear ratio: {}.",
            drives.join(", ")
        ));
    }
    paragraphs
}

/// The columns of the drive parameters that the file gives, and what they are.
fn drive_columns<'g>(
    link: &MechanismLink<'g>,
    rotor: Column<'g>,
    coordinates: usize,
) -> Vec<(&'static str, Column<'g>)> {
    let friction = &link.friction;
    let graph = link.ratio.graph();
    let sign = friction.sign(link.velocity);
    let figures: [(&'static str, Expr<'g>, Expr<'g>); 5] = [
        ("reflected inertia", link.reflected_inertia, link.acceleration),
        ("viscous friction", friction.viscous, link.velocity),
        ("forward friction", friction.coulomb_positive, (sign * sign + sign) / 2),
        ("backward friction", friction.coulomb_negative, (sign - sign * sign) / 2),
        ("offset", friction.offset, graph.one()),
    ];
    let column = |(meaning, _, share): (&'static str, _, Expr<'g>)| {
        let mut column = vec![graph.zero(); coordinates];
        column[link.coordinate] = share * link.ratio;
        (meaning, column)
    };
    let given = figures.into_iter().filter(|(_, figure, _)| !figure.is_zero());
    let coupled = (!link.rotor_coupling.is_zero()).then_some(("rotor coupling", rotor));
    given.map(column).chain(coupled).collect()
}
