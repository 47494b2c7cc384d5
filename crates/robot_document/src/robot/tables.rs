//! The tables of links, masses and frames.

use robot_dynamics::mechanism::{Mechanism, MechanismLink, MechanismOptions};
use robot_model::robot::{Inertia, Move, Payload, Placement, Robot};
use robot_symbolic::print::{exact_text, to_text};
use robot_symbolic::{
    AngleSums, Expr, Formula, Graph, Number, Polynomial, PolynomialOptions, Rational, walk,
};

use super::{dh, drives, heading, numbers, paragraph};
use crate::document::{Block, Cell, Inline, Table};
use crate::error::Error;
use crate::figure::Figure;
use crate::layout::{Order, SymbolTable, has_longer, is_root_of_number, tidied};
use crate::math::Math;
use crate::robot::rows::{self, FrameRow, LinkRow};
use crate::robot::words;
use crate::width::width;

/// The section of the robot.
pub(super) struct Tables {
    pub(super) blocks: Vec<Block>,
    /// The place of the table of masses.
    pub(super) masses: usize,
    /// Whether decimals of poses were rounded.
    pub(super) is_rounded: bool,
}

/// The figure and the tables of the links, of their masses and of the named frames. Decimals of poses are rounded to
/// `digits`.
pub(super) fn blocks(
    robot: &Robot,
    symbols: &SymbolTable,
    digits: Option<usize>,
    figure: Option<Figure>,
) -> Result<Tables, Error> {
    let formulas =
        Formulas { graph: Graph::new(), symbols, digits, rounded: std::cell::Cell::new(false) };
    let mut blocks = vec![heading("The robot")];
    blocks.extend(figure.map(Block::Figure));
    blocks.push(gravity(robot, &formulas)?);
    blocks.push(Block::Table(links(robot, &formulas)?));
    blocks.push(paragraph(
        "T denotes a translation and R a rotation, each in the frame reached by the preceding ones.",
    ));
    blocks.extend(dh::blocks(robot, &formulas)?);
    let place = blocks.len();
    blocks.push(Block::Table(masses(robot, symbols)?));
    blocks.extend(drives::table(robot, &formulas)?.map(Block::Table));
    if !robot.frames.is_empty() {
        blocks.push(Block::Table(frames(robot, &formulas)?));
    }
    Ok(Tables { blocks, masses: place, is_rounded: formulas.rounded.get() })
}

/// Prints the formulas of tables.
pub(super) struct Formulas<'n> {
    graph: Graph,
    symbols: &'n SymbolTable,
    /// The largest number of significant digits of decimals; `None` for all.
    digits: Option<usize>,
    /// Whether a decimal was rounded.
    rounded: std::cell::Cell<bool>,
}

impl Formulas<'_> {
    pub(super) fn math(&self, formula: &Formula) -> Result<Math, Error> {
        self.expression(formula.lower(&self.graph, &mut |name| self.graph.symbol(name)))
    }

    /// An expression, whose decimals are rounded.
    pub(super) fn expression(&self, value: Expr<'_>) -> Result<Math, Error> {
        let math = self.symbols.expression(value)?;
        if self.digits.is_some_and(|digits| has_longer(&math, digits)) {
            self.rounded.set(true);
        }
        Ok(tidied(&math, self.digits))
    }

    fn vector(&self, formulas: &[Formula; 3]) -> Result<Cell, Error> {
        let [x, y, z] = formulas.each_ref().map(|formula| self.math(formula));
        Ok(vec![Inline::Math(numbers::vector(&[x?, y?, z?]))])
    }

    fn placement(&self, placement: &Placement) -> Result<Cell, Error> {
        let mut cell: Cell = vec![];
        for step in words::moves(placement) {
            let shown = match step {
                Move::Translate(vector) => {
                    let Some(Inline::Math(vector)) = self.vector(vector)?.pop() else { continue };
                    Math::Row(vec![Math::Word("T".to_owned()), vector])
                }
                Move::Rotate(axis, angle) => {
                    let axis = Math::Letter(words::axis(*axis));
                    let name = Math::Word("R".to_owned()).with_lower(axis);
                    let angle = Box::new(self.math(angle)?);
                    Math::Row(vec![name, Math::Fenced(crate::math::Fence::Parentheses, angle)])
                }
            };
            if !cell.is_empty() {
                cell.push(Inline::text(" "));
            }
            cell.push(Inline::Math(shown));
        }
        Ok(if cell.is_empty() { vec![Inline::text("none")] } else { cell })
    }
}

