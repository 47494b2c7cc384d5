//! The links' working frames relative to each other: rotations, origins and groups of parallel joints.

use robot_model::robot::JointKind;
use robot_symbolic::{Expr, Number};

use crate::economical::frames::chain::{Chain, ChainLink};
use crate::economical::spatial::rotation::Plane;
use crate::vector::Vector;

/// The pose of a link's working frame relative to its parent's.
///
/// Links whose joint axes are parallel may form a group. The *home axes* of a group are the axes before any of its
/// joints has turned; all links of the group share them. Every other link forms a group by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointFrame<'g> {
    /// The first link of the group.
    pub(crate) group: usize,
    /// The rotation about z from the home axes to the link's axes.
    pub(crate) group_turn: Plane<'g>,
    /// The joint's own rotation about z, including the constant rotation before it.
    pub(crate) turn: Plane<'g>,
    /// The origin in the parent's working frame.
    pub(crate) origin: Vector<'g>,
}

/// The joint frames of all links. A link whose axis is parallel to its parent's belongs to the parent's group if
/// `joins` is true for it.
pub(crate) fn joint_frames<'g>(
    chain: &Chain<'g>,
    joins: impl Fn(usize) -> bool,
) -> Vec<JointFrame<'g>> {
    let mut joint_frames: Vec<JointFrame<'g>> = Vec::with_capacity(chain.links.len());
    let mut angles: Vec<(Expr<'g>, Expr<'g>)> = vec![];
    for (index, link) in chain.links.iter().enumerate() {
        let (sine, cosine) = joint_angle(link);
        let joined = link.parent.filter(|_| joins(index) && link.is_parallel());
        let (group, angle) = match joined {
            Some(parent) => {
                let (s, c) = angles[parent];
                (joint_frames[parent].group, (s * cosine + c * sine, c * cosine - s * sine))
            }
            None => (index, (sine, cosine)),
        };
        angles.push(angle);
        joint_frames.push(JointFrame {
            group,
            group_turn: Plane::z(angle.0, angle.1),
            turn: Plane::z(sine, cosine),
            origin: match link.kind {
                JointKind::Revolute => link.translation,
                JointKind::Prismatic => link.translation + link.axis * link.motion.position,
            },
        });
    }
    joint_frames
}

/// The sine and cosine of the joint's rotation about z, including the constant rotation before it.
fn joint_angle<'g>(link: &ChainLink<'g>) -> (Expr<'g>, Expr<'g>) {
    let (sine, cosine) = link.rotation.turn;
    match link.kind {
        JointKind::Revolute => {}
        JointKind::Prismatic => return (sine, cosine),
    }
    let graph = sine.graph();
    let position = link.motion.position;
    match (sine.as_number(), cosine.as_number()) {
        (Some(s), Some(c)) => {
            let quarter = match (s.to_f64(), c.to_f64()) {
                (0.0, 1.0) => Some(0),
                (1.0, 0.0) => Some(1),
                (0.0, -1.0) => Some(2),
                (-1.0, 0.0) => Some(3),
                _ => None,
            };
            let offset = match quarter {
                Some(quarters) => graph.pi() * quarters / 2,
                None => graph.number(Number::real(s.to_f64().atan2(c.to_f64()))),
            };
            let angle = position + offset;
            (angle.sin(), angle.cos())
        }
        // The constant rotation depends on parameters, so addition formulas are used.
        _ => {
            let (s, c) = (position.sin(), position.cos());
            (s * cosine + c * sine, c * cosine - s * sine)
        }
    }
}
