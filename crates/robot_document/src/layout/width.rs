//! The printed width of formulas in points, set in Computer Modern at 10 points.
//!
//! Advance widths, including italic corrections, are those of the font metrics cmmi10 and cmr10. For smaller sizes,
//! they are scaled by the largest ratio among the letters of cmmi7 and cmr7. Spaces are those in chapter 18 of The
//! TeXbook. Estimates are rather too wide than too narrow, so that a line that seems to fit does fit.

use super::math::{Fence, Line, Math, Script};

/// The widths of thin, medium and thick spaces, in pt.
const SPACES: [f64; 3] = [1.667, 2.222, 2.778];

/// The widths of the italic letters a to z, in thousandths of the font size.
const ITALIC_LOWER: [u16; 26] = [
    529, 429, 433, 520, 466, 597, 513, 576, 345, 469, 552, 318, 878, 600, 485, 503, 482, 479, 469,
    361, 572, 521, 743, 572, 526, 509,
];
/// The widths of the italic letters A to Z.
const ITALIC_UPPER: [u16; 26] = [
    750, 809, 786, 856, 796, 782, 786, 912, 518, 651, 921, 681, 1079, 912, 791, 781, 791, 767, 671,
    723, 792, 806, 1083, 907, 803, 754,
];
/// The widths of the upright letters a to z.
const UPRIGHT_LOWER: [u16; 26] = [
    500, 556, 444, 556, 444, 383, 514, 556, 278, 306, 528, 278, 833, 556, 500, 556, 528, 392, 394,
    389, 556, 542, 736, 528, 542, 444,
];
/// The widths of the upright letters A to Z.
const UPRIGHT_UPPER: [u16; 26] = [
    750, 708, 722, 764, 681, 653, 785, 750, 361, 514, 778, 625, 917, 750, 778, 681, 778, 736, 556,
    722, 750, 764, 1042, 750, 775, 611,
];

/// The styles in which formulas are set.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Size {
    Display,
    Text,
    Script,
    ScriptScript,
}

impl Size {
    fn points(self) -> f64 {
        match self {
            Size::Display | Size::Text => 10.0,
            Size::Script => 8.4,
            Size::ScriptScript => 7.0,
        }
    }

    fn of_indices(self) -> Size {
        match self {
            Size::Display | Size::Text => Size::Script,
            _ => Size::ScriptScript,
        }
    }

    fn of_fractions(self) -> Size {
        match self {
            Size::Display => Size::Text,
            other => other.of_indices(),
        }
    }

    fn space(self, kind: usize) -> f64 {
        match self {
            Size::Display | Size::Text => SPACES[kind],
            _ => 0.0,
        }
    }
}

/// The width of a displayed formula, in pt.
#[must_use]
pub fn width(math: &Math) -> f64 {
    measure(math, Size::Display)
}

/// The width of upright text, in pt.
#[must_use]
pub fn text_width(text: &str) -> f64 {
    text.chars().map(upright).sum::<f64>() * 10.0
}

fn upright(character: char) -> f64 {
    let letter = |table: &[u16; 26], first: u8| {
        let place = usize::from((character as u32 as u8).wrapping_sub(first));
        table.get(place).map_or(0.8, |width| f64::from(*width) / 1000.0)
    };
    match character {
        'a'..='z' => letter(&UPRIGHT_LOWER, b'a'),
        'A'..='Z' => letter(&UPRIGHT_UPPER, b'A'),
        '.' | ',' | ':' | ';' | '\'' | '!' | '|' => 0.28,
        ' ' | '-' | '(' | ')' | '[' | ']' => 0.39,
        '0'..='9' | '/' | '*' => 0.51,
        '+' | '=' | '<' | '>' => 0.78,
        '%' | '&' | '#' | '_' | '$' => 0.84,
        // Characters that are printed as their code are as wide as a word.
        other if !other.is_ascii() => 4.5,
        _ => 0.8,
    }
}

fn italic(character: char) -> f64 {
    let place = |first: u8| usize::from((character as u32 as u8).wrapping_sub(first));
    let width = match character {
        'a'..='z' => ITALIC_LOWER.get(place(b'a')),
        'A'..='Z' => ITALIC_UPPER.get(place(b'A')),
        _ => None,
    };
    // Others have the width of the widest Greek letter and the widest sign.
    width.map_or(1.0, |width| f64::from(*width) / 1000.0)
}

