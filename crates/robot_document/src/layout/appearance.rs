//! Layouts that look the same although they differ.

use robot_model::signs::{Accent, Font};

use super::math::{Math, Script};

/// The layout with the same look that stands for all of them: fonts are moved to the letters on which they have an effect,
/// and wide accents count as plain ones, since Typst has no others.
pub(super) fn appearance(shape: &Math) -> Math {
    match shape {
        Math::Symbol(symbol) => appearance(&symbol.shape),
        Math::Letter('∗') => Math::Sign('*'),
        Math::Word(word) => of_word(word),
        Math::Row(pieces) => row(pieces.iter().map(appearance)),
        Math::Script(script) => scripts(script, appearance),
        Math::Accent(accent, inside) => {
            let accent = match accent {
                Accent::WideHat => Accent::Hat,
                Accent::WideTilde => Accent::Tilde,
                other => *other,
            };
            Math::Accent(accent, Box::new(appearance(inside)))
        }
        Math::Styled(font, inside) => styled(*font, &appearance(inside)),
        other => other.clone(),
    }
}

/// A word of one digit or sign is this digit or sign.
fn of_word(word: &str) -> Math {
    let mut letters = word.chars();
    match (letters.next(), letters.next()) {
        (Some(_), _) if word.chars().all(|one| one.is_ascii_digit()) => {
            Math::Number(word.to_owned())
        }
        (Some(sign), None) if !sign.is_alphabetic() => Math::Sign(sign),
        _ => Math::Word(word.to_owned()),
    }
}

/// Neighboring words are one word.
fn row(pieces: impl Iterator<Item = Math>) -> Math {
    let mut all: Vec<Math> = vec![];
    for piece in pieces {
        match (all.last_mut(), piece) {
            (Some(Math::Word(before)), Math::Word(word)) => before.push_str(&word),
            (_, piece) => all.push(piece),
        }
    }
    match all.as_slice() {
        [one] => one.clone(),
        _ => Math::Row(all),
    }
}

fn scripts(script: &Script, change: impl Fn(&Math) -> Math) -> Math {
    let Script { base, lower, upper } = script;
    let [lower, upper] = [lower, upper].map(|index| index.as_ref().map(&change));
    Math::Script(Box::new(Script { base: change(base), lower, upper }))
}

/// A layout without fonts outside of letters, in a font.
fn styled(font: Font, inside: &Math) -> Math {
    match inside {
        Math::Row(pieces) => row(pieces.iter().map(|piece| styled(font, piece))),
        Math::Script(script) => scripts(script, |piece| styled(font, piece)),
        Math::Accent(accent, inside) => Math::Accent(*accent, Box::new(styled(font, inside))),
        Math::Letter(letter) if letter.is_ascii() && font == Font::Upright => {
            Math::Word(letter.to_string())
        }
        // These fonts have no small Greek letters, and capital ones are upright anyway.
        Math::Letter(letter) if !letter.is_ascii() => match font {
            Font::BoldSymbol => Math::Styled(font, Box::new(inside.clone())),
            _ if letter.is_lowercase() || font == Font::Upright => inside.clone(),
            _ => Math::Styled(font, Box::new(inside.clone())),
        },
        Math::Number(_) if font == Font::Upright => inside.clone(),
        Math::Sign(_) | Math::Styled(..) if font != Font::BoldSymbol => inside.clone(),
        _ => Math::Styled(font, Box::new(inside.clone())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex;

    fn alike(one: &str, other: &str) -> bool {
        let [one, other] = [one, other].map(|text| appearance(&latex::read_symbol(text).unwrap()));
        one == other
    }

    #[test]
    fn spellings_with_the_same_look_are_equal() {
        for (one, other) in [
            (r"x^*", r"x^\ast"),
            (r"x_1", r"x_{\mathrm{1}}"),
            (r"\alpha", r"\mathrm{\alpha}"),
            (r"\alpha", r"\mathbf{\alpha}"),
            (r"\Gamma", r"\mathrm{\Gamma}"),
            (r"x_{-}", r"x_{\mathrm{-}}"),
            (r"\mathrm{a}_1", r"\mathrm{a_1}"),
            (r"\hat{x}", r"\widehat{x}"),
            (r"\tilde{x}", r"\widetilde{x}"),
        ] {
            assert!(alike(one, other), "{one} and {other}");
        }
    }

    #[test]
    fn spellings_with_another_look_are_not() {
        for (one, other) in [
            ("x_1", "x^1"),
            ("x", r"\mathrm{x}"),
            ("x", r"\mathbf{x}"),
            (r"\alpha", r"\boldsymbol{\alpha}"),
            (r"\Gamma", r"\mathbf{\Gamma}"),
            (r"x_1", r"x_{\mathbf{1}}"),
            (r"\hat{x}", r"\bar{x}"),
            (r"\mathbf{a}_1", r"\mathbf{a_1}"),
        ] {
            assert!(!alike(one, other), "{one} and {other}");
        }
    }
}
