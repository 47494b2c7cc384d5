//! Reads printed equations, `(number) quantity = terms`, in infix text or in LaTeX.

use std::ops::Range;

use super::latex::to_infix;
use robot_model::description::is_finite;
use robot_model::diagnostic::{Diagnostic, Source, Span, code, quote};
use robot_symbolic::{Formula, ParseError};

use super::entries::{Entry, Part, entries, has_column_mark, of_matrices, unnamed};
use super::symbols::Symbols;
use super::unprinted::without_comments;

/// The notation of equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// Infix text such as `M5*l5*qdd1*cos(q2)`, with one equation on each line.
    Text,
    /// LaTeX: displayed equations, or one equation on each line.
    Latex,
}

impl Notation {
    /// Guesses the notation of a text: infix text contains backslashes, dollar signs and braces after `_` and `^` only in
    /// comments.
    #[must_use]
    pub fn detect(text: &str) -> Notation {
        let text = without_comments(text, Notation::Text);
        let is_latex = ["\\", "$", "_{", "^{"].iter().any(|sign| text.contains(sign));
        if is_latex { Notation::Latex } else { Notation::Text }
    }
}

/// A printed equation: one scalar quantity and its printed terms.
#[derive(Clone, Debug)]
pub(super) struct PrintedEquation {
    /// The printed number of the equation, without parentheses; empty if it has none.
    pub(super) number: String,
    /// The quantity on the left side, such as `M_l4.z` or `Q1`.
    pub(super) quantity: String,
    /// The bytes of the left side.
    pub(super) span: Span,
    /// Whether it was read as LaTeX.
    pub(super) is_latex: bool,
    /// The terms of the right side in printed order, before parentheses are expanded.
    pub(super) terms: Vec<Formula>,
}

/// Reads the equations of a text.
///
/// In infix text, comment lines start with `#`, and a line that starts with a space continues the preceding one. In
/// LaTeX, comments start with `%`; if there are displayed equations, all other text is ignored.
///
/// # Errors
///
/// Everything that cannot be read, with its place, or that the text has no equations.
pub(super) fn read_printed(
    source: &Source,
    notation: Notation,
    symbols: &Symbols,
) -> Result<Vec<PrintedEquation>, Vec<Diagnostic>> {
    let mut equations = vec![];
    let mut errors = vec![];
    for entry in entries(&source.text, notation) {
        let read = entry.and_then(|entry| match notation {
            Notation::Text => read_text(&entry, symbols),
            Notation::Latex => read_latex(&entry, symbols),
        });
        match read {
            Ok(read) => equations.extend(read),
            Err(error) => errors.push(*error),
        }
    }
    if equations.is_empty() && errors.is_empty() {
        let error = Diagnostic::error(code::EXPRESSION, "no equations found");
        errors.push(error.help("write `Q1 = …`, or LaTeX in `equation` or `align`"));
    }
    if errors.is_empty() { Ok(equations) } else { Err(errors) }
}

fn read_text(entry: &Entry, symbols: &Symbols) -> Result<Vec<PrintedEquation>, Box<Diagnostic>> {
    let (left, right) = entry.sides(Notation::Text)?;
    let (number, quantity) = numbered(left.text);
    if quantity.is_empty() || quantity.contains(char::is_whitespace) {
        return Err(unnamed(&left.span).into());
    }
    let terms = terms(right.text, |span| shifted(&span, right.span.start))?;
    let number = number.or(entry.number.clone()).unwrap_or_default();
    complete(vec![PrintedEquation {
        number,
        quantity: symbols.quantity_in_text(quantity),
        span: left.span,
        is_latex: false,
        terms,
    }])
}

