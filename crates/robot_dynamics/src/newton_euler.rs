//! The paper's iterations: the outward and inward Newton–Euler recursions in the frames of the links.
//!
//! Symbols and equation numbers are those of the paper "The dynamic model of TRTTR1 modular serial robot": a_c, F and
//! M_c for each link, F_l and M_l for each joint, Q for each coordinate. Every vector is in the frame of its own link;
//! M_l is taken about the origin of this frame. The iterations hold for trees and for joints about or along arbitrary
//! axes.
//!
//! This recursion is meant for readers: its expressions expand to the equations that the paper prints. The recursion
//! for code needs fewer operations, but its internal forces have no physical meaning.

use robot_model::functions::Effects;
use robot_model::robot::JointKind;
use robot_model::unit::Dimension;
use robot_symbolic::Expr;

use crate::mechanism::{BaseMotion, Mechanism, MechanismFriction, MechanismLink};
use crate::quantity::{Kind, Quantity, Symbol};
use crate::vector::{Matrix, Vector};

/// The motion of a link, in its own frame.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion<'g> {
    /// \[R\]ᵢ: the rotation from link components to parent components.
    pub rotation: Matrix<'g>,
    /// r̄ᵢ: the origin of the frame in parent components, m.
    pub origin: Vector<'g>,
    /// ω̄: angular velocity, rad/s.
    pub angular_velocity: Vector<'g>,
    /// ε̄: angular acceleration, rad/s².
    pub angular_acceleration: Vector<'g>,
    /// ā: acceleration of the origin, including gravity as an acceleration of the base, m/s².
    pub acceleration: Vector<'g>,
    /// ā_c: acceleration of the center of mass, equation (8), m/s².
    pub center_of_mass_acceleration: Vector<'g>,
    /// F̄ = M ā_c, equation (14), N.
    pub force: Vector<'g>,
    /// M̄_c = J* ε̄ + ω̄ × J* ω̄, equation (20), N m.
    pub moment: Vector<'g>,
}

/// The wrench that a link receives through its joint, in the link's frame.
#[derive(Clone, Copy, Debug)]
pub struct LinkWrench<'g> {
    /// F̄_l: the force that the link receives through its joint, equation (26), N.
    pub force: Vector<'g>,
    /// M̄_l: the moment about the frame's origin, equation (36), N m.
    pub moment: Vector<'g>,
}

/// The results of both iterations.
#[derive(Clone, Debug)]
pub struct NewtonEuler<'g> {
    /// The motion of each link, from the outward iterations.
    pub motions: Vec<LinkMotion<'g>>,
    /// The wrench of each link, from the inward iterations.
    pub wrenches: Vec<LinkWrench<'g>>,
    /// The joint torque or force of each coordinate, equation (3), N m or N.
    pub joint_torques: Vec<Expr<'g>>,
    kinds: Vec<JointKind>,
}

/// Runs both iterations and projects the wrenches on the joint axes; `effects` selects friction and the wrenches of the
/// tips.
#[must_use]
pub fn newton_euler<'g>(mechanism: &Mechanism<'g>, effects: Effects) -> NewtonEuler<'g> {
    let motions = outward(mechanism);
    let wrenches = inward(mechanism, &motions, effects);
    let mut joint_torques = vec![mechanism.graph.zero(); mechanism.degrees_of_freedom];
    let mut kinds = vec![JointKind::Revolute; mechanism.degrees_of_freedom];
    for (link, wrench) in mechanism.links.iter().zip(&wrenches) {
        // (2): the wrench projected on the joint axis, plus the inertia of the drive itself.
        let contact = match link.kind {
            JointKind::Revolute => wrench.moment,
            JointKind::Prismatic => wrench.force,
        };
        let mut force = contact.dot(link.axis)
            + link.reflected_inertia * link.acceleration
            + rotor_torque(link, &motions);
        if effects.friction {
            force += friction(&link.friction, link.kind, link.axis, wrench.force, link.velocity);
        }
        joint_torques[link.coordinate] += force * link.ratio;
        kinds[link.coordinate] = link.kind;
    }
    NewtonEuler { motions, wrenches, joint_torques, kinds }
}

