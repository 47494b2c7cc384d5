//! Writes the robots and states that all programs of the comparison use, in the format that `robot_data.hpp` reads.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use robot_model::description;
use robot_numeric::{JointKind, Mechanism, Pose};
use robot_numeric::random::Random;


const STATES: usize = calls::STATES;

/// The text of a robot and its states, from its file.
pub fn of_file(name: &str, path: &str) -> Result<String, Box<dyn Error>> {
    let described = description::read_toml(path, &fs::read_to_string(path)?)?;
    let mechanism = Mechanism::nominal(&described.robot)?;
    let mut text = format!("{name}\n");
    numbers(&mut text, mechanism.gravity().as_slice());
    writeln!(text, "{}", mechanism.links().len())?;
    for link in mechanism.links() {
        let kind = if link.joint.kind == JointKind::Prismatic { 'P' } else { 'R' };
        writeln!(text, "{} {kind}", link.parent.map_or(-1, |parent| parent as i64))?;
        numbers(&mut text, link.joint.axis.as_slice());
        pose(&mut text, &link.placement);
        numbers(&mut text, &[link.mass]);
        numbers(&mut text, link.center_of_mass.as_slice());
        let i = &link.inertia;
        let entries = [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
        numbers(&mut text, &entries);
    }
    let last = Pose::identity();
    let tip = mechanism.frames().last();
    let carrier = tip.map_or(mechanism.links().len() as i64 - 1, |tip| tip.link.map_or(-1, |link| link as i64));
    writeln!(text, "{carrier}")?;
    pose(&mut text, tip.map_or(&last, |tip| &tip.placement));
    states(&mut text, &mechanism)?;
    Ok(text)
}

fn states(text: &mut String, mechanism: &Mechanism) -> Result<(), Box<dyn Error>> {
    let mut random = Random::new(1);
    writeln!(text, "{STATES}")?;
    for _ in 0..STATES {
        let mut vector = |size: f64| -> Vec<f64> {
            (0..mechanism.coordinates()).map(|_| random.uniform(-size, size)).collect()
        };
        let (q, qd, qdd) = (vector(3.1), vector(2.0), vector(5.0));
        let tau = mechanism.inverse_dynamics(&q, &qd, &qdd)?;
        for values in [q.as_slice(), &qd, &qdd, tau.as_slice()] {
            numbers(text, values);
        }
    }
    Ok(())
}

fn pose(text: &mut String, pose: &Pose) {
    numbers(text, pose.rotation.transpose().as_slice());
    numbers(text, pose.translation.as_slice());
}

fn numbers(text: &mut String, values: &[f64]) {
    let values: Vec<String> = values.iter().map(|value| format!("{value:e}")).collect();
    text.push_str(&values.join(" "));
    text.push('\n');
}
