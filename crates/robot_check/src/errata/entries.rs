//! Splits a text into equations, each with its range of bytes in the file.

use std::ops::Range;

use robot_model::diagnostic::{Diagnostic, Span, code, quote};

use super::printed::Notation;
use super::unprinted::{blanked, printed, without_comments, without_dollars};

/// The environments that display equations, without the star.
pub(super) const DISPLAYS: [&str; 11] = [
    "equation",
    "align",
    "gather",
    "multline",
    "eqnarray",
    "flalign",
    "alignat",
    "displaymath",
    "IEEEeqnarray",
    "dmath",
    "empheq",
];
/// The displays and columns whose arguments follow their name, in brackets and in braces.
const WITH_ARGUMENTS: [&str; 5] = ["alignat", "array", "IEEEeqnarray", "dmath", "empheq"];
/// The environments within these that only arrange equations.
const ARRANGED: [&str; 4] = ["split", "aligned", "gathered", "alignedat"];
/// The environment of a system of equations in a brace, or of the alternatives of a value.
const CASES: &str = "cases";
/// The environments that contain columns.
const COLUMNS: [&str; 7] =
    ["bmatrix", "pmatrix", "matrix", "Bmatrix", "vmatrix", "smallmatrix", "array"];

/// The command that takes the place of a left side which the preceding display printed.
const PHANTOM: &str = r"\phantom{";
/// The maximum number of bytes of a left side in `\phantom`.
const LONGEST_LEFT_SIDE: usize = 1000;
/// The maximum number of bytes between the displays of one equation.
const LONGEST_PROSE: usize = 1000;

/// A printed equation in the text of the file, in which comments and marks are replaced by spaces.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    text: String,
    /// The position of the entry's first byte in the file.
    start: usize,
    /// The equation number in `\tag`.
    pub(super) number: Option<String>,
}

/// A part of an entry, with its bytes in the file.
#[derive(Clone, Debug)]
pub(super) struct Part<'e> {
    pub(super) text: &'e str,
    pub(super) span: Span,
}

impl Entry {
    /// The two sides of the equation.
    pub(super) fn sides(
        &self,
        notation: Notation,
    ) -> Result<(Part<'_>, Part<'_>), Box<Diagnostic>> {
        let whole = self.part(0..self.text.len());
        let Some(place) = self.text.find('=') else {
            return Err(not_an_equation(&whole.trimmed(), notation).into());
        };
        let left = self.part(0..place).trimmed();
        if left.text.is_empty() {
            let error = unnamed(&self.part(place..place + 1).span);
            return Err(error
                .because("a chain `Q1 = a = b` is not read: leave one right side")
                .into());
        }
        Ok((left, self.part(place + 1..self.text.len())))
    }

    fn part(&self, range: Range<usize>) -> Part<'_> {
        let text = self.text.get(range.clone()).unwrap_or_default();
        Part { text, span: self.start + range.start..self.start + range.end }
    }
}

