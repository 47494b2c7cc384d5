//! Tables that fit a column of text: in smaller type, with cells of several lines, in parts side by side, across
//! all columns of the page, or on several pages.

use super::words;
use crate::document::{Block, Cell, Document, Inline, Table};
use crate::width::{text_width, width};

/// The font sizes, as ratios to the normal size.
pub(super) const SIZES: [(&str, f64); 3] =
    [("normalsize", 1.0), ("small", 0.92), ("footnotesize", 0.84)];

/// A table, or a part of one with some of its columns.
pub(super) struct Part {
    /// The headings and rows.
    pub(super) table: Table,
    /// The widths of columns whose cells can take several lines, in pt; `None` for other columns.
    pub(super) widths: Vec<Option<f64>>,
    /// The index of the font size in [`SIZES`].
    pub(super) size: usize,
    /// Whether another part precedes this one.
    pub(super) is_continued: bool,
    /// The numbers of rows in the groups that are never broken across pages. A table of several groups has widths for
    /// all columns.
    pub(super) groups: Vec<usize>,
    /// The estimated number of lines, without the caption and the head.
    pub(super) lines: f64,
}

/// The number of rows from which a narrow table is set in two halves side by side, and the least number of rows in each
/// of more parts.
const LONG: usize = 14;
/// The largest number of parts of a table that stand side by side.
const BESIDE: usize = 4;
/// The empty column between them.
const BETWEEN: [Cell; 1] = [vec![]];
/// The largest number of lines of a table that is never broken across pages.
const LINES: f64 = 28.0;
/// The same in a column that can start with the tallest figure.
const LINES_BELOW: f64 = 8.0;
/// The largest number of lines of a group of a longer table.
const GROUP: f64 = 6.0;
/// The smallest width of a column with broken cells, in pt, unless there is no other way.
const NARROW: f64 = 70.0;

/// A table with its number and its parts.
pub(super) struct Placed {
    pub(super) number: usize,
    pub(super) parts: Vec<Part>,
    /// Whether each part is as wide as the page, not one of its columns.
    pub(super) spans: bool,
}

impl Placed {
    /// The estimated number of lines of `available` points, with the captions and the heads.
    pub(super) fn lines(&self, available: f64) -> f64 {
        let caption = |part: &Part| (text_width(&part.table.caption) / available).floor();
        self.parts.iter().map(|part| part.lines + HEAD + caption(part)).sum()
    }

    /// Whether some rows can stand on another page than the others.
    pub(super) fn is_breakable(&self) -> bool {
        self.parts.iter().any(|part| part.groups.len() > 1)
    }
}

/// The number of lines of a head and a short caption with the spaces around the table.
const HEAD: f64 = 4.0;

/// The tables of a document in their order, for columns of `column` points on a page of `page` points, in which each
/// column of a table needs `gap` points for the space between columns.
pub(super) fn tables(document: &Document, column: f64, page: f64, gap: f64) -> Vec<Placed> {
    let tables = document.blocks.iter().filter_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    });
    let has_figure = document.blocks.iter().any(|block| matches!(block, Block::Figure(_)));
    let lines = if page > column && has_figure { LINES_BELOW } else { LINES };
    let page = Space { width: page, gap, lines: LINES };
    let column = Space { width: column, gap, lines };
    let placed = |(place, table)| Placed { number: place + 1, ..placed(table, column, page) };
    tables.enumerate().map(placed).collect()
}

/// The space for a table.
#[derive(Clone, Copy)]
struct Space {
    /// The width of lines, in pt.
    width: f64,
    /// The space between columns, in pt, for each column.
    gap: f64,
    /// The largest number of lines of a table that is never broken across pages.
    lines: f64,
}

/// Splits a table into parts for a column of a page. A table whose own columns would be divided among parts spans the
/// page if it then has fewer parts.
fn placed(table: &Table, column: Space, page: Space) -> Placed {
    let narrow = parts(table, column);
    let is_divided = narrow.iter().any(|part| part.table.head.len() < table.head.len());
    if page.width > column.width && is_divided {
        let wide = parts(table, page);
        if wide.len() < narrow.len() {
            return Placed { number: 1, parts: wide, spans: true };
        }
    }
    Placed { number: 1, parts: narrow, spans: false }
}