fn read_latex(entry: &Entry, symbols: &Symbols) -> Result<Vec<PrintedEquation>, Box<Diagnostic>> {
    let (left, right) = entry.sides(Notation::Latex)?;
    let (number, latex) = numbered(left.text);
    let number = number.or(entry.number.clone()).unwrap_or_default();
    let column = right.rows()?;
    let is_matrix = |rows: &Vec<Part<'_>>| rows.iter().any(|row| has_column_mark(row.text));
    if column
        .as_ref()
        .is_some_and(|rows| is_matrix(rows) || rows.len() != 3 && !symbols.is_vector(latex))
    {
        return Err(of_matrices(&left.span).into());
    }
    let quantity = symbols.quantity(latex, column.is_some());
    let (rows, axes) = match column {
        None => (vec![right], &[""][..]),
        Some(rows) => (rows, &[".x", ".y", ".z"][..]),
    };
    if rows.len() != axes.len() {
        let message = format!("expected 3 rows in this vector, found {}", rows.len());
        let error = Diagnostic::error(code::WRONG_COUNT, message).at(&left.span, "");
        return Err(error.help("write three components, with a line break between them").into());
    }
    let mut equations = vec![];
    for (row, axis) in rows.iter().zip(axes) {
        let start = row.span.start;
        let text = without_end(row.text);
        if let Some(place) = trailing_number(text) {
            return Err(numbered_behind(&shifted(&place, start)).into());
        }
        let infix = to_infix(text, &|key| symbols.name(key))
            .map_err(|error| fault(&error, shifted(&error.span, start)))?;
        let terms = terms(infix.text(), |span| shifted(&infix.source(&span), start))?;
        equations.push(PrintedEquation {
            number: number.clone(),
            quantity: format!("{quantity}{axis}"),
            span: left.span.clone(),
            is_latex: true,
            terms,
        });
    }
    complete(equations)
}

/// A right side without the punctuation and spaces after it, such as `\,.`
fn without_end(latex: &str) -> &str {
    let end = |c: char| matches!(c, '.' | ',' | ';' | ':' | '!') || c.is_whitespace();
    let mut rest = latex;
    loop {
        let cut = rest.trim_end_matches(end);
        let marks = [r"\nonumber", r"\notag", r"\IEEEnonumber", r"\IEEEyesnumber", "&"];
        if let Some(before) = marks.iter().find_map(|mark| cut.strip_suffix(mark)) {
            rest = before;
            continue;
        }
        let is_cut = cut.len() < rest.len();
        // A backslash before the last of these belongs to a space such as `\,`.
        match cut.strip_suffix('\\').filter(|before| is_cut && !before.ends_with('\\')) {
            Some(before) => rest = before,
            None => return cut,
        }
    }
}

/// The place of a number in parentheses at the end, apart from the term before it, which is that of the equation.
fn trailing_number(latex: &str) -> Option<Span> {
    let (before, number) = latex.strip_suffix([')', ']'])?.rsplit_once(['(', '['])?;
    let digits = number.trim_end_matches(|c: char| c.is_ascii_lowercase());
    let in_number = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-');
    let is_number =
        digits.starts_with(|c: char| c.is_ascii_digit()) && digits.bytes().all(in_number);
    let term = before.trim_end_matches(|c: char| c.is_whitespace() || "~&".contains(c));
    let spaces = [r"\quad", r"\qquad", r"\hfill", r"\hfil", r"\,", r"\;", r"\ ", "&"];
    let is_apart = spaces.iter().any(|space| before.trim_end().ends_with(space));
    // The argument of a function may be a number.
    let is_argument = term.rsplit('\\').next().is_some_and(|word| {
        term.contains('\\') && word.bytes().all(|byte| byte.is_ascii_alphabetic())
    });
    let is_factor = term.len() == before.len() || term.ends_with(['+', '-', '*', '/', '(']);
    (is_number && (is_apart || !(is_argument || is_factor))).then_some(before.len()..latex.len())
}

/// The error for a number at the end, which may be that of the equation or a factor.
fn numbered_behind(span: &Span) -> Diagnostic {
    let message = "this is the number of the equation or a factor of its last term";
    let help = "write a number as `\\tag{2}` or before the equation, and a factor before its term";
    Diagnostic::error(code::EXPRESSION, message).at(span, "").help(help)
}

fn shifted(span: &Span, by: usize) -> Span {
    span.start + by..span.end + by
}

/// The number of an equation in parentheses, and the rest of the left side.
pub(super) fn numbered(left: &str) -> (Option<String>, &str) {
    let left = left.trim();
    match left.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
        Some((number, rest)) => (Some(quote(number.trim())), rest.trim()),
        None => (None, left),
    }
}