impl<'e> Part<'e> {
    fn sub(&self, range: Range<usize>) -> Part<'e> {
        let text = self.text.get(range.clone()).unwrap_or_default();
        Part { text, span: self.span.start + range.start..self.span.start + range.end }
    }

    /// The part without alignment marks and spaces at its ends.
    fn trimmed(&self) -> Part<'e> {
        let mark = |c: char| c.is_whitespace() || c == '&';
        let start = self.text.len() - self.text.trim_start_matches(mark).len();
        let end = self.text.trim_end_matches(mark).len().max(start);
        self.sub(start..end)
    }

    /// The rows of a column; `None` if the part is not a column.
    pub(super) fn rows(&self) -> Result<Option<Vec<Part<'e>>>, Box<Diagnostic>> {
        let Some((name, open, inside)) = environment(self.text, &COLUMNS) else {
            return Ok(None);
        };
        let close = format!(r"\end{{{name}}}");
        let Some(end) = self.text.get(inside..).and_then(|rest| rest.find(&close)) else {
            let error = Diagnostic::error(code::EXPRESSION, format!("`{name}` is not closed"));
            let error = error.at(&self.sub(open..inside).span, "");
            return Err(error.help(format!("add `{close}`")).into());
        };
        let (before, after) = (0..open, inside + end + close.len()..self.text.len());
        for around in [before, after] {
            let around = self.sub(around);
            let bracket = |c: char| " \t\r\n()[].,;&\\".contains(c);
            let rest = around.text.replace(r"\left", "").replace(r"\right", "").replace(r"\,", "");
            if !rest.chars().all(bracket) {
                let is_matrix = self.text.get(inside..end + inside).is_some_and(has_column_mark);
                if is_matrix || around.text.contains(r"\begin{") {
                    return Err(of_matrices(&around.trimmed().span).into());
                }
                let error = Diagnostic::error(
                    code::EXPRESSION,
                    "these terms stand outside the column vector",
                );
                let error = error.at(&around.trimmed().span, "");
                return Err(error.help("write them in its rows").into());
            }
        }
        let columns = self.sub(inside..inside + end);
        let mut rows: Vec<Part<'e>> =
            row_ranges(columns.text).into_iter().map(|range| columns.sub(range)).collect();
        // A line break after the last row does not begin another row.
        if rows.last().is_some_and(|row| row.text.trim().is_empty()) {
            rows.pop();
        }
        Ok(Some(rows))
    }
}

/// Whether a row or matrix has several columns.
pub(super) fn has_column_mark(text: &str) -> bool {
    text.contains('&')
}

/// The error for an equation of matrices or vectors.
pub(super) fn of_matrices(span: &Span) -> Diagnostic {
    let message = "this is an equation of matrices or vectors that is not compared";
    let help = "write an equation for each entry, such as `\\tau_1 = …`";
    Diagnostic::error(code::EXPRESSION, message).at(span, "").help(help)
}

/// The error for text without `=`, which may be a heading between equations or the continuation of one.
fn not_an_equation(part: &Part<'_>, notation: Notation) -> Diagnostic {
    let in_words = |c: char| c.is_alphanumeric() || matches!(c, ' ' | ',' | ':' | '.');
    let is_heading = part.text.contains(' ') && part.text.chars().all(in_words);
    let help = if part.text.starts_with(['+', '-', '*']) {
        "begin a line that continues an equation with a space"
    } else if notation == Notation::Latex {
        "write `quantity = terms`; begin a line of words with `%`, or put the equations in displays such as `equation`, `align` or `\\[ \\]`"
    } else if is_heading {
        "begin a heading with `#`; of the forms that `equations` prints, `expanded` and `collected` without friction can be read"
    } else {
        "write `quantity = terms`, with a number such as `(31)` in front if it has one"
    };
    let error = Diagnostic::error(code::EXPRESSION, "the equation has no `=`");
    error.at(&part.span, "").help(help)
}

/// The error for a left side that is not a quantity.
pub(super) fn unnamed(span: &Span) -> Diagnostic {
    let message = "expected a quantity on the left side, such as `F_l5.x` or `Q1`";
    let help = "in LaTeX `F_{l_x}^{5}` or `Q_{1}`";
    Diagnostic::error(code::EXPRESSION, message).at(span, "").help(help)
}

/// The entries of a text, with errors in its arrangement.
pub(super) fn entries(text: &str, notation: Notation) -> Vec<Result<Entry, Box<Diagnostic>>> {
    match notation {
        Notation::Text => {
            let text = without_comments(text, notation);
            lines(&text, &text)
        }
        Notation::Latex => {
            let text = rejoined(&printed(&without_comments(text, notation)));
            let displays = displays(&text);
            match displays.is_empty() {
                true => lines(&without_dollars(&text), &text),
                false => rows(&text, displays),
            }
        }
    }
}