/// Splits a table into parts for a space.
fn parts(table: &Table, space: Space) -> Vec<Part> {
    let Space { width: available, gap, lines } = space;
    let columns = |table: &Table| 0..table.head.len();
    for count in (3..=(table.rows.len() / LONG).min(BESIDE)).rev() {
        let folded = folded(table, count, &BETWEEN);
        let found = Measure::new(&folded, gap).natural(columns(&folded), available);
        if let Some((0, widths)) = found {
            return vec![grouped(folded, widths, 0, lines)];
        }
    }
    let long = (table.rows.len() >= LONG).then(|| folded(table, 2, &BETWEEN));
    // Pairs of a name and a value are distinct without an empty column, too.
    let tight = long.as_ref().filter(|_| table.head.len() == 2).map(|_| folded(table, 2, &[]));
    for folded in long.iter().chain(&tight) {
        let found = Measure::new(folded, gap).natural(columns(folded), available);
        if let Some((size, widths)) = found {
            return vec![grouped(folded.clone(), widths, size, lines)];
        }
    }
    let measure = Measure::new(table, gap);
    let all: Vec<usize> = columns(table).collect();
    let whole = measure.natural(columns(table), available).or_else(|| {
        (1..SIZES.len()).find_map(|size| measure.broken(&all, available, size, NARROW))
    });
    if let Some((size, widths)) = whole {
        let whole = grouped(table.clone(), widths, size, lines);
        return vec![long.and_then(|long| shorter(long, space, whole.lines)).unwrap_or(whole)];
    }
    let mut parts: Vec<Part> = vec![];
    for columns in measure.split(available) {
        let last = SIZES.len() - 1;
        let (size, widths) = measure
            .natural(columns.iter().copied(), available)
            .or_else(|| measure.broken(&columns, available, last, 0.0))
            .unwrap_or_else(|| measure.forced(&columns, available));
        let part = grouped(chosen(table, &columns), widths, size, lines);
        parts.push(Part { is_continued: !parts.is_empty(), ..part });
    }
    parts
}

/// The folded table with cells of several lines, if it takes less than two thirds of `whole` lines.
fn shorter(folded: Table, space: Space, whole: f64) -> Option<Part> {
    let all: Vec<usize> = (0..folded.head.len()).collect();
    let (size, widths) = Measure::new(&folded, space.gap).broken(&all, space.width, 1, NARROW)?;
    let part = grouped(folded, widths, size, space.lines);
    (part.lines < 2.0 / 3.0 * whole).then_some(part)
}

/// The natural widths of the columns in the normal size, and the widths of their widest words.
struct Measure {
    natural: Vec<f64>,
    least: Vec<f64>,
    keys: usize,
    gap: f64,
}

/// The index of a font size, and the widths of columns whose cells can take several lines.
type Layout = (usize, Vec<Option<f64>>);

impl Measure {
    fn new(table: &Table, gap: f64) -> Measure {
        let widest = |measure: fn(&[Inline]) -> f64| {
            let column = |column: usize| {
                let cells = std::iter::once(&table.head).chain(&table.rows);
                let cells = cells.filter_map(|row| row.get(column));
                cells.map(|cell| measure(cell)).fold(0.0, f64::max)
            };
            (0..table.head.len()).map(column).collect()
        };
        let (natural, least) = (widest(natural_width), widest(least_width));
        Measure { natural, least, keys: table.keys, gap }
    }

    /// The columns in the largest font size in which no cell needs a second line; `None` if there is none.
    fn natural(&self, columns: impl Iterator<Item = usize>, available: f64) -> Option<Layout> {
        let widths: Vec<f64> =
            columns.filter_map(|column| self.natural.get(column).copied()).collect();
        let (sum, gaps) = (widths.iter().sum::<f64>(), self.gap * widths.len() as f64);
        let size = SIZES.iter().position(|(_, scale)| sum * scale + gaps <= available)?;
        Some((size, vec![None; widths.len()]))
    }

    /// The columns with cells of several lines, none narrowed to less than `narrow` points; `None` if they do not fit.
    fn broken(
        &self,
        columns: &[usize],
        available: f64,
        size: usize,
        narrow: f64,
    ) -> Option<Layout> {
        let scale = SIZES.get(size).map_or(1.0, |(_, scale)| *scale);
        let room = available - self.gap * columns.len() as f64;
        let width = |column: &usize, level: f64| {
            let of = |widths: &[f64]| widths.get(*column).map_or(0.0, |width| width * scale);
            of(&self.natural).min(of(&self.least).max(level))
        };
        let total = |level: f64| columns.iter().map(|column| width(column, level)).sum::<f64>();
        let mut level = available;
        while total(level) > room {
            level -= 1.0;
            if level < narrow {
                return None;
            }
        }
        let chosen = columns.iter().map(|column| {
            let own = width(column, level);
            (own < width(column, f64::INFINITY)).then_some(own)
        });
        Some((size, chosen.collect()))
    }

