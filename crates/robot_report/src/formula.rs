//! Formulas of the page in MathML.

use robot_document::markup::{Element, holding};
use robot_document::math::Math;
use robot_document::mathml;
use robot_document::robot::rows::DhParameter;
use robot_document::{SymbolTable, Trigonometry};
use robot_model::robot::Robot;
use robot_symbolic::{Formula, Graph};

use crate::text;

/// A formula within a line.
pub(crate) fn math(formula: &Math) -> Element {
    holding("math", mathml::formula(formula))
}

/// The layouts of the robot's symbols.
pub(crate) struct Symbols {
    /// The table of layouts; `None` if two symbols look the same, so that all are shown by their names.
    table: Option<SymbolTable>,
}

impl Symbols {
    /// The layouts of the symbols of a robot.
    pub(crate) fn of(robot: &Robot) -> Symbols {
        Symbols { table: SymbolTable::new(robot, Trigonometry::Named).ok() }
    }

    /// A symbol, given by its name.
    pub(crate) fn symbol(&self, name: &str) -> Element {
        let table = self.table.as_ref();
        table.map_or_else(|| holding("i", name), |table| math(&table.look(name)))
    }

    /// A formula of the robot file.
    pub(crate) fn formula(&self, formula: &Formula) -> Element {
        let graph = Graph::new();
        let value = formula.lower(&graph, &mut |name| graph.symbol(name));
        let look = self.table.as_ref().and_then(|table| table.expression(value).ok());
        look.map_or_else(|| holding("i", text::plain(formula)), |look| math(&look))
    }

    /// A Denavit–Hartenberg parameter; its value at joint position 0 if two symbols look the same.
    pub(crate) fn parameter(&self, parameter: &DhParameter<'_>) -> Element {
        let table = self.table.as_ref();
        let look = table.and_then(|table| parameter.shown(|value| table.expression(value)).ok());
        look.map_or_else(|| self.formula(parameter.formula), |look| math(&look))
    }
}
