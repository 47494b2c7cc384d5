//! Matrices of expressions, of any size.

use robot_symbolic::{Expr, Graph};

/// What is known about the pivots of a matrix that must be positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pivots {
    /// Nothing is known. A pivot that is not positive and finite makes all results that depend on it NaN.
    Checked,
    /// All pivots are positive and finite.
    Positive,
}

impl Pivots {
    /// The reciprocal of a pivot.
    pub(crate) fn reciprocal(self, pivot: Expr<'_>) -> Expr<'_> {
        match self {
            Pivots::Checked => pivot.recip_positive(),
            Pivots::Positive => pivot.graph().one() / pivot,
        }
    }
}

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

    /// The entry in a row and column.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> Expr<'g> {
        self.entries[Self::place(row, column)]
    }

    /// Replaces an entry and its mirror image across the diagonal.
    pub fn set(&mut self, row: usize, column: usize, value: Expr<'g>) {
        self.entries[Self::place(row, column)] = value;
    }

    /// Adds to an entry and to its mirror image across the diagonal.
    pub fn add(&mut self, row: usize, column: usize, value: Expr<'g>) {
        self.entries[Self::place(row, column)] += value;
    }

    /// All entries row by row, both triangles.
    #[must_use]
    pub fn rows(&self) -> Vec<Expr<'g>> {
        let row = |row| (0..self.order).map(move |column| self.at(row, column));
        (0..self.order).flat_map(row).collect()
    }

    /// Solves A x = b by A = Lᵀ D L, from the last row to the first, which preserves the zeros between branches of a
    /// tree (R. Featherstone, "Rigid Body Dynamics Algorithms", 2008, section 6.5). It needs one division for each row
    /// whose pivot is not constant, and no branch. A must be positive definite.
    #[must_use]
    pub fn solve(self, right: Vec<Expr<'g>>, pivots: Pivots) -> Vec<Expr<'g>> {
        self.solve_all(vec![right], pivots).into_iter().flatten().collect()
    }

    /// Solves A x = b like [`SymmetricMatrix::solve`] for several right sides, with one factorization.
    #[must_use]
    pub fn solve_all(
        mut self,
        mut right: Vec<Vec<Expr<'g>>>,
        pivots: Pivots,
    ) -> Vec<Vec<Expr<'g>>> {
        let reciprocals = self.eliminate(&mut right, pivots);
        right.into_iter().map(|side| self.outward(&reciprocals, &side)).collect()
    }

    /// Replaces the entries below the diagonal by L D and the diagonal by D, transforms the right sides accordingly,
    /// and returns 1/D.
    fn eliminate(&mut self, right: &mut [Vec<Expr<'g>>], pivots: Pivots) -> Vec<Expr<'g>> {
        let mut reciprocals: Vec<Expr<'g>> = vec![];
        for pivot in (0..self.order).rev() {
            let diagonal = self.at(pivot, pivot);
            let reciprocal = pivots.reciprocal(diagonal);
            reciprocals.push(reciprocal);
            for row in 0..pivot {
                let factor = self.at(pivot, row) * reciprocal;
                for side in right.iter_mut() {
                    side[row] = side[row] - factor * side[pivot];
                }
                for column in 0..=row {
                    self.add(row, column, -(factor * self.at(pivot, column)));
                }
            }
        }
        reciprocals.reverse();
        reciprocals
    }

    /// The pivots D of A = Lᵀ D L.
    #[must_use]
    pub fn pivots(mut self, pivots: Pivots) -> Vec<Expr<'g>> {
        self.eliminate(&mut [], pivots);
        (0..self.order).map(|row| self.at(row, row)).collect()
    }

    /// Solves the triangular system from the first row to the last, after [`SymmetricMatrix::eliminate`].
    fn outward(&self, reciprocals: &[Expr<'g>], right: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut solution: Vec<Expr<'g>> = vec![];
        for (row, (value, reciprocal)) in right.iter().zip(reciprocals).enumerate() {
            let known = solution.iter().enumerate();
            let rest = known.fold(*value, |rest, (column, x)| rest - self.at(row, column) * *x);
            solution.push(rest * *reciprocal);
        }
        solution
    }

    fn place(row: usize, column: usize) -> usize {
        let (row, column) = (row.max(column), row.min(column));
        row * (row + 1) / 2 + column
    }
}

/// A square matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SquareMatrix<'g> {
    /// The entries, row by row.
    entries: Vec<Expr<'g>>,
    order: usize,
}

impl<'g> SquareMatrix<'g> {
    /// The zero matrix.
    #[must_use]
    pub fn zero(graph: &'g Graph, order: usize) -> SquareMatrix<'g> {
        SquareMatrix { entries: vec![graph.zero(); order * order], order }
    }

    /// The matrix with the given entries, row by row.
    #[must_use]
    pub fn from_rows(entries: Vec<Expr<'g>>, order: usize) -> SquareMatrix<'g> {
        SquareMatrix { entries, order }
    }

    /// The number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// The entry in a row and column.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> Expr<'g> {
        self.entries[row * self.order + column]
    }

    /// Adds to the entry in a row and column.
    pub fn add(&mut self, row: usize, column: usize, value: Expr<'g>) {
        self.entries[row * self.order + column] += value;
    }

    /// The entries of a column.
    #[must_use]
    pub fn column(&self, column: usize) -> Vec<Expr<'g>> {
        (0..self.order).map(|row| self.at(row, column)).collect()
    }

    /// All entries, row by row.
    #[must_use]
    pub fn rows(&self) -> Vec<Expr<'g>> {
        self.entries.clone()
    }
}
