//! A robot in numbers: its mass matrix in any configuration, and lower bounds on its pivots.
//!
//! These numbers determine which form of code is generated, but never enter the code.

use robot_model::robot::{JointKind, Robot};
use robot_symbolic::walk::Evaluator;
use robot_symbolic::{Expr, Graph, Random, SymbolId};

use super::{Derivation, mass_matrix};
use crate::mechanism::{Mechanism, MechanismLink, MechanismOptions};

/// The mass matrix of a robot at the nominal values of its parameters; parameters without a value are set to 1.
pub(super) struct SampledMassMatrix {
    values: Evaluator,
    order: usize,
    symbols: Vec<Symbol>,
    /// The assumed ranges of the coordinates, ± rad or m.
    ranges: Vec<f64>,
    links: Vec<SampledLink>,
}

/// The meaning of a symbol.
#[derive(Clone, Copy)]
enum Symbol {
    Coordinate(usize),
    Value(f64),
}

/// A link in numbers.
struct SampledLink {
    parent: Option<usize>,
    kind: JointKind,
    coordinate: usize,
    ratio: f64,
    mass: f64,
    /// The inertia of the link about the joint axis, or its mass for a prismatic joint.
    own: f64,
    /// The trace of the inertia tensor about the center of mass.
    trace: f64,
    /// The distance of the center of mass from the origin of the link's frame.
    arm: f64,
    /// The distance of the frame's origin from that of the parent's.
    offset: f64,
    /// The inertia of the drive reflected to the joint.
    reflected: f64,
}

/// A square matrix, row by row.
pub(super) type Rows = Vec<Vec<f64>>;

impl SampledMassMatrix {
    /// Derives the mass matrix in a separate graph, so that its expressions do not affect other derivations.
    pub(super) fn new(robot: &Robot) -> SampledMassMatrix {
        let graph = Graph::new();
        let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
        let matrix = mass_matrix::matrix(&derivation);
        let links = expressions(&derivation.mechanism);
        let order = matrix.order();
        let coordinates: Vec<Option<SymbolId>> =
            (0..order).map(|index| derivation.mechanism.coordinate(index).as_symbol()).collect();
        let nominal = |name: &str| match robot.nominal_value(name) {
            value if value.is_nan() => 1.0,
            value => value,
        };
        let symbol = |id: SymbolId| {
            let coordinate = coordinates.iter().position(|coordinate| *coordinate == Some(id));
            let value = || Symbol::Value(nominal(&graph.symbol_name(id)));
            coordinate.map_or_else(value, Symbol::Coordinate)
        };
        let symbols: Vec<Symbol> = graph.symbols().map(symbol).collect();
        let links = links.iter().zip(&derivation.mechanism.links);
        let links = links.map(|(expressions, link)| sampled(link, expressions, &symbols)).collect();
        let range = |kind: JointKind| match kind {
            JointKind::Revolute => std::f64::consts::PI,
            JointKind::Prismatic => 0.5,
        };
        SampledMassMatrix {
            values: Evaluator::new(&matrix.rows()),
            order,
            symbols,
            ranges: robot.coordinates.iter().map(|one| range(one.kind)).collect(),
            links,
        }
    }

    /// The number of coordinates.
    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// The mass matrix M in a configuration.
    pub(super) fn at(&self, q: &[f64]) -> Rows {
        let values = self.values.values(|symbol| value(symbol, &self.symbols, q));
        values.chunks(self.order.max(1)).map(<[f64]>::to_vec).collect()
    }

    /// A random configuration: angles within ±π, distances within ±0.5 m.
    pub(super) fn configuration(&self, random: &mut Random) -> Vec<f64> {
        self.ranges.iter().map(|range| random.uniform(-range, *range)).collect()
    }

