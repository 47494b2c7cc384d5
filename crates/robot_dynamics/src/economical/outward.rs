//! Outward: angular velocities, the tensors U and accelerations, from the base to the tips.
//!
//! With ω the angular velocity of a link and ε its angular acceleration, the acceleration of a
//! point fixed to the link at r from its origin is a + U r, U = \[ε\]× + \[ω\]×². All in the link's
//! working frame, z along its joint axis.

use super::chain::{Chain, ChainLink};
use super::plan::LinkPlan;
use super::posture::{Posture, postures};
use super::rotation::Plane;
use crate::vector::{Matrix, Vector};

/// The frame shared by a group of links whose joint axes are parallel: before any of their joints
/// turns it.
#[derive(Clone, Copy, Debug)]
struct Group<'g> {
    angular_velocity: Vector<'g>,
    angular_acceleration: Vector<'g>,
    /// The third column of the parent's U: U z is the same before and after a rotation about z.
    column: Vector<'g>,
}

/// The state of a link after the outward recursion.
#[derive(Clone, Debug)]
pub(crate) struct LinkState<'g> {
    pub(crate) posture: Posture<'g>,
    pub(crate) angular_velocity: Vector<'g>,
    pub(crate) angular_acceleration: Vector<'g>,
    /// U.
    pub(crate) tensor: Matrix<'g>,
    /// Acceleration of the origin, gravity included as an acceleration of the base.
    pub(crate) acceleration: Vector<'g>,
}

/// Runs over the links from the base.
pub(crate) fn outward<'g>(chain: &Chain<'g>, plans: &[LinkPlan]) -> Vec<LinkState<'g>> {
    let postures = postures(chain, |index| plans[index].angle_sum);
    let mut states: Vec<LinkState<'g>> = Vec::with_capacity(chain.links.len());
    let mut groups: Vec<Group<'g>> = vec![];
    for (index, (link, posture)) in chain.links.iter().zip(postures).enumerate() {
        let parent = link.parent.map(|parent| &states[parent]);
        let Posture { group, group_turn, turn, origin } = posture;
        groups.push(if group == index { Group::new(chain, link, parent) } else { groups[group] });
        let before = parent.filter(|_| group != index);
        let (angular_velocity, angular_acceleration, tensor) =
            rates(&groups[index], link, group_turn, before, &plans[index]);
        let carried = match parent {
            Some(parent) => parent.acceleration + parent.tensor * origin,
            None => -chain.gravity,
        };
        let mut acceleration = turn.back(link.rotation.back(carried));
        if !link.is_revolute() {
            // 2 ω × q̇ z + q̈ z
            let [_, speed, rate] = link.motion;
            let Vector([x, y, _]) = angular_velocity;
            let twice = speed * 2;
            acceleration = acceleration + Vector([y * twice, -(x * twice), rate]);
        }
        states.push(LinkState {
            posture,
            angular_velocity,
            angular_acceleration,
            tensor,
            acceleration,
        });
    }
    states
}

impl<'g> Group<'g> {
    fn new(chain: &Chain<'g>, link: &ChainLink<'g>, parent: Option<&LinkState<'g>>) -> Group<'g> {
        let Some(parent) = parent else {
            let zero = Vector::zero(chain.graph);
            return Group { angular_velocity: zero, angular_acceleration: zero, column: zero };
        };
        Group {
            angular_velocity: link.rotation.back(parent.angular_velocity),
            angular_acceleration: link.rotation.back(parent.angular_acceleration),
            column: link.rotation.back(parent.tensor * link.axis),
        }
    }
}

/// ω, ε and U of a link from those of its group and, within a group, of the link before.
fn rates<'g>(
    group: &Group<'g>,
    link: &ChainLink<'g>,
    turn: Plane<'g>,
    before: Option<&LinkState<'g>>,
    plan: &LinkPlan,
) -> (Vector<'g>, Vector<'g>, Matrix<'g>) {
    let graph = link.ratio.graph();
    let (speed, rate) = match link.is_revolute() {
        true => (link.motion[1], link.motion[2]),
        false => (graph.zero(), graph.zero()),
    };
    // About the common axis, rates add up along the group.
    let (omega_z, epsilon_z) = match before {
        Some(state) => (state.angular_velocity.0[2], state.angular_acceleration.0[2]),
        None => (group.angular_velocity.0[2], group.angular_acceleration.0[2]),
    };
    let omega_group = group.angular_velocity;
    let Vector([x, y, _]) = turn.back(omega_group);
    let omega = Vector([x, y, omega_z + speed]);
    let column = plan.column.then(|| turn.back(group.column));
    let epsilon = match column {
        // U₁₃ = ω_x ω_z + ε_y, U₂₃ = ω_y ω_z − ε_x
        Some(Vector([u13, u23, _])) => {
            Vector([y * omega.0[2] - u23, u13 - x * omega.0[2], epsilon_z + rate])
        }
        // ε = Rᵀ ε₀ + ω × Q̇ z, with the group's own spin Q̇ about its axis
        None => {
            let spin = omega.0[2] - omega_group.0[2];
            let Vector([ex, ey, _]) = turn.back(group.angular_acceleration);
            Vector([ex + y * spin, ey - x * spin, epsilon_z + rate])
        }
    };
    (omega, epsilon, tensor(omega, epsilon, column, plan.doubled))
}

/// U = \[ε\]× + \[ω\]×², its third column where it is known.
fn tensor<'g>(
    omega: Vector<'g>,
    epsilon: Vector<'g>,
    column: Option<Vector<'g>>,
    doubled: bool,
) -> Matrix<'g> {
    let (Vector([x, y, z]), Vector([ex, ey, ez])) = (omega, epsilon);
    let (xy, xz, yz) = (x * y, x * z, y * z);
    let (xx, yy, zz) = (x * x, y * y, z * z);
    match column {
        Some(Vector([u13, u23, u33])) => {
            let twice = z * 2;
            let (u31, u32) = match doubled {
                true => (x * twice - u13, y * twice - u23),
                false => (xz - ey, yz + ex),
            };
            Matrix([[u33 + (xx - zz), xy - ez, u13], [xy + ez, -(xx + zz), u23], [u31, u32, u33]])
        }
        None => Matrix([
            [-(yy + zz), xy - ez, xz + ey],
            [xy + ez, -(xx + zz), yz - ex],
            [xz - ey, yz + ex, -(xx + yy)],
        ]),
    }
}
