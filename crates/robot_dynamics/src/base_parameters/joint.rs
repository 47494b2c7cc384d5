//! The transformation of twists and bodies across a joint and the placement before it.

use robot_model::robot::{JointKind, LINK_PARAMETERS};
use robot_symbolic::{Expr, Graph};

use super::echelon::Row;
use super::scalar::{Points, Scalar};
use crate::body::{Body, ENTRIES, FIRST_MOMENT, TENSOR};
use crate::mechanism::MechanismLink;
use crate::vector::{Matrix, Vector};

/// The number of components of a twist: the angular velocity, then the velocity of the point at the origin.
const TWIST: usize = 6;

/// A linear map, given by the images of the unit vectors.
struct Map<'g> {
    columns: Vec<Row<'g>>,
}

impl<'g> Map<'g> {
    fn new<const N: usize>(
        points: &Points<'_>,
        units: usize,
        image: impl Fn(usize) -> [Expr<'g>; N],
    ) -> Map<'g> {
        let column = |unit| image(unit).map(|entry| Scalar::of(entry, points)).to_vec();
        Map { columns: (0..units).map(column).collect() }
    }

    /// The image of a vector.
    fn apply(&self, vector: &[Scalar<'g>]) -> Row<'g> {
        let mut result: Row<'g> = vec![];
        for (amount, column) in vector.iter().zip(&self.columns) {
            if result.is_empty() {
                result = vec![Scalar::integer(*amount, 0); column.len()];
            }
            for (sum, entry) in result.iter_mut().zip(column) {
                *sum = add_product(*sum, *amount, *entry);
            }
        }
        result
    }

    /// The pullback of a linear function: the function composed with the map.
    fn pull_back(&self, function: &[Scalar<'g>]) -> Row<'g> {
        let entry = |column: &Row<'g>| dot(function, column);
        self.columns.iter().map(entry).collect()
    }
}

fn add_product<'g>(sum: Scalar<'g>, a: Scalar<'g>, b: Scalar<'g>) -> Scalar<'g> {
    match (a.is_zero() || b.is_zero(), sum.is_zero()) {
        (true, _) => sum,
        (false, true) => a * b,
        (false, false) => sum + a * b,
    }
}

fn dot<'g>(a: &[Scalar<'g>], b: &[Scalar<'g>]) -> Scalar<'g> {
    let zero = Scalar::integer(a[0], 0);
    a.iter().zip(b).fold(zero, |sum, (a, b)| add_product(sum, *a, *b))
}

/// The joint of a link, in the axes of the link's frame.
pub(super) struct Joint<'g> {
    /// The twist of the joint's unit motion.
    pub(super) twist: Row<'g>,
    axis: Row<'g>,
    /// Maps the twist of the carrier from the carrier's origin and axes to those of this link, at joint position 0.
    placement: Map<'g>,
    /// The derivative of the components of a twist with respect to the joint position.
    turning: Map<'g>,
    /// Maps a body's parameters from this link's frame to the carrier's frame, at joint position 0.
    carried: Map<'g>,
    /// The derivative of the parameters of a body with respect to the joint position.
    moving: Map<'g>,
}

impl<'g> Joint<'g> {
    pub(super) fn new(link: &MechanismLink<'g>, points: &Points<'_>) -> Joint<'g> {
        let graph = link.mass.graph();
        let (axis, zero) = (link.axis, Vector::zero(graph));
        let kind = link.kind;
        let of_unit = |place: usize| {
            let unit = |first: usize| {
                Vector([0, 1, 2].map(|k| graph.integer(i64::from(place == first + k))))
            };
            (unit(0), unit(3))
        };
        let placement = |place: usize| {
            let (omega, velocity) = of_unit(place);
            let back = link.rotation.transpose();
            twist(back * omega, back * (velocity + omega.cross(link.translation)))
        };
        let turning = |place: usize| match (of_unit(place), kind) {
            ((omega, velocity), JointKind::Revolute) => {
                twist(omega.cross(axis), velocity.cross(axis))
            }
            ((omega, _), JointKind::Prismatic) => twist(zero, omega.cross(axis)),
        };
        let carried = |place: usize| {
            Body::unit(graph, place).turned(link.rotation).about(link.translation).parameters()
        };
        let scalar = |expr| Scalar::of(expr, points);
        let own = match kind {
            JointKind::Revolute => twist(axis, zero),
            JointKind::Prismatic => twist(zero, axis),
        };
        Joint {
            twist: own.map(scalar).to_vec(),
            axis: axis.0.map(scalar).to_vec(),
            placement: Map::new(points, TWIST, placement),
            turning: Map::new(points, TWIST, turning),
            carried: Map::new(points, LINK_PARAMETERS, carried),
            moving: Map::new(points, LINK_PARAMETERS, |place| moving(graph, kind, axis, place)),
        }
    }