    /// Whether the links' own inertias keep all pivots above a fraction of the diagonal of M.
    pub(super) fn keeps_pivots_above(&self, part: f64) -> bool {
        let (mut least, mut most) = (vec![0.0; self.order], vec![0.0; self.order]);
        for link in &self.links {
            let ratio = link.ratio * link.ratio;
            least[link.coordinate] += ratio * (link.own + link.reflected);
            most[link.coordinate] += ratio * link.reflected;
        }
        // The assumed travel of each prismatic joint: the sum of the distances between consecutive origins.
        let travel: f64 = self.links.iter().map(|link| link.offset).sum();
        for outer in &self.links {
            let mut arm = outer.arm;
            let mut next = Some(outer);
            while let Some(link) = next {
                let (moved, own_travel) = match link.kind {
                    JointKind::Revolute => (outer.trace + outer.mass * arm * arm, 0.0),
                    JointKind::Prismatic => (outer.mass, travel),
                };
                most[link.coordinate] += link.ratio * link.ratio * moved;
                arm += link.offset + own_travel;
                next = link.parent.map(|parent| &self.links[parent]);
            }
        }
        least.iter().zip(&most).all(|(least, most)| *least > 0.0 && *least >= part * most)
    }
}

fn value(symbol: SymbolId, symbols: &[Symbol], q: &[f64]) -> f64 {
    match symbols.get(symbol.index()) {
        Some(Symbol::Coordinate(index)) => q.get(*index).copied().unwrap_or_default(),
        Some(Symbol::Value(value)) => *value,
        None => f64::NAN,
    }
}

/// For each link: the ratio, the mass, the own inertia, the trace, the squares of arm and offset, and the drive's
/// inertia.
fn expressions<'g>(mechanism: &Mechanism<'g>) -> Vec<[Expr<'g>; 7]> {
    let carries_rotor = |index: usize| {
        mechanism.children(index).any(|child| !mechanism.links[child].rotor_coupling.is_zero())
    };
    let links = mechanism.links.iter().enumerate();
    links.map(|(index, link)| of_link(link, carries_rotor(index))).collect()
}

fn of_link<'g>(link: &MechanismLink<'g>, carries_rotor: bool) -> [Expr<'g>; 7] {
    let (center, axis) = (link.center_of_mass, link.axis);
    let own = match link.kind {
        JointKind::Prismatic => link.mass,
        JointKind::Revolute => {
            let lever = axis.cross(center);
            axis.dot(link.inertia * axis) + link.mass * lever.dot(lever)
        }
    };
    [
        link.ratio,
        link.mass,
        // A rotor may turn against the link that carries it, while that link's inertia in the file includes the rotor;
        // so there is no bound.
        if carries_rotor { own.graph().zero() } else { own },
        link.inertia.trace(),
        center.dot(center),
        link.translation.dot(link.translation),
        link.reflected_inertia,
    ]
}

