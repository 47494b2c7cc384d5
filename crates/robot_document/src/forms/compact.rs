//! The compact form: what is used again has a name.

use robot_symbolic::{AngleSums, Expr, Graph, walk};
use rustc_hash::FxHashSet;

use super::naming::{Named, worth_naming};
use super::{Equation, Group, Writer, angle_sums, of_generalized_force, shapes, vectors};
use crate::error::Error;
use crate::layout::is_motion;

/// Letters for combinations of parameters, and for expressions of the state.
const PARAMETER_LETTERS: [&str; 7] = ["k", "p", "h", "A", "B", "K", "X"];
const STATE_LETTERS: [&str; 7] = ["x", "u", "y", "z", "w", "Y", "Z"];

pub(super) fn groups(writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
    let mut quantities = writer.quantities(writer.options.friction);
    let mut forces = writer.economical_forces(writer.options.friction);
    if writer.angle_sums() == AngleSums::Keep {
        forces = angle_sums::joined(&forces, writer.graph);
    }
    for quantity in &mut quantities {
        quantity.value = of_generalized_force(quantity, &forces).unwrap_or(quantity.value);
    }
    let values: Vec<Expr<'_>> = quantities.iter().map(|quantity| quantity.value).collect();
    let target = Graph::new();
    let (mut groups, named) = definitions(writer, &values, &target)?;
    let mut equations: Vec<Equation> = vec![];
    for quantity in &quantities {
        let (name, left) = (quantity.symbol.to_string(), writer.look(quantity.symbol));
        equations.push(writer.of_expression(name, left, named.rewritten(quantity.value))?);
    }
    let arrays = vectors::of_quantities(&quantities, &equations, writer.options.paper);
    let group = Group::of_quantities("Equations of motion, compact", String::new(), equations);
    groups.push(Group { arrays, ..group });
    Ok(groups)
}

/// Definitions of what `roots` use again: combinations of parameters, then expressions of the state.
pub(super) fn definitions<'h>(
    writer: &mut Writer<'_, '_>,
    roots: &[Expr<'_>],
    target: &'h Graph,
) -> Result<(Vec<Group>, Named<'h>), Error> {
    let worthy = worth_naming(roots);
    let moving = moving(roots);
    let mut named = Named::new(target);
    let mut groups = vec![];
    for (letters, of_state, title) in [
        (PARAMETER_LETTERS, false, "Combinations of parameters"),
        (STATE_LETTERS, true, "Expressions of the state"),
    ] {
        let letter = writer.symbols.free_letter(&letters);
        let shape = letter.chars().next().unwrap_or('x');
        let mut equations = vec![];
        let chosen = worthy.iter().filter(|expr| moving.contains(&expr.id()) == of_state);
        for (expr, number) in chosen.zip(1..) {
            let name = shapes::indexed_name(letter, &[number]);
            let left = shapes::indexed(shape, &[number]);
            let value = named.rewritten(*expr);
            writer.define(&name, left)?;
            let left = writer.symbols.look(&name);
            equations.push(writer.of_expression(name.clone(), left, value)?);
            named.name(*expr, &name);
        }
        groups.push(Group::of_definitions(title, equations));
    }
    Ok((groups, named))
}

/// The expressions that depend on the state.
fn moving(roots: &[Expr<'_>]) -> FxHashSet<robot_symbolic::Id> {
    let mut moving = FxHashSet::default();
    for expr in walk::reachable(roots) {
        let moves = match expr.as_symbol() {
            Some(symbol) => is_motion(&expr.graph().symbol_name(symbol)),
            None => expr.operands().iter().any(|operand| moving.contains(&operand.id())),
        };
        if moves {
            moving.insert(expr.id());
        }
    }
    moving
}
