//! Power balance: the power of the drives equals the increase of the energy plus the power that the tips transmit.

use nalgebra::DVector;
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::Graph;

use robot_testing::energy::{Motion, energies};
use robot_testing::{evaluate, robot_files};

/// The power that the tips transmit to their surroundings, by the Jacobians of the numeric solver.
fn tip_power(robot: &Robot, solver: &robot_numeric::Mechanism, state: &State) -> f64 {
    let poses = solver.forward_kinematics(&state.q).unwrap();
    let tips = robot.frames.iter().enumerate().filter(|(_, frame)| frame.wrench.is_some());
    tips.map(|(index, _)| {
        let twist =
            solver.frame_jacobian(&state.q, index).unwrap() * DVector::from_vec(state.qd.clone());
        let turned = poses.frames[index].rotation;
        let (force, moment) =
            (turned * state.wrenches[index].force, turned * state.wrenches[index].moment);
        (0..3).map(|k| force[k] * twist[k] + moment[k] * twist[3 + k]).sum::<f64>()
    })
    .sum()
}

fn check(robot: &Robot, name: &str, seed: u64) {
    let graph = Graph::new();
    let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
    let kind = match robot.tips().next() {
        Some(_) => FunctionKind::InverseDynamics(Effects::WRENCH),
        None => FunctionKind::InverseDynamics(Effects::NONE),
    };
    let torques = derivation.functions(kind).remove(0).outputs.remove(0).values;
    let motion = Motion::new(&derivation.mechanism);
    let (kinetic, potential) = energies(&derivation.mechanism, &motion);
    let gain = motion.rate(&[kinetic + potential]);
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let mut random = Random::new(seed);
    for _ in 0..20 {
        let state = random.state(&solver);
        let torques = evaluate(robot, &torques, &state);
        let terms: Vec<f64> = torques.iter().zip(&state.qd).map(|(tau, qd)| tau * qd).collect();
        let size: f64 = terms.iter().map(|term| term.abs()).sum();
        let balance = terms.iter().sum::<f64>()
            - evaluate(robot, &gain, &state)[0]
            - tip_power(robot, &solver, &state);
        assert!(balance.abs() <= 1e-12 * size, "{name}, seed {seed}: {balance:e} of {size:e} W");
    }
}

#[test]
fn of_every_robot_file() {
    for (name, text) in robot_files() {
        check(&robot_testing::read(&name, &text), &name, 3);
    }
}

#[test]
fn of_random_robots() {
    for seed in 0..40 {
        let recipe = Recipe::tree(1 + seed as usize % 8);
        check(&robots::robot(&mut Random::new(seed), &recipe), "random robot", seed);
    }
}
