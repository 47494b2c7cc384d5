//! A state with its joint torques, for readers who copy the equations.

use robot_document::robot::CheckValue;
use robot_model::robot::{Frame, Robot};
use robot_numeric::{Loads, Mechanism, Wrench};

/// The positions, velocities and accelerations of the check state, which are repeated for more joints.
const STATE: [[&str; 7]; 3] = [
    ["0.3", "-0.5", "0.7", "0.4", "-0.6", "0.2", "0.9"],
    ["0.8", "0.5", "-0.4", "1.1", "0.6", "-0.9", "0.7"],
    ["-0.2", "1.3", "0.6", "-0.7", "0.9", "1.2", "-0.5"],
];
/// The wrench of each tip, N and N m.
const WRENCH: [&str; 6] = ["3", "-2", "5", "0.4", "0.7", "-0.3"];

/// The joint torques in a state, with or without friction, computed by the numeric solver, which is independent of the
/// equations. `None` if parameters have no values.
#[must_use]
pub fn check_value(robot: &Robot, friction: bool) -> Option<CheckValue> {
    let count = robot.degrees_of_freedom();
    let number = |text: &&str| text.parse::<f64>().unwrap_or_default();
    let [positions, velocities, accelerations] =
        STATE.map(|row| row.into_iter().cycle().take(count).collect::<Vec<&str>>());
    let numbers = |texts: &[&str]| texts.iter().map(number).collect::<Vec<f64>>();
    let [fx, fy, fz, mx, my, mz] = WRENCH.each_ref().map(number);
    let wrench = Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() };
    // The solver takes the wrench of each frame; only those of tips are part of the equations.
    let of_frame = |frame: &Frame| frame.wrench.as_ref().map_or_else(Wrench::zero, |_| wrench);
    let loads = Loads { wrenches: robot.frames.iter().map(of_frame).collect(), friction };
    let mechanism = Mechanism::nominal(robot).ok()?;
    let (q, qd, qdd) = (numbers(&positions), numbers(&velocities), numbers(&accelerations));
    let forces = mechanism.inverse_dynamics_with(&q, &qd, &qdd, &loads).ok()?;
    let forces = forces.iter().copied().collect();
    Some(CheckValue { positions, velocities, accelerations, wrench: WRENCH, forces })
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use robot_model::description::read_toml;

    use super::*;

    fn folder() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots")
    }

    #[test]
    fn every_robot_has_a_check_value() {
        let paths = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
        let robots: Vec<_> = paths.filter(|path| path.extension().unwrap() == "toml").collect();
        assert!(robots.len() >= 9);
        for path in robots {
            let text = std::fs::read_to_string(&path).unwrap();
            let robot = read_toml("robot.toml", &text).unwrap().robot;
            let value = check_value(&robot, false).unwrap();
            assert_eq!(value.forces.len(), robot.degrees_of_freedom(), "{}", robot.name);
        }
    }

    /// Only tips exert wrenches, wherever other frames are.
    #[test]
    fn frames_without_wrenches_change_nothing() {
        let text = &std::fs::read_to_string(folder().join("planar_2r.toml")).unwrap();
        let forces = |text: &str| {
            check_value(&read_toml("robot.toml", text).unwrap().robot, false).unwrap().forces
        };
        let frame = "\n[[frame]]\nname = \"camera\"\nparent = \"1\"\n";
        assert_eq!(forces(text), forces(&format!("{text}{frame}")));
    }
}
