//! Matrices and columns that replace the equations of a group if they fit.

use super::grouped::arranged_title;
use super::{Equation, Equations, Group, Relation};
use crate::breaking::broken;
use crate::error::Error;
use crate::math::Math;
use crate::width::width;

/// A matrix or a column, with the symbol that it is equal to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Array {
    /// The name in text, such as `M` or `F_l5`.
    pub name: String,
    /// The layout of the symbol on the left side.
    pub left: Math,
    /// The entries, row by row.
    pub rows: Vec<Vec<Cell>>,
}

/// An entry of a matrix or a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The name of the entry in text, such as `M_1_2` or `F_l5.x`. Equal entries have the same name.
    pub name: String,
    /// The layout of the entry's symbol.
    pub look: Math,
    /// The entry written out; `None` if that is too long.
    pub whole: Option<Written>,
    /// The entry in symbols that other equations of its group define.
    pub parts: Option<Written>,
    /// Whether the entry is 0 or another name of something.
    pub is_plain: bool,
    /// The equation of the entry under its own name, `M_3_5 = M_2_5`, if it equals an earlier coefficient and has the name
    /// of this one.
    pub alias: Option<Equation>,
}

/// A value as text and as layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The infix text.
    pub text: String,
    /// The layout.
    pub math: Math,
}

/// The space for an array with its left side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Room {
    /// In print: the width in points, with 10 pt type.
    Points(f64),
    /// In text: the number of characters.
    Characters(usize),
}

/// The width of an equals sign with its spaces, and the error of estimates, in pt.
const EQUALS: f64 = 18.0;
/// The width of the brackets of a column with the spaces inside them, in pt.
const BRACKETS: f64 = 14.0;
/// The spaces around the sign at the beginning of a line, in pt.
const SIGN: f64 = 4.5;
/// The largest number of columns of a `bmatrix`.
const MAX_COLUMNS: usize = 10;
/// The largest number of lines of a column, which is never broken across pages, and of one of its entries.
const MAX_LINES: usize = 16;
const MAX_ENTRY: usize = 6;

impl Equations {
    /// Returns an error if a symbol of the robot has the name of a matrix or column or, in typeset equations, looks
    /// like one. There an acceleration `a2` does not conflict with a length `a2`, because its letter is bold or overlined.
    ///
    /// # Errors
    ///
    /// The first such name.
    pub fn check_array_names(&self, typeset: bool) -> Result<(), Error> {
        let symbols = &self.symbols;
        let is_taken = |array: &&Array| match typeset {
            true => symbols.is_shown_like(&array.left),
            false => symbols.has(&array.name) && !symbols.is_defined(&array.name),
        };
        match self.arrays().find(is_taken) {
            Some(array) => Err(Error::TakenArray { name: array.name.clone() }),
            None => Ok(()),
        }
    }

    /// The equations without matrices and columns. Groups that have nothing else are dropped.
    #[must_use]
    pub fn listed(&self) -> Equations {
        let groups = self.groups.iter().filter(|group| !group.equations.is_empty());
        let groups = groups.map(|group| Group { arrays: None, ..group.clone() }).collect();
        Equations { groups, symbols: self.symbols.clone(), ..*self }
    }

    /// Replaces the equations that are entries of matrices and columns by these arrays, if they fit. Groups without
    /// remaining equations are dropped.
    ///
    /// An entry that is too long is printed by its name or by other symbols, which are defined in equations after the
    /// matrix. An array that does not fit even then is printed as a list of entries. Entries of columns that are 0 or
    /// only another name of something have no equation of their own.
    #[must_use]
    pub fn arranged(&self, room: Room) -> Equations {
        let groups = self.groups.iter().map(|group| group.arranged(room));
        let groups = groups.filter(|group| !group.equations.is_empty()).collect();
        Equations { groups, symbols: self.symbols.clone(), ..*self }
    }
}

impl Group {
    /// A bound for the number of equations with matrices and columns.
    pub(crate) fn most(&self) -> usize {
        let arrays = self.arrays.as_ref().map_or(0, Vec::len);
        self.equations.len() + arrays + self.relations.len() + usize::from(self.vector.is_some())
    }

    fn arranged(&self, room: Room) -> Group {
        let mut group = self.clone();
        group.arrays = None;
        if let Some(vector) = &self.vector {
            group.equations = vec![vector.clone()];
        } else if let Some(arrays) = &self.arrays {
            group.equations = self.with_arrays(arrays, room);
            group.title = arranged_title(self, &group.equations);
        }
        if matches!(room, Room::Points(_)) {
            group.equations = self.with_relations(group.equations);
        }
        group
    }

    /// Inserts each relation before the first equation that it yields. This is only for print, because relations are
    /// not infix text.
    fn with_relations(&self, equations: Vec<Equation>) -> Vec<Equation> {
        let mut all = Vec::with_capacity(equations.len() + self.relations.len());
        let mut rest: Vec<&Relation> = self.relations.iter().collect();
        for equation in equations {
            if let Some(place) = rest.iter().position(|relation| relation.yields(&equation.name)) {
                all.push(rest.remove(place).equation.clone());
            }
            all.push(equation);
        }
        all
    }

