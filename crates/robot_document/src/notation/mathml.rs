//! Formulas as MathML, the markup of formulas in HTML.
//!
//! Only MathML Core is used, which browsers support: fonts are given by special characters, and there are no style
//! attributes.

use robot_model::signs::{Accent, Font};

use crate::markup::{Element, element, holding};
use crate::math::{Fence, Line, Math, Script};

/// The MathML of a formula, without the enclosing `math` element.
#[must_use]
pub fn formula(math: &Math) -> Element {
    match math {
        Math::Number(digits) => holding("mn", digits.as_str()),
        Math::Letter(letter) => holding("mi", letter.to_string()),
        Math::Word(word) => upright(word),
        Math::Sign(sign) => operator(*sign),
        Math::Function(name) => holding("mi", name.text()),
        Math::Symbol(symbol) => formula(&symbol.shape),
        Math::Row(pieces) => row(pieces),
        Math::Script(script) => with_indices(script),
        Math::Accent(Accent::Underline, inside) => {
            let line = holding("mo", Accent::Underline.sign());
            element("munder").with_all([formula(inside), line]).attribute("accentunder", "true")
        }
        Math::Accent(accent, inside) => marked(*accent, inside).unwrap_or_else(|| {
            let stretches = if accent.stretches() { "true" } else { "false" };
            let sign = holding("mo", accent.sign()).attribute("stretchy", stretches);
            let whole = element("mover").with_all([formula(inside), sign]);
            // As accents, dots touch the letter below them in Chromium.
            match accent {
                Accent::Dot | Accent::DoubleDot => whole,
                _ => whole.attribute("accent", "true"),
            }
        }),
        Math::Styled(font, inside) => styled(*font, inside),
        Math::Fraction(parts) => element("mfrac").with_all(parts.iter().map(formula)),
        Math::Root(inside) => element("msqrt").with(formula(inside)),
        Math::Fenced(fence, inside) => {
            let [open, close] = match fence {
                Fence::Parentheses => ["(", ")"],
                Fence::Bars => ["|", "|"],
                Fence::Brackets => ["[", "]"],
            };
            let [open, close] = [(open, "prefix"), (close, "postfix")].map(|(sign, form)| {
                holding("mo", sign).attribute("fence", "true").attribute("form", form)
            });
            element("mrow").with_all([open, formula(inside), close])
        }
        Math::Matrix(rows) => matrix(rows),
        Math::Lines(lines) => {
            let one = |(place, line): (usize, &Line)| match (place, line.indent) {
                (0, _) => formula(&line.math),
                (_, 0) => continued(&line.math),
                (_, indent) => element("mrow").with_all([space(indent), continued(&line.math)]),
            };
            let row = |line| element("mtr").with(holding("mtd", line));
            let rows = lines.iter().enumerate().map(one).map(row);
            element("mtable").with_all(rows).attribute("columnalign", "left")
        }
    }
}

/// The space at the beginning of a line, in quads.
pub(super) fn space(quads: usize) -> Element {
    element("mspace").attribute("width", format!("{quads}em"))
}

/// The MathML of a line or term that continues a sum: the sign at its beginning is an operator between the preceding
/// term and this one.
#[must_use]
pub fn continued(math: &Math) -> Element {
    let mut markup = formula(math);
    let has_sign = matches!(math.pieces().first(), Some(Math::Sign(_)));
    if let Some(sign) = markup.first_mut().filter(|first| has_sign && first.name() == "mo") {
        sign.set("form", "infix");
    }
    markup
}

/// Upright text; a single letter needs an attribute, because it would be italic otherwise.
fn upright(word: &str) -> Element {
    let text = holding("mi", word);
    if word.chars().count() == 1 { text.attribute("mathvariant", "normal") } else { text }
}

fn operator(sign: char) -> Element {
    match sign {
        '-' => holding("mo", "−"),
        '(' | ')' => holding("mo", sign.to_string()).attribute("stretchy", "false"),
        _ => holding("mo", sign.to_string()),
    }
}

