//! The dimensions of symbols and terms.

use std::collections::BTreeMap;

use robot_model::robot::{JointKind, Robot};
use robot_model::unit::Dimension;
use robot_model::variable::JointVariable;
use robot_symbolic::View;

use super::term::Term;

/// The dimension of every symbol of a robot; `None` if the file gives no unit.
pub(super) struct Dimensions {
    symbols: BTreeMap<String, Option<Dimension>>,
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
        Dimensions { symbols }
    }

    /// The dimension of a term, which is that of the product of its symbols' powers; `None` if one of them has no unit.
    ///
    /// # Errors
    ///
    /// The name of a symbol that the robot does not have.
    pub(super) fn of_term(&self, term: &Term<'_>) -> Result<Option<Dimension>, String> {
        let mut product = Some(Dimension::NONE);
        for factor in &term.factors {
            let View::Symbol(symbol) = factor.atom.view() else { continue };
            let name = factor.atom.graph().symbol_name(symbol);
            let Some(dimension) = self.symbols.get(&name) else { return Err(name) };
            let exponent = i8::try_from(factor.exponent).unwrap_or(i8::MAX);
            product = product
                .zip(*dimension)
                .map(|(product, dimension)| product.product(dimension.to_power(exponent)));
        }
        Ok(product)
    }
}