    fn with_arrays(&self, arrays: &[Array], room: Room) -> Vec<Equation> {
        let room = self.beside_left_sides(arrays, room);
        let mut list = List { shown: vec![], known: vec![], used: vec![], aliases: vec![] };
        let mut rest = self.equations.iter().peekable();
        let is_entry = |equation: &Equation| arrays.iter().any(|array| array.has(&equation.name));
        for array in arrays {
            // Equations of quantities that are not entries keep their places.
            while let Some(equation) = rest.next_if(|equation| !array.has(&equation.name)) {
                if !self.definitions && !is_entry(equation) {
                    list.shown.push(equation.clone());
                }
            }
            while rest.next_if(|equation| array.has(&equation.name)).is_some() {}
            list.add(array, room);
        }
        match self.definitions {
            true => list.add_definitions(&self.equations),
            false => list.shown.extend(rest.cloned()),
        }
        list.add_aliases();
        list.shown
    }

    /// The space beside the widest left side.
    fn beside_left_sides(&self, arrays: &[Array], room: Room) -> Room {
        let cells = || arrays.iter().flat_map(|array| array.rows.iter().flatten());
        match room {
            Room::Points(points) => {
                let all = arrays.iter().map(|array| &array.left);
                let all = all.chain(cells().map(|cell| &cell.look));
                let all = all.chain(self.equations.iter().map(|equation| &equation.left));
                Room::Points(points - EQUALS - all.map(width).fold(0.0, f64::max))
            }
            Room::Characters(characters) => {
                let widest = arrays.iter().map(|array| array.name.len()).max();
                Room::Characters(
                    characters.saturating_sub(widest.unwrap_or_default() + " = ".len()),
                )
            }
        }
    }
}

/// The equations of a group that are shown.
struct List<'a> {
    shown: Vec<Equation>,
    /// The names of the entries that are written out.
    known: Vec<&'a str>,
    /// The names of entries that are shown in place of an equation.
    used: Vec<&'a str>,
    /// The equations of entries that equal others, each with the names of the entries before it.
    aliases: Vec<(Vec<&'a str>, Equation)>,
}

impl<'a> List<'a> {
    /// Adds an array, or its entries if it does not fit.
    fn add(&mut self, array: &'a Array, room: Room) {
        let cells = array.rows.iter().flatten();
        if let Some((equation, by_parts)) = array.fitted(room) {
            self.shown.push(equation);
            // An entry that is too long to be written out needs its equation, as one by parts does.
            let whole = cells.filter(|cell| cell.whole.is_some()).map(|cell| cell.name.as_str());
            self.known.extend(whole.filter(|name| !by_parts.contains(name)));
            return;
        }
        let mut before = vec![];
        for cell in cells {
            if let Some(alias) = &cell.alias {
                self.aliases.push((before.clone(), alias.clone()));
                self.used.push(&cell.name);
                before.push(&*alias.name);
                continue;
            }
            before.push(&*cell.name);
            match cell.equation().filter(|_| !cell.is_plain) {
                None if cell.is_plain => {}
                Some(equation) if !self.known.contains(&cell.name.as_str()) => {
                    self.shown.push(equation);
                    self.known.push(&cell.name);
                }
                _ => self.used.push(&cell.name),
            }
        }
    }

    /// Adds the equations of entries that equal others at their places among the entries.
    fn add_aliases(&mut self) {
        for (before, alias) in std::mem::take(&mut self.aliases) {
            let is_before = |one: &Equation| before.contains(&one.name.as_str());
            let place = self.shown.iter().rposition(is_before).map_or(0, |place| place + 1);
            self.shown.insert(place, alias);
        }
    }

    /// Adds the equations that define symbols used so far, in their order.
    fn add_definitions(&mut self, equations: &[Equation]) {
        let others = equations.iter().filter(|one| !self.known.contains(&one.name.as_str()));
        let others: Vec<&Equation> = others.collect();
        let mut is_used = vec![false; others.len()];
        let mut pending: Vec<Vec<&str>> = vec![self.used.clone()];
        pending.extend(self.shown.iter().map(|equation| equation.right.symbols()));
        while let Some(symbols) = pending.pop() {
            for (other, is_used) in others.iter().zip(&mut is_used) {
                if !*is_used && symbols.contains(&other.name.as_str()) {
                    *is_used = true;
                    pending.push(other.right.symbols());
                }
            }
        }
        let used = others.into_iter().zip(is_used).filter(|(_, is_used)| *is_used);
        let used: Vec<Equation> = used.map(|(equation, _)| equation.clone()).collect();
        self.shown.extend(used);
    }
}

impl Array {
    pub(super) fn cells_mut(&mut self) -> impl Iterator<Item = &mut Cell> {
        self.rows.iter_mut().flatten()
    }

    fn has(&self, name: &str) -> bool {
        self.rows.iter().flatten().any(|cell| cell.name == name)
    }

