//! A robot file after lowering: checked values, names unresolved, fixed links still apart.
//!
//! Whatever the format of the file, this is where the formats meet.

use robot_symbolic::{Formula, Rational};

use super::locations::{BodyLocation, FrameLocation, LinkLocation};
use super::reader::Named;
use crate::diagnostic::Span;
use crate::robot::{BaseFrames, Body, Drive, Friction, JointKind, Placement, Wrench};

/// A robot as a file describes it.
#[derive(Clone)]
pub(super) struct Draft {
    pub(super) name: Named,
    pub(super) description: Option<String>,
    pub(super) gravity: [Formula; 3],
    pub(super) gravity_place: Option<Span>,
    pub(super) snap: Option<f64>,
    pub(super) base_frames: BaseFrames,
    pub(super) links: Vec<DraftLink>,
    pub(super) frames: Vec<DraftFrame>,
    pub(super) payload: Option<DraftPayload>,
}

/// The carrier of a link or frame.
#[derive(Clone, Debug)]
pub(super) enum Parent {
    Base,
    Link(usize),
    /// A name that is still to be found.
    Name(Named),
}

/// A link, moving or fixed.
#[derive(Clone)]
pub(super) struct DraftLink {
    pub(super) name: Named,
    pub(super) parent: Parent,
    pub(super) joint: DraftJoint,
    /// From the parent's frame to the joint's frame at joint position 0.
    pub(super) before: Placement,
    /// From the joint's frame to the link's own frame, if the file's convention puts them
    /// apart.
    pub(super) after: Placement,
    /// Placed in the link's own frame; `None` if the link has no mass.
    pub(super) body: Option<(Body, BodyLocation)>,
    pub(super) friction: Friction,
    /// Friction that the file has and the robot has not.
    pub(super) left_out: Option<Friction>,
    pub(super) drive: Drive,
    pub(super) places: LinkLocation,
}

/// The joint between a link and its parent.
#[derive(Clone)]
pub(super) struct DraftJoint {
    /// `None` for a fixed link.
    pub(super) kind: Option<JointKind>,
    pub(super) name: Named,
    pub(super) axis: [Formula; 3],
    pub(super) limits: Option<[Rational; 2]>,
    pub(super) mimic: Option<Mimic>,
}

/// Joint position = `ratio` × that of `joint` + `offset`.
#[derive(Clone)]
pub(super) struct Mimic {
    pub(super) joint: Named,
    pub(super) ratio: Formula,
    /// The place of the ratio, if the file has one.
    pub(super) of_ratio: Option<Span>,
    pub(super) offset: Formula,
}

/// A named frame or a tip.
#[derive(Clone)]
pub(super) struct DraftFrame {
    pub(super) name: Named,
    pub(super) parent: Parent,
    pub(super) placement: Placement,
    pub(super) wrench: Option<Wrench>,
    pub(super) places: FrameLocation,
}

/// The body that the robot may carry.
#[derive(Clone)]
pub(super) struct DraftPayload {
    pub(super) parent: Parent,
    /// From the parent's frame to that of the payload's values.
    pub(super) placement: Placement,
    pub(super) place: Span,
}
