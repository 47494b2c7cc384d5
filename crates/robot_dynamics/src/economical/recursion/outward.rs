//! The outward recursion: angular velocities, the tensors U and accelerations, from the base to the tips.
//!
//! Let ω be the angular velocity of a link, ε its angular acceleration and a the acceleration of its origin. A point
//! fixed to the link at r from the origin has the acceleration a + U r, with U = \[ε\]× + \[ω\]×². All quantities are
//! in the link's working frame, whose z axis is the joint axis.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::frames::chain::{Chain, ChainLink};
use crate::economical::frames::joint_frame::{JointFrame, joint_frames};
use crate::economical::plan::{FreeAcceleration, LinkPlan};
use crate::economical::spatial::rotation::Plane;
use crate::mechanism::BaseMotion;
use crate::vector::{Matrix, Vector};

/// The minimum lever, in the chain's unit of length, for canceling an acceleration. With shorter levers, the required
/// joint accelerations would lose digits.
const MIN_REACH: f64 = 5e-2;

/// The motion of the frame that a group of links with parallel joint axes shares, before any of their joints turns it.
#[derive(Clone, Copy, Debug)]
struct Group<'g> {
    angular_velocity: Vector<'g>,
    angular_acceleration: Vector<'g>,
    /// The third column of the parent's U; U z is the same before and after a rotation about z.
    column: Vector<'g>,
}

/// The state of a link after the outward recursion.
#[derive(Clone, Debug)]
pub(crate) struct LinkState<'g> {
    pub(crate) joint_frame: JointFrame<'g>,
    pub(crate) angular_velocity: Vector<'g>,
    pub(crate) angular_acceleration: Vector<'g>,
    /// The tensor U.
    pub(crate) tensor: Matrix<'g>,
    /// The acceleration of the origin, including gravity as an acceleration of the base.
    pub(crate) acceleration: Vector<'g>,
    /// The acceleration of the joint about or along z.
    pub(crate) rate: Expr<'g>,
    /// The component along which the acceleration of the next link's origin is zero.
    at_rest: Option<Rest>,
}

/// A child whose origin has no acceleration along a component of the link's frame.
#[derive(Clone, Copy, Debug)]
struct Rest {
    child: usize,
    component: usize,
}

/// The choice of the joint accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Accelerations {
    /// The accelerations of the chain's links.
    Given,
    /// The accelerations that each link's plan chooses.
    Free,
}

/// Runs the recursion from the base outward.
pub(crate) fn outward<'g>(
    chain: &Chain<'g>,
    plans: &[LinkPlan],
    accelerations: Accelerations,
) -> Vec<LinkState<'g>> {
    let joint_frames = joint_frames(chain, |index| plans[index].angle_sum);
    let mut states: Vec<LinkState<'g>> = Vec::with_capacity(chain.links.len());
    let mut groups: Vec<Group<'g>> = vec![];
    for (index, (link, joint_frame)) in chain.links.iter().zip(&joint_frames).enumerate() {
        let parent = link.parent.map(|parent| &states[parent]);
        let group = joint_frame.group;
        groups.push(if group == index { Group::new(chain, link, parent) } else { groups[group] });
        let before = parent.filter(|_| group != index);
        let plan = &plans[index];
        let turning = Turning::of(&groups[index], link, joint_frame.group_turn, before, plan);
        let free = match accelerations {
            Accelerations::Free if chain.drives_alone(index) => Some(plan.free),
            Accelerations::Free => Some(FreeAcceleration::Zero),
            Accelerations::Given => None,
        };
        let carried = carried_acceleration(chain, index, joint_frame, parent);
        let next = chain.children(index).next().map(|child| (child, joint_frames[child].origin));
        states.push(match link.kind {
            JointKind::Revolute => turning.rotating(link, joint_frame, carried, free, next),
            JointKind::Prismatic => turning.translating(link, joint_frame, carried, free),
        });
    }
    states
}

/// The acceleration of a link's origin due to the motion of its parent, in the link's axes.
fn carried_acceleration<'g>(
    chain: &Chain<'g>,
    index: usize,
    joint_frame: &JointFrame<'g>,
    parent: Option<&LinkState<'g>>,
) -> Vector<'g> {
    let carried = match parent {
        Some(parent) => {
            let mut carried = parent.acceleration + parent.tensor * joint_frame.origin;
            if let Some(rest) = parent.at_rest.filter(|rest| rest.child == index) {
                carried.0[rest.component] = chain.graph.zero();
            }
            carried
        }
        None => match &chain.base {
            Some(base) => base.acceleration + base_tensor(base) * joint_frame.origin,
            None => -chain.gravity,
        },
    };
    joint_frame.turn.back(chain.links[index].rotation.back(carried))
}

impl<'g> Group<'g> {
    fn new(chain: &Chain<'g>, link: &ChainLink<'g>, parent: Option<&LinkState<'g>>) -> Group<'g> {
        let (velocity, acceleration, tensor) = match (parent, &chain.base) {
            (Some(parent), _) => {
                (parent.angular_velocity, parent.angular_acceleration, parent.tensor)
            }
            (None, Some(base)) => {
                (base.angular_velocity, base.angular_acceleration, base_tensor(base))
            }
            (None, None) => {
                let zero = Vector::zero(chain.graph);
                return Group { angular_velocity: zero, angular_acceleration: zero, column: zero };
            }
        };
        Group {
            angular_velocity: link.rotation.back(velocity),
            angular_acceleration: link.rotation.back(acceleration),
            column: link.rotation.back(tensor * link.axis),
        }
    }
}

/// The rotational state of a link before its own joint's acceleration is added.
struct Turning<'g> {
    omega: Vector<'g>,
    /// ε, whose z component only contains the contribution of the carrier.
    epsilon: Vector<'g>,
    /// The third column of U, if it is known.
    column: Option<Vector<'g>>,
    /// Whether, in that case, the third row of U is computed from doubled products.
    doubled: bool,
}

