//! The properties on which a pinned plan depends, and those on which it does not.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use robot_dynamics::economical::mechanics;
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::read_toml;
use robot_model::robot::Robot;

const ARM: &str = r#"format = 1
[robot]
name = "arm"
gravity = [0, "-g", 0]
[parameters]
g = { value = 9.81, unit = "m/s^2" }
l = { value = 1.0, unit = "m" }
m = { value = 5.0, unit = "kg" }
r = { value = 0.5, unit = "m" }
I = { value = 0.2, unit = "kg m^2" }
[[link]]
name = "1"
joint = { type = "revolute", axis = "z" }
mass = "m"
center_of_mass = ["r", 0, 0.1]
inertia = { zz = "I", unchecked = true }
[[link]]
name = "2"
joint = { type = "revolute", axis = "z" }
origin = { xyz = ["l", 0, 0], rpy = [1.570, 0, 0] }
mass = 3
center_of_mass = ["r", 0, 0]
inertia = { zz = "I", unchecked = true }
"#;

fn robot(text: &str) -> Robot {
    read_toml("arm.toml", text).unwrap_or_else(|found| panic!("{text}\n{found}")).robot
}

fn edited(from: &str, to: &str) -> Robot {
    assert!(ARM.contains(from), "{from}");
    robot(&ARM.replace(from, to))
}

#[test]
fn what_no_plan_depends_on_is_left_out() {
    let text = mechanics(&robot(ARM));
    let tip = "[tip]\nparent = \"2\"\norigin = { xyz = [\"l\", 0, 0] }\n[[link]]\nname = \"1\"";
    for (from, to) in [
        ("format = 1", "# a remark\nformat = 1"),
        ("name = \"arm\"", "name = \"other\"\ndescription = \"an arm\""),
        (
            "value = 5.0, unit = \"kg\"",
            "unit = \"kg\", value = 7.5, doc = \"of link 1\", latex = \"m_1\"",
        ),
        (
            "g = { value = 9.81, unit = \"m/s^2\" }\nl = { value = 1.0, unit = \"m\" }",
            "l = 2\ng = 9.7",
        ),
        ("\"I\"", "\"J\""),
        ("name = \"2\"", "name = \"forearm\""),
        ("axis = \"z\" }\nmass = \"m\"", "axis = \"z\" , limits = [-1, 1] }\nmass = \"m\""),
        ("axis = \"z\" }\nmass = \"m\"", "axis = [0, 0, 2] }\nmass = \"m\""),
        ("mass = 3", "friction = { viscous = 0.5 }\nmass = \"1.5 + 1.5\""),
        ("[[link]]\nname = \"1\"", tip),
    ] {
        let file = match to {
            "\"J\"" => ARM.replace("\nI = ", "\nJ = ").replace(from, to),
            _ => ARM.replace(from, to),
        };
        assert_ne!(file, ARM, "{from}");
        assert_eq!(mechanics(&robot(&file)), text, "{to}");
    }
    let rubbing = ARM
        .replace("\nr = ", "\nb = { value = 0.1 }\nr = ")
        .replace("mass = \"m\"", "friction = { viscous = \"b\" }\nmass = \"m\"");
    assert_eq!(mechanics(&robot(&rubbing)), text);
}

#[test]
fn what_a_plan_may_depend_on_is_held() {
    let text = mechanics(&robot(ARM));
    for (from, to) in [
        ("[0, \"-g\", 0]", "[0, 0, \"-g\"]"),
        ("revolute\", axis = \"z\" }\nmass", "revolute\", axis = \"x\" }\nmass"),
        (
            "type = \"revolute\", axis = \"z\" }\norigin",
            "type = \"prismatic\", axis = \"z\" }\norigin",
        ),
        ("mass = 3", "mass = \"m\""),
        ("mass = 3", "mass = 4"),
        ("[\"r\", 0, 0]", "[\"r\", \"r\", 0]"),
        ("[\"r\", 0, 0.1]", "[\"r\", 0, 0]"),
        ("1.570", "1.571"),
        ("name = \"arm\"", "name = \"arm\"\nsnap = 1e-3"),
        ("[\"l\", 0, 0]", "[\"l\", \"r\", 0]"),
        (
            "zz = \"I\", unchecked = true }\n[[link]]",
            "zz = \"I\", xx = 0.1, unchecked = true }\n[[link]]",
        ),
        ("mass = 3", "drive = { armature = \"I\" }\nmass = 3"),
    ] {
        assert_ne!(mechanics(&edited(from, to)), text, "{to}");
    }
    // A mechanism in which two links share a mass differs from one in which each has its own.
    let shared = edited("mass = 3", "mass = \"m\"");
    let own =
        ARM.replace("\nr = ", "\nm2 = { value = 3 }\nr = ").replace("mass = 3", "mass = \"m2\"");
    assert_ne!(mechanics(&shared), mechanics(&robot(&own)));
    assert!(!text.contains("real"), "constants are exact\n{text}");
}

/// Robots with the same text have the same plan, independently of the names and the order of their parameters.
#[test]
fn equal_mechanics_have_one_plan() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots");
    for name in ["planar_3r", "scara", "trttr1"] {
        let file = std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap();
        let robot = robot(&file);
        let mut turned = robot.clone();
        turned.parameters.reverse();
        turned.frames.clear();
        assert_eq!(mechanics(&turned), mechanics(&robot), "{name}");
        let plan =
            |robot: &Robot| search(robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap();
        let (found, other) = (plan(&robot), plan(&turned));
        assert_eq!((found.operations, found.plan), (other.operations, other.plan), "{name}");
    }
}
