//! The search for the cheapest plan of a robot, by regenerating and counting.
//!
//! Coordinate descent in a fixed order: deterministic, bounded, and with a whole generation at each step, so
//! that a plan's cost is the code's. A plan is accepted only if its torques agree with
//! those of the paper's iterations at test states.

mod changes;
mod cheapest;
mod limbs;

use std::collections::{BTreeSet, HashSet};

use robot_model::functions::Effects;
use robot_model::robot::{Parameter, Robot};
use robot_symbolic::{Counter, Expr, Graph, Operations, SymbolId, walk};

use crate::economical::Recursion;
use crate::economical::frames::chain::Base;
use crate::economical::plan::{FreeRate, LinkPlan, Origin, Place, Plan, Turn};
use crate::mechanism::{Mechanism, MechanismOptions};
use crate::newton_euler;
use changes::{Change, frame_changes, motion_changes};
use cheapest::Cheapest;
pub use cheapest::search_several;
use limbs::Limbs;

/// A plan must reproduce the torques to this fraction of the largest.
const TOLERANCE: f64 = 1e-12;
/// The most sweeps over all options of all links, improved or not.
const MAX_SWEEPS: usize = 6;
/// The number of starting plans to descend from: the cheapest.
const DESCENTS: usize = 2;
/// The number of plans after which no new descent begins.
const MAX_TRIES: usize = 3000;
/// Operations, summed over the candidates, after which a search ends with the best plan so far: the time
/// of a search goes with them. The longest arms of seven joints take some two million and a second.
/// Chains of dozens of joints, of which not even the first sweep would fit, are not descended from at
/// all: its plan is the best of the uniform ones.
const MAX_WORK: usize = 2_500_000;
/// The limit of searches that count several functions, each of which may be ten times as long.
const MAX_WORK_FOR: usize = 40 * MAX_WORK;

/// The measure that a search minimizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// Multiplications and additions.
    #[default]
    Operations,
    /// Operations with each product and the only sum that uses it counted as one multiply-add: for targets
    /// that have the instruction, and code that uses it.
    Instructions,
}

impl Measure {
    fn of(self, count: &Operations) -> usize {
        match self {
            Measure::Operations => count.flops(),
            Measure::Instructions => count.instructions(),
        }
    }
}

/// The result of a search.
#[derive(Clone, Debug)]
pub struct Found {
    /// The cheapest plan.
    pub plan: Plan,
    /// The measure that was minimized.
    pub measure: Measure,
    /// The plan's multiplications and additions, sines and cosines apart.
    pub operations: usize,
    /// The operations with fusible pairs counted once.
    pub instructions: usize,
    /// The number of plans that were generated and counted.
    pub tried: usize,
    /// Whether the search ended early because of the length of the mechanism: then it is the best plan that
    /// was seen, and others were not tried.
    pub cut_short: bool,
    /// Whether it was chosen among several by the time that its code took on some machine, which no search does itself.
    pub tuned: bool,
}

/// The expressions of a candidate that a search counts and checks.
#[derive(Clone, Debug)]
pub struct Objective<'g> {
    /// The expressions whose operations count.
    pub counted: Vec<Expr<'g>>,
    /// The expressions that must have the right values.
    pub checked: Vec<Expr<'g>>,
}

impl<'g> Objective<'g> {
    /// Expressions that are both counted and checked.
    #[must_use]
    pub fn new(roots: Vec<Expr<'g>>) -> Objective<'g> {
        Objective { checked: roots.clone(), counted: roots }
    }
}

type ObjectiveOf<'m, 'g> = &'m dyn Fn(&Recursion<'g>) -> Objective<'g>;

/// The groups of options that a search tries, besides those of frames and inertias.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scope {
    /// The options of the recursion over motions and forces.
    pub motions: bool,
    /// The options of composite inertias.
    pub composites: bool,
    /// The choice of accelerations in forward dynamics.
    pub free: bool,
}

/// Searches the cheapest plan for inverse dynamics.
///
/// The robot's parameters are free: what depends on them alone costs nothing. `None` if the
/// economical recursion does not apply (a joint axis that depends on parameters).
#[must_use]
pub fn search(robot: &Robot, options: &MechanismOptions, measure: Measure) -> Option<Found> {
    search_with(robot, options, measure, 0, |_, found| found)
}

