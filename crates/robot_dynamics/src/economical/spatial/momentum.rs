//! Composite momenta: B = Σ V P over a link and everything that it carries, with the motions V and pseudo-inertias P of
//! these links.

use crate::economical::composite::Accumulate;
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::rotation::{ConstantRotation, Plane};
use crate::economical::spatial::{Twist, Wrench};
use crate::vector::{Matrix, Vector};

/// The upper three rows of the 4 × 4 matrix V P, in blocks, about some origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Momentum<'g> {
    /// ∫ v rᵀ dm, in which v is the velocity of the point at r, kg m²/s.
    pub(crate) second: Matrix<'g>,
    /// ∫ v dm, kg m/s.
    pub(crate) linear: Vector<'g>,
}

impl<'g> Momentum<'g> {
    /// The momentum of one body.
    pub(crate) fn of_body(motion: &Twist<'g>, inertia: &PseudoInertia<'g>) -> Momentum<'g> {
        let Twist { angular, linear } = *motion;
        let turning = Matrix::skew(angular);
        Momentum {
            second: turning * inertia.second + Matrix::outer(linear, inertia.first),
            linear: angular.cross(inertia.first) + linear * inertia.mass,
        }
    }

    /// Whether the momentum is zero.
    pub(crate) fn is_zero(&self) -> bool {
        self.linear.is_zero() && self.second.0.iter().flatten().all(|entry| entry.is_zero())
    }

    /// The time derivative of B in axes at rest if all bodies move with the same twist: V B + B Vᵀ.
    pub(crate) fn rate(&self, motion: &Twist<'g>) -> Momentum<'g> {
        let Twist { angular, linear } = *motion;
        let turning = Matrix::skew(angular);
        Momentum {
            second: turning * self.second
                + self.second * turning.transpose()
                + Matrix::outer(self.linear, linear),
            linear: angular.cross(self.linear),
        }
    }

    /// The wrench of the matrix Ẑ B for a joint motion at unit velocity with the angular part `turning`.
    pub(crate) fn wrench_of_unit_rate(&self, turning: Vector<'g>) -> Wrench<'g> {
        let Matrix(n) = Matrix::skew(turning) * self.second;
        Wrench {
            force: turning.cross(self.linear),
            moment: Vector([n[2][1] - n[1][2], n[0][2] - n[2][0], n[1][0] - n[0][1]]),
        }
    }

    /// The projection of Ẑ B on a joint with the motion `joint`, for each component of Z's angular part.
    pub(crate) fn project(&self, joint: &Twist<'g>) -> Vector<'g> {
        let Matrix(b) = self.second;
        let Vector(z) = joint.angular;
        // ⟨\[z\]×, \[e\]× B⟩ = e · (tr B 1 − Bᵀ) z, and z · (e × b) = e · (b × z).
        let turned = Vector([0, 1, 2].map(|k| {
            let (p, q) = ((k + 1) % 3, (k + 2) % 3);
            (b[p][p] + b[q][q]) * z[k] - (b[p][k] * z[p] + b[q][k] * z[q])
        }));
        turned + self.linear.cross(joint.linear)
    }
}

impl<'g> Accumulate<'g> for Momentum<'g> {
    fn zero(graph: &'g robot_symbolic::Graph) -> Self {
        Momentum { second: Matrix::zero(graph), linear: Vector::zero(graph) }
    }

    fn plus(&self, other: &Self) -> Self {
        Momentum { second: self.second + other.second, linear: self.linear + other.linear }
    }

    fn turned(&self, plane: &Plane<'g>) -> Self {
        Momentum { second: plane.forward_tensor(self.second), linear: plane.forward(self.linear) }
    }

    fn rotated(&self, rotation: &ConstantRotation<'g>) -> Self {
        Momentum {
            second: rotation.forward_tensor(self.second),
            linear: rotation.forward(self.linear),
        }
    }

    fn shifted(&self, arm: Vector<'g>) -> Self {
        Momentum { second: self.second + Matrix::outer(self.linear, arm), ..*self }
    }
}
