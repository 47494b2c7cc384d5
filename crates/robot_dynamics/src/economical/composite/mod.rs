//! Composites: each link and everything that it carries, taken together as one rigid body.

pub(crate) mod gravity;
pub(crate) mod mass_matrix;
pub(crate) mod projection;

use robot_symbolic::{Expr, Graph};

use crate::economical::frames::Frames;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::rotation::{ConstantRotation, Plane};
use crate::economical::spatial::{Twist, Wrench};
use crate::vector::{Matrix, Vector};

/// A quantity that is summed over the children of each link.
pub(crate) trait Accumulate<'g>: Copy {
    /// The empty sum.
    fn zero(graph: &'g Graph) -> Self;
    /// The sum of both.
    fn plus(&self, other: &Self) -> Self;
    /// The quantity in the axes from which a turn in the given plane leads to its own axes.
    fn turned(&self, plane: &Plane<'g>) -> Self;
    /// The quantity in the axes from which the given rotation leads to its own axes.
    fn rotated(&self, rotation: &ConstantRotation<'g>) -> Self;
    /// The quantity about another origin; `arm` is the position of its own origin relative to that one.
    fn shifted(&self, arm: Vector<'g>) -> Self;
    /// The result of [`Accumulate::shifted`] as two summands: a part that is constant if the arm is, and the rest.
    fn shifted_in_parts(&self, arm: Vector<'g>) -> (Self, Self) {
        (Self::zero(arm.0[0].graph()), self.shifted(arm))
    }
}

/// Sums a quantity of every link over everything that the link carries. The sums are about the link's origin, in its
/// home axes.
///
/// `own` is in the links' own axes.
pub(crate) fn gather<'g, T: Accumulate<'g>>(frames: &Frames<'_, 'g>, own: Vec<T>) -> Vec<T> {
    gather_across(frames, own, |_, composite| *composite)
}

/// Sums a quantity like [`gather`], for sums in which the contribution of a link to its parent differs from the link's
/// composite: `crossed` computes the contribution from the index of the link and its composite, in home axes.
pub(crate) fn gather_across<'g, T: Accumulate<'g>>(
    frames: &Frames<'_, 'g>,
    mut own: Vec<T>,
    crossed: impl Fn(usize, &T) -> T,
) -> Vec<T> {
    let chain = frames.chain;
    // The sums over the children, separately in the link's own axes and in its home axes.
    let none = T::zero(chain.graph);
    let mut from_children = vec![none; chain.links.len()];
    let mut at_home = vec![none; chain.links.len()];
    let mut composites = vec![none; chain.links.len()];
    for (index, link) in chain.links.iter().enumerate().rev() {
        let joint_frame = &frames.joint_frames[index];
        let in_own_axes = own[index].plus(&from_children[index]);
        composites[index] = in_own_axes.turned(&joint_frame.group_turn).plus(&at_home[index]);
        let Some(parent) = link.parent else { continue };
        let composite = crossed(index, &composites[index]);
        if frames.is_joined(index) {
            let (constant, rest) = composite.shifted_in_parts(frames.arm_at_home(index));
            at_home[parent] = at_home[parent].plus(&rest.plus(&constant));
        } else {
            let (constant, rest) =
                composite.rotated(&link.rotation).shifted_in_parts(joint_frame.origin);
            // Constants are added first, so that they are combined with the parent's own constants.
            own[parent] = own[parent].plus(&constant);
            from_children[parent] = from_children[parent].plus(&rest);
        }
    }
    composites
}

/// The composite pseudo-inertia of every link about its origin, in its home axes.
///
/// Regrouped mass belongs to the link to which it was moved, so that composites of links on revolute joints have no
/// mass. Composites therefore agree with those of the robot only in their effect on the joint axes.
pub(crate) fn composites<'g>(frames: &Frames<'_, 'g>) -> Vec<PseudoInertia<'g>> {
    gather(frames, frames.chain.links.iter().map(|link| link.inertia).collect())
}

impl<'g> Accumulate<'g> for PseudoInertia<'g> {
    fn zero(graph: &'g Graph) -> Self {
        PseudoInertia::zero(graph)
    }

    fn plus(&self, other: &Self) -> Self {
        PseudoInertia::plus(*self, *other)
    }

    fn turned(&self, plane: &Plane<'g>) -> Self {
        PseudoInertia {
            second: plane.forward_symmetric(self.second),
            first: plane.forward(self.first),
            mass: self.mass,
        }
    }

    fn rotated(&self, rotation: &ConstantRotation<'g>) -> Self {
        PseudoInertia {
            second: rotation.forward_symmetric(self.second),
            first: rotation.forward(self.first),
            mass: self.mass,
        }
    }

    fn shifted(&self, arm: Vector<'g>) -> Self {
        let (of_mass, rest) = self.shifted_in_parts(arm);
        rest.plus(of_mass)
    }

    /// The two parts: the contribution of the mass alone, and Σ + h pᵀ + p hᵀ with h.
    fn shifted_in_parts(&self, arm: Vector<'g>) -> (Self, Self) {
        let (Vector(h), Vector(p)) = (self.first, arm);
        let shift = arm * self.mass;
        let of_mass = PseudoInertia {
            second: symmetric(|a, b| shift.0[a] * p[b]),
            first: shift,
            mass: self.mass,
        };
        let Matrix(s) = self.second;
        let second = symmetric(|a, b| match a == b {
            true => s[a][a] + h[a] * (p[a] * 2),
            false => s[a][b] + (h[a] * p[b] + p[a] * h[b]),
        });
        let zero = self.mass.graph().zero();
        (of_mass, PseudoInertia { second, first: self.first, mass: zero })
    }
}

impl<'g> Accumulate<'g> for Wrench<'g> {
    fn zero(graph: &'g Graph) -> Self {
        Wrench::zero(graph)
    }

    fn plus(&self, other: &Self) -> Self {
        Wrench::plus(self, other)
    }

    fn turned(&self, plane: &Plane<'g>) -> Self {
        self.turned_forward(plane)
    }

    fn rotated(&self, rotation: &ConstantRotation<'g>) -> Self {
        Wrench { force: rotation.forward(self.force), moment: rotation.forward(self.moment) }
    }

    fn shifted(&self, arm: Vector<'g>) -> Self {
        self.about(arm)
    }
}

/// A free vector, without a point of application: only its components are transformed.
impl<'g> Accumulate<'g> for Vector<'g> {
    fn zero(graph: &'g Graph) -> Self {
        Vector::zero(graph)
    }

    fn plus(&self, other: &Self) -> Self {
        *self + *other
    }

    fn turned(&self, plane: &Plane<'g>) -> Self {
        plane.forward(*self)
    }

    fn rotated(&self, rotation: &ConstantRotation<'g>) -> Self {
        rotation.forward(*self)
    }

    fn shifted(&self, _arm: Vector<'g>) -> Self {
        *self
    }
}

/// A symmetric matrix from the entries of its upper triangle, so that both triangles contain the same expressions.
pub(crate) fn symmetric<'g>(entry: impl Fn(usize, usize) -> Expr<'g>) -> Matrix<'g> {
    Matrix::from_fn(|a, b| entry(a.min(b), a.max(b)))
}

/// The wrench that accelerates a body at rest by a given twist: P A.
pub(crate) fn inertial_wrench<'g>(inertia: &PseudoInertia<'g>, motion: &Twist<'g>) -> Wrench<'g> {
    let Twist { angular, linear } = *motion;
    let (first, Matrix(s)) = (inertia.first, inertia.second);
    // (tr(Σ) 1 − Σ) ε
    let turning = Vector([0, 1, 2].map(|k| {
        let (p, q) = ((k + 1) % 3, (k + 2) % 3);
        let across = s[k][p] * angular.0[p] + s[k][q] * angular.0[q];
        (s[p][p] + s[q][q]) * angular.0[k] - across
    }));
    Wrench {
        force: angular.cross(first) + linear * inertia.mass,
        moment: turning + first.cross(linear),
    }
}
