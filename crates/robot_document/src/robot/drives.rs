//! The table of the drives.

use robot_model::robot::{Drive, Link, Robot};
use robot_symbolic::Formula;

use super::tables::{Formulas, heads, link_cells, link_heads};
use super::words;
use crate::document::{Inline, Table};
use crate::error::Error;

/// The drives of a robot in the words that all outputs share.
#[derive(Clone, Debug, PartialEq)]
pub struct Drives<'r> {
    /// What the values are, with their units, in sentences.
    pub caption: String,
    /// The headings of the values.
    pub columns: Vec<&'static str>,
    /// The index of the link that each drive moves, with the drive's values, in the order of the robot file.
    pub rows: Vec<(usize, Vec<&'r Formula>)>,
}

/// A value of a drive: the heading of its column, and the value.
type Column = (&'static str, fn(&Drive) -> &Formula);

const ARMATURE: Column = ("Armature", |drive| &drive.armature);
const ROTOR: Column = ("Rotor inertia", |drive| &drive.rotor_inertia);
const RATIO: Column = ("Gear ratio", |drive| &drive.gear_ratio);

/// The drives of a robot; `None` if no joint has a drive with inertia.
#[must_use]
pub fn drives(robot: &Robot) -> Option<Drives<'_>> {
    let has = |link: &Link, (_, value): Column| !words::is_zero(value(&link.drive));
    let any = |column| robot.links.iter().any(|link| has(link, column));
    let (columns, inertia): (&[Column], &str) = match (any(ARMATURE), any(ROTOR)) {
        (false, false) => return None,
        (true, false) => (
            &[ARMATURE],
            "the armature is the inertia at the joint, in kg m² or, at prismatic joints, kg",
        ),
        (false, true) => (
            &[ROTOR, RATIO],
            "the rotor inertia, in kg m², times the square of the gear ratio is the inertia at the joint",
        ),
        (true, true) => (
            &[ARMATURE, ROTOR, RATIO],
            "the armature, in kg m² or, at prismatic joints, kg, and the rotor inertia, in kg m², times the square of \
             the gear ratio make the inertia at the joint",
        ),
    };
    let rows = robot.links.iter().enumerate();
    let rows =
        rows.filter(|(_, link)| has(link, ARMATURE) || has(link, ROTOR)).map(|(index, link)| {
            (index, columns.iter().map(|(_, value)| value(&link.drive)).collect())
        });
    Some(Drives {
        caption: format!("Drives: {inertia}.{}", gyroscopic(robot)),
        columns: columns.iter().map(|(name, _)| *name).collect(),
        rows: rows.collect(),
    })
}

/// The sentence about rotors with gyroscopic moments; empty if there are none.
fn gyroscopic(robot: &Robot) -> String {
    let links = robot.links.iter().filter(|link| link.drive.gyroscopic);
    let names: Vec<&str> = links.map(|link| link.joint.name.as_str()).collect();
    match names.as_slice() {
        [] => String::new(),
        [name] => {
            format!(" The rotor of {name} also reacts to the rotation of the link that carries it.")
        }
        names => format!(
            " The rotors of {} also react to the rotation of the links that carry them.",
            names.join(", ")
        ),
    }
}

/// The drives with their links; `None` if no joint has a drive with inertia.
pub(super) fn table(robot: &Robot, formulas: &Formulas<'_>) -> Result<Option<Table>, Error> {
    let Some(drives) = drives(robot) else { return Ok(None) };
    let mut rows = vec![];
    for (index, values) in &drives.rows {
        let mut row = link_cells(robot, *index);
        for value in values {
            row.push(vec![Inline::Math(formulas.math(value)?)]);
        }
        rows.push(row);
    }
    let mut head = link_heads(robot);
    let keys = head.len();
    head.extend(heads(&drives.columns));
    Ok(Some(Table { caption: drives.caption, head, rows, keys }))
}
