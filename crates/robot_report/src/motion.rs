//! Driving forces along a sample trajectory, split by what asks for them.

use std::f64::consts::TAU;

use robot_build::Programs;
use robot_codegen::{Errors, Interpreter};
use robot_dynamics::model::{JointKind, Robot};

use crate::html::{Node, holding};
use crate::plot::{self, Plot};
use crate::table::Table;
use crate::text;

/// The length of the trajectory, s, and the number of steps in it.
const DURATION: f64 = 4.0;
const STEPS: u32 = 160;
/// The share of a joint's range that is used, and what is used where it has no limits, rad and m.
const SHARE: f64 = 0.3;
const SWING: f64 = 0.8;
const STROKE: f64 = 0.2;

/// A moment of the trajectory.
struct State {
    t: f64,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

/// What asks for driving forces, and the forces of each coordinate at each moment; the last is the
/// sum of the others.
type Shares = Vec<(&'static str, Vec<Vec<f64>>)>;

/// Curves of the driving force of each coordinate, and a table of their largest values.
pub(crate) fn torques(programs: &Programs) -> Vec<Node> {
    let robot = &programs.robot;
    let states = trajectory(robot);
    let shares = match shares(programs, &states) {
        Ok(shares) => shares,
        Err(errors) => {
            let words = format!("There are no curves: {errors}");
            return vec![holding("p", words).class("note").into()];
        }
    };
    let t: Vec<f64> = states.iter().map(|state| state.t).collect();
    let mut columns = vec!["Coordinate", "Unit"];
    columns.extend(shares.iter().map(|(name, _)| *name));
    let mut table = Table::new("The largest magnitudes along the trajectory", columns);
    let mut body = vec![Node::from(holding("p", WORDS))];
    for (index, coordinate) in robot.coordinates.iter().enumerate() {
        let unit = match coordinate.kind {
            JointKind::Revolute => "N m",
            JointKind::Prismatic => "N",
        };
        let of = |samples: &Vec<Vec<f64>>| -> Vec<f64> {
            samples.iter().filter_map(|sample| sample.get(index).copied()).collect()
        };
        let curves: Vec<_> = shares.iter().map(|(name, samples)| (*name, of(samples))).collect();
        let symbol = text::symbol(&format!("q{}", index + 1));
        let peaks =
            curves.iter().map(|(_, values)| text::number(plot::rounded(plot::peak(values))));
        let cells: Vec<String> = std::iter::once(unit.to_owned()).chain(peaks).collect();
        table.row("", symbol.as_str(), cells);
        let title = format!("{symbol}, joint {}", coordinate.joint);
        let plot = Plot { number: index + 1, title, unit, t: &t, curves };
        body.push(holding("figure", plot.build()).into());
    }
    body.push(table.build().into());
    body
}

/// The driving forces of all moments, split.
fn shares(programs: &Programs, states: &[State]) -> Result<Shares, Errors> {
    let interpreter = Interpreter::new(&programs.module, &[])?;
    let call = |function: &str, inputs: &[(&str, &[f64])]| -> Result<Vec<f64>, Errors> {
        let outputs = interpreter.call(function, inputs)?;
        Ok(outputs.into_iter().flat_map(|output| output.values).collect())
    };
    let less = |all: &[f64], part: &[f64]| -> Vec<f64> {
        all.iter().zip(part).map(|(all, part)| all - part).collect()
    };
    let has_friction = programs.robot.has_friction();
    let mut names = vec!["inertia", "velocities", "gravity"];
    names.extend(has_friction.then_some("friction"));
    names.push("total");
    let mut shares: Shares = names.into_iter().map(|name| (name, vec![])).collect();
    for State { q, qd, qdd, .. } in states {
        let motion: [(&str, &[f64]); 3] = [("q", q), ("qd", qd), ("qdd", qdd)];
        let torques = call("inverse_dynamics", &motion)?;
        let bias = call("bias", motion.get(..2).unwrap_or_default())?;
        let gravity = call("gravity", motion.get(..1).unwrap_or_default())?;
        let mut parts = vec![less(&torques, &bias), less(&bias, &gravity), gravity];
        if has_friction {
            let total = call("inverse_dynamics_friction", &motion)?;
            parts.push(less(&total, &torques));
            parts.push(total);
        } else {
            parts.push(torques);
        }
        for ((_, samples), part) in shares.iter_mut().zip(parts) {
            samples.push(part);
        }
    }
    Ok(shares)
}

/// What the trajectory is.
const WORDS: &str = "Each coordinate swings about the middle of its range, or about 0 where it has no \
    limits: q = middle − amplitude · cos(2π k t / 4 s), with k = 1 for coordinates of odd number and \
    k = 2 for the others. The amplitude is 0.3 of half the range; without limits 0.8 rad or 0.2 m. \
    Inertia is M q̈, velocities C q̇, gravity g; the total is their sum, with friction where there is some.";

fn trajectory(robot: &Robot) -> Vec<State> {
    let moment = |step: u32| {
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
        State { t, q, qd, qdd }
    };
    (0..=STEPS).map(moment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shares against the numeric solver's, which knows nothing of the programs.
    #[test]
    fn each_share_is_that_of_its_cause() {
        let path = format!("{}/../../robots/scara.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let source = robot_build::Source { name: "scara.toml".to_owned(), text };
        let options = robot_build::Options {
            functions: robot_build::Functions::All,
            ..robot_build::Options::default()
        };
        let programs = robot_build::programs(&source, &options).unwrap();
        let mechanism = robot_dynamics::numeric::Mechanism::nominal(&programs.robot).unwrap();
        let states = trajectory(&programs.robot);
        let shares = shares(&programs, &states).unwrap();
        let share = |wanted: &str| &shares.iter().find(|(name, _)| *name == wanted).unwrap().1;
        for (place, State { q, qd, qdd, .. }) in states.iter().enumerate().step_by(20) {
            let inertia =
                mechanism.mass_matrix(q).unwrap() * nalgebra::DVector::from_column_slice(qdd);
            let gravity = mechanism.gravity_torques(q).unwrap();
            let velocities = mechanism.bias(q, qd).unwrap() - &gravity;
            let expected = [("inertia", inertia), ("velocities", velocities), ("gravity", gravity)];
            for (name, expected) in expected {
                for (value, expected) in share(name)[place].iter().zip(expected.iter()) {
                    assert!((value - expected).abs() < 1e-9, "{name}: {value} {expected}");
                }
            }
        }
    }

    /// Velocities and accelerations are the derivatives of the positions.
    #[test]
    fn the_trajectory_is_smooth() {
        let path = format!("{}/../../robots/panda.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let robot = robot_dynamics::description::read_toml("panda.toml", &text).unwrap().robot;
        let states = trajectory(&robot);
        for moments in states.windows(3) {
            let step = moments[2].t - moments[0].t;
            for index in 0..robot.degrees_of_freedom() {
                let slope = (moments[2].q[index] - moments[0].q[index]) / step;
                assert!((slope - moments[1].qd[index]).abs() < 0.01);
                let slope = (moments[2].qd[index] - moments[0].qd[index]) / step;
                assert!((slope - moments[1].qdd[index]).abs() < 0.01);
            }
        }
        let ends = [&states[0], states.last().unwrap()];
        assert!(ends.iter().all(|state| state.qd.iter().all(|rate| rate.abs() < 1e-12)));
    }
}
