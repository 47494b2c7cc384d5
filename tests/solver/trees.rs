//! Compares two hundred random trees with two tips with the numeric solver: by the paper's iterations, the economical
//! recursion and the generated programs in the interpreter.

use robot_build::{FunctionKind, Functions, Options, programs_of};
use robot_codegen::Interpreter;
use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_model::robot::{Robot, Wrench};
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_numeric::{self, Loads};
use robot_symbolic::Graph;

use robot_testing::place::{Layout, Off};
use robot_testing::{evaluate, magnitude};

const STATES: usize = 6;
const TOLERANCE: f64 = 1e-12;

/// A tree with 2 to 12 joints whose links carry two tips: `tip` on the last link and `sensor` on any link.
fn tree(seed: u64) -> Robot {
    let recipe = Recipe {
        drives: seed.is_multiple_of(2),
        mimic: seed.is_multiple_of(3),
        fixed: seed.is_multiple_of(5),
        ..Recipe::tree(2 + seed as usize % 11)
    };
    let mut robot = robots::robot(&mut Random::new(seed), &recipe);
    let sensor = &mut robot.frames[1];
    sensor.link = sensor.link.or(Some(0));
    let named = |letter: &str| ["x", "y", "z"].map(|axis| format!("{letter}{axis}_sensor"));
    let (force, moment) = (named("F"), named("M"));
    sensor.wrench = Some(Wrench { force, moment, latex: Default::default() });
    robot
}

/// Compares values in each state with expected ones; returns the largest error relative to the largest value.
fn assert_agrees(
    robot: &Robot,
    what: &str,
    seed: u64,
    found: &[Vec<f64>],
    expected: &[Vec<f64>],
) -> f64 {
    let size = magnitude(expected.iter().flatten());
    let layout = Layout::per_joint(robot, what);
    let errors = found.iter().zip(expected).map(|(found, expected)| {
        let off = Off::of(&layout, found, expected, size);
        assert!(off.error <= TOLERANCE, "seed {seed}: {off}");
        off.error
    });
    errors.fold(0.0, f64::max)
}

fn interpreted(robot: &Robot, states: &[State]) -> Vec<Vec<f64>> {
    let kind = FunctionKind::InverseDynamics(Effects::WRENCH);
    let options = Options { functions: Functions::Chosen(vec![kind]), ..Options::default() };
    let programs = programs_of(robot.clone(), "tree", &options).unwrap();
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let run = |state: &State| {
        let wrench = |index: usize| {
            let robot_numeric::Wrench { force, moment } = &state.wrenches[index];
            [force.as_slice(), moment.as_slice()].concat()
        };
        let (tip, sensor) = (wrench(0), wrench(1));
        let inputs: [(&str, &[f64]); 5] = [
            ("q", &state.q),
            ("qd", &state.qd),
            ("qdd", &state.qdd),
            ("wrench_tip", &tip),
            ("wrench_sensor", &sensor),
        ];
        interpreter.call(kind.name(), &inputs).unwrap().remove(0).values
    };
    states.iter().map(run).collect()
}

fn check(seed: u64) -> f64 {
    let robot = tree(seed);
    let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
    let mut random = Random::new(seed);
    let states: Vec<State> = (0..STATES).map(|_| random.state(&solver)).collect();
    let expected: Vec<Vec<f64>> = states
        .iter()
        .map(|state| {
            let loads = Loads { wrenches: state.wrenches.clone(), friction: false };
            let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
            solver.inverse_dynamics_with(q, qd, qdd, &loads).unwrap().as_slice().to_vec()
        })
        .collect();
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
    let effects = Effects { wrench: true, friction: false };
    let recursion = Recursion::new(&mechanism, &Plan::default_for(&robot)).unwrap();
    let at_states = |roots: &[_]| -> Vec<Vec<f64>> {
        states.iter().map(|state| evaluate(&robot, roots, state)).collect()
    };
    let paper = at_states(&newton_euler(&mechanism, effects).joint_torques);
    let economical = at_states(&recursion.inverse_dynamics(true));
    [
        assert_agrees(&robot, "the paper's Q", seed, &paper, &expected),
        assert_agrees(&robot, "the economical Q", seed, &economical, &expected),
        assert_agrees(&robot, "the program", seed, &interpreted(&robot, &states), &expected),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

#[test]
fn two_hundred_trees_with_two_tips_agree_with_the_numeric_solver() {
    let worst = (5000..5200).map(check).fold(0.0, f64::max);
    println!("200 trees of 2 to 12 joints × {STATES} states: worst error {worst:.1e}");
    // Enough of the robots must have branches: a chain has no link with two children.
    let branched = |robot: &Robot| {
        (0..robot.links.len())
            .any(|link| robot.links.iter().filter(|child| child.parent == Some(link)).count() > 1)
    };
    assert!((5000..5200).map(tree).filter(|robot| branched(robot)).count() >= 100);
}