/// Searches, keeps so many of the cheapest plans, and gives what is made of both.
fn search_with<T>(
    robot: &Robot,
    options: &MechanismOptions,
    measure: Measure,
    kept: usize,
    then: impl FnOnce(&mut Search<'_, '_>, Found) -> T,
) -> Option<T> {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, options);
    let base = Base::new(&mechanism)?;
    let effects = Effects { wrench: false, friction: false };
    let reference = newton_euler::newton_euler(&mechanism, effects).generalized_forces;
    let torques: ObjectiveOf<'_, '_> =
        &|recursion| Objective::new(recursion.inverse_dynamics(false));
    let mut search = Search::new(robot, &mechanism, &base, torques, &reference);
    search.measure = measure;
    search.cheapest = Cheapest::new(kept);
    let scope = Scope { motions: true, composites: false, free: false };
    let found = if limbs::applies(&mechanism) {
        search.max_work = limbs::MAX_WORK;
        Limbs { robot, options, measure }.search(&mut search, scope)
    } else {
        search.run(scope)
    };
    Some(then(&mut search, found))
}

/// Searches the plan with the fewest multiplications and additions for the given functions.
///
/// Candidates are checked against the values under the plan that keeps the file's frames. `None` if
/// the economical recursion does not apply (a joint axis that depends on parameters).
#[must_use]
pub fn search_for(
    robot: &Robot,
    options: &MechanismOptions,
    scope: Scope,
    objective: &dyn for<'m, 'g> Fn(&'m Mechanism<'g>, &Recursion<'g>) -> Objective<'g>,
) -> Option<Found> {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, options);
    let base = Base::new(&mechanism)?;
    let file = Plan::uniform(mechanism.links.len(), &FILE);
    let of_mechanism: ObjectiveOf<'_, '_> = &|recursion| objective(&mechanism, recursion);
    let reference = of_mechanism(&Recursion::from_base(&mechanism, &base, &file)).checked;
    let mut search = Search::new(robot, &mechanism, &base, of_mechanism, &reference);
    search.max_work = MAX_WORK_FOR;
    Some(search.run(scope))
}

/// The frames of the file.
const FILE: LinkPlan = LinkPlan { origin: Origin::File, turn: Turn::File, ..LinkPlan::BASIC };

/// Options to descend from, the same for every link that is searched.
fn starts() -> [LinkPlan; 5] {
    let searched = LinkPlan { angle_sum: true, column: true, diagonal: true, ..LinkPlan::BASIC };
    [
        LinkPlan::BASIC,
        FILE,
        LinkPlan { moment: [false, false, true], ..searched.clone() },
        LinkPlan { moment: [true; 3], doubled: true, ..searched.clone() },
        LinkPlan { origin: Origin::PreviousNormal, composite_sum: true, ..searched },
    ]
}

/// A fixed sequence of pseudo-random numbers (xorshift): the search is the same at every run.
struct Steps(u64);

impl Steps {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) as usize % bound.max(1)
    }
}

struct Search<'m, 'g> {
    mechanism: &'m Mechanism<'g>,
    base: &'m Base<'g>,
    /// The links whose options are searched.
    searched: Vec<usize>,
    /// Whether the unit of length is searched.
    with_unit: bool,
    objective: ObjectiveOf<'m, 'g>,
    /// The robot's parameters: all other symbols are inputs.
    parameters: BTreeSet<SymbolId>,
    counter: Counter,
    states: Vec<Vec<f64>>,
    reference: Vec<Vec<f64>>,
    measure: Measure,
    tried: usize,
    /// Plans that need not be tried again, if they are kept.
    known: Option<HashSet<Plan>>,
    cheapest: Cheapest,
    work: usize,
    max_tries: usize,
    max_work: usize,
}

