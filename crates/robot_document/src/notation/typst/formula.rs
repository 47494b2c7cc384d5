//! Formulas in Typst, written as people write them.

use robot_model::signs::FunctionName;

use super::text::quoted;
use crate::math::{Fence, Line, Math, Script};

/// The Typst source of a formula, for math mode.
#[must_use]
pub fn formula(math: &Math) -> String {
    shown(math, Place::Free)
}

/// The place of a formula: in an argument of a call, a comma would start the next argument.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Free,
    Argument,
}

fn shown(math: &Math, place: Place) -> String {
    match math {
        Math::Number(digits) => digits.clone(),
        Math::Letter(letter) => letter.to_string(),
        Math::Word(word) => quoted(word),
        Math::Sign(sign) => self::sign(*sign, place),
        Math::Function(FunctionName::Sign) => format!("op({})", quoted(FunctionName::Sign.text())),
        Math::Function(name) => name.text().to_owned(),
        Math::Symbol(symbol) => shown(&symbol.shape, place),
        Math::Row(pieces) => row(pieces, place),
        Math::Script(script) => with_indices(script, place),
        Math::Accent(accent, inside) => call(accent.typst(), inside),
        Math::Styled(font, inside) => {
            let [before, after] = font.typst();
            format!("{before}{}{after}", shown(inside, Place::Argument))
        }
        Math::Fraction(parts) => {
            let [above, below] = parts.each_ref().map(|part| grouped(&shown(part, place)));
            format!("{above}/{below}")
        }
        Math::Root(inside) => call("sqrt", inside),
        Math::Fenced(Fence::Parentheses, inside) => format!("({})", shown(inside, place)),
        Math::Fenced(Fence::Bars, inside) => call("abs", inside),
        Math::Fenced(Fence::Brackets, inside) => format!("[{}]", shown(inside, place)),
        Math::Matrix(rows) => {
            let cell = |entry: &Math| shown(entry, Place::Argument);
            let row = |row: &Vec<Math>| row.iter().map(cell).collect::<Vec<_>>().join(", ");
            // A column with entries of several lines is aligned at the left, and its entries are further apart than
            // their lines.
            let is_apart = rows.iter().flatten().any(|entry| matches!(entry, Math::Lines(_)));
            let layout =
                if is_apart { "align: #left, row-gap: #0.8em" } else { "row-gap: #0.35em" };
            let rows: Vec<String> = rows.iter().map(row).collect();
            format!("mat(delim: \"[\", {layout}, {})", rows.join("; "))
        }
        Math::Lines(lines) => {
            let line = |(index, line): (usize, &Line)| match index {
                0 => format!("inline({})", shown(&line.math, Place::Argument)),
                _ => format!("inline({})", continued(line, Place::Argument)),
            };
            let lines: Vec<String> = lines.iter().enumerate().map(line).collect();
            format!("mat(delim: #none, align: #left, row-gap: #0.35em, {})", lines.join("; "))
        }
    }
}

/// A further line of an equation: the sign at its beginning has the same spaces as within a sum.
pub(super) fn continued(line: &Line, place: Place) -> String {
    let indent = "quad ".repeat(line.indent);
    match line.math.pieces() {
        [first @ Math::Sign('+' | '-'), rest @ ..] => {
            format!("{indent}{} med {}", shown(first, place), row(rest, place))
        }
        _ => format!("{indent}{}", shown(&line.math, place)),
    }
}

/// Escapes all signs except those of sums and lists. A parenthesis here is not part of a pair, so it is escaped too.
fn sign(sign: char, place: Place) -> String {
    match sign {
        '·' => "dot.op".to_owned(),
        '×' => "times".to_owned(),
        '*' => "∗".to_owned(),
        '+' | '-' | '=' => sign.to_string(),
        ',' if place == Place::Free => sign.to_string(),
        other => format!("\\{other}"),
    }
}

fn call(function: &str, inside: &Math) -> String {
    format!("{function}({})", shown(inside, Place::Argument))
}

/// Whether Typst takes this source as one operand of `/`, `_` or `^`: a number or a letter.
fn is_single(typst: &str) -> bool {
    let mut letters = typst.chars();
    match (letters.next(), letters.as_str()) {
        (Some(first), "") => first.is_alphanumeric(),
        (Some(_), _) => typst.bytes().all(|byte| byte.is_ascii_digit()),
        (None, _) => false,
    }
}

/// Makes one operand of the source; the added parentheses are not printed.
fn grouped(typst: &str) -> String {
    if is_single(typst) { typst.to_owned() } else { format!("({typst})") }
}

