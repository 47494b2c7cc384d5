//! The compact form, in which expressions that occur several times have names.

use robot_dynamics::quantity::{Quantity, Symbol};
use robot_symbolic::collected::{Collector, length};
use robot_symbolic::print::{ArrangedTerm, arranged_text, arranged_value};
use robot_symbolic::{AngleSums, Expr, Function, Graph, Id, Polynomial, View, walk};
use rustc_hash::FxHashSet;

use super::definitions::{Definitions, Root};
use super::naming::is_leaf;
use super::uses::{Attempt, Rare, Unnamed, printed_length, without_unused};
use super::{
    Equation, Group, Writer, angle_sums, arranged, canceled, coefficients, independent, multiples,
    numbers, of_joint_torque, residues, vectors,
};
use crate::error::Error;
use crate::layout::{BRACKETS, SymbolTable, is_motion};
use crate::math::Math;

pub(super) fn groups<'r, 'g>(writer: &mut Writer<'r, 'g>) -> Result<Vec<Group>, Error> {
    let mut quantities = writer.quantities(writer.options.friction);
    let expansion = expansion(&quantities);
    take_economical_torques(writer, &mut quantities);
    let values: Vec<Expr<'_>> = quantities.iter().map(|quantity| quantity.value).collect();
    let values = with_short_parameters(writer, &values);
    let values = numbers::rounded(writer, &values);
    let values = canceled::with_single_terms(&values, writer.graph);
    let values = canceled::without_canceled_terms(&values, writer.graph);
    let symbols = writer.symbols.clone();
    let mut groups = named(writer, &mut quantities, &values)?;
    let united = multiples::united(&values, writer.graph);
    if united != values {
        groups =
            shorter_of(writer, groups, &symbols, |writer| named(writer, &mut quantities, &united))?;
    }
    let bytes = printed_length(&groups, writer.options.digits);
    let Some(expansion) = expansion.filter(|all| could_be_shorter(writer, all, bytes)) else {
        return Ok(groups);
    };
    let collected: Vec<Vec<ArrangedTerm<'_>>> =
        expansion.iter().map(|value| writer.collected(value)).collect();
    let values: Vec<Expr<'_>> =
        collected.iter().map(|terms| arranged_value(terms, writer.graph)).collect();
    let groups =
        shorter_of(writer, groups, &symbols, |writer| named(writer, &mut quantities, &values))?;
    shorter_of(writer, groups, &symbols, |writer| {
        let equations = quantities.iter().zip(&collected).map(|(quantity, terms)| {
            writer.of_terms(quantity.symbol.to_string(), writer.look(quantity.symbol), terms)
        });
        Ok(vec![group(writer, &quantities, equations.collect::<Result<_, _>>()?)])
    })
}

/// Sets the values of joint torques to those of the economical recursion.
fn take_economical_torques<'g>(writer: &Writer<'_, 'g>, quantities: &mut [Quantity<'g>]) {
    let forces = writer.economical_forces(writer.options.friction);
    let mut forces = independent::without_velocities(writer, forces);
    if writer.angle_sums() == AngleSums::Keep {
        forces = angle_sums::joined(&forces, writer.graph);
    }
    for quantity in quantities {
        quantity.value = of_joint_torque(quantity, &forces).unwrap_or(quantity.value);
    }
}

/// The quantities, multiplied out: in the structure of the recursion, terms of different links can cancel that are in
/// different parts. `None` if one is too long or has the root of a sum that depends on the state, such as the force in a
/// joint with dry friction.
fn expansion<'g>(quantities: &[Quantity<'g>]) -> Option<Vec<Polynomial<'g>>> {
    let of_motion =
        |argument: Expr<'_>| !is_leaf(argument) && moving(&[argument]).contains(&argument.id());
    let is_root = |atom: Expr<'_>| matches!(atom.view(), View::Call(Function::Sqrt, argument) if of_motion(argument));
    let expanded = quantities.iter().map(|quantity| {
        let expanded = residues::polynomial(quantity.value, &coefficients::LIMITS).ok()?;
        let has_root = expanded.atoms().into_iter().any(is_root);
        (!has_root).then_some(expanded)
    });
    expanded.collect()
}

