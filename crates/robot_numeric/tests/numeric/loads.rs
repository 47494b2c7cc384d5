//! Wrenches, contact forces and friction.

use nalgebra::{DVector, Vector3};
use robot_numeric::{Friction, JointKind, LinkDynamics, Loads, Mechanism, Sign, Wrench};

use crate::measure::{Worst, cases};

#[test]
fn wrenches_enter_through_the_transposed_jacobian() {
    let mut worst = Worst::default();
    for case in cases(60) {
        let (mechanism, state) = (&case.mechanism, &case.state);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let free = mechanism.inverse_dynamics(q, qd, qdd).unwrap();
        let loads = Loads { wrenches: state.wrenches.clone(), friction: false };
        let loaded = mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
        let expected = mechanism.wrench_torques(q, &state.wrenches).unwrap();
        let found = loaded - free;
        worst.compare("wrenches", &case.name, found.as_slice(), expected.as_slice(), 100.0);
    }
    worst.check(|_| 1e-13);
}

/// The balance of forces and moments on a link, equations (1) of the paper.
fn expected_contact(
    mechanism: &Mechanism,
    q: &[f64],
    dynamics: &[LinkDynamics],
    wrenches: &[Wrench],
    index: usize,
) -> (Vector3<f64>, Vector3<f64>) {
    let placements = mechanism.forward_kinematics(q).unwrap();
    let motion = &dynamics[index];
    let mut force = motion.inertial_force;
    let center = mechanism.links()[index].center_of_mass;
    let mut moment = motion.inertial_moment + center.cross(&motion.inertial_force);
    let mut passed_on = |pose: &robot_numeric::Pose, outer: &Wrench| {
        let relative = placements.links[index].inverse().then(pose);
        let outer_force = relative.rotation * outer.force;
        force += outer_force;
        moment += relative.rotation * outer.moment + relative.translation.cross(&outer_force);
    };
    for (child, link) in mechanism.links().iter().enumerate() {
        if link.parent == Some(index) {
            let (force, moment) = (dynamics[child].contact_force, dynamics[child].contact_moment);
            passed_on(&placements.links[child], &Wrench { force, moment });
        }
    }
    for (frame, wrench) in mechanism.frames().iter().zip(wrenches).enumerate() {
        if wrench.0.link == Some(index) {
            passed_on(&placements.frames[frame], wrench.1);
        }
    }
    (force, moment)
}

#[test]
fn every_link_is_in_balance_and_drives_carry_their_share() {
    let mut worst = Worst::default();
    for case in cases(60) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let dynamics = mechanism.link_dynamics(q, qd, qdd, &state.wrenches).unwrap();
        let mut torques = DVector::zeros(mechanism.coordinates());
        for (index, (link, motion)) in mechanism.links().iter().zip(&dynamics).enumerate() {
            let (force, moment) = expected_contact(mechanism, q, &dynamics, &state.wrenches, index);
            worst.compare("F_l", name, motion.contact_force.as_slice(), force.as_slice(), 1.0);
            worst.compare("M_l", name, motion.contact_moment.as_slice(), moment.as_slice(), 1.0);
            let joint = &link.joint;
            let contribution = match joint.kind {
                JointKind::Fixed => continue,
                JointKind::Revolute => joint.axis.dot(&motion.contact_moment),
                JointKind::Prismatic => joint.axis.dot(&motion.contact_force),
            };
            let rotor = link.rotor_inertia * joint.ratio * qdd[joint.coordinate];
            torques[joint.coordinate] += joint.ratio * (contribution + rotor);
        }
        let loads = Loads { wrenches: state.wrenches.clone(), friction: false };
        let tau = mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
        worst.compare("Q", name, torques.as_slice(), tau.as_slice(), 1.0);
    }
    worst.check(|_| 1e-13);
}

