//! The recursive form: the paper's iterations link by link, with each quantity in terms of earlier ones.

use robot_dynamics::mechanism::Mechanism;
use robot_dynamics::newton_euler::{NewtonEuler, newton_euler};
use robot_dynamics::quantity::{Kind, Symbol};
use robot_dynamics::vector::Vector;
use robot_model::functions::Effects;
use robot_symbolic::{Expr, Graph, Number, View};
use rustc_hash::FxHashSet;

use super::compact::{definitions, tidy};
use super::definitions::{Definitions, Root, positive};
use super::letters::candidates;
use super::naming::{Named, is_leaf, is_long_constant};
use super::uses::{Attempt, Unnamed, without_unused};
use super::vectors::{cell, column};
use super::{Cell, Equation, Group, Writer, joint_torque, numbers, residues, shapes};
use crate::error::Error;
use crate::math::Math;

pub(super) fn groups<'r, 'g>(writer: &mut Writer<'r, 'g>) -> Result<Vec<Group>, Error> {
    let effects = Effects { wrench: true, friction: writer.options.friction };
    let mut mechanism = writer.derivation().mechanism;
    numbers::round_links(writer, &mut mechanism);
    let masses = masses_by_name(writer, &mut mechanism);
    let iterations = newton_euler(&mechanism, effects);
    let write = |writer: &mut Writer<'r, 'g>, unnamed| {
        written(writer, (&mechanism, &masses), &iterations, unnamed)
    };
    let (groups, ()) = without_unused(writer, write)?;
    Ok(groups)
}

/// The masses that are short numbers, with the symbols that replace them in the mechanism: the moment of a force is then
/// the product of a lever and the force, and not that of a number and an acceleration, and the force of 1 kg is not
/// the acceleration.
fn masses_by_name<'g>(
    writer: &Writer<'_, 'g>,
    mechanism: &mut Mechanism<'g>,
) -> Vec<(Expr<'g>, Number)> {
    let digits = writer.options.digits;
    let mut masses = vec![];
    for (link, place) in mechanism.links.iter_mut().zip(1..) {
        let number = link.mass.as_number().filter(|number| !number.is_zero());
        if let Some(number) = number.filter(|_| !is_long_constant(link.mass, digits)) {
            // Symbols of the robot contain no spaces.
            link.mass = writer.graph.symbol(&format!("mass {place}"));
            masses.push((link.mass, number));
        }
    }
    masses
}

/// Writes the iterations with names for common parts except those `unnamed`.
fn written<'g>(
    writer: &mut Writer<'_, 'g>,
    (mechanism, masses): (&Mechanism<'g>, &[(Expr<'g>, Number)]),
    iterations: &NewtonEuler<'g>,
    unnamed: Unnamed,
) -> Result<Attempt<()>, Error> {
    let target = Graph::new();
    let (mut groups, mut list) = link_values(writer, mechanism, &target, unnamed)?;
    let named = &mut list.named;
    for (mass, number) in masses {
        named.replace(*mass, target.number(number.clone()));
    }
    let mut printed = FxHashSet::default();
    for (index, motion) in iterations.motions.iter().enumerate() {
        let number = index + 1;
        let mut group = Vectors::new(&format!("Link {number}, outward"));
        let paper = |kind| Look::Paper(kind);
        for (name, look, vector) in [
            ("omega", Look::Letter('ω'), motion.angular_velocity),
            ("epsilon", Look::Letter('ε'), motion.angular_acceleration),
            ("a", Look::Letter('a'), motion.acceleration),
            ("a_c", paper(Kind::CenterOfMassAcceleration), motion.center_of_mass_acceleration),
            ("F", paper(Kind::Force), motion.force),
            ("M_c", paper(Kind::Moment), motion.moment),
        ] {
            group.add(writer, named, (name, look, number), vector, &mut printed)?;
        }
        groups.push(group.0);
    }
    for (index, wrench) in iterations.wrenches.iter().enumerate().rev() {
        let number = index + 1;
        let mut group = Vectors::new(&format!("Link {number}, inward"));
        for (name, kind, vector) in
            [("F_l", Kind::LinkForce, wrench.force), ("M_l", Kind::LinkMoment, wrench.moment)]
        {
            let look = Look::Paper(kind);
            group.add(writer, named, (name, look, number), vector, &mut printed)?;
        }
        groups.push(group.0);
    }
    groups.push(joint_torques(writer, &iterations.joint_torques, named)?);
    leave_unused(&mut groups);
    let uses = list.uses(&groups);
    Ok(Attempt { groups, uses, more: () })
}

