//! The table of the drives.

use robot_model::robot::{Drive, Link, Robot};
use robot_symbolic::Formula;

use super::tables::{Formulas, heads, link_cells, link_heads};
use super::words;
use crate::document::{Inline, Table};
use crate::error::Error;

/// A value of a drive: the heading of its column, and the value.
type Column = (&'static str, fn(&Drive) -> &Formula);

const ARMATURE: Column = ("Armature", |drive| &drive.armature);
const ROTOR: Column = ("Rotor inertia", |drive| &drive.rotor_inertia);
const RATIO: Column = ("Gear ratio", |drive| &drive.gear_ratio);

/// The drives with their links, in the order of the robot file; `None` if no joint has a drive with inertia.
pub(super) fn table(robot: &Robot, formulas: &Formulas<'_>) -> Result<Option<Table>, Error> {
    let links = || robot.links.iter().enumerate();
    let any = |(_, value): Column| links().any(|(_, link)| !words::is_zero(value(&link.drive)));
    let (armature, rotor) = (any(ARMATURE), any(ROTOR));
    let columns: &[Column] = match (armature, rotor) {
        (false, false) => return Ok(None),
        (true, false) => &[ARMATURE],
        (false, true) => &[ROTOR, RATIO],
        (true, true) => &[ARMATURE, ROTOR, RATIO],
    };
    let has = |link: &Link| {
        [ARMATURE, ROTOR].iter().any(|(_, value)| !words::is_zero(value(&link.drive)))
    };
    let mut rows = vec![];
    for (index, link) in links().filter(|(_, link)| has(link)) {
        let mut row = link_cells(robot, index);
        for (_, value) in columns {
            row.push(vec![Inline::Math(formulas.math(value(&link.drive))?)]);
        }
        rows.push(row);
    }
    let mut head = link_heads(robot);
    let keys = head.len();
    head.extend(heads(&columns.iter().map(|(name, _)| *name).collect::<Vec<_>>()));
    Ok(Some(Table { caption: caption(robot, armature, rotor), head, rows, keys }))
}

fn caption(robot: &Robot, armature: bool, rotor: bool) -> String {
    let inertia = match (armature, rotor) {
        (true, true) => {
            "the armature, in kg m² or, at prismatic joints, kg, and the rotor inertia, in kg m², times the square of \
             the gear ratio make the inertia at the joint"
        }
        (false, _) => {
            "the rotor inertia, in kg m², times the square of the gear ratio is the inertia at the joint"
        }
        _ => "the armature is the inertia at the joint, in kg m² or, at prismatic joints, kg",
    };
    let gyroscopic = robot.links.iter().filter(|link| link.drive.gyroscopic);
    let names: Vec<&str> = gyroscopic.map(|link| link.joint.name.as_str()).collect();
    let gyroscopic = match names.as_slice() {
        [] => String::new(),
        names => format!(
            " The rotors of {} also react to the rotation of the links that carry them.",
            names.join(", ")
        ),
    };
    format!("Drives: {inertia}.{gyroscopic}")
}
