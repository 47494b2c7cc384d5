//! Line breaking of long formulas.
//!
//! A line is broken before a `+` or `-` outside of fences. If a term alone does not fit, it is also broken between its
//! factors, after a `·`, and at the signs within its parentheses. A product that takes several lines starts on a line
//! of its own, and its further lines are indented more.

use super::math::{Fence, Math};
use super::width::width;
use crate::error::{Centimeters, Error};
use crate::forms::Equation;

/// A piece that cannot be broken further is wider than a line.
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
pub fn broken(math: &Math, first: f64, rest: f64) -> Result<Vec<Math>, TooWide> {
    let mut lines = Lines { first, rest, reserve: 0.0, done: vec![], line: vec![] };
    for term in terms(math.pieces()) {
        lines.add(term, Joint::Sign)?;
    }
    lines.end();
    Ok(lines.done.into_iter().map(Math::row).collect())
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
) -> Result<Vec<Math>, Error> {
    if equation.is_name() {
        return Ok(vec![Math::default()]);
    }
    let rest = available - number - INDENT;
    let first = available - number - EQUALS;
    let lines = broken(&equation.right, first, rest);
    // On one line, or without a number, the wider lines would not be fewer.
    let is_settled = number <= 0.0 || lines.as_ref().is_ok_and(|lines| lines.len() == 1);
    let wider = || broken(&equation.right, available - EQUALS, available - INDENT).ok();
    let whole = (!is_settled).then(wider).flatten().filter(|lines| lines.len() > 1);
    match (lines, whole.and_then(|lines| beside(lines, rest))) {
        (Ok(lines), Some(whole)) if whole.len() >= lines.len() => Ok(lines),
        (_, Some(whole)) => Ok(whole),
        (lines, None) => lines.map_err(|wide| Error::Narrow {
            name: equation.name.clone(),
            needed: Centimeters::from_points(wide.needed),
            available: Centimeters::from_points(rest),
        }),
    }
}

/// Lines of which the last one fits the room that the number of the equation leaves, if need be by moving its last term to
/// a line of its own.
fn beside(mut lines: Vec<Math>, rest: f64) -> Option<Vec<Math>> {
    let fits = |line: &Math| {
        let indent = if is_within_product(line.pieces()) { DEEPER } else { 0.0 };
        width(line) <= rest - indent
    };
    let last = lines.pop()?;
    if fits(&last) {
        lines.push(last);
        return Some(lines);
    }
    let moved = terms(last.pieces()).last()?.to_vec();
    let kept = last.pieces().len().checked_sub(moved.len()).filter(|kept| *kept > 0)?;
    let kept = last.pieces().get(..kept)?.to_vec();
    let moved = Math::row(moved);
    fits(&moved).then(|| lines.into_iter().chain([Math::row(kept), moved]).collect())
}

/// The way in which a piece is joined to the preceding one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Joint {
    /// By the sign at its beginning.
    Sign,
    /// As a factor.
    Factor,
}

/// An upper bound for the width of a closing parenthesis, in pt.
const PARENTHESIS: f64 = 6.0;
/// The additional indent of lines within a product, in pt.
const DEEPER: f64 = 10.0;

struct Lines {
    first: f64,
    rest: f64,
    /// The width that is reserved for closing parentheses.
    reserve: f64,
    done: Vec<Vec<Math>>,
    line: Vec<Math>,
}

impl Lines {
    fn limit(&self) -> f64 {
        match self.done.is_empty() {
            true => self.first - self.reserve,
            false => self.further(&self.line),
        }
    }

    /// The width of a further line that starts with these pieces.
    fn further(&self, pieces: &[Math]) -> f64 {
        let indent = if is_within_product(pieces) { DEEPER } else { 0.0 };
        self.rest - self.reserve - indent
    }

    fn end(&mut self) {
        if !self.line.is_empty() || self.done.is_empty() {
            self.done.push(std::mem::take(&mut self.line));
        }
    }

