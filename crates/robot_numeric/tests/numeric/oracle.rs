//! Compares the solver with values of Pinocchio for six arms (tests/fixtures/oracle at the root of the project).

use std::fs;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use robot_numeric::{Frame, Joint, Link, Mechanism, Pose};
use serde_json::Value;

use crate::measure::{Worst, rows};

fn load(robot: &str) -> Value {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures/oracle");
    let text = fs::read_to_string(format!("{folder}/{robot}.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn array<const N: usize>(value: &Value) -> [f64; N] {
    numbers(value).try_into().unwrap()
}

fn index(value: &Value) -> Option<usize> {
    value.as_u64().map(|index| index as usize)
}

/// The mechanism of a fixture; its coordinates are in the order of the joints.
fn mechanism(fixture: &Value) -> Mechanism {
    let data = &fixture["mechanism"];
    let link = |(coordinate, link): (usize, &Value)| {
        let axis = Vector3::from(array(&link["axis"]));
        let joint = match link["type"].as_str().unwrap() {
            "revolute" => Joint::revolute(axis, coordinate),
            "prismatic" => Joint::prismatic(axis, coordinate),
            other => panic!("joint of type {other}"),
        };
        let [xx, xy, xz, yy, yz, zz] = array(&link["inertia"]);
        Link::new(
            index(&link["parent"]),
            Pose::from_xyz_rpy(array(&link["xyz"]), array(&link["rpy"])),
            joint,
            link["mass"].as_f64().unwrap(),
            Vector3::from(array(&link["center_of_mass"])),
            Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        )
    };
    let frame = |frame: &Value| Frame {
        link: index(&frame["link"]),
        placement: Pose {
            rotation: Matrix3::from_row_slice(&array::<9>(&frame["rotation"])),
            translation: Vector3::from(array(&frame["xyz"])),
        },
    };
    let links = data["links"].as_array().unwrap().iter().enumerate().map(link).collect();
    let frames = data["frames"].as_array().unwrap().iter().map(frame).collect();
    Mechanism::new(Vector3::from(array(&data["gravity"])), links, frames).unwrap()
}

/// The index of a named body among the links or among the frames.
enum Body {
    Link(usize),
    Frame(usize),
}

fn body(fixture: &Value, name: &str) -> Body {
    let place = |list: &str| {
        let bodies = fixture["mechanism"][list].as_array().unwrap();
        bodies.iter().position(|body| body["name"] == name)
    };
    place("links").map_or_else(|| Body::Frame(place("frames").unwrap()), Body::Link)
}

fn compare_dynamics(worst: &mut Worst, place: &str, mechanism: &Mechanism, state: &Value) {
    let value = |key: &str| numbers(&state[key]);
    let (q, v, a, tau) = (value("q"), value("v"), value("a"), value("aba_tau"));
    let mut vector = |key: &str, found: &DVector<f64>| {
        worst.compare(key, place, found.as_slice(), &value(key), 1e-3);
    };
    vector("tau", &mechanism.inverse_dynamics(&q, &v, &a).unwrap());
    vector("g", &mechanism.gravity_torques(&q).unwrap());
    vector("nle", &mechanism.bias(&q, &v).unwrap());
    vector("aba_a", &mechanism.forward_dynamics(&q, &v, &tau, &[]).unwrap());
    let found = mechanism.articulated_body(&q, &v, &tau, &[]).unwrap();
    worst.compare("aba_a, articulated body", place, found.as_slice(), &value("aba_a"), 1e-3);
    let inverse = mechanism.inverse_dynamics_derivatives(&q, &v, &a, &[]).unwrap();
    let forward = mechanism.forward_dynamics_derivatives(&q, &v, &tau, &[]).unwrap();
    let mut matrix = |key: &str, found: &DMatrix<f64>| {
        worst.compare(key, place, &rows(found), &value(key), 1e-3);
    };
    matrix("M", &mechanism.mass_matrix(&q).unwrap());
    matrix("M", &inverse.dqdd);
    matrix("Minv", &mechanism.inverse_mass_matrix(&q).unwrap());
    matrix("Minv", &forward.dtau);
    matrix("C", &mechanism.coriolis_matrix(&q, &v).unwrap());
    matrix("dtau_dq", &inverse.dq);
    matrix("dtau_dv", &inverse.dqd);
    matrix("da_dq", &forward.dq);
    matrix("da_dv", &forward.dqd);
    matrix("Y", &mechanism.regressor(&q, &v, &a).unwrap());
    let energies = mechanism.energies(&q, &v).unwrap();
    for (key, found) in [("kinetic", energies.kinetic), ("potential", energies.potential)] {
        worst.compare(key, place, &[found], &[state[key].as_f64().unwrap()], 1e-3);
    }
}

fn compare_kinematics(worst: &mut Worst, place: &str, fixture: &Value, state: &Value) {
    let mechanism = mechanism(fixture);
    let (q, v) = (numbers(&state["q"]), numbers(&state["v"]));
    let placements = mechanism.forward_kinematics(&q).unwrap();
    for (name, expected) in state["poses"].as_object().unwrap() {
        let pose = match body(fixture, name) {
            Body::Link(link) => &placements.links[link],
            Body::Frame(frame) => &placements.frames[frame],
        };
        let rotation = pose.rotation.transpose();
        worst.compare("poses", place, rotation.as_slice(), &numbers(&expected["R"]), 1.0);
        worst.compare("poses", place, pose.translation.as_slice(), &numbers(&expected["p"]), 1.0);
    }
    for (name, expected) in state["J"].as_object().unwrap() {
        let (jacobian, drift) = match body(fixture, name) {
            Body::Link(link) => (
                mechanism.link_jacobian(&q, link).unwrap(),
                mechanism.link_jacobian_dot_qd(&q, &v, link).unwrap(),
            ),
            Body::Frame(frame) => (
                mechanism.frame_jacobian(&q, frame).unwrap(),
                mechanism.frame_jacobian_dot_qd(&q, &v, frame).unwrap(),
            ),
        };
        worst.compare("J", place, jacobian.transpose().as_slice(), &numbers(expected), 1.0);
        worst.compare("Jdot_v", place, drift.as_slice(), &numbers(&state["Jdot_v"][name]), 1.0);
    }
    let center = mechanism.center_of_mass(&q).unwrap();
    worst.compare("com", place, center.as_slice(), &numbers(&state["com"]), 1.0);
}

fn agrees_with_pinocchio(robot: &str) {
    let fixture = load(robot);
    let mechanism = mechanism(&fixture);
    let mut worst = Worst::default();
    let parameters = mechanism.parameters();
    worst.compare("pi", robot, parameters.as_slice(), &numbers(&fixture["pi"]), 1e-3);
    let states = fixture["states"].as_array().unwrap();
    assert_eq!(states.len(), 8);
    for (number, state) in states.iter().enumerate() {
        let place = format!("{robot}, state {number}");
        compare_dynamics(&mut worst, &place, &mechanism, state);
        compare_kinematics(&mut worst, &place, &fixture, state);
    }
    worst.check(|what| match what {
        // The accuracy of M⁻¹ is limited by the condition number of M, in both programs.
        "Minv" | "da_dq" | "da_dv" => 1e-11,
        _ => 1e-13,
    });
}

#[test]
fn ur5_agrees_with_pinocchio() {
    agrees_with_pinocchio("ur5");
}

#[test]
fn panda_agrees_with_pinocchio() {
    agrees_with_pinocchio("panda");
}

#[test]
fn iiwa_agrees_with_pinocchio() {
    agrees_with_pinocchio("iiwa");
}

#[test]
fn puma560_agrees_with_pinocchio() {
    agrees_with_pinocchio("puma560");
}

#[test]
fn stanford_agrees_with_pinocchio() {
    agrees_with_pinocchio("stanford");
}

#[test]
fn scara_agrees_with_pinocchio() {
    agrees_with_pinocchio("scara");
}
