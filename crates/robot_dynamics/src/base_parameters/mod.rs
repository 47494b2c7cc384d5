//! The base parameters: the smallest set of combinations of the parameters of links and drives that determines the
//! joint torques.
//!
//! The joint torques are linear in the standard parameters ([`StandardParameter`]): ten of each link and those of its
//! drive. Some of them have no effect, others only have an effect in combination. A base parameter is a kept standard
//! parameter together with the parameters that are regrouped into it: β = B π. The columns of the kept parameters in
//! the full regressor Y form the regressor of the base parameters, Y π = Y_base β, and each column of Y is Y_base times
//! the corresponding column of B.
//!
//! The regrouping and the names follow M. Gautier and W. Khalil, "Direct calculation of minimum set of inertial
//! parameters of serial robots" (1990), and W. Khalil and E. Dombre, "Modeling, Identification and Control of Robots"
//! (2002), section 9.4. The conditions ([`identifiable`](self)) are exact for any tree, including first joints along
//! gravity, parallel axes and planar arms.
//!
//! In Denavit–Hartenberg frames ([`BaseFrames`]), first and second moments are kept instead of standard parameters;
//! their formulas are still in terms of standard parameters.
//!
//! If joints share a coordinate, fewer combinations are identifiable than with independent coordinates. They are found
//! from the rank of the columns at seeded states, and their coefficients are rounded.

mod columns;
mod echelon;
mod identifiable;
mod joint;
mod moments;
mod regroup;
mod scalar;
mod shared;
mod standard;

use robot_symbolic::Expr;

use crate::derivation::Derivation;
use crate::economical::{Reframed, WorkingFrame};
use crate::mechanism::Mechanism;
pub(crate) use columns::{base_columns, standard_columns};
use joint::Joint;
use regroup::{Form, Kept};
use robot_model::functions::{has_shared_coordinates, out_of_reach};
use robot_model::robot::BaseFrames;
use robot_model::robot::LINK_PARAMETERS;
use scalar::tidied;
pub use shared::inseparable;
pub use standard::{Quantity, StandardParameter, standard_parameters};

/// The base parameters of a robot.
#[derive(Clone, Debug)]
pub struct BaseParameters<'g> {
    /// The standard parameters with their values, in the order of the full regressor's columns.
    pub standard: Vec<(StandardParameter, Expr<'g>)>,
    /// The base parameters, in the order of the columns of Y_base.
    pub base: Vec<BaseParameter<'g>>,
    /// Whether coefficients were found at seeded states and are therefore rounded. This is the case if joints share a
    /// coordinate and fewer parameters are identifiable because of this.
    pub rounded: bool,
    /// The frames to which the parameters refer.
    pub frames: BaseFrames,
}

/// A base parameter.
#[derive(Clone, Debug)]
pub struct BaseParameter<'g> {
    /// The index of the kept parameter. For a standard parameter, this is its column in the full regressor; for a
    /// moment in another frame, the index of the link's standard parameter with the same number.
    pub column: usize,
    /// The kept parameter: a standard parameter or a moment in another frame ([`Quantity::Moment`]).
    pub kept: StandardParameter,
    /// A row of B: the nonzero coefficients of standard parameters with their indices, in ascending order. If standard
    /// parameters are kept, the coefficient of the kept one is 1, and no other kept parameter occurs.
    pub terms: Vec<(usize, Expr<'g>)>,
    /// Standard parameters, with their indices, for which this base parameter is 1 and all others are 0: the kept
    /// parameter alone, or those of a unit moment in another frame. Its column of Y_base is the corresponding
    /// combination of columns of the full regressor.
    pub unit: Vec<(usize, Expr<'g>)>,
}

impl<'g> BaseParameter<'g> {
    /// The column of the full regressor that equals this parameter's column; `None` for a moment in another frame.
    #[must_use]
    pub fn full_column(&self) -> Option<usize> {
        (!matches!(self.kept.quantity, Quantity::Moment(_))).then_some(self.column)
    }

    /// The name: that of the kept parameter, with an R if others are regrouped into it, as in `ZZR_2`.
    #[must_use]
    pub fn name(&self) -> String {
        let StandardParameter { link, quantity } = self.kept;
        format!("{}{}_{}", quantity.symbol(), self.mark(), link + 1)
    }

    /// `R` if other parameters are regrouped into the kept one. For a moment, only parameters of other links and of
    /// drives count as others.
    #[must_use]
    pub fn mark(&self) -> &'static str {
        let own = |place: usize| place / LINK_PARAMETERS == self.column / LINK_PARAMETERS;
        let regrouped = match self.kept.quantity {
            Quantity::Moment(_) => self.terms.iter().any(|(place, _)| !own(*place)),
            _ => self.terms.len() > 1,
        };
        if regrouped { "R" } else { "" }
    }
}