    /// Adds pieces to the current line or to a new line, or splits them if neither has enough space.
    fn add(&mut self, pieces: &[Math], joint: Joint) -> Result<(), TooWide> {
        let mut longer = self.line.clone();
        longer.extend_from_slice(pieces);
        if width(&Math::Row(longer.clone())) <= self.limit() {
            self.line = longer;
            return Ok(());
        }
        let dot = Math::Sign('·');
        let joined: Vec<Math> = match joint {
            Joint::Factor if !is_within_product(pieces) => {
                std::iter::once(dot).chain(pieces.iter().cloned()).collect()
            }
            _ => pieces.to_vec(),
        };
        let alone = width(&Math::Row(joined.clone()));
        if !self.line.is_empty() && alone <= self.further(&joined) {
            let opened = self.opened(&joined);
            if opened.is_empty() && self.goes_on_with(pieces) {
                return self.split(pieces, joint, alone);
            }
            self.end();
            self.line = [opened, joined].concat();
            return Ok(());
        }
        let is_product = !pieces.iter().any(|piece| matches!(piece, Math::Fenced(..)));
        if joint == Joint::Sign && is_product && !self.line.is_empty() {
            self.end();
        }
        self.split(pieces, joint, alone)
    }

    /// Removes an opening parenthesis from the end of the line, with the sign before it or as a factor, and returns the
    /// removed pieces. They start the next line if they fit before `next`: a line should not end with `+ (` or `) (`.
    fn opened(&mut self, next: &[Math]) -> Vec<Math> {
        let is_sign = |piece: &Math| matches!(piece, Math::Sign('+' | '-' | '('));
        if self.line.last() != Some(&Math::Sign('(')) {
            return vec![];
        }
        let start = self.line.iter().rposition(|piece| !is_sign(piece)).map_or(0, |last| last + 1);
        let opened = self.line.get(start..).unwrap_or_default().to_vec();
        let before = start.checked_sub(1).and_then(|place| self.line.get(place));
        let is_after_factor = before.is_some_and(|piece| !matches!(piece, Math::Sign(_)));
        let (opened, follows) = match opened.as_slice() {
            [Math::Sign('+' | '-'), ..] => (opened, start > 0),
            [_] => ([Math::Sign('·')].into_iter().chain(opened).collect(), is_after_factor),
            _ => (opened, false),
        };
        let together = [opened.as_slice(), next].concat();
        if !follows || width(&Math::Row(together.clone())) > self.further(&together) {
            return vec![];
        }
        self.line.truncate(start);
        opened
    }

    /// Whether the line is little more than an opened parenthesis, such as `2 (`, and has room for the first one of several
    /// factors: such a line is not left alone.
    fn goes_on_with(&self, pieces: &[Math]) -> bool {
        let is_short = |line: &[Math]| width(&Math::Row(line.to_vec())) <= TAIL * self.rest;
        let is_opened = self.line.last() == Some(&Math::Sign('(')) && is_short(&self.line);
        let factors = factors(pieces);
        is_opened
            && factors.len() > 1
            && factors.first().is_some_and(|factor| {
                width(&Math::Row([self.line.as_slice(), factor].concat())) <= self.limit()
            })
    }

    /// Adds pieces that do not fit on one line.
    fn split(&mut self, pieces: &[Math], joint: Joint, needed: f64) -> Result<(), TooWide> {
        if let Some((signs, inside, tail)) = fenced(pieces) {
            let before = (self.done.clone(), self.line.clone(), self.reserve);
            let fits = width(&Math::Row(tail.to_vec())) <= TAIL * self.rest;
            if fits && self.within(signs, inside, tail, joint).is_ok() {
                return Ok(());
            }
            (self.done, self.line, self.reserve) = before;
            if tail.is_empty() {
                return self.within(signs, inside, tail, joint);
            }
        }
        let factors = factors(pieces);
        if factors.len() < 2 {
            return Err(TooWide { needed });
        }
        let mut start = 0;
        for (place, factor) in factors.iter().enumerate() {
            let joint = if place == 0 { joint } else { Joint::Factor };
            let rest = pieces.get(start..).unwrap_or_default();
            // Short factors after a sum stay on the last line of the sum.
            if place > 0 && rest.len() > factor.len() && has_short_tail(rest, self.rest) {
                let before = (self.done.clone(), self.line.clone(), self.reserve);
                if self.add(rest, joint).is_ok() {
                    return Ok(());
                }
                (self.done, self.line, self.reserve) = before;
            }
            self.add(factor, joint)?;
            start += factor.len();
        }
        Ok(())
    }

