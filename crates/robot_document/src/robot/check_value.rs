//! A check value: a state with its joint torques, for readers who copy the equations.

use robot_model::variable::JointVariable;

use super::{heading, numbers, paragraph};
use crate::document::{Block, Inline, Table};
use crate::forms::Letters;
use crate::layout::SymbolTable;
use crate::math::Math;

/// A state and its joint torques, which are computed without the equations. The numbers of the state are given as they
/// are printed.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckValue {
    /// The joint positions, in rad or m.
    pub positions: Vec<&'static str>,
    /// The joint velocities, in rad/s or m/s.
    pub velocities: Vec<&'static str>,
    /// The joint accelerations, in rad/s² or m/s².
    pub accelerations: Vec<&'static str>,
    /// The wrench that each tip exerts on its surroundings: the force in N, then the moment in N m.
    pub wrench: [&'static str; 6],
    /// The joint torques, in N m or N.
    pub forces: Vec<f64>,
}

/// The part of the largest torque below which another one is a rounding error.
const NEGLIGIBLE: f64 = 1e-12;

/// The check value as a table.
pub(super) fn blocks(
    value: &CheckValue,
    has_tip: bool,
    symbols: &SymbolTable,
    letters: &Letters,
) -> Vec<Block> {
    let CheckValue { positions, velocities, accelerations, wrench, forces } = value;
    let largest = forces.iter().fold(0.0_f64, |largest, force| largest.max(force.abs()));
    let mut rows = vec![];
    for (index, force) in forces.iter().enumerate() {
        let mut row = vec![vec![Inline::Math(Math::integer(index + 1))]];
        for texts in [positions, velocities, accelerations] {
            row.push(texts.get(index).map(|text| number(text)).into_iter().collect());
        }
        row.push(vec![number(&torque(*force, largest))]);
        rows.push(row);
    }
    let name = |prefix: &str| {
        let shape = symbols.look(&format!("{prefix}1"));
        vec![Inline::Math(without_index(shape))]
    };
    let driving = vec![Inline::Math(letters.torque_sign())];
    let [q, qd, qdd] = JointVariable::MOTION.map(|variable| name(variable.name()));
    let joint = vec![Inline::Math(Math::Letter('i'))];
    let head = vec![joint, q, qd, qdd, driving];
    let mut blocks = vec![
        heading("A check value"),
        paragraph(
            "At the nominal parameters, this state requires the following joint torques and \
             forces. They were computed by a numeric solver, not from the equations.",
        ),
    ];
    if has_tip {
        let [fx, fy, fz, mx, my, mz] = wrench.map(numbers::signed);
        blocks.push(Block::Paragraph(vec![
            Inline::text("Each tip exerts the force "),
            Inline::Math(numbers::vector(&[fx, fy, fz])),
            Inline::text(" N and the moment "),
            Inline::Math(numbers::vector(&[mx, my, mz])),
            Inline::text(" N m."),
        ]));
    }
    let caption = "State and joint torques, SI units.".to_owned();
    blocks.push(Block::Table(Table { caption, head, rows, keys: 1 }));
    blocks
}

/// A torque with eight decimals, or with ten digits if these would be too few or too many. One that is negligible
/// beside the `largest` is a rounding error of 0.
fn torque(force: f64, largest: f64) -> String {
    let is_negligible = force.abs() <= NEGLIGIBLE * largest;
    match is_negligible || (0.01..1e8).contains(&force.abs()) {
        true => format!("{:.8}", if is_negligible { 0.0 } else { force }),
        false => format!("{force:.9e}"),
    }
}

fn number(text: &str) -> Inline {
    Inline::Math(numbers::signed(text))
}

/// Removes the index: `q` from `q_1`.
fn without_index(shape: Math) -> Math {
    match shape {
        Math::Symbol(symbol) => without_index(*symbol.shape),
        Math::Script(script) => script.base,
        other => other,
    }
}
