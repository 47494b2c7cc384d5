//! Reasons why the base parameters of a robot cannot be determined.

use crate::robot::{BaseFrames, Link, Move, Placement, Robot};

/// The reason why the base parameters of a robot cannot be determined; `None` if they can. One case is that joints
/// share coordinates while lengths, angles, axes, gravity, ratios or offsets are parameters, so that the rank at states
/// with given values proves nothing. The other case is that Denavit–Hartenberg frames are requested while a joint axis
/// is a parameter.
#[must_use]
pub fn out_of_reach(robot: &Robot) -> Option<&'static str> {
    let is_free = |link: &Link| link.joint.axis.iter().any(|axis| axis.symbols().next().is_some());
    if robot.base_frames == BaseFrames::DenavitHartenberg && robot.links.iter().any(is_free) {
        return Some(
            "a joint axis depends on parameters, and the axes of Denavit-Hartenberg frames must \
             be known; set base_frames = \"file\", or write the axis with numbers",
        );
    }
    (has_shared_coordinates(robot) && has_free_geometry(robot)).then_some(
        "joints share a coordinate, and lengths, angles, axes, gravity, ratios or offsets are \
         parameters; write them with numbers",
    )
}

/// Whether a coordinate moves several joints, or moves a joint with a ratio other than 1.
#[must_use]
pub fn has_shared_coordinates(robot: &Robot) -> bool {
    let one = robot_symbolic::Formula::number(&robot_symbolic::Rational::ONE);
    robot.links.len() != robot.coordinates.len()
        || robot.links.iter().any(|link| link.joint.ratio != one)
}

fn has_free_geometry(robot: &Robot) -> bool {
    let of_move = |step: &Move| match step {
        Move::Translate(by) => by.iter().any(|formula| formula.symbols().next().is_some()),
        Move::Rotate(_, angle) => angle.symbols().next().is_some(),
    };
    let of_placement = |Placement(steps): &Placement| steps.iter().any(of_move);
    robot.gravity.iter().any(|formula| formula.symbols().next().is_some())
        || robot.links.iter().any(|link| {
            let joint = &link.joint;
            let mut formulas = joint.axis.iter().chain([&joint.ratio, &joint.offset]);
            of_placement(&link.placement)
                || formulas.any(|formula| formula.symbols().next().is_some())
        })
}
