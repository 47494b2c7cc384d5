//! Kinematics and energies derived directly from the links' frames, for robots whose joint axes depend on parameters:
//! the economical recursion cannot be set up for them.

use robot_model::functions::Effects;
use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, walk};

use crate::derivation::Derivation;
use crate::economical::{Column, Pose, RegressorColumns, Wrench, unit_rotor, unit_wrenches};
use crate::matrix::SymmetricMatrix;
use crate::mechanism::{MechanismFrame, MechanismLink};
use crate::newton_euler::{self, LinkMotion};
use crate::vector::{Matrix, Vector};

/// The poses of the links' frames.
pub(crate) fn link_poses<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Pose<'g>> {
    let mechanism = &derivation.mechanism;
    let base = Pose {
        rotation: Matrix::identity(mechanism.graph),
        position: Vector::zero(mechanism.graph),
    };
    let mut poses: Vec<Pose<'g>> = vec![];
    for link in &mechanism.links {
        let parent = link.parent.map_or(base, |parent| poses[parent]);
        poses.push(carried(&parent, link.joint_rotation(), link.joint_translation()));
    }
    poses
}

/// The poses of named frames.
pub(crate) fn frame_poses<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Pose<'g>> {
    let links = link_poses(derivation);
    derivation.mechanism.frames.iter().map(|frame| frame_pose(&links, frame)).collect()
}

fn frame_pose<'g>(links: &[Pose<'g>], frame: &MechanismFrame<'g>) -> Pose<'g> {
    match frame.link {
        Some(link) => carried(&links[link], frame.rotation, frame.translation),
        None => Pose { rotation: frame.rotation, position: frame.translation },
    }
}

fn carried<'g>(carrier: &Pose<'g>, rotation: Matrix<'g>, translation: Vector<'g>) -> Pose<'g> {
    Pose {
        rotation: carrier.rotation * rotation,
        position: carrier.position + carrier.rotation * translation,
    }
}

/// The geometric Jacobian of a frame, row by row.
pub(crate) fn jacobian<'g>(
    derivation: &Derivation<'_, 'g>,
    frame: &MechanismFrame<'g>,
) -> Vec<Vec<Expr<'g>>> {
    let mechanism = &derivation.mechanism;
    let poses = link_poses(derivation);
    let point = frame_pose(&poses, frame).position;
    let mut rows = vec![vec![mechanism.graph.zero(); mechanism.degrees_of_freedom]; 6];
    let mut next = frame.link;
    while let Some(index) = next {
        let (link, pose) = (&mechanism.links[index], &poses[index]);
        let axis = pose.rotation * link.axis;
        let (linear, angular) = match link.kind {
            JointKind::Revolute => (axis.cross(point - pose.position), axis),
            JointKind::Prismatic => (axis, Vector::zero(mechanism.graph)),
        };
        for (row, entry) in linear.0.into_iter().chain(angular.0).enumerate() {
            rows[row][link.coordinate] += entry * link.ratio;
        }
        next = link.parent;
    }
    rows
}

/// J̇ q̇: the time derivative of J q̇ at constant q̇.
pub(crate) fn jacobian_dot_qd<'g>(
    derivation: &Derivation<'_, 'g>,
    frame: &MechanismFrame<'g>,
) -> Vec<Expr<'g>> {
    let graph = derivation.mechanism.graph;
    let rates = derivation.coordinate_symbols(JointVariable::Velocity);
    let rows = jacobian(derivation, frame);
    let twist: Vec<Expr<'g>> = rows
        .iter()
        .map(|row| row.iter().zip(&rates).fold(graph.zero(), |sum, (j, qd)| sum + *j * *qd))
        .collect();
    let mut drift = vec![graph.zero(); twist.len()];
    for (q, qd) in derivation.coordinate_symbols(JointVariable::Position).into_iter().zip(&rates) {
        for (sum, slope) in drift.iter_mut().zip(walk::derivatives(&twist, q)) {
            *sum += slope * *qd;
        }
    }
    drift
}

/// The kinetic energy ½ q̇ᵀ M q̇.
pub(crate) fn kinetic_energy<'g>(
    derivation: &Derivation<'_, 'g>,
    matrix: &SymmetricMatrix<'g>,
) -> Expr<'g> {
    let rates = derivation.coordinate_symbols(JointVariable::Velocity);
    let mut twice = derivation.mechanism.graph.zero();
    for (row, rate) in rates.iter().enumerate() {
        for (column, other) in rates.iter().enumerate() {
            twice += matrix.at(row, column) * *rate * *other;
        }
    }
    twice / 2
}

/// The potential energy −Σ m g · c.
pub(crate) fn potential_energy<'g>(derivation: &Derivation<'_, 'g>) -> Expr<'g> {
    let mechanism = &derivation.mechanism;
    let mut energy = mechanism.graph.zero();
    for (link, pose) in mechanism.links.iter().zip(link_poses(derivation)) {
        let center = pose.position + pose.rotation * link.center_of_mass;
        energy -= link.mass * mechanism.gravity.dot(center);
    }
    energy
}

/// The contributions of the links' inertial parameters and of the rotors to the joint torques.
pub(crate) fn regressor<'g>(derivation: &Derivation<'_, 'g>) -> RegressorColumns<'g> {
    let mechanism = &derivation.mechanism;
    let effects = Effects { wrench: false, friction: false };
    let motions = newton_euler::newton_euler(mechanism, effects).motions;
    let of_link = |(index, motion): (usize, &LinkMotion<'g>)| {
        let (omega, epsilon) = (motion.angular_velocity, motion.angular_acceleration);
        let spin = Matrix::skew(omega);
        let tensor = Matrix::skew(epsilon) + spin * spin;
        let wrenches = unit_wrenches(tensor, omega, epsilon, motion.acceleration, false);
        wrenches.map(|wrench| column(derivation, &motions, Some(index), wrench))
    };
    let of_rotor = |link: &MechanismLink<'g>| {
        let none = Wrench::zero(mechanism.graph);
        let Some(carrier) = link.parent.map(|parent| &motions[parent]) else {
            return column(derivation, &motions, None, none);
        };
        let (torque, moment) = unit_rotor(
            link.axis_in_parent(),
            [link.velocity, link.acceleration],
            carrier.angular_velocity,
            carrier.angular_acceleration,
        );
        let mut column = column(derivation, &motions, link.parent, Wrench { moment, ..none });
        column[link.coordinate] += torque * link.ratio;
        column
    };
    RegressorColumns {
        links: motions.iter().enumerate().flat_map(of_link).collect(),
        rotors: mechanism.links.iter().map(of_rotor).collect(),
    }
}

/// The contributions of a wrench on a link to the joint torques.
fn column<'g>(
    derivation: &Derivation<'_, 'g>,
    motions: &[LinkMotion<'g>],
    link: Option<usize>,
    mut wrench: Wrench<'g>,
) -> Column<'g> {
    let mechanism = &derivation.mechanism;
    let mut column = vec![mechanism.graph.zero(); mechanism.degrees_of_freedom];
    let mut next = link;
    while let Some(here) = next {
        let (link, motion) = (&mechanism.links[here], &motions[here]);
        let load = match link.kind {
            JointKind::Revolute => wrench.moment,
            JointKind::Prismatic => wrench.force,
        };
        column[link.coordinate] += load.dot(link.axis) * link.ratio;
        let turned = Wrench {
            force: motion.rotation * wrench.force,
            moment: motion.rotation * wrench.moment,
        };
        wrench = turned.about(motion.origin);
        next = link.parent;
    }
    column
}
