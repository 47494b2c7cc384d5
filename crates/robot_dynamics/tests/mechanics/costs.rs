//! Choices of a recursion that save operations.

use robot_dynamics::economical::plan::{FreeAcceleration, LinkPlan};
use robot_dynamics::economical::{Plan, Solver};
use robot_dynamics::functions::Derivation;
use robot_dynamics::matrix::Pivots;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::FunctionKind;
use robot_model::variable::JointVariable;
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Expr, Graph, operations};

use crate::functions::outputs;

/// An acceleration of the free choice that stops the origin of the next link saves operations.
#[test]
fn an_acceleration_that_stops_the_next_origin_saves_operations() {
    for joints in [6, 7, 12] {
        let robot = robots::robot(&mut Random::new(7), &Recipe::serial(joints));
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let torques = robot.symbols(JointVariable::Torque);
        let torques: Vec<Expr<'_>> = torques.iter().map(|name| graph.symbol(name)).collect();
        let cost = |free| {
            let plan = Plan::uniform(joints, &LinkPlan { free, ..LinkPlan::DEFAULT });
            let recursion = derivation.with_plan(&plan).recursion.unwrap();
            let found =
                recursion.forward_dynamics(&torques, false, Solver::MassMatrix, Pivots::Checked);
            operations(&found.unwrap(), |_| false).flops()
        };
        let zero = cost(FreeAcceleration::Zero);
        for free in [FreeAcceleration::NextX, FreeAcceleration::NextY] {
            assert!(cost(free) < zero, "{joints}: {} {zero}", cost(free));
        }
    }
}

/// Columns of a long chain that are projected at different places need 2,248 and 11,892 operations.
#[test]
fn columns_of_long_chains_are_projected_at_a_common_place() {
    for (joints, most) in [(6, 2150), (12, 11_650)] {
        let robot = robots::robot(&mut Random::new(7), &Recipe::serial(joints));
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let outputs = outputs(&derivation, FunctionKind::Regressor);
        let roots: Vec<_> = outputs.into_iter().flat_map(|output| output.values).collect();
        let count = operations(&roots, |_| false).flops();
        assert!(count < most, "{joints}: {count}");
    }
}
