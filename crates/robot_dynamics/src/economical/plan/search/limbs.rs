//! The search for plans of trees and long chains, limb by limb.
//!
//! A limb is a chain of links between branchings. The options of a link affect the operations of its neighbors but
//! hardly those of links farther away. A limb, or a window of a long limb, is therefore searched like a separate robot,
//! together with a few adjacent links whose options are held fixed. The result is accepted if the whole robot then
//! needs fewer operations and has the same torques.

use std::collections::{BTreeMap, HashSet};

use robot_model::functions::Effects;
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use super::{Found, Measure, Objective, ObjectiveOf, Scope, Search};
use crate::economical::Recursion;
use crate::economical::frames::chain::Base;
use crate::economical::plan::{LinkPlan, Plan};
use crate::mechanism::{BaseMotion, Mechanism, MechanismLink, MechanismOptions};
use crate::newton_euler;

/// The maximum length of a chain that is searched as a whole.
const LONGEST: usize = 10;
/// The number of links in a window of a longer limb. In every second round, the windows are shifted by half their
/// length.
const WINDOW: usize = 5;
/// The number of links inward of a window whose options are held fixed.
const INWARD: usize = 1;
/// The number of links near the base whose motions lack components. Beyond them, a window starts from an arbitrary
/// motion.
const NEAR: usize = 3;
/// The maximum number of rounds over all limbs.
const MAX_ROUNDS: usize = 6;
/// The number of plans for one limb or window after which no new descent is started.
const MAX_TRIES: usize = 1000;
/// The number of operations, summed over the candidates of all limbs, after which the search ends with the best plan so
/// far.
pub(super) const MAX_WORK: usize = 5_000_000;

/// The number of operations that are allowed for final sweeps over the whole robot; they are omitted if it is not
/// enough for one.
const POLISHING: usize = 2_000_000;

/// Whether the robot is searched limb by limb: if it has branches or is a long chain.
pub(super) fn applies(mechanism: &Mechanism<'_>) -> bool {
    let bases = mechanism.links.iter().filter(|link| link.parent.is_none()).count();
    let branches = (0..mechanism.links.len()).any(|link| mechanism.children(link).count() > 1);
    bases > 1 || branches || mechanism.links.len() > LONGEST
}

/// Links that are searched together, with the adjacent links.
#[derive(Clone, Debug)]
struct Part {
    /// The links to search and the adjacent links, whose options are held fixed; parents before children.
    links: Vec<usize>,
    /// The indices in `links` of the links to search.
    searched: Vec<usize>,
}

/// The robot that is searched. It does not depend on a graph.
#[derive(Clone, Copy)]
pub(super) struct Limbs<'r> {
    pub(super) robot: &'r Robot,
    pub(super) options: &'r MechanismOptions,
    pub(super) measure: Measure,
}

impl Limbs<'_> {
    /// Searches limb by limb until the cost does not decrease any more, then searches for the best unit of length of
    /// the whole robot.
    pub(super) fn search(self, whole: &mut Search<'_, '_>, scope: Scope) -> Found {
        let (mut cost, mut plan) = whole.cheapest_start();
        let mut settled: BTreeMap<Vec<usize>, Vec<LinkPlan>> = BTreeMap::new();
        let mut last = usize::MAX;
        let mut cut_short = false;
        for round in 0..MAX_ROUNDS {
            // Windows are at two alternating positions: the search of a limb ends if no improvement is found at either
            // of them.
            let parts = parts(whole.mechanism, round % 2 == 1);
            let left = parts.len();
            for (done, part) in parts.into_iter().enumerate() {
                let held = part.plan(&plan);
                if settled.get(&part.links) == Some(&held.links) || whole.is_spent() {
                    continue;
                }
                let share = (whole.max_work - whole.work) / (left - done).max(2);
                if let Some((found, ended)) = self.search_part(whole, &part, held, (scope, share)) {
                    whole.take(&part, &found, &mut plan, &mut cost);
                    cut_short |= ended;
                }
                settled.insert(part.links.clone(), part.plan(&plan).links);
            }
            if round > 0 && cost == last {
                break;
            }
            last = cost;
        }
        cut_short |= whole.is_spent();
        whole.max_work = whole.work + POLISHING;
        if whole.can_sweep(scope, &plan, cost) {
            (cost, plan) = whole.descend(scope, plan, cost);
        }
        whole.max_work = usize::MAX;
        whole.descend_unit(&mut plan, &mut cost);
        Found { cut_short, ..whole.found(plan) }
    }

    /// The best plan of a part that is found with a limited amount of work, which also counts as work of the whole
    /// search, and whether the limit ended the search. `None` if the recursion does not apply to the part.
    fn search_part(
        self,
        whole: &mut Search<'_, '_>,
        part: &Part,
        held: Plan,
        (scope, work): (Scope, usize),
    ) -> Option<(Plan, bool)> {
        let graph = Graph::new();
        let mechanism = part.of(&Mechanism::new(self.robot, &graph, self.options));
        let base = Base::new(&mechanism)?;
        let effects = Effects { wrench: false, friction: false };
        let reference = newton_euler::newton_euler(&mechanism, effects).joint_torques;
        let torques: ObjectiveOf<'_, '_> =
            &|recursion: &Recursion<'_>| Objective::new(recursion.inverse_dynamics(false));
        let mut search = Search::new(self.robot, &mechanism, &base, torques, &reference);
        search.measure = self.measure;
        search.searched.clone_from(&part.searched);
        search.max_work = work;
        search.max_tries = MAX_TRIES;
        search.with_unit = false;
        search.known = Some(HashSet::new());
        let (_, plan) = search.best_descent(scope, Some(held));
        whole.tried += search.tried;
        whole.work += search.work;
        Some((plan, search.is_spent()))
    }
}

