//! The tables of links and masses.

use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::robot::{Inertia, Move, Placement, Robot};
use robot_symbolic::{Expr, Formula, Graph, walk};

use super::{heading, paragraph};
use crate::document::{Block, Inline, Table};
use crate::error::Error;
use crate::layout::SymbolTable;
use crate::math::Math;
use crate::robot::rows::{self, FrameRow, LinkRow};
use crate::robot::words;

type Cell = Vec<Inline>;

/// Tables of the links, of their masses, and of the named frames.
pub(super) fn blocks(robot: &Robot, symbols: &SymbolTable) -> Result<Vec<Block>, Error> {
    let formulas = Formulas { graph: Graph::new(), symbols };
    let mut blocks = vec![heading("The robot"), gravity(robot, &formulas)?];
    blocks.push(Block::Table(links(robot, &formulas)?));
    blocks.push(paragraph(
        "T denotes a translation and R a rotation, each in the frame reached by the preceding ones.",
    ));
    blocks.push(Block::Table(masses(robot, symbols)?));
    if !robot.frames.is_empty() {
        blocks.push(Block::Table(frames(robot, &formulas)?));
    }
    Ok(blocks)
}

struct Formulas<'n> {
    graph: Graph,
    symbols: &'n SymbolTable,
}

impl Formulas<'_> {
    fn math(&self, formula: &Formula) -> Result<Math, Error> {
        let value = formula.lower(&self.graph, &mut |name| self.graph.symbol(name));
        self.symbols.expression(value)
    }

    fn vector(&self, formulas: &[Formula; 3]) -> Result<Cell, Error> {
        let mut pieces = vec![];
        for formula in formulas {
            if !pieces.is_empty() {
                pieces.push(Math::Sign(','));
            }
            pieces.extend(self.math(formula)?.pieces().iter().cloned());
        }
        let inside = Math::Row(pieces);
        Ok(vec![Inline::Math(Math::Fenced(crate::math::Fence::Parentheses, Box::new(inside)))])
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

fn heads(names: &[&str]) -> Vec<Cell> {
    names.iter().map(|name| vec![Inline::text(*name)]).collect()
}

fn links(robot: &Robot, formulas: &Formulas<'_>) -> Result<Table, Error> {
    let mut rows = vec![];
    for (index, row) in rows::links(robot).enumerate() {
        let LinkRow { link, parent, kind, coordinate, .. } = row;
        rows.push(vec![
            vec![Inline::Math(Math::integer(index + 1))],
            vec![Inline::text(&link.name)],
            vec![Inline::text(parent)],
            vec![Inline::text(kind)],
            formulas.vector(&link.joint.axis)?,
            vec![Inline::Math(formulas.symbols.look(&coordinate))],
            formulas.placement(&link.placement)?,
        ]);
    }
    let head =
        heads(&["", "Link", "Parent", "Joint", "Axis", "Coordinate", "Pose in the parent frame"]);
    Ok(Table { caption: "Links and joints.".to_owned(), head, rows })
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
    Ok(Table { caption: "Named frames.".to_owned(), head, rows })
}

/// A value of a table: long constants to six digits.
fn value_cell(symbols: &SymbolTable, value: Expr<'_>) -> Result<Math, Error> {
    let long = robot_symbolic::print::to_text(value).is_ok_and(|text| text.len() > LONG_NUMBER);
    if !long || !walk::symbols(&[value]).is_empty() {
        return symbols.expression(value);
    }
    let number = value.evaluate(|_| f64::NAN);
    let places = (5.0 - number.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let digits = format!("{:.places$}", number.abs());
    let digits = Math::Number(digits.trim_end_matches('0').trim_end_matches('.').to_owned());
    Ok(if number < 0.0 { Math::Row(vec![Math::Sign('-'), digits]) } else { digits })
}

/// Constants of more bytes of text are rounded in tables.
const LONG_NUMBER: usize = 10;

/// Mass, center of mass and tensor of each link, in the link's axes; columns of zeros are left out.
fn masses(robot: &Robot, symbols: &SymbolTable) -> Result<Table, Error> {
    let graph = Graph::new();
    let options = MechanismOptions::EXACT.with_snap(None, robot);
    let mechanism = Mechanism::new(robot, &graph, &options);
    let names: Vec<&str> = ["Mass", "x", "y", "z"].into_iter().chain(Inertia::NAMES).collect();
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let mut values = vec![];
    for link in &mechanism.links {
        let mut row = vec![link.mass];
        row.extend(link.center_of_mass.0);
        row.extend(places.map(|(row, column)| link.inertia.0[row][column]));
        values.push(row);
    }
    let shown = |column: &usize| {
        *column < 1
            || values.iter().any(|row| row.get(*column).is_some_and(|value| !value.is_zero()))
    };
    let columns: Vec<usize> = (0..names.len()).filter(shown).collect();
    let mut rows = vec![];
    for (index, (link, values)) in robot.links.iter().zip(&values).enumerate() {
        let mut row =
            vec![vec![Inline::Math(Math::integer(index + 1))], vec![Inline::text(&link.name)]];
        for value in columns.iter().filter_map(|column| values.get(*column)) {
            row.push(vec![Inline::Math(value_cell(symbols, *value)?)]);
        }
        rows.push(row);
    }
    let mut head = heads(&["", "Link"]);
    for (column, name) in columns.iter().filter_map(|column| Some((*column, *names.get(*column)?)))
    {
        let letters = |name: &str| Math::row(name.chars().map(Math::Letter).collect());
        head.push(vec![match column {
            0 => Inline::text(name),
            1..=3 => Inline::Math(letters(name).with_lower(Math::Letter('c'))),
            _ => Inline::Math(Math::Letter('J').with_lower(letters(name))),
        }]);
    }
    let caption = "Masses, kg; centers of mass, m; moments of inertia about the center of mass \
        in the axes of the link frame, kg m²; columns of zeros are omitted, values are rounded."
        .to_owned();
    Ok(Table { caption, head, rows })
}
