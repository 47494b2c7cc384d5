//! Angles between the links of parallel joints.
//!
//! The links of n parallel joints and the body before them are n + 1 bodies that rotate about the same direction.
//! Formulas are written in the angles between any two of them: c₁₂ = cos(q₁ + q₂). A set of angles that determines all
//! others is a spanning tree of the complete graph on the bodies.

use crate::expr::Expr;
use crate::graph::Graph;

use super::terms::{Term, Terms, Variable};
use super::variables::Variables;

/// The largest number of trees that are tried for one group.
const MAX_TREES: usize = 128;

/// A joint in a group of parallel joints.
#[derive(Clone, Debug)]
pub struct Turn<'g> {
    /// The symbol of the joint's angle.
    pub coordinate: Expr<'g>,
    /// Whether the joint turns against the direction of the group.
    pub negative: bool,
    /// The index of the preceding joint in the group; `None` for a joint that follows the body before the group.
    pub parent: Option<usize>,
}

/// Revolute joints with parallel axes, whose angles add up.
#[derive(Clone, Debug)]
pub struct ParallelAngles<'g> {
    /// The joints; each one comes after its parent.
    pub turns: Vec<Turn<'g>>,
}

impl<'g> ParallelAngles<'g> {
    /// Returns the whole group if the coordinates of at least two of its joints occur, otherwise `None`.
    pub(super) fn restricted(&self, occurs: impl Fn(&Expr<'g>) -> bool) -> Option<Self> {
        let used = self.turns.iter().filter(|turn| occurs(&turn.coordinate)).count();
        (used >= 2).then(|| self.clone())
    }

    /// For each body, the sign of every coordinate in the angle from the body before the group, or 0.
    fn positions(&self) -> Vec<Vec<i8>> {
        let mut positions: Vec<Vec<i8>> = vec![vec![0; self.turns.len()]];
        for (place, turn) in self.turns.iter().enumerate() {
            let parent = turn.parent.map_or(0, |parent| parent + 1);
            let mut position = positions.get(parent).cloned().unwrap_or_default();
            position.resize(self.turns.len(), 0);
            position[place] = if turn.negative { -1 } else { 1 };
            positions.push(position);
        }
        positions
    }

    /// The angles between any two bodies, with the first coordinate of each positive.
    pub(super) fn differences(&self, graph: &'g Graph) -> Vec<Expr<'g>> {
        let positions = self.positions();
        pairs(positions.len())
            .map(|(a, b)| self.angle(&difference(&positions[a], &positions[b]).1, graph))
            .collect()
    }

    fn angle(&self, signs: &[i8], graph: &'g Graph) -> Expr<'g> {
        signs.iter().zip(&self.turns).fold(graph.zero(), |sum, (sign, turn)| match sign {
            0 => sum,
            1 => sum + turn.coordinate,
            _ => sum - turn.coordinate,
        })
    }
}

fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b)))
}

/// The angle between two bodies, given by the sign of every coordinate and negated if the first one is negative, and
/// whether it was negated.
fn difference(a: &[i8], b: &[i8]) -> (bool, Vec<i8>) {
    let signs: Vec<i8> = a.iter().zip(b).map(|(a, b)| b - a).collect();
    let negative = signs.iter().find(|sign| **sign != 0).is_some_and(|sign| *sign < 0);
    let signs = signs.into_iter().map(|sign| if negative { -sign } else { sign }).collect();
    (negative, signs)
}

/// An angle between two bodies, given by the variables of its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Angle {
    pub(super) sine: Variable,
    pub(super) cosine: Variable,
}

/// An angle between two bodies with the sign of every coordinate in it, or 0.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    pub(super) angle: Angle,
    pub(super) signs: Vec<i8>,
}

/// A set of angles that determines all angles of a group. Each coordinate is a sum of these angles, given by the
/// indices of their edges and whether they are subtracted.
pub(super) type Basis = Vec<Vec<(usize, bool)>>;

/// A group of parallel joints; its angles are given by the variables of their sines and cosines.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The angles between any two bodies.
    pub(super) edges: Vec<Edge>,
    /// The angles of the joints.
    pub(super) coordinates: Vec<Angle>,
    /// The bases; the first one is that of the coordinates themselves.
    pub(super) bases: Vec<Basis>,
}

