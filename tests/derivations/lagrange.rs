//! A second derivation from the energies: Lagrange's equations, by symbolic differentiation of T − V, agree exactly
//! with the Newton–Euler iterations: the difference expands to zero.

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::Graph;
use robot_symbolic::polynomial::expands_to_zero;

use robot_testing::energy::{Motion, energies};

/// Checks the equation of each coordinate; returns the number of recursions that were compared.
fn check(robot: &Robot, name: &str) -> usize {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::EXACT);
    let motion = Motion::new(&mechanism);
    let (kinetic, potential) = energies(&mechanism, &motion);
    let lagrangian = kinetic - potential;
    let effects = Effects { wrench: false, friction: false };
    let mut torques = vec![("iterations", newton_euler(&mechanism, effects).joint_torques)];
    // With a skew axis whose exact components are irrational, there are no working frames; the numeric tests cover this
    // case.
    if let Some(recursion) = Recursion::new(&mechanism, &Plan::default_for(robot)) {
        torques.push(("economical recursion", recursion.inverse_dynamics(false)));
    }
    for (index, (q, qd)) in motion.q.iter().zip(&motion.qd).enumerate() {
        // d/dt ∂L/∂q̇ − ∂L/∂q
        let momentum = lagrangian.derivative(*qd);
        let force = motion.rate(&[momentum])[0] - lagrangian.derivative(*q);
        for (recursion, torques) in &torques {
            let difference = force - torques[index];
            let zero = expands_to_zero(difference)
                .unwrap_or_else(|error| panic!("{name}, Q{}: {error}", index + 1));
            assert!(zero, "{name}: Lagrange's Q{} is not that of the {recursion}", index + 1);
        }
    }
    torques.len()
}

#[test]
fn trttr1_and_the_planar_arms() {
    for name in ["trttr1", "planar_2r", "planar_3r"] {
        assert_eq!(check(&robot_testing::robot(name), name), 2);
    }
}

#[test]
fn random_robots_of_up_to_three_joints() {
    // Three joints with skew axes take seconds, because their expansions have 10⁵ terms.
    let robots = [(0, 1), (1, 2), (2, 3), (3, 1), (4, 2), (6, 1), (7, 2), (10, 2), (13, 2)];
    for (seed, joints) in robots {
        let robot = robots::robot(&mut Random::new(seed), &Recipe::serial(joints));
        check(&robot, &format!("seed {seed}, {joints} joints"));
    }
}

#[test]
fn random_parameterized_robots() {
    for seed in 100..106 {
        let joints = 1 + seed as usize % 2;
        let robot = robots::robot(&mut Random::new(seed), &Recipe::serial(joints));
        check(&robots::parameterized(&robot), &format!("seed {seed}, {joints} joints"));
    }
}