/// Removes the values of links that no equation needs, such as moments of inertia about axes that do not turn.
fn leave_unused(groups: &mut [Group]) {
    let Some((links, others)) = groups.split_first_mut() else { return };
    let used = others.iter().flat_map(|group| &group.equations);
    let mut used: FxHashSet<String> =
        used.flat_map(|equation| equation.right.symbols()).map(str::to_owned).collect();
    let mut kept: Vec<Equation> = vec![];
    for equation in std::mem::take(&mut links.equations).into_iter().rev() {
        if used.contains(&equation.name) {
            used.extend(equation.right.symbols().into_iter().map(str::to_owned));
            kept.push(equation);
        }
    }
    kept.reverse();
    links.equations = kept;
}

/// Defines the masses, centers of mass and inertia tensors of the links whose values are more than a number or a
/// symbol.
fn link_values<'g, 'h>(
    writer: &mut Writer<'_, '_>,
    mechanism: &Mechanism<'g>,
    target: &'h Graph,
    unnamed: Unnamed,
) -> Result<(Vec<Group>, Definitions<'g, 'h>), Error> {
    let letter = writer.symbols.free_letter(&candidates::LINK_MASS);
    let mut link_values: Vec<(String, Math, Expr<'g>)> = vec![];
    for (link, number) in mechanism.links.iter().zip(1..) {
        let shape = shapes::indexed(letter.chars().next().unwrap_or('m'), &[number]);
        link_values.push((shapes::indexed_name(letter, &[number]), shape, link.mass));
        for (component, value) in link.center_of_mass.0.into_iter().enumerate() {
            let name = format!("r{number}.{}", shapes::axis_name(component));
            link_values.push((name, shapes::component('r', number, &[component]), value));
        }
        for (row, column) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)] {
            let axes = [shapes::axis_name(row), shapes::axis_name(column)].concat();
            let shape = shapes::component('J', number, &[row, column]);
            link_values.push((format!("J{number}.{axes}"), shape, link.inertia.0[row][column]));
        }
    }
    let digits = writer.options.digits;
    link_values
        .retain(|(_, _, value)| !is_leaf(*value) || is_long_constant(positive(*value), digits));
    let mut roots = vec![];
    for (name, shape, value) in &link_values {
        writer.define(name, shape.clone())?;
        roots.push(Root { name: name.clone(), look: shape.clone(), value: *value });
    }
    // Numbers do not depend on each other.
    let is_plain = link_values.iter().all(|(_, _, value)| is_leaf(*value));
    let order: Vec<String> = link_values.iter().map(|(name, _, _)| name.clone()).collect();
    let (groups, mut list) = definitions(writer, roots, target, unnamed)?;
    let named = &mut list.named;
    let mut all: Vec<Equation> = groups.into_iter().flat_map(|group| group.equations).collect();
    for (name, left, expr) in link_values {
        if all.iter().all(|equation| equation.name != name) {
            let value = named.rewritten(expr);
            all.push(tidy(writer, name.clone(), left, value)?);
            named.name(expr, &name);
        }
    }
    if is_plain {
        all.sort_by_key(|equation| order.iter().position(|name| *name == equation.name));
    }
    Ok((vec![Group::of_definitions("Parameters of the links", all)], list))
}

/// The layout of a vector's components.
#[derive(Clone, Copy)]
enum Look {
    Letter(char),
    Paper(Kind),
}

impl Look {
    fn vector(self, number: usize) -> Math {
        match self {
            Look::Letter(letter) => {
                Math::Letter(letter).with_bar().with_upper(Math::integer(number))
            }
            Look::Paper(kind) => Math::vector(kind, number),
        }
    }

