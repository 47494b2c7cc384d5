//! Compares quantities that are derivatives of others with finite differences of high order.

use nalgebra::{DVector, Matrix3, Vector3};
use robot_numeric::{Loads, Mechanism, Pose};

use crate::measure::{Worst, cases, derivative, moved, nudged};

/// The vector a for a skew-symmetric matrix a×.
fn unskew(matrix: &Matrix3<f64>) -> [f64; 3] {
    [matrix[(2, 1)], matrix[(0, 2)], matrix[(1, 0)]]
}

fn pose_numbers(pose: &Pose) -> Vec<f64> {
    [pose.translation.as_slice(), pose.rotation.as_slice()].concat()
}

/// The velocity and angular velocity of a frame that moves with the pose.
fn twist(pose: &Pose, along: impl Fn(f64) -> Pose) -> Vec<f64> {
    let rates = derivative(|distance| pose_numbers(&along(distance)));
    let turning = Matrix3::from_column_slice(&rates[3..]) * pose.rotation.transpose();
    [&rates[..3], &unskew(&turning)].concat()
}

#[test]
fn gravity_torques_are_the_slope_of_the_potential() {
    let mut worst = Worst::default();
    for case in cases(60) {
        let (mechanism, q) = (&case.mechanism, &case.state.q);
        let still = vec![0.0; q.len()];
        let slope = |k| {
            derivative(|step| {
                vec![mechanism.energies(&nudged(q, k, step), &still).unwrap().potential]
            })[0]
        };
        let expected: Vec<f64> = (0..q.len()).map(slope).collect();
        let gravity = mechanism.gravity_torques(q).unwrap();
        worst.compare("g", &case.name, gravity.as_slice(), &expected, 1.0);
    }
    worst.check(|_| 1e-11);
}

#[test]
fn slopes_of_the_mass_matrix_agree_with_differences() {
    let mut worst = Worst::default();
    for case in cases(36) {
        let (mechanism, q) = (&case.mechanism, &case.state.q);
        for (k, slope) in mechanism.mass_matrix_derivatives(q).unwrap().iter().enumerate() {
            let expected = derivative(|step| {
                mechanism.mass_matrix(&nudged(q, k, step)).unwrap().as_slice().to_vec()
            });
            worst.compare("dM/dq", &case.name, slope.as_slice(), &expected, 1.0);
        }
        let rate = derivative(|t| {
            let q = moved(q, &case.state.qd, t);
            mechanism.mass_matrix(&q).unwrap().as_slice().to_vec()
        });
        let coriolis = mechanism.coriolis_matrix(q, &case.state.qd).unwrap();
        let sum = &coriolis + coriolis.transpose();
        worst.compare("Mdot = C + C'", &case.name, sum.as_slice(), &rate, 1.0);
    }
    worst.check(|_| 1e-10);
}

/// d(T + V)/dt = q̇ᵀ τ − (power that the frames transmit to their surroundings).
#[test]
fn power_balances() {
    let mut worst = Worst::default();
    for case in cases(60) {
        let (mechanism, state) = (&case.mechanism, &case.state);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let loads = Loads { wrenches: state.wrenches.clone(), friction: false };
        let tau = mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
        let velocity = DVector::from_column_slice(qd);
        let mut power = tau.dot(&velocity);
        let placements = mechanism.forward_kinematics(q).unwrap();
        for (index, wrench) in state.wrenches.iter().enumerate() {
            let twist = mechanism.frame_jacobian(q, index).unwrap() * &velocity;
            let rotation = placements.frames[index].rotation;
            power -= (rotation * wrench.force).dot(&twist.fixed_rows::<3>(0));
            power -= (rotation * wrench.moment).dot(&twist.fixed_rows::<3>(3));
        }
        let change = derivative(|t| {
            let position = moved(&moved(q, qd, t), qdd, t * t / 2.0);
            let energies = mechanism.energies(&position, &moved(qd, qdd, t)).unwrap();
            vec![energies.kinetic + energies.potential]
        });
        worst.compare("power", &case.name, &change, &[power], tau.amax() * velocity.amax());
    }
    worst.check(|_| 1e-10);
}