/// Pieces separated by spaces: letters without a space would be a word, and a letter before a parenthesis a call. There
/// is no space beside quotation marks, because it would be printed.
fn row(pieces: &[Math], place: Place) -> String {
    let mut typst = String::new();
    for (index, piece) in pieces.iter().enumerate() {
        let before = index.checked_sub(1).and_then(|index| pieces.get(index));
        if before.is_some_and(|before| piece.is_apart_from(before)) {
            typst.push_str(" thin");
        }
        let is_close = match (before, piece) {
            (None, _) | (_, Math::Sign(',')) => true,
            (Some(Math::Function(_)), Math::Fenced(..)) => true,
            (Some(Math::Sign('-')), _) => index == 1,
            _ => false,
        };
        let piece = shown(piece, place);
        if !is_close && !typst.ends_with('"') && !piece.starts_with('"') {
            typst.push(' ');
        }
        typst.push_str(&piece);
    }
    if typst.is_empty() { "\"\"".to_owned() } else { typst }
}

/// The base with its indices. The exponent of a symbol with a lower index stands above that index.
fn with_indices(script: &Script, place: Place) -> String {
    if let (None, Some(upper), Some(own)) = (&script.lower, &script.upper, own_index(&script.base))
        && own.upper.is_none()
    {
        let (base, lower) = (own.base.clone(), own.lower.clone());
        return with_indices(&Script { base, lower, upper: Some(upper.clone()) }, place);
    }
    let places = [("b", "_", &script.lower), ("t", "^", &script.upper)];
    let indices = places
        .into_iter()
        .filter_map(|(name, sign, index)| index.as_ref().map(|index| (name, sign, index)));
    if is_simple(&script.base) {
        let indices: String = indices
            .map(|(_, sign, index)| format!("{sign}{}", grouped(&shown(index, place))))
            .collect();
        return format!("{}{indices}", shown(&script.base, place));
    }
    let indices: String = indices
        .map(|(name, _, index)| format!(", {name}: {}", shown(index, Place::Argument)))
        .collect();
    format!("attach({}{indices})", shown(&script.base, Place::Argument))
}

/// The indices of a base that has some itself.
fn own_index(base: &Math) -> Option<&Script> {
    match base {
        Math::Script(script) => Some(script),
        Math::Symbol(symbol) => own_index(&symbol.shape),
        _ => None,
    }
}

fn is_simple(base: &Math) -> bool {
    match base {
        Math::Symbol(symbol) => is_simple(&symbol.shape),
        Math::Script(_) | Math::Row(_) | Math::Sign(_) | Math::Fraction(_) => false,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use robot_model::signs::Accent;

    use super::*;
    use crate::latex::read;

    #[test]
    fn indices_accents_and_calls() {
        let rate = Math::Accent(Accent::DoubleDot, Box::new(Math::Letter('q')));
        let power = rate.with_lower(Math::integer(2)).with_upper(Math::integer(3));
        assert_eq!(formula(&power), "dot.double(q)_2^3");
        let fenced = Math::Fenced(Fence::Parentheses, Box::new(Math::Letter('x')));
        let row = Math::Row(vec![Math::Letter('q'), fenced, Math::Sign('·'), Math::Letter('ω')]);
        assert_eq!(formula(&row), "q (x) dot.op ω");
    }

    #[test]
    fn formulas_read_as_people_write_them() {
        for (latex, typst) in [
            (r"\sin q_2 \dot{q}_2^{2}", "sin q_2 dot(q)_2^2"),
            (r"-\cos^{2} q_{12} + J_x^{*5}", "-cos^2 q_12 + J_x^(∗ 5)"),
            (r"\sin\left(q_2 + q_3\right) - F_{l_x}^{6}", "sin(q_2 + q_3) - F_(l_x)^6"),
            (r"\left(0, -g, l_1\right)", "(0, - g, l_1)"),
            (r"\omega_{2,x} \frac{1}{2} \frac{a + b}{c_1}", "ω_(2, x) 1/2 (a + b)/(c_1)"),
            (r"\dot{x_{1,2}} \sqrt{2}", r"dot(x_(1\, 2)) sqrt(2)"),
        ] {
            assert_eq!(formula(&read(latex).unwrap()), typst, "{latex}");
        }
    }

    #[test]
    fn signs_and_words_are_never_markup() {
        let signs: Vec<Math> = ",(:;./".chars().map(Math::Sign).collect();
        assert_eq!(formula(&Math::Row(signs.clone())), r", \( \: \; \. \/");
        let marked = Math::Accent(Accent::Bar, Box::new(Math::Row(signs)));
        assert_eq!(formula(&marked), r"macron(\, \( \: \; \. \/)");
        let word = Math::Word("\"#x\\".to_owned());
        let row = Math::Row(vec![Math::Letter('a'), word, Math::Letter('b')]);
        assert_eq!(formula(&row), r##"a"\"#x\\"b"##);
    }
}