/// One entry for each line and the lines that follow it and are indented in the file.
fn lines(text: &str, file: &str) -> Vec<Result<Entry, Box<Diagnostic>>> {
    let mut ranges: Vec<Range<usize>> = vec![];
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let range = start..start + line.trim_end().len();
        let is_indented = file.get(start..).is_some_and(|rest| rest.starts_with([' ', '\t']));
        start += line.len();
        match ranges.last_mut() {
            _ if range.is_empty() => {}
            Some(last) if is_indented => last.end = range.end,
            _ => ranges.push(range),
        }
    }
    ranges.into_iter().map(|range| Ok(entry(text, range))).collect()
}

/// The entry of a range of bytes, without `\tag` and `\label`.
fn entry(text: &str, range: Range<usize>) -> Entry {
    let own = text.get(range.clone()).unwrap_or_default();
    let (mut number, mut marks, mut place) = (None, vec![], 0);
    while let Some(found) = own.get(place..).and_then(|rest| rest.find('\\')) {
        let start = place + found;
        place = start + 1;
        let rest = own.get(place..).unwrap_or_default();
        let mark = ["tag*{", "tag{", "label{", "intertext{", "shortintertext{"]
            .into_iter()
            .find(|mark| rest.starts_with(mark));
        if let Some(mark) = mark {
            let length = rest.find('}').unwrap_or(rest.len());
            if mark.starts_with("tag") {
                let given = rest.get(mark.len()..length).unwrap_or_default();
                number = Some(quote(given.trim_matches([' ', '(', ')'])));
            }
            place = (place + length + 1).min(own.len());
            marks.push(start..place);
        }
    }
    Entry { text: blanked(own, &marks), start: range.start, number }
}

/// Joins equations that continue in the next display, which begins with `\phantom` of their left side. Between the two
/// parts, only a line break and spaces remain. Other `\phantom` become spaces, too, because they print nothing.
fn rejoined(text: &str) -> String {
    let phantoms = text.match_indices(PHANTOM).filter_map(|(place, _)| {
        let end = phantom_end(text, place)?;
        Some((seam(text, place), place..end))
    });
    let phantoms: Vec<_> = phantoms.collect();
    let start = |(seam, own): &(Option<usize>, Range<usize>)| seam.unwrap_or(own.start)..own.end;
    let mut whole = blanked(text, &phantoms.iter().map(start).collect::<Vec<_>>());
    for seam in phantoms.iter().filter_map(|(seam, _)| *seam) {
        whole.replace_range(seam..seam + 2, r"\\");
    }
    whole
}

