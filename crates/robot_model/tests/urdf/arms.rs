//! Arms with published values, written as URDF and compared with the values of Pinocchio.

use std::fmt::Write;
use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use robot_model::description::{Options, import, read_toml};
use robot_numeric::{Mechanism, Pose};
use serde_json::Value;

use crate::{difference, read};

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|one| one.as_f64().unwrap()).collect()
}

fn spaced(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// The values of a fixture, written as URDF.
fn urdf(name: &str, mechanism: &Value) -> String {
    let mut text =
        format!("<?xml version=\"1.0\"?>\n<robot name=\"{name}\">\n<link name=\"world\"/>\n");
    let links = mechanism["links"].as_array().unwrap();
    for link in links {
        let [name, joint] = ["name", "joint"].map(|key| link[key].as_str().unwrap());
        let parent = link["parent"].as_u64().map_or("world", |parent| {
            links[usize::try_from(parent).unwrap()]["name"].as_str().unwrap()
        });
        let vector = |key: &str| spaced(&numbers(&link[key]));
        let inertia = numbers(&link["inertia"]);
        writeln!(
            text,
            "<link name=\"{name}\"><inertial><origin xyz=\"{}\"/><mass value=\"{}\"/>\
             <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/></inertial></link>",
            vector("center_of_mass"),
            link["mass"],
            inertia[0],
            inertia[1],
            inertia[2],
            inertia[3],
            inertia[4],
            inertia[5],
        )
        .unwrap();
        writeln!(
            text,
            "<joint name=\"{joint}\" type=\"{}\"><origin xyz=\"{}\" rpy=\"{}\"/><parent link=\"{parent}\"/>\
             <child link=\"{name}\"/><axis xyz=\"{}\"/></joint>",
            link["type"].as_str().unwrap(),
            vector("xyz"),
            vector("rpy"),
            vector("axis"),
        )
        .unwrap();
    }
    for (index, frame) in mechanism["frames"].as_array().unwrap().iter().enumerate() {
        let name = frame["name"].as_str().unwrap();
        let link = frame["link"].as_u64().map_or("world", |link| {
            links[usize::try_from(link).unwrap()]["name"].as_str().unwrap()
        });
        let rotation = Matrix3::from_row_slice(&numbers(&frame["rotation"]));
        let rpy = Pose { rotation, translation: Vector3::zeros() }.rpy();
        writeln!(
            text,
            "<link name=\"{name}\"/>\n<joint name=\"fixed_{index}\" type=\"fixed\"><origin xyz=\"{}\" \
             rpy=\"{}\"/><parent link=\"{link}\"/><child link=\"{name}\"/></joint>",
            spaced(&numbers(&frame["xyz"])),
            spaced(&rpy),
        )
        .unwrap();
    }
    text + "</robot>\n"
}

fn largest(found: &[f64], expected: &Value) -> f64 {
    let expected = numbers(expected);
    assert_eq!(found.len(), expected.len());
    found.iter().zip(&expected).fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

/// The fixture of an arm: its values, and states with the results of Pinocchio.
fn fixture(name: &str) -> Value {
    let path = format!("../../tests/fixtures/oracle/{name}.json");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn agrees(name: &str, text: &str) {
    let fixture = fixture(name);
    let robot = read(text).robot;
    let mechanism = Mechanism::nominal(&robot).unwrap();
    let states = fixture["states"].as_array().unwrap();
    assert!(states.len() >= 8);
    for state in states {
        let [q, v, a] = ["q", "v", "a"].map(|key| numbers(&state[key]));
        let tau = mechanism.inverse_dynamics(&q, &v, &a).unwrap();
        let worst = largest(tau.as_slice(), &state["tau"]) / tau.amax().max(1e-3);
        assert!(worst <= 1e-9, "{name}: torques differ by {worst:e}");
        let placements = mechanism.forward_kinematics(&q).unwrap();
        for (body, expected) in state["poses"].as_object().unwrap() {
            let link = robot.links.iter().position(|link| link.name == *body);
            let frame = robot.frames.iter().position(|frame| frame.name == *body);
            let pose = link
                .map(|index| &placements.links[index])
                .or(frame.map(|index| &placements.frames[index]))
                .unwrap_or_else(|| panic!("{name} has no {body}"));
            let worst = largest(pose.translation.as_slice(), &expected["p"])
                .max(largest(pose.rotation.transpose().as_slice(), &expected["R"]));
            assert!(worst <= 1e-9, "{name}: {body} is off by {worst:e}");
        }
    }
    let toml = import("arm.urdf", text, &Options::default()).unwrap().toml;
    let again = read_toml("arm.toml", &toml).unwrap_or_else(|found| panic!("{found}"));
    assert!(again.warnings.is_empty(), "{}", again.warnings);
    assert_eq!(difference(&robot, &again.robot), 0.0, "{name}");
}

#[test]
fn arms_with_published_figures_agree_with_pinocchio() {
    for name in ["ur5", "panda", "iiwa", "puma560", "stanford", "scara"] {
        agrees(name, &urdf(name, &fixture(name)["mechanism"]));
    }
}

/// The original files, if they are in a folder beside the project.
#[test]
fn files_beside_the_project_agree_with_pinocchio() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/urdf");
    for name in ["ur5", "panda", "iiwa", "puma560", "stanford", "scara"] {
        if let Ok(text) = std::fs::read_to_string(folder.join(format!("{name}.urdf"))) {
            agrees(name, &text);
            println!("{name}.urdf agrees");
        }
    }
}