impl Group {
    pub(super) fn new<'g>(
        angles: &ParallelAngles<'g>,
        graph: &'g Graph,
        variables: &Variables<'g>,
    ) -> Option<Group> {
        let positions = angles.positions();
        let known = |angle: Expr<'g>| {
            Some(Angle { sine: variables.find(angle.sin())?, cosine: variables.find(angle.cos())? })
        };
        let mut edges = vec![];
        for (a, b) in pairs(positions.len()) {
            let (_, signs) = difference(&positions[a], &positions[b]);
            edges.push(Edge { angle: known(angles.angle(&signs, graph))?, signs });
        }
        let coordinates: Option<Vec<Angle>> =
            angles.turns.iter().map(|turn| known(turn.coordinate)).collect();
        let bases = bases(angles, &positions);
        Some(Group { edges, coordinates: coordinates?, bases })
    }

    /// Returns the angle with these signs of coordinates if it is between two bodies, and whether it must be negated.
    pub(super) fn angle_of(&self, signs: &[i8]) -> Option<(Angle, bool)> {
        let is = |edge: &Edge, negative: bool| {
            let mut pairs = edge.signs.iter().zip(signs);
            pairs.all(|(a, b)| *a == if negative { -b } else { *b })
        };
        let found = self.edges.iter().find(|edge| is(edge, false)).map(|edge| (edge.angle, false));
        found.or_else(|| {
            self.edges.iter().find(|edge| is(edge, true)).map(|edge| (edge.angle, true))
        })
    }

    /// Whether a variable is the sine or cosine of one of the group's angles.
    pub(super) fn has(&self, variable: Variable) -> bool {
        self.edge_of(variable).is_some()
    }

    /// The angle whose sine or cosine a variable is; `None` for other variables.
    pub(super) fn edge_of(&self, variable: Variable) -> Option<&Edge> {
        let of = |edge: &&Edge| edge.angle.sine == variable || edge.angle.cosine == variable;
        self.edges.iter().find(of)
    }

    /// Groups the terms by their factors outside the group of joints; the rest of the terms is the coefficient of
    /// these.
    pub(super) fn by_cofactor(&self, terms: &Terms) -> Vec<(super::terms::Powers, Vec<Term>)> {
        use super::terms::Powers;
        let mut found: indexmap::IndexMap<Powers, Vec<Term>, rustc_hash::FxBuildHasher> =
            indexmap::IndexMap::default();
        for (powers, number) in terms.as_slice() {
            let (inside, outside): (Vec<_>, Vec<_>) =
                powers.iter().partition(|(variable, _)| self.has(*variable));
            let part = |powers: Vec<(Variable, u16)>| Powers::from_unsorted(powers.into_iter());
            found.entry(part(outside)).or_default().push((part(inside), number.clone()));
        }
        found.into_iter().collect()
    }
}

/// The bases of the spanning trees of the bodies: first the tree of the joints, then all trees or, if there are too
/// many, only the stars.
fn bases(angles: &ParallelAngles<'_>, positions: &[Vec<i8>]) -> Vec<Basis> {
    let bodies = positions.len();
    let parents: Vec<(usize, usize)> = angles
        .turns
        .iter()
        .enumerate()
        .map(|(place, turn)| (turn.parent.map_or(0, |parent| parent + 1), place + 1))
        .collect();
    let mut trees = vec![parents.clone()];
    let all = spanning_trees(bodies);
    match all.len() <= MAX_TREES {
        true => trees.extend(all),
        false => trees.extend((0..bodies).map(|center| {
            let others = (0..bodies).filter(|body| *body != center);
            others.map(|body| (center.min(body), center.max(body))).collect()
        })),
    }
    let basis = |tree: &Vec<(usize, usize)>| -> Basis {
        parents.iter().map(|(from, to)| along(tree, *from, *to, positions)).collect()
    };
    let mut bases: Vec<Basis> = trees.iter().map(basis).collect();
    // The coordinate of a joint that turns against the direction of the group is a sum with the opposite signs.
    for basis in &mut bases {
        for (sum, turn) in basis.iter_mut().zip(&angles.turns) {
            sum.iter_mut().for_each(|(_, negative)| *negative ^= turn.negative);
        }
    }
    bases
}

/// All spanning trees of the complete graph, from their Prüfer sequences. If there are more than [`MAX_TREES`], the
/// result is a longer list of empty trees.
fn spanning_trees(bodies: usize) -> Vec<Vec<(usize, usize)>> {
    let Some(length) = bodies.checked_sub(2) else { return vec![] };
    let power = u32::try_from(length).ok().and_then(|length| bodies.checked_pow(length));
    let Some(count) = power.filter(|count| *count <= MAX_TREES) else {
        return vec![vec![]; MAX_TREES + 1];
    };
    let sequence = |number: usize| -> Vec<usize> {
        (0..length)
            .scan(number, |left, _| {
                let digit = *left % bodies;
                *left /= bodies;
                Some(digit)
            })
            .collect()
    };
    (0..count).map(|number| tree_of(&sequence(number), bodies)).collect()
}

/// The tree of a Prüfer sequence.
fn tree_of(sequence: &[usize], bodies: usize) -> Vec<(usize, usize)> {
    let mut degrees = vec![1_usize; bodies];
    for body in sequence {
        degrees[*body] += 1;
    }
    let mut tree = vec![];
    for body in sequence {
        if let Some(leaf) = degrees.iter().position(|degree| *degree == 1) {
            tree.push((leaf.min(*body), leaf.max(*body)));
            degrees[leaf] = 0;
            degrees[*body] -= 1;
        }
    }
    let mut last = (0..bodies).filter(|body| degrees[*body] == 1);
    if let (Some(a), Some(b)) = (last.next(), last.next()) {
        tree.push((a, b));
    }
    tree
}

/// The path from one body to another along a tree, as edges and whether each is traversed backward.
fn along(
    tree: &[(usize, usize)],
    from: usize,
    to: usize,
    positions: &[Vec<i8>],
) -> Vec<(usize, bool)> {
    let mut before: Vec<Option<usize>> = vec![None; positions.len()];
    let mut pending = vec![from];
    while let Some(body) = pending.pop() {
        for (a, b) in tree {
            let next = match body {
                _ if body == *a => *b,
                _ if body == *b => *a,
                _ => continue,
            };
            if next != from && before[next].is_none() {
                before[next] = Some(body);
                pending.push(next);
            }
        }
    }
    let mut way = vec![];
    let mut body = to;
    while let Some(previous) = before.get(body).copied().flatten() {
        let (low, high) = (previous.min(body), previous.max(body));
        let edge = pairs(positions.len()).position(|pair| pair == (low, high)).unwrap_or_default();
        // Edges point from the lower body to the higher one, except for those whose sign was changed.
        let turned = difference(&positions[low], &positions[high]).0;
        way.push((edge, turned != (previous > body)));
        body = previous;
    }
    way
}
