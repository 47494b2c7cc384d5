//! Definitions of common parts of several equations.

use robot_dynamics::quantity::{Kind, Quantity, Symbol};
use robot_symbolic::collected::length;
use robot_symbolic::print::{ArrangedTerm, arranged_value};
use robot_symbolic::{Expr, Graph, Id, View, walk};
use rustc_hash::{FxHashMap, FxHashSet};

use super::arranged::{is_short_product, known};
use super::compact::{moving, short_terms};
use super::letters::candidates;
use super::multiples::Multiples;
use super::naming::{Named, Worthy, worth_naming};
use super::uses::Unnamed;
use super::{Equation, Group, Writer, residues, shapes};
use crate::error::Error;
use crate::math::{Math, Script};

/// The title of joint torques that stand before definitions that use them.
const TORQUES: &str = "Joint torques in these expressions";

/// The named common parts of several equations.
pub(super) struct Definitions<'g, 'h> {
    /// The expressions that have names.
    pub(super) named: Named<'h>,
    /// Whether parts of long expressions are named only if the whole does not become shorter without these names, as it
    /// does if terms cancel.
    pub(super) is_economical: bool,
    pub(super) roots: Vec<Expr<'g>>,
    pub(super) worthy: Vec<Worthy<'g>>,
    moving: FxHashSet<Id>,
    /// Expressions that get no names.
    pub(super) unnamed: Unnamed,
    /// The names of the expressions that are defined, by their values in the graph of the names.
    names: FxHashMap<Id, Expr<'h>>,
    /// The defined expressions, by their names, with those that are omitted.
    pub(super) sources: FxHashMap<String, Id>,
    /// The names of defined sums.
    sums: Multiples<'h>,
    /// The values of names that stand for one product.
    products: FxHashMap<String, Expr<'h>>,
    /// Parts that possibly need no name.
    pending: Vec<Expr<'g>>,
    /// The joint torques that are parts of others.
    named_torques: Vec<NamedTorque<'g>>,
    /// The places of the defined ones in `named_torques`, in the order of their definition.
    defined: Vec<usize>,
    /// Roots with names; those that are parts of other expressions are defined among them.
    pub(super) entries: Vec<Root<'g>>,
}

/// An expression with the name under which it is defined.
#[derive(Clone)]
pub(super) struct Root<'g> {
    pub(super) name: String,
    pub(super) look: Math,
    pub(super) value: Expr<'g>,
}

/// A joint torque that is used under its own name.
struct NamedTorque<'g> {
    value: Expr<'g>,
    /// The value without its sign.
    part: Expr<'g>,
    symbol: Symbol,
    name: String,
    look: Math,
    /// The equation, once the quantity is defined.
    equation: Option<Equation>,
    /// Whether the equation stands before definitions that use the quantity.
    is_placed: bool,
}

/// The definitions that share a letter.
struct Section {
    letter: &'static str,
    title: &'static str,
    /// The number of definitions.
    count: usize,
    /// The definitions since the last group was closed.
    equations: Vec<Equation>,
    /// The groups before them, including joint torques that the definitions use.
    groups: Vec<Group>,
}

impl Section {
    fn close(&mut self) {
        let equations = std::mem::take(&mut self.equations);
        if !equations.is_empty() {
            self.groups.push(Group::of_definitions(self.title, equations));
        }
    }
}

