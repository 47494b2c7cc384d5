//! The tables of Denavit–Hartenberg parameters, one for each convention that the robot file uses.

use robot_model::robot::{DhConvention, Robot};

use super::tables::{Formulas, are_numbered, link_heads};
use crate::document::{Block, Cell, Inline, Table};
use crate::error::Error;
use crate::math::{Fence, Math};
use crate::robot::rows;

/// The tables, each with the displacements of its rows; none if the robot file has no such parameters.
pub(super) fn blocks(robot: &Robot, formulas: &Formulas<'_>) -> Result<Vec<Block>, Error> {
    let mut blocks = vec![];
    for convention in DhConvention::ALL {
        let table = table(robot, convention, formulas)?;
        if !table.rows.is_empty() {
            blocks.extend([Block::Table(table), displacements(convention)]);
        }
    }
    Ok(blocks)
}

fn table(robot: &Robot, convention: DhConvention, formulas: &Formulas<'_>) -> Result<Table, Error> {
    let mut head = link_heads(robot);
    let keys = head.len();
    head.extend(symbols(convention).map(|symbol| vec![Inline::Math(symbol)]));
    let mut table = Table { caption: rows::dh_caption(convention), head, rows: vec![], keys };
    for (row, parameters) in rows::dh(robot, convention) {
        let name = vec![Inline::text(&row.link)];
        let number = row.moving.map(|index| vec![Inline::Math(Math::integer(index + 1))]);
        let mut cells: Vec<Cell> = match are_numbered(robot) {
            true => vec![number.unwrap_or(name)],
            false => vec![number.unwrap_or(vec![Inline::text("fixed")]), name],
        };
        for parameter in parameters {
            let shown = parameter.shown(|value| formulas.expression(value))?;
            cells.push(vec![Inline::Math(shown)]);
        }
        table.rows.push(cells);
    }
    Ok(table)
}

/// The symbols a, α, d and θ with the indices of their frames.
fn symbols(convention: DhConvention) -> [Math; 4] {
    let own = || Math::Letter('i');
    let along_x = || match convention {
        DhConvention::Standard => own(),
        DhConvention::Modified => parent(),
    };
    [('a', along_x()), ('α', along_x()), ('d', own()), ('θ', own())]
        .map(|(letter, index)| Math::Letter(letter).with_lower(index))
}

/// The index of the parent's frame, i−1.
fn parent() -> Math {
    Math::Row(vec![Math::Letter('i'), Math::Sign('-'), Math::integer(1)])
}

/// The paragraph on the displacements of a row.
fn displacements(convention: DhConvention) -> Block {
    let [a, alpha, d, theta] = symbols(convention);
    let step = |name: &str, axis: char, by: Math| {
        let name = Math::Word(name.to_owned()).with_lower(Math::Letter(axis));
        Math::Row(vec![name, Math::Fenced(Fence::Parentheses, Box::new(by))])
    };
    let along_z = [step("R", 'z', theta), step("T", 'z', d)];
    let along_x = [step("T", 'x', a), step("R", 'x', alpha)];
    let (moves, frames, moved) = match convention {
        DhConvention::Standard => (
            along_z.into_iter().chain(along_x).collect(),
            "The Denavit-Hartenberg frame ",
            parent(),
        ),
        DhConvention::Modified => {
            let [shift, turn] = along_x;
            ([turn, shift].into_iter().chain(along_z).collect(), "The frame ", Math::Letter('i'))
        }
    };
    Block::Paragraph(vec![
        Inline::text(frames),
        Inline::Math(Math::Letter('i')),
        Inline::text(" of a link is reached from that of its parent link, written "),
        Inline::Math(parent()),
        Inline::text(", by "),
        Inline::Math(Math::Row(moves)),
        Inline::text("; joint "),
        Inline::Math(Math::Letter('i')),
        Inline::text(" moves about or along z of frame "),
        Inline::Math(moved),
        Inline::text("."),
    ])
}