/// The end of the `\phantom` at `place`.
fn phantom_end(text: &str, place: usize) -> Option<usize> {
    let inside = place + PHANTOM.len();
    let mut depth = 1_usize;
    let close = text.get(inside..)?.bytes().take(LONGEST_LEFT_SIDE).position(|byte| {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    Some(inside + close + 1)
}

/// The end of the preceding display, if the `\phantom` at `place` begins a display of the same name and there is none
/// between them.
fn seam(text: &str, place: usize) -> Option<usize> {
    let before = text.get(..place)?.trim_end_matches(|c: char| c.is_whitespace() || c == '&');
    let open = before.len() - before.bytes().rev().take(24).position(|byte| byte == b'\\')? - 1;
    let name = before.get(open..)?.strip_prefix(r"\begin{")?.strip_suffix('}')?;
    let end = format!(r"\end{{{name}}}");
    // The start of the search may be in the middle of a character.
    let near =
        (open.saturating_sub(LONGEST_PROSE)..=open).find_map(|start| text.get(start..open))?;
    let (_, between) = near.rsplit_once(end.as_str())?;
    let others = [r"\begin{", r"\end{", r"\[", "$$"];
    let is_display = DISPLAYS.contains(&name.trim_end_matches('*'));
    (is_display && !others.iter().any(|other| between.contains(other)))
        .then(|| open - between.len() - end.len())
}

/// The ranges of displayed equations, or errors at places at which something is not closed.
pub(super) fn displays(text: &str) -> Vec<Result<Range<usize>, Box<Diagnostic>>> {
    let mut found = vec![];
    let mut place = 0;
    while let Some(rest) = text.get(place..).filter(|rest| !rest.is_empty()) {
        let Some((inside, close)) = display(rest) else {
            // A line break may be followed by its height in brackets.
            let skipped = if rest.starts_with(r"\\") { 2 } else { 1 };
            place += rest.chars().take(skipped).map(char::len_utf8).sum::<usize>();
            continue;
        };
        let inside = place + inside;
        let Some(length) = text.get(inside..).and_then(|rest| rest.find(&close)) else {
            let error = Diagnostic::error(code::EXPRESSION, "a display that is not closed");
            let error = error.at(&(place..inside), "").help(format!("add `{close}`"));
            found.push(Err(error.into()));
            return found;
        };
        found.push(Ok(inside..inside + length));
        place = inside + length + close.len();
    }
    found
}

/// The offset of the content of a display at the start of the text, and the mark that closes the display.
fn display(text: &str) -> Option<(usize, String)> {
    if text.starts_with(r"\[") {
        return Some((2, r"\]".to_owned()));
    }
    if text.starts_with("$$") {
        return Some((2, "$$".to_owned()));
    }
    let (name, inside) = begins(text, &DISPLAYS)?;
    Some((inside, format!(r"\end{{{name}}}")))
}

/// The first of the given environments: its name, its position, and the position of its content.
fn environment<'t>(text: &'t str, names: &[&str]) -> Option<(&'t str, usize, usize)> {
    let mut opens = text.match_indices(r"\begin{");
    opens.find_map(|(open, _)| {
        let (name, inside) = begins(text.get(open..)?, names)?;
        Some((name, open, open + inside))
    })
}

/// The name of the environment at the start of the text, and the offset of its content.
fn begins<'t>(text: &'t str, names: &[&str]) -> Option<(&'t str, usize)> {
    let rest = text.strip_prefix(r"\begin{")?;
    let name = rest.get(..rest.bytes().take(16).position(|byte| byte == b'}')?)?;
    names.contains(&name.trim_end_matches('*')).then_some(())?;
    let inside = text.len() - rest.len() + name.len() + 1;
    let mut inside = inside;
    if WITH_ARGUMENTS.contains(&name.trim_end_matches('*')) {
        inside += arguments(text.get(inside..).unwrap_or_default());
    }
    Some((name, inside))
}

/// The number of bytes of the arguments of an environment: groups in brackets or braces.
pub(super) fn arguments(text: &str) -> usize {
    let mut length = 0;
    loop {
        let rest = text.get(length..).unwrap_or_default();
        let close = match rest.chars().next() {
            Some('[') => ']',
            Some('{') => '}',
            _ => return length,
        };
        let Some(end) = rest.find(close) else { return length };
        length += end + 1;
    }
}

/// One entry for each row that contains `=` and the following rows without it.
fn rows(
    text: &str,
    displays: Vec<Result<Range<usize>, Box<Diagnostic>>>,
) -> Vec<Result<Entry, Box<Diagnostic>>> {
    let mut entries = vec![];
    for display in displays {
        let display = match display {
            Ok(display) => display,
            Err(error) => {
                entries.push(Err(error));
                continue;
            }
        };
        let own = flattened(text.get(display.clone()).unwrap_or_default());
        let mut ranges: Vec<Range<usize>> = vec![];
        for row in row_ranges(&own) {
            let line = own.get(row.clone()).unwrap_or_default();
            match ranges.last_mut() {
                _ if line.trim().is_empty() => {}
                Some(last) if !line.contains('=') => last.end = row.end,
                _ => ranges.push(row),
            }
        }
        entries.extend(ranges.into_iter().map(|range| {
            let mut entry = entry(&own, range);
            entry.start += display.start;
            Ok(entry)
        }));
    }
    entries
}

