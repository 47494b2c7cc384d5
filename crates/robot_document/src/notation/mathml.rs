//! Formulas as MathML, the markup of formulas in HTML.
//!
//! Only what MathML Core has is used, so that browsers set it: fonts are characters of their own, and
//! there are no attributes of style.

use std::fmt;

use robot_model::signs::{Accent, Font};

use crate::math::{Fence, Math, Script};

/// An element of MathML.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Markup {
    /// Its name, such as `mrow`.
    pub name: &'static str,
    /// Its attributes.
    pub attributes: Vec<(&'static str, &'static str)>,
    /// Its content.
    pub content: Content,
}

/// The content of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Content {
    /// Text, as it is to be read.
    Text(String),
    /// Elements.
    Elements(Vec<Markup>),
}

/// The MathML of a formula, without the element `math` around it.
#[must_use]
pub fn formula(math: &Math) -> Markup {
    match math {
        Math::Number(digits) => leaf("mn", digits),
        Math::Letter(letter) => leaf("mi", &letter.to_string()),
        Math::Word(word) => upright(word),
        Math::Sign(sign) => operator(*sign),
        Math::Function(name) => leaf("mi", name.text()),
        Math::Symbol(symbol) => formula(&symbol.shape),
        Math::Row(pieces) => row(pieces),
        Math::Script(script) => with_indices(script),
        Math::Accent(Accent::Underline, inside) => {
            let line = leaf("mo", Accent::Underline.sign());
            inner("munder", vec![formula(inside), line]).with("accentunder", "true")
        }
        Math::Accent(accent, inside) => marked(*accent, inside).unwrap_or_else(|| {
            let stretches = if accent.stretches() { "true" } else { "false" };
            let sign = leaf("mo", accent.sign()).with("stretchy", stretches);
            let whole = inner("mover", vec![formula(inside), sign]);
            // As accents, dots touch what is below in Chromium.
            match accent {
                Accent::Dot | Accent::DoubleDot => whole,
                _ => whole.with("accent", "true"),
            }
        }),
        Math::Styled(font, inside) => styled(*font, inside),
        Math::Fraction(parts) => inner("mfrac", parts.iter().map(formula).collect()),
        Math::Root(inside) => inner("msqrt", vec![formula(inside)]),
        Math::Fenced(fence, inside) => {
            let [open, close] = match fence {
                Fence::Parentheses => ["(", ")"],
                Fence::Bars => ["|", "|"],
            };
            let [open, close] = [(open, "prefix"), (close, "postfix")]
                .map(|(sign, form)| leaf("mo", sign).with("fence", "true").with("form", form));
            inner("mrow", vec![open, formula(inside), close])
        }
        Math::Matrix(rows) => matrix(rows),
    }
}

/// The MathML of a line or a term that goes on with a sum: the sign that it starts with stands between
/// it and what is before.
#[must_use]
pub fn continued(math: &Math) -> Markup {
    let mut markup = formula(math);
    if let Content::Elements(parts) = &mut markup.content
        && let Some(sign) = parts.first_mut().filter(|part| part.name == "mo")
    {
        sign.attributes.push(("form", "infix"));
    }
    markup
}

fn leaf(name: &'static str, text: &str) -> Markup {
    Markup { name, attributes: vec![], content: Content::Text(text.to_owned()) }
}

fn inner(name: &'static str, elements: Vec<Markup>) -> Markup {
    Markup { name, attributes: vec![], content: Content::Elements(elements) }
}

impl Markup {
    /// The element with one more attribute.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: &'static str) -> Markup {
        self.attributes.push((name, value));
        self
    }
}

/// A single letter would be italic.
fn upright(word: &str) -> Markup {
    let text = leaf("mi", word);
    if word.chars().count() == 1 { text.with("mathvariant", "normal") } else { text }
}

fn operator(sign: char) -> Markup {
    match sign {
        '-' => leaf("mo", "−"),
        '(' | ')' => leaf("mo", &sign.to_string()).with("stretchy", "false"),
        _ => leaf("mo", &sign.to_string()),
    }
}

/// Pieces side by side, with a thin space around functions and words.
fn row(pieces: &[Math]) -> Markup {
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
            elements.push(inner("mspace", vec![]).with("width", "0.167em"));
        }
        elements.push(formula(piece));
    }
    inner("mrow", elements)
}