    /// The layout for a column that is wider than the line: its formulas are broken where possible.
    fn forced(&self, columns: &[usize], available: f64) -> Layout {
        let scale = SIZES.last().map_or(1.0, |(_, scale)| *scale);
        let keys: f64 = self.natural.iter().take(self.keys).map(|width| width * scale).sum();
        let room = available - self.gap * columns.len() as f64 - keys;
        let widths = columns.iter().map(|column| (*column >= self.keys).then_some(room.max(20.0)));
        (SIZES.len() - 1, widths.collect())
    }

    /// Divides the columns into parts that fit; the first `keys` columns are repeated in each.
    fn split(&self, available: f64) -> Vec<Vec<usize>> {
        let scale = SIZES.last().map_or(1.0, |(_, scale)| *scale);
        let width =
            |column: usize| self.natural.get(column).map_or(0.0, |width| width * scale) + self.gap;
        let keys: Vec<usize> = (0..self.keys).collect();
        let start: f64 = keys.iter().map(|column| width(*column)).sum();
        let (mut parts, mut part, mut sum) = (vec![], keys.clone(), start);
        for column in self.keys..self.natural.len() {
            if sum + width(column) > available && part.len() > keys.len() {
                parts.push(std::mem::replace(&mut part, keys.clone()));
                sum = start;
            }
            part.push(column);
            sum += width(column);
        }
        parts.push(part);
        parts
    }
}

/// The table in `count` parts side by side, with these cells between them.
fn folded(table: &Table, count: usize, between: &[Cell]) -> Table {
    let height = table.rows.len().div_ceil(count);
    let empty = vec![vec![]; table.head.len()];
    let row = |place: usize| -> Vec<Cell> {
        let rows = (0..count).map(|part| table.rows.get(part * height + place).unwrap_or(&empty));
        rows.map(Vec::as_slice).collect::<Vec<_>>().join(between)
    };
    Table {
        caption: table.caption.clone(),
        head: vec![table.head.as_slice(); count].join(between),
        rows: (0..height).map(row).collect(),
        keys: table.keys,
    }
}

/// The table with some of its columns.
fn chosen(table: &Table, columns: &[usize]) -> Table {
    let of = |row: &Vec<Cell>| -> Vec<Cell> {
        columns.iter().filter_map(|column| row.get(*column).cloned()).collect()
    };
    Table {
        caption: table.caption.clone(),
        head: of(&table.head),
        rows: table.rows.iter().map(of).collect(),
        keys: table.keys,
    }
}

/// Divides the rows of a table of more than `longest` lines into groups.
fn grouped(table: Table, mut widths: Vec<Option<f64>>, size: usize, longest: f64) -> Part {
    let scale = SIZES.get(size).map_or(1.0, |(_, scale)| *scale);
    let lines = |row: &Vec<Cell>| {
        let cells = row.iter().zip(&widths).filter_map(|(cell, width)| Some((cell, (*width)?)));
        let lines = cells.map(|(cell, width)| (1.15 * scale * natural_width(cell) / width).ceil());
        lines.fold(1.0, f64::max)
    };
    let heights: Vec<f64> = table.rows.iter().map(lines).collect();
    let all = heights.iter().sum();
    let mut groups = vec![];
    let mut sum = f64::INFINITY;
    for height in heights {
        sum += height;
        match groups.last_mut() {
            Some(count) if all <= longest || sum <= GROUP => *count += 1,
            _ => {
                groups.push(1);
                sum = height;
            }
        }
    }
    // No row is alone on a page.
    if let [.., before, 1] = groups.as_mut_slice() {
        *before += 1;
        groups.pop();
    }
    if groups.len() > 1 {
        let naturals = Measure::new(&table, 0.0).natural;
        for (width, natural) in widths.iter_mut().zip(naturals) {
            // Widths are rounded down, and indices are relatively wider in small type.
            width.get_or_insert((natural * scale).ceil() + 1.0);
        }
    }
    Part { table, widths, size, is_continued: false, groups, lines: all }
}

/// The width of a cell on one line in the normal size, pt.
pub(super) fn natural_width(cell: &[Inline]) -> f64 {
    cell.iter().map(inline_width).sum()
}

/// The width of the widest word or formula of a cell, in pt.
fn least_width(cell: &[Inline]) -> f64 {
    let word = |inline: &Inline| match inline {
        Inline::Text(text) | Inline::Emphasis(text) => {
            let words = text.split(' ').map(|word| 1.2 * text_width(words::longest_part(word)));
            words.fold(0.0, f64::max)
        }
        whole => inline_width(whole),
    };
    cell.iter().map(word).fold(0.0, f64::max)
}