/// The display without environments and heights of line breaks that only arrange it.
fn flattened(display: &str) -> String {
    let (mut ranges, mut place, mut is_braced) = (vec![], 0, false);
    while let Some(found) = display.get(place..).and_then(|rest| rest.find('\\')) {
        let start = place + found;
        let rest = display.get(start..).unwrap_or_default();
        if rest.starts_with(r"\\") {
            place = start + 2;
            let end = place + height(rest.get(2..).unwrap_or_default());
            ranges.push(place..end);
            place = end;
            continue;
        }
        place = start + 1;
        // A brace around several equations.
        let brace = rest.strip_prefix(r"\left\{").map(str::trim_start);
        let opens = brace.is_some_and(|after| begins(after, &ARRANGED).is_some());
        if opens || is_braced && rest.starts_with(r"\right.") {
            is_braced = opens;
            place = start + r"\right.".len();
            ranges.push(start..place);
            continue;
        }
        let inside = rest.strip_prefix(r"\begin{").or(rest.strip_prefix(r"\end{"));
        let is_named = |inside: &str, name: &str| {
            inside.strip_prefix(name).is_some_and(|rest| rest.starts_with(['}', '*']))
        };
        // After an `=`, the rows of `cases` are alternatives, which are not read.
        let is_value = display.get(..start).is_some_and(|before| before.contains('='));
        let known = inside.is_some_and(|inside| {
            let is_system = is_named(inside, CASES) && (!is_value || rest.starts_with(r"\end"));
            is_system || ARRANGED.iter().any(|name| is_named(inside, name))
        });
        if let Some(length) = rest.find('}').filter(|_| known) {
            place = start + length + 1;
            // The place of the environment relative to the line.
            let option = display.get(place..).unwrap_or_default();
            let is_option = ["[t]", "[b]", "[c]"].iter().any(|place| option.starts_with(place));
            place += if is_option { 3 } else { 0 };
            ranges.push(start..place);
        }
    }
    blanked(display, &ranges)
}

/// The ranges between line breaks that are outside groups and environments. The height of a line break belongs to it.
fn row_ranges(text: &str) -> Vec<Range<usize>> {
    let mut ranges = vec![];
    let (mut start, mut place, mut depth) = (0, 0, 0_usize);
    while let Some(rest) = text.get(place..).filter(|rest| !rest.is_empty()) {
        let mut length = rest.chars().next().map_or(1, char::len_utf8);
        if rest.starts_with(r"\begin{") || rest.starts_with('{') {
            depth += 1;
            length = rest.find('{').map_or(1, |brace| brace + 1);
            // The braces of the environment's name are skipped.
            if rest.starts_with('\\') {
                length = rest.find('}').map_or(rest.len(), |brace| brace + 1);
            }
        } else if rest.starts_with(r"\end{") {
            depth = depth.saturating_sub(1);
            length = rest.find('}').map_or(rest.len(), |brace| brace + 1);
        } else if rest.starts_with('}') {
            depth = depth.saturating_sub(1);
        } else if rest.starts_with(r"\\") {
            length = 2 + height(rest.get(2..).unwrap_or_default());
            if depth == 0 {
                ranges.push(start..place);
                start = place + length;
            }
        } else if rest.starts_with('\\') {
            length = 1 + rest.chars().nth(1).map_or(0, char::len_utf8);
            if rest.starts_with(r"\begin") || rest.starts_with(r"\end") {
                length = 1;
            }
        }
        place += length;
    }
    ranges.push(start..text.len());
    ranges
}

/// The length of `*` and `[2pt]` after a line break.
fn height(rest: &str) -> usize {
    let star = usize::from(rest.starts_with('*'));
    let bracket = rest.get(star..).filter(|rest| rest.starts_with('['));
    star + bracket.and_then(|rest| rest.find(']')).map_or(0, |end| end + 1)
}