impl<'g> BaseParameters<'g> {
    /// The values of the base parameters for given values of the standard parameters, B π; both in their order.
    #[must_use]
    pub fn values(&self, standard: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let value = |base: &BaseParameter<'g>| {
            let terms = base.terms.iter().filter_map(|(place, coefficient)| {
                standard.get(*place).map(|value| *coefficient * *value)
            });
            terms.reduce(|sum, term| sum + term)
        };
        self.base.iter().filter_map(value).collect()
    }

    /// The values of the base parameters as functions of the robot file's parameters.
    #[must_use]
    pub fn nominal(&self) -> Vec<Expr<'g>> {
        let standard: Vec<Expr<'g>> = self.standard.iter().map(|(_, value)| *value).collect();
        self.values(&standard)
    }

    /// One of many sets of standard parameters that give these base parameters: the kept parameters have the values of
    /// the base parameters, and all others are 0.
    #[must_use]
    pub fn representative(&self, base: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let zero = |(_, value): &(_, Expr<'g>)| value.graph().zero();
        let mut standard: Vec<Expr<'g>> = self.standard.iter().map(zero).collect();
        for (parameter, value) in self.base.iter().zip(base) {
            for (place, coefficient) in &parameter.unit {
                if let Some(sum) = standard.get_mut(*place) {
                    *sum += *coefficient * *value;
                }
            }
        }
        standard
    }
}

/// The base parameters of a robot; `None` in the cases of [`out_of_reach`].
#[must_use]
pub fn base_parameters<'g>(derivation: &Derivation<'_, 'g>) -> Option<BaseParameters<'g>> {
    if out_of_reach(derivation.robot).is_some() {
        return None;
    }
    let reframed = base_frames(derivation);
    let frames = reframed.as_ref().map(|reframed| reframed.frames.as_slice());
    let standard = standard_parameters(&derivation.mechanism);
    let mechanism = reframed.as_ref().map_or(&derivation.mechanism, |moved| &moved.mechanism);
    let parameters: Vec<StandardParameter> =
        standard.iter().map(|(parameter, _)| *parameter).collect();
    let points = scalar::Points::new(mechanism, derivation.robot);
    let joints: Vec<Joint<'g>> =
        mechanism.links.iter().map(|link| Joint::new(link, &points)).collect();
    let conditions = identifiable::conditions(mechanism, &joints, &points);
    let mut kept = regroup::regroup(mechanism, &joints, &conditions, &parameters, frames, &points);
    let one = scalar::Scalar::new(mechanism.graph.one());
    let friction = parameters.iter().enumerate();
    let friction = friction.filter(|(_, parameter)| !regroup::is_inertial(parameter.quantity));
    kept.extend(friction.map(|(column, _)| (column, Form::from([(column, one)]))));
    kept.sort_by_key(|(column, _)| *column);
    let before = kept.len();
    if has_shared_coordinates(derivation.robot) {
        kept = shared::reduced(derivation, &kept);
    }
    let rounded = kept.len() < before;
    let base = |(column, form): Kept<'g>| {
        let terms = form
            .into_iter()
            .map(|(place, coefficient)| (place, tidied(coefficient.expr)))
            .collect();
        let (kept, unit) = kept_parameter(mechanism, column, parameters[column], frames);
        BaseParameter { column, kept, terms, unit }
    };
    let base = kept.into_iter().map(base).collect();
    Some(BaseParameters { base, standard, rounded, frames: derivation.robot.base_frames })
}

/// The quantity that is kept at an index, and the standard parameters of a unit of it.
fn kept_parameter<'g>(
    mechanism: &Mechanism<'g>,
    column: usize,
    parameter: StandardParameter,
    frames: Option<&[WorkingFrame<'g>]>,
) -> (StandardParameter, Vec<(usize, Expr<'g>)>) {
    let StandardParameter { link, quantity } = parameter;
    match (quantity, frames.and_then(|frames| frames.get(link))) {
        (Quantity::Link(place), Some(frame)) => {
            let coefficients = moments::unit_in_file(frame, place).into_iter().enumerate();
            let unit = coefficients
                .map(|(place, coefficient)| (LINK_PARAMETERS * link + place, coefficient));
            let unit = unit.filter(|(_, coefficient)| !coefficient.is_zero()).collect();
            (StandardParameter { link, quantity: Quantity::Moment(place) }, unit)
        }
        _ => (parameter, vec![(column, mechanism.graph.one())]),
    }
}

/// The mechanism in the frames to which the base parameters refer; `None` if these are the frames of the robot file.
pub(crate) fn base_frames<'g>(derivation: &Derivation<'_, 'g>) -> Option<Reframed<'g>> {
    match derivation.robot.base_frames {
        BaseFrames::File => None,
        BaseFrames::DenavitHartenberg => Reframed::denavit_hartenberg(&derivation.mechanism),
    }
}
