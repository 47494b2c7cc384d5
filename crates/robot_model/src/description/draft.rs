//! The draft of a robot: values are checked, names are not yet resolved, and fixed links are not yet merged.
//!
//! The readers of all formats produce this draft.

use robot_symbolic::{Formula, Rational};

use super::locations::{BodyLocation, FrameLocation, LinkLocation};
use super::placement::Row;
use super::reader::Named;
use crate::diagnostic::Span;
use crate::robot::{BaseFrames, Body, DhConvention, Drive, Friction, JointKind, Placement, Wrench};

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
    /// A name that is not resolved yet.
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
    /// From the joint's frame to the link's own frame, if the file's convention distinguishes them.
    pub(super) after: Placement,
    /// The Denavit–Hartenberg row that gives the two placements, with its convention.
    pub(super) dh: Option<(DhConvention, Row)>,
    /// The body, placed in the link's own frame; `None` if the link has no mass.
    pub(super) body: Option<(Body, BodyLocation)>,
    pub(super) friction: Friction,
    /// Friction that the file contains but that is not part of the robot.
    pub(super) left_out: Option<Friction>,
    pub(super) drive: Drive,
    pub(super) places: LinkLocation,
}

/// The joint between a link and its parent.
#[derive(Clone)]
pub(super) struct DraftJoint {
    /// The kind of the joint; `None` for a fixed joint.
    pub(super) kind: Option<JointKind>,
    pub(super) name: Named,
    pub(super) axis: [Formula; 3],
    pub(super) limits: Option<[Rational; 2]>,
    pub(super) mimic: Option<Mimic>,
}

/// The law of a mimic joint: joint position = `ratio` × position of `joint` + `offset`.
#[derive(Clone)]
pub(super) struct Mimic {
    pub(super) joint: Named,
    pub(super) ratio: Formula,
    /// The place of the ratio, if the file states one.
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
    /// The payload's frame relative to the parent's frame.
    pub(super) placement: Placement,
    pub(super) place: Span,
}
