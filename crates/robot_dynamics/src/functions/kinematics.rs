//! Poses and Jacobians.

use robot_model::functions::FrameRef;
use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output};
use crate::economical::plan::{LinkPlan, Origin, Turn};
use crate::economical::{Plan, Pose, Recursion};
use crate::mechanism::MechanismFrame;
use crate::plain;
use crate::vector::{Matrix, Vector};

/// The function for the poses of all links.
pub(super) fn forward_kinematics<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let poses = link_poses(derivation);
    let names = derivation.robot.links.iter().map(|link| link.name.as_str());
    let rows = format!("One row per link: {}.", quoted(names));
    derivation.of_kind(
        FunctionKind::ForwardKinematics,
        &[
            "The poses of the link frames in the base frame: rotation matrices, which transform \
             components in the link frame to components in the base frame, and origins.",
            &rows,
        ],
        pose_outputs(&poses),
    )
}

/// The function for the poses of the named frames.
pub(super) fn frame_poses<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let poses = match &derivation.recursion {
        Some(recursion) => recursion.frame_poses(&derivation.mechanism.frames),
        None => plain::frame_poses(derivation),
    };
    let names = derivation.robot.frames.iter().map(|frame| frame.name.as_str());
    let rows = format!("One row per frame: {}.", quoted(names));
    derivation.of_kind(
        FunctionKind::FramePoses,
        &[
            "The poses of the named frames in the base frame: rotation matrices, which transform \
             components in the frame to components in the base frame, and origins.",
            &rows,
        ],
        pose_outputs(&poses),
    )
}

fn quoted<'n>(names: impl Iterator<Item = &'n str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn pose_outputs<'g>(poses: &[Pose<'g>]) -> Vec<Output<'g>> {
    let rotations = poses.iter().flat_map(|pose| pose.rotation.0).flatten().collect();
    let positions = poses.iter().flat_map(|pose| pose.position.0).collect();
    vec![
        Output::new(
            "rotation",
            "Rotation matrices, each row by row",
            "1",
            vec![poses.len(), 9],
            rotations,
        ),
        Output::new("position", "Origins", "m", vec![poses.len(), 3], positions),
    ]
}

/// The poses of the links' frames, which are those of the file. They need the fewest operations with working frames at
/// the same places.
fn link_poses<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Pose<'g>> {
    let of_plan = |angle_sum: bool| {
        let file =
            LinkPlan { origin: Origin::File, turn: Turn::File, angle_sum, ..LinkPlan::BASIC };
        let plan = Plan::uniform(derivation.mechanism.links.len(), &file);
        Some(Recursion::new(&derivation.mechanism, &plan)?.link_poses())
    };
    let cost = |poses: &Vec<Pose<'g>>| {
        let values: Vec<Expr<'g>> =
            pose_outputs(poses).into_iter().flat_map(|output| output.values).collect();
        derivation.operations(&values).flops()
    };
    let forms = [of_plan(false), of_plan(true)].into_iter().flatten();
    forms.min_by_key(cost).unwrap_or_else(|| plain::link_poses(derivation))
}

/// The functions of all frames that the kind comprises.
pub(super) fn per_frame<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Vec<Function<'g>> {
    let parts = kind.parts(derivation.robot);
    if !parts.is_empty() {
        return parts.into_iter().flat_map(|part| of_frame(derivation, part)).collect();
    }
    let frames = FrameRef::usual(derivation.robot).into_iter();
    let functions = frames.filter_map(|frame| of_frame(derivation, kind.of_frame(frame)?));
    functions.map(|function| Function { name: kind.name().to_owned(), ..function }).collect()
}

/// The function of one frame; `None` if the robot does not have the frame.
pub(super) fn of_frame<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Option<Function<'g>> {
    let frame = kind.frame()?;
    let name = frame.name(derivation.robot)?;
    let (what, place) = match frame {
        FrameRef::Named(index) => {
            (format!("the frame `{name}`"), derivation.mechanism.frames.get(index)?.clone())
        }
        FrameRef::Link(index) => {
            (format!("the frame of the link `{name}`"), link_frame(derivation, name, index))
        }
    };
    let function = match kind {
        FunctionKind::JacobianDotQdOf(_) => jacobian_dot_qd(derivation, &what, &place),
        _ => jacobian(derivation, &what, &place),
    };
    Some(Function { name: kind.full_name(derivation.robot), ..function })
}

/// The frame of a moving link in the robot file, as a frame on the link.
fn link_frame<'g>(derivation: &Derivation<'_, 'g>, name: &str, index: usize) -> MechanismFrame<'g> {
    let graph = derivation.mechanism.graph;
    MechanismFrame {
        name: name.to_owned(),
        link: Some(index),
        rotation: Matrix::identity(graph),
        translation: Vector::zero(graph),
        wrench: None,
    }
}

fn jacobian<'g>(
    derivation: &Derivation<'_, 'g>,
    what: &str,
    frame: &MechanismFrame<'g>,
) -> Function<'g> {
    let rows = match &derivation.recursion {
        Some(recursion) => recursion.jacobian(frame),
        None => plain::jacobian(derivation, frame),
    };
    let doc = format!(
        "The geometric Jacobian J of {what}: J q̇ is the velocity of the frame's origin \
         (first three rows, m/s) and the angular velocity of the frame (last three rows, rad/s), both \
         in base axes."
    );
    let unit = "m and 1 for a revolute joint, 1 and 0 for a prismatic joint";
    let shape = vec![6, derivation.mechanism.degrees_of_freedom];
    let values = rows.into_iter().flatten().collect();
    derivation.of_kind(
        FunctionKind::Jacobian,
        &[&doc],
        vec![Output::new("jacobian", "The Jacobian, row by row", unit, shape, values)],
    )
}

fn jacobian_dot_qd<'g>(
    derivation: &Derivation<'_, 'g>,
    what: &str,
    frame: &MechanismFrame<'g>,
) -> Function<'g> {
    let values = match &derivation.recursion {
        Some(recursion) => recursion.jacobian_dot_qd(frame),
        None => plain::jacobian_dot_qd(derivation, frame),
    };
    let doc = format!(
        "J̇ q̇ of {what}: the part of the acceleration of the frame's origin (0 to 2, m/s²) and \
         of its angular acceleration (3 to 5, rad/s²) that depends only on velocities, in base \
         axes; J q̈ is the other part."
    );
    derivation.of_kind(
        FunctionKind::JacobianDotQd,
        &[&doc],
        vec![Output::new(
            "acceleration",
            "Velocity-product acceleration",
            "m/s² and rad/s²",
            vec![6],
            values,
        )],
    )
}
