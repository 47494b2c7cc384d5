//! Angles that sines and cosines do not take.

use robot_codegen::Trigonometry;
use robot_model::diagnostic::number;
use robot_model::robot::{JointKind, Robot};
use robot_runtime::trig::double::LIMIT;

/// Why nothing at these positions (rad or m) has a value: the first angle of a revolute joint for which the
/// polynomials of the runtime give NaN; `None` where there is none.
#[must_use]
pub fn too_large_angle(robot: &Robot, q: &[f64], trigonometry: Trigonometry) -> Option<String> {
    if trigonometry == Trigonometry::Standard {
        return None;
    }
    let mut positions = robot.coordinates.iter().zip(q).enumerate();
    let (index, (coordinate, position)) = positions.find(|(_, (coordinate, position))| {
        coordinate.kind == JointKind::Revolute && position.abs() >= LIMIT
    })?;
    Some(format!(
        "q{} = {} rad (joint `{}`) is beyond the angles that the sines of the program take, below 2^30 rad; \
         give it within a turn",
        index + 1,
        number(*position),
        coordinate.joint
    ))
}
