//! Reduced row echelon forms.

use super::scalar::Scalar;

/// A row of coefficients.
pub(super) type Row<'g> = Vec<Scalar<'g>>;

/// Constants this much smaller than the largest entry of a column are not taken as pivots.
const SMALL: f64 = 0.05;

/// Rows with a pivot each: 1 there, 0 in the other rows and to the left; in order of the pivots. The
/// form depends on nothing but the space that the rows span.
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

    /// The rows alone.
    pub(super) fn into_rows(self) -> Vec<Row<'g>> {
        self.rows.into_iter().map(|(_, row)| row).collect()
    }
}

/// The row to take the pivot of a column from: constants before others, then the largest.
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

/// Makes the row's entry at the pivot vanish.
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

/// The smallest space that holds the rows and is closed under a linear map.
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