/// The outward iterations, from the base to the tips.
fn outward<'g>(mechanism: &Mechanism<'g>) -> Vec<LinkMotion<'g>> {
    // Gravity is represented by the opposite acceleration of the base.
    let base = mechanism.base.unwrap_or(BaseMotion::at_rest(mechanism.gravity));
    let base = (base.angular_velocity, base.angular_acceleration, base.acceleration);
    let mut motions: Vec<LinkMotion<'g>> = Vec::with_capacity(mechanism.links.len());
    for link in &mechanism.links {
        let (omega, epsilon, a) = link.parent.map_or(base, |parent| {
            let motion = &motions[parent];
            (motion.angular_velocity, motion.angular_acceleration, motion.acceleration)
        });
        let (rotation, origin) = (link.joint_rotation(), link.joint_translation());
        let turned_back = rotation.transpose();
        // The motion of the parent at this link's origin, in this link's axes.
        let carried_omega = turned_back * omega;
        let carried_epsilon = turned_back * epsilon;
        let carried_a =
            turned_back * (a + epsilon.cross(origin) + omega.cross(omega.cross(origin)));
        let (speed, rate) = (link.axis * link.velocity, link.axis * link.acceleration);
        let (omega, epsilon, a) = match link.kind {
            JointKind::Revolute => (
                carried_omega + speed,
                carried_epsilon + carried_omega.cross(speed) + rate,
                carried_a,
            ),
            JointKind::Prismatic => (
                carried_omega,
                carried_epsilon,
                carried_a + carried_omega.cross(speed) * mechanism.graph.integer(2) + rate,
            ),
        };
        let r = link.center_of_mass;
        let a_c = a + epsilon.cross(r) + omega.cross(omega.cross(r)); // (8)
        let inertia = link.inertia;
        motions.push(LinkMotion {
            rotation,
            origin,
            angular_velocity: omega,
            angular_acceleration: epsilon,
            acceleration: a,
            center_of_mass_acceleration: a_c,
            force: a_c * link.mass,                                   // (14)
            moment: inertia * epsilon + omega.cross(inertia * omega), // (20)
        });
    }
    motions
}

/// The inward iterations, from the tips to the base.
fn inward<'g>(
    mechanism: &Mechanism<'g>,
    motions: &[LinkMotion<'g>],
    effects: Effects,
) -> Vec<LinkWrench<'g>> {
    let zero = Vector::zero(mechanism.graph);
    let mut wrenches = vec![LinkWrench { force: zero, moment: zero }; mechanism.links.len()];
    for (frame, (force, moment)) in
        mechanism.frames.iter().filter_map(|frame| Some((frame, frame.wrench?)))
    {
        if let (true, Some(link)) = (effects.wrench, frame.link) {
            let wrench = LinkWrench { force, moment };
            wrenches[link] =
                wrenches[link].plus(wrench.seen_from(frame.rotation, frame.translation));
        }
    }
    for (index, link) in mechanism.links.iter().enumerate().rev() {
        let motion = &motions[index];
        // (26) and (36): the wrenches of the children and the tips, and the wrench that the link's own motion requires.
        let own = LinkWrench {
            force: motion.force,
            moment: motion.moment + link.center_of_mass.cross(motion.force),
        };
        wrenches[index] = wrenches[index].plus(own);
        if let Some(parent) = link.parent {
            let in_parent = wrenches[index].seen_from(motion.rotation, motion.origin);
            let rotor = LinkWrench { force: zero, moment: rotor_moment(link, &motions[parent]) };
            wrenches[parent] = wrenches[parent].plus(in_parent).plus(rotor);
        }
    }
    wrenches
}

/// The moment that a gyroscopic rotor requires from the link that carries it, beyond that of a locked rotor: the time
/// derivative of its angular momentum J N q̇ a, with the joint axis a fixed to the carrier.
fn rotor_moment<'g>(link: &MechanismLink<'g>, carrier: &LinkMotion<'g>) -> Vector<'g> {
    let axis = link.axis_in_parent();
    let turning = carrier.angular_velocity.cross(axis) * link.velocity;
    (axis * link.acceleration + turning) * link.rotor_coupling
}