fn gravity(robot: &Robot, formulas: &Formulas<'_>) -> Result<Block, Error> {
    let mut line = vec![Inline::text("Acceleration of gravity in the base frame: ")];
    line.extend(formulas.vector(&robot.gravity)?);
    line.push(Inline::text("."));
    Ok(Block::Paragraph(line))
}

pub(super) fn heads(names: &[&str]) -> Vec<Cell> {
    names.iter().map(|name| vec![Inline::text(*name)]).collect()
}

/// The cells that identify a link: its number, and its name unless all names are numbers.
pub(super) fn link_cells(robot: &Robot, index: usize) -> Vec<Cell> {
    let number = vec![Inline::Math(Math::integer(index + 1))];
    let name = robot.links.get(index).map_or("", |link| &link.name);
    if are_numbered(robot) { vec![number] } else { vec![number, vec![Inline::text(name)]] }
}

/// The cells that identify the payload in a table of links.
fn payload_cells(robot: &Robot) -> Vec<Cell> {
    let name = vec![Inline::text("payload")];
    if are_numbered(robot) { vec![name] } else { vec![vec![], name] }
}

/// The headings of these cells.
pub(super) fn link_heads(robot: &Robot) -> Vec<Cell> {
    if are_numbered(robot) {
        return heads(&["Link"]);
    }
    vec![vec![Inline::Math(Math::Letter('i'))], vec![Inline::text("Link")]]
}

/// Whether the names of all links are their numbers.
pub(super) fn are_numbered(robot: &Robot) -> bool {
    robot.links.iter().zip(1..).all(|(link, number)| link.name == number.to_string())
}

fn links(robot: &Robot, formulas: &Formulas<'_>) -> Result<Table, Error> {
    let mut rows = vec![];
    for (index, row) in rows::links(robot).enumerate() {
        let LinkRow { link, parent, kind, .. } = row;
        let zero = Formula::number(&Rational::ZERO);
        let position = rows::position(&link.joint, &zero, |value| formulas.expression(value))?;
        let mut row = link_cells(robot, index);
        row.extend([
            vec![Inline::text(parent)],
            vec![Inline::text(kind)],
            formulas.vector(&link.joint.axis)?,
            vec![Inline::Math(position)],
            formulas.placement(&link.placement)?,
        ]);
        rows.push(row);
    }
    let mut head = link_heads(robot);
    let keys = head.len();
    head.extend(heads(&["Parent", "Joint", "Axis", "Coordinate", "Pose in the parent frame"]));
    Ok(Table { caption: "Links and joints.".to_owned(), head, rows, keys })
}

fn frames(robot: &Robot, formulas: &Formulas<'_>) -> Result<Table, Error> {
    let mut rows = vec![];
    for FrameRow { frame, link, .. } in rows::frames(robot) {
        rows.push(vec![
            vec![Inline::text(&frame.name)],
            vec![Inline::text(link)],
            formulas.placement(&frame.placement)?,
        ]);
    }
    let head = heads(&["Frame", "Link", "Pose in the link frame"]);
    Ok(Table { caption: "Named frames.".to_owned(), head, rows, keys: 1 })
}

/// The width in pt above which a formula in a table is written as a sum, which breaks at its signs.
const WIDE: f64 = 250.0;
/// The limits of this sum.
const SUM: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 500, max_products: 100_000 };

/// The values of a table.
struct Values<'t> {
    symbols: &'t SymbolTable,
    order: Order<'t>,
    /// Whether a value was rounded.
    are_rounded: bool,
}

impl Values<'_> {
    /// A value; long constants are rounded to six digits.
    fn cell(&mut self, value: Expr<'_>) -> Result<Math, Error> {
        let text = to_text(value);
        let is_long = text.is_ok_and(|text| numbers::is_long(&text)) || is_quotient(value);
        if is_long && walk::symbols(&[value]).is_empty() {
            self.are_rounded = true;
            return Ok(numbers::rounded(value.evaluate(|_| f64::NAN)));
        }
        let nested = tidied(&self.symbols.expression(value)?, None);
        let is_narrow = width(&nested) <= WIDE;
        if is_narrow && !has_roots(value) {
            return Ok(nested);
        }
        let Ok(sum) = Polynomial::of(value, &SUM) else { return Ok(nested) };
        let exact = self.symbols.polynomial(&sum, &self.order)?;
        let sum = tidied(&exact, Some(numbers::DIGITS));
        // Multiplied out, products of roots are numbers.
        if is_narrow && width(&sum) >= width(&nested) {
            return Ok(nested);
        }
        self.are_rounded |= has_longer(&exact, numbers::DIGITS);
        Ok(sum)
    }
}

