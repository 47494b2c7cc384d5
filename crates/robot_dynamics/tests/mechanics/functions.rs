//! Every function that the numeric solver has, under the default plan and plans drawn at random.

use robot_dynamics::economical::Plan;
use robot_dynamics::functions::{Derivation, Output};
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::FunctionKind;
use robot_model::robot::Robot;
use robot_numeric::random::Random;
use robot_symbolic::{Expr, Graph};

use crate::{STATES, TOLERANCE, robots};
use robot_testing::place::{Layout, Off};
use robot_testing::plans::random_plan;
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, magnitude};

/// All functions but those over base parameters, which are in `base_parameters.rs`.
fn kinds(robot: &Robot) -> impl Iterator<Item = FunctionKind> {
    let over_base = [FunctionKind::RegressorBase, FunctionKind::BaseParameters];
    FunctionKind::of_robot(robot).into_iter().filter(move |kind| !over_base.contains(kind))
}

/// The outputs that the solver has: of the regressor the columns of the links.
fn outputs<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Output<'g>> {
    let functions = derivation.functions(kind).into_iter();
    let mut outputs: Vec<_> = functions.flat_map(|function| function.outputs).collect();
    if kind == FunctionKind::Regressor {
        let inertial = robot_model::robot::LINK_PARAMETERS * derivation.robot.links.len();
        for output in &mut outputs {
            let rows = output.values.chunks(output.shape[1]);
            output.values = rows.flat_map(|row| row[..inertial].to_vec()).collect();
            output.shape[1] = inertial;
        }
    }
    outputs
}

#[test]
fn functions_agree_with_the_numeric_solver() {
    for (name, robot, seed) in robots() {
        let mut random = Random::new(seed);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let states: Vec<_> = (0..STATES).map(|_| state(&mut random, &solver, &robot)).collect();
        let graph = Graph::new();
        let usual = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let drawn: Vec<Plan> = (0..2).map(|_| random_plan(&mut random, &robot)).collect();
        let drawn: Vec<_> = drawn.iter().map(|plan| (usual.with_plan(plan), plan)).collect();
        for kind in kinds(&robot) {
            let expected: Vec<Vec<f64>> =
                states.iter().map(|state| expected(&robot, &solver, kind, state)).collect();
            let size = magnitude(expected.iter().flatten()).max(1e-3);
            let hold = |derivation: &Derivation<'_, '_>, plan: Option<&Plan>| {
                let outputs = outputs(derivation, kind);
                let layout = Layout::of(&robot, &outputs);
                let roots: Vec<Expr<'_>> =
                    outputs.into_iter().flat_map(|output| output.values).collect();
                for (state, expected) in states.iter().zip(&expected) {
                    let off = Off::of(&layout, &evaluate(&robot, &roots, state), expected, size);
                    assert!(off.error <= TOLERANCE, "{name}, {}: {off}\n{plan:?}", kind.name());
                }
            };
            hold(&usual, None);
            // The several ways to the derivatives are compared by the operations, which takes long.
            if kind != FunctionKind::InverseDynamicsDerivatives {
                drawn.iter().for_each(|(derivation, plan)| hold(derivation, Some(plan)));
            }
        }
    }
}