/// The terms of a right side; `place` converts a range of bytes of the right side to that in the file.
fn terms(right: &str, place: impl Fn(Span) -> Span) -> Result<Vec<Formula>, Box<Diagnostic>> {
    let mut terms = vec![];
    for range in split_terms(right) {
        let text = right.get(range.clone()).unwrap_or_default();
        let unsigned = text.trim_start();
        let unsigned = unsigned.strip_prefix('+').unwrap_or(unsigned);
        let start = range.start + text.len() - unsigned.len();
        let formula = Formula::parse_with_dots(unsigned.trim_end())
            .map_err(|error| fault(&error, place(shifted(&error.span, start))))?;
        if !is_finite(&formula) {
            let span = place(start..start + unsigned.trim_end().len());
            let error = Diagnostic::error(code::NUMBER, "the term does not have a finite value");
            let help = "look for a division by zero, the square root of a negative number, or an \
                overflow";
            return Err(error.at(&span, "this is not a number").help(help).into());
        }
        terms.push(formula);
    }
    Ok(terms)
}

fn fault(error: &ParseError, span: Span) -> Diagnostic {
    let found = Diagnostic::error(code::EXPRESSION, error.message.as_str()).at(&span, "");
    match &error.help {
        Some(help) => found.help(help.as_str()),
        None => found,
    }
}

fn complete(equations: Vec<PrintedEquation>) -> Result<Vec<PrintedEquation>, Box<Diagnostic>> {
    match equations.iter().find(|equation| equation.terms.is_empty()) {
        None => Ok(equations),
        Some(empty) => {
            let quantity = quote(&empty.quantity);
            let message = format!("`{quantity}` has no right-hand side");
            let error = Diagnostic::error(code::EXPRESSION, message).at(&empty.span, "");
            Err(error.help("write the right-hand side after `=`; write `0` if it vanishes").into())
        }
    }
}

/// The ranges of the terms of a sum, which is split before each plus or minus sign that is outside parentheses and
/// follows an operand.
fn split_terms(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let mut ranges = vec![];
    let (mut depth, mut start, mut place, mut after_operand) = (0_usize, 0, 0, false);
    while let Some(byte) = bytes.get(place) {
        let operand = operand_length(bytes, place);
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            b'+' | b'-' if depth == 0 && after_operand => {
                ranges.push(start..place);
                start = place;
            }
            _ => {}
        }
        if !byte.is_ascii_whitespace() {
            after_operand = operand > 0 || *byte == b')';
        }
        place += operand.max(1);
    }
    if !text.get(start..).unwrap_or_default().trim().is_empty() {
        ranges.push(start..text.len());
    }
    ranges
}

