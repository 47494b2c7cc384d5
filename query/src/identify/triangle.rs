//! The triangle R of the QR decomposition of a table whose rows arrive a few at a time (TSQR).
//!
//! Householder reflections fold a block of rows into the triangle. Nothing is squared, so the triangle has the
//! condition number of the table, and triangles of parts of the table can be folded into one another in any order.

use pulp::{Simd, WithSimd};

/// The number of rows of a block. A column of them fits in the registers of a processor with AVX-512.
pub(super) const ROWS: usize = 64;

/// A column of a block.
pub(super) type Column = [f64; ROWS];

/// An upper triangle with as many rows as columns, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Triangle {
    size: usize,
    values: Vec<f64>,
}

impl Triangle {
    /// The triangle of a table without rows.
    pub(super) fn new(size: usize) -> Triangle {
        Triangle { size, values: vec![0.0; size * size] }
    }

    /// The number of columns.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// An entry; 0 below the diagonal.
    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        self.values[row * self.size + column]
    }

    /// The part of a row from the diagonal on.
    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.size + row..(row + 1) * self.size]
    }

    /// Folds a block of rows into the triangle, with a column of the block for each column of the triangle. The
    /// values of the block are arbitrary afterwards.
    pub(super) fn fold(&mut self, block: &mut [Column]) {
        pulp::Arch::new().dispatch(Fold { triangle: self, block });
    }

    /// Folds rows into the triangle whose entries are functions of their row and column.
    pub(super) fn fold_rows(&mut self, rows: usize, entry: impl Fn(usize, usize) -> f64) {
        let mut block = vec![[0.0; ROWS]; self.size];
        for start in (0..rows).step_by(ROWS) {
            for (column, values) in block.iter_mut().enumerate() {
                for (row, value) in values.iter_mut().enumerate() {
                    let row = start + row;
                    *value = if row < rows { entry(row, column) } else { 0.0 };
                }
            }
            self.fold(&mut block);
        }
    }

    /// Folds another triangle with the same columns into this one.
    pub(super) fn merge(&mut self, other: &Triangle) {
        self.fold_rows(other.size, |row, column| other.get(row, column));
    }

    /// The entries on and above the diagonal, row by row.
    pub(super) fn packed(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.size).flat_map(|row| self.row(row).iter().copied())
    }

    /// The triangle from the numbers of [`Triangle::packed`], whose length must fit.
    pub(super) fn unpacked(size: usize, packed: &[f64]) -> Option<Triangle> {
        let mut triangle = Triangle::new(size);
        let mut packed = packed.iter();
        for row in 0..size {
            for column in row..size {
                triangle.values[row * size + column] = *packed.next()?;
            }
        }
        packed.next().is_none().then_some(triangle)
    }
}

/// The fold, compiled for every kind of vector registers.
struct Fold<'a> {
    triangle: &'a mut Triangle,
    block: &'a mut [Column],
}

impl WithSimd for Fold<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Fold { triangle, block } = self;
        let size = triangle.size;
        for place in 0..size {
            let (head, tail) = block.split_at_mut(place + 1);
            let reflected = &mut head[place];
            let square = product(reflected, reflected);
            if square == 0.0 {
                continue;
            }
            let row = &mut triangle.values[place * size + place..(place + 1) * size];
            let (diagonal, row) = row.split_first_mut().unwrap_or((&mut reflected[0], &mut []));
            // The opposite sign of the diagonal entry, so that nothing cancels (Golub and Van Loan, section 5.1).
            let length = (*diagonal * *diagonal + square).sqrt().copysign(-*diagonal);
            let scale = 1.0 / (*diagonal - length);
            let factor = (length - *diagonal) / length;
            *diagonal = length;
            reflected.iter_mut().for_each(|value| *value *= scale);
            for (entry, column) in row.iter_mut().zip(tail) {
                let moved = factor * (*entry + product(reflected, column));
                *entry -= moved;
                for (value, direction) in column.iter_mut().zip(reflected.iter()) {
                    *value = direction.mul_add(-moved, *value);
                }
            }
        }
    }
}

/// The scalar product, summed in sixteen parts that stay in registers.
#[inline(always)]
fn product(a: &Column, b: &Column) -> f64 {
    let mut sums = [0.0; 16];
    for (a, b) in a.chunks_exact(16).zip(b.chunks_exact(16)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum = a.mul_add(*b, *sum);
        }
    }
    let mut halves = [0.0; 8];
    for ((half, a), b) in halves.iter_mut().zip(&sums[..8]).zip(&sums[8..]) {
        *half = a + b;
    }
    let [a, b, c, d, e, f, g, h] = halves;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_symbolic::Random;

    fn table(rows: usize, columns: usize) -> Vec<Vec<f64>> {
        let mut random = Random::new(5);
        let row = |_| (0..columns).map(|_| random.uniform(-1.0, 1.0)).collect();
        (0..rows).map(row).collect()
    }

    /// RᵀR, which does not depend on the signs of rows.
    fn squared(triangle: &Triangle) -> Vec<f64> {
        let size = triangle.size();
        let entry = |i: usize, j: usize| -> f64 {
            (0..size).map(|row| triangle.get(row, i) * triangle.get(row, j)).sum()
        };
        (0..size * size).map(|place| entry(place / size, place % size)).collect()
    }

    #[test]
    fn the_triangle_has_the_products_of_the_columns() {
        let table = table(1000, 7);
        let mut triangle = Triangle::new(7);
        triangle.fold_rows(1000, |row, column| table[row][column]);
        for (place, found) in squared(&triangle).into_iter().enumerate() {
            let products = table.iter().map(|row| row[place / 7] * row[place % 7]);
            let wanted: f64 = products.sum();
            assert!((found - wanted).abs() < 1e-12 * 1000.0, "{place}: {found} {wanted}");
        }
    }

    #[test]
    fn parts_fold_in_any_order() {
        let table = table(500, 5);
        let part = |from: usize, to: usize| {
            let mut triangle = Triangle::new(5);
            triangle.fold_rows(to - from, |row, column| table[from + row][column]);
            triangle
        };
        let whole = squared(&part(0, 500));
        let mut merged = part(130, 500);
        merged.merge(&part(1, 130));
        merged.merge(&part(0, 1));
        for (found, wanted) in squared(&merged).iter().zip(whole) {
            assert!((found - wanted).abs() < 1e-12 * 500.0, "{found} {wanted}");
        }
    }

    #[test]
    fn a_packed_triangle_unpacks() {
        let mut triangle = Triangle::new(4);
        triangle.fold_rows(9, |row, column| ((row * 7 + column * 3) % 5) as f64);
        let packed: Vec<f64> = triangle.packed().collect();
        assert_eq!(packed.len(), 10);
        assert_eq!(Triangle::unpacked(4, &packed), Some(triangle));
        assert_eq!(Triangle::unpacked(4, &packed[1..]), None);
    }
}