impl<'m, 'g> Search<'m, 'g> {
    fn new(
        robot: &Robot,
        mechanism: &'m Mechanism<'g>,
        base: &'m Base<'g>,
        objective: ObjectiveOf<'m, 'g>,
        reference: &[Expr<'g>],
    ) -> Search<'m, 'g> {
        let graph = mechanism.graph;
        let symbol =
            |parameter: &Parameter| graph.find_symbol(&parameter.name).and_then(Expr::as_symbol);
        let parameters = robot.parameters.iter().filter_map(symbol).collect();
        let states: Vec<Vec<f64>> =
            (0..4).map(|state| test_state(state, graph.symbol_count())).collect();
        let reference = states.iter().map(|state| evaluate(reference, state)).collect();
        Search {
            mechanism,
            base,
            searched: (0..mechanism.links.len()).collect(),
            with_unit: true,
            objective,
            parameters,
            counter: Counter::default(),
            states,
            reference,
            measure: Measure::Operations,
            tried: 0,
            known: None,
            cheapest: Cheapest::new(0),
            work: 0,
            max_tries: MAX_TRIES,
            max_work: MAX_WORK,
        }
    }

    fn run(&mut self, scope: Scope) -> Found {
        let (_, plan) = self.best_descent(scope, None);
        let cut_short = self.is_spent();
        Found { cut_short, ..self.found(plan) }
    }

    /// A plan with what it costs.
    fn found(&mut self, plan: Plan) -> Found {
        let candidate = self.candidate(&plan);
        let count = self.operations(&candidate.counted);
        let (operations, instructions) = (count.flops(), count.instructions());
        let (measure, tried) = (self.measure, self.tried);
        Found { plan, measure, operations, instructions, tried, cut_short: false, tuned: false }
    }

    /// Plans to descend from, the cheapest first: one with the options of `held` for all links, and some with
    /// others for those that are searched. Those with wrong values are left out, unless all are wrong.
    fn ranked(&mut self, held: Option<Plan>) -> Vec<(usize, Plan)> {
        let links = self.mechanism.links.len();
        let under = held.clone().unwrap_or_else(|| Plan::uniform(links, &LinkPlan::BASIC));
        let mut plans = Vec::from_iter(held);
        for start in starts() {
            let mut plan = under.clone();
            self.searched.iter().for_each(|link| plan.links[*link].clone_from(&start));
            plans.push(plan);
        }
        let (mut right, mut wrong) = (vec![], vec![]);
        for plan in plans {
            let candidate = self.candidate(&plan);
            let cost = self.cost_of(&plan, &candidate);
            let list = if self.is_accurate(&candidate.checked) { &mut right } else { &mut wrong };
            list.push((cost, plan));
        }
        let mut ranked = if right.is_empty() { wrong } else { right };
        ranked.sort_by_key(|(cost, _)| *cost);
        ranked
    }

    /// The cheapest of a few plans, without a descent, and its cost.
    fn cheapest_start(&mut self) -> (usize, Plan) {
        self.ranked(None).swap_remove(0)
    }

    /// The best of the descents from the cheapest of a few plans, and of further descents from
    /// neighbors of the best; and its cost.
    fn best_descent(&mut self, scope: Scope, held: Option<Plan>) -> (usize, Plan) {
        let ranked = self.ranked(held);
        let (mut best, mut plan) = ranked[0].clone();
        if !self.can_sweep(scope, &plan, best) {
            self.end();
        }
        for (cost, start) in ranked.into_iter().take(DESCENTS) {
            let found = self.descend(scope, start, cost);
            if found.0 < best {
                (best, plan) = found;
            }
        }
        // Out of a dead end by a few changes at random, from there downhill again.
        let mut steps = Steps(1);
        while self.tried < self.max_tries && !self.is_spent() && !self.searched.is_empty() {
            let perturbed = self.perturb(scope, &plan, &mut steps);
            let cost = self.cost(&perturbed);
            let (cost, candidate) = self.descend(scope, perturbed, cost);
            if cost <= best && self.better(&candidate, best + 1).is_some() {
                (best, plan) = (cost, candidate);
            }
        }
        (best, plan)
    }

    /// Whether the budget is enough to try all changes of all links once.
    fn can_sweep(&self, scope: Scope, plan: &Plan, cost: usize) -> bool {
        let links = self.searched.iter();
        let changes: usize =
            links.map(|link| self.alternatives(scope, &plan.links[*link], *link).len()).sum();
        self.work + changes * cost <= self.max_work
    }

    /// A copy of the plan with a few options changed at random.
    fn perturb(&self, scope: Scope, plan: &Plan, steps: &mut Steps) -> Plan {
        let mut perturbed = plan.clone();
        for _ in 0..2 + steps.below(3) {
            let link = self.searched[steps.below(self.searched.len())];
            let changes = self.alternatives(scope, &perturbed.links[link], link);
            let change = steps.below(changes.len());
            changes[change](&mut perturbed.links[link]);
        }
        perturbed
    }

    fn candidate(&self, plan: &Plan) -> Objective<'g> {
        (self.objective)(&Recursion::from_base(self.mechanism, self.base, plan))
    }

