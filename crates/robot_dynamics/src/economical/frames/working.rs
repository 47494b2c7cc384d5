//! Working frames: z is the joint axis; the plan determines the origin and the rotation about z.

use robot_model::robot::JointKind;
use robot_symbolic::Expr;

use crate::economical::plan::{LinkPlan, Origin, Turn};
use crate::economical::spatial::inertia::PseudoInertia;
use crate::economical::spatial::rotation::{ConstantRotation, constant_root};
use crate::mechanism::{Mechanism, MechanismLink};
use crate::vector::{Matrix, Vector};

/// If the squared sine of the angle between two axes is below this, their common normal is not well defined
/// numerically.
const NEARLY_PARALLEL: f64 = 1e-4;

/// Axes whose squared sine is at most this are parallel to within rounding errors.
const PARALLEL: f64 = 1e-24;

/// A frame fixed to a link.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorkingFrame<'g> {
    /// The frame's axes in components of the link's frame, as columns.
    pub(crate) axes: Matrix<'g>,
    /// The origin relative to the link's frame, m.
    pub(crate) origin: Vector<'g>,
    /// Whether z is opposite to the joint axis, which makes antiparallel joints parallel.
    pub(crate) flipped: bool,
}

/// Frames at the links' own origins, with z along the joint axis and x as close to the file's as this allows. `None` if
/// a joint axis is not constant.
pub(crate) fn file_frames<'g>(mechanism: &Mechanism<'g>) -> Option<Vec<WorkingFrame<'g>>> {
    let mut frames: Vec<WorkingFrame<'g>> = vec![];
    for link in &mechanism.links {
        let axis = link.rotation * link.axis;
        let parent_axis = link.parent.map(|parent| frames[parent].axes.column(2));
        let flipped = parent_axis.is_some_and(|parent| parent == -axis);
        let z = if flipped { -link.axis } else { link.axis };
        let known = z.0.iter().all(|component| component.as_number().is_some());
        let axes = if known { axes_about(z)? } else { return None };
        frames.push(WorkingFrame { axes, origin: Vector::zero(mechanism.graph), flipped });
    }
    Some(frames)
}

/// A right-handed set of axes with the given z axis; a permutation of the coordinate axes if z is a coordinate axis.
///
/// `None` if the axis depends on parameters.
pub(crate) fn axes_about(z: Vector<'_>) -> Option<Matrix<'_>> {
    let graph = z.0[0].graph();
    let [Some(a), Some(b), Some(c)] = z.0.map(coefficient) else {
        return None;
    };
    let unit = Matrix::identity(graph);
    // Axis x is derived from the coordinate axis that is most nearly perpendicular to z.
    let x = if z.0[0].is_zero() && z.0[1].is_zero() {
        unit.column(0)
    } else if z.0[1].is_zero() && z.0[2].is_zero() {
        unit.column(1)
    } else if z.0[0].is_zero() && z.0[2].is_zero() {
        unit.column(2)
    } else {
        let least = if a.abs() <= b.abs() && a.abs() <= c.abs() {
            0
        } else if b.abs() <= c.abs() {
            1
        } else {
            2
        };
        let normal = unit.column(least).cross(z);
        let length = constant_root(normal.dot(normal));
        normal.map(|component| component / length)
    };
    let y = z.cross(x);
    Some(Matrix([x, y, z].map(|axis| axis.0)).transpose())
}

/// The value of a constant; `None` if the expression is not constant.
fn coefficient(expr: Expr<'_>) -> Option<f64> {
    let value = expr.evaluate(|_| f64::NAN);
    value.is_finite().then_some(value)
}

/// The distance along the joint axis from a link's origin to the foot of the common normal with the axis of its
/// parent's joint. If the axes are parallel, this is the normal through the parent's origin. `axes` and `parent_axes`
/// are in the file's frames, with z along the joint axes; `parent_origin` is in the parent's frame of the file.
///
/// `None` if the distance exceeds `farthest`, if the angle between the axes depends on parameters, or if the axes are
/// so close to parallel that the foot is not well defined.
pub(crate) fn normal_with_parent<'g>(
    link: &MechanismLink<'g>,
    axes: Matrix<'g>,
    parent_axes: Matrix<'g>,
    parent_origin: Vector<'g>,
    farthest: f64,
) -> Option<Expr<'g>> {
    let back = axes.transpose() * link.rotation.transpose();
    let direction = back * parent_axes.column(2);
    let point = back * (parent_origin - link.translation);
    let axis = Axis { direction, point, has_place: true };
    let sine_squared = coefficient(axis.sine_squared())?;
    let foot = match sine_squared {
        ..=PARALLEL => Some(point.0[2]),
        ..=NEARLY_PARALLEL => None,
        _ => Some(axis.foot()),
    };
    foot.filter(|foot| coefficient(*foot).is_none_or(|foot| foot.abs() <= farthest))
}

