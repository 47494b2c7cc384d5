//! Poses and Jacobians.

use robot_symbolic::Expr;

use super::{Derivation, Function, FunctionKind, Output, plain};
use crate::economical::plan::{LinkPlan, Origin, Turn};
use crate::economical::{Plan, Pose, Recursion};
use crate::model::Frame;

/// The poses of all links.
pub(super) fn forward_kinematics<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let poses = link_poses(derivation);
    let names = derivation.robot.links.iter().map(|link| link.name.as_str());
    let rows = format!("A row per link: {}.", quoted(names));
    derivation.of_kind(
        FunctionKind::ForwardKinematics,
        &[
            "The poses of the links' frames in the base frame: rotation matrices, which take \
             components in the link's frame to components in the base frame, and origins.",
            &rows,
        ],
        derivation.coordinate_inputs(["q"]),
        pose_outputs(&poses),
    )
}

/// The poses of the named frames.
pub(super) fn frame_poses<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let poses = match &derivation.recursion {
        Some(recursion) => recursion.frame_poses(&derivation.mechanism.frames),
        None => plain::frame_poses(derivation),
    };
    let names = derivation.robot.frames.iter().map(|frame| frame.name.as_str());
    let rows = format!("A row per frame: {}.", quoted(names));
    derivation.of_kind(
        FunctionKind::FramePoses,
        &[
            "The poses of the named frames in the base frame: rotation matrices, which take \
             components in the frame to components in the base frame, and origins.",
            &rows,
        ],
        derivation.coordinate_inputs(["q"]),
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

/// The links' frames are the file's: they come cheapest from working frames at the same places.
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

/// The functions of each named frame.
pub(super) fn per_frame<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Vec<Function<'g>> {
    let frames = derivation.robot.frames.iter().enumerate();
    let several = derivation.robot.frames.len() > 1;
    let names: Vec<String> =
        derivation.robot.frames.iter().map(|frame| identifier(&frame.name)).collect();
    let function = |(index, _): (usize, &Frame)| {
        let mut function = match kind {
            FunctionKind::JacobianDotQd => jacobian_dot_qd(derivation, index),
            _ => jacobian(derivation, index),
        };
        if several {
            let name = &names[index];
            let unique = names.iter().filter(|other| *other == name).count() == 1;
            let number = if unique { String::new() } else { format!("_{}", index + 1) };
            function.name = format!("{}_{name}{number}", kind.name());
        }
        function
    };
    frames.map(function).collect()
}

/// The name with everything that cannot stand in an identifier replaced.
fn identifier(name: &str) -> String {
    let fits = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    name.chars().map(fits).collect()
}

fn jacobian<'g>(derivation: &Derivation<'_, 'g>, frame: usize) -> Function<'g> {
    let rows = match &derivation.recursion {
        Some(recursion) => recursion.jacobian(&derivation.mechanism.frames[frame]),
        None => plain::jacobian(derivation, frame),
    };
    let doc = format!(
        "The geometric Jacobian J of the frame `{}`: J q̇ is the velocity of the frame's origin \
         (rows 0 to 2, m/s) and the angular velocity of the frame (rows 3 to 5, rad/s), both in \
         base axes.",
        derivation.robot.frames[frame].name
    );
    let unit = "m and 1 for a rotation, 1 and 0 for a translation";
    let shape = vec![6, derivation.mechanism.degrees_of_freedom];
    let values = rows.into_iter().flatten().collect();
    derivation.of_kind(
        FunctionKind::Jacobian,
        &[&doc],
        derivation.coordinate_inputs(["q"]),
        vec![Output::new("jacobian", "The Jacobian, row by row", unit, shape, values)],
    )
}

fn jacobian_dot_qd<'g>(derivation: &Derivation<'_, 'g>, frame: usize) -> Function<'g> {
    let values = match &derivation.recursion {
        Some(recursion) => recursion.jacobian_dot_qd(&derivation.mechanism.frames[frame]),
        None => plain::jacobian_dot_qd(derivation, frame),
    };
    let doc = format!(
        "J̇ q̇ of the frame `{}`: what velocities alone contribute to the acceleration of the \
         frame's origin (0 to 2, m/s²) and to its angular acceleration (3 to 5, rad/s²), in base \
         axes; with J q̈ they make the whole.",
        derivation.robot.frames[frame].name
    );
    derivation.of_kind(
        FunctionKind::JacobianDotQd,
        &[&doc],
        derivation.coordinate_inputs(["q", "qd"]),
        vec![Output::new(
            "acceleration",
            "Velocity-product acceleration",
            "m/s² and rad/s²",
            vec![6],
            values,
        )],
    )
}