/// The largest number of terms of all quantities that are collected as wholes, which takes up to a second.
const MAX_COLLECTED: usize = 300;
/// The number of bytes for each term of an expansion below which equations are not compared with the collected terms.
/// Of 180 random robots, those whose collected terms were shorter had at least 8.5.
const TERM_BYTES: usize = 8;

/// The number of terms of all quantities that are always collected, because it takes no time.
const FEW_TERMS: usize = 40;

/// Whether collected quantities could be shorter than equations with so many bytes.
fn could_be_shorter<'g>(
    writer: &Writer<'_, 'g>,
    expansion: &[Polynomial<'g>],
    bytes: usize,
) -> bool {
    let terms: usize = expansion.iter().map(|value| writer.with_decimals(value).len()).sum();
    terms <= MAX_COLLECTED && (terms <= FEW_TERMS || TERM_BYTES * terms <= bytes)
}

/// The shorter equations: these, or those that `write` writes with the symbols that are known before.
fn shorter_of<'r, 'g>(
    writer: &mut Writer<'r, 'g>,
    groups: Vec<Group>,
    symbols: &SymbolTable,
    write: impl FnOnce(&mut Writer<'r, 'g>) -> Result<Vec<Group>, Error>,
) -> Result<Vec<Group>, Error> {
    let known = std::mem::replace(&mut writer.symbols, symbols.clone());
    let (others, digits) = (write(writer)?, writer.options.digits);
    if printed_length(&others, digits) < printed_length(&groups, digits) {
        return Ok(others);
    }
    writer.symbols = known;
    Ok(groups)
}