fn with_indices(script: &Script) -> Markup {
    // The power of a symbol with an index is above the index.
    if let (None, Some(upper), Some(own)) = (&script.lower, &script.upper, own_index(&script.base))
        && let (Some(lower), None) = (&own.lower, &own.upper)
    {
        return inner("msubsup", vec![formula(&own.base), formula(lower), formula(upper)]);
    }
    let base = formula(&script.base);
    match (&script.lower, &script.upper) {
        (Some(lower), Some(upper)) => inner("msubsup", vec![base, formula(lower), formula(upper)]),
        (Some(lower), None) => inner("msub", vec![base, formula(lower)]),
        (None, Some(upper)) => inner("msup", vec![base, formula(upper)]),
        (None, None) => base,
    }
}

/// The indices that a base has itself.
fn own_index(base: &Math) -> Option<&Script> {
    match base {
        Math::Script(script) => Some(script),
        Math::Symbol(symbol) => own_index(&symbol.shape),
        _ => None,
    }
}

/// A letter and a mark on it as characters: the font knows where the mark belongs. Above a letter that is
/// an element of its own, browsers set marks without a gap, and left of where a slanted letter has them.
fn marked(accent: Accent, inside: &Math) -> Option<Markup> {
    let letter = match inside {
        Math::Symbol(symbol) => return marked(accent, &symbol.shape),
        Math::Letter(letter) => italic(*letter)?,
        _ => return None,
    };
    Some(leaf("mi", &String::from_iter([letter, accent.mark()?])))
}

/// The italic character of a letter, as browsers show an `mi` of one letter.
fn italic(letter: char) -> Option<char> {
    let (first, italic) = match letter {
        // It is older than the others.
        'h' => return Some('\u{210e}'),
        'A'..='Z' => ('A', 0x1d434),
        'a'..='z' => ('a', 0x1d44e),
        'Α'..='Ω' => ('Α', 0x1d6e2),
        'α'..='ω' => ('α', 0x1d6fc),
        _ => return None,
    };
    char::from_u32(italic + u32::from(letter) - u32::from(first))
}

fn styled(font: Font, inside: &Math) -> Markup {
    let text = match inside {
        Math::Letter(letter) => letter.to_string(),
        Math::Word(text) | Math::Number(text) => text.clone(),
        Math::Row(pieces) => {
            return inner("mrow", pieces.iter().map(|piece| styled(font, piece)).collect());
        }
        Math::Script(script) => {
            let mut whole = with_indices(script);
            if let Content::Elements(parts) = &mut whole.content
                && let Some(base) = parts.first_mut()
            {
                *base = styled(font, &script.base);
            }
            return whole;
        }
        other => return formula(other),
    };
    match font {
        Font::Upright => upright(&text),
        // Letters run together in italics.
        Font::Italic => {
            inner("mrow", text.chars().map(|letter| leaf("mi", &letter.to_string())).collect())
        }
        _ => upright(&text.chars().map(|letter| font.character(letter)).collect::<String>()),
    }
}

fn matrix(rows: &[Vec<Math>]) -> Markup {
    let cell = |entry: &Math| inner("mtd", vec![formula(entry)]);
    let rows = rows.iter().map(|row| inner("mtr", row.iter().map(cell).collect()));
    let table = inner("mtable", rows.collect());
    let [open, close] = [("[", "prefix"), ("]", "postfix")]
        .map(|(sign, form)| leaf("mo", sign).with("fence", "true").with("form", form));
    inner("mrow", vec![open, table, close])
}

/// Well-formed XML, which is HTML too.
impl fmt::Display for Markup {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(formatter, " {name}=\"{value}\"")?;
        }
        formatter.write_str(">")?;
        match &self.content {
            Content::Text(text) => {
                for character in text.chars() {
                    match character {
                        '&' => formatter.write_str("&amp;")?,
                        '<' => formatter.write_str("&lt;")?,
                        '>' => formatter.write_str("&gt;")?,
                        plain => write!(formatter, "{plain}")?,
                    }
                }
            }
            Content::Elements(elements) => {
                elements.iter().try_for_each(|element| write!(formatter, "{element}"))?;
            }
        }
        write!(formatter, "</{}>", self.name)
    }
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
    fn text_is_never_markup() {
        let hostile = Math::Word("</math><script>&".to_owned());
        assert_eq!(shown(&hostile), "<mi>&lt;/math&gt;&lt;script&gt;&amp;</mi>");
    }
}
