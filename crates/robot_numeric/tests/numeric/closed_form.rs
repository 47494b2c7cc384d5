//! Mechanisms whose equations are known in closed form.

use nalgebra::{DMatrix, Matrix3, Vector3};
use robot_numeric::{Frame, Joint, Link, Loads, Mechanism, Pose, Wrench};

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_xyz_rpy([x, y, z], [0.0; 3])
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-13 * b.abs().max(1.0), "{found:?}, expected {expected:?}");
    }
}

#[test]
fn pendulum() {
    let (m, l, i, g, rotor) = (2.0, 0.7, 0.3, 9.81, 0.11);
    let bob = Vector3::new(0.0, 0.0, -l);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.9, i, 0.8));
    let joint = Joint::revolute(Vector3::y(), 0);
    let mut link = Link::new(None, Pose::identity(), joint, m, bob, inertia);
    link.rotor_inertia = rotor;
    let pendulum = Mechanism::new(Vector3::new(0.0, 0.0, -g), vec![link], vec![]).unwrap();
    let (q, qd, qdd): (f64, f64, f64) = (0.8, -1.3, 2.1);
    let about = i + m * l * l + rotor;
    let tau = about * qdd + m * g * l * q.sin();
    close(pendulum.inverse_dynamics(&[q], &[qd], &[qdd]).unwrap().as_slice(), &[tau]);
    close(pendulum.articulated_body(&[q], &[qd], &[tau], &[]).unwrap().as_slice(), &[qdd]);
    let energies = pendulum.energies(&[q], &[qd]).unwrap();
    close(&[energies.kinetic, energies.potential], &[about * qd * qd / 2.0, -m * g * l * q.cos()]);
    let found = pendulum.inverse_dynamics_derivatives(&[q], &[qd], &[qdd], &[]).unwrap();
    close(found.dq.as_slice(), &[m * g * l * q.cos()]);
    // The pin supports the weight and provides the centripetal force m l q̇² along the rod.
    let load = &pendulum.link_dynamics(&[q], &[qd], &[qdd], &[]).unwrap()[0];
    let expected = [-m * l * qdd - m * g * q.sin(), 0.0, m * l * qd * qd + m * g * q.cos()];
    close(load.contact_force.as_slice(), &expected);
}

/// The textbook example of a planar arm with two links in a vertical plane.
#[test]
fn planar_arm_of_two_links() {
    let (l1, r1, r2, m1, m2, i1, i2, g) = (0.6, 0.25, 0.3, 3.0, 1.5, 0.12, 0.07, 9.81);
    let upright = |i: f64| Matrix3::from_diagonal(&Vector3::new(0.01, 0.02, i));
    let center = |r: f64| Vector3::new(r, 0.0, 0.0);
    let joint = |coordinate| Joint::revolute(Vector3::z(), coordinate);
    let links = vec![
        Link::new(None, Pose::identity(), joint(0), m1, center(r1), upright(i1)),
        Link::new(Some(0), at(l1, 0.0, 0.0), joint(1), m2, center(r2), upright(i2)),
    ];
    let arm = Mechanism::new(Vector3::new(0.0, -g, 0.0), links, vec![]).unwrap();
    let (q, qd, qdd): ([f64; 2], _, _) = ([0.4, -1.1], [1.2, -0.7], [0.3, 2.0]);
    let a = i1 + i2 + m1 * r1 * r1 + m2 * (l1 * l1 + r2 * r2);
    let (b, d) = (m2 * l1 * r2, i2 + m2 * r2 * r2);
    let (c2, s2, c12) = (q[1].cos(), q[1].sin(), (q[0] + q[1]).cos());
    let mass = [a + 2.0 * b * c2, d + b * c2, d + b * c2, d];
    close(arm.mass_matrix(&q).unwrap().as_slice(), &mass);
    let coriolis = [-b * s2 * qd[1], -b * s2 * (qd[0] + qd[1]), b * s2 * qd[0], 0.0];
    let found: DMatrix<f64> = arm.coriolis_matrix(&q, &qd).unwrap();
    close(found.transpose().as_slice(), &coriolis);
    let gravity = [(m1 * r1 + m2 * l1) * g * q[0].cos() + m2 * r2 * g * c12, m2 * r2 * g * c12];
    close(arm.gravity_torques(&q).unwrap().as_slice(), &gravity);
    let row = |i: usize| {
        mass[2 * i] * qdd[0]
            + mass[2 * i + 1] * qdd[1]
            + coriolis[2 * i] * qd[0]
            + coriolis[2 * i + 1] * qd[1]
            + gravity[i]
    };
    close(arm.inverse_dynamics(&q, &qd, &qdd).unwrap().as_slice(), &[row(0), row(1)]);
    let symbols = arm.christoffel_symbols(&q).unwrap();
    close(symbols[0].as_slice(), &[0.0, -b * s2, -b * s2, -b * s2]);
    close(symbols[1].as_slice(), &[b * s2, 0.0, 0.0, 0.0]);
}

