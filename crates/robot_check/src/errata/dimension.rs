//! The dimensions of symbols and terms.

use std::collections::{BTreeMap, BTreeSet};

use robot_model::robot::{JointKind, Robot};
use robot_model::unit::Dimension;
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Formula, Function, View, walk};

use super::term::Term;

/// The dimension of every symbol of a robot; `None` if the file gives no unit.
pub(super) struct Dimensions {
    symbols: BTreeMap<String, Option<Dimension>>,
    /// The symbols in the robot's friction.
    friction: BTreeSet<String>,
}

impl Dimensions {
    pub(super) fn of(robot: &Robot) -> Dimensions {
        let mut symbols = BTreeMap::new();
        for (index, coordinate) in robot.coordinates.iter().enumerate() {
            let length = match coordinate.kind {
                JointKind::Revolute => 0,
                JointKind::Prismatic => 1,
            };
            for variable in JointVariable::MOTION {
                let dimension = variable.order().map(|order| Dimension::new(0, length, -order));
                symbols.insert(variable.symbol(index), dimension);
            }
        }
        for parameter in &robot.parameters {
            let dimension = parameter.unit.as_ref().map(|unit| unit.dimension);
            symbols.insert(parameter.name.clone(), dimension);
        }
        for (_, wrench) in robot.tips() {
            for name in &wrench.force {
                symbols.insert(name.clone(), Some(Dimension::FORCE));
            }
            for name in &wrench.moment {
                symbols.insert(name.clone(), Some(Dimension::MOMENT));
            }
        }
        Dimensions { symbols, friction: of_friction(robot) }
    }

    /// The symbols that only the robot's friction has, given the derived terms.
    pub(super) fn of_friction_alone<'t, 'g: 't>(
        &self,
        derived: impl Iterator<Item = &'t Term<'g>>,
    ) -> BTreeSet<String> {
        let mut alone = self.friction.clone();
        for factor in derived.flat_map(|term| &term.factors) {
            for part in walk::reachable(&[factor.atom]) {
                if let Some(symbol) = part.as_symbol() {
                    alone.remove(&*part.graph().symbol_name(symbol));
                }
            }
        }
        alone
    }

    /// The dimension of a term, which is that of the product of its symbols' powers; `None` if a factor has an unknown
    /// dimension.
    ///
    /// # Errors
    ///
    /// The names of the symbols that the robot does not have.
    pub(super) fn of_term(&self, term: &Term<'_>) -> Result<Option<Dimension>, BTreeSet<String>> {
        let unknown: BTreeSet<String> =
            term.factors.iter().flat_map(|factor| self.unknown(factor.atom)).collect();
        if !unknown.is_empty() {
            return Err(unknown);
        }
        let mut product = Some(Dimension::NONE);
        for factor in &term.factors {
            let exponent = i8::try_from(factor.exponent).unwrap_or(i8::MAX);
            product = product
                .zip(self.of_atom(factor.atom))
                .map(|(product, dimension)| product.product(dimension.to_power(exponent)));
        }
        Ok(product)
    }

    /// The dimension of a symbol or function; `None` if it is unknown.
    fn of_atom(&self, atom: Expr<'_>) -> Option<Dimension> {
        match atom.view() {
            View::Symbol(symbol) => {
                self.symbols.get(&*atom.graph().symbol_name(symbol)).copied().flatten()
            }
            View::Pi
            | View::Call(Function::Sin | Function::Cos | Function::Sign | Function::Tanh, _) => {
                Some(Dimension::NONE)
            }
            _ => None,
        }
    }

    /// The names of the symbols in a factor that the robot does not have.
    fn unknown(&self, atom: Expr<'_>) -> Vec<String> {
        let symbols = walk::symbols(&[atom]).into_iter();
        let names = symbols.map(|symbol| atom.graph().symbol_name(symbol).to_string());
        names.filter(|name| !self.symbols.contains_key(name.as_str())).collect()
    }

    /// Whether the dimensions of some derived terms are known, and all of these are the dimensions of their quantities.
    /// Each equation is given by its terms and the dimension of its quantity. If a term has another dimension, its
    /// coefficient has a dimension, as with numbers in place of masses and lengths, and so may the coefficient of any
    /// printed term.
    pub(super) fn terms_have_units<'t, 'g: 't>(
        &self,
        derived: impl Iterator<Item = (&'t [Term<'g>], Dimension)>,
    ) -> bool {
        let known = derived.flat_map(|(terms, expected)| {
            let known = terms.iter().filter_map(|term| self.of_term(term).ok()?);
            known.map(move |dimension| dimension == expected)
        });
        let mut known = known.peekable();
        known.peek().is_some() && known.all(|agrees| agrees)
    }
}

/// The symbols in the robot's friction.
fn of_friction(robot: &Robot) -> BTreeSet<String> {
    let formulas = robot.links.iter().flat_map(|link| link.friction.formulas());
    formulas.flat_map(Formula::symbols).map(|(name, _)| name.to_owned()).collect()
}
