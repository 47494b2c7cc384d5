//! The search for the cheapest plan of a robot, by regenerating and counting.
//!
//! Coordinate descent in a fixed order: deterministic, bounded, and each step a whole generation, so
//! that a plan's cost is what the code will have. A plan is taken only where its torques agree with
//! those of the paper's iterations at test states.

use robot_symbolic::{Expr, Graph, SymbolId, operations, walk};

use super::chain::Base;
use super::plan::{Entry, LinkPlan, Origin, Plan, Turn};
use crate::mechanism::{Mechanism, MechanismOptions};
use crate::model::Robot;
use crate::newton_euler::{self, Effects};

/// A plan must reproduce the torques to this fraction of the largest.
const TOLERANCE: f64 = 1e-12;
/// Sweeps over all options of all links after which the descent ends, improved or not.
const MAX_SWEEPS: usize = 6;

/// What a search found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The cheapest plan.
    pub plan: Plan,
    /// Its multiplications and additions, sines and cosines apart.
    pub operations: usize,
    /// How many plans were generated and counted.
    pub tried: usize,
}

/// Searches the plan with the fewest multiplications and additions for inverse dynamics.
///
/// The robot's parameters are free: what depends on them alone costs nothing. `None` where the
/// economical recursion does not apply (a joint axis that depends on parameters).
#[must_use]
pub fn search(robot: &Robot, options: &MechanismOptions) -> Option<Found> {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, options);
    let base = Base::new(&mechanism)?;
    let mut search = Search::new(&mechanism, &base);
    let links = mechanism.links.len();
    let starts = [
        LinkPlan::BASIC,
        LinkPlan { origin: Origin::File, turn: Turn::File, ..LinkPlan::BASIC },
        LinkPlan { angle_sum: true, column: true, moment: [true; 3], ..LinkPlan::BASIC },
        LinkPlan { origin: Origin::PreviousNormal, angle_sum: true, ..LinkPlan::BASIC },
    ];
    let mut best: Option<(usize, Plan)> = None;
    for start in &starts {
        let start = Plan::uniform(links, start);
        let cost = search.cost(&start);
        let found = search.descend(start, cost);
        if best.as_ref().is_none_or(|(cost, _)| found.0 < *cost) {
            best = Some(found);
        }
    }
    let (operations, plan) = best?;
    Some(Found { plan, operations, tried: search.tried })
}

struct Search<'m, 'g> {
    mechanism: &'m Mechanism<'g>,
    base: &'m Base<'g>,
    /// Symbols that are inputs: all others are parameters.
    inputs: Vec<SymbolId>,
    states: Vec<Vec<f64>>,
    reference: Vec<Vec<f64>>,
    tried: usize,
}

impl<'m, 'g> Search<'m, 'g> {
    fn new(mechanism: &'m Mechanism<'g>, base: &'m Base<'g>) -> Search<'m, 'g> {
        let graph = mechanism.graph;
        let effects = Effects { wrench: false, friction: false };
        let reference = newton_euler::newton_euler(mechanism, effects).driving_forces;
        let motions = ["q", "qd", "qdd"];
        let symbols = motions.iter().flat_map(|prefix| {
            (1..=mechanism.degrees_of_freedom)
                .filter_map(move |number| graph.symbol(&format!("{prefix}{number}")).as_symbol())
        });
        let inputs = symbols.collect();
        let states: Vec<Vec<f64>> =
            (0..4).map(|state| test_state(state, graph.symbol_count())).collect();
        let reference = states.iter().map(|state| evaluate(&reference, state)).collect();
        Search { mechanism, base, inputs, states, reference, tried: 0 }
    }

