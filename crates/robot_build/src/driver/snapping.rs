//! The effects of snapping angles close to multiples of π/2, and the operations that it saves.

use robot_dynamics::economical::Plan;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions, Snap};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use crate::driver::counted::inverse_dynamics;
use crate::driver::options::Options;
use crate::error::Errors;

/// The tolerances, in rad, that are tried in addition to the one in use.
const TRIED: [f64; 3] = [1e-6, 1e-4, 1e-3];

/// The effect of snapping on a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapping {
    /// The effect of the tolerance in use.
    pub taken: Tried,
    /// The effects of larger tolerances, each of which snaps more angles.
    pub larger: Vec<Tried>,
}

/// The effect of a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// The tolerance, in rad.
    pub tolerance: f64,
    /// The angles that are changed.
    pub snapped: Vec<Snap>,
    /// The multiplications, additions and divisions of inverse dynamics with this tolerance, without sines and cosines.
    pub operations: usize,
}

impl Tried {
    /// The largest change of an angle.
    #[must_use]
    pub fn largest(&self) -> Option<&Snap> {
        self.snapped.iter().max_by(|a, b| a.change.abs().total_cmp(&b.change.abs()))
    }
}

/// Computes the effect of snapping on a robot with the given tolerance, or else that of the file or the default, and
/// with larger ones that snap more angles.
/// All use the same plan, or the default plan if none is given.
///
/// # Errors
///
/// The tolerance is not an angle, the plan does not match the robot, or inverse dynamics is too large.
pub fn snapping(robot: &Robot, snap: Option<f64>, plan: Option<&Plan>) -> Result<Snapping, Errors> {
    let tolerance = MechanismOptions::ROUNDED.with_snap(snap, robot).snap;
    let taken = tried(robot, tolerance, plan)?;
    let mut larger: Vec<Tried> = vec![];
    for tolerance in TRIED.into_iter().filter(|tried| *tried > tolerance) {
        let options = MechanismOptions { snap: tolerance, ..MechanismOptions::ROUNDED };
        let count = Mechanism::new(robot, &Graph::new(), &options).snapped.len();
        if count > larger.last().unwrap_or(&taken).snapped.len() {
            larger.push(tried(robot, tolerance, plan)?);
        }
    }
    Ok(Snapping { taken, larger })
}

fn tried(robot: &Robot, tolerance: f64, plan: Option<&Plan>) -> Result<Tried, Errors> {
    let options = Options { snap: Some(tolerance), plan: plan.cloned(), ..Options::default() };
    let (programs, counts) = inverse_dynamics(robot, options)?;
    Ok(Tried { tolerance, snapped: programs.snapped, operations: counts.operations() })
}

#[cfg(test)]
mod tests {
    use robot_dynamics::economical::plan::LinkPlan;

    use super::*;
    use crate::driver::programs::programs_of;

    /// An arm with two angles near a right angle, one of them nearer.
    fn arm() -> Robot {
        let link = |name: &str, angle: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n\
                 origin = {{ xyz = [0.1, 0.2, 0.3], rpy = [{angle}, 0, 0] }}\nmass = 1\n\
                 center_of_mass = [0.1, 0.2, 0.3]\ninertia = {{ xx = 0.1, yy = 0.11, zz = 0.12 }}\n"
            )
        };
        let links = [link("1", "0"), link("2", "1.5707958"), link("3", "1.57076")].concat();
        let text = format!("format = 1\n[robot]\nname = \"arm\"\ngravity = [0, 0, -9.81]\n{links}");
        robot_model::description::read("arm.toml", &text).unwrap().robot
    }

    #[test]
    fn larger_tolerances_are_reported_if_they_snap_more() {
        let robot = arm();
        let told = |snap: Option<f64>| {
            let Snapping { taken, larger } = snapping(&robot, snap, None).unwrap();
            let all: Vec<Tried> = std::iter::once(taken).chain(larger).collect();
            assert!(all.windows(2).all(|two| two[0].operations > two[1].operations), "{all:?}");
            all.iter().map(|one| (one.tolerance, one.snapped.len())).collect::<Vec<_>>()
        };
        // A tolerance that snaps no further angle is left out, and so is the one in use.
        assert_eq!(told(Some(0.0)), [(0.0, 0), (1e-6, 1), (1e-4, 2)]);
        assert_eq!(told(Some(1e-6)), [(1e-6, 1), (1e-4, 2)]);
        assert_eq!(told(Some(1e-4)), [(1e-4, 2)]);
        assert_eq!(told(Some(1e-3)), [(1e-3, 2)]);
        let snapped = snapping(&robot, Some(1e-3), None).unwrap().taken;
        let largest = snapped.largest().unwrap();
        assert_eq!((largest.name.as_str(), largest.angle), ("3", 1.57076));
        // The operations are those of inverse dynamics alone, and of the given plan.
        let options = Options { snap: Some(1e-3), ..Options::default() };
        let module = programs_of(robot.clone(), "arm", &options).unwrap().module;
        let mut functions = module.functions.iter();
        let torques = functions.find(|one| one.name == "inverse_dynamics").unwrap();
        assert_eq!(snapped.operations, module.counts(torques).call.operations());
        let basic = Plan::uniform(robot.links.len(), &LinkPlan::BASIC);
        let basic = snapping(&robot, Some(1e-3), Some(&basic)).unwrap().taken;
        assert!(basic.operations > snapped.operations, "{basic:?}");
    }
}
