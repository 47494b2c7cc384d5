//! Joint torques along a sample trajectory, divided into contributions.

use std::f64::consts::TAU;

use robot_build::Programs;
use robot_document::markup::{Node, holding};
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_simulation::{TorqueContributions, Trajectory, torque_contributions};

use crate::plot::{self, Plot};
use crate::table::Table;
use crate::text;

/// The duration of the trajectory in s, and the number of its steps.
const DURATION: f64 = 4.0;
const STEPS: u32 = 160;
/// The fraction of a joint's range that is used, and the amplitudes without limits, in rad and m.
const SHARE: f64 = 0.3;
const SWING: f64 = 0.8;
const STROKE: f64 = 0.2;

/// The curves of the joint torque of each coordinate, and a table of their largest values.
pub(crate) fn torques(programs: &Programs) -> Vec<Node> {
    let robot = &programs.robot;
    let found = match torque_contributions(programs, &[], &trajectory(robot), robot.has_friction())
    {
        Ok(contributions) => contributions,
        Err(error) => {
            let words = format!("The curves cannot be shown: {error}");
            return vec![holding("p", words).class("note").into()];
        }
    };
    let mut columns = vec!["Coordinate", "Unit"];
    columns.extend(found.titled().iter().map(|(name, _)| *name));
    let mut table = Table::stacked("The largest magnitudes along the trajectory", columns);
    let mut body = vec![Node::from(holding("p", WORDS))];
    for (index, (coordinate, curves)) in
        robot.coordinates.iter().zip(curves(robot, &found)).enumerate()
    {
        let unit = JointVariable::Torque.unit(coordinate.kind);
        let symbol = text::symbol(&JointVariable::Position.symbol(index));
        let peaks =
            curves.iter().map(|(_, values)| text::number(plot::rounded(plot::peak(values))));
        let cells: Vec<String> = std::iter::once(unit.to_owned()).chain(peaks).collect();
        table.row("", symbol.as_str(), cells);
        let title = format!("{symbol}, joint {}", coordinate.joint);
        let plot = Plot { number: index + 1, title, unit, t: &found.t, curves };
        body.push(holding("figure", plot.build()).class("wide").into());
    }
    body.push(table.build().into());
    body
}

/// The largest size of what rounding leaves of a sum, relative to the largest joint torque: that of about a thousand
/// roundings.
const NOISE: f64 = 1e-13;

/// The contributions to the joint torque of a coordinate over time, by their names.
type Curves = Vec<(&'static str, Vec<f64>)>;

/// The contributions of each coordinate. Those that are only the rounding error of a sum of larger terms are 0, such as
/// the torque of gravity about a vertical axis; they are compared with all torques of the same unit.
fn curves(robot: &Robot, found: &TorqueContributions) -> Vec<Curves> {
    let of = |index: usize| -> Curves {
        let values = |samples: &Vec<Vec<f64>>| {
            samples.iter().filter_map(|sample| sample.get(index).copied()).collect()
        };
        found.titled().into_iter().map(|(name, samples)| (name, values(samples))).collect()
    };
    let largest =
        |curves: &Curves| curves.iter().map(|(_, values)| plot::peak(values)).fold(0.0, f64::max);
    let mut all: Vec<Curves> = (0..robot.coordinates.len()).map(of).collect();
    let sizes: Vec<f64> = all.iter().map(largest).collect();
    for (coordinate, curves) in robot.coordinates.iter().zip(&mut all) {
        let alike = robot.coordinates.iter().zip(&sizes);
        let alike = alike.filter(|(other, _)| other.kind == coordinate.kind);
        let noise = NOISE * alike.map(|(_, size)| *size).fold(0.0, f64::max);
        for (_, values) in curves.iter_mut().filter(|(_, values)| plot::peak(values) <= noise) {
            values.fill(0.0);
        }
    }
    all
}

/// The explanation of the trajectory.
const WORDS: &str = "Each coordinate oscillates about the middle of its range, or about 0 if it \
    has no limits: q = middle − amplitude · cos(2π k t / 4 s), with k = 1 for odd coordinate \
    numbers and k = 2 for even ones. The amplitude is 0.3 of half the range; without limits it \
    is 0.8 rad or 0.2 m. Inertia is M q̈, Coriolis is C q̇, the Coriolis and centrifugal \
    terms, and gravity is g; the total is their sum, including friction if there is any.";

fn trajectory(robot: &Robot) -> Trajectory {
    let mut trajectory = Trajectory::default();
    for step in 0..=STEPS {
        let t = DURATION * f64::from(step) / f64::from(STEPS);
        let (mut q, mut qd, mut qdd) = (vec![], vec![], vec![]);
        for (index, coordinate) in robot.coordinates.iter().enumerate() {
            let without = match coordinate.kind {
                JointKind::Revolute => [-SWING, SWING],
                JointKind::Prismatic => [-STROKE, STROKE],
            };
            let limits = coordinate.limits.as_ref();
            let limits =
                limits.map(|limits| limits.each_ref().map(robot_symbolic::Rational::to_f64));
            let share = if limits.is_some() { SHARE } else { 1.0 };
            let [low, high] = limits.unwrap_or(without);
            let amplitude = share * (high - low) / 2.0;
            let rate = TAU / DURATION * if index % 2 == 0 { 1.0 } else { 2.0 };
            let (sin, cos) = (rate * t).sin_cos();
            q.push((low + high) / 2.0 - amplitude * cos);
            qd.push(amplitude * rate * sin);
            qdd.push(amplitude * rate * rate * cos);
        }
        trajectory.t.push(t);
        trajectory.q.push(q);
        trajectory.qd.push(qd);
        trajectory.qdd.push(qdd);
    }
    trajectory
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounding_leaves_is_zero() {
        let path = format!("{}/../../robots/panda.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let robot = robot_model::description::read_toml("panda.toml", &text).unwrap().robot;
        let sample = |first: f64| vec![vec![first, 50.0, 1e-9, 0.0, 0.0, 0.0, 0.0]];
        let (gravity, inertia) = (sample(6.2e-15), sample(7.0));
        let zero = sample(0.0);
        let t = vec![0.0];
        let total = inertia.clone();
        let (coriolis, friction, wrench) = (zero, None, None);
        let found = TorqueContributions { t, total, inertia, coriolis, gravity, friction, wrench };
        let shown = curves(&robot, &found);
        let gravity = |index: usize| -> &Vec<f64> {
            let own = shown[index].iter().find(|(name, _)| *name == "gravity");
            &own.unwrap().1
        };
        assert_eq!([0, 1, 2].map(gravity), [&vec![0.0], &vec![50.0], &vec![1e-9]]);
    }

    /// The velocities and accelerations are the derivatives of the positions.
    #[test]
    fn the_trajectory_is_smooth() {
        let path = format!("{}/../../robots/panda.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let robot = robot_model::description::read_toml("panda.toml", &text).unwrap().robot;
        let Trajectory { t, q, qd, qdd, .. } = trajectory(&robot);
        for middle in 1..t.len() - 1 {
            let step = t[middle + 1] - t[middle - 1];
            for index in 0..robot.degrees_of_freedom() {
                for (values, rates) in [(&q, &qd), (&qd, &qdd)] {
                    let slope = (values[middle + 1][index] - values[middle - 1][index]) / step;
                    assert!((slope - rates[middle][index]).abs() < 0.01);
                }
            }
        }
        let ends = [&qd[0], qd.last().unwrap()];
        assert!(ends.iter().all(|rates| rates.iter().all(|rate| rate.abs() < 1e-12)));
    }
}