#[test]
fn jacobians_are_derivatives_of_poses() {
    let mut worst = Worst::default();
    for case in cases(36) {
        let (mechanism, q, qd) = (&case.mechanism, &case.state.q, &case.state.qd);
        let pose_of =
            |q: &[f64], frame: usize| mechanism.forward_kinematics(q).unwrap().frames[frame];
        for frame in 0..mechanism.frames().len() {
            let pose = pose_of(q, frame);
            let jacobian = mechanism.frame_jacobian(q, frame).unwrap();
            for (k, column) in jacobian.column_iter().enumerate() {
                let expected = twist(&pose, |step| pose_of(&nudged(q, k, step), frame));
                worst.compare("frame J", &case.name, column.as_slice(), &expected, 1.0);
            }
            let velocity = DVector::from_column_slice(qd);
            let expected = derivative(|t| {
                let jacobian = mechanism.frame_jacobian(&moved(q, qd, t), frame).unwrap();
                (jacobian * &velocity).as_slice().to_vec()
            });
            let found = mechanism.frame_jacobian_dot_qd(q, qd, frame).unwrap();
            worst.compare("frame Jdot v", &case.name, found.as_slice(), &expected, 1.0);
        }
        let last = mechanism.links().len() - 1;
        let expected = derivative(|t| {
            let jacobian = mechanism.link_jacobian(&moved(q, qd, t), last).unwrap();
            (jacobian * DVector::from_column_slice(qd)).as_slice().to_vec()
        });
        let found = mechanism.link_jacobian_dot_qd(q, qd, last).unwrap();
        worst.compare("link Jdot v", &case.name, found.as_slice(), &expected, 1.0);
    }
    worst.check(|_| 1e-10);
}

#[test]
fn torque_derivatives_agree_with_differences() {
    let mut worst = Worst::default();
    for case in cases(36) {
        let (mechanism, state) = (&case.mechanism, &case.state);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let loads = Loads { wrenches: state.wrenches.clone(), friction: false };
        let torques = |q: &[f64], qd: &[f64]| {
            mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap().as_slice().to_vec()
        };
        let found = mechanism.inverse_dynamics_derivatives(q, qd, qdd, &state.wrenches).unwrap();
        let scale = mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap().amax();
        for k in 0..q.len() {
            let expected = derivative(|step| torques(&nudged(q, k, step), qd));
            worst.compare("dtau/dq", &case.name, found.dq.column(k).as_slice(), &expected, scale);
            let expected = derivative(|step| torques(q, &nudged(qd, k, step)));
            worst.compare("dtau/dqd", &case.name, found.dqd.column(k).as_slice(), &expected, scale);
        }
    }
    worst.check(|_| 1e-10);
}

/// The angular momentum of a link about its center of mass, and the linear momentum, in base axes.
fn momenta(mechanism: &Mechanism, q: &[f64], qd: &[f64], index: usize) -> Vec<f64> {
    let link = &mechanism.links()[index];
    let pose = mechanism.forward_kinematics(q).unwrap().links[index];
    let twist = mechanism.link_jacobian(q, index).unwrap() * DVector::from_column_slice(qd);
    let velocity: Vector3<f64> = twist.fixed_rows::<3>(0).into();
    let omega: Vector3<f64> = twist.fixed_rows::<3>(3).into();
    let linear = (velocity + omega.cross(&(pose.rotation * link.center_of_mass))) * link.mass;
    let angular = pose.rotation * link.inertia * pose.rotation.transpose() * omega;
    [linear.as_slice(), angular.as_slice()].concat()
}

/// Newton's and Euler's laws in their original form: the force is the time derivative of the momentum.
#[test]
fn forces_of_links_are_rates_of_momenta() {
    let mut worst = Worst::default();
    for case in cases(36) {
        let (mechanism, state) = (&case.mechanism, &case.state);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let poses = mechanism.forward_kinematics(q).unwrap().links;
        let dynamics = mechanism.link_dynamics(q, qd, qdd, &[]).unwrap();
        for (index, motion) in dynamics.iter().enumerate() {
            let rates = derivative(|t| {
                let position = moved(&moved(q, qd, t), qdd, t * t / 2.0);
                momenta(mechanism, &position, &moved(qd, qdd, t), index)
            });
            let weight = mechanism.gravity() * mechanism.links()[index].mass;
            let force = poses[index].rotation * motion.inertial_force + weight;
            let moment = poses[index].rotation * motion.inertial_moment;
            worst.compare("F", &case.name, force.as_slice(), &rates[..3], 1.0);
            worst.compare("M_c", &case.name, moment.as_slice(), &rates[3..], 1.0);
        }
    }
    worst.check(|_| 1e-10);
}
