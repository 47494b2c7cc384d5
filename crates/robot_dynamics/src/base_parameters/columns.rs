//! The columns of regressors, among which are the columns of the base parameters.

use robot_symbolic::Expr;

use super::{Quantity, StandardParameter, base_frames, standard_parameters};
use crate::body::Moments;
use crate::derivation::Derivation;
use crate::economical::{self, Column, RegressorColumns};
use crate::mechanism::MechanismLink;
use crate::plain;

/// The columns of the full regressor, one for each of [`standard_parameters`].
pub(crate) fn standard_columns<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Column<'g>> {
    let columns = economical::regressor(&derivation.mechanism, Moments::Inertia);
    with_drives(derivation, &columns.unwrap_or_else(|| plain::regressor(derivation)))
}

/// The columns among which are those of the base parameters: the column of a base parameter is at its `column`.
pub(crate) fn base_columns<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Column<'g>> {
    let columns = base_frames(derivation)
        .and_then(|reframed| economical::regressor(&reframed.mechanism, Moments::Second));
    match columns {
        Some(columns) => with_drives(derivation, &columns),
        None => standard_columns(derivation),
    }
}

/// The columns of the links, followed by those of the drives.
fn with_drives<'g>(
    derivation: &Derivation<'_, 'g>,
    RegressorColumns { links, rotors }: &RegressorColumns<'g>,
) -> Vec<Column<'g>> {
    let mechanism = &derivation.mechanism;
    let column = |(place, (parameter, _)): (usize, (StandardParameter, Expr<'g>))| {
        let link = &mechanism.links[parameter.link];
        match parameter.quantity {
            Quantity::Link(_) | Quantity::Moment(_) => links[place].clone(),
            Quantity::RotorCoupling => rotors[parameter.link].clone(),
            quantity => drive_column(link, quantity, mechanism.degrees_of_freedom),
        }
    };
    standard_parameters(mechanism).into_iter().enumerate().map(column).collect()
}

/// The column of a quantity of a drive that only affects the drive's own joint.
fn drive_column<'g>(
    link: &MechanismLink<'g>,
    quantity: Quantity,
    coordinates: usize,
) -> Column<'g> {
    let graph = link.ratio.graph();
    let sign = link.friction.sign(link.velocity);
    let contribution = match quantity {
        Quantity::ReflectedInertia => link.acceleration,
        Quantity::ViscousFriction => link.velocity,
        Quantity::ForwardFriction => (sign * sign + sign) / 2,
        Quantity::BackwardFriction => (sign - sign * sign) / 2,
        Quantity::Offset => graph.one(),
        Quantity::Link(_) | Quantity::Moment(_) | Quantity::RotorCoupling => graph.zero(),
    };
    let mut column = vec![graph.zero(); coordinates];
    column[link.coordinate] = contribution * link.ratio;
    column
}