    fn cost(&mut self, plan: &Plan) -> usize {
        let candidate = self.candidate(plan);
        self.cost_of(plan, &candidate)
    }

    fn cost_of(&mut self, plan: &Plan, candidate: &Objective<'g>) -> usize {
        let count = self.operations(&candidate.counted);
        self.tried += 1;
        self.work += count.flops();
        let cost = self.measure.of(&count);
        self.cheapest.offer(cost, &count, plan);
        cost
    }

    /// Ends the search.
    fn end(&mut self) {
        self.work = self.max_work;
    }

    fn is_spent(&self) -> bool {
        self.work >= self.max_work
    }

    fn operations(&mut self, roots: &[Expr<'g>]) -> Operations {
        let Search { counter, parameters, .. } = self;
        counter.count(roots, |symbol| parameters.contains(&symbol))
    }

    /// The plan's cost if it is below a bound and the values are right.
    fn better(&mut self, plan: &Plan, bound: usize) -> Option<usize> {
        let candidate = self.candidate(plan);
        let cost = self.cost_of(plan, &candidate);
        (cost < bound && self.is_accurate(&candidate.checked)).then_some(cost)
    }

    fn is_accurate(&self, roots: &[Expr<'g>]) -> bool {
        self.states.iter().zip(&self.reference).all(|(state, reference)| {
            let size = reference.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            let values = evaluate(roots, state);
            // A comparison with NaN is false: such a plan is rejected.
            values.iter().zip(reference).all(|(a, b)| (a - b).abs() <= TOLERANCE * size)
        })
    }

    fn descend(&mut self, scope: Scope, mut plan: Plan, mut cost: usize) -> (usize, Plan) {
        for _ in 0..MAX_SWEEPS {
            let before = cost;
            for link in self.searched.clone().into_iter().rev() {
                for alternative in self.alternatives(scope, &plan.links[link], link) {
                    self.try_link(&mut plan, &mut cost, link, &alternative);
                }
            }
            if self.with_unit {
                self.descend_unit(&mut plan, &mut cost);
            }
            if cost == before {
                break;
            }
        }
        (cost, plan)
    }

    /// The changes of one option, or of two that go together, of a link.
    fn alternatives(&self, scope: Scope, current: &LinkPlan, link: usize) -> Vec<Change> {
        let mut changes = frame_changes(current);
        if scope.motions {
            changes.extend(motion_changes());
        }
        if scope.free {
            for free in FreeRate::ALL {
                changes.push(Box::new(move |plan| plan.free = free));
            }
        }
        if scope.composites {
            changes.push(Box::new(|plan| plan.composite_sum ^= true));
            changes.push(Box::new(|plan| plan.projected_at = None));
            let mut inward = Some(link);
            while let Some(link) = inward {
                for turned in [false, true] {
                    let place = Some(Place { link, turned });
                    changes.push(Box::new(move |plan| plan.projected_at = place));
                }
                inward = self.mechanism.links[link].parent;
            }
        }
        changes
    }

    fn try_link(
        &mut self,
        plan: &mut Plan,
        cost: &mut usize,
        link: usize,
        change: &dyn Fn(&mut LinkPlan),
    ) {
        let mut candidate = plan.clone();
        change(&mut candidate.links[link]);
        if candidate.links[link] == plan.links[link] || self.is_spent() {
            return;
        }
        if self.known.as_mut().is_some_and(|known| !known.insert(candidate.clone())) {
            return;
        }
        if let Some(lower) = self.better(&candidate, *cost) {
            (*plan, *cost) = (candidate, lower);
        }
    }

    fn descend_unit(&mut self, plan: &mut Plan, cost: &mut usize) {
        let components = (0..plan.links.len()).flat_map(|link| (0..3).map(move |k| (link, k)));
        for unit in components {
            if self.is_spent() {
                return;
            }
            let candidate = Plan { unit_length: Some(unit), ..plan.clone() };
            if let Some(lower) = self.better(&candidate, *cost) {
                (*plan, *cost) = (candidate, lower);
            }
        }
    }
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

#[cfg(test)]
mod tests;