/// The group of the quantities.
fn group(writer: &Writer<'_, '_>, quantities: &[Quantity<'_>], all: Vec<Equation>) -> Group {
    let arrays = vectors::of_quantities(quantities, &all, writer.options.paper);
    let group = Group::of_quantities("Equations of motion, compact", String::new(), all);
    Group { arrays, ..group }
}

/// Writes quantities with these values, with names for common parts.
fn named<'r, 'g>(
    writer: &mut Writer<'r, 'g>,
    quantities: &mut [Quantity<'g>],
    values: &[Expr<'g>],
) -> Result<Vec<Group>, Error> {
    for (quantity, value) in quantities.iter_mut().zip(values) {
        quantity.value = *value;
    }
    let quantities: &[Quantity<'g>] = quantities;
    let symbols = writer.symbols.clone();
    let attempt = |writer: &mut Writer<'r, 'g>, inlined: &FxHashSet<Id>| {
        writer.symbols = symbols.clone();
        without_unused(writer, |writer, mut unnamed| {
            unnamed.inlined.extend(inlined);
            let target = Graph::new();
            let (groups, list) = written(writer, (quantities, values), &target, unnamed)?;
            let (uses, more) = (list.uses(&groups), list.rarely_used(&groups));
            Ok(Attempt { groups, uses, more })
        })
    };
    let mut inlined = FxHashSet::default();
    let (mut groups, mut rare) = attempt(writer, &inlined)?;
    let digits = writer.options.digits;
    // What is written in place can leave other names that are rarely used.
    for _ in 0..ROUNDS {
        let known = writer.symbols.clone();
        let Some(found) =
            shorter(&groups, &rare, (&inlined, digits), |more| attempt(writer, more))?
        else {
            writer.symbols = known;
            break;
        };
        (groups, rare, inlined) = found;
    }
    Ok(groups)
}

/// The largest number of times that names are sought that are rarely used.
const ROUNDS: usize = 3;

/// The equations, the names in them that are rarely used, and the expressions that have no names.
type Found = (Vec<Group>, Rare, FxHashSet<Id>);

/// The equations as `attempt` writes them without names that are rarely used, in addition to those `inlined`; `None` if
/// they are longer.
fn shorter(
    groups: &[Group],
    rare: &Rare,
    (inlined, digits): (&FxHashSet<Id>, Option<usize>),
    mut attempt: impl FnMut(&FxHashSet<Id>) -> Result<(Vec<Group>, Rare), Error>,
) -> Result<Option<Found>, Error> {
    for more in rare.iter().filter(|more| !more.is_subset(inlined)) {
        let inlined: FxHashSet<Id> = inlined.union(more).copied().collect();
        let (shorter, rare) = attempt(&inlined)?;
        if printed_length(&shorter, digits) <= printed_length(groups, digits) {
            return Ok(Some((shorter, rare, inlined)));
        }
    }
    Ok(None)
}

/// Writes quantities with their values, with names for common parts except those `unnamed`. Returns the groups and
/// the definitions.
fn written<'g, 'h>(
    writer: &mut Writer<'_, 'g>,
    (quantities, values): (&[Quantity<'g>], &[Expr<'g>]),
    target: &'h Graph,
    unnamed: Unnamed,
) -> Result<(Vec<Group>, Definitions<'g, 'h>), Error> {
    let mut list = Definitions::new(target, values, writer.options.digits);
    list.is_economical = true;
    list.unnamed = unnamed;
    list.name_torques(writer, quantities);
    let mut groups = list.define(writer)?;
    let mut equations: Vec<Equation> = vec![];
    for quantity in quantities {
        let (name, left) = (quantity.symbol.to_string(), writer.look(quantity.symbol));
        equations.push(match list.torque_equation(quantity.symbol) {
            Some(equation) => equation,
            None => list.tidy(writer, name, left, list.named.rewritten(quantity.value))?,
        });
    }
    let symbols: Vec<Symbol> = quantities.iter().map(|quantity| quantity.symbol).collect();
    let group = group(writer, quantities, equations);
    let equations = list.remaining(&symbols, group.equations);
    groups.push(Group { equations, ..group });
    Ok((groups, list))
}

/// Defines the common parts of `roots`, except those `unnamed`: first combinations of parameters, then expressions of the
/// state. A root that is part of others is defined among them under its own name, which the writer must already know.
pub(super) fn definitions<'g, 'h>(
    writer: &mut Writer<'_, '_>,
    roots: Vec<Root<'g>>,
    target: &'h Graph,
    unnamed: Unnamed,
) -> Result<(Vec<Group>, Definitions<'g, 'h>), Error> {
    let values: Vec<Expr<'_>> = roots.iter().map(|root| root.value).collect();
    let mut list = Definitions::new(target, &values, writer.options.digits);
    list.unnamed = unnamed;
    list.entries = roots;
    let groups = list.define(writer)?;
    Ok((groups, list))
}

/// The largest number of terms of a sum that is multiplied out to be collected.
const MAX_TERMS: usize = 60;

/// An equation whose right side has collected powers and sorted factors. Common factors are taken out of parentheses if
/// this needs no more operations.
pub(super) fn tidy(
    writer: &Writer<'_, '_>,
    name: String,
    left: Math,
    value: Expr<'_>,
) -> Result<Equation, Error> {
    let terms = short_terms(writer, value);
    writer.of_terms(name, left, &terms)
}

/// The terms of an expression in the structure in which it was built or, if that is shorter and needs no more
/// operations, collected.
pub(super) fn short_terms<'h>(writer: &Writer<'_, '_>, value: Expr<'h>) -> Vec<ArrangedTerm<'h>> {
    let built = arranged::factored(arranged::terms(value, &writer.order), &writer.order);
    let Some(polynomial) = residues::short_polynomial(value, MAX_TERMS) else { return built };
    // An expression with sines of sums keeps its structure.
    if walk::reachable(&[value]).iter().any(|part| is_of_sum(*part)) {
        return built;
    }
    let collector = Collector { angles: &[], factors: true, double_angles: false };
    let collected = collector.collect(&polynomial, |atom| writer.order.rank(atom), &BRACKETS);
    // Among equally long forms, the collector can choose one with an additional product.
    let collected = arranged::positive_first(arranged::factored(collected, &writer.order));
    let bytes = |terms: &[ArrangedTerm<'_>]| arranged_text(terms).map_or(0, |text| text.len());
    let (new, old) = (length(&collected), length(&built));
    let is_shorter = new < old
        && arranged::operations(&collected) <= arranged::operations(&built)
        // A few symbols fewer with longer numbers and names are no gain.
        && (10 * new < 9 * old || bytes(&collected) <= bytes(&built));
    if is_shorter { collected } else { built }
}

/// Whether an expression is the sine or cosine of something other than a symbol or a number.
fn is_of_sum(expr: Expr<'_>) -> bool {
    let View::Call(Function::Sin | Function::Cos, argument) = expr.view() else { return false };
    !is_leaf(argument)
}

/// Writes each part of the expressions that contains only parameters in its shortest form: sums of pseudo-inertias
/// become the moments of inertia that they stand for.
fn with_short_parameters<'g>(writer: &Writer<'_, 'g>, roots: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let moving = moving(roots);
    walk::rebuild_above(roots, writer.graph, |part| {
        if moving.contains(&part.id()) || is_leaf(part) {
            return None;
        }
        let terms = short_terms(writer, part);
        Some(arranged_value(&terms, writer.graph))
    })
}

/// The expressions that depend on the state.
pub(super) fn moving(roots: &[Expr<'_>]) -> FxHashSet<Id> {
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

#[cfg(test)]
mod tests {
    use robot_model::description::read_toml;

    use crate::{EquationOptions, Form, equations};

    /// Two links; `second` has the joint and the origin of the second one.
    fn robot(second: &str) -> robot_model::robot::Robot {
        let text = format!(
            "format = 1\n[robot]\nname = \"two\"\ngravity = [0, -9.81, 0]\n[parameters]\nm = 1\nl = 0.4\n\
             [[link]]\nname = \"1\"\njoint = {{ type = \"revolute\", axis = [1, 2, 2] }}\nmass = \"m\"\n\
             center_of_mass = [0.1, 0, 0.2]\ninertia = {{ xx = 0.1, yy = 0.2, zz = 0.25 }}\n\
             [[link]]\nname = \"2\"\n{second}mass = 2\ncenter_of_mass = [0, \"l\", 0]\n\
             inertia = {{ xx = 0.1, yy = 0.12, zz = 0.15 }}\n"
        );
        read_toml("two.toml", &text).unwrap().robot
    }

    #[test]
    fn compact_equations_are_not_longer_than_collected_ones() {
        let mut shorter = 0;
        for second in [
            "joint = { type = \"revolute\", axis = \"z\" }\norigin = { xyz = [\"l\", 0, 0] }\n",
            "joint = { type = \"prismatic\", axis = [1, 1, 0] }\n",
            "joint = { type = \"prismatic\", axis = \"x\" }\norigin = { xyz = [0, \"l\", 0.1] }\n",
            "joint = { type = \"revolute\", axis = [0, 0.6, 0.8] }\n",
            // A length that is a root.
            "joint = { type = \"revolute\", axis = \"z\" }\norigin = { xyz = [\"sqrt(l^2 + 0.09)\", 0, 0] }\n",
        ] {
            let robot = robot(second);
            let bytes = |form| {
                let digits = Some(10);
                let options = EquationOptions { form, digits, ..EquationOptions::default() };
                let found = equations(&robot, &options).unwrap();
                super::printed_length(&found.groups, digits)
            };
            let [compact, collected] = [Form::Compact, Form::Collected].map(bytes);
            assert!(compact <= collected, "{second}: {compact} > {collected}");
            shorter += usize::from(compact < collected);
        }
        assert!(shorter > 0);
    }
}
