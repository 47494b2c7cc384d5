//! The figures of motions and of joint torques.

use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;

use super::{Curve, Figure, Panel};
use crate::contributions::TorqueContributions;
use crate::motion::{Energies, Motion};

/// The figure of a motion: its positions, velocities, joint torques and energies. If `conserved`, a last panel shows
/// the change of the energy since the start, which is the error of the integration.
#[must_use]
pub fn motion_figure(
    robot: &Robot,
    motion: &Motion,
    energies: &Energies,
    conserved: bool,
) -> Figure {
    let q: Vec<&[f64]> = motion.states.iter().map(|state| state.q.as_slice()).collect();
    let qd: Vec<&[f64]> = motion.states.iter().map(|state| state.qd.as_slice()).collect();
    let mut panels = by_unit(robot, "position", JointVariable::Position, &q);
    panels.extend(by_unit(robot, "velocity", JointVariable::Velocity, &qd));
    if motion.tau.iter().flatten().any(|tau| *tau != 0.0) {
        panels.extend(by_unit(robot, "torque", JointVariable::Torque, &motion.tau));
    }
    let curve = |color: usize, name: &str, values: &[f64]| Curve {
        name: name.to_owned(),
        values: values.to_vec(),
        is_sum: name == "total",
        color,
    };
    panels.push(Panel {
        quantity: "energy".to_owned(),
        unit: "J".to_owned(),
        curves: vec![
            curve(0, "kinetic", &energies.kinetic),
            curve(1, "potential", &energies.potential),
            curve(2, "total", &energies.total),
        ],
    });
    if conserved {
        let start = energies.total.first().copied().unwrap_or_default();
        let change: Vec<f64> = energies.total.iter().map(|energy| energy - start).collect();
        let curves = vec![curve(0, "error", &change)];
        panels
            .push(Panel { quantity: "energy − start".to_owned(), unit: "J".to_owned(), curves });
    }
    Figure { title: format!("Motion of {}", robot.name), t: motion.t.clone(), panels }
}

/// The figure of the contributions to the joint torques along a trajectory, with a panel for each coordinate.
#[must_use]
pub fn contributions_figure(robot: &Robot, contributions: &TorqueContributions) -> Figure {
    let panel = |(index, kind): (usize, JointKind)| {
        let curve = |(color, (name, series)): (usize, (&str, &Vec<Vec<f64>>))| Curve {
            name: name.to_owned(),
            values: entries(series, index),
            is_sum: name == "total",
            color,
        };
        Panel {
            quantity: name(JointVariable::Torque, Some(index)),
            unit: JointVariable::Torque.unit(kind).to_owned(),
            curves: contributions.titled().into_iter().enumerate().map(curve).collect(),
        }
    };
    let kinds = robot.coordinates.iter().map(|coordinate| coordinate.kind).enumerate();
    let title = format!("Joint torques of {}", robot.name);
    Figure { title, t: contributions.t.clone(), panels: kinds.map(panel).collect() }
}

/// A panel for all revolute coordinates and one for all prismatic coordinates, if there are any.
fn by_unit(
    robot: &Robot,
    quantity: &str,
    variable: JointVariable,
    samples: &[impl AsRef<[f64]>],
) -> Vec<Panel> {
    let panel = |kind: JointKind| {
        let numbers = robot.coordinates.iter().enumerate();
        let numbers = numbers.filter(|(_, coordinate)| coordinate.kind == kind);
        let curve = |(index, _)| Curve {
            name: name(variable, Some(index)),
            values: entries(samples, index),
            is_sum: false,
            color: index,
        };
        let curves: Vec<Curve> = numbers.map(curve).collect();
        let quantity = format!("{quantity} {}", name(variable, None));
        let unit = variable.unit(kind).to_owned();
        (!curves.is_empty()).then_some(Panel { quantity, unit, curves })
    };
    [JointKind::Revolute, JointKind::Prismatic].into_iter().filter_map(panel).collect()
}

/// The name of a variable with the number of its coordinate as a subscript: `q̇₁`.
fn name(variable: JointVariable, index: Option<usize>) -> String {
    let letters = match variable {
        JointVariable::Velocity => "q\u{307}",
        JointVariable::Acceleration => "q\u{308}",
        JointVariable::Torque => "τ",
        other => other.name(),
    };
    let digits = index.map(|index| (index + 1).to_string()).unwrap_or_default();
    let lowered = digits
        .bytes()
        .filter_map(|digit| char::from_u32(u32::from('₀') + u32::from(digit.saturating_sub(b'0'))));
    letters.chars().chain(lowered).collect()
}

/// One entry of every sample.
fn entries(samples: &[impl AsRef<[f64]>], index: usize) -> Vec<f64> {
    samples.iter().filter_map(|sample| sample.as_ref().get(index).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_have_their_signs() {
        let all = [JointVariable::Position, JointVariable::Velocity, JointVariable::Torque];
        assert_eq!(all.map(|variable| name(variable, Some(10))), ["q₁₁", "q\u{307}₁₁", "τ₁₁"]);
        assert_eq!(name(JointVariable::Position, None), "q");
    }
}
