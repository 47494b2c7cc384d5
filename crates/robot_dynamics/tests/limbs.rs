//! Plans of trees and long chains, which are searched limb by limb.
#![allow(clippy::unwrap_used, reason = "a test that fails panics")]

use std::fmt::Write as _;

use robot_dynamics::economical::search::{Found, Measure, search, search_several};
use robot_dynamics::economical::{Plan, Recursion, plan::LinkPlan};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::robot::Robot;
use robot_numeric::random::Random;
use robot_symbolic::{Graph, operations};

/// A robot file that is built link by link, with random values.
struct File {
    text: String,
    random: Random,
}

impl File {
    fn new(seed: u64) -> File {
        let text = "format = 1\n[robot]\nname = \"limbs\"\n".to_owned();
        File { text, random: Random::new(seed) }
    }

    /// A random number from `low` thousandths to below `high` thousandths.
    fn between(&mut self, low: i64, high: i64) -> f64 {
        (low + self.random.index((high - low) as usize) as i64) as f64 / 1000.0
    }

    /// Adds a link on a revolute joint, with all inertial parameters; its axes are turned about x by `quarters` right
    /// angles.
    fn link(&mut self, name: &str, parent: &str, axis: &str, origin: [f64; 3], quarters: usize) {
        let [mass, x, y, z] = [(500, 4000), (-50, 50), (-50, 50), (-200, 200)]
            .map(|(low, high)| self.between(low, high));
        let [xx, yy, zz] = [(); 3].map(|()| self.between(20, 34));
        let [xy, xz, yz] = [(); 3].map(|()| self.between(-8, 8) / 10.0);
        let rpy = ["0", "\"pi/2\"", "\"-pi/2\""][quarters];
        writeln!(
            self.text,
            "[[link]]\nname = \"{name}\"\nparent = \"{parent}\"\n\
             joint = {{ type = \"revolute\", axis = \"{axis}\" }}\n\
             origin = {{ xyz = {origin:?}, rpy = [{rpy}, 0, 0] }}\nmass = {mass}\n\
             center_of_mass = [{x}, {y}, {z}]\n\
             inertia = {{ xx = {xx}, yy = {yy}, zz = {zz}, xy = {xy}, xz = {xz}, yz = {yz} }}",
        )
        .unwrap();
    }

    fn leg(&mut self, number: usize) {
        let (x, y) = ([0.2, -0.2][number / 2], [0.05, -0.05][number % 2]);
        let name = |part: &str| format!("{part}_{number}");
        self.link(&name("hip"), "base", "x", [x, y, 0.0], 0);
        self.link(&name("thigh"), &name("hip"), "y", [0.0, 1.6 * y, 0.0], 0);
        self.link(&name("calf"), &name("thigh"), "y", [0.0, 0.0, -0.21], 0);
    }

    fn robot(&self) -> Robot {
        robot_testing::read("limbs", &self.text)
    }
}

fn chain(joints: usize) -> Robot {
    let mut file = File::new(joints as u64);
    for number in 0..joints {
        let parent = if number == 0 { "base".to_owned() } else { (number - 1).to_string() };
        let origin = [file.between(-200, 200), file.between(-200, 200), 0.1];
        let quarters = file.random.index(3);
        file.link(&number.to_string(), &parent, "z", origin, quarters);
    }
    file.robot()
}

fn searched(robot: &Robot) -> Found {
    search(robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap()
}

fn cost(robot: &Robot, plan: &Plan) -> usize {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::ROUNDED);
    let torques = Recursion::new(&mechanism, plan).unwrap().inverse_dynamics(false);
    operations(&torques, |_| false).flops()
}

/// The legs are only connected by the base, so each of them gets the plan that it would get as a separate robot.
#[test]
fn each_leg_gets_its_own_plan() {
    let mut quadruped = File::new(5);
    let mut alone = 0;
    for number in 0..4 {
        quadruped.leg(number);
        let start = quadruped.text.rfind("[[link]]\nname = \"hip_").unwrap();
        let head = File::new(0).text;
        let leg = File { text: head + &quadruped.text[start..], random: Random::new(0) }.robot();
        let plan = Plan { unit_length: None, ..searched(&leg).plan };
        alone += cost(&leg, &plan);
    }
    let robot = quadruped.robot();
    let found = searched(&robot);
    println!("quadruped: {} operations, legs alone {alone}", found.operations);
    assert!(!found.cut_short && found.operations <= alone, "{} {alone}", found.operations);
    assert_eq!(cost(&robot, &found.plan), found.operations);
}

/// The search of a chain that is too long to be swept as a whole must not end with the same options for all links.
#[test]
fn a_long_chain_is_searched_window_by_window() {
    let robot = chain(24);
    let found = searched(&robot);
    let default = cost(&robot, &Plan::default_for(&robot));
    let basic = cost(&robot, &Plan::uniform(24, &LinkPlan::BASIC));
    let Found { operations, tried, .. } = found;
    println!("24 joints: {operations} operations, {tried} forms; default {default}, basic {basic}");
    assert!(operations * 100 <= default * 94, "{operations} {default}");
    assert_eq!(cost(&robot, &found.plan), operations);
    let differing = found.plan.links.iter().filter(|link| **link != found.plan.links[0]).count();
    assert!(differing > 12, "{differing}");
}

#[test]
fn the_cheapest_plans_begin_with_the_one_that_is_found() {
    let legs = {
        let mut file = File::new(3);
        (0..2).for_each(|number| file.leg(number));
        file.robot()
    };
    for robot in [chain(3), legs] {
        let several = search_several(&robot, &MechanismOptions::ROUNDED, Measure::Operations, 8);
        let several = several.unwrap();
        assert_eq!(several[0].plan, searched(&robot).plan);
        assert!(several.len() > 1 && several.len() <= 8, "{}", several.len());
        assert!(several[1..].is_sorted_by_key(|found| found.operations));
        for (index, found) in several.iter().enumerate() {
            assert!(found.operations >= several[0].operations && !found.tuned);
            assert_eq!(found.operations, cost(&robot, &found.plan));
            assert!(several[..index].iter().all(|other| other.plan != found.plan));
        }
    }
}
