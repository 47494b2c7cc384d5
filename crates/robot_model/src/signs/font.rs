//! Fonts of formulas.

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

    /// LaTeX, what Typst puts before and behind, and where Unicode's letters of the font begin.
    const fn row(self) -> (&'static str, [&'static str; 2], Option<u32>) {
        match self {
            Font::Upright => ("mathrm", ["upright(", ")"], None),
            Font::Bold => ("mathbf", ["bold(upright(", "))"], Some(0x1d400)),
            Font::Italic => ("mathit", ["italic(", ")"], None),
            Font::SansSerif => ("mathsf", ["sans(", ")"], Some(0x1d5a0)),
            // The bold ones, for the plain ones have letters elsewhere.
            Font::Calligraphic => ("mathcal", ["cal(", ")"], Some(0x1d4d0)),
            Font::BoldSymbol => ("boldsymbol", ["bold(", ")"], Some(0x1d468)),
        }
    }

    /// The font of a command of LaTeX, given without the backslash.
    #[must_use]
    pub fn of_latex(command: &str) -> Option<Font> {
        Font::ALL.into_iter().find(|font| font.latex() == command)
    }

    /// The command of LaTeX, without the backslash.
    #[must_use]
    pub const fn latex(self) -> &'static str {
        self.row().0
    }

    /// The text before and after a piece in Typst's math mode.
    #[must_use]
    pub const fn typst(self) -> [&'static str; 2] {
        self.row().1
    }

    /// The character of a letter in the font, from Unicode's Mathematical Alphanumeric Symbols; other
    /// characters, and letters in upright and italic fonts, as they are.
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
