//! The robot files of this project are read without errors or warnings.

#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::{Path, PathBuf};

use robot_check::doctor::examine;
use robot_model::description::{Described, read_toml};
use robot_model::diagnostic::code;
use robot_model::robot::{JointKind, Robot};
use robot_numeric::Mechanism;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots")
}

fn read(name: &str) -> Described {
    let text = std::fs::read_to_string(folder().join(name)).unwrap();
    read_toml(name, &text).unwrap_or_else(|found| panic!("{found}"))
}

fn kinds(robot: &Robot) -> String {
    let letter = |kind| {
        if kind == JointKind::Revolute { 'R' } else { 'P' }
    };
    robot.coordinates.iter().map(|one| letter(one.kind)).collect()
}

#[test]
fn every_robot_file_is_clean() {
    let mut names: Vec<_> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    assert!(names.len() >= 9, "{names:?}");
    for name in names {
        let described = read(&name);
        assert!(described.warnings.is_empty(), "{}", described.warnings);
        let robot = &described.robot;
        assert_eq!(format!("{}.toml", robot.name.to_lowercase()), name);
        assert!(robot.description.is_some(), "{name}");
        let locations = &described.locations;
        assert_eq!(locations.parameters.len(), robot.parameters.len(), "{name}");
        assert_eq!(locations.links.len(), robot.links.len(), "{name}");
        assert_eq!(locations.frames.len(), robot.frames.len(), "{name}");
        for (link, places) in robot.links.iter().zip(&locations.links) {
            assert_eq!(link.bodies.len(), places.bodies.len(), "{name} {}", link.name);
        }
    }
}

#[test]
fn the_doctor_finds_what_is_odd_and_nothing_else() {
    for path in std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_str().unwrap();
        if !name.ends_with(".toml") {
            continue;
        }
        let found = examine(&read(name)).found;
        let codes: Vec<_> = found.iter().map(|one| one.code).collect();
        // The published wrist links of the UR5 have the inertia of far larger bodies.
        let expected = if name == "ur5.toml" { vec![code::TOO_WIDE; 2] } else { vec![] };
        assert_eq!(codes, expected, "{found}");
    }
}

#[test]
fn trttr1_has_the_symbols_of_the_paper() {
    let robot = read("trttr1.toml").robot;
    assert_eq!(kinds(&robot), "PRPPR");
    let numbered = |prefix: &str, last: usize| {
        (1..=last).map(move |i| format!("{prefix}{i}")).collect::<Vec<_>>()
    };
    let mut expected = vec!["g".to_owned(), "d2".to_owned(), "d5".to_owned()];
    for (prefix, last) in [("l", 6), ("M", 5), ("Jx", 5), ("Jy", 5), ("Jz", 5), ("b", 5), ("c", 5)]
    {
        expected.extend(numbered(prefix, last));
    }
    let mut names: Vec<_> = robot.parameters.iter().map(|one| one.name.clone()).collect();
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
    assert!(robot.parameters.iter().all(|one| one.value.is_some() && one.unit.is_some()));
    let (tip, wrench) = robot.tips().next().unwrap();
    assert_eq!((tip.name.as_str(), tip.link), ("6", Some(4)));
    assert_eq!(wrench.force, ["Fx6", "Fy6", "Fz6"]);
    assert_eq!(wrench.moment, ["Mx6", "My6", "Mz6"]);
}

/// The largest difference between corresponding numbers of two lists.
fn difference(found: &[f64], expected: &serde_json::Value) -> f64 {
    let expected: Vec<f64> =
        expected.as_array().unwrap().iter().map(|one| one.as_f64().unwrap()).collect();
    assert_eq!(found.len(), expected.len());
    let differences = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// Compares torques and placements of the file's robot, at the states of a fixture, with the values of the fixture.
fn agrees_with_pinocchio(name: &str) {
    let described = read(&format!("{name}.toml"));
    let mechanism = Mechanism::nominal(&described.robot).unwrap();
    let path = folder().join(format!("../tests/fixtures/oracle/{name}.json"));
    let fixture: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let states = fixture["states"].as_array().unwrap();
    assert!(states.len() >= 8, "{name}");
    let frames: Vec<_> = described.robot.frames.iter().map(|frame| frame.name.as_str()).collect();
    let mut placed = 0;
    for (index, state) in states.iter().enumerate() {
        let values = |key: &str| -> Vec<f64> {
            state[key].as_array().unwrap().iter().map(|one| one.as_f64().unwrap()).collect()
        };
        let tau = mechanism.inverse_dynamics(&values("q"), &values("v"), &values("a")).unwrap();
        let scale = values("tau").iter().fold(1e-3_f64, |scale, one| scale.max(one.abs()));
        let worst = difference(tau.as_slice(), &state["tau"]) / scale;
        assert!(worst <= 1e-9, "{name}, state {index}: torques differ by {worst:e} of the largest");
        let placements = mechanism.forward_kinematics(&values("q")).unwrap();
        for (body, expected) in state["poses"].as_object().unwrap() {
            let link = described.robot.links.iter().position(|link| link.name == *body);
            let frame = frames.iter().position(|frame| frame == body);
            let pose = match (link, frame) {
                (Some(link), _) => &placements.links[link],
                (_, Some(frame)) => &placements.frames[frame],
                _ => panic!("{name} has no {body}"),
            };
            placed += 1;
            let worst = difference(pose.translation.as_slice(), &expected["p"])
                .max(difference(pose.rotation.transpose().as_slice(), &expected["R"]));
            assert!(worst <= 1e-9, "{name}, state {index}: {body} is off by {worst:e}");
        }
    }
    assert!(placed >= states.len() * described.robot.links.len(), "{name}: {placed}");
}

#[test]
fn arms_with_published_figures_agree_with_pinocchio() {
    for name in ["ur5", "panda", "iiwa", "puma560", "stanford", "scara"] {
        agrees_with_pinocchio(name);
    }
}

#[test]
fn coordinates_of_several_joints_or_with_ratios_are_shared() {
    let link = |name: &str, rest: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\"{rest} }}\n\
             mass = 1\ncenter_of_mass = [0.5, 0, 0]\n\
             inertia = {{ xx = 0.01, yy = 0.01, zz = 0.01 }}\n"
        )
    };
    let shared = |rest: &str| {
        let links = link("one", "") + &link("two", rest);
        let text = format!("format = 1\n[robot]\nname = \"gripper\"\n{links}");
        robot_model::functions::has_shared_coordinates(&read_toml("gripper", &text).unwrap().robot)
    };
    assert!(!shared(""));
    assert!(shared(", mimic = { joint = \"one\" }"));
    assert!(shared(", mimic = { joint = \"one\", ratio = 2 }"));
}
