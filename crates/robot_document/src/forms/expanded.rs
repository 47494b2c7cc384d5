//! The expanded form: products multiplied out, angle sums resolved or kept, s² replaced by 1 − c²,
//! like terms merged.

use robot_dynamics::quantity::Kind;
use robot_symbolic::{AngleSums, Polynomial, PolynomialOptions};

use super::{Equation, Group, Writer, shapes};
use crate::error::Error;

/// What an expansion may cost: under a second, and more terms than anybody reads.
const LIMITS: PolynomialOptions = PolynomialOptions {
    angle_sums: AngleSums::Expand,
    max_terms: 250_000,
    max_products: 2_000_000,
};
/// The terms of all equations together.
const MAX_TERMS: usize = 20_000;

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let mut quantities = writer.quantities();
    if writer.options.angle_sums == AngleSums::Keep {
        // Only the economical recursion has sines and cosines of sums.
        let forces = writer.economical_forces(writer.options.friction);
        for quantity in &mut quantities {
            if quantity.symbol.kind == Kind::DrivingForce {
                let force = quantity.symbol.number.checked_sub(1).and_then(|at| forces.get(at));
                quantity.value = force.copied().unwrap_or(quantity.value);
            }
        }
    }
    let values: Vec<_> = quantities.iter().map(|quantity| quantity.value).collect();
    let polynomials = writer
        .polynomials(&values, &LIMITS)
        .map_err(|error| Error::TooLong { reason: error.to_string() })?;
    let terms: usize = polynomials.iter().map(Polynomial::len).sum();
    if terms > MAX_TERMS {
        let reason = format!(
            "the expanded form has {terms} terms, more than the {MAX_TERMS} that are printed"
        );
        return Err(Error::TooLong { reason });
    }
    let mut equations: Vec<Equation> = vec![];
    for (quantity, polynomial) in quantities.iter().zip(&polynomials) {
        let left = shapes::quantity(quantity.symbol);
        equations.push(writer.of_polynomial(quantity.symbol.to_string(), left, polynomial)?);
    }
    let introduction =
        "Products are multiplied out, even powers of sines are replaced by cosines, \
                        and like terms are merged."
            .to_owned();
    let title = "Equations of motion, expanded".to_owned();
    Ok(vec![Group { title, introduction, definitions: false, equations }])
}
