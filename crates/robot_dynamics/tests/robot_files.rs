//! The robot files of this project are read without errors or warnings.

#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::{Path, PathBuf};

use robot_dynamics::description::{Described, read_toml};
use robot_dynamics::model::{JointKind, Robot};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots")
}

fn read(name: &str) -> Described {
    let text = std::fs::read_to_string(folder().join(name)).unwrap();
    read_toml(name, &text).unwrap_or_else(|found| panic!("{found}"))
}

fn kinds(robot: &Robot) -> String {
    let letter = |kind| {
        if kind == JointKind::Revolute {
            'R'
        } else {
            'P'
        }
    };
    robot
        .coordinates
        .iter()
        .map(|one| letter(one.kind))
        .collect()
}

#[test]
fn every_robot_file_is_clean() {
    let mut names: Vec<_> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    assert!(names.len() >= 3, "{names:?}");
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
            assert_eq!(
                link.bodies.len(),
                places.bodies.len(),
                "{name} {}",
                link.name
            );
        }
    }
}

#[test]
fn trttr1_has_the_symbols_of_the_paper() {
    let robot = read("trttr1.toml").robot;
    assert_eq!(kinds(&robot), "PRPPR");
    let numbered = |prefix: &str, last: usize| {
        (1..=last)
            .map(move |i| format!("{prefix}{i}"))
            .collect::<Vec<_>>()
    };
    let mut expected = vec!["g".to_owned(), "d2".to_owned(), "d5".to_owned()];
    for (prefix, last) in [
        ("l", 6),
        ("M", 5),
        ("Jx", 5),
        ("Jy", 5),
        ("Jz", 5),
        ("b", 5),
        ("c", 5),
    ] {
        expected.extend(numbered(prefix, last));
    }
    let mut names: Vec<_> = robot
        .parameters
        .iter()
        .map(|one| one.name.clone())
        .collect();
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
    assert!(
        robot
            .parameters
            .iter()
            .all(|one| one.value.is_some() && one.unit.is_some())
    );
    let (tip, wrench) = robot.tips().next().unwrap();
    assert_eq!((tip.name.as_str(), tip.link), ("6", Some(4)));
    assert_eq!(wrench.force, ["Fx6", "Fy6", "Fz6"]);
    assert_eq!(wrench.moment, ["Mx6", "My6", "Mz6"]);
}
