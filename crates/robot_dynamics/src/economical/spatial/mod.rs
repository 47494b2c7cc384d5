//! Twists and wrenches about the origins of working frames, and their way from frame to frame.

pub(crate) mod inertia;
pub(crate) mod momentum;
pub(crate) mod rotation;

use robot_symbolic::{Expr, Graph};

use crate::economical::frames::chain::Chain;
use crate::economical::frames::joint_frame::{Posture, postures};
use crate::economical::plan::Place;
use crate::economical::spatial::rotation::Plane;
use crate::vector::Vector;

/// The motion of a body: its angular velocity and the velocity of its point at the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twist<'g> {
    pub(crate) angular: Vector<'g>,
    pub(crate) linear: Vector<'g>,
}

/// A force and its moment about the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wrench<'g> {
    pub(crate) force: Vector<'g>,
    pub(crate) moment: Vector<'g>,
}

impl<'g> Twist<'g> {
    /// The power of a wrench.
    pub(crate) fn dot(&self, wrench: &Wrench<'g>) -> Expr<'g> {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }

    pub(crate) fn plus(&self, other: &Twist<'g>) -> Twist<'g> {
        Twist { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }

    pub(crate) fn times(&self, rate: Expr<'g>) -> Twist<'g> {
        Twist { angular: self.angular * rate, linear: self.linear * rate }
    }

    /// The same motion about an origin at `arm`.
    fn about(self, arm: Vector<'g>) -> Twist<'g> {
        Twist { linear: self.linear + self.angular.cross(arm), ..self }
    }

    fn turned_back(&self, plane: &Plane<'g>) -> Twist<'g> {
        Twist { angular: plane.back(self.angular), linear: plane.back(self.linear) }
    }
}

impl<'g> Wrench<'g> {
    /// The same wrench about an origin from which its own lies at `arm`.
    pub(crate) fn about(self, arm: Vector<'g>) -> Wrench<'g> {
        Wrench { moment: self.moment + arm.cross(self.force), ..self }
    }

    pub(crate) fn zero(graph: &'g Graph) -> Wrench<'g> {
        Wrench { force: Vector::zero(graph), moment: Vector::zero(graph) }
    }

    pub(crate) fn plus(&self, other: &Wrench<'g>) -> Wrench<'g> {
        Wrench { force: self.force + other.force, moment: self.moment + other.moment }
    }

    /// The rate of a wrench that moves with a body: Z ×* W.
    pub(crate) fn carried_by(&self, motion: &Twist<'g>) -> Wrench<'g> {
        let Twist { angular, linear } = *motion;
        Wrench {
            force: angular.cross(self.force),
            moment: angular.cross(self.moment) + linear.cross(self.force),
        }
    }

    pub(crate) fn turned_forward(&self, plane: &Plane<'g>) -> Wrench<'g> {
        Wrench { force: plane.forward(self.force), moment: plane.forward(self.moment) }
    }
}

/// The frames through which a quantity passes on its way along the mechanism: each link has its
/// home axes (before the joints of its parallel group turn) and its own axes, both about the
/// link's origin.
#[derive(Clone, Debug)]
pub(crate) struct Ways<'c, 'g> {
    pub(crate) chain: &'c Chain<'g>,
    pub(crate) postures: Vec<Posture<'g>>,
}

impl<'c, 'g> Ways<'c, 'g> {
    /// `joins` tells which links join the parallel group of their parent.
    pub(crate) fn new(chain: &'c Chain<'g>, joins: impl Fn(usize) -> bool) -> Ways<'c, 'g> {
        Ways { chain, postures: postures(chain, joins) }
    }

    /// Whether the link shares its parent's home axes.
    pub(crate) fn is_joined(&self, link: usize) -> bool {
        self.postures[link].group != link
    }

    /// Components in the parent's own axes (the base's) to components in the link's home axes.
    pub(crate) fn parent_to_home(&self, link: usize, vector: Vector<'g>) -> Vector<'g> {
        match self.chain.links[link].parent {
            Some(parent) if self.is_joined(link) => {
                self.postures[parent].group_turn.forward(vector)
            }
            _ => self.chain.links[link].rotation.back(vector),
        }
    }

    /// The origin of a joined link from its parent's, in their home axes.
    pub(crate) fn arm_at_home(&self, link: usize) -> Vector<'g> {
        let origin = self.postures[link].origin;
        match self.chain.links[link].parent {
            Some(parent) => self.postures[parent].group_turn.forward(origin),
            None => origin,
        }
    }

    /// The place after `place` on the way to the base; `None` at the base.
    pub(crate) fn inward(&self, place: Place) -> Option<Place> {
        if place.turned {
            return Some(Place { turned: false, ..place });
        }
        let parent = self.chain.links[place.link].parent?;
        Some(Place { link: parent, turned: !self.is_joined(place.link) })
    }

    /// A wrench at `place`, at the next place inward.
    pub(crate) fn wrench_inward(&self, place: Place, wrench: &Wrench<'g>) -> Wrench<'g> {
        let (link, posture) = (&self.chain.links[place.link], &self.postures[place.link]);
        if place.turned {
            return wrench.turned_forward(&posture.group_turn);
        }
        if self.is_joined(place.link) {
            return wrench.about(self.arm_at_home(place.link));
        }
        let turned = Wrench {
            force: link.rotation.forward(wrench.force),
            moment: link.rotation.forward(wrench.moment),
        };
        turned.about(posture.origin)
    }

    /// A vector's components at `place`, at the next place inward.
    pub(crate) fn vector_inward(&self, place: Place, vector: Vector<'g>) -> Vector<'g> {
        let (link, posture) = (&self.chain.links[place.link], &self.postures[place.link]);
        if place.turned {
            posture.group_turn.forward(vector)
        } else if self.is_joined(place.link) {
            vector
        } else {
            link.rotation.forward(vector)
        }
    }

    /// A twist at the place inward of `place`, at `place`.
    pub(crate) fn twist_outward(&self, place: Place, twist: &Twist<'g>) -> Twist<'g> {
        let (link, posture) = (&self.chain.links[place.link], &self.postures[place.link]);
        if place.turned {
            return twist.turned_back(&posture.group_turn);
        }
        if self.is_joined(place.link) {
            return twist.about(self.arm_at_home(place.link));
        }
        let moved = twist.about(posture.origin);
        Twist {
            angular: link.rotation.back(moved.angular),
            linear: link.rotation.back(moved.linear),
        }
    }

    /// The motion for a unit rate of the joint; at home and in the link's own axes it is the same.
    pub(crate) fn joint_twist(&self, link: usize) -> Twist<'g> {
        let (zero, one) = (self.chain.graph.zero(), self.chain.graph.one());
        let link = &self.chain.links[link];
        // In the chain's unit of length a translation of one metre is 1/unit.
        let (angular, linear) =
            if link.is_revolute() { (one, zero) } else { (zero, one / self.chain.unit) };
        let along = |length| Vector([zero, zero, length]);
        Twist { angular: along(angular), linear: along(linear) }
    }
}
