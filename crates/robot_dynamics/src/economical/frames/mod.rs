//! The frames in which the recursion works, and the mechanism in these frames.

pub(crate) mod chain;
pub(crate) mod joint_frame;
pub(crate) mod reframed;
pub(crate) mod working;

use crate::economical::plan::Place;
use crate::economical::spatial::Twist;
use crate::vector::Vector;
use chain::Chain;
use joint_frame::{JointFrame, joint_frames};
use robot_model::robot::JointKind;

/// The frames through which a quantity is transformed along the mechanism. Each link has home axes (before the joints
/// of its parallel group turn) and its own axes, both at the link's origin.
#[derive(Clone, Debug)]
pub(crate) struct Frames<'c, 'g> {
    pub(crate) chain: &'c Chain<'g>,
    pub(crate) joint_frames: Vec<JointFrame<'g>>,
}

impl<'c, 'g> Frames<'c, 'g> {
    /// Creates the frames; `joins` determines which links join the parallel group of their parent.
    pub(crate) fn new(chain: &'c Chain<'g>, joins: impl Fn(usize) -> bool) -> Frames<'c, 'g> {
        Frames { chain, joint_frames: joint_frames(chain, joins) }
    }

    /// Whether the link shares its parent's home axes.
    pub(crate) fn is_joined(&self, link: usize) -> bool {
        self.joint_frames[link].group != link
    }

    /// Converts components in the own axes of the parent (or the base) to components in the link's home axes.
    pub(crate) fn parent_to_home(&self, link: usize, vector: Vector<'g>) -> Vector<'g> {
        match self.chain.links[link].parent {
            Some(parent) if self.is_joined(link) => {
                self.joint_frames[parent].group_turn.forward(vector)
            }
            _ => self.chain.links[link].rotation.back(vector),
        }
    }

    /// The position of a joined link's origin relative to its parent's, in their home axes.
    pub(crate) fn arm_at_home(&self, link: usize) -> Vector<'g> {
        let origin = self.joint_frames[link].origin;
        match self.chain.links[link].parent {
            Some(parent) => self.joint_frames[parent].group_turn.forward(origin),
            None => origin,
        }
    }

    /// The next place after `place` on the way to the base; `None` at the base.
    pub(crate) fn inward(&self, place: Place) -> Option<Place> {
        if place.turned {
            return Some(Place { turned: false, ..place });
        }
        let parent = self.chain.links[place.link].parent?;
        Some(Place { link: parent, turned: !self.is_joined(place.link) })
    }

    /// Converts a twist from the next place inward of `place` to `place`.
    pub(crate) fn twist_outward(&self, place: Place, twist: &Twist<'g>) -> Twist<'g> {
        let (link, joint_frame) = (&self.chain.links[place.link], &self.joint_frames[place.link]);
        if place.turned {
            return twist.turned_back(&joint_frame.group_turn);
        }
        if self.is_joined(place.link) {
            return twist.about(self.arm_at_home(place.link));
        }
        let moved = twist.about(joint_frame.origin);
        Twist {
            angular: link.rotation.back(moved.angular),
            linear: link.rotation.back(moved.linear),
        }
    }

    /// The twist of the joint at unit velocity, which is the same in home axes and in the link's own axes.
    pub(crate) fn joint_twist(&self, link: usize) -> Twist<'g> {
        let (zero, one) = (self.chain.graph.zero(), self.chain.graph.one());
        let link = &self.chain.links[link];
        // In the chain's unit of length, a translation of one meter is 1/unit.
        let (angular, linear) = match link.kind {
            JointKind::Revolute => (one, zero),
            JointKind::Prismatic => (zero, one / self.chain.unit),
        };
        let along = |length| Vector([zero, zero, length]);
        Twist { angular: along(angular), linear: along(linear) }
    }
}
