//! The choice of a place for each label of the scheme, so that they do not hide each other.

use super::labels::{Candidate, conflict};

/// The most passes in which labels move to better places.
const PASSES: usize = 4;
/// The cost from which labels push others away, as those with leaders do.
const CROWDED: f64 = 100.0;
/// The most labels that make way for one, and the number of places that are tried for it.
const MOST: usize = 2;
const TRIED: usize = 48;

/// Chooses one of the places of each label. Each first takes the best place beside the labels before it; then labels
/// move while this makes them better, and crowded labels push others away where all together become better.
pub(super) fn settled(labels: Vec<Vec<Candidate>>) -> Vec<Candidate> {
    let labels: Vec<Vec<Candidate>> =
        labels.into_iter().filter(|places| !places.is_empty()).collect();
    let neighbors = neighbors(&labels);
    let mut settling = Settling { chosen: vec![None; labels.len()], labels, neighbors };
    for _ in 0..PASSES {
        settling.improve();
        if !settling.push() {
            break;
        }
    }
    settling.chosen.into_iter().flatten().collect()
}

/// For each label, the others that one of its places can disturb, in order.
fn neighbors(labels: &[Vec<Candidate>]) -> Vec<Vec<usize>> {
    let reaches: Vec<_> = labels.iter().map(|places| Candidate::reach(places)).collect();
    let meet = |one: usize, other: usize| {
        let pair = reaches[one].zip(reaches[other]);
        one != other && pair.is_some_and(|(one, other)| one.meets(&other))
    };
    let of = |index| (0..labels.len()).filter(|other| meet(index, *other)).collect();
    (0..labels.len()).map(of).collect()
}

/// Labels that take places.
struct Settling {
    /// The places of each label, with the cost of each place itself.
    labels: Vec<Vec<Candidate>>,
    /// The places that are taken.
    chosen: Vec<Option<Candidate>>,
    /// For each label, the others that it can disturb.
    neighbors: Vec<Vec<usize>>,
}

impl Settling {
    /// Lets labels move to better places, one at a time.
    fn improve(&mut self) {
        for _ in 0..PASSES {
            let mut has_moved = false;
            for index in 0..self.labels.len() {
                let best = self.best(&self.chosen, index);
                let now = self.chosen[index].map(|place| self.cost(&self.chosen, index, &place));
                if now.is_none_or(|now| best.is_some_and(|(cost, _)| cost < now)) {
                    self.chosen[index] = best.map(|(_, place)| place);
                    has_moved = true;
                }
            }
            if !has_moved {
                break;
            }
        }
    }

    /// Lets labels with leaders, and crowded ones, take the places of others, which move; returns whether this made anything better.
    fn push(&mut self) -> bool {
        let mut has_moved = false;
        for index in 0..self.labels.len() {
            let Some(taken) = self.chosen[index] else { continue };
            let now = self.cost(&self.chosen, index, &taken);
            if taken.leader.is_none() && now < CROWDED {
                continue;
            }
            let mut places = self.labels[index].clone();
            places.retain(|place| place.cost < now);
            places.sort_by(|one, other| one.cost.total_cmp(&other.cost));
            let mut best = (1e-6, None);
            for place in places.iter().take(TRIED) {
                if let Some((gain, trial)) = self.pushed(index, place)
                    && gain > best.0
                {
                    best = (gain, Some(trial));
                }
            }
            if let (_, Some(trial)) = best {
                self.chosen = trial;
                has_moved = true;
            }
        }
        has_moved
    }

    /// The places after a label has taken one and others have made way, and how much better they are; `None` if too many
    /// would have to.
    fn pushed(&self, index: usize, place: &Candidate) -> Option<(f64, Vec<Option<Candidate>>)> {
        let is_hit = |other: &usize| {
            let taken = self.chosen[*other];
            taken.is_some_and(|taken| conflict(&taken, place) > 0.0)
        };
        let mut moved: Vec<usize> = self.neighbors[index].iter().copied().filter(is_hit).collect();
        if moved.len() > MOST {
            return None;
        }
        let mut trial = self.chosen.clone();
        trial[index] = Some(*place);
        for other in &moved {
            trial[*other] = None;
        }
        for other in &moved {
            trial[*other] = self.best(&trial, *other).map(|(_, place)| place);
        }
        moved.push(index);
        Some((self.total(&self.chosen, &moved) - self.total(&trial, &moved), trial))
    }

    /// The best place of a label beside others, and its cost.
    fn best(&self, chosen: &[Option<Candidate>], index: usize) -> Option<(f64, Candidate)> {
        let mut best: Option<(f64, Candidate)> = None;
        for place in &self.labels[index] {
            // Conflicts only add to the cost.
            if best.is_none_or(|(least, _)| place.cost < least) {
                let cost = self.cost(chosen, index, place);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, *place));
                }
            }
        }
        best
    }

    /// The cost of a place for a label, beside the places of the others.
    fn cost(&self, chosen: &[Option<Candidate>], index: usize, place: &Candidate) -> f64 {
        let others = self.neighbors[index].iter().filter_map(|other| chosen[*other].as_ref());
        place.cost + others.map(|other| conflict(place, other)).sum::<f64>()
    }

    /// The cost of the places of some labels, beside each other and beside those of the others.
    fn total(&self, chosen: &[Option<Candidate>], some: &[usize]) -> f64 {
        let of = |(at, index): (usize, &usize)| {
            let Some(place) = chosen[*index] else { return 0.0 };
            // Two of the labels disturb each other once.
            let twice = some[..at].iter().filter_map(|other| chosen[*other]);
            let twice = twice.map(|other| conflict(&place, &other)).sum::<f64>();
            self.cost(chosen, *index, &place) - twice
        };
        some.iter().enumerate().map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::scheme::labels::Rectangle;

    /// A label that takes the only good place of another one moves away, though its next place costs more.
    #[test]
    fn labels_make_way() {
        let place = |x: f64, cost: f64, leads: bool| {
            let label = Rectangle::about(Vector2::new(x, 0.0), Vector2::new(40.0, 14.0));
            let leader = leads.then_some([Vector2::new(x, 60.0), Vector2::new(x, 7.0)]);
            Candidate { label, leader, cost }
        };
        let first = vec![place(0.0, 1.0, false), place(100.0, 5.0, false)];
        let second = vec![place(0.0, 2.0, false), place(200.0, 90.0, true)];
        let placed = settled(vec![first, second]);
        assert_eq!([placed[0].cost, placed[1].cost], [5.0, 2.0]);
    }
}