/// Pieces side by side, with a thin space around functions and words.
fn row(pieces: &[Math]) -> Element {
    let mut elements = vec![];
    for (place, piece) in pieces.iter().enumerate() {
        let before = place.checked_sub(1).and_then(|place| pieces.get(place));
        let is_apart = match before {
            None | Some(Math::Sign(_)) => false,
            Some(before) if piece.is_apart_from(before) => true,
            Some(before) if before.is_function() => !matches!(piece, Math::Fenced(..)),
            Some(_) => piece.is_function(),
        };
        if is_apart {
            elements.push(element("mspace").attribute("width", "0.167em"));
        }
        elements.push(formula(piece));
    }
    element("mrow").with_all(elements)
}

fn with_indices(script: &Script) -> Element {
    // The exponent of a symbol with a lower index stands above that index.
    if let (None, Some(upper), Some(own)) = (&script.lower, &script.upper, own_index(&script.base))
        && let (Some(lower), None) = (&own.lower, &own.upper)
    {
        return element("msubsup").with_all([formula(&own.base), formula(lower), formula(upper)]);
    }
    let base = formula(&script.base);
    match (&script.lower, &script.upper) {
        (Some(lower), Some(upper)) => {
            element("msubsup").with_all([base, formula(lower), formula(upper)])
        }
        (Some(lower), None) => element("msub").with_all([base, formula(lower)]),
        (None, Some(upper)) => element("msup").with_all([base, formula(upper)]),
        (None, None) => base,
    }
}

/// The indices of a base that has some itself.
fn own_index(base: &Math) -> Option<&Script> {
    match base {
        Math::Script(script) => Some(script),
        Math::Symbol(symbol) => own_index(&symbol.shape),
        _ => None,
    }
}

/// A letter with its accent as characters, because the font places the accent correctly. Over a letter in an element of
/// its own, browsers place accents without a gap, and too far left for a slanted letter.
fn marked(accent: Accent, inside: &Math) -> Option<Element> {
    let letter = match inside {
        Math::Symbol(symbol) => return marked(accent, &symbol.shape),
        Math::Letter(letter) => italic(*letter)?,
        _ => return None,
    };
    Some(holding("mi", String::from_iter([letter, accent.mark()?])))
}

/// The italic character of a letter, as browsers show an `mi` of one letter.
fn italic(letter: char) -> Option<char> {
    let (first, italic) = match letter {
        // The italic h has a code point outside the range of the others.
        'h' => return Some('\u{210e}'),
        'A'..='Z' => ('A', 0x1d434),
        'a'..='z' => ('a', 0x1d44e),
        'Α'..='Ω' => ('Α', 0x1d6e2),
        'α'..='ω' => ('α', 0x1d6fc),
        _ => return None,
    };
    char::from_u32(italic + u32::from(letter) - u32::from(first))
}

fn styled(font: Font, inside: &Math) -> Element {
    let text = match inside {
        Math::Letter(letter) => letter.to_string(),
        Math::Word(text) | Math::Number(text) => text.clone(),
        Math::Row(pieces) => {
            return element("mrow").with_all(pieces.iter().map(|piece| styled(font, piece)));
        }
        Math::Script(script) => {
            let mut whole = with_indices(script);
            if let Some(base) = whole.first_mut() {
                *base = styled(font, &script.base);
            }
            return whole;
        }
        other => return formula(other),
    };
    match font {
        Font::Upright => upright(&text),
        // A word in one element would be upright, so each letter has its own.
        Font::Italic => {
            element("mrow").with_all(text.chars().map(|letter| holding("mi", letter.to_string())))
        }
        _ => upright(&text.chars().map(|letter| font.character(letter)).collect::<String>()),
    }
}

fn matrix(rows: &[Vec<Math>]) -> Element {
    let is_apart = rows.iter().flatten().any(|entry| matches!(entry, Math::Lines(_)));
    let rows = rows.iter().map(|row| row.iter().map(formula).collect());
    // A column with entries of several lines is aligned at the left.
    in_brackets(rows, if is_apart { Some("left") } else { None })
}