impl<'g, 'h> Definitions<'g, 'h> {
    /// Finds the common parts of the roots, which get names in the graph `target`; numbers are printed with `digits`
    /// significant digits.
    pub(super) fn new(
        target: &'h Graph,
        roots: &[Expr<'g>],
        digits: Option<usize>,
    ) -> Definitions<'g, 'h> {
        Definitions {
            named: Named::new(target),
            is_economical: false,
            roots: roots.to_vec(),
            worthy: worth_naming(roots, digits),
            moving: moving(roots),
            unnamed: Unnamed::default(),
            names: FxHashMap::default(),
            sources: FxHashMap::default(),
            sums: Multiples::default(),
            products: FxHashMap::default(),
            pending: vec![],
            named_torques: vec![],
            defined: vec![],
            entries: vec![],
        }
    }

    /// Gives joint torques that are parts of other quantities or definitions their own names: `Q2`, and not `x_1` with
    /// `Q2 = x_1`.
    pub(super) fn name_torques(&mut self, writer: &Writer<'_, '_>, quantities: &[Quantity<'g>]) {
        for quantity in quantities {
            let (value, symbol) = (quantity.value, quantity.symbol);
            let part = positive(value);
            let is_worthy = self.worthy.iter().any(|one| one.expr == part);
            if symbol.kind != Kind::JointTorque || !is_worthy {
                continue;
            }
            let name = format!("{}{}", writer.options.letters.torque(), symbol.number);
            let look = match writer.look(symbol) {
                Math::Script(script) => {
                    let base = writer.options.letters.torque_sign();
                    Math::Script(Box::new(Script { base, ..*script }))
                }
                other => other,
            };
            let is_new = self.named_torques.iter().all(|torque| torque.part != part);
            if is_new && writer.symbols.is_free(&name, &look) {
                let (equation, is_placed) = (None, false);
                self.named_torques.push(NamedTorque {
                    value,
                    part,
                    symbol,
                    name,
                    look,
                    equation,
                    is_placed,
                });
            }
        }
    }

    /// The equation of a joint torque that is used under its own name, once it is defined.
    pub(super) fn torque_equation(&self, symbol: Symbol) -> Option<Equation> {
        self.named_torques.iter().find(|torque| torque.symbol == symbol)?.equation.clone()
    }

    /// The equations of quantities that do not already stand before definitions. Joint torques come before the torques
    /// that contain them.
    pub(super) fn remaining(&self, symbols: &[Symbol], equations: Vec<Equation>) -> Vec<Equation> {
        let place_of =
            |symbol: Symbol| self.named_torques.iter().position(|torque| torque.symbol == symbol);
        let all = symbols.iter().copied().zip(equations);
        let is_placed = |symbol| place_of(symbol).and_then(|place| self.named_torques.get(place));
        let (torques, others): (Vec<_>, Vec<_>) = all
            .filter(|(symbol, _)| !is_placed(*symbol).is_some_and(|torque| torque.is_placed))
            .partition(|(symbol, _)| symbol.kind == Kind::JointTorque);
        let order = |symbol| {
            let place = place_of(symbol)
                .and_then(|place| self.defined.iter().position(|one| *one == place));
            place.unwrap_or(usize::MAX)
        };
        let mut torques = torques;
        torques.sort_by_key(|(symbol, _)| order(*symbol));
        let is_torque = |symbol: &Symbol| symbol.kind == Kind::JointTorque;
        let (mut first, mut last) = (torques, others);
        if !symbols.first().is_some_and(is_torque) {
            std::mem::swap(&mut first, &mut last);
        }
        first.into_iter().chain(last).map(|(_, equation)| equation).collect()
    }

    /// Defines everything that needs a name and returns the groups of definitions.
    pub(super) fn define(&mut self, writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
        let mut groups = vec![];
        for (letters, of_state, title) in [
            (candidates::OF_PARAMETERS, false, "Combinations of parameters"),
            (candidates::OF_STATE, true, "Expressions of the state"),
        ] {
            let letter = writer.symbols.free_letter(&letters);
            let mut section =
                Section { letter, title, count: 0, equations: vec![], groups: vec![] };
            for one in self.worthy.clone() {
                let is_named = !self.unnamed.inlined.contains(&one.expr.id());
                if is_named && self.moving.contains(&one.expr.id()) == of_state {
                    self.add(one, writer, &mut section)?;
                }
            }
            if of_state {
                for root in self.roots.clone() {
                    self.name_pending_parts(root, writer, &mut section)?;
                }
            }
            for rest in std::mem::take(&mut self.pending) {
                self.emit(rest, writer, &mut section)?;
            }
            section.close();
            groups.extend(section.groups);
        }
        Ok(groups)
    }

    fn add(
        &mut self,
        Worthy { expr, is_cut }: Worthy<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        self.name_pending_parts(expr, writer, section)?;
        match is_cut && self.is_economical {
            true => self.pending.push(expr),
            false => self.emit(expr, writer, section)?,
        }
        Ok(())
    }

    /// Names the pending parts of an expression, unless the expression is shorter by a tenth without the names.
    fn name_pending_parts(
        &mut self,
        expr: Expr<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        if self.pending.is_empty() {
            return Ok(());
        }
        let within: FxHashSet<Id> = walk::reachable(&[expr]).into_iter().map(Expr::id).collect();
        let is_part = |one: &Expr<'g>| *one != expr && within.contains(&one.id());
        let (parts, others): (Vec<_>, Vec<_>) = self.pending.iter().copied().partition(is_part);
        self.pending = others;
        if parts.is_empty() {
            return Ok(());
        }
        let whole = length(&short_terms(writer, self.named.rewritten(expr)));
        // The trial names are assigned in the same order as the final ones below.
        let mut trial = self.named.clone();
        let mut apart = 0;
        for (place, part) in parts.iter().enumerate() {
            apart += length(&short_terms(writer, trial.rewritten(*part)));
            trial.name(*part, &format!("trial_{place}"));
        }
        apart += length(&short_terms(writer, trial.rewritten(expr)));
        if 10 * whole > 9 * apart {
            for part in parts {
                self.emit(part, writer, section)?;
            }
        }
        Ok(())
    }

    /// Defines an expression: names it and adds its equation.
    fn emit(
        &mut self,
        expr: Expr<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        if let Some(place) = self.named_torques.iter().position(|torque| torque.part == expr) {
            return self.emit_torque(place, writer);
        }
        let mut value = self.named.rewritten(expr);
        let mut terms = short_terms(writer, value);
        if let Some(shorter) = unfolded(writer, expr, self.named.graph)
            && length(&shorter) < length(&terms)
        {
            // Named parts of the expression cancel each other.
            value = arranged_value(&shorter, self.named.graph);
            terms = shorter;
            if self.is_economical && is_short_product(&terms) {
                self.named.replace(expr, value);
                return Ok(());
            }
        }
        if let Some(shorter) = self.without_products(writer, value, &terms) {
            value = arranged_value(&shorter, self.named.graph);
            terms = shorter;
        }
        terms = self.with_sums(writer, terms);
        let written = arranged_value(&terms, self.named.graph);
        let same = self.names.get(&written.id()).copied();
        if let Some(known) = same.or_else(|| known(&terms, self.named.graph)) {
            self.named.replace(expr, known);
            return Ok(());
        }
        if self.uses_torque(value) {
            section.close();
            let torques = Group::of_quantities(TORQUES, String::new(), self.placed());
            section.groups.push(Group { used: true, ..torques });
        }
        if let Some(place) = self.entries.iter().position(|entry| positive(entry.value) == expr) {
            let Root { name, look, value } = self.entries.swap_remove(place);
            let renamed = self.named.rewritten(value);
            section.equations.push(self.tidy(writer, name.clone(), look, renamed)?);
            self.named.name(value, &name);
            return Ok(());
        }
        if self.unnamed.omitted.contains(&expr.id()) {
            let name = format!("{OMITTED}{}", self.names.len());
            self.named.name(expr, &name);
            self.names.insert(written.id(), self.named.graph.symbol(&name));
            self.sources.insert(name, expr.id());
            return Ok(());
        }
        section.count += 1;
        let name = shapes::indexed_name(section.letter, &[section.count]);
        let letter = section.letter.chars().next().unwrap_or('x');
        writer.define(&name, shapes::indexed(letter, &[section.count]))?;
        let left = writer.symbols.look(&name);
        section.equations.push(writer.of_terms(name.clone(), left, &terms)?);
        self.named.name(expr, &name);
        self.names.insert(written.id(), self.named.graph.symbol(&name));
        match terms.as_slice() {
            [_] => drop(self.products.insert(name.clone(), written)),
            _ => self.sums.insert(written, self.named.graph.symbol(&name)),
        }
        self.sources.insert(name, expr.id());
        Ok(())
    }

    /// An equation whose right side has collected powers and sorted factors, with the names of sums that are defined.
    pub(super) fn tidy(
        &self,
        writer: &Writer<'_, '_>,
        name: String,
        left: Math,
        value: Expr<'h>,
    ) -> Result<Equation, Error> {
        let terms = self.with_sums(writer, short_terms(writer, value));
        writer.of_terms(name, left, &terms)
    }

    /// The terms with the names of sums that are defined, if they are not longer: sums that are collected can be
    /// multiples of these.
    fn with_sums(
        &self,
        writer: &Writer<'_, '_>,
        terms: Vec<ArrangedTerm<'h>>,
    ) -> Vec<ArrangedTerm<'h>> {
        let value = arranged_value(&terms, self.named.graph);
        let named = self.sums.within(value);
        if named == value {
            return terms;
        }
        let shorter = short_terms(writer, named);
        if length(&shorter) <= length(&terms) { shorter } else { terms }
    }

    /// Writes names of products as products if this makes an expression shorter by more than a fifth, because terms
    /// cancel: with x = 3 (a − b), 3 (a − b) c − x c is 0.
    fn without_products(
        &self,
        writer: &Writer<'_, '_>,
        value: Expr<'h>,
        terms: &[ArrangedTerm<'h>],
    ) -> Option<Vec<ArrangedTerm<'h>>> {
        let graph = self.named.graph;
        let names = walk::symbols(&[value]).into_iter().map(|symbol| graph.symbol_name(symbol));
        let (mut value, mut shortest) = (value, None);
        let mut least = length(terms);
        for name in names.filter(|name| self.products.contains_key(name)) {
            let of_name = |other: &str| match self.products.get(other) {
                Some(product) if other == name => *product,
                _ => graph.symbol(other),
            };
            let Some(written) = walk::rebuild(&[value], graph, of_name).pop() else { continue };
            let terms = short_terms(writer, written);
            if 5 * length(&terms) < 4 * least {
                least = length(&terms);
                value = written;
                shortest = Some(terms);
            }
        }
        shortest
    }

    /// Defines a joint torque under its own name.
    fn emit_torque(&mut self, place: usize, writer: &mut Writer<'_, '_>) -> Result<(), Error> {
        let Some(torque) = self.named_torques.get(place) else { return Ok(()) };
        let (value, symbol) = (torque.value, torque.symbol);
        writer.define(&torque.name, torque.look.clone())?;
        let left = writer.look(symbol);
        let renamed = self.named.rewritten(value);
        let equation = self.tidy(writer, symbol.to_string(), left, renamed)?;
        if let Some(torque) = self.named_torques.get_mut(place) {
            torque.equation = Some(equation);
            self.named.name(value, &torque.name);
        }
        self.defined.push(place);
        Ok(())
    }

    /// Whether an expression contains the name of a joint torque whose equation has no place yet.
    fn uses_torque(&self, value: Expr<'_>) -> bool {
        let names = walk::symbols(&[value]);
        let names: Vec<String> =
            names.into_iter().map(|symbol| value.graph().symbol_name(symbol)).collect();
        let defined = self.defined.iter().filter_map(|place| self.named_torques.get(*place));
        defined.filter(|torque| !torque.is_placed).any(|torque| names.contains(&torque.name))
    }

    /// The equations of the defined joint torques that have no place yet; they get their place now.
    fn placed(&mut self) -> Vec<Equation> {
        let mut equations = vec![];
        for place in &self.defined {
            if let Some(torque) =
                self.named_torques.get_mut(*place).filter(|torque| !torque.is_placed)
            {
                torque.is_placed = true;
                equations.extend(torque.equation.clone());
            }
        }
        equations
    }
}

/// Returns the expression without minus signs before it.
pub(super) fn positive(mut expr: Expr<'_>) -> Expr<'_> {
    while let View::Neg(inside) = expr.view() {
        expr = inside;
    }
    expr
}

/// The start of the names of omitted expressions; those of other symbols contain no spaces.
const OMITTED: &str = "omitted ";

/// Whether a name is that of an omitted expression, which is not printed.
pub(super) fn is_omitted(name: &str) -> bool {
    name.starts_with(OMITTED)
}

/// The largest number of terms with which an expression is expanded to see whether its named parts cancel.
const MAX_UNFOLDED: usize = 100;

/// The terms of an expression without names of its parts; `None` if the expression is long.
fn unfolded<'h>(
    writer: &Writer<'_, '_>,
    expr: Expr<'_>,
    target: &'h Graph,
) -> Option<Vec<ArrangedTerm<'h>>> {
    let value = residues::short_polynomial(expr, MAX_UNFOLDED)?.to_expr();
    let value = walk::rebuild(&[value], target, |name| target.symbol(name)).pop()?;
    Some(short_terms(writer, value))
}