fn inline_width(inline: &Inline) -> f64 {
    match inline {
        Inline::Text(text) => text_width(text),
        Inline::Emphasis(text) => 1.2 * text_width(text),
        Inline::Math(math) => width(math),
        Inline::Reference(_) => 25.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn space(width: f64) -> Space {
        Space { width, gap: 10.0, lines: LINES }
    }

    fn table(columns: usize, rows: usize, cell: &str) -> Table {
        let row = vec![vec![Inline::text(cell)]; columns];
        let (head, rows) = (row.clone(), vec![row; rows]);
        Table { caption: String::new(), head, rows, keys: 1 }
    }

    #[test]
    fn wide_tables_are_split_and_keep_their_first_column() {
        let wide = parts(&table(9, 2, "onelongword"), space(200.0));
        assert!(wide.len() > 2);
        for part in &wide {
            let width: f64 = part.table.head.iter().map(|cell| natural_width(cell) * 0.84).sum();
            assert!(width + 10.0 * part.table.head.len() as f64 <= 200.0);
        }
        let columns: usize = wide.iter().map(|part| part.table.head.len() - 1).sum();
        assert_eq!(columns, 8);
        assert!(!wide[0].is_continued && wide[1].is_continued);
    }

    #[test]
    fn wide_tables_span_the_page_if_they_are_cut_less_often() {
        let spans = |columns, rows, page| {
            let placed = placed(&table(columns, rows, "onelongword"), space(200.0), space(page));
            (placed.spans, placed.parts.len())
        };
        assert_eq!(spans(3, 2, 600.0), (false, 1));
        assert_eq!(spans(9, 2, 200.0), (false, 4));
        assert_eq!(spans(9, 2, 600.0), (true, 1));
        // Rows can follow in the next column.
        assert_eq!(spans(3, 40, 300.0), (false, 1));
    }

    #[test]
    fn long_text_takes_several_lines() {
        let sentence = ["word"; 30].join(" ");
        let found = parts(&table(2, 2, &sentence), space(200.0));
        let [part] = found.as_slice() else { panic!("{} parts", found.len()) };
        let widths: Vec<f64> = part.widths.iter().flatten().copied().collect();
        assert!(widths.len() == 2 && widths.iter().sum::<f64>() <= 180.0, "{widths:?}");
    }

    #[test]
    fn names_and_values_stand_in_as_many_parts_as_fit() {
        let columns = |available| -> Vec<(usize, usize)> {
            let found = parts(&table(2, 60, "abcd"), space(available));
            found.iter().map(|part| (part.table.head.len(), part.table.rows.len())).collect()
        };
        let expected: [Vec<(usize, usize)>; 3] = [vec![(11, 15)], vec![(8, 20)], vec![(4, 30)]];
        assert_eq!([400.0, 240.0, 114.0].map(columns), expected);
    }

    #[test]
    fn long_narrow_tables_stand_side_by_side_and_long_ones_go_on() {
        let found = parts(&table(2, 21, "a"), space(200.0));
        let [part] = found.as_slice() else { panic!("{} parts", found.len()) };
        assert_eq!((part.table.head.len(), part.table.rows.len()), (5, 11));
        assert!(part.table.rows.iter().all(|row| row.len() == 5));
        let groups = |rows| parts(&table(3, rows, "abcdefghij"), space(200.0)).remove(0).groups;
        assert_eq!(groups(28), [28]);
        assert_eq!(groups(32), [6, 6, 6, 6, 6, 2]);
        assert_eq!(groups(31), [6, 6, 6, 6, 7]);
    }

    /// A column that starts with a figure has room for few rows.
    #[test]
    fn below_a_figure_in_columns_also_shorter_tables_go_on() {
        let bounds = [[0.0; 2]; 2];
        let figure = crate::figure::Figure { caption: String::new(), bounds, shapes: vec![] };
        let groups = |blocks: Vec<Block>, page| {
            let document = Document { title: String::new(), blocks };
            tables(&document, 200.0, page, 10.0).remove(0).parts.remove(0).groups
        };
        let table = || Block::Table(table(3, 12, "abcdefghij"));
        assert_eq!(groups(vec![Block::Figure(figure.clone()), table()], 500.0), [6, 6]);
        assert_eq!(groups(vec![Block::Figure(figure), table()], 200.0), [12]);
        assert_eq!(groups(vec![table()], 500.0), [12]);
    }
}
