//! Base parameters in terms of second moments: conversion between a link's parameters in the file's frame and the first
//! and second moments in another frame.

use robot_model::robot::LINK_PARAMETERS;
use robot_symbolic::Expr;

use super::echelon::Row;
use super::regroup::{Form, add};
use super::scalar::Scalar;
use crate::body::{Body, ENTRIES, Moments, TENSOR};
use crate::economical::WorkingFrame;

/// Whether an index among the six entries of a tensor is that of a diagonal entry.
fn is_diagonal(place: usize) -> bool {
    ENTRIES.get(place).is_some_and(|(row, column)| row == column)
}

/// The ten parameters, in the given frame, of a body whose parameters in the file's frame are all 0 except the given
/// one, which is 1.
pub(super) fn unit_in_frame<'g>(
    frame: &WorkingFrame<'g>,
    parameter: usize,
) -> [Expr<'g>; LINK_PARAMETERS] {
    let unit = Body::unit(frame.origin.0[0].graph(), parameter);
    unit.about(-frame.origin).turned(frame.axes.transpose()).parameters()
}

/// The ten parameters, in the file's frame, of a body whose moments in the given frame are all 0 except the given one,
/// which is 1.
pub(super) fn unit_in_file<'g>(
    frame: &WorkingFrame<'g>,
    moment: usize,
) -> [Expr<'g>; LINK_PARAMETERS] {
    let unit = Body::unit(frame.origin.0[0].graph(), moment);
    let body = Body { tensor: Moments::Inertia.of_second(unit.tensor), ..unit };
    body.turned(frame.axes).about(frame.origin).parameters()
}

/// Converts a linear function of a body's parameters to a function of its moments: with I = tr(Σ) 1 − Σ, f(Σ_xx) is
/// f(I_yy) + f(I_zz), and f(Σ_xy) is −f(I_xy).
pub(super) fn of_moments<'g>(function: &Row<'g>) -> Row<'g> {
    let mut row = function.clone();
    for place in 0..ENTRIES.len() {
        let others = (0..ENTRIES.len()).filter(|other| is_diagonal(*other) && *other != place);
        row[TENSOR + place] = match is_diagonal(place) {
            true => others.map(|other| function[TENSOR + other]).reduce(|a, b| a + b),
            false => None,
        }
        .unwrap_or_else(|| -function[TENSOR + place]);
    }
    row
}

/// Converts forms of a body's parameters to forms of its moments: Σ = tr(I)/2 1 − I.
pub(super) fn to_second<'g>(forms: &mut [Form<'g>], one: Scalar<'g>) {
    exchange(forms, one, one / Scalar::integer(one, 2));
}

/// Converts forms of a body's moments to forms of its parameters: I = tr(Σ) 1 − Σ.
pub(super) fn to_inertia<'g>(forms: &mut [Form<'g>], one: Scalar<'g>) {
    exchange(forms, one, one);
}

/// Replaces a symmetric tensor T by `factor` · tr(T) 1 − T.
fn exchange<'g>(forms: &mut [Form<'g>], one: Scalar<'g>, factor: Scalar<'g>) {
    let mut trace = Form::new();
    for place in (0..ENTRIES.len()).filter(|place| is_diagonal(*place)) {
        add(&mut trace, &forms[TENSOR + place], factor);
    }
    for place in 0..ENTRIES.len() {
        let mut form = if is_diagonal(place) { trace.clone() } else { Form::new() };
        add(&mut form, &forms[TENSOR + place], -one);
        forms[TENSOR + place] = form;
    }
}