fn measure(math: &Math, size: Size) -> f64 {
    let points = size.points();
    match math {
        Math::Number(digits) => {
            digits.chars().map(|digit| if digit == '.' { 0.278 } else { 0.5 }).sum::<f64>() * points
        }
        Math::Letter(letter) => italic(*letter) * points,
        Math::Word(word) => word.chars().map(upright).sum::<f64>() * points,
        Math::Sign('·') => 0.278 * points,
        Math::Sign('×') => 0.778 * points,
        Math::Sign(sign) => upright(*sign).max(if *sign == '-' { 0.778 } else { 0.0 }) * points,
        Math::Function(name) => name.text().chars().map(upright).sum::<f64>() * points,
        Math::Symbol(symbol) => measure(&symbol.shape, size),
        Math::Row(pieces) => row(pieces, size),
        Math::Script(script) => script_width(script, size),
        Math::Accent(_, inside) => measure(inside, size).max(0.5 * points),
        // Bold and upright letters are wider than italic ones by up to a sixth.
        Math::Styled(_, inside) => 1.2 * measure(inside, size),
        Math::Fraction(parts) => {
            let inner = size.of_fractions();
            parts.iter().map(|part| measure(part, inner)).fold(0.0, f64::max) + 2.4
        }
        Math::Root(inside) => measure(inside, size) + points,
        Math::Fenced(Fence::Parentheses | Fence::Brackets, inside) => {
            // Tall contents make the parentheses wider.
            measure(inside, size) + if is_tall(inside) { 1.5 } else { 0.8 } * points
        }
        Math::Fenced(Fence::Bars, inside) => measure(inside, size) + 0.6 * points,
        Math::Matrix(rows) => {
            let columns = rows.iter().map(Vec::len).max().unwrap_or_default();
            let cell = |row: &Vec<Math>, column: usize| {
                row.get(column).map_or(0.0, |entry| measure(entry, Size::Text))
            };
            let widest = |column| rows.iter().map(|row| cell(row, column)).fold(0.0, f64::max);
            // The columns have a gap of 10 pt between them, and each bracket is less than 7 pt wide.
            (0..columns).map(|column| widest(column) + points).sum::<f64>() + 0.4 * points
        }
        Math::Lines(lines) => {
            // A sign at the start of a further line has the same spaces as one within a sum.
            let before = |place| if place > 0 { 2.0 * SPACES[1] } else { 0.0 };
            let width = |(place, line): (usize, &Line)| {
                measure(&line.math, Size::Text) + before(place) + line.indent as f64 * points
            };
            lines.iter().enumerate().map(width).fold(0.0, f64::max)
        }
    }
}

/// Whether fences around a piece grow with it.
fn is_tall(math: &Math) -> bool {
    match math {
        Math::Fraction(_) | Math::Root(_) | Math::Matrix(_) | Math::Lines(_) => true,
        Math::Row(pieces) => pieces.iter().any(is_tall),
        Math::Fenced(_, inside) => is_tall(inside),
        Math::Script(script) => is_tall(&script.base),
        _ => false,
    }
}

fn row(pieces: &[Math], size: Size) -> f64 {
    (0..pieces.len()).map(|place| with_spaces(pieces, place, size)).sum()
}

/// The width of a piece of a displayed row with its spaces, in pt.
pub(super) fn in_row(pieces: &[Math], place: usize) -> f64 {
    with_spaces(pieces, place, Size::Display)
}

fn with_spaces(pieces: &[Math], place: usize, size: Size) -> f64 {
    let Some(piece) = pieces.get(place) else { return 0.0 };
    let spaces = match piece {
        Math::Sign('=') => 2.0 * size.space(2),
        Math::Sign('+' | '-' | '·' | '×' | '*') if place > 0 => 2.0 * size.space(1),
        Math::Sign(',') | Math::Function(_) => size.space(0),
        // The space before and after fences and fractions, or between a function's exponent and its argument.
        Math::Fenced(..) | Math::Fraction(_) => 2.0 * size.space(0),
        Math::Script(_) if piece.is_function() => size.space(0),
        _ => 0.0,
    };
    let before = place.checked_sub(1).and_then(|place| pieces.get(place));
    let is_apart = before.is_some_and(|before| piece.is_apart_from(before));
    // There is a space before a function.
    let is_function = place > 0 && piece.is_function();
    let before = [is_apart, is_function].into_iter().filter(|is_apart| *is_apart).count();
    measure(piece, size) + spaces + before as f64 * size.space(0)
}

fn script_width(script: &Script, size: Size) -> f64 {
    let inner = size.of_indices();
    let index = |part: &Option<Math>| part.as_ref().map_or(0.0, |part| measure(part, inner) + 0.5);
    measure(&script.base, size) + index(&script.lower).max(index(&script.upper))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::read;

    /// Widths of boxes in pt, measured by pdfTeX with the class article at 10 points.
    const MEASURED: [(&str, f64); 12] = [
        (r"M_1 + M_2", 40.597),
        (r"\ddot{q}_1", 8.950),
        (r"0.18645124 \left(M_4 + M_5 + M_6\right)", 124.229),
        (r"\sin q_2 \cos^{2} q_3 \dot{q}_1 \dot{q}_{12}", 74.940),
        (r"\frac{l_1^{2} + l_2^{2}}{2}", 29.956),
        (r"\sqrt{x + y}", 31.532),
        (r"\mathit{ZZR}_1 = \mathit{ZZ}_1 - J_x^{*5}", 83.285),
        (r"\mathit{ZZR}_1\, Y_{1,2} + m_2\, \mathit{XX}_3", 90.842),
        (r"F_{l_x}^{6} \tanh\left(v\right)", 50.235),
        (r"W m w M f", 43.806),
        (r"m \cdot n", 22.005),
        (r"a \times b", 21.799),
    ];

    #[test]
    fn estimates_are_on_the_wide_side_and_near() {
        for (latex, measured) in MEASURED {
            let estimate = width(&read(latex).unwrap());
            // The table is rounded to thousandths of the font size.
            assert!(estimate >= measured - 0.01, "{latex}: {estimate} {measured}");
            assert!(estimate <= 1.2 * measured + 4.0, "{latex}: {estimate} {measured}");
        }
    }

    #[test]
    fn text_is_as_wide_as_its_letters() {
        assert!((text_width("mass") - (8.33 + 5.0 + 2.0 * 3.94)).abs() < 1e-9);
        // This character is printed as its code.
        assert!(text_width("\u{4e2d}") > 40.0);
    }
}
