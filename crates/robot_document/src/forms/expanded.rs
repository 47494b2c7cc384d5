//! The expanded form, in which products are multiplied out, s² is replaced by 1 − c² and like terms are merged; and the
//! collected form, in which common factors of the same sums are taken out of parentheses.

use robot_dynamics::quantity::{Kind, Quantity};
use robot_symbolic::{AngleSums, Expr, Polynomial, PolynomialOptions, walk};

use super::coefficients::Coefficient;
use super::loads::{CONTACT_FORCES, friction_contributions, whole};
use super::{Equation, Form, Group, Writer, of_joint_torque, paper, vectors};
use crate::error::Error;

/// The limits of an expansion: it takes less than a second, and nobody could read more terms.
pub(super) const LIMITS: PolynomialOptions = PolynomialOptions {
    angle_sums: AngleSums::Expand,
    max_terms: 250_000,
    max_products: 2_000_000,
};
/// The largest number of terms of all equations together.
const MAX_TERMS: usize = 20_000;

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let mut quantities = writer.quantities(false);
    let joints = with_friction(writer, &mut quantities)?;
    let mut values: Vec<Expr<'_>> = quantities.iter().map(|quantity| quantity.value).collect();
    values.extend(joints.iter().map(|force| force.value));
    let polynomials =
        Polynomial::of_all(&values, &LIMITS).map_err(|error| writer.too_long(error.to_string()))?;
    let terms: usize = polynomials.iter().map(Polynomial::len).sum();
    if terms > MAX_TERMS {
        let reason = format!(
            "the expanded form has {terms} terms, more than the {MAX_TERMS} that can be printed"
        );
        return Err(writer.too_long(reason));
    }
    let (of_quantities, of_joints) = polynomials.split_at(quantities.len().min(polynomials.len()));
    let (mut forces, mut equations): (Vec<Equation>, Vec<Equation>) = (vec![], vec![]);
    let in_paper = match writer.options.paper {
        true => writer.in_paper_order(&quantities, of_quantities),
        false => vec![None; quantities.len()],
    };
    for ((quantity, polynomial), in_paper) in quantities.iter().zip(of_quantities).zip(in_paper) {
        let (name, left) = (quantity.symbol.to_string(), writer.look(quantity.symbol));
        let terms = in_paper.unwrap_or_else(|| writer.collected(polynomial));
        let ordered = match writer.options.form {
            Form::Expanded => {
                let (order, graph) = (&writer.options.order, writer.graph);
                order.count(&mut writer.differences, &name, &terms, graph);
                order.arranged(&name, &terms, graph)
            }
            _ => None,
        };
        let terms = ordered.filter(|terms| writer.is_value(terms, polynomial)).unwrap_or(terms);
        equations.push(writer.of_terms(name, left, &terms)?);
    }
    for (force, polynomial) in joints.into_iter().zip(of_joints) {
        forces.push(writer.of_collected(force.name, force.shape, polynomial)?);
    }
    let (title, introduction) = match writer.options.form {
        Form::Collected => (
            "Equations of motion, collected",
            "Each joint torque is one formula, with common factors in front of parentheses. Multiplied out, it is the expanded form, term by term.",
        ),
        _ if !writer.options.order.is_empty() => (
            "Equations of motion, expanded",
            "Each vector is preceded by the relation that defines it. Terms are in the order of the published equations; even \
             powers of sines are replaced by cosines, and like terms are merged.",
        ),
        _ if writer.options.paper => (
            "Equations of motion, expanded",
            "Each vector is preceded by the relation that defines it. Terms are in the order in which the relations yield \
             them; even powers of sines are replaced by cosines, and like terms are merged.",
        ),
        _ => (
            "Equations of motion, expanded",
            "Products are multiplied out, even powers of sines are replaced by cosines, and like terms are merged.",
        ),
    };
    let arrays = vectors::of_quantities(&quantities, &equations, writer.options.paper);
    let relations = if writer.options.paper { paper::relations(writer)? } else { vec![] };
    let group = Group::of_quantities(title, introduction.to_owned(), equations);
    Ok(vec![Group { arrays, relations, ..group }, Group::of_definitions(CONTACT_FORCES, forces)])
}

/// Adds friction to the joint torques. The joint forces that dry friction needs get names, because no line is long
/// enough for their expansion under a root.
fn with_friction<'g>(
    writer: &mut Writer<'_, 'g>,
    quantities: &mut [Quantity<'g>],
) -> Result<Vec<Coefficient<'g>>, Error> {
    let of_forces = |quantity: &Quantity<'_>| quantity.symbol.kind == Kind::JointTorque;
    if !writer.options.friction || !quantities.iter().any(of_forces) {
        return Ok(vec![]);
    }
    let (joints, contributions) = friction_contributions(writer, whole);
    for quantity in quantities {
        if let Some(contribution) = of_joint_torque(quantity, &contributions) {
            quantity.value += contribution;
        }
    }
    let used: Vec<String> = walk::symbols(&contributions)
        .into_iter()
        .map(|symbol| writer.graph.symbol_name(symbol))
        .collect();
    let mut forces = joints.coefficients;
    forces.retain(|force| used.contains(&force.name));
    for force in &forces {
        writer.define(&force.name, force.shape.clone())?;
    }
    Ok(forces)
}