/// The torque that a gyroscopic rotor requires at its joint while its carrier turns: J N a · ε, with ε of the carrier.
fn rotor_torque<'g>(link: &MechanismLink<'g>, motions: &[LinkMotion<'g>]) -> Expr<'g> {
    let carrier = link.parent.map(|parent| motions[parent].angular_acceleration);
    let zero = link.rotor_coupling.graph().zero();
    carrier.map_or(zero, |epsilon| link.axis_in_parent().dot(epsilon) * link.rotor_coupling)
}

impl<'g> LinkWrench<'g> {
    /// The wrench in the axes and about the origin of a frame relative to which its own frame is at `origin` and
    /// rotated by `rotation`.
    fn seen_from(self, rotation: Matrix<'g>, origin: Vector<'g>) -> LinkWrench<'g> {
        let force = rotation * self.force;
        LinkWrench { force, moment: rotation * self.moment + origin.cross(force) }
    }

    fn plus(self, other: LinkWrench<'g>) -> LinkWrench<'g> {
        LinkWrench { force: self.force + other.force, moment: self.moment + other.moment }
    }
}

/// The friction Q_f of equations (4) and (5), including the additional terms of the robot file, N m or N. The contact
/// force F̄_l and the axis are in the link's axes.
#[must_use]
pub fn friction<'g>(
    friction: &MechanismFriction<'g>,
    kind: JointKind,
    axis: Vector<'g>,
    contact_force: Vector<'g>,
    velocity: Expr<'g>,
) -> Expr<'g> {
    let sign = friction.sign(velocity);
    let mut force = friction.viscous * velocity + friction.offset; // (4)
    if !friction.coulomb.is_zero() {
        let across = axis.cross(contact_force).norm();
        let lever = match kind {
            JointKind::Revolute => friction.spindle_diameter / 2,
            JointKind::Prismatic => velocity.graph().one(),
        };
        force += friction.coulomb * lever * across * sign; // (5)
    }
    let (positive, negative) = (friction.coulomb_positive, friction.coulomb_negative);
    // Constant dry friction: the mean times the sign, and half of the difference times the squared sign.
    force += (positive + negative) / 2 * sign;
    force + (positive - negative) / 2 * sign * sign
}

impl<'g> NewtonEuler<'g> {
    /// All quantities of a kind, in the order of the links (of the coordinates for Q) and components.
    #[must_use]
    pub fn quantities(&self, kind: Kind) -> Vec<Quantity<'g>> {
        let vectors: Vec<Vector<'g>> = match kind {
            Kind::CenterOfMassAcceleration => {
                self.motions.iter().map(|motion| motion.center_of_mass_acceleration).collect()
            }
            Kind::Force => self.motions.iter().map(|motion| motion.force).collect(),
            Kind::Moment => self.motions.iter().map(|motion| motion.moment).collect(),
            Kind::LinkForce => self.wrenches.iter().map(|wrench| wrench.force).collect(),
            Kind::LinkMoment => self.wrenches.iter().map(|wrench| wrench.moment).collect(),
            Kind::JointTorque => return self.joint_torque_quantities(),
        };
        let dimension = match kind {
            Kind::CenterOfMassAcceleration => Dimension::ACCELERATION,
            Kind::Force | Kind::LinkForce => Dimension::FORCE,
            _ => Dimension::MOMENT,
        };
        let mut quantities = vec![];
        for (index, Vector(components)) in vectors.into_iter().enumerate() {
            for (component, value) in components.into_iter().enumerate() {
                let symbol = Symbol { kind, number: index + 1, component: Some(component) };
                quantities.push(Quantity { symbol, value, dimension });
            }
        }
        quantities
    }

    fn joint_torque_quantities(&self) -> Vec<Quantity<'g>> {
        let forces = self.joint_torques.iter().zip(&self.kinds).enumerate();
        let quantity = |(index, (value, kind)): (usize, (&Expr<'g>, &JointKind))| Quantity {
            symbol: Symbol { kind: Kind::JointTorque, number: index + 1, component: None },
            value: *value,
            dimension: match kind {
                JointKind::Revolute => Dimension::MOMENT,
                JointKind::Prismatic => Dimension::FORCE,
            },
        };
        forces.map(quantity).collect()
    }
}