/// Whether an expression contains roots of numbers.
fn has_roots(value: Expr<'_>) -> bool {
    walk::reachable(&[value]).into_iter().any(is_root_of_number)
}

/// The largest denominator of a number that people write as a fraction.
const DENOMINATOR: i64 = 12;

/// Whether a number is a quotient that nobody would write, such as 7/45, and no decimal.
fn is_quotient(value: Expr<'_>) -> bool {
    let Some(Number::Rational(number)) = value.as_number() else { return false };
    let is_large = number.to_small().is_none_or(|(_, below)| below > DENOMINATOR);
    is_large && exact_text(&number).contains('/')
}

/// The masses, centers of mass and inertia tensors of the links without the payload, in the links' axes, and last those
/// of the payload in the axes of its own frame.
fn of_bodies<'g>(robot: &Robot, graph: &'g Graph) -> Vec<Vec<Expr<'g>>> {
    let mut robot = robot.clone();
    let payload = robot.payload.take();
    if let Some(payload) = &payload {
        let mass = Formula::symbol(&payload.mass);
        for link in &mut robot.links {
            link.bodies.retain(|body| body.mass != mass);
        }
    }
    let options = MechanismOptions::EXACT.with_snap(None, &robot);
    let mechanism = Mechanism::new(&robot, graph, &options);
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let of_link = |link: &MechanismLink<'g>| {
        let mut row = vec![link.mass];
        row.extend(link.center_of_mass.0);
        row.extend(places.map(|(row, column)| link.inertia.0[row][column]));
        row
    };
    let of_payload = payload.map(|Payload { mass, center_of_mass, inertia }| {
        let names = std::iter::once(mass).chain(center_of_mass).chain(inertia);
        names.map(|name| graph.symbol(&name)).collect()
    });
    mechanism.links.iter().map(of_link).chain(of_payload).collect()
}

/// The mass, center of mass and inertia tensor of each link, in the link's axes, and of the payload; columns of zeros are
/// omitted.
fn masses(robot: &Robot, symbols: &SymbolTable) -> Result<Table, Error> {
    let graph = Graph::new();
    let names: Vec<&str> = ["Mass", "x", "y", "z"].into_iter().chain(Inertia::NAMES).collect();
    let values = of_bodies(robot, &graph);
    let shown = |column: &usize| {
        *column < 1
            || values.iter().any(|row| row.get(*column).is_some_and(|value| !value.is_zero()))
    };
    let columns: Vec<usize> = (0..names.len()).filter(shown).collect();
    let mut rows = vec![];
    let mut formulas = Values { symbols, order: Order::new(robot), are_rounded: false };
    for (index, values) in values.iter().enumerate() {
        let mut row = match index < robot.links.len() {
            true => link_cells(robot, index),
            false => payload_cells(robot),
        };
        for value in columns.iter().filter_map(|column| values.get(*column)) {
            row.push(vec![Inline::Math(formulas.cell(*value)?)]);
        }
        rows.push(row);
    }
    let mut head = link_heads(robot);
    let keys = head.len();
    for (column, name) in columns.iter().filter_map(|column| Some((*column, *names.get(*column)?)))
    {
        let letters = |name: &str| Math::row(name.chars().map(Math::Letter).collect());
        head.push(vec![match column {
            0 => Inline::text(name),
            1..=3 => Inline::Math(letters(name).with_lower(Math::Letter('c'))),
            _ => Inline::Math(Math::Letter('J').with_lower(letters(name))),
        }]);
    }
    let omitted = |range: std::ops::Range<usize>| {
        let without = range.filter(|column| !columns.contains(column));
        without.filter_map(|column| names.get(column).copied()).collect::<Vec<_>>()
    };
    let count: usize = robot.links.iter().map(|link| link.bodies.len()).sum();
    let merged = match count > values.len() {
        true => " A link includes the bodies that are fixed to it.",
        false => "",
    };
    let carried = match robot.payload {
        Some(_) => " Those of the payload are in the axes of the frame that carries it.",
        None => "",
    };
    let rounded = if formulas.are_rounded { " Values are rounded." } else { "" };
    let caption = format!(
        "Masses, kg; centers of mass, m; moments of inertia about the center of mass in the axes of the link frame, \
         kg m².{carried}{rounded}{merged}{}",
        words::zeros(&omitted(1..4), &omitted(4..names.len()))
    );
    Ok(Table { caption, head, rows, keys })
}
