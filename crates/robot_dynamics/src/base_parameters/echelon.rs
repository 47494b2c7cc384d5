//! Reduced row echelon forms.

use super::scalar::Scalar;

/// A row of coefficients.
pub(super) type Row<'g> = Vec<Scalar<'g>>;

/// A constant is preferred as a pivot only if it exceeds this fraction of the largest entry of its column.
const SMALL: f64 = 0.05;

/// Rows in the order of their pivots. The pivot of a row is 1; the entries to its left, and the entries of the other
/// rows in its column, are 0. The form only depends on the space that the rows span.
#[derive(Clone, Debug)]
pub(super) struct Echelon<'g> {
    pub(super) rows: Vec<(usize, Row<'g>)>,
}

impl<'g> Echelon<'g> {
    pub(super) fn of(rows: impl IntoIterator<Item = Row<'g>>) -> Echelon<'g> {
        let mut pending: Vec<Row<'g>> = rows.into_iter().collect();
        let mut done: Vec<(usize, Row<'g>)> = vec![];
        for column in 0..pending.first().map_or(0, Vec::len) {
            let Some(chosen) = pivot(&pending, column) else { continue };
            let mut row = pending.swap_remove(chosen);
            let lead = row[column];
            for entry in row.iter_mut().skip(column + 1).filter(|entry| !entry.is_zero()) {
                *entry = *entry / lead;
            }
            row[column] = Scalar::integer(lead, 1);
            let others = pending.iter_mut().chain(done.iter_mut().map(|(_, row)| row));
            others.for_each(|other| subtract(other, &row, column));
            done.push((column, row));
        }
        Echelon { rows: done }
    }

    /// The rows without the columns of their pivots.
    pub(super) fn into_rows(self) -> Vec<Row<'g>> {
        self.rows.into_iter().map(|(_, row)| row).collect()
    }
}

/// The row whose entry becomes the pivot of a column: constants are preferred to other entries, then large to small
/// ones.
fn pivot(rows: &[Row<'_>], column: usize) -> Option<usize> {
    let size = |row: usize| rows[row][column].size();
    let candidates: Vec<usize> =
        (0..rows.len()).filter(|row| !rows[*row][column].is_zero()).collect();
    let largest = candidates.iter().map(|row| size(*row)).fold(0.0, f64::max);
    let rank = |row: usize| {
        let constant = rows[row][column].is_constant() && size(row) > SMALL * largest;
        (constant, size(row))
    };
    candidates.into_iter().reduce(|best, row| if rank(row) > rank(best) { row } else { best })
}

/// Subtracts a multiple of a known row so that the entry in the pivot's column becomes 0.
fn subtract<'g>(row: &mut Row<'g>, known: &Row<'g>, pivot: usize) {
    let factor = row[pivot];
    if factor.is_zero() {
        return;
    }
    for (place, (entry, other)) in row.iter_mut().zip(known).enumerate() {
        if place == pivot {
            *entry = Scalar::integer(factor, 0);
        } else if !other.is_zero() {
            *entry = *entry - factor * *other;
        }
    }
}

/// A basis of the smallest space that contains the rows and is closed under a linear map.
pub(super) fn closure<'g>(
    rows: impl IntoIterator<Item = Row<'g>>,
    map: impl Fn(&Row<'g>) -> Row<'g>,
) -> Vec<Row<'g>> {
    let mut space = Echelon::of(rows).into_rows();
    loop {
        let images: Vec<Row<'g>> = space.iter().map(&map).collect();
        let count = space.len();
        space = Echelon::of(space.into_iter().chain(images)).into_rows();
        if space.len() <= count {
            return space;
        }
    }
}
