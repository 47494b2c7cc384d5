//! Poses, Jacobians and J̇ q̇ in base axes.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::Recursion;
use crate::economical::frames::Frames;
use crate::economical::recursion::outward::{self, Accelerations};
use crate::mechanism::MechanismFrame;
use crate::vector::{Matrix, Vector};

/// The pose of a frame in the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pose<'g> {
    /// The rotation from frame components to base components.
    pub rotation: Matrix<'g>,
    /// The origin, m.
    pub position: Vector<'g>,
}

/// A point with axes that a link carries, in the link's working frame and in the chain's unit of length.
#[derive(Clone, Copy, Debug)]
struct Carried<'g> {
    link: usize,
    /// The rotation from frame components to components of the working frame.
    rotation: Matrix<'g>,
    point: Vector<'g>,
}

impl<'g> Recursion<'g> {
    /// The poses of the links' frames of the robot file.
    #[must_use]
    pub fn link_poses(&self) -> Vec<Pose<'g>> {
        let zero = Vector::zero(self.chain.graph);
        let unit = Matrix::identity(self.chain.graph);
        let carried: Vec<Carried<'g>> =
            (0..self.chain.links.len()).map(|link| self.carried(link, unit, zero)).collect();
        self.poses_of(&carried)
    }

    /// The poses of named frames. Those of frames on the base are constant.
    #[must_use]
    pub fn frame_poses(&self, frames: &[MechanismFrame<'g>]) -> Vec<Pose<'g>> {
        let carried: Vec<Carried<'g>> =
            frames.iter().filter_map(|frame| self.carried_frame(frame)).collect();
        let mut moving = self.poses_of(&carried).into_iter();
        let fixed = |frame: &MechanismFrame<'g>| Pose {
            rotation: frame.rotation,
            position: frame.translation,
        };
        let pose = |frame: &MechanismFrame<'g>| match frame.link {
            Some(_) => moving.next().unwrap_or_else(|| fixed(frame)),
            None => fixed(frame),
        };
        frames.iter().map(pose).collect()
    }

    fn carried_frame(&self, frame: &MechanismFrame<'g>) -> Option<Carried<'g>> {
        Some(self.carried(frame.link?, frame.rotation, frame.translation))
    }

    fn carried(&self, link: usize, rotation: Matrix<'g>, origin: Vector<'g>) -> Carried<'g> {
        let working = &self.chain.frames[link];
        let back = working.axes.transpose();
        let point = (back * (origin - working.origin)).map(|entry| entry / self.chain.unit);
        Carried { link, rotation: back * rotation, point }
    }

    fn poses_of(&self, carried: &[Carried<'g>]) -> Vec<Pose<'g>> {
        let frames = self.frames();
        let axes = own_axes(&frames);
        let mut origins: Vec<Vector<'g>> = vec![];
        for (index, link) in self.chain.links.iter().enumerate() {
            let origin = frames.joint_frames[index].origin;
            origins.push(match link.parent {
                Some(parent) => origins[parent] + axes[parent] * origin,
                None => origin,
            });
        }
        let pose = |carried: &Carried<'g>| {
            let axes = axes[carried.link];
            let position = origins[carried.link] + axes * carried.point;
            Pose { rotation: axes * carried.rotation, position: position * self.chain.unit }
        };
        carried.iter().map(pose).collect()
    }

    /// The geometric Jacobian of a frame, 6 × n, in base axes: the velocity of the frame's origin (rows 0–2) and the
    /// angular velocity of the frame (rows 3–5) at unit velocity of each coordinate.
    #[must_use]
    pub fn jacobian(&self, frame: &MechanismFrame<'g>) -> Vec<Vec<Expr<'g>>> {
        let zero = self.chain.graph.zero();
        let mut rows = vec![vec![zero; self.chain.degrees_of_freedom]; 6];
        let Some(carried) = self.carried_frame(frame) else {
            return rows;
        };
        let frames = self.frames();
        let axes = own_axes(&frames);
        // The vector from the joint's origin to the frame's origin, in base axes.
        let mut arm = axes[carried.link] * carried.point;
        let mut next = Some(carried.link);
        while let Some(index) = next {
            let link = &self.chain.links[index];
            let axis = axes[index].column(2);
            let (linear, angular) = match link.kind {
                JointKind::Revolute => (axis.cross(arm) * self.chain.unit, axis),
                JointKind::Prismatic => (axis, Vector::zero(self.chain.graph)),
            };
            for (row, entry) in linear.0.into_iter().chain(angular.0).enumerate() {
                rows[row][link.coordinate] += entry * link.ratio;
            }
            next = link.parent;
            if let Some(parent) = link.parent {
                arm = arm + axes[parent] * frames.joint_frames[index].origin;
            }
        }
        rows
    }

    /// J̇ q̇ of a frame, in base axes: the acceleration of its origin (0–2) and its angular acceleration (3–5) if the
    /// accelerations of the coordinates are zero.
    #[must_use]
    pub fn jacobian_dot_qd(&self, frame: &MechanismFrame<'g>) -> Vec<Expr<'g>> {
        let graph = self.chain.graph;
        let Some(carried) = self.carried_frame(frame) else {
            return vec![graph.zero(); 6];
        };
        let mut chain = self.chain.clone();
        chain.gravity = Vector::zero(graph);
        for link in &mut chain.links {
            link.motion.acceleration = graph.zero();
        }
        let states = outward::outward(&chain, &self.plans, Accelerations::Given);
        let state = &states[carried.link];
        let linear = (state.acceleration + state.tensor * carried.point) * chain.unit;
        let mut vectors = [linear, state.angular_acceleration];
        let mut next = Some(carried.link);
        while let Some(index) = next {
            // Transforms through the home axes of the link's parallel group to the axes of the group's parent.
            let joint_frame = &states[index].joint_frame;
            let first = &chain.links[joint_frame.group];
            vectors = vectors.map(|v| first.rotation.forward(joint_frame.group_turn.forward(v)));
            next = first.parent;
        }
        vectors.into_iter().flat_map(|vector| vector.0).collect()
    }

    /// The frames along the mechanism, with the parallel groups that `angle_sum` selects for motions.
    pub(in crate::economical) fn frames(&self) -> Frames<'_, 'g> {
        Frames::new(&self.chain, |index| self.plans[index].angle_sum)
    }
}

/// The links' own axes relative to the base axes, as rotation matrices.
fn own_axes<'g>(frames: &Frames<'_, 'g>) -> Vec<Matrix<'g>> {
    let (mut home, mut own): (Vec<Matrix<'g>>, Vec<Matrix<'g>>) = (vec![], vec![]);
    for (index, link) in frames.chain.links.iter().enumerate() {
        let at_home = match link.parent {
            Some(parent) if frames.is_joined(index) => home[parent],
            Some(parent) => rows(own[parent], |row| link.rotation.back(row)),
            None => rows(Matrix::identity(frames.chain.graph), |row| link.rotation.back(row)),
        };
        home.push(at_home);
        own.push(rows(at_home, |row| frames.joint_frames[index].group_turn.back(row)));
    }
    own
}

/// Applies a function to each row. This is a multiplication by a rotation from the right, whose transpose turns the
/// rows.
fn rows<'g>(Matrix(matrix): Matrix<'g>, turn: impl Fn(Vector<'g>) -> Vector<'g>) -> Matrix<'g> {
    Matrix(matrix.map(|row| turn(Vector(row)).0))
}