/// Places the working frames according to the plan, from the base outward. An origin that would be farther than
/// `farthest` (m) along its axis remains at the file's origin.
pub(crate) fn place<'g>(
    mechanism: &Mechanism<'g>,
    plans: &[LinkPlan],
    file: &[WorkingFrame<'g>],
    regrouped: &[PseudoInertia<'g>],
    farthest: f64,
) -> Vec<WorkingFrame<'g>> {
    let mut placed: Vec<WorkingFrame<'g>> = vec![];
    for (index, link) in mechanism.links.iter().enumerate() {
        let mut frame = file[index];
        let child = mechanism.children(index).next();
        let next = child.map(|child| Axis::of(&mechanism.links[child], &file[child], &frame));
        let plan = &plans[index];
        let turn = match plan.turn {
            Turn::File => None,
            Turn::NextNormal => next.as_ref().and_then(Axis::normal_turn),
            Turn::FirstMoment => direction(regrouped[index].first.0),
        };
        if let Some((sine, cosine)) = turn {
            let z = Matrix::identity(mechanism.graph).column(2);
            frame.axes = frame.axes * Matrix::rotation(z, sine, cosine);
        }
        let previous = link.parent.map(|parent| (&file[parent], &placed[parent]));
        let offset = match link.kind {
            JointKind::Revolute => {
                let along = origin_along(
                    plan.origin,
                    link,
                    &file[index],
                    next,
                    previous,
                    &regrouped[index],
                );
                let is_near =
                    |t: &Expr<'g>| t.as_number().is_none_or(|t| t.to_f64().abs() <= farthest);
                along.filter(is_near).map(|t| file[index].axes.column(2) * t)
            }
            JointKind::Prismatic => {
                free_origin(plan.origin, link, previous.map(|(_, placed)| placed))
            }
        };
        frame.origin = offset.unwrap_or(frame.origin);
        placed.push(frame);
    }
    placed
}

/// The position, along the joint axis, of the origin of the working frame of a link on a revolute joint.
fn origin_along<'g>(
    origin: Origin,
    link: &MechanismLink<'g>,
    file: &WorkingFrame<'g>,
    next: Option<Axis<'g>>,
    previous: Option<(&WorkingFrame<'g>, &WorkingFrame<'g>)>,
    inertia: &PseudoInertia<'g>,
) -> Option<Expr<'g>> {
    let (Vector(h), Matrix(s)) = (inertia.first, inertia.second);
    match origin {
        Origin::File | Origin::CenterOfMass | Origin::Parent => None,
        Origin::NextNormal => next.filter(|axis| axis.has_place)?.foot_on_z(),
        Origin::PreviousNormal => {
            let (parent_file, parent) = previous?;
            let back = file.axes.transpose() * link.rotation.transpose();
            let direction = back * parent_file.axes.column(2);
            let point = back * (parent.origin - link.translation);
            let axis = Axis { direction, point, has_place: true };
            // Parallel axes have common normals everywhere; the one through the parent's origin is chosen.
            axis.foot_on_z().or_else(|| axis.is_parallel().then_some(point.0[2]))
        }
        // Moving the origin by t subtracts t h from the third column of Σ.
        Origin::ZeroXz => safe_quotient(s[0][2], h[0]),
        Origin::ZeroYz => safe_quotient(s[1][2], h[1]),
    }
}

/// The origin of the working frame of a link on a prismatic joint, which can be anywhere.
fn free_origin<'g>(
    origin: Origin,
    link: &MechanismLink<'g>,
    parent: Option<&WorkingFrame<'g>>,
) -> Option<Vector<'g>> {
    match origin {
        Origin::CenterOfMass => Some(link.center_of_mass),
        Origin::Parent => {
            let zero = Vector::zero(link.mass.graph());
            let parent_origin = parent.map_or(zero, |parent| parent.origin);
            Some(link.rotation.transpose() * (parent_origin - link.translation))
        }
        _ => None,
    }
}

/// The quotient, if the denominator is a number that is not small and the numerator is not 0.
fn safe_quotient<'g>(numerator: Expr<'g>, denominator: Expr<'g>) -> Option<Expr<'g>> {
    let size = denominator.as_number()?.to_f64().abs();
    (size > 1e-3 && !numerator.is_zero()).then(|| numerator / denominator)
}

/// The sine and cosine of the direction of the first two components.
fn direction<'g>([x, y, _]: [Expr<'g>; 3]) -> Option<(Expr<'g>, Expr<'g>)> {
    if y.is_zero() {
        return None;
    }
    if x.is_zero() {
        return Some((x.graph().one(), x));
    }
    let (Some(a), Some(b)) = (x.as_number(), y.as_number()) else {
        return None;
    };
    if a.to_f64().hypot(b.to_f64()) < 1e-9 {
        return None;
    }
    let length = constant_root(x * x + y * y);
    Some((y / length, x / length))
}

/// A joint axis in another link's file frame.
struct Axis<'g> {
    direction: Vector<'g>,
    point: Vector<'g>,
    /// Whether the axis has a position; the axis of a prismatic joint only has a direction.
    has_place: bool,
}

