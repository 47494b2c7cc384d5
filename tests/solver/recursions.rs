//! Compares the two symbolic recursions with the numeric solver, which shares no code with them, for every robot file
//! and for random chains and trees.

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_dynamics::quantity::Kind;
use robot_model::functions::Effects;
use robot_model::robot::Robot;
use robot_numeric::random::Recipe;
use robot_numeric::robots;
use robot_numeric::{self, Loads};
use robot_symbolic::{Expr, Graph};

use robot_testing::place::{Layout, Off};
use robot_testing::{evaluate, magnitude, robot_files};

const STATES: usize = 50;
const TOLERANCE: f64 = 1e-12;

/// The results of the numeric solver in a state.
struct Reference {
    state: robot_numeric::random::State,
    torques: Vec<f64>,
    torques_with_loads: Vec<f64>,
    link_wrenches: Vec<f64>,
}

fn references(robot: &Robot, random: &mut robot_numeric::random::Random) -> Vec<Reference> {
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let reference = |_| {
        let mut state = random.state(&solver);
        for (wrench, frame) in state.wrenches.iter_mut().zip(&robot.frames) {
            if frame.wrench.is_none() {
                *wrench = robot_numeric::Wrench::zero();
            }
        }
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let loads = Loads { wrenches: state.wrenches.clone(), friction: true };
        let links = solver.link_dynamics(q, qd, qdd, &state.wrenches).unwrap();
        let wrench = |link: &robot_numeric::LinkDynamics| {
            [link.contact_force, link.contact_moment].map(|vector| [vector.x, vector.y, vector.z])
        };
        Reference {
            torques: solver.inverse_dynamics(q, qd, qdd).unwrap().iter().copied().collect(),
            torques_with_loads: {
                let torques = solver.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
                torques.iter().copied().collect()
            },
            // In the solver, gyroscopic rotors are additional links after those of the robot.
            link_wrenches: links[..robot.links.len()].iter().flat_map(wrench).flatten().collect(),
            state,
        }
    };
    (0..STATES).map(reference).collect()
}

fn check(robot: &Robot, seed: u64, name: &str) -> f64 {
    let mut random = robot_numeric::random::Random::new(seed);
    let references = references(robot, &mut random);
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::ROUNDED);
    let loaded = newton_euler(&mechanism, Effects { wrench: true, friction: true });
    let plain = newton_euler(&mechanism, Effects { wrench: false, friction: false });
    let components: Vec<Expr<'_>> = loaded
        .wrenches
        .iter()
        .flat_map(|wrench| [wrench.force.0, wrench.moment.0].concat())
        .collect();
    let mut worst = 0.0_f64;
    let (order, links) = (robot.degrees_of_freedom(), robot.links.len());
    let mut assert_agrees = |what: &str,
                             roots: &[Expr<'_>],
                             expected: fn(&Reference) -> &Vec<f64>| {
        let per_joint = [order];
        let shape: &[usize] = if roots.len() == order { &per_joint } else { &[links, 6] };
        // A torque that passes through zero has no relative accuracy of its own, so errors are relative to the robot's
        // largest torque over the states.
        let size = magnitude(references.iter().flat_map(expected));
        for reference in &references {
            let values = evaluate(robot, roots, &reference.state);
            let off = Off::of(&Layout::new(robot, what, shape), &values, expected(reference), size);
            assert!(off.error <= TOLERANCE, "{name}, seed {seed}: {off}");
            worst = worst.max(off.error);
        }
    };
    assert_agrees("the paper's Q", &plain.joint_torques, |reference| &reference.torques);
    assert_agrees("the paper's Q with loads", &loaded.joint_torques, |r| &r.torques_with_loads);
    assert_agrees("F_l and M_l", &components, |reference| &reference.link_wrenches);
    let recursion = Recursion::new(&mechanism, &Plan::default_for(robot)).unwrap();
    assert_agrees("the economical Q", &recursion.inverse_dynamics(false), |r| &r.torques);
    worst
}

#[test]
fn every_robot_file_agrees_with_the_numeric_solver() {
    for (name, text) in robot_files() {
        let worst = check(&robot_testing::read(&name, &text), 7, &name);
        println!("{name}: worst error {worst:.1e} of the largest torque");
    }
}

#[test]
fn random_serial_robots_agree_with_the_numeric_solver() {
    let mut worst = 0.0_f64;
    for seed in 0..64 {
        let joints = 1 + seed as usize % 8;
        let mut random = robot_numeric::random::Random::new(seed);
        let robot = robots::robot(&mut random, &Recipe::serial(joints));
        worst = worst.max(check(&robot, seed, "serial robot"));
    }
    println!("64 serial robots: worst error {worst:.1e} of the largest torque");
}

#[test]
fn random_trees_agree_with_the_numeric_solver() {
    let mut worst = 0.0_f64;
    for seed in 1000..1040 {
        let joints = 2 + seed as usize % 11;
        let mut random = robot_numeric::random::Random::new(seed);
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        let robot = robots::robot(&mut random, &recipe);
        worst = worst.max(check(&robot, seed, "tree"));
    }
    println!("40 trees: worst error {worst:.1e} of the largest torque");
}

#[test]
fn quantities_carry_the_papers_names() {
    let robot = robot_testing::robot("trttr1");
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    let solution = newton_euler(&mechanism, Effects { wrench: true, friction: false });
    let names = |kind| -> Vec<String> {
        solution.quantities(kind).iter().map(|quantity| quantity.symbol.to_string()).collect()
    };
    assert_eq!(names(Kind::JointTorque), ["Q1", "Q2", "Q3", "Q4", "Q5"]);
    assert_eq!(names(Kind::LinkForce)[..4], ["F_l1.x", "F_l1.y", "F_l1.z", "F_l2.x"]);
    assert_eq!(names(Kind::CenterOfMassAcceleration).len(), 15);
}
