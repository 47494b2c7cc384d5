//! The search for the cheapest plan of a robot, which derives and counts every candidate.
//!
//! The search is a coordinate descent in a fixed order. It is deterministic and bounded, and it derives the whole
//! recursion at each step, so that the cost of a plan is that of the code. A plan is accepted only if its torques agree
//! with those of the paper's iterations at test states.

mod changes;
mod cheapest;
mod limbs;

use std::collections::{BTreeSet, HashSet};

use robot_model::functions::Effects;
use robot_model::robot::{Parameter, Robot};
use robot_symbolic::{Counter, Expr, Graph, Operations, SymbolId, walk};

use crate::economical::Recursion;
use crate::economical::frames::chain::Base;
use crate::economical::plan::{FreeAcceleration, LinkPlan, Origin, Place, Plan, Turn};
use crate::mechanism::{Mechanism, MechanismOptions};
use crate::newton_euler;
use changes::{Change, frame_changes, motion_changes};
use cheapest::Cheapest;
pub use cheapest::search_several;
use limbs::Limbs;

/// The maximum error of the torques of a plan, relative to the largest torque.
const TOLERANCE: f64 = 1e-12;
/// The maximum number of sweeps over all options of all links.
const MAX_SWEEPS: usize = 6;
/// The number of starting plans from which a descent is started; the cheapest are chosen.
const DESCENTS: usize = 2;
/// The number of plans after which no new descent is started.
const MAX_TRIES: usize = 3000;
/// The number of operations, summed over the candidates, after which a search ends with the best plan so far; the time
/// of a search is proportional to it. The longest searches for arms with seven joints take about two million operations
/// and a second. Chains of dozens of joints exceed the limit in their first sweep. For them, no descent is started: the
/// result is the best of the uniform plans.
const MAX_WORK: usize = 2_500_000;
/// The limit for searches that count several functions, each of which may be ten times as long.
const MAX_WORK_FOR: usize = 40 * MAX_WORK;

/// The measure that a search minimizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The number of multiplications and additions.
    #[default]
    Operations,
    /// The number of operations, in which a product and the only sum that uses it count as one multiply-add. This is
    /// for targets with such an instruction, and code that uses it.
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
    /// The number of multiplications and additions of the plan's expressions, without sines and cosines. The code needs
    /// no more; plan files state its number instead.
    pub operations: usize,
    /// The number of operations, with fusible pairs counted once.
    pub instructions: usize,
    /// The number of plans that were derived and counted.
    pub tried: usize,
    /// Whether the search ended early because of the length of the mechanism. The plan is then the best one that was
    /// found, and others were not tried.
    pub cut_short: bool,
    /// Whether the plan was chosen among several by the run time of its code on some machine. No search does this
    /// itself.
    pub tuned: bool,
}

/// The expressions of a candidate that a search counts and checks.
#[derive(Clone, Debug)]
pub struct Objective<'g> {
    /// The expressions whose operations are counted.
    pub counted: Vec<Expr<'g>>,
    /// The expressions whose values must be right.
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

/// The groups of options that a search tries, in addition to those of frames and inertias.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scope {
    /// The options of the recursion over motions and forces.
    pub motions: bool,
    /// The options of composite inertias.
    pub composites: bool,
    /// The choice of the accelerations that forward dynamics assumes.
    pub free: bool,
}

/// Searches for the cheapest plan for inverse dynamics.
///
/// Expressions that only depend on the robot's parameters are not counted. `None` if the economical recursion does not
/// apply because a joint axis depends on parameters.
#[must_use]
pub fn search(robot: &Robot, options: &MechanismOptions, measure: Measure) -> Option<Found> {
    search_with(robot, options, measure, 0, |_, found| found)
}

/// Searches for the cheapest plan and keeps the given number of the cheapest plans; returns the result of `then` for
/// both.
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
    let reference = newton_euler::newton_euler(&mechanism, effects).joint_torques;
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

/// Searches for the plan with the fewest multiplications and additions for the given functions.
///
/// The candidates' values are compared with those of the plan that keeps the file's frames. `None` if the economical
/// recursion does not apply because a joint axis depends on parameters.
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

/// Options that keep the frames of the file.
const FILE: LinkPlan = LinkPlan { origin: Origin::File, turn: Turn::File, ..LinkPlan::BASIC };

/// Options from which a descent may be started, the same for every link that is searched.
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

/// A fixed sequence of pseudo-random numbers (xorshift), so that the search is the same in every run.
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
    /// The links whose options are varied.
    searched: Vec<usize>,
    /// Whether the unit of length is varied.
    with_unit: bool,
    objective: ObjectiveOf<'m, 'g>,
    /// The robot's parameters; all other symbols are inputs.
    parameters: BTreeSet<SymbolId>,
    counter: Counter,
    states: Vec<Vec<f64>>,
    reference: Vec<Vec<f64>>,
    measure: Measure,
    tried: usize,
    /// Plans that need not be tried again; `None` if they are not recorded.
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

    /// A plan with its cost.
    fn found(&mut self, plan: Plan) -> Found {
        let candidate = self.candidate(&plan);
        let count = self.operations(&candidate.counted);
        let (operations, instructions) = (count.flops(), count.instructions());
        let (measure, tried) = (self.measure, self.tried);
        Found { plan, measure, operations, instructions, tried, cut_short: false, tuned: false }
    }

    /// Plans from which to start a descent, the cheapest first: one with the options of `held` for all links, and
    /// several with other options for the links that are searched. Plans that give wrong values are left out, unless
    /// all do.
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

    /// The best plan of the descents from the cheapest of a few plans and of further descents from neighbors of the
    /// best; and its cost.
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
        // A few random changes, followed by another descent, may lead out of a local minimum.
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

    /// Whether the remaining budget is enough to try all changes of all links once.
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
            // A comparison with NaN is false, so a plan with such values is rejected.
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

    /// The changes of single options of a link, and of two options that belong together.
    fn alternatives(&self, scope: Scope, current: &LinkPlan, link: usize) -> Vec<Change> {
        let mut changes = frame_changes(current);
        if scope.motions {
            changes.extend(motion_changes());
        }
        if scope.free {
            for free in FreeAcceleration::ALL {
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

/// Values for all symbols, distributed by the golden ratio: parameters are positive, and states are of order 1.
fn test_state(state: usize, symbols: usize) -> Vec<f64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let value = |symbol: usize| ((state * 131 + symbol + 1) as f64 * GOLDEN).fract() + 0.4;
    (0..symbols).map(value).collect()
}

#[cfg(test)]
mod tests;
