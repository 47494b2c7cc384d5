//! The symbols of the scheme: joints, frames, hands and the ground.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::shape::{Cylinder, Group, Line, arrow, group, line};
use super::view::View;

/// Half the length of a joint's symbol along its axis.
pub(crate) const HALF: f64 = 20.0;
/// The radius of the cylinder, which is also half the width of the box.
const RADIUS: f64 = 12.0;
/// The distances from a joint's origin to the ends of its drawn axis: against the axis, and along it.
pub(crate) const AXIS: [f64; 2] = [-40.0, 54.0];
/// The drawn length of the axes of a frame.
pub(crate) const TRIAD: f64 = 38.0;

/// The axis of a joint.
pub(crate) fn axis(view: &View, origin: &Vector3<f64>, axis: &Vector3<f64>) -> Group {
    let [from, to] = AXIS.map(|reach| view.point(&(origin + axis * reach)));
    group().class("axis").with(line(&[from, to], false))
}

/// The symbol of a revolute joint: a cylinder around its axis.
pub(crate) fn cylinder(view: &View, origin: &Vector3<f64>, axis: &Vector3<f64>) -> Cylinder {
    let along = view.point(axis);
    let nearness = view.nearness(axis);
    Cylinder {
        center: view.point(origin),
        turn: if along.norm() > 1e-9 { along.y.atan2(along.x) } else { 0.0 },
        half: HALF * along.norm(),
        radius: RADIUS,
        bulge: RADIUS * nearness.abs(),
        is_near: nearness >= 0.0,
    }
}

/// The symbol of a prismatic joint: a box between the rails of its guide.
pub(crate) fn slider(
    view: &View,
    origin: &Vector3<f64>,
    axis: &Vector3<f64>,
    rotation: &Matrix3<f64>,
) -> Group {
    let [across, beside] = normals(view, axis, rotation);
    let rails = [-1.0, 1.0].map(|side| {
        let rail = origin + across * (side * (RADIUS + 5.0));
        let ends = [-1.9, 1.9].map(|reach| view.point(&(rail + axis * (reach * HALF))));
        line(&ends, false).class("rail")
    });
    let half = [axis * HALF, across * RADIUS, beside * RADIUS];
    let faces = (0..3).map(|face| {
        // Only one of two opposite faces is visible.
        let sign = if view.nearness(&half[face]) >= 0.0 { 1.0 } else { -1.0 };
        let center = origin + half[face] * sign;
        let (u, v) = (half[(face + 1) % 3], half[(face + 2) % 3]);
        let corners = [u + v, u - v, -u - v, v - u].map(|corner| view.point(&(center + corner)));
        line(&corners, true)
    });
    group().class("joint").with_all(rails).with_all(faces)
}

/// Two directions perpendicular to an axis; the first is the one that is seen better.
fn normals(view: &View, axis: &Vector3<f64>, rotation: &Matrix3<f64>) -> [Vector3<f64>; 2] {
    let columns = rotation.column_iter().map(nalgebra::Matrix::into_owned);
    let across = |column: Vector3<f64>| (column - axis * column.dot(axis)).try_normalize(0.5);
    let first = columns.filter_map(across).next().unwrap_or(view.vertical);
    let second = axis.cross(&first);
    let seen = |direction: &Vector3<f64>| view.point(direction).norm();
    if seen(&first) >= seen(&second) { [first, second] } else { [second, first] }
}

/// The axes of a frame.
pub(crate) fn triad(view: &View, origin: &Vector3<f64>, rotation: &Matrix3<f64>) -> Group {
    let start = view.point(origin);
    let axes = rotation.column_iter().zip(["axis-x", "axis-y", "axis-z"]).map(|(axis, class)| {
        let end = view.point(&(origin + axis * TRIAD));
        group().class(class).with_all(arrow(start, end, 6.0))
    });
    group().class("triad").with_all(axes)
}

/// The symbol of the ground under a point.
pub(crate) fn ground(point: Vector2<f64>) -> Group {
    let edge = [-24.0, 24.0].map(|x| point + Vector2::new(x, 0.0));
    let hatch = (0..6).map(|index| {
        let top = point + Vector2::new(-20.0 + 8.0 * f64::from(index), 0.0);
        line(&[top, top + Vector2::new(-7.0, 8.0)], false)
    });
    group().class("ground").with(line(&edge, false)).with_all(hatch)
}

/// The hand at a tip: a fork that opens outward.
pub(crate) fn hand(view: &View, origin: &Vector3<f64>, outward: &Vector3<f64>) -> Line {
    let point = view.point(origin);
    let along = view.point(outward).try_normalize(1e-3).unwrap_or(Vector2::new(1.0, 0.0));
    let across = Vector2::new(-along.y, along.x);
    let corner = |x: f64, y: f64| point + along * x + across * y;
    let fork = [corner(9.0, -8.0), corner(0.0, -8.0), corner(0.0, 8.0), corner(9.0, 8.0)];
    line(&fork, false).class("hand")
}
