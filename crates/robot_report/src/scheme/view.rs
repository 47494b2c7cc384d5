//! The directions from which the scheme is seen.

use nalgebra::{Vector2, Vector3};
use robot_model::robot::Robot;

use crate::text;

/// A parallel projection, given by directions of the drawing in the base frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// The direction to the right on the page.
    right: Vector3<f64>,
    /// The direction to the top of the page.
    up: Vector3<f64>,
    /// The direction out of the page, toward the viewer.
    toward: Vector3<f64>,
    /// The base axis that is nearest to the direction opposite to gravity; z without gravity.
    pub(crate) vertical: Vector3<f64>,
}

/// The angles of the views in degrees: about the vertical, and above the horizon.
const ANGLES: [[f64; 2]; 6] =
    [[28.0, 20.0], [40.0, 24.0], [16.0, 18.0], [55.0, 22.0], [-25.0, 20.0], [-45.0, 24.0]];

/// The views, with the [vertical](View::vertical) pointing up the page and the next base axis toward the viewer.
pub(crate) fn views(robot: &Robot) -> [View; 6] {
    let [up, front] = upright(robot);
    let side = up.cross(&front);
    let view = |[azimuth, elevation]: [f64; 2]| {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let right = side * cos - front * sin;
        let forth = front * cos + side * sin;
        let (sin, cos) = elevation.to_radians().sin_cos();
        View { right, up: up * cos - forth * sin, toward: forth * cos + up * sin, vertical: up }
    };
    ANGLES.map(view)
}

/// Two unit vectors along base axes: the [vertical](View::vertical) one, which points up, and that of the next axis in the
/// order x, y, z, x, which faces the viewer before the view is turned.
pub(crate) fn upright(robot: &Robot) -> [Vector3<f64>; 2] {
    let gravity = robot.gravity.each_ref().map(|part| text::value(robot, part));
    let gravity = Vector3::from(gravity.map(|part| if part.is_finite() { part } else { 0.0 }));
    // Without gravity, the z axis is vertical.
    let vertical = if gravity.norm() > 0.0 { gravity.iamax() } else { 2 };
    let sign = if gravity.norm() > 0.0 && gravity[vertical] > 0.0 { -1.0 } else { 1.0 };
    let axis = |index: usize| Vector3::ith(index % 3, 1.0);
    [axis(vertical) * sign, axis(vertical + 1)]
}

impl View {
    /// The projection of a point on the page, with y pointing down.
    pub(crate) fn point(&self, point: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(point.dot(&self.right), -point.dot(&self.up))
    }

    /// The component of a direction toward the viewer.
    pub(crate) fn nearness(&self, direction: &Vector3<f64>) -> f64 {
        direction.dot(&self.toward)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(gravity: &str) -> Robot {
        let text = format!(
            "format = 1\n[robot]\nname = \"r\"\ngravity = {gravity}\n[[link]]\nname = \"a\"\n\
             joint = {{ type = \"revolute\", axis = \"x\" }}\nmass = 1\n\
             center_of_mass = [0, 0, 1]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        );
        robot_model::description::read_toml("r.toml", &text).unwrap().robot
    }

    #[test]
    fn gravity_points_down_the_page_and_views_are_right_handed() {
        for (gravity, down) in [
            ("[0, 0, -9.81]", -Vector3::z()),
            ("[0, -9.81, 0]", -Vector3::y()),
            ("[9.81, 0, 0]", Vector3::x()),
            ("[0, 0, 0]", -Vector3::z()),
        ] {
            for view in views(&robot(gravity)) {
                let fall = view.point(&down);
                assert!(fall.y > 0.8 && fall.x.abs() < 1e-12, "{gravity}: {fall}");
                assert!((view.right.cross(&view.up) - view.toward).norm() < 1e-12);
            }
        }
    }
}