impl Search<'_, '_> {
    /// Takes over the plan of a part if this reduces the cost of the whole robot; otherwise, takes over the options of
    /// single links that reduce it.
    fn take(&mut self, part: &Part, found: &Plan, plan: &mut Plan, cost: &mut usize) {
        let mut candidate = plan.clone();
        for &place in &part.searched {
            candidate.links[part.links[place]].clone_from(&found.links[place]);
        }
        if candidate == *plan {
            return;
        }
        if let Some(lower) = self.better(&candidate, *cost) {
            (*plan, *cost) = (candidate, lower);
            return;
        }
        for &place in part.searched.iter().rev() {
            let options = found.links[place].clone();
            let change = move |link: &mut LinkPlan| link.clone_from(&options);
            self.try_link(plan, cost, part.links[place], &change);
        }
    }
}

/// The limbs, or the windows of long limbs, from the tips to the base.
fn parts(mechanism: &Mechanism<'_>, shifted: bool) -> Vec<Part> {
    let mut parts = vec![];
    for limb in limbs(mechanism).into_iter().rev() {
        let first = if shifted { WINDOW / 2 } else { WINDOW };
        let (inner, outer) = match limb.len() > LONGEST {
            true => limb.split_at(first.min(limb.len())),
            false => (&limb[..], &limb[..0]),
        };
        let windows: Vec<&[usize]> = [inner].into_iter().chain(outer.chunks(WINDOW)).collect();
        parts.extend(windows.into_iter().rev().map(|window| Part::around(mechanism, window)));
    }
    parts
}

/// The maximal chains between branchings, each from the base outward.
fn limbs(mechanism: &Mechanism<'_>) -> Vec<Vec<usize>> {
    let mut limbs: Vec<Vec<usize>> = vec![];
    let mut limb_of = vec![0; mechanism.links.len()];
    for (index, link) in mechanism.links.iter().enumerate() {
        let inner = link.parent.filter(|parent| mechanism.children(*parent).count() == 1);
        limb_of[index] = inner.map_or(limbs.len(), |parent| limb_of[parent]);
        match limbs.get_mut(limb_of[index]) {
            Some(limb) => limb.push(index),
            None => limbs.push(vec![index]),
        }
    }
    limbs
}

impl Part {
    /// A window with the adjacent links: a few links inward, and the links that its last link carries.
    fn around(mechanism: &Mechanism<'_>, window: &[usize]) -> Part {
        let mut links = window.to_vec();
        let parent = |link: &usize| mechanism.links[*link].parent;
        let inward = std::iter::successors(window.first().and_then(parent), parent);
        let inward: Vec<usize> = inward.collect();
        let near = if inward.len() > NEAR { INWARD } else { NEAR };
        links.extend(inward.into_iter().take(near));
        links.extend(window.last().into_iter().flat_map(|last| mechanism.children(*last)));
        links.sort_unstable();
        let searched = (0..links.len()).filter(|place| window.contains(&links[*place])).collect();
        Part { links, searched }
    }

    /// The options of the part's links.
    fn plan(&self, whole: &Plan) -> Plan {
        let links = self.links.iter().map(|link| whole.links[*link].clone()).collect();
        Plan { links, unit_length: None }
    }

    /// A mechanism of these links alone, on a base that moves if the parent of a first link moves.
    fn of<'g>(&self, whole: &Mechanism<'g>) -> Mechanism<'g> {
        let place = |link: usize| self.links.iter().position(|other| *other == link);
        let link = |index: &usize| {
            let link = whole.links[*index].clone();
            let parent = link.parent.and_then(place);
            let rotor_coupling = match parent {
                Some(_) => link.rotor_coupling,
                None => whole.graph.zero(),
            };
            MechanismLink { parent, rotor_coupling, ..link }
        };
        let links = self.links.iter().map(link).collect();
        let innermost = self.links.first().and_then(|first| whole.links[*first].parent);
        let base = innermost.map(|_| BaseMotion::any(whole.graph));
        Mechanism { links, frames: vec![], base, ..whole.clone() }
    }
}