/// A second joint that mimics the first one in the opposite direction keeps the outer link level.
#[test]
fn mimic_joint() {
    let (l, m, g) = (0.5, 2.0, 9.81);
    let level = Joint { ratio: -1.0, offset: 0.2, ..Joint::revolute(Vector3::z(), 0) };
    let links = vec![
        Link::new(
            None,
            Pose::identity(),
            Joint::revolute(Vector3::z(), 0),
            0.0,
            Vector3::zeros(),
            Matrix3::zeros(),
        ),
        Link::new(
            Some(0),
            at(l, 0.0, 0.0),
            level,
            m,
            Vector3::new(0.3, 0.1, 0.0),
            Matrix3::identity(),
        ),
    ];
    let arm = Mechanism::new(Vector3::new(0.0, -g, 0.0), links, vec![]).unwrap();
    assert_eq!(arm.coordinates(), 1);
    let q = 0.7f64;
    // The outer link only translates, on a circle of radius l.
    close(arm.mass_matrix(&[q]).unwrap().as_slice(), &[m * l * l]);
    close(arm.gravity_torques(&[q]).unwrap().as_slice(), &[m * g * l * q.cos()]);
    let outer = arm.forward_kinematics(&[q]).unwrap().links[1];
    close(&outer.rpy(), &[0.0, 0.0, 0.2]);
}

fn paper_robot() -> Mechanism {
    let joints = [
        (Joint::prismatic(Vector3::y(), 0), at(0.0, 0.0, 0.0)),
        (Joint::revolute(Vector3::z(), 1), at(0.0, 0.0, L[1])),
        (Joint::prismatic(Vector3::z(), 2), at(0.0, 0.0, L[2])),
        (Joint::prismatic(Vector3::x(), 3), at(L[4], 0.0, L[3])),
        (Joint::revolute(Vector3::y(), 4), at(L[5], 0.0, 0.0)),
    ];
    let links = joints.into_iter().enumerate().map(|(index, (joint, placement))| {
        let inertia = Matrix3::from_diagonal(&Vector3::from(J[index]));
        let parent = index.checked_sub(1);
        Link::new(parent, placement, joint, M[index], Vector3::zeros(), inertia)
    });
    let tip = Frame { link: Some(4), placement: at(L[6], 0.0, 0.0) };
    Mechanism::new(Vector3::new(0.0, 0.0, -G), links.collect(), vec![tip]).unwrap()
}

const G: f64 = 9.81;
const L: [f64; 7] = [0.0, 0.35, 0.4, 0.15, 0.3, 0.25, 0.2];
const M: [f64; 5] = [12.0, 9.0, 7.0, 5.0, 3.0];
const J: [[f64; 3]; 5] =
    [[0.5, 0.4, 0.3], [0.3, 0.35, 0.2], [0.2, 0.25, 0.15], [0.1, 0.12, 0.08], [0.03, 0.05, 0.04]];

/// The robot TRTTR1 of the paper: accelerations (12), contact force (31), forces (57), (59), (61).
#[test]
fn robot_of_the_paper() {
    let robot = paper_robot();
    let q = [0.3, 0.8, 0.1, 0.2, -0.6];
    let [d1, d2, d3, d4, d5] = [0.4, -1.1, 0.6, 0.9, 1.7];
    let [a1, a2, a3, a4, a5] = [1.5, -0.8, 0.7, 1.1, -2.0];
    let (force, moment) = (Vector3::new(4.0, -3.0, 6.0), Vector3::new(0.5, 0.7, -0.9));
    let (s2, c2) = f64::sin_cos(q[1]);
    let (s5, c5) = f64::sin_cos(q[4]);
    let wrenches = vec![Wrench { force, moment }];
    let (qd, qdd) = ([d1, d2, d3, d4, d5], [a1, a2, a3, a4, a5]);
    let links = robot.link_dynamics(&q, &qd, &qdd, &wrenches).unwrap();
    let reach = q[3] + L[4];
    let fourth = [s2 * a1 - d2 * d2 * reach + a4, c2 * a1 + a2 * reach + 2.0 * d4 * d2, G + a3];
    close(links[3].center_acceleration.as_slice(), &fourth);
    // The frame of link 5 is farther outward by l5 and rotated about y.
    let outer = [fourth[0] - d2 * d2 * L[5], fourth[1] + a2 * L[5], fourth[2]];
    let fifth = [c5 * outer[0] - s5 * outer[2], outer[1], s5 * outer[0] + c5 * outer[2]];
    close(links[4].center_acceleration.as_slice(), &fifth);
    let contact: Vec<f64> = fifth.iter().zip(force.iter()).map(|(a, f)| M[4] * a + f).collect();
    close(links[4].contact_force.as_slice(), &contact);

    let loads = Loads { wrenches, friction: false };
    let tau = robot.inverse_dynamics_with(&q, &qd, &qdd, &loads).unwrap();
    let third = -s5 * force.x + c5 * force.z + (M[2] + M[3] + M[4]) * (G + a3);
    let fourth = c5 * force.x + s5 * force.z + M[4] * outer[0] + M[3] * fourth[0];
    let fifth = moment.y - L[6] * force.z + J[4][1] * a5 + s5 * c5 * d2 * d2 * (J[4][2] - J[4][0]);
    close(&tau.as_slice()[2..], &[third, fourth, fifth]);
    // The first link does not rotate; the only moment on it is the reaction of the second joint.
    close(&[links[0].inertial_moment.norm()], &[0.0]);
    close(links[0].inertial_force.as_slice(), &[0.0, M[0] * a1, M[0] * G]);
}
