//! The paper's iterations and the economical recursion, with and without loads and friction.

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::{Effects, FunctionKind};
use robot_numeric::random::Random;
use robot_symbolic::{Expr, Graph};

use crate::{STATES, TOLERANCE, robots};
use robot_testing::place::{Layout, Off};
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, magnitude};

#[test]
fn joint_torques_and_forces_between_links_agree_with_the_numeric_solver() {
    for (name, robot, seed) in robots() {
        let mut random = Random::new(seed);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let graph = Graph::new();
        let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
        let plain = newton_euler(&mechanism, Effects { wrench: false, friction: false });
        let loaded = newton_euler(&mechanism, Effects { wrench: true, friction: true });
        let forces = loaded.wrenches.iter().flat_map(|wrench| wrench.force.0);
        let moments = loaded.wrenches.iter().flat_map(|wrench| wrench.moment.0);
        let components: Vec<Expr<'_>> = forces.chain(moments).collect();
        let recursion = Recursion::new(&mechanism, &Plan::default_for(&robot));
        let economical = recursion.map(|recursion| recursion.inverse_dynamics(true));
        let joints = [robot.degrees_of_freedom()];
        let links = [2, robot.links.len(), 3];
        let mut held: Vec<(&str, &[Expr<'_>], FunctionKind, &[usize])> = vec![
            ("Q", &plain.joint_torques, FunctionKind::InverseDynamics(Effects::NONE), &joints),
            (
                "Q with loads and friction",
                &loaded.joint_torques,
                FunctionKind::InverseDynamics(Effects::BOTH),
                &joints,
            ),
            ("F_l, then M_l", &components, FunctionKind::LinkWrenches, &links),
        ];
        if let Some(torques) = &economical {
            let kind = FunctionKind::InverseDynamics(Effects::WRENCH);
            held.push(("the economical Q with loads", torques, kind, &joints));
        }
        let states: Vec<_> = (0..STATES).map(|_| state(&mut random, &solver, &robot)).collect();
        for (what, roots, kind, shape) in held {
            let expected: Vec<Vec<f64>> =
                states.iter().map(|state| expected(&robot, &solver, kind, state)).collect();
            let size = magnitude(expected.iter().flatten()).max(1e-3);
            let layout = Layout::new(&robot, what, shape);
            for (state, expected) in states.iter().zip(&expected) {
                let off = Off::of(&layout, &evaluate(&robot, roots, state), expected, size);
                assert!(off.error <= TOLERANCE, "{name}: {off}");
            }
        }
    }
}
