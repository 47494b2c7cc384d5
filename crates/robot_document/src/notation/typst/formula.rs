//! Formulas as Typst.

use super::text::quoted;
use crate::math::{Fence, Math, Script};

/// The Typst of a formula, for math mode.
#[must_use]
pub fn formula(math: &Math) -> String {
    match math {
        Math::Number(digits) => digits.clone(),
        Math::Letter(letter) => letter.to_string(),
        Math::Word(word) => quoted(word),
        Math::Sign(sign) => self::sign(*sign),
        Math::Function(name) => format!("op({})", quoted(name.text())),
        Math::Symbol(symbol) => formula(&symbol.shape),
        Math::Row(pieces) => row(pieces),
        Math::Script(script) => with_indices(script),
        Math::Accent(accent, inside) => call(accent.typst(), inside),
        Math::Styled(font, inside) => {
            let [before, after] = font.typst();
            format!("{before}{}{after}", formula(inside))
        }
        Math::Fraction(parts) => {
            let [above, below] = parts.each_ref().map(formula);
            format!("frac({above}, {below})")
        }
        Math::Root(inside) => call("sqrt", inside),
        Math::Fenced(Fence::Parentheses, inside) => format!("({})", formula(inside)),
        Math::Fenced(Fence::Bars, inside) => call("abs", inside),
        Math::Matrix(rows) => {
            let row = |row: &Vec<Math>| row.iter().map(formula).collect::<Vec<_>>().join(", ");
            let rows: Vec<String> = rows.iter().map(row).collect();
            format!("mat(delim: \"[\", {})", rows.join("; "))
        }
    }
}

/// All signs but those of sums are escaped: a comma or a parenthesis would be one of a call.
fn sign(sign: char) -> String {
    match sign {
        '·' => "dot.op".to_owned(),
        '*' => "∗".to_owned(),
        '+' | '-' | '=' => sign.to_string(),
        other => format!("\\{other}"),
    }
}

fn call(function: &str, inside: &Math) -> String {
    format!("{function}({})", formula(inside))
}

/// Pieces with a space between: letters without one would be a word, and a letter before a
/// parenthesis a call. Beside quotation marks a space would print.
fn row(pieces: &[Math]) -> String {
    let mut typst = String::new();
    for (place, piece) in pieces.iter().enumerate() {
        let before = place.checked_sub(1).and_then(|place| pieces.get(place));
        if before.is_some_and(|before| piece.is_apart_from(before)) {
            typst.push_str(" thin");
        }
        let piece = formula(piece);
        if !typst.is_empty() && !typst.ends_with('"') && !piece.starts_with('"') {
            typst.push(' ');
        }
        typst.push_str(&piece);
    }
    if typst.is_empty() { "\"\"".to_owned() } else { typst }
}

/// A power of a symbol with an index is above the index: `attach` sees to that.
fn with_indices(script: &Script) -> String {
    let base = formula(&script.base);
    let places = [("b", "_", &script.lower), ("t", "^", &script.upper)];
    let indices = places
        .into_iter()
        .filter_map(|(name, sign, index)| index.as_ref().map(|index| (name, sign, formula(index))));
    if is_simple(&script.base) {
        let indices: String = indices.map(|(_, sign, index)| format!("{sign}({index})")).collect();
        return format!("{base}{indices}");
    }
    let indices: String = indices.map(|(name, _, index)| format!(", {name}: {index}")).collect();
    format!("attach({base}{indices})")
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

    #[test]
    fn indices_accents_and_calls() {
        let rate = Math::Accent(Accent::DoubleDot, Box::new(Math::Letter('q')));
        let power = rate.with_lower(Math::integer(2)).with_upper(Math::integer(3));
        assert_eq!(formula(&power), "attach(dot.double(q)_(2), t: 3)");
        let fenced = Math::Fenced(Fence::Parentheses, Box::new(Math::Letter('x')));
        let row = Math::Row(vec![Math::Letter('q'), fenced, Math::Sign('·'), Math::Letter('ω')]);
        assert_eq!(formula(&row), "q (x) dot.op ω");
    }

    #[test]
    fn signs_and_words_are_never_markup() {
        let signs = ",(:;./".chars().map(Math::Sign).collect();
        assert_eq!(formula(&Math::Row(signs)), r"\, \( \: \; \. \/");
        let word = Math::Word("\"#x\\".to_owned());
        let row = Math::Row(vec![Math::Letter('a'), word, Math::Letter('b')]);
        assert_eq!(formula(&row), r##"a"\"#x\\"b"##);
    }
}
