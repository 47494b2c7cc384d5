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
    pub(super) fn joint_frame(&self, random: &mut Random) -> Vec<f64> {
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
