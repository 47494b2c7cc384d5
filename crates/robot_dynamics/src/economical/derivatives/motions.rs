//! The motions of joints from which derivatives are computed.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use super::loads::Load;

use crate::economical::frames::Frames;
use crate::economical::recursion::outward::{self, LinkState};
use crate::economical::spatial::Twist;
use crate::vector::{Matrix, Vector};

/// The motion of a joint in its link's home axes, about the link's origin. The origin is taken as being at rest,
/// because wrenches do not change if the same velocity is added to all velocities (Galilean invariance).
#[derive(Clone, Copy, Debug)]
pub(super) struct JointMotion<'g> {
    /// Z: the motion at unit velocity.
    pub(super) unit: Twist<'g>,
    /// Y = \[V, Z\], times the factor of the motions.
    pub(super) rate: Twist<'g>,
    /// The angular part of Y, without the factor.
    pub(super) turning: Vector<'g>,
    /// X = \[A, Z\] − 2 Y V, the shift of the accelerations.
    pub(super) shift: Twist<'g>,
    /// The angular velocity ω of the link.
    pub(super) omega: Vector<'g>,
    /// The motion of the body that carries the joint.
    pub(super) carrier: Carrier<'g>,
    /// The velocity of the link's origin relative to the parent's, times the factor, in the parent's own axes or,
    /// within a group, in its home axes.
    pub(super) passed: Vector<'g>,
}

/// The motions of all joints.
pub(super) struct Motions<'g> {
    pub(super) links: Vec<JointMotion<'g>>,
    /// The factor 1 or 2. V and Y occur in pairs of equal terms in the derivatives; doubling V and Y once takes fewer
    /// operations than doubling the products.
    pub(super) factor: Expr<'g>,
}

impl<'g> Motions<'g> {
    pub(super) fn new(
        frames: &Frames<'_, 'g>,
        states: &[LinkState<'g>],
        factor: Expr<'g>,
    ) -> Motions<'g> {
        let links = 0..frames.chain.links.len();
        let links = links.map(|index| JointMotion::new(frames, states, index, factor)).collect();
        Motions { links, factor }
    }
}

impl<'g> JointMotion<'g> {
    /// The derivative, with respect to this joint's velocity, of the torque of a joint that it carries; that joint's
    /// load is given at this joint's link.
    pub(super) fn by_velocity(&self, load: &Load<'_, 'g>) -> Expr<'g> {
        self.rate.dot(&load.unit) + self.unit.angular.dot(load.projected)
    }

    /// The derivative like that of [`JointMotion::by_velocity`], with respect to this joint's position.
    pub(super) fn by_position(&self, load: &Load<'_, 'g>) -> Expr<'g> {
        self.shift.dot(&load.unit) + self.turning.dot(load.projected)
    }

    fn new(
        frames: &Frames<'_, 'g>,
        states: &[LinkState<'g>],
        index: usize,
        factor: Expr<'g>,
    ) -> JointMotion<'g> {
        let chain = frames.chain;
        let zero = Vector::zero(chain.graph);
        let link = &chain.links[index];
        let carrier = Carrier::of(frames, states, index);
        let unit = frames.joint_twist(index);
        let turning = carrier.omega.cross(unit.angular);
        let linear = carrier.omega.cross(unit.linear);
        let rate = Twist { angular: turning * factor, linear: linear * factor };
        // (U z, a × z) for a revolute joint, (0, U z) for a prismatic joint.
        let column = carrier.tensor.column(2);
        let shift = match link.kind {
            JointKind::Revolute => {
                let linear = carrier.acceleration.cross(unit.angular);
                Twist { angular: column, linear }
            }
            JointKind::Prismatic => {
                let linear = column * unit.linear.0[2];
                Twist { angular: zero, linear }
            }
        };
        let Vector([x, y, _]) = carrier.omega;
        let omega = Vector([x, y, states[index].angular_velocity.0[2]]);
        let passed = passed(frames, states, index, factor);
        JointMotion { unit, rate, turning, shift, omega, carrier, passed }
    }
}

/// The motion of the body that carries a joint, in the home axes of the joint's link.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carrier<'g> {
    pub(super) omega: Vector<'g>,
    /// The tensor U.
    pub(super) tensor: Matrix<'g>,
    /// The acceleration at the link's origin.
    pub(super) acceleration: Vector<'g>,
}

impl<'g> Carrier<'g> {
    fn of(frames: &Frames<'_, 'g>, states: &[LinkState<'g>], index: usize) -> Carrier<'g> {
        let chain = frames.chain;
        let (link, joint_frame) = (&chain.links[index], &frames.joint_frames[index]);
        let home = |vector| frames.parent_to_home(index, vector);
        let Some(parent) = link.parent else {
            return Carrier {
                omega: Vector::zero(chain.graph),
                tensor: Matrix::zero(chain.graph),
                acceleration: home(-chain.gravity),
            };
        };
        let state = &states[parent];
        let omega = home(state.angular_velocity);
        let column = home(state.tensor * link.axis);
        let turned = |Matrix(rows): Matrix<'g>| Matrix(rows.map(|row| home(Vector(row)).0));
        let exchanges_axes = !frames.is_joined(index)
            && turned(Matrix::identity(chain.graph))
                .0
                .iter()
                .flatten()
                .all(|entry| entry.is_zero() || entry.is_one() || (-*entry).is_one());
        let tensor = match exchanges_axes {
            // These are the entries in the carrier's own axes.
            true => turned(turned(state.tensor.transpose()).transpose()),
            false => outward::tensor(omega, home(state.angular_acceleration), Some(column), true),
        };
        Carrier {
            omega,
            tensor,
            acceleration: home(state.acceleration + state.tensor * joint_frame.origin),
        }
    }
}

/// The velocity of a link's origin relative to its parent's, times the factor.
fn passed<'g>(
    frames: &Frames<'_, 'g>,
    states: &[LinkState<'g>],
    index: usize,
    factor: Expr<'g>,
) -> Vector<'g> {
    let link = &frames.chain.links[index];
    let Some(parent) = link.parent else {
        return Vector::zero(frames.chain.graph);
    };
    let turning = states[parent].angular_velocity * factor;
    let joined = frames.is_joined(index);
    let carried = match joined {
        true => {
            let turning = frames.joint_frames[parent].group_turn.forward(turning);
            turning.cross(frames.arm_at_home(index))
        }
        false => turning.cross(frames.joint_frames[index].origin),
    };
    match link.kind {
        JointKind::Revolute => carried,
        JointKind::Prismatic => {
            let along = link.motion.velocity * factor;
            let axis = if joined { Vector::along_z(along) } else { link.axis * along };
            carried + axis
        }
    }
}
