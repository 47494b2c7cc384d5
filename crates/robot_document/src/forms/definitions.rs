//! The definitions of what several equations have in common.

use robot_dynamics::quantity::{Kind, Quantity, Symbol};
use robot_symbolic::collected::length;
use robot_symbolic::{Expr, Graph, Id, walk};
use rustc_hash::FxHashSet;

use super::compact::{moving, short_terms, tidy};
use super::naming::{Named, Worthy, worth_naming};
use super::{Equation, Group, Writer, shapes};
use crate::error::Error;
use crate::math::{Math, Script};

/// Letters for combinations of parameters, and for expressions of the state.
const PARAMETER_LETTERS: [&str; 7] = ["k", "p", "h", "A", "B", "K", "X"];
const STATE_LETTERS: [&str; 7] = ["x", "u", "y", "z", "w", "Y", "Z"];

/// What several equations have in common, with names.
pub(super) struct Definitions<'g, 'h> {
    /// What has names.
    pub(super) named: Named<'h>,
    /// Whether parts of long expressions are named only if the whole does not become shorter without, as it does if
    /// terms cancel.
    pub(super) is_economical: bool,
    roots: Vec<Expr<'g>>,
    worthy: Vec<Worthy<'g>>,
    moving: FxHashSet<Id>,
    /// Parts that may need no name.
    pending: Vec<Expr<'g>>,
    /// The quantities that are parts of others.
    own: Vec<Own<'g>>,
}

/// A quantity that is known by its own name.
struct Own<'g> {
    value: Expr<'g>,
    symbol: Symbol,
    name: String,
    look: Math,
    /// Its equation, once it is defined.
    right: Option<Equation>,
}

/// The definitions with one letter.
struct Section {
    letter: &'static str,
    equations: Vec<Equation>,
}

impl<'g, 'h> Definitions<'g, 'h> {
    /// What the roots have in common, with names in another graph.
    pub(super) fn new(target: &'h Graph, roots: &[Expr<'g>]) -> Definitions<'g, 'h> {
        Definitions {
            named: Named::new(target),
            is_economical: false,
            roots: roots.to_vec(),
            worthy: worth_naming(roots),
            moving: moving(roots),
            pending: vec![],
            own: vec![],
        }
    }

    /// Joint torques that other quantities contain, but no other definition, are known by their own names: `Q2`, not
    /// `x_1` with `Q2 = x_1`.
    pub(super) fn own_names(&mut self, writer: &Writer<'_, '_>, quantities: &[Quantity<'g>]) {
        for quantity in quantities {
            let (value, symbol) = (quantity.value, quantity.symbol);
            let has = |other: &Worthy<'g>| {
                other.expr != value && walk::reachable(&[other.expr]).contains(&value)
            };
            let is_worthy = self.worthy.iter().any(|one| one.expr == value);
            let is_torque = symbol.kind == Kind::GeneralizedForce;
            if !is_torque || !is_worthy || self.worthy.iter().any(has) {
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
            let is_new = self.own.iter().all(|own| own.value != value);
            if is_new && writer.symbols.is_free(&name, &look) {
                self.own.push(Own { value, symbol, name, look, right: None });
            }
        }
    }

    /// The equation of a quantity that is known by its own name.
    pub(super) fn own_equation(&self, symbol: Symbol, left: &Math) -> Option<Equation> {
        let own = self.own.iter().find(|own| own.symbol == symbol)?;
        let Equation { text, right, .. } = own.right.clone()?;
        Some(Equation { name: symbol.to_string(), text, left: left.clone(), right })
    }

    /// Puts joint torques that others contain before these.
    pub(super) fn first_what_is_used(&self, symbols: &[Symbol], equations: &mut [Equation]) {
        let is_torque = |symbol: &&Symbol| symbol.kind == Kind::GeneralizedForce;
        let Some(start) = symbols.iter().position(|symbol| is_torque(&symbol)) else { return };
        let count = symbols.iter().skip(start).take_while(is_torque).count();
        let names: Vec<String> = self.own.iter().map(|own| own.symbol.to_string()).collect();
        if let Some(torques) = equations.get_mut(start..start + count) {
            torques.sort_by_key(|equation| !names.contains(&equation.name));
        }
    }

    /// The groups of definitions.
    pub(super) fn define(&mut self, writer: &mut Writer<'_, '_>) -> Result<Vec<Group>, Error> {
        let mut groups = vec![];
        for (letters, of_state, title) in [
            (PARAMETER_LETTERS, false, "Combinations of parameters"),
            (STATE_LETTERS, true, "Expressions of the state"),
        ] {
            let letter = writer.symbols.free_letter(&letters);
            let mut section = Section { letter, equations: vec![] };
            for one in self.worthy.clone() {
                if self.moving.contains(&one.expr.id()) == of_state {
                    self.add(one, writer, &mut section)?;
                }
            }
            if of_state {
                for root in self.roots.clone() {
                    self.settle(root, writer, &mut section)?;
                }
            }
            for rest in std::mem::take(&mut self.pending) {
                self.emit(rest, writer, &mut section)?;
            }
            groups.push(Group::of_definitions(title, section.equations));
        }
        Ok(groups)
    }

    fn add(
        &mut self,
        Worthy { expr, is_cut }: Worthy<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        self.settle(expr, writer, section)?;
        match is_cut && self.is_economical {
            true => self.pending.push(expr),
            false => self.emit(expr, writer, section)?,
        }
        Ok(())
    }

    /// Names the pending parts of an expression, unless it is shorter by a tenth without.
    fn settle(
        &mut self,
        expr: Expr<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        let within = walk::reachable(&[expr]);
        let is_part = |one: &Expr<'g>| *one != expr && within.contains(one);
        let (parts, others): (Vec<_>, Vec<_>) = self.pending.iter().copied().partition(is_part);
        self.pending = others;
        if parts.is_empty() {
            return Ok(());
        }
        let whole = length(&short_terms(writer, self.named.rewritten(expr)));
        // Names for a trial, in the order in which they are given below.
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

    /// Defines an expression.
    fn emit(
        &mut self,
        expr: Expr<'g>,
        writer: &mut Writer<'_, '_>,
        section: &mut Section,
    ) -> Result<(), Error> {
        let value = self.named.rewritten(expr);
        if let Some(place) = self.own.iter().position(|own| own.value == expr) {
            let (name, look) = (self.own[place].name.clone(), self.own[place].look.clone());
            self.own[place].right = Some(tidy(writer, name.clone(), look.clone(), value)?);
            writer.define(&name, look)?;
            self.named.name(expr, &name);
            return Ok(());
        }
        let number = section.equations.len() + 1;
        let name = shapes::indexed_name(section.letter, &[number]);
        let letter = section.letter.chars().next().unwrap_or('x');
        writer.define(&name, shapes::indexed(letter, &[number]))?;
        let left = writer.symbols.look(&name);
        section.equations.push(tidy(writer, name.clone(), left, value)?);
        self.named.name(expr, &name);
        Ok(())
    }
}