impl<'g> Axis<'g> {
    /// The axis of a link's joint in the file frame of its parent.
    fn of(link: &MechanismLink<'g>, own: &WorkingFrame<'g>, parent: &WorkingFrame<'g>) -> Axis<'g> {
        let back = parent.axes.transpose();
        Axis {
            direction: back * (link.rotation * own.axes.column(2)),
            point: back * link.translation,
            has_place: match link.kind {
                JointKind::Revolute => true,
                JointKind::Prismatic => false,
            },
        }
    }

    fn is_parallel(&self) -> bool {
        self.direction.0[0].is_zero() && self.direction.0[1].is_zero()
    }

    /// The position, along the z axis, of the foot of the common normal of the two axes.
    fn foot_on_z(&self) -> Option<Expr<'g>> {
        let size = self.sine_squared().as_number()?.to_f64();
        (size > NEARLY_PARALLEL).then(|| self.foot())
    }

    fn sine_squared(&self) -> Expr<'g> {
        let Vector([x, y, _]) = self.direction;
        x * x + y * y
    }

    /// The position like that of [`Axis::foot_on_z`], for axes that are known not to be parallel.
    fn foot(&self) -> Expr<'g> {
        let along = self.direction.0[2] * self.point.dot(self.direction);
        (self.point.0[2] - along) / self.sine_squared()
    }

    /// The sine and cosine of the rotation about z that makes x parallel to the common normal.
    fn normal_turn(&self) -> Option<(Expr<'g>, Expr<'g>)> {
        let Vector([ex, ey, _]) = self.direction;
        if self.is_parallel() {
            return self.has_place.then(|| direction(self.point.0)).flatten();
        }
        direction([-ey, ex, ex])
    }
}

/// The constant displacement from a parent's working frame to a link's, at joint position 0.
pub(crate) fn between<'g>(
    link: &MechanismLink<'g>,
    own: &WorkingFrame<'g>,
    parent: Option<&WorkingFrame<'g>>,
) -> (Matrix<'g>, Vector<'g>) {
    let rotation = link.rotation * own.axes;
    let origin = link.translation + link.rotation * own.origin;
    match parent {
        Some(parent) => {
            let back = parent.axes.transpose();
            (clean(back * rotation), back * (origin - parent.origin))
        }
        None => (clean(rotation), origin),
    }
}

/// Sets entries to 0 that differ from it only by rounding, because of a rotation by an angle and back.
fn clean(matrix: Matrix<'_>) -> Matrix<'_> {
    matrix.map(|entry| match entry.as_number() {
        Some(number) if number.as_rational().is_none() && number.to_f64().abs() < 1e-15 => {
            entry.graph().zero()
        }
        _ => entry,
    })
}

/// The constant rotation between working frames, ready to apply.
pub(crate) fn constant_rotation(matrix: Matrix<'_>) -> ConstantRotation<'_> {
    ConstantRotation::new(matrix)
}

#[cfg(test)]
mod tests {
    use robot_symbolic::{Graph, Number};

    use super::*;

    #[test]
    fn nothing_is_divided_by_what_is_small_or_not_a_number() {
        let graph = Graph::new();
        let number = |value: f64| graph.number(Number::real(value));
        let quotient = |numerator: f64, denominator: f64| {
            safe_quotient(number(numerator), number(denominator))
                .map(|quotient| quotient.evaluate(|_| f64::NAN))
        };
        assert_eq!(quotient(3.0, -2.0), Some(-1.5));
        assert_eq!((quotient(3.0, 1e-4), quotient(3.0, 0.0)), (None, None));
        // A shift by 0 has no effect.
        assert_eq!(safe_quotient(graph.zero(), number(2.0)), None);
        assert_eq!(safe_quotient(number(3.0), graph.symbol("h")), None);
    }

    #[test]
    fn a_direction_has_a_length() {
        let graph = Graph::new();
        let number = |value: f64| graph.number(Number::real(value));
        let found = direction([graph.integer(8), graph.integer(-6), graph.one()]);
        let found =
            found.map(|(sine, cosine)| [sine, cosine].map(|one| one.evaluate(|_| f64::NAN)));
        assert_eq!(found, Some([-0.6, 0.8]));
        // The direction of rounding errors is arbitrary.
        assert_eq!(direction([number(6e-10), number(-3e-10), graph.one()]), None);
        assert_eq!(direction([graph.symbol("x"), number(1.0), graph.one()]), None);
    }

    #[test]
    fn rounding_errors_in_rotations_become_zero() {
        let graph = Graph::new();
        let number = |value: f64| graph.number(Number::real(value));
        let cleaned = |value: f64| {
            let of = |one: Expr<'_>| if one.is_zero() { value } else { 1.0 };
            clean(Matrix::identity(&graph).map(|one| number(of(one)))).0[0][1]
        };
        assert!(cleaned(-9e-16).is_zero());
        assert_eq!(cleaned(2e-15), number(2e-15));
    }
}
