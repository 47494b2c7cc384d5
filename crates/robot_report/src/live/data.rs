//! The data about the robot that the script needs, as JSON.

use nalgebra::{Matrix3, Rotation3, Vector3};
use robot_build::Programs;
use robot_model::robot::{Axis, Frame, Link, Move, Placement, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::Formula;
use serde_json::{Value, json};

use super::controls::range;
use crate::scheme::{drawn_frames, upright};
use crate::text;

/// The coordinates, links, frames and parameters of the robot, and the directions of the view.
pub(super) fn of(programs: &Programs) -> String {
    let Programs { robot, module, .. } = programs;
    let parameters = module.parameters.iter().map(|parameter| parameter.nominal);
    let coordinates = robot.coordinates.iter().enumerate().map(|(index, coordinate)| {
        let [low, high] = range(coordinate);
        let symbol = text::symbol(&JointVariable::Position.symbol(index));
        let unit = text::unit(JointVariable::Torque.unit(coordinate.kind));
        json!({ "symbol": symbol, "low": low, "high": high, "unit": unit })
    });
    let [up, front] = upright(robot).map(list);
    let frames = frames(robot).into_iter().map(|frame| of_frame(robot, frame));
    json!({
        "coordinates": coordinates.collect::<Vec<_>>(),
        "links": robot.links.iter().map(|link| of_link(robot, link)).collect::<Vec<_>>(),
        "frames": frames.collect::<Vec<_>>(),
        "parameters": parameters.collect::<Vec<_>>(),
        "fields": module.constructor.results().len(),
        "friction": robot.has_friction(),
        "up": up,
        "front": front,
    })
    .to_string()
}

/// A link: the joint axis in its own frame, and the path to its joint in the parent's frame.
fn of_link(robot: &Robot, link: &Link) -> Value {
    let axis = Vector3::from(link.joint.axis.each_ref().map(|part| text::value(robot, part)));
    let (path, _) = walked(robot, &link.placement);
    json!({
        "parent": link.parent,
        "kind": robot_document::robot::words::motion(link.joint.kind),
        "coordinate": link.joint.coordinate,
        "axis": list(axis.try_normalize(0.0).unwrap_or_default()),
        "path": path,
    })
}

/// The frames of the scheme or, if it shows none because there are too many, the frame farthest out on the end of an
/// arm.
fn frames(robot: &Robot) -> Vec<&Frame> {
    let drawn: Vec<&Frame> = drawn_frames(robot).map(|(_, frame)| frame).collect();
    if !drawn.is_empty() {
        return drawn;
    }
    let is_end = |frame: &&Frame| {
        frame.link.is_some() && robot.links.iter().all(|link| link.parent != frame.link)
    };
    let length = |frame: &&Frame| {
        let (path, _) = walked(robot, &frame.placement);
        path.last().map_or(0.0, |end| Vector3::from(*end).norm())
    };
    let ends = robot.frames.iter().filter(is_end);
    ends.max_by(|a, b| length(a).total_cmp(&length(b))).into_iter().collect()
}

/// A frame: the path to it and its axes, in the frame of its link.
fn of_frame(robot: &Robot, frame: &Frame) -> Value {
    let (path, rotation) = walked(robot, &frame.placement);
    let axes: Vec<[f64; 3]> = rotation.column_iter().map(|axis| list(axis.into())).collect();
    json!({ "link": frame.link, "path": path, "axes": axes })
}

/// The points that the moves of a placement pass through, starting at the origin, and the axes at the end.
fn walked(robot: &Robot, placement: &Placement) -> (Vec<[f64; 3]>, Matrix3<f64>) {
    let value = |formula: &Formula| text::value(robot, formula);
    let (mut rotation, mut position) = (Matrix3::identity(), Vector3::zeros());
    let mut path = vec![list(position)];
    for step in &placement.0 {
        match step {
            Move::Translate(by) => {
                position += rotation * Vector3::from(by.each_ref().map(value));
                path.push(list(position));
            }
            Move::Rotate(axis, angle) => {
                let axis = match axis {
                    Axis::X => Vector3::x_axis(),
                    Axis::Y => Vector3::y_axis(),
                    Axis::Z => Vector3::z_axis(),
                };
                rotation *= Rotation3::from_axis_angle(&axis, value(angle)).into_inner();
            }
        }
    }
    (path, rotation)
}

fn list(vector: Vector3<f64>) -> [f64; 3] {
    vector.into()
}
