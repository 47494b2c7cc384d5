//! The base (minimal) inertial parameters: the fewest combinations of the parameters of links and
//! drives that determine the driving forces.
//!
//! The driving forces are linear in the standard parameters, ten of each link and those of its drive
//! ([`StandardParameter`]); some have no effect, others only together. A base parameter is a kept
//! standard parameter and what is regrouped under it: β = B π. The columns of the kept ones in the full
//! regressor Y are the regressor over the base parameters, Y π = Y_base β, and each column of Y is
//! Y_base times the column of B.
//!
//! The regrouping is that of M. Gautier and W. Khalil, "Direct calculation of minimum set of inertial
//! parameters of serial robots" (1990), and W. Khalil and E. Dombre, "Modeling, Identification and
//! Control of Robots" (2002), section 9.4, whose names are used; the conditions are exact for any tree
//! ([`told`](self)): first joints along gravity, parallel axes, planar arms.
//!
//! Where joints share a coordinate, what the mechanism's coordinates tell less than independent ones
//! would is found by the rank of the columns at seeded states, and the figures are rounded.

mod echelon;
mod joint;
mod regroup;
mod scalar;
mod shared;
mod standard;
mod told;

use robot_symbolic::Expr;

use crate::functions::Derivation;
use crate::model::{Move, Placement, Robot};
use joint::Joint;
use regroup::{Form, Kept};
use scalar::tidied;
pub use standard::{Quantity, StandardParameter, standard_parameters};

/// The base parameters of a robot.
#[derive(Clone, Debug)]
pub struct BaseParameters<'g> {
    /// The standard parameters with their values, in the order of the full regressor's columns.
    pub standard: Vec<(StandardParameter, Expr<'g>)>,
    /// The base parameters, in the order of their columns.
    pub base: Vec<BaseParameter<'g>>,
    /// Whether figures were found at seeded states, and rounded: where joints share a coordinate and
    /// that matters.
    pub rounded: bool,
}

/// A base parameter.
#[derive(Clone, Debug)]
pub struct BaseParameter<'g> {
    /// The place of the kept standard parameter, whose column in the full regressor is this one's.
    pub column: usize,
    /// The kept standard parameter.
    pub kept: StandardParameter,
    /// A row of B: the figures of standard parameters by their places, all but those that are 0, in
    /// order. That of the kept one is 1; no other kept one occurs.
    pub terms: Vec<(usize, Expr<'g>)>,
}

impl<'g> BaseParameter<'g> {
    /// The name: that of the kept parameter, with an R where others are regrouped under it, as in
    /// `ZZR_2`.
    #[must_use]
    pub fn name(&self) -> String {
        let StandardParameter { link, quantity } = self.kept;
        format!("{}{}_{}", quantity.symbol(), self.mark(), link + 1)
    }

    /// `R` where other parameters are regrouped under the kept one.
    #[must_use]
    pub fn mark(&self) -> &'static str {
        if self.terms.len() > 1 { "R" } else { "" }
    }
}

impl<'g> BaseParameters<'g> {
    /// The values of the base parameters from those of the standard ones, in their order: B π.
    #[must_use]
    pub fn values(&self, standard: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let value = |base: &BaseParameter<'g>| {
            let terms = base
                .terms
                .iter()
                .filter_map(|(place, figure)| standard.get(*place).map(|value| *figure * *value));
            terms.reduce(|sum, term| sum + term)
        };
        self.base.iter().filter_map(value).collect()
    }

    /// The values of the base parameters in the file's parameters.
    #[must_use]
    pub fn nominal(&self) -> Vec<Expr<'g>> {
        let standard: Vec<Expr<'g>> = self.standard.iter().map(|(_, value)| *value).collect();
        self.values(&standard)
    }

    /// Standard parameters that have these base parameters, one of many: the kept ones have their
    /// values, the others are `zero`.
    #[must_use]
    pub fn representative<T: Copy>(&self, base: &[T], zero: T) -> Vec<T> {
        let mut standard = vec![zero; self.standard.len()];
        for (parameter, value) in self.base.iter().zip(base) {
            if let Some(place) = standard.get_mut(parameter.column) {
                *place = *value;
            }
        }
        standard
    }
}

/// The base parameters of a robot; `None` where [`out_of_reach`] says why.
#[must_use]
pub fn base_parameters<'g>(derivation: &Derivation<'_, 'g>) -> Option<BaseParameters<'g>> {
    if out_of_reach(derivation.robot).is_some() {
        return None;
    }
    let mechanism = &derivation.mechanism;
    let standard = standard_parameters(mechanism);
    let parameters: Vec<StandardParameter> =
        standard.iter().map(|(parameter, _)| *parameter).collect();
    let joints: Vec<Joint<'g>> = mechanism.links.iter().map(Joint::new).collect();
    let conditions = told::conditions(mechanism, &joints);
    let mut kept = regroup::regroup(mechanism, &joints, &conditions, &parameters);
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
    let base = |(column, form): Kept<'g>| BaseParameter {
        column,
        kept: parameters[column],
        terms: form.into_iter().map(|(place, figure)| (place, tidied(figure.expr))).collect(),
    };
    Some(BaseParameters { base: kept.into_iter().map(base).collect(), standard, rounded })
}

/// Why the base parameters of a robot cannot be found: its joints share coordinates, and lengths,
/// angles, gravity or ratios are parameters, so that the rank at states with given figures proves
/// nothing.
#[must_use]
pub fn out_of_reach(robot: &Robot) -> Option<&'static str> {
    (has_shared_coordinates(robot) && has_free_geometry(robot)).then_some(
        "joints share a coordinate, and lengths, axes, gravity or ratios are parameters; give them \
         figures",
    )
}

/// Whether a coordinate moves several joints, or a joint not at all.
fn has_shared_coordinates(robot: &Robot) -> bool {
    let one = robot_symbolic::Formula::number(&robot_symbolic::Rational::ONE);
    robot.links.len() != robot.coordinates.len()
        || robot.links.iter().any(|link| link.joint.ratio != one)
}

fn has_free_geometry(robot: &Robot) -> bool {
    let of_move = |step: &Move| match step {
        Move::Translate(by) => by.iter().any(|formula| formula.symbols().next().is_some()),
        Move::Rotate(_, angle) => angle.symbols().next().is_some(),
    };
    let of_placement = |Placement(steps): &Placement| steps.iter().any(of_move);
    robot.gravity.iter().any(|formula| formula.symbols().next().is_some())
        || robot.links.iter().any(|link| {
            let joint = &link.joint;
            let mut figures = joint.axis.iter().chain([&joint.ratio, &joint.offset]);
            of_placement(&link.placement)
                || figures.any(|formula| formula.symbols().next().is_some())
        })
}
