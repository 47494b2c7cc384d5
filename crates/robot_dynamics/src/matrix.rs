//! Matrices of expressions, of any size.

use robot_symbolic::{Expr, Graph};

/// A symmetric matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SymmetricMatrix<'g> {
    /// The lower triangle, row by row.
    entries: Vec<Expr<'g>>,
    order: usize,
}

impl<'g> SymmetricMatrix<'g> {
    /// The zero matrix.
    #[must_use]
    pub fn zero(graph: &'g Graph, order: usize) -> SymmetricMatrix<'g> {
        SymmetricMatrix { entries: vec![graph.zero(); order * (order + 1) / 2], order }
    }

    /// The number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// An entry.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> Expr<'g> {
        self.entries[Self::place(row, column)]
    }

    /// Replaces an entry and the one across the diagonal.
    pub fn set(&mut self, row: usize, column: usize, value: Expr<'g>) {
        self.entries[Self::place(row, column)] = value;
    }

    /// Adds to an entry, and to the one across the diagonal.
    pub fn add(&mut self, row: usize, column: usize, value: Expr<'g>) {
        self.entries[Self::place(row, column)] += value;
    }

    /// All entries row by row, both triangles.
    #[must_use]
    pub fn rows(&self) -> Vec<Expr<'g>> {
        let row = |row| (0..self.order).map(move |column| self.at(row, column));
        (0..self.order).flat_map(row).collect()
    }

    fn place(row: usize, column: usize) -> usize {
        let (row, column) = (row.max(column), row.min(column));
        row * (row + 1) / 2 + column
    }
}