/// The length of the name or number that begins at a byte, including the exponent of a number.
pub(super) fn operand_length(bytes: &[u8], start: usize) -> usize {
    let run = |from: usize, member: fn(&u8) -> bool| {
        bytes.get(from..).unwrap_or_default().iter().take_while(|byte| member(byte)).count()
    };
    let word =
        |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.') || !byte.is_ascii();
    match bytes.get(start) {
        Some(b'0'..=b'9' | b'.') => {
            let digits = run(start, |byte| byte.is_ascii_digit() || *byte == b'.');
            let exponent = start + digits;
            let signed = matches!(bytes.get(exponent), Some(b'e' | b'E'));
            let sign = usize::from(matches!(bytes.get(exponent + 1), Some(b'+' | b'-')));
            match run(exponent + 1 + sign, u8::is_ascii_digit) {
                length @ 1.. if signed => digits + 1 + sign + length,
                _ => digits,
            }
        }
        Some(_) => run(start, word),
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<PrintedEquation>, Vec<Diagnostic>> {
        let source = Source { name: "printed".to_owned(), text: text.to_owned() };
        read_printed(&source, Notation::detect(text), &Symbols::default())
    }

    fn texts(equation: &PrintedEquation) -> Vec<&str> {
        equation.terms.iter().map(Formula::text).collect()
    }

    #[test]
    fn entries_continue_and_split_into_terms() {
        let text = "# head\n(45) M_l2.x = sin(q5)*l6 - q3*(l2 - l3)\n# é \\ more\n  + 2*q4\nQ1 = -1.5e-3*a\n";
        let equations = read(text).unwrap();
        assert_eq!(equations.len(), 2);
        assert_eq!(texts(&equations[0]), ["sin(q5)*l6", "- q3*(l2 - l3)", " 2*q4"]);
        assert_eq!(equations[0].number, "45");
        assert_eq!(&text[equations[0].span.clone()], "(45) M_l2.x");
        assert_eq!((equations[1].number.as_str(), texts(&equations[1])), ("", vec!["-1.5e-3*a"]));
    }

    #[test]
    fn every_bad_line_is_reported_at_its_place() {
        let text = "Q1\nQ2 = a + 2q3\nQ3 =\nQ 4 = q1\n= c\n(5) Q5 = a\n  + b c\n";
        let errors = read(text).unwrap_err();
        let places: Vec<&str> = errors
            .iter()
            .map(|error| &text[error.primary.as_ref().unwrap().span.clone()])
            .collect();
        assert_eq!(places, ["Q1", "2q3", "Q3", "Q 4", "=", "b c"]);
        assert_eq!(read("# nothing\n").unwrap_err().len(), 1);
    }

    #[test]
    fn displayed_equations_are_read_and_prose_is_not() {
        let text = r"Prose with $x = 1$.
\begin{align*} % Q_9 = 1
  Q_{1} &= a + \\
  & \quad + b \tag{7a} \\[2pt]
  (8) Q_2 &= c - d.
\end{align*}
\[ Q_3 = e_1 \]
\begin{equation}\label{v}
  F_l^5 = \begin{bmatrix} a \\ b \\ c - 1 \end{bmatrix},
\end{equation}";
        let equations = read(text).unwrap();
        let shown: Vec<(&str, Vec<&str>)> =
            equations.iter().map(|equation| (equation.number.as_str(), texts(equation))).collect();
        assert_eq!(shown[0], ("7a", vec!["a", "b"]));
        assert_eq!(shown[1], ("8", vec!["c", "-d"]));
        assert_eq!(shown[2], ("", vec!["e1"]));
        assert_eq!(shown[5].1, ["c", "-1"]);
        assert!(equations[5].quantity.ends_with(".z"));
    }

    #[test]
    fn equations_go_on_in_the_next_display() {
        let text = r"\begin{align*}
  Q_{1} &= a
\end{align*}
\begin{align*}
  \phantom{Q_{1}} &\quad {}+ b \\
  Q_2 &= c
\end{align*}
\begin{align*} \phantom{Q_2} - d \end{align*}";
        let shown: Vec<Vec<String>> = read(text)
            .unwrap()
            .iter()
            .map(|equation| texts(equation).into_iter().map(str::to_owned).collect())
            .collect();
        assert_eq!(shown, [["a", "b"], ["c", "-d"]]);
        // A setting of lengths or prose may be between the displays, and a phantom within one prints nothing.
        for between in [
            "\\end{align*}}%\n{\\abovedisplayskip=\\jot\n\\begin{align*}",
            "\\end{align*} where $\\mu = 1$, é,\n\\begin{align*} &",
            "\\\\",
        ] {
            let text = text.replace("\\end{align*}\n\\begin{align*}", between);
            let found = read(&text).unwrap();
            let shown: Vec<_> = found.iter().map(texts).collect();
            assert_eq!(shown, [["a", "b"], ["c", "-d"]], "{text}");
        }
        let text_of_equals = text.replace("&\\quad {}+ b", "\\phantom{=} + b");
        assert_eq!(read(&text_of_equals).unwrap().len(), 2);
        // Another display between the two is not passed over.
        assert!(
            read(&text.replace("\\begin{align*}\n  \\ph", "$$Q_3 = a$$ \\begin{align*}\n  \\ph"))
                .is_err()
        );
        // An environment with another name does not continue the equation.
        assert_eq!(
            read(&text.replace("{align*} \\phantom", "{gather} \\phantom")).unwrap_err().len(),
            1
        );
    }

    #[test]
    fn errors_in_latex_have_their_place() {
        let text = "\\begin{align}\n Q_1 &= a + \\foo \\\\\n Q_2 &= b \\cdot \\cdot c \\\\ d = \\end{align}\n\\[ Q_3 ";
        let errors = read(text).unwrap_err();
        let place =
            |error: &Diagnostic| text[error.primary.as_ref().unwrap().span.clone()].to_owned();
        assert_eq!(
            errors.iter().map(place).collect::<Vec<_>>(),
            ["\\foo", "\\cdot \\cdot", "d", "\\["]
        );
    }
}