    fn torques(&mut self, plan: &Plan) -> Vec<Expr<'g>> {
        self.tried += 1;
        super::inverse_dynamics_from(self.mechanism, self.base, plan, false)
    }

    fn cost(&mut self, plan: &Plan) -> usize {
        let torques = self.torques(plan);
        self.count(&torques)
    }

    fn count(&self, torques: &[Expr<'g>]) -> usize {
        operations(torques, |symbol| !self.inputs.contains(&symbol)).flops()
    }

    /// The cost where it is below a bound and the torques are right.
    fn better(&mut self, plan: &Plan, bound: usize) -> Option<usize> {
        let torques = self.torques(plan);
        let cost = self.count(&torques);
        (cost < bound && self.is_accurate(&torques)).then_some(cost)
    }

    fn is_accurate(&self, torques: &[Expr<'g>]) -> bool {
        self.states.iter().zip(&self.reference).all(|(state, reference)| {
            let size = reference.iter().fold(0.0_f64, |size, torque| size.max(torque.abs()));
            let values = evaluate(torques, state);
            // A comparison with NaN is false: such a plan is refused.
            values.iter().zip(reference).all(|(a, b)| (a - b).abs() <= TOLERANCE * size)
        })
    }

    fn descend(&mut self, mut plan: Plan, mut cost: usize) -> (usize, Plan) {
        for _ in 0..MAX_SWEEPS {
            let before = cost;
            for link in (0..plan.links.len()).rev() {
                for alternative in alternatives(&plan.links[link]) {
                    self.try_link(&mut plan, &mut cost, link, &alternative);
                }
            }
            self.descend_unit(&mut plan, &mut cost);
            if cost == before {
                break;
            }
        }
        (cost, plan)
    }

    fn try_link(&mut self, plan: &mut Plan, cost: &mut usize, link: usize, change: &Change) {
        let mut candidate = plan.clone();
        change(&mut candidate.links[link]);
        if candidate.links[link] == plan.links[link] {
            return;
        }
        if let Some(lower) = self.better(&candidate, *cost) {
            (*plan, *cost) = (candidate, lower);
        }
    }

    fn descend_unit(&mut self, plan: &mut Plan, cost: &mut usize) {
        let components = (0..plan.links.len()).flat_map(|link| (0..3).map(move |k| (link, k)));
        for unit in components {
            let candidate = Plan { unit_length: Some(unit), ..plan.clone() };
            if let Some(lower) = self.better(&candidate, *cost) {
                (*plan, *cost) = (candidate, lower);
            }
        }
    }
}

type Change = Box<dyn Fn(&mut LinkPlan)>;

/// The changes of one option, or of two that go together, of a link.
fn alternatives(current: &LinkPlan) -> Vec<Change> {
    let mut changes: Vec<Change> = vec![];
    let origins = [
        Origin::File,
        Origin::NextNormal,
        Origin::PreviousNormal,
        Origin::ZeroXz,
        Origin::ZeroYz,
        Origin::MassCentre,
        Origin::Parent,
    ];
    for turn in [current.turn, Turn::File, Turn::NextNormal, Turn::FirstMoment] {
        for origin in origins {
            changes.push(Box::new(move |plan| {
                (plan.origin, plan.turn) = (origin, turn);
            }));
        }
    }
    changes.push(Box::new(|plan| plan.angle_sum ^= true));
    changes.push(Box::new(|plan| plan.column ^= true));
    for k in 0..3 {
        changes.push(Box::new(move |plan| plan.moment[k] ^= true));
    }
    changes.push(Box::new(|plan| {
        plan.angle_sum ^= true;
        plan.column ^= true;
    }));
    for kind in 0..3 {
        changes.push(Box::new(move |plan| plan.residual[kind] = None));
        for entry in Entry::ALL {
            changes.push(Box::new(move |plan| plan.residual[kind] = Some(entry)));
        }
    }
    changes
}

fn evaluate(roots: &[Expr<'_>], state: &[f64]) -> Vec<f64> {
    walk::evaluate(roots, |symbol| state.get(symbol.index()).copied().unwrap_or(f64::NAN))
}

/// Values for all symbols, spread by the golden ratio: parameters positive, states of order 1.
fn test_state(state: usize, symbols: usize) -> Vec<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let value = |symbol: usize| ((state * 131 + symbol + 1) as f64 * GOLDEN).fract() + 0.4;
    (0..symbols).map(value).collect()
}