/// A matrix in brackets with these entries, row by row.
pub fn bracketed(rows: impl IntoIterator<Item = Vec<Element>>) -> Element {
    in_brackets(rows, None)
}

fn in_brackets(
    rows: impl IntoIterator<Item = Vec<Element>>,
    align: Option<&'static str>,
) -> Element {
    let cell = |entry: Element| {
        let cell = element("mtd").with(entry);
        match align {
            Some(align) => cell.attribute("columnalign", align),
            None => cell,
        }
    };
    let rows = rows.into_iter().map(|row| element("mtr").with_all(row.into_iter().map(cell)));
    let table = element("mtable").with_all(rows);
    let [open, close] = [("[", "prefix"), ("]", "postfix")]
        .map(|(sign, form)| holding("mo", sign).attribute("fence", "true").attribute("form", form));
    element("mrow").with_all([open, table, close])
}

#[cfg(test)]
mod tests {
    use robot_model::signs::FunctionName;

    use super::*;

    fn shown(math: &Math) -> String {
        formula(math).to_string()
    }

    #[test]
    fn indices_and_accents() {
        let rate = Math::Accent(Accent::DoubleDot, Box::new(Math::Letter('q')));
        assert_eq!(
            shown(&rate.with_lower(Math::integer(2)).with_upper(Math::integer(3))),
            "<msubsup><mi>\u{1d45e}\u{308}</mi><mn>2</mn><mn>3</mn></msubsup>"
        );
        let of = |letter| shown(&Math::Accent(Accent::Dot, Box::new(Math::Letter(letter))));
        let marked = ['h', 'Z', 'ω'].map(of).concat();
        assert_eq!(
            marked,
            "<mi>\u{210e}\u{307}</mi><mi>\u{1d44d}\u{307}</mi><mi>\u{1d714}\u{307}</mi>"
        );
        let word = Math::Word("cm".to_owned());
        assert_eq!(
            shown(&Math::Accent(Accent::Dot, Box::new(word))),
            "<mover><mi>cm</mi><mo stretchy=\"false\">\u{2d9}</mo></mover>"
        );
        assert_eq!(
            shown(&Math::Styled(
                Font::Bold,
                Box::new(Math::Letter('J').with_lower(Math::Letter('x')))
            )),
            "<msub><mi mathvariant=\"normal\">\u{1d409}</mi><mi>x</mi></msub>"
        );
    }

    #[test]
    fn functions_keep_their_distance() {
        let row = Math::Row(vec![
            Math::Letter('g'),
            Math::Function(FunctionName::Sine),
            Math::Letter('q'),
            Math::Sign('-'),
            Math::Function(FunctionName::Cosine),
            Math::Fenced(Fence::Parentheses, Box::new(Math::Letter('x'))),
        ]);
        assert_eq!(shown(&row).matches("<mspace width=\"0.167em\"></mspace>").count(), 2);
        assert!(shown(&row).contains("<mo>−</mo><mi>cos</mi><mrow><mo fence"));
    }

    #[test]
    fn a_line_that_continues_a_sum_has_its_sign_between() {
        let sum = |first| Math::Row(vec![first, Math::Letter('m')]);
        assert!(continued(&sum(Math::Sign('+'))).to_string().contains("<mo form=\"infix\">+"));
        let fenced = Math::Fenced(Fence::Parentheses, Box::new(Math::Letter('x')));
        assert_eq!(continued(&fenced).to_string().matches("form=\"prefix\"").count(), 1);
        assert!(!continued(&fenced).to_string().contains("infix"));
    }

    #[test]
    fn text_is_never_markup() {
        let hostile = Math::Word("</math><script>&".to_owned());
        assert_eq!(shown(&hostile), "<mi>&lt;/math&gt;&lt;script&gt;&amp;</mi>");
    }
}
