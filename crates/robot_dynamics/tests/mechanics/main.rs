//! Compares the symbolic mechanics with the numeric solver, which shares no code with them: both recursions, every
//! function and the base parameters, for a few robots of each kind. These tests take seconds; the tests of the whole
//! project make the same comparisons for hundreds of robots (`tests/solver/recursions.rs` and others).
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod axes;
mod base_parameters;
mod costs;
mod derivatives;
mod documented;
mod energies;
mod functions;
mod parallel;
mod recursions;

use robot_model::robot::{Axis, Move, Parameter, Placement, Robot};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Formula, Rational};

use robot_testing::with_free_axes;

/// The number of states in which values are compared.
const STATES: usize = 3;

/// The maximum error of values, relative to the largest value.
const TOLERANCE: f64 = 1e-11;

/// Robots from files, chains, trees with drives, friction, mimic joints and fixed links, robots whose values are
/// parameters, robots whose placements are, and robots whose joint axes are, each with a name and a seed for states.
fn robots() -> Vec<(String, Robot, u64)> {
    let files = ["trttr1", "scara", "stanford", "puma560"];
    let files = files.map(|name| (name.to_owned(), robot_testing::robot(name), 3));
    let random = |seed: u64, recipe: &Recipe| robots::robot(&mut Random::new(seed), recipe);
    let chains = (0..8).map(|seed| {
        let recipe = Recipe::serial(1 + seed as usize % 6);
        (format!("chain, seed {seed}"), random(seed, &recipe), seed)
    });
    let trees = (1000..1012).map(|seed| {
        let joints = 2 + seed as usize % 6;
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        (format!("tree, seed {seed}"), random(seed, &recipe), seed)
    });
    let parameters = (2000..2003).map(|seed| {
        let recipe = Recipe { fixed: true, ..Recipe::tree(1 + seed as usize % 4) };
        let robot = robots::parameterized(&random(seed, &recipe));
        (format!("parameters, seed {seed}"), robot, seed)
    });
    let free =
        (3000..3003).map(|seed| (format!("free axes, seed {seed}"), with_free_axes(seed), seed));
    let turned = (4000..4004).map(|seed| (format!("turned, seed {seed}"), turned(seed), seed));
    files
        .into_iter()
        .chain(chains)
        .chain(trees)
        .chain(parameters)
        .chain(turned)
        .chain(free)
        .collect()
}

/// A chain of joints about z whose placements depend on parameters: turned about z by an angle, and of every second
/// robot about x by another, with a distance between.
fn turned(seed: u64) -> Robot {
    let mut random = Random::new(seed);
    let mut robot = robots::robot(&mut random, &Recipe::serial(2 + seed as usize % 3));
    let numbers = |axis: [i64; 3]| axis.map(|one| Formula::number(&Rational::integer(one)));
    for (number, link) in (1..).zip(&mut robot.links) {
        let [turn, tilt, reach] =
            ["turn", "tilt", "reach"].map(|name| Formula::symbol(&format!("{name}{number}")));
        let [zero, ..] = numbers([0; 3]);
        let tilt = if seed.is_multiple_of(2) { tilt } else { zero.clone() };
        link.joint.axis = numbers([0, 0, 1]);
        link.placement = Placement(vec![
            Move::Translate([reach, zero.clone(), zero]),
            Move::Rotate(Axis::X, tilt),
            Move::Rotate(Axis::Z, turn),
        ]);
        for name in ["turn", "tilt", "reach"] {
            let value = Rational::new(2 + random.index(9) as i64, 7);
            let name = format!("{name}{number}");
            robot.parameters.push(Parameter { name, value, unit: None, latex: None, doc: None });
        }
    }
    robot
}

#[test]
fn the_robots_have_what_is_to_be_tried() {
    let links: Vec<_> = robots().into_iter().flat_map(|(_, robot, _)| robot.links).collect();
    let count = |has: fn(&robot_model::robot::Link) -> bool| -> usize {
        links.iter().filter(|link| has(link)).count()
    };
    assert!(count(|link| link.drive.gyroscopic && link.parent.is_some()) > 3);
    assert!(count(|link| link.joint.kind == robot_model::robot::JointKind::Prismatic) > 10);
    assert!(count(|link| link.joint.ratio.text() != "1") > 3);
    assert!(count(|link| link.friction.coulomb.text() != "0") > 3);
}