fn sampled(
    link: &MechanismLink<'_>,
    expressions: &[Expr<'_>; 7],
    symbols: &[Symbol],
) -> SampledLink {
    let at = |expr: Expr<'_>| expr.evaluate(|symbol| value(symbol, symbols, &[]));
    let [ratio, mass, own, trace, arm, offset, reflected] = expressions.map(at);
    SampledLink {
        parent: link.parent,
        kind: link.kind,
        coordinate: link.coordinate,
        ratio,
        mass,
        own,
        trace,
        arm: arm.sqrt(),
        offset: offset.sqrt(),
        reflected,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_testing::read;

    /// A revolute joint, a prismatic one on it, and on that a joint that follows the first, with ratio −2.
    const ARM: &str = "format = 1
[robot]
name = \"arm\"
[[link]]
name = \"column\"
joint = { type = \"revolute\", axis = \"z\" }
origin = { xyz = [0, 0, 0.3] }
mass = 2
center_of_mass = [0.6, 0, 0.8]
inertia = { xx = 0.3, yy = 0.2, zz = 0.1 }
drive = { armature = 0.18 }
[[link]]
name = \"slide\"
joint = { type = \"prismatic\", axis = \"x\" }
origin = { xyz = [0, 0.4, 0] }
mass = 3
center_of_mass = [0, 0, 0.5]
inertia = { xx = 0.2, yy = 0.2, zz = 0.1 }
[[link]]
name = \"hand\"
joint = { type = \"revolute\", axis = \"y\", mimic = { joint = \"column\", ratio = -2 } }
origin = { xyz = [0, 0, 0.5] }
mass = 1
center_of_mass = [0.3, 0, 0]
inertia = { xx = 0.1, yy = 0.1, zz = 0.1 }
";

    /// The largest fraction of the diagonal that all pivots are known to exceed, in steps of 10⁻⁴.
    fn bound(text: &str) -> f64 {
        let matrix = SampledMassMatrix::new(&read("arm", text));
        let known =
            (1..10_000).take_while(|part| matrix.keeps_pivots_above(f64::from(*part) * 1e-4));
        f64::from(known.last().unwrap_or_default()) * 1e-4
    }

    /// The bound computed by hand: the inertia that a coordinate moves in every configuration, divided by the largest
    /// inertia that it can move.
    #[test]
    fn the_own_inertias_over_the_largest_are_a_bound() {
        // The own inertia and the drive of the column, and the own inertia of the hand times the square of its ratio.
        let least = (0.1 + 2.0 * 0.36) + 0.18 + 4.0 * (0.1 + 0.09);
        // The slide may be as far out as the sum of the distances between all frames.
        let travel = 0.3 + 0.4 + 0.5;
        let [column, hand] = [0.6 + 2.0, 4.0 * (0.3 + 0.09)];
        let slide = 0.5 + 3.0 * (0.5_f64 + 0.4 + travel).powi(2);
        let hand_at_column = 0.3 + (0.3_f64 + 0.5 + 0.4 + travel).powi(2);
        let most = 0.18 + column + hand + slide + hand_at_column;
        let found = bound(ARM);
        assert!((found - least / most).abs() < 1e-4, "{found} {}", least / most);
        // If the column has a heavy drive, the slide determines the bound: 3 kg of 4 kg.
        let found = bound(&ARM.replace("armature = 0.18", "armature = 100"));
        assert!((found - 0.75).abs() < 1e-4, "{found}");
    }

    /// No bound is known for a link that carries a rotor, which may turn against it, or for a link without mass.
    #[test]
    fn nothing_is_known_of_carriers_of_rotors_and_of_links_without_mass() {
        let rotor =
            "axis = \"x\" }\ndrive = { rotor_inertia = 0.001, gear_ratio = 10, gyroscopic = true }";
        let carrier =
            ARM.replace("axis = \"x\" }", rotor).replace("drive = { armature = 0.18 }\n", "");
        // Of the inertia that the column moves, only that of the hand is left in the bound.
        assert!(bound(&carrier) < bound(ARM));
        let alone = carrier
            .replace("{ joint = \"column\", ratio = -2 }", "{ joint = \"slide\", ratio = -2 }");
        assert_eq!(bound(&alone), 0.0);
    }

    /// Over random robots and configurations no pivot is below the bound.
    #[test]
    fn no_pivot_is_below_the_bound() {
        use robot_numeric::random::{Random as Seeded, Recipe};
        let mut bounded = 0;
        for seed in 0..30 {
            let recipe =
                Recipe { drives: true, mimic: true, ..Recipe::tree(1 + seed as usize % 4) };
            let robot = robot_numeric::robots::robot(&mut Seeded::new(seed), &recipe);
            let matrix = SampledMassMatrix::new(&robot);
            let part = (1..100).map(|part| f64::from(part) * 1e-2);
            let Some(part) = part.take_while(|part| matrix.keeps_pivots_above(*part)).last() else {
                continue;
            };
            bounded += 1;
            let mut random = Random::new(seed);
            for _ in 0..20 {
                let found = super::super::pivots::smallest_part(
                    matrix.at(&matrix.configuration(&mut random)),
                );
                assert!(found >= part, "seed {seed}: {found} {part}");
            }
        }
        assert!(bounded > 10, "{bounded}");
    }
}
