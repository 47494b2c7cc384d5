//! Labels in the standard fonts, which every PDF viewer has.

use robot_document::document::Inline;
use robot_document::math::{Fence, Math};

use super::fonts::{BOLD, DOT, FONTS, GREEK, ITALIC, ROOT, SANS, TIMES, UPRIGHT};

/// Characters with the same font, size and height.
pub(super) struct Run {
    pub(super) font: usize,
    /// The codes of the characters.
    pub(super) text: Vec<u8>,
    /// The height of the baseline above that of the label, in units of the label's font size.
    pub(super) rise: f64,
    /// The font size, in units of the label's font size.
    pub(super) scale: f64,
}

impl Run {
    /// The width, in units of the label's font size.
    pub(super) fn width(&self) -> f64 {
        Run::width_of(self.font, &self.text) * self.scale
    }

    /// The width of characters, in units of their font size.
    pub(super) fn width_of(font: usize, text: &[u8]) -> f64 {
        text.iter().map(|code| FONTS[font].width(*code)).sum()
    }
}

/// The runs of a label, from left to right.
pub(super) fn runs(words: &Inline, is_bold: bool) -> Vec<Run> {
    let mut runs = vec![];
    match words {
        Inline::Math(math) => formula(math, 0.0, 1.0, &mut runs),
        Inline::Text(text) | Inline::Emphasis(text) | Inline::Reference(text) => {
            let font = if is_bold { BOLD } else { SANS };
            runs.push(Run { font, text: latin(text), rise: 0.0, scale: 1.0 });
        }
    }
    runs
}

/// The codes of characters; those that the fonts lack become question marks.
fn latin(text: &str) -> Vec<u8> {
    let code = |character: char| {
        let code = u8::try_from(character).ok();
        code.filter(|code| matches!(code, 32..=126 | 160..)).unwrap_or(b'?')
    };
    text.chars().map(code).collect()
}

/// The size of indices, and the distances by which they are lowered and raised, in units of the font size.
const INDEX: f64 = 0.7;
const LOWER: f64 = -0.18;
const UPPER: f64 = 0.35;

fn formula(math: &Math, rise: f64, scale: f64, runs: &mut Vec<Run>) {
    let mut add = |font, text: Vec<u8>| runs.push(Run { font, text, rise, scale });
    match math {
        Math::Number(digits) => add(UPRIGHT, latin(digits)),
        Math::Word(word) => add(UPRIGHT, latin(word)),
        Math::Function(name) => add(UPRIGHT, latin(name.text())),
        Math::Letter(letter) => match greek(*letter) {
            Some(code) => add(GREEK, vec![code]),
            None => add(ITALIC, latin(&letter.to_string())),
        },
        // The minus sign, the multiplication sign and the dot are in the font of Greek letters.
        Math::Sign('-') => add(GREEK, b"-".to_vec()),
        Math::Sign('·') => add(GREEK, vec![DOT]),
        Math::Sign('×') => add(GREEK, vec![TIMES]),
        Math::Sign(sign) => add(UPRIGHT, latin(&sign.to_string())),
        Math::Symbol(symbol) => formula(&symbol.shape, rise, scale, runs),
        Math::Row(pieces) => pieces.iter().for_each(|piece| formula(piece, rise, scale, runs)),
        Math::Script(script) => {
            formula(&script.base, rise, scale, runs);
            for (index, shift) in [(&script.lower, LOWER), (&script.upper, UPPER)] {
                if let Some(index) = index {
                    formula(index, rise + shift * scale, scale * INDEX, runs);
                }
            }
        }
        Math::Accent(_, inside) | Math::Styled(_, inside) => formula(inside, rise, scale, runs),
        Math::Fraction(parts) => {
            formula(&parts[0], rise, scale, runs);
            runs.push(Run { font: UPRIGHT, text: b"/".to_vec(), rise, scale });
            formula(&parts[1], rise, scale, runs);
        }
        Math::Root(inside) => {
            add(GREEK, vec![ROOT]);
            formula(inside, rise, scale, runs);
        }
        Math::Fenced(fence, inside) => {
            let [open, close] = match fence {
                Fence::Parentheses => ["(", ")"],
                Fence::Bars => ["|", "|"],
                Fence::Brackets => ["[", "]"],
            };
            add(UPRIGHT, latin(open));
            formula(inside, rise, scale, runs);
            runs.push(Run { font: UPRIGHT, text: latin(close), rise, scale });
        }
        Math::Matrix(rows) => {
            rows.iter().flatten().for_each(|entry| formula(entry, rise, scale, runs));
        }
        Math::Lines(lines) => lines.iter().for_each(|line| formula(&line.math, rise, scale, runs)),
    }
}

/// The code of a Greek letter in the font Symbol.
fn greek(letter: char) -> Option<u8> {
    const LETTERS: &str = "αβχδεφγηιϕκλμνοπθρστυϖωξψζ";
    const CAPITALS: &str = "ΑΒΧΔΕΦΓΗΙϑΚΛΜΝΟΠΘΡΣΤΥςΩΞΨΖ";
    let place = |all: &str, first: u8| {
        let place = all.chars().position(|known| known == letter)?;
        u8::try_from(place).ok().map(|place| first + place)
    };
    place(LETTERS, b'a').or_else(|| place(CAPITALS, b'A'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_italic_with_smaller_indices() {
        let math = Math::Letter('l').with_lower(Math::integer(6));
        let found = runs(&Inline::Math(math), false);
        let shown: Vec<(usize, &[u8])> = found.iter().map(|run| (run.font, &*run.text)).collect();
        assert_eq!(shown, [(ITALIC, &b"l"[..]), (UPRIGHT, &b"6"[..])]);
        assert!(found[1].rise < 0.0 && found[1].scale < 1.0);
        assert!((Run::width_of(ITALIC, b"l") - 0.278).abs() < 1e-12);
    }

    #[test]
    fn letters_that_the_fonts_lack_are_question_marks() {
        assert_eq!(latin("é中(\u{202e}"), [0xe9, b'?', b'(', b'?']);
        assert_eq!(
            ['α', 'ω', 'Ω', 'φ', 'q'].map(greek),
            [Some(b'a'), Some(b'w'), Some(b'W'), Some(b'f'), None]
        );
    }
}
