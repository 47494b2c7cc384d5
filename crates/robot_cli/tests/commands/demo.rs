//! The ingredients of the demonstration: the robot file of the project, and code that is generated from it.

use std::fs;
use std::path::PathBuf;

use crate::output;

/// The path of a file in the folder with the robot and the code of the demonstration.
fn demo(file: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "demo", file].iter().collect()
}

/// Compares a file with its expected contents, or writes it again if `UPDATE_GOLDENS` is set.
#[track_caller]
fn assert_unchanged(file: &str, now: &str) {
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        fs::write(demo(file), now).unwrap();
    } else if fs::read_to_string(demo(file)).unwrap() != now {
        panic!("demo/{file} is out of date; UPDATE_GOLDENS=1 writes it anew");
    }
}

#[test]
fn the_robot_is_that_of_the_project_and_the_code_is_generated_from_it() {
    for file in ["trttr1.toml", "trttr1.plan"] {
        let robots = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../robots");
        assert_unchanged(file, &fs::read_to_string(robots.join(file)).unwrap());
    }
    let robot = demo("trttr1.toml");
    let arguments = ["generate", robot.to_str().unwrap(), "--function", "inverse_dynamics"];
    assert_unchanged("trttr1.rs", &output(&arguments, ""));
}
