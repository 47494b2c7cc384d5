//! Pair reuse: two terms or factors that occur together in several sums or products are combined only
//! once.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::nary::{Id, Nary, Node, Term};
use crate::program::Program;

/// The most terms of a sum or factors of a product; longer ones have too many pairs and are not changed.
const LONGEST: usize = 64;

/// Joins pairs, the most frequent pair first.
///
/// Pairs of terms that differ by a common sign are equal. Terms that depend only on parameters are always joined,
/// because their sum costs nothing at a call. This pass reassociates.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
    let mut view = Nary::new(program);
    for kind in [Kind::Product, Kind::Sum] {
        Rows::new(&mut view, kind).reduce(&mut view);
    }
    view.program()
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sum,
    Product,
}

impl Kind {
    fn node(self, terms: Vec<Term>) -> Node {
        match self {
            Kind::Sum => Node::Sum(terms),
            Kind::Product => Node::Product(terms.into_iter().map(|term| term.node).collect()),
        }
    }
}

/// Two nodes, the smaller first, and whether their signs differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Pair(Id, Id, bool);

impl Pair {
    fn new(a: Term, b: Term) -> Pair {
        Pair(a.node.min(b.node), a.node.max(b.node), a.negative != b.negative)
    }

    /// The pair as terms, the first positive.
    fn terms(self) -> [Term; 2] {
        [Term::positive(self.0), Term { node: self.1, negative: self.2 }]
    }
}

/// The sums or products of a view.
struct Rows {
    kind: Kind,
    rows: Vec<(Id, Vec<Term>)>,
    counts: FxHashMap<Pair, u32>,
    /// The rows that contained a pair when it was counted. Some of them may no longer contain it.
    places: FxHashMap<Pair, Vec<usize>>,
    heap: BinaryHeap<(u32, Reverse<Pair>)>,
}

impl Rows {
    fn new(view: &mut Nary, kind: Kind) -> Rows {
        let uses = view.uses();
        let mut rows = Rows {
            kind,
            rows: vec![],
            counts: FxHashMap::default(),
            places: FxHashMap::default(),
            heap: BinaryHeap::new(),
        };
        let mut early: FxHashMap<Vec<Term>, Id> = FxHashMap::default();
        for id in 0..uses.len() as Id {
            if uses[id as usize] == 0 || view.is_early(id) {
                continue;
            }
            let terms = match (view.node(id), kind) {
                (Node::Sum(terms), Kind::Sum) => terms.clone(),
                (Node::Product(factors), Kind::Product) => {
                    factors.iter().copied().map(Term::positive).collect()
                }
                _ => continue,
            };
            let terms = join_early(view, kind, terms, &mut early);
            if terms.len() <= LONGEST {
                rows.add(id, terms);
            } else {
                view.replace(id, kind.node(terms));
            }
        }
        rows
    }

    fn add(&mut self, id: Id, terms: Vec<Term>) {
        let row = self.rows.len();
        for (place, a) in terms.iter().enumerate() {
            for b in &terms[place + 1..] {
                self.count(Pair::new(*a, *b), row);
            }
        }
        self.rows.push((id, terms));
    }

    fn count(&mut self, pair: Pair, row: usize) {
        let count = self.counts.entry(pair).or_default();
        *count += 1;
        let count = *count;
        self.places.entry(pair).or_default().push(row);
        if count > 1 {
            self.heap.push((count, Reverse(pair)));
        }
    }

    fn reduce(mut self, view: &mut Nary) {
        while let Some((count, Reverse(pair))) = self.heap.pop() {
            let now = self.counts.get(&pair).copied().unwrap_or(0);
            if now == count {
                self.join(pair, view);
            } else if now > 1 {
                // Its count was higher before some of its rows changed.
                self.heap.push((now, Reverse(pair)));
            }
        }
        for (id, terms) in self.rows {
            view.replace(id, self.kind.node(terms));
        }
    }

    /// Replaces a pair with one node wherever it occurs.
    fn join(&mut self, pair: Pair, view: &mut Nary) {
        let mut rows = self.places.remove(&pair).unwrap_or_default();
        rows.sort_unstable();
        rows.dedup();
        let places: usize = rows.iter().map(|row| self.occurrences(*row, pair)).sum();
        self.counts.remove(&pair);
        // Squares may overlap: x³ has three pairs (x, x) but room for one.
        if places < 2 {
            return;
        }
        let joined = view.push(self.kind.node(pair.terms().to_vec()));
        for row in rows {
            for _ in 0..self.occurrences(row, pair) {
                self.join_in(row, pair, joined);
            }
        }
    }

    /// The number of times that a pair occurs in a row, without overlap.
    fn occurrences(&self, row: usize, pair: Pair) -> usize {
        let terms = &self.rows[row].1;
        let count = |node: Id| terms.iter().filter(|term| term.node == node).count();
        if pair.0 == pair.1 {
            return count(pair.0) / 2;
        }
        if self.kind == Kind::Product {
            return count(pair.0).min(count(pair.1));
        }
        let term = |node: Id| terms.iter().find(|term| term.node == node);
        let both = term(pair.0).zip(term(pair.1));
        usize::from(both.is_some_and(|(a, b)| Pair::new(*a, *b) == pair))
    }

