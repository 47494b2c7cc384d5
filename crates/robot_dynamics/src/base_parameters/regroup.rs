//! Regrouping, from the tips inward: keeps the parameters that a link's joint identifies and moves the rest to the
//! carrier.

use std::collections::BTreeMap;

use robot_model::robot::JointKind;
use robot_model::robot::LINK_PARAMETERS;

use super::echelon::{Echelon, Row};
use super::identifiable::DRIVE;
use super::joint::Joint;
use super::moments::{of_moments, to_inertia, to_second, unit_in_frame};
use super::scalar::{Points, Scalar};
use super::standard::{Quantity, StandardParameter};
use crate::body::{FIRST_MOMENT, tensor_place};
use crate::economical::WorkingFrame;
use crate::mechanism::{Mechanism, MechanismLink};

/// A linear function of the standard parameters: coefficients by the parameters' indices.
pub(super) type Form<'g> = BTreeMap<usize, Scalar<'g>>;

/// A kept parameter: its index among the standard parameters, and the form that it stands for, including itself.
pub(super) type Kept<'g> = (usize, Form<'g>);

/// Keeps as many parameters of the links, and of the drives' inertias and offsets, as are identifiable.
///
/// If `frames` is given, the mechanism, its joints and the conditions are in these frames, and moments are kept instead
/// of parameters: the index of a kept moment is that of the parameter with the same number. Forms are nevertheless
/// functions of the parameters in the file's frames.
pub(super) fn regroup<'g>(
    mechanism: &Mechanism<'g>,
    joints: &[Joint<'g>],
    conditions: &[Vec<Row<'g>>],
    standard: &[StandardParameter],
    frames: Option<&[WorkingFrame<'g>]>,
    points: &Points<'_>,
) -> Vec<Kept<'g>> {
    let one = Scalar::new(mechanism.graph.one());
    let Own { mut gathered, columns } = own(joints.len(), standard, frames, one, points);
    let mut kept = vec![];
    for (index, link) in mechanism.links.iter().enumerate().rev() {
        let order: Vec<usize> = preference(link, frames.is_some(), points)
            .into_iter()
            .filter(|place| columns[index][*place].is_some())
            .collect();
        let identifiable = conditions[index].iter().map(|row| {
            let row = if frames.is_some() { of_moments(row) } else { row.clone() };
            order.iter().map(|place| row[*place]).collect()
        });
        let identifiable = Echelon::of(identifiable);
        if frames.is_some() {
            to_second(&mut gathered[index], one);
        }
        // The unidentifiable rest, which acts like a body on the carrier.
        let mut rest = gathered[index].clone();
        for (pivot, row) in identifiable.rows {
            let mut regrouped = Form::new();
            let others = row.iter().zip(&order).enumerate().filter(|(column, _)| *column != pivot);
            for (_, (coefficient, place)) in others {
                add(&mut regrouped, &gathered[index][*place], *coefficient);
            }
            let place = order[pivot];
            rest[place] = Form::new();
            add(&mut rest[place], &regrouped, -one);
            add(&mut regrouped, &gathered[index][place], one);
            kept.extend(columns[index][place].map(|column| (column, regrouped)));
        }
        if frames.is_some() {
            to_inertia(&mut rest, one);
        }
        let Some(parent) = link.parent else { continue };
        for (place, form) in rest.iter().take(LINK_PARAMETERS).enumerate() {
            for (target, amount) in joints[index].moved(place) {
                add(&mut gathered[parent][target], form, amount);
            }
        }
    }
    kept
}

/// What each link has of its own, by places.
struct Own<'g> {
    /// The forms at each place, to which those of the links farther out are added.
    gathered: Vec<Vec<Form<'g>>>,
    /// The column of each place, if it has one.
    columns: Vec<Vec<Option<usize>>>,
}

fn own<'g>(
    links: usize,
    standard: &[StandardParameter],
    frames: Option<&[WorkingFrame<'g>]>,
    one: Scalar<'g>,
    points: &Points<'_>,
) -> Own<'g> {
    let mut gathered: Vec<Vec<Form<'g>>> =
        vec![vec![Form::new(); LINK_PARAMETERS + DRIVE.len()]; links];
    let mut columns = vec![vec![None; LINK_PARAMETERS + DRIVE.len()]; links];
    for (column, parameter) in standard.iter().enumerate() {
        if is_inertial(parameter.quantity) {
            let place = parameter.quantity.place();
            let frame = frames.and_then(|frames| frames.get(parameter.link));
            match frame.filter(|_| place < LINK_PARAMETERS) {
                Some(frame) => {
                    let coefficients = unit_in_frame(frame, place);
                    for (form, coefficient) in gathered[parameter.link].iter_mut().zip(coefficients)
                    {
                        add(form, &Form::from([(column, one)]), Scalar::of(coefficient, points));
                    }
                }
                None => {
                    gathered[parameter.link][place].insert(column, one);
                }
            }
            columns[parameter.link][place] = Some(column);
        }
    }
    Own { gathered, columns }
}

/// Whether the quantity is identifiable from inertial or position-dependent torques, unlike friction.
pub(super) fn is_inertial(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Link(_)) || DRIVE.contains(&quantity)
}

/// Adds a multiple of a form to a sum.
pub(super) fn add<'g>(sum: &mut Form<'g>, form: &Form<'g>, factor: Scalar<'g>) {
    if factor.is_zero() {
        return;
    }
    for (column, coefficient) in form {
        let more = factor * *coefficient;
        let total = sum.get(column).map_or(more, |known| *known + more);
        if total.is_zero() {
            sum.remove(column);
        } else {
            sum.insert(*column, total);
        }
    }
}

/// The places in order of preference: among parameters that the joint torques cannot distinguish, the first is kept.
/// The first seven for a revolute joint, or four for a prismatic joint, are those that the recursion computes. Of the
/// second moments, a revolute joint does not identify the one along its axis; of the inertia tensor, the one that is
/// left out is perpendicular to the axis.
fn preference(link: &MechanismLink<'_>, second: bool, points: &Points<'_>) -> Vec<usize> {
    let size = |component: usize| Scalar::of(link.axis.0[component], points).size();
    let z = [0, 1].into_iter().fold(2, |best, k| if size(k) > size(best) { k } else { best });
    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
    let tensor = tensor_place;
    let first = |component: usize| FIRST_MOMENT + component;
    let (kept, left) = if second { (y, z) } else { (z, y) };
    let of_tensor = [tensor(kept, kept), tensor(x, x), tensor(x, y), tensor(x, z), tensor(y, z)];
    let mut order = match link.kind {
        JointKind::Revolute => {
            let identifiable = of_tensor.into_iter().chain([first(x), first(y)]);
            identifiable.chain([tensor(left, left), first(z), 0]).collect()
        }
        JointKind::Prismatic => {
            let moments = [0, first(0), first(1), first(2)].into_iter();
            moments.chain(of_tensor).chain([tensor(left, left)]).collect::<Vec<usize>>()
        }
    };
    order.extend(DRIVE.map(Quantity::place));
    order
}
