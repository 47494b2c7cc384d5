//! Columns with the components of vectors.

use robot_dynamics::quantity::{Quantity, Symbol};

use super::{Array, Cell, Equation, Written};
use crate::math::Math;

/// The columns of the vectors among the quantities; `None` if there are none.
pub(super) fn of_quantities(
    quantities: &[Quantity<'_>],
    equations: &[Equation],
    paper: bool,
) -> Option<Vec<Array>> {
    let vector = |symbol: Symbol| symbol.component.map(|_| (symbol.kind, symbol.number));
    let all: Vec<_> = quantities.iter().zip(equations).collect();
    let same = |(first, _): &(&Quantity<'_>, _), (next, _): &(&Quantity<'_>, _)| {
        vector(first.symbol) == vector(next.symbol)
    };
    let arrays = all.chunk_by(same).filter_map(|components| {
        let (kind, number) = vector(components.first()?.0.symbol)?;
        let name = format!("{}{number}", kind.name());
        let cells = components.iter().map(|(_, equation)| cell(equation, false));
        let left = match paper {
            true => Math::column_in_paper(kind, number),
            false => Math::vector(kind, number),
        };
        Some(column(name, left, cells))
    });
    let arrays: Vec<Array> = arrays.collect();
    (!arrays.is_empty()).then_some(arrays)
}

/// Makes a column of entries.
pub(super) fn column(name: String, left: Math, cells: impl Iterator<Item = Cell>) -> Array {
    Array { name, left, rows: cells.map(|cell| vec![cell]).collect() }
}

/// Makes an entry from the equation of a component.
pub(super) fn cell(equation: &Equation, is_plain: bool) -> Cell {
    let whole = Written { text: equation.text.clone(), math: equation.right.clone() };
    let (name, look) = (equation.name.clone(), equation.left.clone());
    Cell { name, look, whole: Some(whole), parts: None, is_plain, alias: None }
}
