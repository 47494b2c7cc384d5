//! Line breaking of long formulas.
//!
//! A line can start at a `+` or `-`, or within a product at a factor, after a `·`, both also within parentheses. Each
//! line and each break has a cost; the lines with the lowest total cost are used. A break costs more within a product,
//! and within parentheses the more, the shorter their sum is. A product that takes several lines preferably starts on a
//! line of its own, and its further lines are indented more. Lines that start within parentheses are indented more than
//! the term that contains them, if the lines are wide enough. The numerator of a fraction that is too wide for a line is
//! written beside it.

mod fractions;
mod sequence;

use sequence::Sequence;

use super::math::{Line, Math};
use super::width::text_width;
use crate::error::{Centimeters, Error};
use crate::forms::Equation;

/// The error for a piece that cannot be broken and is wider than a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooWide {
    /// The width of the piece, in pt.
    pub needed: f64,
}

/// Breaks a formula into lines. The first line is at most `first` points wide, and the following ones at most `rest`.
///
/// # Errors
///
/// If a piece that cannot be broken does not fit on a line.
pub fn broken(math: &Math, first: f64, rest: f64) -> Result<Vec<Line>, TooWide> {
    lines_of(math, Limits { first, rest, number: 0.0 })
}

/// The lines of a formula; the numerators of fractions are written beside them only if it has no lines otherwise.
fn lines_of(math: &Math, limits: Limits) -> Result<Vec<Line>, TooWide> {
    let whole = |math: &Math| {
        let lines = |deepest| Sequence::new(math, limits.rest, deepest).lines(limits);
        lines(DEEPEST).or_else(|_| lines(0))
    };
    whole(math).or_else(|wide| {
        let narrowest = limits.first.min(limits.rest - limits.number);
        let split = fractions::split(math, narrowest * WIDEST_FRACTION).ok_or(wide)?;
        whole(&split)
    })
}

/// The largest indent of a line that starts with a term within parentheses, in quads. If a formula does not fit with
/// such indents, it has none.
const DEEPEST: usize = 3;

/// The largest width of a fraction that is kept whole in a formula that is too wide otherwise, as a part of a line.
const WIDEST_FRACTION: f64 = 0.5;

/// The width of the numbers of equations up to the largest one, in parentheses, with the distance from the equations,
/// in pt.
pub(crate) fn number_width(largest: usize) -> f64 {
    let digits = largest.max(1).ilog10() + 1;
    text_width("()") + 5.0 * f64::from(digits) + 6.0
}

/// The width of an equals sign with its spaces, in pt.
const EQUALS: f64 = 13.4;
/// The indent of further lines, with the spaces around the sign at their beginning, in pt.
const INDENT: f64 = 14.5;

/// Breaks the right side of an equation into lines; `available` is the width beside the left side, in points. The last
/// line leaves `number` points of it for the number of the equation.
///
/// # Errors
///
/// If a piece that cannot be broken does not fit on a line.
pub(crate) fn right_side(
    equation: &Equation,
    available: f64,
    number: f64,
) -> Result<Vec<Line>, Error> {
    if equation.is_name() {
        return Ok(vec![Line { math: Math::default(), indent: 0 }]);
    }
    let limits = Limits { first: available - EQUALS, rest: available - INDENT, number };
    lines_of(&equation.right, limits).map_err(|wide| Error::Narrow {
        name: equation.name.clone(),
        needed: Centimeters::from_points(wide.needed),
        available: Centimeters::from_points(limits.rest - number),
    })
}

/// The widths of lines, in pt.
#[derive(Clone, Copy)]
struct Limits {
    first: f64,
    rest: f64,
    /// The width that the last line leaves free for the number.
    number: f64,
}

/// The terms of a sum with their signs. A minus sign after an equals sign does not start a term.
pub fn terms(pieces: &[Math]) -> impl Iterator<Item = &[Math]> {
    let stay = |before: &Math, next: &Math| !starts_term(before, next);
    pieces.chunk_by(stay).filter(|term| !term.is_empty())
}

