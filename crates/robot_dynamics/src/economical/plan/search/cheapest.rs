//! The cheapest plans that a search encountered, for callers that compare them by more than an operation count.

use robot_model::robot::Robot;
use robot_symbolic::Operations;

use super::{Found, Measure, search_with};
use crate::economical::plan::Plan;
use crate::mechanism::MechanismOptions;

/// The number of plans with the same count of operations of each kind that are kept; most such plans give the same
/// program.
const ALIKE: usize = 2;

/// A limited number of the cheapest plans, without repetitions.
#[derive(Debug)]
pub(super) struct Cheapest {
    most: usize,
    /// The plans in the order of their cost; plans of equal cost are in the order in which they were encountered.
    plans: Vec<(usize, Operations, Plan)>,
}

impl Cheapest {
    pub(super) fn new(most: usize) -> Cheapest {
        Cheapest { most, plans: vec![] }
    }

    pub(super) fn offer(&mut self, cost: usize, count: &Operations, plan: &Plan) {
        let end = self.plans.partition_point(|(other, ..)| *other <= cost);
        if end >= self.most {
            return;
        }
        let before = &self.plans[..end];
        let is_known = before.iter().any(|(.., other)| other == plan);
        let alike = before.iter().filter(|(_, other, _)| other == count).count();
        if !is_known && alike < ALIKE {
            self.plans.insert(end, (cost, *count, plan.clone()));
            self.plans.truncate(self.most);
        }
    }

    pub(super) fn into_plans(self) -> impl Iterator<Item = Plan> {
        self.plans.into_iter().map(|(.., plan)| plan)
    }
}

/// Searches like [`search`](super::search()) and returns at most `most` of the cheapest plans that were encountered,
/// the best first. All of them give the right torques. The result is the same in every run.
#[must_use]
pub fn search_several(
    robot: &Robot,
    options: &MechanismOptions,
    measure: Measure,
    most: usize,
) -> Option<Vec<Found>> {
    search_with(robot, options, measure, most, |search, found| {
        let kept = std::mem::replace(&mut search.cheapest, Cheapest::new(0));
        let mut several = vec![found];
        for plan in kept.into_plans() {
            let is_new = several.iter().all(|found| found.plan != plan);
            if is_new && search.is_accurate(&search.candidate(&plan).checked) {
                let Found { tried, cut_short, .. } = several[0];
                several.push(Found { tried, cut_short, ..search.found(plan) });
            }
        }
        several.truncate(most.max(1));
        several
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::economical::plan::LinkPlan;

    #[test]
    fn the_cheapest_stay_in_order() {
        let plan = |links: usize| Plan::uniform(links, &LinkPlan::BASIC);
        let mut cheapest = Cheapest::new(3);
        for (cost, links) in [(5, 1), (3, 2), (5, 3), (3, 2), (4, 4), (9, 5), (3, 6), (3, 7)] {
            let count = Operations { additions: cost, ..Operations::default() };
            cheapest.offer(cost, &count, &plan(links));
        }
        // Only two plans with the same operations of each kind are kept.
        let kept: Vec<Plan> = cheapest.into_plans().collect();
        assert_eq!(kept, [plan(2), plan(6), plan(4)]);
    }
}