    fn join_in(&mut self, row: usize, pair: Pair, joined: Id) {
        let mut terms = std::mem::take(&mut self.rows[row].1);
        let take = |terms: &mut Vec<Term>, node: Id| {
            let place = terms.iter().position(|term| term.node == node)?;
            Some(terms.remove(place))
        };
        let (first, second) = (take(&mut terms, pair.0), take(&mut terms, pair.1));
        for gone in first.into_iter().chain(second) {
            for other in &terms {
                if let Some(count) = self.counts.get_mut(&Pair::new(gone, *other)) {
                    *count = count.saturating_sub(1);
                }
            }
        }
        let negative = first.is_some_and(|first| first.negative);
        let new = Term { node: joined, negative };
        for other in &terms {
            self.count(Pair::new(new, *other), row);
        }
        terms.push(new);
        self.rows[row].1 = terms;
    }
}

/// Joins the terms that are known before the call into one node; equal terms give the same node.
fn join_early(
    view: &mut Nary,
    kind: Kind,
    terms: Vec<Term>,
    known: &mut FxHashMap<Vec<Term>, Id>,
) -> Vec<Term> {
    let (mut early, mut late): (Vec<Term>, Vec<Term>) =
        terms.into_iter().partition(|term| view.is_early(term.node));
    if early.len() < 2 || late.is_empty() {
        early.extend(late);
        return early;
    }
    early.sort_unstable();
    let negative = early[0].negative;
    let flip = |term: &Term| Term { negative: term.negative != negative, ..*term };
    let key: Vec<Term> = early.iter().map(flip).collect();
    let node = match known.get(&key) {
        Some(node) => *node,
        None => {
            let node = view.push(kind.node(key.clone()));
            known.insert(key, node);
            node
        }
    };
    late.insert(0, Term { node, negative });
    late
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Counts;
    use crate::interpreter::evaluate;
    use crate::passes::testing::{assert_same_values, operations_left};
    use crate::program::{Builder, Source, Value};
    use crate::trigonometry::Trigonometry;

    #[test]
    fn values_stay() {
        assert_same_values("pair reuse", run);
    }

    fn inputs(builder: &mut Builder) -> [Value; 5] {
        [0, 1, 2, 3, 4].map(|index| builder.load(Source::Input(index)))
    }

    #[test]
    fn common_pairs_of_sums_are_added_once() {
        let mut b = Builder::new();
        let [u, v, x, y, z] = inputs(&mut b);
        // u + v + x, y − u − v, and v + z + u
        let (ux, uy) = (b.add(u, x), b.sub(y, u));
        let vz = b.add(v, z);
        let results = vec![b.add(ux, v), b.sub(uy, v), b.add(vz, u)];
        assert_eq!(Counts::of(&run(&b.finish(results))).add, 4);
    }

    #[test]
    fn a_pair_of_two_sums_is_added_once() {
        let mut b = Builder::new();
        let [x, y, u, v, _] = inputs(&mut b);
        // u + x + v, y + u + v
        let (ux, yu) = (b.add(u, x), b.add(y, u));
        let results = vec![b.add(ux, v), b.add(yu, v)];
        assert_eq!(Counts::of(&run(&b.finish(results))).add, 3);
    }

    /// p + x + r: the sum of the parameters comes from the constructor.
    #[test]
    fn what_is_known_early_is_joined_early() {
        let mut b = Builder::new();
        let [x, ..] = inputs(&mut b);
        let [p, r] = [0, 1].map(|index| b.load(Source::Parameter(index)));
        let sum = b.add(p, x);
        let sum = b.add(sum, r);
        assert_eq!(Counts::of_calls(&run(&b.finish(vec![sum]))).add, 1);
    }

    #[test]
    fn squares_in_high_powers_are_shared() {
        let mut b = Builder::new();
        let [x, y, z, ..] = inputs(&mut b);
        let cube = [x, x].into_iter().fold(x, |power, x| b.mul(power, x));
        let other = [z, x, x].into_iter().fold(y, |product, x| b.mul(product, x));
        // x² once, then x² x, and (x² y) z
        assert_eq!(Counts::of(&run(&b.finish(vec![cube, other]))).mul, 4);
    }

    /// The operations that remain of the program that `build` makes; checks that its values stay.
    fn left(build: impl Fn(&mut Builder, [Value; 5]) -> Vec<Value>) -> (usize, usize) {
        let mut b = Builder::new();
        let loads = inputs(&mut b);
        let results = build(&mut b, loads);
        let program = b.finish(results);
        let found = run(&program);
        let load = |source| match source {
            Source::Input(index) => [3.0, 5.0, 7.0, 0.25, 11.0][index as usize],
            Source::Parameter(index) => [2.0, 13.0, 0.5][index as usize],
            other => panic!("{other:?}"),
        };
        let values = |program| evaluate(program, Trigonometry::Standard, load);
        assert_eq!(values(&found), values(&program), "{program:?}");
        let counts = Counts::of_calls(&found);
        (counts.add, counts.mul)
    }

    fn joined(
        b: &mut Builder,
        values: &[Value],
        make: fn(&mut Builder, Value, Value) -> Value,
    ) -> Value {
        values[1..].iter().fold(values[0], |all, value| make(b, all, *value))
    }

    #[test]
    fn pairs_of_sums_match_up_to_a_common_sign_alone() {
        let same = left(|b, [u, v, x, y, _]| {
            let (first, second) = (b.sub(x, u), b.sub(y, v));
            vec![b.add(first, v), b.add(second, u)]
        });
        let other = left(|b, [u, v, x, y, _]| {
            let (first, second) = (b.sub(x, u), b.add(y, v));
            vec![b.add(first, v), b.add(second, u)]
        });
        assert_eq!((same.0, other.0), (3, 4));
    }

    #[test]
    fn pairs_of_products_are_multiplied_once() {
        // u v x, u v y, u v z; and u² v², which is (u v)²
        let three = left(|b, [u, v, x, y, z]| {
            [x, y, z].map(|w| joined(b, &[u, w, v], Builder::mul)).to_vec()
        });
        let square = left(|b, [u, v, ..]| vec![joined(b, &[u, u, v, v], Builder::mul)]);
        let fourth = left(|b, [u, ..]| vec![joined(b, &[u, u, u, u], Builder::mul)]);
        let cube = left(|b, [u, ..]| vec![joined(b, &[u, u, u], Builder::mul)]);
        // u⁴ v², if u v is computed too: ((u v) u)²
        let fifth = left(|b, [u, v, ..]| {
            vec![joined(b, &[u, u, v, u, v, u], Builder::mul), joined(b, &[u, v], Builder::mul)]
        });
        assert_eq!([three, square, fourth, cube, fifth].map(|counts| counts.1), [4, 2, 2, 2, 3]);
    }

    /// The most frequent pairs are joined first.
    #[test]
    fn the_most_frequent_pair_is_joined_first() {
        let sums = left(|b, [u, v, x, y, z]| {
            let rows = [vec![u, v, x], vec![u, v, y], vec![u, v, z], vec![v, x, y], vec![z, v, x]];
            rows.map(|row| joined(b, &row, Builder::add)).to_vec()
        });
        assert_eq!(sums.0, 7);
    }

    /// A pair is queued once for each occurrence after the first.
    #[test]
    fn pairs_that_occur_once_are_not_queued() {
        let queued = |rows: &[&[Id]]| {
            let mut found = Rows::new(&mut Nary::new(&Builder::new().finish(vec![])), Kind::Sum);
            for row in rows {
                found.add(0, row.iter().copied().map(Term::positive).collect());
            }
            found.heap.len()
        };
        assert_eq!(queued(&[&[0, 1, 2], &[3, 4, 5]]), 0);
        assert_eq!(queued(&[&[0, 1, 2], &[1, 3, 0]]), 1);
        assert_eq!(queued(&[&[0, 1], &[0, 1], &[0, 1, 2]]), 2);
    }

    /// Terms known early are joined in the constructor; the same terms with opposite signs share a node.
    #[test]
    fn early_terms_of_many_sums_are_one() {
        let mut b = Builder::new();
        let [x, y, z, ..] = inputs(&mut b);
        let [p, r, s] = [0, 1, 2].map(|index| b.load(Source::Parameter(index)));
        let less = b.sub(p, r);
        let (first, second, third) = (b.add(x, p), b.sub(y, p), b.sub(z, r));
        let single = b.add(x, s);
        let results = vec![b.sub(first, r), b.add(second, r), b.add(third, p), single, less];
        let program = run(&b.finish(results));
        assert_eq!((Counts::of_calls(&program).add, Counts::of(&program).add), (4, 5));
        let products = left(|b, [x, y, ..]| {
            let [p, r, s] = [0, 1, 2].map(|index| b.load(Source::Parameter(index)));
            vec![joined(b, &[x, p, r], Builder::mul), joined(b, &[r, y, s, p], Builder::mul)]
        });
        assert_eq!(products.1, 2);
    }

    /// Sums of 64 terms are changed, sums of 65 are not.
    #[test]
    fn the_longest_sums_are_left_alone() {
        let added = |terms: u32| {
            let mut b = Builder::new();
            let loads: Vec<Value> = (0..terms).map(|index| b.load(Source::Input(index))).collect();
            let backward: Vec<Value> = loads.iter().copied().rev().collect();
            let (first, second) =
                (joined(&mut b, &loads, Builder::add), joined(&mut b, &backward, Builder::add));
            let results = vec![first, second];
            Counts::of(&run(&b.finish(results))).add
        };
        let longest = LONGEST as u32;
        assert_eq!((added(longest), added(longest + 1)), (63, 128));
    }

    #[test]
    fn no_program_costs_more_and_many_less() {
        let (before, after) = operations_left(run);
        assert!(before == 6338 && after <= 5294, "{before} became {after}");
    }
}