fn starts_term(before: &Math, next: &Math) -> bool {
    matches!(next, Math::Sign('+' | '-' | '=')) && !matches!(before, Math::Sign('='))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{formula, read};
    use crate::layout::width::width;

    fn math(latex: &str) -> Math {
        read(latex).unwrap()
    }

    fn lines(latex: &str, first: f64, rest: f64) -> Vec<String> {
        broken(&math(latex), first, rest).unwrap().iter().map(|line| formula(&line.math)).collect()
    }

    #[test]
    fn lines_break_before_signs_where_they_must() {
        let sum = "a_1 + b_2 - c_3";
        assert_eq!(lines(sum, 60.0, 60.0), [sum]);
        assert_eq!(lines(sum, 50.0, 50.0), ["a_1 + b_2", "-c_3"]);
        assert_eq!(lines(sum, 20.0, 50.0), ["a_1", "+b_2 - c_3"]);
        // A sign after an equals sign belongs to the number.
        assert_eq!(lines("a + b = -0.125", 45.0, 60.0), ["a+ b", "= - 0.125"]);
    }

    #[test]
    fn a_long_product_starts_on_a_line_of_its_own() {
        let sum = r"a - 0.0125 \sin q_1 \cos q_1 \sin q_2 \cos q_2 + b";
        let expected = ["a", r"-0.0125 \sin q_1 \cos q_1", r"\cdot \sin q_2 \cos q_2 + b"];
        assert_eq!(lines(sum, 100.0, 100.0), expected);
    }

    #[test]
    fn short_factors_stay_with_the_sum_before_them() {
        let product = r"m \left(a_1 + a_2 + a_3 + a_4\right) \cos q_2 + b";
        assert_eq!(lines(product, 95.0, 95.0), ["m( a_1 + a_2 + a_3", r"+a_4 ) \cos q_2 + b"]);
        let alone = r"-\left(a_1 + a_2 + a_3 + a_4\right) \sin q_5";
        assert_eq!(lines(alone, 95.0, 95.0), ["-( a_1 + a_2 + a_3", r"+a_4 ) \sin q_5"]);
    }

    #[test]
    fn a_line_does_not_end_with_what_opens_a_sum() {
        let sum = r"c_1 + c_2 + \left(a_1 a_2 a_3 a_4 + b_2\right) \cos q_2";
        for first in 40..140 {
            let broken = lines(sum, f64::from(first), 80.0);
            assert!(broken.iter().all(|line| !line.ends_with('(')), "{first}: {broken:?}");
        }
        let product = r"\left(c_1 + c_2\right) \left(a_1 a_2 a_3 a_4 + b_2\right)";
        for first in 60..140 {
            let broken = lines(product, f64::from(first), 90.0);
            assert!(broken.iter().all(|line| !line.ends_with('(')), "{first}: {broken:?}");
        }
    }

    #[test]
    fn a_line_is_more_than_a_factor_and_what_opens_a_sum() {
        let sum =
            r"2 \left(\left(a_1 + a_2\right) \left(b_1 + b_2\right) c_3 + d_4 + e_5\right) f_6";
        for first in 100..200 {
            let broken = lines(sum, f64::from(first), f64::from(first));
            assert!(broken.iter().all(|line| line != "2("), "{first}: {broken:?}");
        }
    }

    /// This also holds for a sum within a sum.
    #[test]
    fn a_line_never_ends_with_a_parenthesis() {
        let product = r"\left(\left(c_1 c_2 c_3 + c_4\right) d_1 - d_2 d_3\right) e_1";
        let sum = format!(
            r"a_1 - \left(\left(b_1 + b_2\right) {product} + 2 {product}\right) \dot{{q}}_2^{{2}}"
        );
        for width in (60..240).map(f64::from) {
            let broken = lines(&sum, width, width);
            assert!(broken.iter().all(|line| !line.ends_with('(')), "{width}: {broken:?}");
        }
    }

    #[test]
    fn a_short_factor_has_no_line_of_its_own() {
        let product = r"\left(J_1 - J_2\right) \sin q_5 \cos q_5 \cdot \dot{q}_2^{2}";
        for width in (80..140).map(f64::from) {
            let broken = lines(product, width, width);
            let is_alone = |line: &String| line == r"\cdot \dot{q}_2^{2}";
            assert!(!broken.iter().any(is_alone), "{width}: {broken:?}");
        }
    }

    /// A break before a term or within a sum is better.
    #[test]
    fn factors_have_no_line_of_their_own_behind_a_sum() {
        let sum =
            r"a_1 + \left(0.3839 + 0.0012 \cos q_5 + 0.0076 \sin q_4\right) \cos q_3 \sin q_5 + b";
        for width in (110..200).map(f64::from) {
            let broken = lines(sum, width, width);
            let is_alone = |line: &String| line.starts_with(r"\cdot") && !line.contains('+');
            assert!(!broken.iter().any(is_alone), "{width}: {broken:?}");
        }
    }

    #[test]
    fn a_short_sum_stays_whole() {
        let sum = r"2 \left(\left(M_4 + M_5\right) \left(l_4 + q_4\right) a + M_5 l_5 b\right) c";
        for width in (100..180).map(f64::from) {
            let broken = lines(sum, width, width).join("|");
            for whole in [r"\left(M_4 + M_5\right)", r"\left(l_4 + q_4\right)"] {
                assert!(broken.contains(whole), "{width}: {broken}");
            }
        }
    }

    /// Lines within parentheses are indented more than the term that contains them, and more again if this term continues
    /// on a line of its own.
    #[test]
    fn lines_within_parentheses_are_indented() {
        let sum = r"a_1 + m \left(b_1 + n \left(c_1 + c_2 + c_3\right) + b_2\right) k_1 k_2 k_3 \left(d_1 + d_2 + d_3\right) + e_1";
        let found = broken(&math(sum), 60.0, 75.0).unwrap();
        let shown: Vec<_> = found.iter().map(|line| (line.indent, formula(&line.math))).collect();
        let shown: Vec<_> = shown.iter().map(|(indent, line)| (*indent, line.as_str())).collect();
        let expected = [
            (0, "a_1"),
            (0, "+m( b_1 + n( c_1"),
            (2, "+c_2 + c_3 )"),
            (1, "+b_2 ) k_1 k_2 k_3"),
            (1, r"\cdot ( d_1 + d_2"),
            (2, "+d_3 ) + e_1"),
        ];
        assert_eq!(shown, expected);
        // Without the width for it, they are not.
        let deep = r"a \left(b + \left(c + \left(d_{123456} + e_{123456}\right)\right)\right)";
        let [narrow, wide] = [60.0, 90.0].map(|width| broken(&math(deep), width, width).unwrap());
        let deepest = |lines: &[Line]| lines.iter().map(|line| line.indent).max();
        assert_eq!([deepest(&narrow), deepest(&wide)], [Some(0), Some(3)]);
    }

    /// A number and its power of ten are one factor.
    #[test]
    fn a_power_of_ten_stays_with_its_number() {
        let product = r"5.8464 \cdot 10^{-5} \cos q_2 \sin q_4 + a_1";
        for width in (75..140).map(f64::from) {
            let broken = lines(product, width, width);
            assert!(!broken.iter().any(|line| line.starts_with(r"\cdot 10")), "{broken:?}");
        }
    }

    #[test]
    fn a_cross_product_stays_whole() {
        let sum = r"a + \varepsilon \times r + \omega \times \left(\omega \times r\right)";
        for first in 60..140 {
            let broken = lines(sum, f64::from(first), 80.0);
            let is_whole = |line: &String| !line.contains(r"\cdot") && !line.starts_with(r"\times");
            assert!(broken.iter().all(is_whole), "{first}: {broken:?}");
        }
    }

    /// The number of an equation stands beside its last line only.
    #[test]
    fn lines_before_the_last_one_take_the_room_of_the_number() {
        let right = math("a_1 + a_2 + a_3 + a_4 + a_5 + a_6 + a_7");
        let equation =
            Equation { name: "Q1".to_owned(), text: String::new(), left: math("Q_1"), right };
        let mut fewer = 0;
        for available in (90..200).map(f64::from) {
            let [whole, beside] =
                [0.0, 36.0].map(|number| right_side(&equation, available, number).unwrap());
            let narrow = right_side(&equation, available - 36.0, 0.0).unwrap();
            assert!((whole.len()..=narrow.len()).contains(&beside.len()), "{available}");
            let before = if beside.len() == 1 { EQUALS } else { INDENT };
            let last = width(&beside.last().unwrap().math);
            assert!(last <= available - 36.0 - before, "{available}: {last}");
            let printed: String = beside.iter().map(|line| formula(&line.math)).collect();
            assert_eq!(printed.replace(' ', ""), formula(&equation.right).replace(' ', ""));
            fewer += usize::from(beside.len() < narrow.len());
        }
        assert!(fewer > 10, "{fewer}");
    }

    #[test]
    fn sums_in_parentheses_break_within() {
        let sum = r"m \left(a_1 + a_2 + a_3 + a_4\right) + b";
        assert_eq!(lines(sum, 80.0, 80.0), ["m( a_1 + a_2 + a_3", "+a_4 ) + b"]);
    }

    /// The width reserved for closing parentheses is available again after them.
    #[test]
    fn lines_behind_parentheses_are_as_long_as_before() {
        let long = |letter: &str| [1, 2, 3, 4, 5, 6].map(|k| format!("{letter}_{k}")).join(" + ");
        let sum = format!(r"m \left({}\right) + n \left({}\right)", long("a"), long("b"));
        let tail = "+c_1 + c_2 + c_3 + c_4";
        let limit = width(&math(tail)) + 0.5;
        let found = lines(&format!("{sum} {tail} + c_5"), limit, limit);
        assert_eq!(found.last().map(String::as_str), Some("+c_5"), "{found:?}");
        assert!(found.contains(&tail.to_owned()), "{found:?}");
    }

    /// In 10 pt type an equals sign is 7.78 pt wide, with two thick spaces of 2.78 pt; further lines
    /// start with a quad, 10 pt, and a sign with two medium spaces of 2.22 pt.
    #[test]
    fn a_right_side_leaves_room_for_the_equals_sign_and_the_indent() {
        let sums: Vec<String> = (1..6).map(random_sum).collect();
        let right = math(&sums.join(" + "));
        let left = math("Q_1");
        let equation = Equation { name: "Q1".to_owned(), text: String::new(), left, right };
        let (mut several, mut tight) = (0, f64::INFINITY);
        for available in (120..400).map(f64::from) {
            let lines = right_side(&equation, available, 0.0).unwrap();
            for (place, line) in lines.iter().enumerate() {
                let before = if place == 0 { 7.78 + 2.0 * 2.78 } else { 10.0 + 2.0 * 2.22 };
                let room = available - before - 10.0 * line.indent as f64 - width(&line.math);
                assert!(room >= 0.0, "{available} pt, line {place}: {room} pt");
                tight = tight.min(room);
            }
            several += usize::from(lines.len() > 1);
        }
        // The lines also leave no more space than necessary.
        assert!(several > 100 && tight < 1.0, "{several} {tight}");
    }

    /// Otherwise a long numerator has no line.
    #[test]
    fn the_numerator_of_a_wide_fraction_is_written_beside_it() {
        let sum = r"\frac{p\left(a_1 + a_2 + a_3\right)}{r}";
        assert_eq!(lines(sum, 90.0, 90.0), [sum]);
        assert_eq!(lines(sum, 60.0, 60.0), [r"\frac{1}{r} p( a_1 + a_2", "+a_3 )"]);
        let terms = r"\frac{a_1 + a_2 + a_3}{r} + b";
        assert_eq!(lines(terms, 60.0, 60.0), [r"\frac{1}{r} ( a_1 + a_2", "+a_3 ) + b"]);
        let number = r"\frac{3 a_1 a_2 a_3 a_4}{r}";
        assert_eq!(lines(number, 35.0, 45.0), [r"\frac{3}{r} a_1 a_2", r"\cdot a_3 a_4"]);
    }

    #[test]
    fn a_piece_without_a_break_is_refused() {
        let wide = broken(&math("1.23456789012345678901"), 50.0, 50.0).unwrap_err();
        assert!(wide.needed > 100.0, "{wide:?}");
        assert!(broken(&math("a + b_{1234567890123}"), 50.0, 50.0).is_err());
    }

    /// No piece is lost and no line is too wide, for all widths.
    #[test]
    fn lines_fit_and_hold_all() {
        for seed in 1..200_u32 {
            let sum = math(&random_sum(seed));
            let [first, rest] = [seed % 60 + 70, seed % 90 + 90].map(f64::from);
            let lines = broken(&sum, first, rest).unwrap();
            let mut found = String::new();
            for (place, line) in lines.iter().enumerate() {
                let limit = if place == 0 { first } else { rest };
                let width = width(&line.math) + 10.0 * line.indent as f64;
                assert!(width <= limit, "seed {seed}: {width} {line:?}");
                found.push_str(&formula(&line.math));
            }
            let bare = |latex: &str| {
                let fences = latex.replace(r"\left(", "(").replace(r"\right)", ")");
                fences.replace(r"\cdot", "").replace([' ', '{', '}'], "")
            };
            assert_eq!(bare(&found), bare(&formula(&sum)), "seed {seed}");
        }
    }

    fn random_sum(seed: u32) -> String {
        let mut state = seed;
        let mut next = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % below
        };
        let factors = [r"\sin q_1", r"\cos^{2} q_2", "m_3", r"\dot{q}_1", "l_{4}^{2}"];
        let mut sum = String::from("1.5");
        for _ in 0..next(12) + 1 {
            sum.push_str(if next(2) == 0 { " + " } else { " - " });
            for _ in 0..next(8) + 1 {
                sum.push_str(factors[next(5) as usize]);
                sum.push(' ');
            }
            if next(3) == 0 {
                sum.push_str(r"\left(a_1 + 0.25 b_{2} - c_3 \dot{q}_2 + d\right)");
            }
        }
        sum
    }
}