impl<'g> Turning<'g> {
    /// ω, ε and the third column of U of a link, computed from those of its group and, within a group, from the
    /// preceding link.
    fn of(
        group: &Group<'g>,
        link: &ChainLink<'g>,
        turn: Plane<'g>,
        before: Option<&LinkState<'g>>,
        plan: &LinkPlan,
    ) -> Turning<'g> {
        let zero = link.ratio.graph().zero();
        let speed = match link.kind {
            JointKind::Revolute => link.motion.velocity,
            JointKind::Prismatic => zero,
        };
        // Velocities and accelerations about the common axis add up along the group.
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
                Vector([y * omega.0[2] - u23, u13 - x * omega.0[2], epsilon_z])
            }
            // ε = Rᵀ ε₀ + ω × Q̇ z, with the group's own angular velocity Q̇ about its axis.
            None => {
                let spin = omega.0[2] - omega_group.0[2];
                let Vector([ex, ey, _]) = turn.back(group.angular_acceleration);
                Vector([ex + y * spin, ey - x * spin, epsilon_z])
            }
        };
        Turning { omega, epsilon, column, doubled: plan.doubled }
    }

    fn tensor(&self) -> Matrix<'g> {
        tensor(self.omega, self.epsilon, self.column, self.doubled)
    }

    fn rotating(
        mut self,
        link: &ChainLink<'g>,
        joint_frame: &JointFrame<'g>,
        acceleration: Vector<'g>,
        free: Option<FreeAcceleration>,
        next: Option<(usize, Vector<'g>)>,
    ) -> LinkState<'g> {
        let carried = self.epsilon.0[2];
        let mut at_rest = None;
        let rate = match free {
            None => link.motion.acceleration,
            Some(free) => match self.chosen(free, acceleration, next) {
                Some((total, rest)) => {
                    at_rest = rest;
                    total - carried
                }
                None => carried.graph().zero(),
            },
        };
        self.epsilon.0[2] = match (free, at_rest) {
            (Some(FreeAcceleration::Still), _) => carried.graph().zero(),
            _ => carried + rate,
        };
        LinkState {
            joint_frame: *joint_frame,
            angular_velocity: self.omega,
            angular_acceleration: self.epsilon,
            tensor: self.tensor(),
            acceleration,
            rate,
            at_rest,
        }
    }

    /// ε_z for a choice of the joint's acceleration, and the acceleration that it cancels; `None` for the joint
    /// acceleration 0.
    fn chosen(
        &self,
        free: FreeAcceleration,
        Vector(a): Vector<'g>,
        next: Option<(usize, Vector<'g>)>,
    ) -> Option<(Expr<'g>, Option<Rest>)> {
        let Vector([x, y, _]) = self.omega;
        let xy = x * y;
        let reach = |entry: Expr<'g>| {
            entry.as_number().is_some_and(|number| number.to_f64().abs() > MIN_REACH)
        };
        match free {
            FreeAcceleration::Zero => None,
            FreeAcceleration::Still => Some((xy.graph().zero(), None)),
            FreeAcceleration::Upper => Some((xy, None)),
            FreeAcceleration::Lower => Some((-xy, None)),
            FreeAcceleration::NextX | FreeAcceleration::NextY => {
                let (child, Vector(p)) = next?;
                let component = usize::from(free == FreeAcceleration::NextY);
                let lever = p[1 - component];
                if !reach(lever) {
                    return None;
                }
                let Matrix(u) = self.tensor();
                let others = u[component][component] * p[component] + u[component][2] * p[2];
                // The entry U₁₂ = ω_x ω_y − ε_z or U₂₁ = ω_x ω_y + ε_z that cancels the remaining acceleration.
                let entry = -((a[component] + others) / lever);
                let total = if component == 0 { xy - entry } else { entry - xy };
                Some((total, Some(Rest { child, component })))
            }
        }
    }

    fn translating(
        self,
        link: &ChainLink<'g>,
        joint_frame: &JointFrame<'g>,
        carried: Vector<'g>,
        free: Option<FreeAcceleration>,
    ) -> LinkState<'g> {
        // 2 ω × q̇ z + q̈ z
        let twice = link.motion.velocity * 2;
        let Vector([x, y, _]) = self.omega;
        let zero = twice.graph().zero();
        let mut acceleration = carried + Vector([y * twice, -(x * twice), zero]);
        let rate = match free {
            None => link.motion.acceleration,
            Some(FreeAcceleration::Zero) => zero,
            Some(_) => -carried.0[2],
        };
        acceleration.0[2] += rate;
        LinkState {
            joint_frame: *joint_frame,
            angular_velocity: self.omega,
            angular_acceleration: self.epsilon,
            tensor: self.tensor(),
            acceleration,
            rate,
            at_rest: None,
        }
    }
}

fn base_tensor<'g>(base: &BaseMotion<'g>) -> Matrix<'g> {
    tensor(base.angular_velocity, base.angular_acceleration, None, false)
}

/// U = \[ε\]× + \[ω\]×²; its third column is taken over if it is known.
pub(crate) fn tensor<'g>(
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
