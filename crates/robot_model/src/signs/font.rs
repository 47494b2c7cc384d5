//! The fonts of letters in formulas.

/// A font of letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is its own name")]
pub enum Font {
    Upright,
    Bold,
    Italic,
    SansSerif,
    Calligraphic,
    BoldSymbol,
}

impl Font {
    /// All fonts.
    pub const ALL: [Font; 6] = [
        Font::Upright,
        Font::Bold,
        Font::Italic,
        Font::SansSerif,
        Font::Calligraphic,
        Font::BoldSymbol,
    ];

    /// The LaTeX command, the Typst text before and after the letters, and the code point of the font's first letter in
    /// Unicode.
    const fn row(self) -> (&'static str, [&'static str; 2], Option<u32>) {
        match self {
            Font::Upright => ("mathrm", ["upright(", ")"], None),
            Font::Bold => ("mathbf", ["bold(upright(", "))"], Some(0x1d400)),
            Font::Italic => ("mathit", ["italic(", ")"], None),
            Font::SansSerif => ("mathsf", ["sans(", ")"], Some(0x1d5a0)),
            // Bold letters, because some of the plain calligraphic letters are in another block of Unicode.
            Font::Calligraphic => ("mathcal", ["cal(", ")"], Some(0x1d4d0)),
            Font::BoldSymbol => ("boldsymbol", ["bold(", ")"], Some(0x1d468)),
        }
    }

    /// The font of a LaTeX command, given without the backslash.
    #[must_use]
    pub fn of_latex(command: &str) -> Option<Font> {
        Font::ALL.into_iter().find(|font| font.latex() == command)
    }

    /// The LaTeX command, without the backslash.
    #[must_use]
    pub const fn latex(self) -> &'static str {
        self.row().0
    }

    /// The text before and after the letters in the math mode of Typst.
    #[must_use]
    pub const fn typst(self) -> [&'static str; 2] {
        self.row().1
    }

    /// The character of a letter in the font, from Unicode's Mathematical Alphanumeric Symbols. Other characters, and
    /// letters in upright and italic fonts, are returned unchanged.
    #[must_use]
    pub fn character(self, letter: char) -> char {
        let place = match letter {
            'A'..='Z' => u32::from(letter) - u32::from('A'),
            'a'..='z' => u32::from(letter) - u32::from('a') + 26,
            _ => return letter,
        };
        self.row().2.and_then(|first| char::from_u32(first + place)).unwrap_or(letter)
    }
}

#[cfg(test)]
mod tests {
    use super::Font;

    #[test]
    fn letters_have_their_places_in_unicode() {
        let bold = "AZaz".chars().map(|letter| Font::Bold.character(letter));
        assert_eq!(bold.collect::<String>(), "\u{1d400}\u{1d419}\u{1d41a}\u{1d433}");
        assert_eq!(Font::Bold.character('1'), '1');
        assert_eq!(Font::Upright.character('A'), 'A');
    }
}
