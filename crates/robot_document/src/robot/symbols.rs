//! The table of the symbols in a document, with their meanings, units and values.

use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use rustc_hash::FxHashSet;

use super::families::families;
use super::{heading, numbers};
use crate::document::{Block, Cell, Inline, Table};
use crate::forms::{Equations, Form, Letters};
use crate::layout::SymbolTable;
use crate::math::Math;
use crate::robot::rows::{self, ParameterRow};

/// The table of the symbols of a robot that occur in the given blocks, and of those that the forms define. The table of
/// masses, at the given place, explains its own symbols.
pub(super) fn blocks(
    robot: &Robot,
    parts: &[(Form, Equations)],
    (document, masses): (&[Block], usize),
    letters: &Letters,
) -> Vec<Block> {
    let Some((_, first)) = parts.first() else { return vec![] };
    let symbols = &first.symbols;
    let occurring = Occurring::new(document, masses);
    let mut rows = coordinates(robot, symbols, &occurring);
    rows.extend(rates(robot, symbols, &occurring));
    for row in rows::parameters(robot).filter(|row| occurring.has(&row.parameter.name)) {
        rows.push(parameter(symbols.look(&row.parameter.name), &row));
    }
    rows.extend(wrenches(robot, symbols, &occurring));
    for family in families(parts, letters) {
        rows.push(vec![vec![Inline::Math(family.shape)], family.meaning, vec![]]);
    }
    let mut head: Vec<Cell> =
        ["Symbol", "Meaning", "Value"].map(|name| vec![Inline::text(name)]).into();
    // If no symbol has a value, the column of values is omitted.
    if rows.iter().all(|row| row.last().is_some_and(Vec::is_empty)) {
        head.truncate(2);
        rows.iter_mut().for_each(|row| row.truncate(2));
    }
    let is_rounded = rows::parameters(robot).any(|row| {
        let value = row.parameter.value.as_ref().filter(|_| occurring.has(&row.parameter.name));
        value.zip(row.value.as_ref()).is_some_and(|(value, text)| numbers::is_cut(value, text))
    });
    let caption = match is_rounded {
        true => "Symbols, SI units; long values are rounded.",
        false => "Symbols, SI units.",
    };
    let table = Table { caption: caption.to_owned(), head, rows, keys: 1 };
    vec![heading("Symbols"), Block::Table(table)]
}

/// The names of the symbols that are printed.
struct Occurring<'d>(FxHashSet<&'d str>);