#[test]
fn friction_adds_to_the_torques_and_takes_power() {
    let mut worst = Worst::default();
    let mut compared = 0;
    for case in cases(60).filter(|case| case.recipe.drives) {
        let (state, name) = (&case.state, &case.name);
        let (q, qd, qdd, wrenches) = (&state.q, &state.qd, &state.qdd, &state.wrenches);
        let mechanism = without_load_friction(&case.mechanism);
        let free = Loads { wrenches: wrenches.clone(), friction: false };
        let braked = Loads { friction: true, ..free.clone() };
        let difference = mechanism.inverse_dynamics_with(q, qd, qdd, &braked).unwrap()
            - mechanism.inverse_dynamics_with(q, qd, qdd, &free).unwrap();
        // Friction that does not depend on the load is linear in the drive parameters; the inertia of rotors is
        // excluded by q̈ = 0.
        let still = vec![0.0; qd.len()];
        let expected =
            mechanism.drive_regressor(qd, &still).unwrap() * mechanism.drive_parameters();
        worst.compare("Q_f", name, difference.as_slice(), expected.as_slice(), 1.0);
        // The rest is the load-dependent friction of the random mechanism, which always opposes the motion.
        let all = case.mechanism.friction_torques(q, qd, qdd, wrenches).unwrap();
        let by_load = all - expected;
        let power = by_load.dot(&DVector::from_column_slice(qd));
        assert!(power > 0.0, "{name}: dry friction must take power, not {power}");
        compared += 1;
    }
    assert!(compared > 10);
    worst.check(|_| 1e-12);
}

fn without_load_friction(mechanism: &Mechanism) -> Mechanism {
    let mut links = mechanism.links().to_vec();
    for link in &mut links {
        link.friction.coulomb = 0.0;
    }
    Mechanism::new(*mechanism.gravity(), links, mechanism.frames().to_vec()).unwrap()
}

/// Tests equations (4) and (5) of the paper with a slider and a wheel that carry a known load.
#[test]
fn friction_follows_the_equations_of_the_paper() {
    use nalgebra::Matrix3;
    use robot_numeric::{Joint, Link, Pose};
    let friction = Friction {
        viscous: 0.5,
        coulomb: 0.1,
        spindle_diameter: 0.04,
        constant: [0.3, 0.2],
        offset: 0.05,
        sign: Sign::Exact,
    };
    let gravity = Vector3::new(0.0, 0.0, -10.0);
    let torque = |joint: Joint, friction: Friction, rate: f64| {
        let mut link =
            Link::new(None, Pose::identity(), joint, 3.0, Vector3::zeros(), Matrix3::identity());
        link.friction = friction;
        let mechanism = Mechanism::new(gravity, vec![link], vec![]).unwrap();
        mechanism.friction_torques(&[0.4], &[rate], &[0.0], &[]).unwrap()[0]
    };
    let (wheel, slider) = (Joint::revolute(Vector3::y(), 0), Joint::prismatic(Vector3::x(), 0));
    // The joint transmits 30 N upward, perpendicular to both axes.
    let cases = [
        (wheel, 2.0, 1.0 + 0.1 * 0.02 * 30.0 + 0.3 + 0.05),
        (wheel, -2.0, -1.0 - 0.1 * 0.02 * 30.0 - 0.2 + 0.05),
        (wheel, 0.0, 0.05),
        (slider, 2.0, 1.0 + 0.1 * 30.0 + 0.3 + 0.05),
        (slider, -0.0, 0.05),
    ];
    for (joint, rate, expected) in cases {
        let found = torque(joint, friction, rate);
        assert!((found - expected).abs() < 1e-14, "{joint:?} at {rate}: {found}, not {expected}");
    }
    // A load along the axis causes no friction.
    let upright = Joint::prismatic(Vector3::z(), 0);
    assert!((torque(upright, friction, 2.0) - 1.35).abs() < 1e-14);
    // A drive that turns twice as fast in the opposite direction acts on the coordinate accordingly.
    let geared = Joint { ratio: -2.0, ..slider };
    let expected = -2.0 * (-2.0 - 0.1 * 30.0 - 0.2 + 0.05);
    assert!((torque(geared, friction, 2.0) - expected).abs() < 1e-14);
    // A smooth sign with the width 2 / ln 2 is tanh(ln 2) = 3/5 at the velocity 2.
    let smooth =
        Friction { sign: Sign::Smooth(2.0 / std::f64::consts::LN_2), offset: 0.0, ..friction };
    let expected = 1.0 + 0.1 * 30.0 * 0.6 + 0.25 * 0.6 + 0.05 * 0.36;
    assert!((torque(slider, smooth, 2.0) - expected).abs() < 1e-14);
}
