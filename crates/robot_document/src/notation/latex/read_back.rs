//! The reader of displayed equations in LaTeX.

use super::read::{ReadError, read};
use crate::math::Math;

/// Reads the equations in environments of amsmath as this project prints them: their left and right sides, with further
/// lines joined to the first.
///
/// # Errors
///
/// The first side that is not a formula.
pub fn read_equations(latex: &str) -> Result<Vec<[Math; 2]>, ReadError> {
    let mut equations: Vec<[String; 2]> = vec![];
    for line in latex.lines() {
        let line = line.trim();
        if line.starts_with('%') || line.starts_with(r"\begin") || line.starts_with(r"\end") {
            continue;
        }
        let line = line.trim_end_matches(r"\\").trim_end();
        let line = line.trim_end_matches(r"\notag").trim_end();
        let line = line.split_once(r" \label{").map_or(line, |(formula, _)| formula);
        match (line.split_once("&= "), line.split_once(r"&\quad"), equations.last_mut()) {
            (Some((left, right)), _, _) => equations.push([left.to_owned(), right.to_owned()]),
            // Before the mark of a further line, there is only a piece that takes up the width of the left side.
            (None, Some((_, more)), Some([_, right])) => {
                right.push(' ');
                right.push_str(more);
            }
            _ => {}
        }
    }
    let sides = |[left, right]: [String; 2]| Ok([read(&left)?, read(&right)?]);
    equations.into_iter().map(sides).collect()
}
