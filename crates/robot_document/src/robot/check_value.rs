//! A state with its driving forces, for whoever copies the equations.

use robot_model::robot::Robot;
use robot_numeric::{Loads, Mechanism, Wrench};

use super::{heading, paragraph};
use crate::document::{Block, Inline, Table};
use crate::error::Error;
use crate::forms::EquationOptions;
use crate::math::Math;
use crate::notation::Notation;

/// Positions, velocities and accelerations of the check state, taken in turn.
const STATE: [[&str; 7]; 3] = [
    ["0.3", "-0.5", "0.7", "0.4", "-0.6", "0.2", "0.9"],
    ["0.8", "0.5", "-0.4", "1.1", "0.6", "-0.9", "0.7"],
    ["-0.2", "1.3", "0.6", "-0.7", "0.9", "1.2", "-0.5"],
];
/// The wrench of each tip, N and N m.
const WRENCH: [&str; 6] = ["3", "-2", "5", "0.4", "0.7", "-0.3"];

/// The driving forces at a state, by a numeric solver that shares nothing with the equations. Robots
/// whose parameters have no values have none.
pub(super) fn blocks(
    robot: &Robot,
    options: &EquationOptions,
    notation: &Notation,
) -> Result<Vec<Block>, Error> {
    let count = robot.degrees_of_freedom();
    let value = |text: &str| text.parse::<f64>().unwrap_or_default();
    let [q, qd, qdd] =
        STATE.map(|row| row.iter().cycle().take(count).copied().collect::<Vec<&str>>());
    let numbers = |texts: &[&str]| texts.iter().map(|text| value(text)).collect::<Vec<f64>>();
    let [fx, fy, fz, mx, my, mz] = WRENCH.map(value);
    let wrench = || Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() };
    let loads =
        Loads { wrenches: robot.tips().map(|_| wrench()).collect(), friction: options.friction };
    let Ok(mechanism) = Mechanism::nominal(robot) else { return Ok(vec![]) };
    let found =
        mechanism.inverse_dynamics_with(&numbers(&q), &numbers(&qd), &numbers(&qdd), &loads);
    let Ok(forces) = found else { return Ok(vec![]) };
    let mut rows = vec![];
    for (index, force) in forces.iter().enumerate() {
        let mut row = vec![vec![Inline::Math(Math::integer(index + 1))]];
        for texts in [&q, &qd, &qdd] {
            row.push(texts.get(index).map(|text| number(text)).into_iter().collect());
        }
        row.push(vec![number(&format!("{force:.8}"))]);
        rows.push(row);
    }
    let name = |prefix: &str| -> Result<Vec<Inline>, Error> {
        let shape = notation.symbol(&format!("{prefix}1"))?;
        Ok(vec![Inline::Math(without_index(shape))])
    };
    let driving = vec![Inline::Math(Math::Letter('Q'))];
    let head = vec![vec![], name("q")?, name("qd")?, name("qdd")?, driving];
    let mut blocks = vec![
        heading("A check value"),
        paragraph(
            "With the parameters at their values, this state asks for these driving forces. They were \
             computed by a numeric solver, not from the equations.",
        ),
    ];
    if robot.tips().next().is_some() {
        blocks.push(paragraph(&format!(
            "Each tip exerts the force ({}) N and the moment ({}) N m.",
            WRENCH[..3].join(", "),
            WRENCH[3..].join(", ")
        )));
    }
    let caption = "State and driving forces, SI units.".to_owned();
    blocks.push(Block::Table(Table { caption, head, rows }));
    Ok(blocks)
}

fn number(text: &str) -> Inline {
    let digits = text.trim_start_matches('-');
    let value = Math::Number(digits.to_owned());
    match digits.len() < text.len() {
        true => Inline::Math(Math::Row(vec![Math::Sign('-'), value])),
        false => Inline::Math(value),
    }
}

/// `q` of `q_1`.
fn without_index(shape: Math) -> Math {
    match shape {
        Math::Symbol(symbol) => without_index(*symbol.shape),
        Math::Script(script) => script.base,
        other => other,
    }
}