    /// A twist of the carrier about this link's origin and in its axes, at joint position 0.
    pub(super) fn twist_here(&self, twist: &Row<'g>) -> Row<'g> {
        self.placement.apply(twist)
    }

    /// The derivative of the components of a twist with respect to the joint position.
    pub(super) fn turned(&self, twist: &Row<'g>) -> Row<'g> {
        self.turning.apply(twist)
    }

    /// The component of the angular velocity along the joint axis.
    pub(super) fn about_axis(&self, twist: &Row<'g>) -> Scalar<'g> {
        dot(&self.axis, &twist[..3])
    }

    /// A linear function of the carrier's parameters as a function of this link's; entries after the ten parameters are
    /// kept.
    pub(super) fn function_here(&self, function: &Row<'g>) -> Row<'g> {
        with_rest(self.carried.pull_back(&function[..LINK_PARAMETERS]), function, None)
    }

    /// The derivative of a linear function of parameters with respect to the joint position; it is 0 for entries after
    /// the ten parameters.
    pub(super) fn rate(&self, function: &Row<'g>) -> Row<'g> {
        let rate = self.moving.pull_back(&function[..LINK_PARAMETERS]);
        with_rest(rate, function, Some(Scalar::integer(function[0], 0)))
    }

    /// The nonzero parameters, in the carrier's frame at joint position 0, of a body of this link that has a unit of
    /// one parameter: pairs of the parameter's index and its value.
    pub(super) fn moved(&self, parameter: usize) -> impl Iterator<Item = (usize, Scalar<'g>)> + '_ {
        let column = self.carried.columns.get(parameter).into_iter().flatten();
        column.copied().enumerate().filter(|(_, entry)| !entry.is_zero())
    }
}

/// Appends to a row the entries of `whole` after the ten parameters, or `filling` in place of each of them.
fn with_rest<'g>(mut row: Row<'g>, whole: &Row<'g>, filling: Option<Scalar<'g>>) -> Row<'g> {
    let rest = whole.iter().skip(LINK_PARAMETERS);
    row.extend(rest.map(|entry| filling.unwrap_or(*entry)));
    row
}

fn twist<'g>(Vector([a, b, c]): Vector<'g>, Vector([x, y, z]): Vector<'g>) -> [Expr<'g>; TWIST] {
    [a, b, c, x, y, z]
}

/// The derivative of a unit of one parameter with respect to the joint position.
fn moving<'g>(
    graph: &'g Graph,
    kind: JointKind,
    axis: Vector<'g>,
    place: usize,
) -> [Expr<'g>; LINK_PARAMETERS] {
    let Body { mass, first, tensor } = Body::unit(graph, place);
    let rate = match kind {
        JointKind::Revolute => {
            let cross = Matrix::skew(axis);
            let tensor = cross * tensor - tensor * cross;
            Body { mass: graph.zero(), first: axis.cross(first), tensor }
        }
        JointKind::Prismatic => {
            let mixed = Matrix::outer(first, axis) + Matrix::outer(axis, first);
            let tensor = Matrix::identity(graph) * (first.dot(axis) * 2) - mixed;
            Body { mass: graph.zero(), first: axis * mass, tensor }
        }
    };
    rate.parameters()
}

/// The bilinear form of two twists as a linear function of a body's parameters: m v₁ · v₂ + h · (v₁ × ω₂ + v₂ × ω₁) +
/// ω₁ · I ω₂. For equal twists, this is twice the kinetic energy.
pub(super) fn energy<'g>(a: &Row<'g>, b: &Row<'g>) -> Row<'g> {
    let ((w, v), (u, x)) = (a.split_at(3), b.split_at(3));
    let zero = Scalar::integer(a[0], 0);
    let mut row = vec![zero; LINK_PARAMETERS];
    row[0] = dot(v, x);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let cross = |p: &[Scalar<'g>], q: &[Scalar<'g>]| {
            add_product(add_product(zero, p[i], q[j]), -p[j], q[i])
        };
        row[FIRST_MOMENT + k] = cross(v, u) + cross(x, w);
    }
    for (place, (i, j)) in ENTRIES.into_iter().enumerate() {
        let both = add_product(zero, w[i], u[j]);
        row[TENSOR + place] = if i == j { both } else { add_product(both, w[j], u[i]) };
    }
    row
}
