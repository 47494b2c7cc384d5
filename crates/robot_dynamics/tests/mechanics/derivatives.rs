//! Checks every form of the torques' derivatives and of the Coriolis matrix with random plans, including forms that no
//! function uses.

use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::FunctionKind;
use robot_numeric::Mechanism;
use robot_numeric::random::Random;
use robot_symbolic::Graph;
use robot_testing::plans::random_plan;
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, largest_difference, magnitude};

use crate::{STATES, TOLERANCE, robots};

#[test]
fn every_form_has_the_solvers_values() {
    let (mut derivatives, mut matrices) = (0, 0);
    for (name, robot, seed) in robots() {
        let mut random = Random::new(seed);
        let solver = Mechanism::nominal(&robot).unwrap();
        let graph = Graph::new();
        let plan = random_plan(&mut random, &robot);
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, Some(plan));
        let Some(recursion) = &derivation.recursion else { continue };
        let forms = recursion.torque_derivatives();
        let coriolis = recursion.coriolis_matrix();
        let gyroscopic = robot.links.iter().any(|link| link.drive.gyroscopic);
        assert!(gyroscopic || forms.len() == 3 && coriolis.len() == 2, "{name}");
        for _ in 0..STATES {
            let state = state(&mut random, &solver, &robot);
            let value = |kind| expected(&robot, &solver, kind, &state);
            // The Coriolis matrix is zero for some robots.
            let size = magnitude(value(FunctionKind::InverseDynamicsDerivatives).iter());
            let check = |kind, roots: &[_], form: usize| {
                let off = largest_difference(&evaluate(&robot, roots, &state), &value(kind));
                assert!(off <= TOLERANCE * size, "{name}, {}, form {form}: {off}", kind.name());
            };
            for (form, found) in forms.iter().enumerate() {
                let roots = [found.positions.rows(), found.velocities.rows()].concat();
                check(FunctionKind::InverseDynamicsDerivatives, &roots, form);
                derivatives += 1;
            }
            for (form, found) in coriolis.iter().enumerate() {
                check(FunctionKind::CoriolisMatrix, &found.rows(), form);
                matrices += 1;
            }
        }
    }
    assert!(derivatives > 100 && matrices > 70, "{derivatives} {matrices}");
}