    /// The array as an equation, and the names of the entries that are written by parts. The longest entries are
    /// written by parts until the array fits; `None` if it never does.
    fn fitted(&self, room: Room) -> Option<(Equation, Vec<&str>)> {
        let mut by_parts: Vec<&str> = vec![];
        loop {
            let chosen = |cell: &'_ Cell| -> Option<Written> {
                let whole = cell.whole.as_ref().filter(|_| !by_parts.contains(&&*cell.name));
                whole.or(cell.parts.as_ref()).cloned()
            };
            let row = |row: &Vec<Cell>| row.iter().map(chosen).collect::<Option<Vec<Written>>>();
            let rows = self.rows.iter().map(row).collect::<Option<Vec<_>>>()?;
            if let Some(right) = set(&rows, room) {
                let (name, left) = (self.name.clone(), self.left.clone());
                return Some((Equation { name, text: text(&rows), left, right }, by_parts));
            }
            let cells = self.rows.iter().flatten();
            let wide = cells.filter(|cell| !by_parts.contains(&&*cell.name));
            let wide = wide.filter_map(|cell| {
                let whole = room.size(cell.whole.as_ref()?);
                (whole > room.size(cell.parts.as_ref()?)).then_some((cell, whole))
            });
            let widest = wide.reduce(|most, next| if next.1 > most.1 { next } else { most });
            by_parts.push(&widest?.0.name);
        }
    }

    /// The names of the entries or, if they are short, the entries themselves, row by row.
    #[must_use]
    pub fn names(&self) -> Vec<Vec<&str>> {
        self.rows.iter().map(|row| row.iter().map(Cell::short).collect()).collect()
    }
}

impl Cell {
    /// The entry as an equation, unless other equations define it. It is written by parts: short sums define long ones.
    fn equation(&self) -> Option<Equation> {
        let Written { text, math } = self.parts.as_ref().or(self.whole.as_ref())?.clone();
        let (name, left) = (self.name.clone(), self.look.clone());
        (math != self.look).then_some(Equation { name, text, left, right: math })
    }

    fn short(&self) -> &str {
        match (&self.parts, &self.whole) {
            (Some(parts), _) => &parts.text,
            (None, Some(whole)) if self.is_plain => &whole.text,
            _ => &self.name,
        }
    }
}

impl Room {
    fn size(self, written: &Written) -> f64 {
        match self {
            Room::Points(_) => width(&written.math),
            Room::Characters(_) => written.text.len() as f64,
        }
    }
}

/// The matrix of these entries if it fits.
fn set(rows: &[Vec<Written>], room: Room) -> Option<Math> {
    let entries = |row: &Vec<Written>| row.iter().map(|one| one.math.clone()).collect();
    let matrix: Vec<Vec<Math>> = rows.iter().map(entries).collect();
    match room {
        Room::Characters(available) => {
            let lines = text(rows);
            let fits = lines.lines().all(|line| line.len() <= available);
            fits.then_some(Math::Matrix(matrix))
        }
        Room::Points(available) if rows.iter().all(|row| row.len() == 1) => {
            column(&matrix, available - BRACKETS).filter(|column| width(column) <= available)
        }
        Room::Points(available) => {
            let columns = matrix.iter().map(Vec::len).max().unwrap_or_default();
            let matrix = Math::Matrix(matrix);
            (columns <= MAX_COLUMNS && width(&matrix) <= available).then_some(matrix)
        }
    }
}

/// A column whose entries can take several lines, if it fits.
fn column(rows: &[Vec<Math>], available: f64) -> Option<Math> {
    let mut column = vec![];
    let mut all = 0;
    for entry in rows.iter().flatten() {
        let mut lines = broken(entry, available, available - SIGN).ok()?;
        all += lines.len();
        if lines.len() > MAX_ENTRY || all > MAX_LINES {
            return None;
        }
        let entry = if lines.len() > 1 { Math::Lines(lines) } else { lines.pop()?.math };
        column.push(vec![entry]);
    }
    Some(Math::Matrix(column))
}

/// The rows as text, one per line, with the entries aligned in columns.
fn text(rows: &[Vec<Written>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or_default();
    let length = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.text.len()).max().unwrap_or_default()
    };
    let lengths: Vec<usize> = (0..columns).map(length).collect();
    let one = |row: &Vec<Written>| {
        let cells = row.iter().zip(&lengths).map(|(cell, length)| {
            // Pads without `format!`, whose width is limited to 65,535, because entries can be longer.
            let padding = length.saturating_sub(cell.text.len());
            format!("{}{}", cell.text, " ".repeat(padding))
        });
        format!("[ {} ]", cells.collect::<Vec<_>>().join(",  "))
    };
    rows.iter().map(one).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_any_length_are_written_below_each_other() {
        let written =
            |text: &str| Written { text: text.to_owned(), math: Math::Number(String::new()) };
        assert_eq!(text(&[vec![written("a"), written("b")]]), "[ a,  b ]");
        let long = "q1 + ".repeat(20_000);
        let rows = text(&[vec![written(&long)], vec![written("0")]]);
        let lengths: Vec<usize> = rows.lines().map(str::len).collect();
        assert_eq!(lengths, [long.len() + 4, long.len() + 4]);
    }
}
