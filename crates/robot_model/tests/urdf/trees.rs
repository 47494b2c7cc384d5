//! Random trees that are written as URDF, read, and imported.

use robot_model::description::{Options, import, read_toml};
use robot_model::robot::Robot;
use robot_numeric::robots::{Random, Recipe, robot};
use robot_symbolic::Formula;

use crate::{difference, read, text};

fn tree(seed: u64) -> Robot {
    let mut random = Random::new(seed);
    let joints = 2 + random.index(11);
    let recipe = Recipe { mimic: true, fixed: true, ..Recipe::tree(joints) };
    let mut robot = robot(&mut random, &recipe);
    // URDF does not specify gravity, and a mimic joint cannot have the ratio 0.
    robot.gravity = ["0", "0", "-9.81"].map(|text| Formula::parse(text).unwrap());
    for link in &mut robot.links {
        if link.joint.ratio.text() == "0" {
            link.joint.ratio = Formula::parse("0.5").unwrap();
        }
    }
    robot
}

#[test]
fn trees_are_read_as_they_are() {
    for seed in 0..200 {
        let expected = tree(seed);
        let found = read(&text::of_robot(&expected)).robot;
        assert_eq!(found.degrees_of_freedom(), expected.degrees_of_freedom(), "seed {seed}");
        let worst = difference(&expected, &found);
        assert!(worst < 1e-12, "seed {seed}: {worst:e}");
    }
}

#[test]
fn an_import_is_the_same_robot_and_always_the_same_text() {
    for seed in 0..60 {
        let text = text::of_robot(&tree(seed));
        let import = |name: &str, text: &str| import(name, text, &Options::default()).unwrap();
        let first = import("arm.urdf", &text);
        assert_eq!(first.toml, import("arm.urdf", &text).toml);
        assert_eq!(first.toml, import("arm.toml", &first.toml).toml);
        let again = read_toml("arm.toml", &first.toml).unwrap_or_else(|found| panic!("{found}"));
        assert!(again.warnings.is_empty(), "{}", again.warnings);
        let names = |robot: &Robot| -> Vec<String> {
            let links = robot.links.iter().flat_map(|link| [&link.name, &link.joint.name]);
            links.chain(robot.frames.iter().map(|frame| &frame.name)).cloned().collect()
        };
        assert_eq!(names(&again.robot), names(&first.described.robot));
        assert_eq!(difference(&first.described.robot, &again.robot), 0.0, "seed {seed}");
    }
}
