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

/// The check value as a table.
pub(super) fn blocks(
    value: &CheckValue,
    has_tip: bool,
    symbols: &SymbolTable,
    letters: &Letters,
) -> Vec<Block> {
    let CheckValue { positions, velocities, accelerations, wrench, forces } = value;
    let mut rows = vec![];
    for (index, force) in forces.iter().enumerate() {
        let mut row = vec![vec![Inline::Math(Math::integer(index + 1))]];
        for texts in [positions, velocities, accelerations] {
            row.push(texts.get(index).map(|text| number(text)).into_iter().collect());
        }
        row.push(vec![number(&format!("{force:.8}"))]);
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
