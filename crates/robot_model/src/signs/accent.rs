//! Accents: marks above and below letters.

/// A mark above or below a part of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is its own name")]
pub enum Accent {
    Dot,
    DoubleDot,
    Bar,
    Hat,
    Tilde,
    Vector,
    Check,
    Breve,
    Overline,
    Underline,
    WideHat,
    WideTilde,
}

/// The spellings of an accent in each notation.
struct Row {
    latex: &'static str,
    typst: &'static str,
    sign: &'static str,
    mark: Option<char>,
    stretches: bool,
}

const fn row(
    latex: &'static str,
    typst: &'static str,
    sign: &'static str,
    mark: Option<char>,
    stretches: bool,
) -> Row {
    Row { latex, typst, sign, mark, stretches }
}

impl Accent {
    /// All accents.
    pub const ALL: [Accent; 12] = [
        Accent::Dot,
        Accent::DoubleDot,
        Accent::Bar,
        Accent::Hat,
        Accent::Tilde,
        Accent::Vector,
        Accent::Check,
        Accent::Breve,
        Accent::Overline,
        Accent::Underline,
        Accent::WideHat,
        Accent::WideTilde,
    ];

    const fn row(self) -> Row {
        match self {
            Accent::Dot => row("dot", "dot", "\u{2d9}", Some('\u{307}'), false),
            Accent::DoubleDot => row("ddot", "dot.double", "\u{a8}", Some('\u{308}'), false),
            Accent::Bar => row("bar", "macron", "\u{af}", Some('\u{304}'), false),
            Accent::Hat => row("hat", "hat", "^", Some('\u{302}'), false),
            Accent::Tilde => row("tilde", "tilde", "~", Some('\u{303}'), false),
            Accent::Vector => row("vec", "arrow", "\u{2192}", None, false),
            Accent::Check => row("check", "caron", "\u{2c7}", Some('\u{30c}'), false),
            Accent::Breve => row("breve", "breve", "\u{2d8}", Some('\u{306}'), false),
            Accent::Overline => row("overline", "overline", "\u{af}", None, true),
            Accent::Underline => row("underline", "underline", "_", None, false),
            Accent::WideHat => row("widehat", "hat", "^", None, true),
            Accent::WideTilde => row("widetilde", "tilde", "~", None, true),
        }
    }

    /// The accent of a LaTeX command, given without the backslash.
    #[must_use]
    pub fn of_latex(command: &str) -> Option<Accent> {
        Accent::ALL.into_iter().find(|accent| accent.latex() == command)
    }

    /// The LaTeX command, without the backslash.
    #[must_use]
    pub const fn latex(self) -> &'static str {
        self.row().latex
    }

    /// The function in the math mode of Typst.
    #[must_use]
    pub const fn typst(self) -> &'static str {
        self.row().typst
    }

    /// The mark as a character of its own, as MathML places it over or under a part of a formula.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        self.row().sign
    }

    /// The combining character of Unicode that puts the mark above the preceding letter.
    #[must_use]
    pub const fn mark(self) -> Option<char> {
        self.row().mark
    }

    /// Whether the mark is as wide as the part of the formula that it belongs to.
    #[must_use]
    pub const fn stretches(self) -> bool {
        self.row().stretches
    }
}
