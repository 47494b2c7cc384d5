//! Reduced row echelon forms.

use super::scalar::Scalar;

/// A row of coefficients.
pub(super) type Row<'g> = Vec<Scalar<'g>>;

/// A constant is preferred as a pivot only if it exceeds this fraction of the largest entry of its column.
const SMALL: f64 = 0.05;

/// Rows in the order in which their pivots were chosen. The pivot of a row is 1; the entries of the other rows in its
/// column are 0. The form only depends on the space that the rows span.
///
/// Pivots are in the first possible columns, so that the entries to their left are 0, except that a column is chosen after
/// all others if its pivot would be 0 at the nominal parameters.
#[derive(Clone, Debug)]
pub(super) struct Echelon<'g> {
    pub(super) rows: Vec<(usize, Row<'g>)>,
}

impl<'g> Echelon<'g> {
    pub(super) fn of(rows: impl IntoIterator<Item = Row<'g>>) -> Echelon<'g> {
        let mut pending: Vec<Row<'g>> = rows.into_iter().collect();
        let mut form = Echelon { rows: vec![] };
        let mut postponed = vec![];
        for column in 0..pending.first().map_or(0, Vec::len) {
            match pivot(&pending, column) {
                Some(row) if pending[row][column].divides() => {
                    form.eliminate(&mut pending, row, column);
                }
                Some(_) => postponed.push(column),
                None => {}
            }
        }
        for column in postponed {
            if let Some(row) = pivot(&pending, column) {
                form.eliminate(&mut pending, row, column);
            }
        }
        form
    }

    /// Takes a row out of `pending`, with its pivot in a column, and eliminates this column from all other rows.
    fn eliminate(&mut self, pending: &mut Vec<Row<'g>>, row: usize, column: usize) {
        let mut row = pending.swap_remove(row);
        let lead = row[column];
        for entry in row.iter_mut().filter(|entry| !entry.is_zero()) {
            *entry = *entry / lead;
        }
        row[column] = Scalar::integer(lead, 1);
        let others = pending.iter_mut().chain(self.rows.iter_mut().map(|(_, row)| row));
        others.for_each(|other| subtract(other, &row, column));
        self.rows.push((column, row));
    }

    /// The rows without the columns of their pivots.
    pub(super) fn into_rows(self) -> Vec<Row<'g>> {
        self.rows.into_iter().map(|(_, row)| row).collect()
    }
}

/// The row whose entry becomes the pivot of a column: entries that are not 0 at the nominal parameters are preferred to
/// those that are, then constants to others, then large to small ones.
fn pivot(rows: &[Row<'_>], column: usize) -> Option<usize> {
    let size = |row: usize| rows[row][column].size();
    let candidates: Vec<usize> =
        (0..rows.len()).filter(|row| !rows[*row][column].is_zero()).collect();
    let largest = candidates.iter().map(|row| size(*row)).fold(0.0, f64::max);
    let rank = |row: usize| {
        let constant = rows[row][column].is_constant() && size(row) > SMALL * largest;
        (rows[row][column].divides(), constant, size(row))
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

#[cfg(test)]
mod tests {
    use super::*;
    use robot_symbolic::{Graph, print};

    fn rows<'g>(graph: &'g Graph, rows: &[&[&str]]) -> Vec<Row<'g>> {
        let scalar = |text: &&str| Scalar::new(graph.parse(text).unwrap());
        rows.iter().map(|row| row.iter().map(scalar).collect()).collect()
    }

    fn texts(row: &Row<'_>) -> Vec<String> {
        row.iter().map(|entry| print::to_text(entry.expr).unwrap()).collect()
    }

    #[test]
    fn each_pivot_is_one_with_zeros_above_and_below() {
        let graph = Graph::new();
        let found =
            Echelon::of(rows(&graph, &[&["2", "4", "6"], &["1", "2", "4"], &["3", "6", "10"]]));
        let shown: Vec<_> = found.rows.iter().map(|(pivot, row)| (*pivot, texts(row))).collect();
        let text = |row: [&str; 3]| row.map(str::to_owned).to_vec();
        assert_eq!(shown, [(0, text(["1", "2", "0"])), (2, text(["0", "0", "1"]))]);
        assert_eq!(
            found.into_rows().iter().map(texts).collect::<Vec<_>>(),
            [text(["1", "2", "0"]), text(["0", "0", "1"])]
        );
    }

    /// A parameter is chosen as the pivot only if no entry is a number, or if all numbers are small relative to the
    /// other entries.
    #[test]
    fn numbers_are_pivots_before_parameters() {
        let graph = Graph::new();
        let place = |column: &[&str]| {
            let column: Vec<[&str; 1]> = column.iter().map(|entry| [*entry]).collect();
            let column: Vec<&[&str]> = column.iter().map(|row| &row[..]).collect();
            pivot(&rows(&graph, &column), 0)
        };
        assert_eq!(place(&["l", "1/4", "l"]), Some(1));
        assert_eq!(place(&["l", "1/4", "-1/2", "1/3"]), Some(2));
        assert_eq!(place(&["l", "1/1000"]), Some(0));
        assert_eq!(place(&["0", "l/8", "l"]), Some(2));
        assert_eq!(place(&["0", "0"]), None);
    }

    fn shifted<'g>(row: &Row<'g>) -> Row<'g> {
        let zero = Scalar::integer(row[0], 0);
        [zero].into_iter().chain(row[..row.len() - 1].iter().copied()).collect()
    }

    /// The repeated shifts of one row by one place span all places from its first nonzero entry on.
    #[test]
    fn a_closure_holds_all_images() {
        let graph = Graph::new();
        for (row, size) in
            [(["1", "l", "0", "2"], 4), (["0", "0", "3", "1"], 2), (["0", "0", "0", "0"], 0)]
        {
            assert_eq!(closure(rows(&graph, &[&row]), shifted).len(), size, "{row:?}");
        }
    }
}