#[cfg(test)]
mod tests {
    use crate::{EquationOptions, Form, equations};

    /// For the Stanford arm, sin q₂ q̈₁ must not be printed as −2 cos q₂ q̇₁ q̇₂ + x, where x is defined as
    /// 2 cos q₂ q̇₁ q̇₂ + sin q₂ q̈₁.
    #[test]
    fn named_parts_that_cancel_are_not_used() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/stanford.toml");
        let text = std::fs::read_to_string(path).unwrap();
        let robot = robot_model::description::read_toml(path, &text).unwrap().robot;
        let options = EquationOptions { form: Form::Compact, ..EquationOptions::default() };
        let found = equations(&robot, &options).unwrap();
        let is_motion = |name: &str| name.starts_with("x_");
        let motions: Vec<_> = found.definitions().filter(|one| is_motion(&one.name)).collect();
        assert!(motions.len() <= 41, "{}", motions.len());
        let texts: Vec<&str> = motions.iter().map(|one| one.text.as_str()).collect();
        assert!(texts.contains(&"sin(q2)*qdd1 + 2*cos(q2)*qd1*qd2"), "{texts:#?}");
        // A name that is a term by itself.
        let is_alone = |rest: &str| {
            !rest.trim_start_matches(|digit: char| digit.is_ascii_digit()).starts_with('*')
        };
        let after = |text: &str, start: &str| text.split(start).skip(1).any(is_alone);
        let cancels = |text: &&&str| after(text, "qd1^2 + x_") || after(text, "qd1*qd2 + x_");
        assert_eq!(texts.iter().find(cancels), None);
    }
}
