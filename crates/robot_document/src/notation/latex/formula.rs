//! Formulas as LaTeX.

use robot_model::signs::Letter;

use super::equations::continued;
use crate::math::{Fence, Line, Math, Script};

/// The LaTeX of a formula, for math mode.
#[must_use]
pub fn formula(math: &Math) -> String {
    let mut writer = Writer::default();
    writer.write(math, Spacing::Wide);
    writer.latex
}

/// Whether factors are separated by spaces in the source, which does not change the printed formula.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Spacing {
    Wide,
    Tight,
}

#[derive(Default)]
struct Writer {
    latex: String,
}

impl Writer {
    /// Appends text, with a space before a letter that would become part of the preceding command.
    fn push(&mut self, text: &str) {
        if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
            let head = self.latex.trim_end_matches(|c: char| c.is_ascii_alphabetic());
            if head.len() < self.latex.len() && head.ends_with('\\') {
                self.latex.push(' ');
            }
        }
        self.latex.push_str(text);
    }

    fn group(&mut self, inside: &Math, spacing: Spacing) {
        self.push("{");
        self.write(inside, spacing);
        self.push("}");
    }

    fn command(&mut self, command: &str) {
        self.push("\\");
        self.latex.push_str(command);
    }

    fn write(&mut self, math: &Math, spacing: Spacing) {
        match math {
            Math::Number(digits) => self.push(digits),
            Math::Letter(letter) if letter.is_ascii_alphabetic() => {
                self.push(letter.encode_utf8(&mut [0; 4]));
            }
            Math::Letter(letter) => {
                self.command(Letter::of_character(*letter).map_or("relax", |known| known.latex));
            }
            Math::Word(word) => {
                self.push(r"\mathrm{");
                self.latex.push_str(&super::text::in_math(word));
                self.latex.push('}');
            }
            Math::Sign('·') => self.push(r"\cdot"),
            Math::Sign('×') => self.push(r"\times"),
            Math::Sign(sign) => self.push(sign.encode_utf8(&mut [0; 4])),
            Math::Function(name) => self.push(name.latex()),
            Math::Symbol(symbol) => self.write(&symbol.shape, Spacing::Tight),
            Math::Row(pieces) => self.row(pieces, spacing),
            Math::Script(script) => self.script(script, spacing),
            Math::Accent(accent, inside) => {
                self.command(accent.latex());
                self.group(inside, Spacing::Tight);
            }
            Math::Styled(font, inside) => {
                self.command(font.latex());
                self.group(inside, Spacing::Tight);
            }
            Math::Fraction(parts) => {
                self.push(r"\frac");
                for part in parts.iter() {
                    self.group(part, spacing);
                }
            }
            Math::Root(inside) => {
                self.push(r"\sqrt");
                self.group(inside, spacing);
            }
            Math::Fenced(fence, inside) => {
                let [open, close] = match fence {
                    Fence::Parentheses => [r"\left(", r"\right)"],
                    Fence::Bars => [r"\left|", r"\right|"],
                    Fence::Brackets => [r"\left[", r"\right]"],
                };
                self.push(open);
                self.write(inside, spacing);
                self.push(close);
            }
            Math::Matrix(rows) => self.matrix(rows),
            Math::Lines(lines) => self.lines(lines),
        }
    }

    fn row(&mut self, pieces: &[Math], spacing: Spacing) {
        for (place, piece) in pieces.iter().enumerate() {
            let before = place.checked_sub(1).and_then(|place| pieces.get(place));
            if before.is_some_and(|before| piece.is_apart_from(before)) {
                self.push(r"\,");
            }
            if spacing == Spacing::Wide
                && before.is_some_and(|before| needs_gap(before, place, piece))
            {
                self.latex.push(' ');
            }
            match piece {
                Math::Row(_) => self.group(piece, spacing),
                _ => self.write(piece, spacing),
            }
        }
    }

    fn script(&mut self, script: &Script, spacing: Spacing) {
        match &script.base {
            // A base with indices of its own needs a group.
            Math::Script(_) | Math::Row(_) => self.group(&script.base, Spacing::Tight),
            base => self.write(base, spacing),
        }
        for (sign, index) in [("_", &script.lower), ("^", &script.upper)] {
            let Some(index) = index else { continue };
            self.push(sign);
            match index {
                Math::Number(digits) if digits.len() == 1 && sign == "_" => self.push(digits),
                Math::Letter(letter) if letter.is_ascii() => self.write(index, Spacing::Tight),
                _ => self.group(index, Spacing::Tight),
            }
        }
    }

    fn matrix(&mut self, rows: &[Vec<Math>]) {
        // A column with entries of several lines is aligned at the left, and its entries are further apart than their
        // lines. Rows with fractions would touch.
        let entries = || rows.iter().flatten();
        let is_fraction = |piece: &Math| matches!(piece, Math::Fraction(_));
        let [begin, gap, end] = if entries().any(|entry| matches!(entry, Math::Lines(_))) {
            [r"\left[\begin{array}{@{}l@{}}", r" \\[6pt] ", r" \end{array}\right]"]
        } else if entries().any(|entry| entry.pieces().iter().any(is_fraction)) {
            [r"\begin{bmatrix}", r" \\[2pt] ", r" \end{bmatrix}"]
        } else {
            [r"\begin{bmatrix}", r" \\ ", r" \end{bmatrix}"]
        };
        self.push(begin);
        for (place, row) in rows.iter().enumerate() {
            self.push(if place == 0 { " " } else { gap });
            for (column, entry) in row.iter().enumerate() {
                self.push(if column == 0 { "" } else { " & " });
                self.write(entry, Spacing::Wide);
            }
        }
        self.push(end);
    }

    /// The lines of an entry, aligned with its row by the last line, from which the gap to the next entry is measured.
    fn lines(&mut self, lines: &[Line]) {
        self.push(r"\begin{array}[b]{@{}l@{}}");
        for (place, line) in lines.iter().enumerate() {
            match place {
                0 => {
                    self.push(" ");
                    self.write(&line.math, Spacing::Wide);
                }
                _ => self.push(&format!(r" \\ {}", continued(line))),
            }
        }
        self.push(r" \end{array}");
    }
}

/// Whether two neighbors are separated by a space in the source.
fn needs_gap(before: &Math, place: usize, piece: &Math) -> bool {
    match (before, piece) {
        // There is no space after the letters s and c of sines and cosines, or after a sign before the first term.
        (Math::Letter(_), _) => false,
        (Math::Script(script), _) if matches!(script.base, Math::Letter('s' | 'c')) => {
            script.lower.is_some() || matches!(piece, Math::Sign(_))
        }
        (Math::Sign('-' | '+'), _) if place == 1 => false,
        (Math::Function(_), Math::Fenced(..)) | (_, Math::Sign(',')) => false,
        _ => true,
    }
}