    /// Adds a sum in parentheses term by term, and the factors after it on its last line.
    fn within(
        &mut self,
        signs: &[Math],
        inside: &Math,
        tail: &[Math],
        joint: Joint,
    ) -> Result<(), TooWide> {
        let behind = match tail {
            [] => 0.0,
            // Includes the space after a parenthesis.
            tail => width(&Math::Row(tail.to_vec())) + PARENTHESIS,
        };
        self.reserve += PARENTHESIS;
        self.add(&[signs, &[Math::Sign('(')]].concat(), joint)?;
        let mut terms = terms(inside.pieces()).peekable();
        while let Some(term) = terms.next() {
            let behind = if terms.peek().is_none() { behind } else { 0.0 };
            self.reserve += behind;
            self.add(term, Joint::Sign)?;
            self.reserve -= behind;
        }
        self.reserve -= PARENTHESIS;
        self.line.push(Math::Sign(')'));
        self.line.extend_from_slice(tail);
        Ok(())
    }
}

/// The largest width of short factors after a sum, as a fraction of the line.
const TAIL: f64 = 0.4;

/// Splits pieces into signs, a sum in parentheses and the factors after it, if none of these is in fences.
fn fenced(pieces: &[Math]) -> Option<(&[Math], &Math, &[Math])> {
    let is_sign = |piece: &Math| matches!(piece, Math::Sign(_));
    let place = pieces.iter().position(|piece| !is_sign(piece))?;
    let (signs, rest) = pieces.split_at_checked(place)?;
    match rest {
        [Math::Fenced(Fence::Parentheses, inside), tail @ ..]
            if !tail.iter().any(|piece| matches!(piece, Math::Fenced(..))) =>
        {
            Some((signs, inside, tail))
        }
        _ => None,
    }
}

fn has_short_tail(pieces: &[Math], line: f64) -> bool {
    fenced(pieces).is_some_and(|(_, _, tail)| {
        !tail.is_empty() && width(&Math::Row(tail.to_vec())) <= TAIL * line
    })
}

/// Whether a line that starts with these pieces continues a product.
pub(crate) fn is_within_product(line: &[Math]) -> bool {
    line.starts_with(&[Math::Sign('·')])
}

/// The terms of a sum with their signs. A minus sign after an equals sign does not start a term.
pub fn terms(pieces: &[Math]) -> impl Iterator<Item = &[Math]> {
    let stay = |before: &Math, next: &Math| {
        !matches!(next, Math::Sign('+' | '-' | '=')) || matches!(before, Math::Sign('='))
    };
    pieces.chunk_by(stay).filter(|term| !term.is_empty())
}

/// The factors of a term. A sign belongs to the factor after it, a function to its argument, and a `×` to both of its
/// operands.
fn factors(pieces: &[Math]) -> Vec<&[Math]> {
    let stay = |before: &Math, next: &Math| stays_with_next(before) || *next == Math::Sign('×');
    pieces.chunk_by(stay).collect()
}

fn stays_with_next(piece: &Math) -> bool {
    match piece {
        Math::Sign(_) | Math::Function(_) | Math::Letter('s' | 'c') => true,
        Math::Script(script) => stays_with_next(&script.base) && script.lower.is_none(),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::{formula, read};

    fn math(latex: &str) -> Math {
        read(latex).unwrap()
    }

    fn lines(latex: &str, first: f64, rest: f64) -> Vec<String> {
        broken(&math(latex), first, rest).unwrap().iter().map(formula).collect()
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

    #[test]
    fn a_cross_product_stays_whole() {
        let sum = r"a + \varepsilon \times r + \omega \times \left(\omega \times r\right)";
        for first in 60..140 {
            let broken = lines(sum, f64::from(first), 80.0);
            let is_whole = |line: &String| !line.contains(r"\cdot") && !line.starts_with(r"\times");
            assert!(broken.iter().all(is_whole), "{first}: {broken:?}");
        }
    }

    /// The number of an equation stands beside its last line alone.
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
            let last = width(beside.last().unwrap());
            assert!(last <= available - 36.0 - before, "{available}: {last}");
            let printed: String = beside.iter().map(formula).collect();
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
                let room = available - before - width(line);
                assert!(room >= 0.0, "{available} pt, line {place}: {room} pt");
                tight = tight.min(room);
            }
            several += usize::from(lines.len() > 1);
        }
        // The lines also leave no more space than necessary.
        assert!(several > 100 && tight < 1.0, "{several} {tight}");
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
                assert!(width(line) <= limit, "seed {seed}: {} {line:?}", width(line));
                found.push_str(&formula(line));
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
