//! Angles outside the range of sines and cosines.

use robot_codegen::Trigonometry;
use robot_model::diagnostic::number;
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_runtime::trig::double::LIMIT;
use robot_symbolic::Formula;

/// Returns the reason why functions have no values at these positions (rad or m): the first joint whose angle is so
/// large that the runtime's polynomials give NaN, or the magnitudes of all angles together, which bound the sums that a
/// plan uses. `None` if neither is too large.
#[must_use]
pub fn too_large_angle(robot: &Robot, q: &[f64], trigonometry: Trigonometry) -> Option<String> {
    if trigonometry == Trigonometry::Standard {
        return None;
    }
    let beyond = "outside the range of the program's sines and cosines, which is below 2^30 rad";
    let mut sum = 0.0;
    for joint in robot.links.iter().map(|link| &link.joint) {
        match joint.kind {
            JointKind::Revolute => {}
            JointKind::Prismatic => continue,
        }
        let Some(position) = q.get(joint.coordinate) else {
            continue;
        };
        let value = |formula: &Formula| formula.evaluate(|name| robot.nominal_value(name));
        let angle = value(&joint.ratio) * position + value(&joint.offset);
        if angle.abs() >= LIMIT {
            let symbol = JointVariable::Position.symbol(joint.coordinate);
            let (q, joint) = (number(*position), &joint.name);
            // The angle of a joint that mimics another is not the position of the coordinate.
            let turned = match angle == *position {
                true => {
                    format!(
                        "{symbol} = {q} rad (joint `{joint}`) is {beyond}; give it within one turn"
                    )
                }
                false => {
                    let angle = number(angle);
                    format!("{symbol} = {q} turns joint `{joint}` by {angle} rad, {beyond}")
                }
            };
            return Some(turned);
        }
        sum += angle.abs();
    }
    (sum >= LIMIT).then(|| {
        format!(
            "the magnitudes of the joint angles add up to {} rad, {beyond}; give each within one turn",
            number(sum)
        )
    })
}

#[cfg(test)]
mod tests {
    use robot_codegen::Trigonometry::{Polynomial, Standard};

    use super::*;

    const ARM: &str = r#"
format = 1
[robot]
name = "arm"
gravity = [0, 0, -9.81]
[[link]]
name = "1"
joint = { type = "revolute", axis = "z" }
massless = true
[[link]]
name = "2"
joint = { type = "revolute", axis = "z" }
origin = { xyz = [1, 0, 0] }
mass = 1
center_of_mass = [1, 0, 0]
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
"#;

    fn arm() -> Robot {
        robot_model::description::read("arm.toml", ARM).unwrap().robot
    }

    #[test]
    fn what_no_sine_takes_is_named() {
        let why = |q: [f64; 2]| too_large_angle(&arm(), &q, Polynomial);
        assert_eq!(why([1e9, 1.0]), None);
        assert!(why([1.0, -2e9]).unwrap().starts_with("q2 = -2000000000 rad (joint "));
        assert!(
            why([1e9, -1e9])
                .unwrap()
                .starts_with("the magnitudes of the joint angles add up to 2000000000 rad")
        );
        assert_eq!(too_large_angle(&arm(), &[1e9, 2e9], Standard), None);
    }

    /// The range ends below the limit, and only angles count.
    #[test]
    fn the_limit_is_out_of_range_and_lengths_are_not_angles() {
        let why = |q: [f64; 2]| too_large_angle(&arm(), &q, Polynomial);
        let below = LIMIT.next_down();
        assert_eq!([why([below, 0.0]), why([0.0, -below])], [None, None]);
        assert!(why([LIMIT, 0.0]).unwrap().starts_with("q1 = 1073741824 rad (joint "));
        assert!(why([-LIMIT, 0.0]).unwrap().starts_with("q1 = -1073741824 rad (joint "));
        assert!(why([LIMIT / 2.0, LIMIT / 2.0]).unwrap().contains("add up to 1073741824 rad"));
        let mut robot = arm();
        robot.links[0].joint.kind = JointKind::Prismatic;
        assert_eq!(too_large_angle(&robot, &[2e9, 1e9], Polynomial), None);
        assert!(too_large_angle(&robot, &[0.0, 2e9], Polynomial).unwrap().starts_with("q2 = "));
        robot.links[1].joint.offset = Formula::parse("1e9").unwrap();
        let why = too_large_angle(&robot, &[0.0, 1e9], Polynomial).unwrap();
        assert!(why.starts_with("q2 = 1000000000 turns joint "), "{why}");
        assert_eq!(too_large_angle(&robot, &[0.0], Polynomial), None);
    }

    #[test]
    fn a_joint_that_mimics_another_is_turned_by_its_own_angle() {
        let mut robot = arm();
        let joint = &mut robot.links[1].joint;
        joint.coordinate = 0;
        joint.ratio = Formula::parse("8").unwrap();
        let why = too_large_angle(&robot, &[3e8, 0.0], Polynomial).unwrap();
        assert!(why.starts_with("q1 = 300000000 turns joint `"), "{why}");
        assert!(why.contains("by 2400000000 rad"), "{why}");
    }
}
