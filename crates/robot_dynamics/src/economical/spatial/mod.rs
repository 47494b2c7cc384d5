//! Twists and wrenches about the origins of working frames, and their transformations between frames.

pub(crate) mod inertia;
pub(crate) mod momentum;
pub(crate) mod rotation;

use robot_symbolic::{Expr, Graph};

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
    /// The power of a wrench on this motion.
    pub(crate) fn dot(&self, wrench: &Wrench<'g>) -> Expr<'g> {
        self.angular.dot(wrench.moment) + self.linear.dot(wrench.force)
    }

    pub(crate) fn plus(&self, other: &Twist<'g>) -> Twist<'g> {
        Twist { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }

    pub(crate) fn times(&self, rate: Expr<'g>) -> Twist<'g> {
        Twist { angular: self.angular * rate, linear: self.linear * rate }
    }

    /// This motion with respect to a new origin at `arm`.
    pub(crate) fn about(self, arm: Vector<'g>) -> Twist<'g> {
        Twist { linear: self.linear + self.angular.cross(arm), ..self }
    }

    pub(crate) fn turned_back(&self, plane: &Plane<'g>) -> Twist<'g> {
        Twist { angular: plane.back(self.angular), linear: plane.back(self.linear) }
    }
}

impl<'g> Wrench<'g> {
    /// This wrench with respect to a new origin; `arm` is the position of the old origin relative to the new one.
    pub(crate) fn about(self, arm: Vector<'g>) -> Wrench<'g> {
        Wrench { moment: self.moment + arm.cross(self.force), ..self }
    }

    pub(crate) fn zero(graph: &'g Graph) -> Wrench<'g> {
        Wrench { force: Vector::zero(graph), moment: Vector::zero(graph) }
    }

    pub(crate) fn plus(&self, other: &Wrench<'g>) -> Wrench<'g> {
        Wrench { force: self.force + other.force, moment: self.moment + other.moment }
    }

    /// The time derivative of a wrench that moves with a body: Z ×* W.
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
