//! A symbolic robot with its recursion, from which all functions and base parameters are derived.

use std::cell::OnceCell;

use robot_model::functions::Effects;
use robot_model::robot::{Parameter, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Graph, Operations, SymbolId, operations, walk};

use crate::economical::{Plan, Recursion};
use crate::mechanism::{Mechanism, MechanismOptions};
use crate::newton_euler;

/// A symbolic robot from which functions are derived in one graph.
#[derive(Debug)]
pub struct Derivation<'r, 'g> {
    /// The robot.
    pub robot: &'r Robot,
    /// The symbolic robot.
    pub mechanism: Mechanism<'g>,
    /// The economical recursion. `None` if a joint axis depends on parameters, because the recursion cannot be set up
    /// in this case; functions are then derived from the paper's iterations.
    pub recursion: Option<Recursion<'g>>,
    /// Whether pivots of the mass matrix may be small. This is computed on first use.
    pub(crate) small_pivots: OnceCell<bool>,
}

impl<'r, 'g> Derivation<'r, 'g> {
    /// Expresses the robot in the symbols of `graph`.
    ///
    /// If no plan is given, the recursion uses [`Plan::default_for`].
    #[must_use]
    pub fn new(
        robot: &'r Robot,
        graph: &'g Graph,
        options: &MechanismOptions,
        plan: Option<Plan>,
    ) -> Derivation<'r, 'g> {
        let mechanism = Mechanism::new(robot, graph, options);
        let plan = plan.unwrap_or_else(|| Plan::default_for(robot));
        let recursion = Recursion::new(&mechanism, &plan);
        Derivation { robot, mechanism, recursion, small_pivots: OnceCell::new() }
    }

    /// The operations of the expressions; subexpressions that depend only on parameters are not counted.
    pub(crate) fn operations(&self, roots: &[Expr<'g>]) -> Operations {
        let symbol = |parameter: &Parameter| {
            self.mechanism.graph.find_symbol(&parameter.name).and_then(Expr::as_symbol)
        };
        let free: Vec<SymbolId> = self.robot.parameters.iter().filter_map(symbol).collect();
        operations(roots, |symbol| free.contains(&symbol))
    }

    /// This robot in the same graph with another plan.
    #[must_use]
    pub fn with_plan(&self, plan: &Plan) -> Derivation<'r, 'g> {
        let mechanism = self.mechanism.clone();
        let recursion = Recursion::new(&mechanism, plan);
        let small_pivots = self.small_pivots.clone();
        Derivation { robot: self.robot, mechanism, recursion, small_pivots }
    }

    /// The symbols of an input that has one entry for each coordinate.
    pub(crate) fn coordinate_symbols(&self, variable: JointVariable) -> Vec<Expr<'g>> {
        let names = variable.symbols(self.mechanism.degrees_of_freedom);
        names.iter().map(|name| self.mechanism.graph.symbol(name)).collect()
    }

    /// The joint torques by the paper's iterations, with some variables set to 0. They replace the economical recursion
    /// if it cannot be set up.
    pub(crate) fn paper_torques(&self, wrench: bool, zero: &[JointVariable]) -> Vec<Expr<'g>> {
        let effects = Effects { wrench, friction: false };
        let torques = newton_euler::newton_euler(&self.mechanism, effects).joint_torques;
        let graph = self.mechanism.graph;
        walk::rebuild(&torques, graph, |name| {
            let variable = JointVariable::parse(name).map(|(variable, _)| variable);
            let is_zero = variable.is_some_and(|variable| zero.contains(&variable));
            if is_zero { graph.zero() } else { graph.symbol(name) }
        })
    }
}