    fn shape(self, number: usize, component: usize) -> Math {
        match self {
            Look::Letter(letter) => shapes::component(letter, number, &[component]),
            Look::Paper(kind) => {
                Math::quantity(Symbol { kind, number, component: Some(component) })
            }
        }
    }
}

/// A group of vectors.
struct Vectors(Group);

impl Vectors {
    fn new(title: &str) -> Vectors {
        let group = Group::of_definitions(title, vec![]);
        Vectors(Group { arrays: Some(vec![]), ..group })
    }

    /// Adds the equations of the components of a vector. Components that are only a number or a symbol are printed but
    /// get no name, so their value is used directly in later equations.
    ///
    /// A vector of numbers and symbols gets no column if a component is only another name, if the vector is 0, or if
    /// the same vector was `printed` before.
    fn add(
        &mut self,
        writer: &mut Writer<'_, '_>,
        named: &mut Named<'_>,
        (name, look, number): (&str, Look, usize),
        vector: Vector<'_>,
        printed: &mut FxHashSet<Vec<String>>,
    ) -> Result<(), Error> {
        let (mut cells, mut leaves) = (vec![], vec![]);
        let mut has_own_names = false;
        for (component, expr) in vector.0.into_iter().enumerate() {
            let name = format!("{name}{number}.{}", shapes::axis_name(component));
            let value = named.rewritten(expr);
            // A force that is a mass of 1 kg times an acceleration is not another name of the acceleration.
            let is_own = !(value.is_zero() || is_leaf(expr) || named.has(expr));
            has_own_names |= is_own;
            let is_plain = !is_own && is_known(writer, value);
            writer.define(&name, look.shape(number, component))?;
            let left = writer.symbols.look(&name);
            let equation = sum(writer, name.clone(), left, value)?;
            if is_leaf(value) {
                leaves.push(equation.text.clone());
            }
            cells.push(cell(&equation, is_plain));
            self.0.equations.push(equation);
            if !is_leaf(expr) {
                named.name(expr, &name);
            }
        }
        let is_short = leaves.len() == cells.len();
        let is_zero = leaves.iter().all(|text| text == "0");
        let is_other = is_zero || cells.iter().any(is_name);
        let is_known = is_short && !has_own_names && (is_other || !printed.insert(leaves));
        if let Some(arrays) = self.0.arrays.as_mut().filter(|_| !is_known) {
            let left = look.vector(number);
            arrays.push(column(format!("{name}{number}"), left, cells.into_iter()));
        }
        Ok(())
    }
}

/// Whether a component is only another name, and not 0.
fn is_name(cell: &Cell) -> bool {
    cell.is_plain && cell.whole.as_ref().is_some_and(|whole| whole.text != "0")
}

/// Whether a value is 0 or a defined symbol, possibly with the opposite sign.
fn is_known(writer: &Writer<'_, '_>, value: Expr<'_>) -> bool {
    match value.view() {
        View::Neg(inside) => is_known(writer, inside),
        View::Symbol(symbol) => writer.symbols.is_defined(&value.graph().symbol_name(symbol)),
        _ => value.is_zero(),
    }
}

fn joint_torques(
    writer: &Writer<'_, '_>,
    forces: &[Expr<'_>],
    named: &Named<'_>,
) -> Result<Group, Error> {
    let mut equations = vec![];
    for (index, force) in forces.iter().enumerate() {
        let symbol = joint_torque(index);
        let value = named.rewritten(*force);
        equations.push(sum(writer, symbol.to_string(), Math::quantity(symbol), value)?);
    }
    Ok(Group::of_quantities("Joint torques", String::new(), equations))
}

/// The largest number of terms of an equation that is multiplied out.
const MAX_TERMS: usize = 40;

/// The equation with a short sum of products or, if the sum is long, with the expression as it was built.
fn sum(
    writer: &Writer<'_, '_>,
    name: String,
    left: Math,
    value: Expr<'_>,
) -> Result<Equation, Error> {
    match residues::short_polynomial(value, MAX_TERMS) {
        Some(polynomial) => writer.of_polynomial(name, left, &polynomial),
        None => {
            let rounded = numbers::rounded(writer, &[value]).pop().unwrap_or(value);
            writer.of_expression(name, left, rounded)
        }
    }
}