impl<'d> Occurring<'d> {
    fn new(blocks: &'d [Block], masses: usize) -> Occurring<'d> {
        let mut formulas: Vec<&Math> = vec![];
        for (place, block) in blocks.iter().enumerate() {
            match block {
                Block::Heading(..) | Block::Figure(_) => {}
                Block::Paragraph(inlines) => formulas.extend(of_inlines(inlines)),
                Block::Table(table) => {
                    let cells = table.rows.iter().flatten().flat_map(|cell| of_inlines(cell));
                    let is_explained =
                        |math: &&Math| place == masses && matches!(math, Math::Symbol(_));
                    formulas.extend(cells.filter(|math| !is_explained(math)));
                }
                Block::Equations(list) => formulas
                    .extend(list.iter().flat_map(|one| [&one.equation.left, &one.equation.right])),
            }
        }
        Occurring(formulas.into_iter().flat_map(Math::symbols).collect())
    }

    fn has(&self, name: &str) -> bool {
        self.0.contains(name)
    }
}

fn of_inlines(inlines: &[Inline]) -> impl Iterator<Item = &Math> {
    inlines.iter().filter_map(|inline| match inline {
        Inline::Math(math) => Some(math),
        _ => None,
    })
}

fn coordinates(robot: &Robot, symbols: &SymbolTable, occurring: &Occurring<'_>) -> Vec<Vec<Cell>> {
    let mut rows = vec![];
    for (index, coordinate) in robot.coordinates.iter().enumerate() {
        let name = JointVariable::Position.symbol(index);
        if occurring.has(&name) {
            let position = match coordinate.kind {
                JointKind::Revolute => "angle",
                JointKind::Prismatic => "position",
            };
            let unit = JointVariable::Position.unit(coordinate.kind);
            let meaning = format!("{position} of joint {}, {unit}", coordinate.joint);
            rows.push(vec![
                vec![Inline::Math(symbols.look(&name))],
                vec![Inline::Text(meaning)],
                vec![],
            ]);
        }
    }
    rows
}

/// The velocities and accelerations, with one row each for all joints.
fn rates(robot: &Robot, symbols: &SymbolTable, occurring: &Occurring<'_>) -> Vec<Vec<Cell>> {
    let mut rows = vec![];
    for (variable, word) in [
        (JointVariable::Velocity, "time derivative"),
        (JointVariable::Acceleration, "second time derivative"),
    ] {
        let mut indices = 0..robot.coordinates.len();
        if let Some(first) = indices.find(|index| occurring.has(&variable.symbol(*index))) {
            let shape = super::families::general(&symbols.look(&variable.symbol(first)), 1);
            let meaning = vec![
                Inline::text(format!("{word} of ")),
                Inline::Math(Math::Letter('q').with_lower(Math::Letter('i'))),
            ];
            rows.push(vec![vec![Inline::Math(shape)], meaning, vec![]]);
        }
    }
    rows
}

/// The components of the wrenches that the tips exert on their surroundings.
fn wrenches(robot: &Robot, symbols: &SymbolTable, occurring: &Occurring<'_>) -> Vec<Vec<Cell>> {
    let mut rows = vec![];
    for (frame, wrench) in robot.tips() {
        for (names, what, unit) in
            [(&wrench.force, "force along", "N"), (&wrench.moment, "moment about", "N m")]
        {
            for (name, axis) in names.iter().zip(["x", "y", "z"]) {
                if occurring.has(name) {
                    let tip = match frame.name.as_str() {
                        "tip" => "the tip".to_owned(),
                        name => format!("the tip {name}"),
                    };
                    let meaning =
                        format!("{what} {axis} that {tip} exerts on its surroundings, {unit}");
                    let symbol = vec![Inline::Math(symbols.look(name))];
                    rows.push(vec![symbol, vec![Inline::Text(meaning)], vec![]]);
                }
            }
        }
    }
    rows
}

fn parameter(symbol: Math, row: &ParameterRow<'_>) -> Vec<Cell> {
    let mut meaning = row.meaning.unwrap_or_default().trim().to_owned();
    let unit = row.unit.filter(|text| *text != "1");
    let value = match (&row.value, unit) {
        (Some(text), unit) => {
            let number = match row.parameter.value.as_ref() {
                Some(value) if numbers::is_long(text) => numbers::rounded(value.to_f64()),
                _ => numbers::signed(text),
            };
            let pieces = std::iter::once(number).chain(unit.into_iter().flat_map(unit_shape));
            vec![Inline::Math(Math::row(pieces.collect()))]
        }
        (None, Some(unit)) => {
            meaning.push_str(if meaning.is_empty() { "in " } else { ", in " });
            meaning.push_str(unit);
            vec![]
        }
        (None, None) => vec![],
    };
    vec![vec![Inline::Math(symbol)], vec![Inline::Text(meaning)], value]
}

/// The layout of a unit after a number, such as `kg m²`, with raised exponents.
fn unit_shape(unit: &str) -> Vec<Math> {
    let mut pieces = vec![Math::Word(" ".to_owned())];
    let mut rest = unit;
    while let Some((name, more)) = rest.split_once('^') {
        pieces.push(Math::Word(name.to_owned()));
        let digits = more.trim_start_matches('-');
        let length = digits.len() - digits.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let mut power = vec![];
        if digits.len() < more.len() {
            power.push(Math::Sign('-'));
        }
        power.push(Math::Number(digits.get(..length).unwrap_or_default().to_owned()));
        if let Some(word) = pieces.pop() {
            pieces.push(word.with_upper(Math::row(power)));
        }
        rest = digits.get(length..).unwrap_or_default();
    }
    if !rest.is_empty() {
        pieces.push(Math::Word(rest.to_owned()));
    }
    pieces
}
