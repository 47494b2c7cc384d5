//! Formulas as layouts that do not depend on a notation: pieces beside, above and below each other.
//!
//! The printers, one for each notation, walk this tree; line breaking measures and splits it. A symbol of the robot
//! keeps its name, so that a printer can tell which parameter or coordinate it shows.

use robot_model::signs::{Accent, Font, FunctionName};

/// A formula, or a piece of one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Math {
    /// A number as its digits: `0.35`.
    Number(String),
    /// An italic letter, Latin or Greek, such as `q` or `ω`; also other symbols of that size, such as `∞`.
    Letter(char),
    /// An upright word.
    Word(String),
    /// One of `+ - · × = , : ; . / * ( )` between or beside other pieces.
    Sign(char),
    /// The upright name of a function, before its argument: `sin`, `tanh`, `sgn`.
    Function(FunctionName),
    /// A symbol of the equations.
    Symbol(Symbol),
    /// Pieces side by side. Neighbors without a sign between them are factors.
    Row(Vec<Math>),
    /// A piece with indices.
    Script(Box<Script>),
    /// A piece with an accent above or below it.
    Accent(Accent, Box<Math>),
    /// A piece in another font.
    Styled(Font, Box<Math>),
    /// A fraction: its numerator and denominator.
    Fraction(Box<[Math; 2]>),
    /// A square root.
    Root(Box<Math>),
    /// A piece between fences.
    Fenced(Fence, Box<Math>),
    /// A matrix in brackets, row by row.
    Matrix(Vec<Vec<Math>>),
    /// The lines of a sum that does not fit on one line, one below the other.
    Lines(Vec<Line>),
}

/// A line of a formula that takes several lines.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Line {
    /// The pieces of the line. A parenthesis that opens or closes in another line is a [`Math::Sign`].
    pub math: Math,
    /// How much further the line is indented than those that start with a term of the whole sum, in quads.
    pub indent: usize,
}

/// A symbol of the equations with its layout.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Symbol {
    /// The name in text, such as that of a parameter, `q2`, `qdd2` or `F_l5.x`.
    pub name: String,
    /// The layout.
    pub shape: Box<Math>,
}

/// A base with indices.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Script {
    /// The piece to which the indices belong.
    pub base: Math,
    /// The lower index.
    pub lower: Option<Math>,
    /// The upper index.
    pub upper: Option<Math>,
}

/// The signs that enclose a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fence {
    /// `( )`
    Parentheses,
    /// `| |`
    Bars,
    /// `[ ]`
    Brackets,
}

/// An empty row.
impl Default for Math {
    fn default() -> Math {
        Math::Row(vec![])
    }
}

impl Math {
    /// Adds a lower index: `base_lower`.
    #[must_use]
    pub fn with_lower(self, lower: Math) -> Math {
        Math::Script(Box::new(Script { base: self, lower: Some(lower), upper: None }))
    }

    /// Adds an upper index: `base^upper`.
    #[must_use]
    pub fn with_upper(self, upper: Math) -> Math {
        Math::Script(Box::new(Script { base: self, lower: None, upper: Some(upper) }))
    }

    /// A number that the program makes, such as an index.
    #[must_use]
    pub fn integer(value: usize) -> Math {
        Math::Number(value.to_string())
    }

    /// A row of pieces; a single piece stays as it is.
    #[must_use]
    pub fn row(mut pieces: Vec<Math>) -> Math {
        match (pieces.len(), pieces.pop()) {
            (1, Some(single)) => single,
            (_, Some(last)) => {
                pieces.push(last);
                Math::Row(pieces)
            }
            (_, None) => Math::Row(pieces),
        }
    }

    /// The pieces of a row, or the piece itself if it is not a row.
    #[must_use]
    pub fn pieces(&self) -> &[Math] {
        match self {
            Math::Row(pieces) => pieces,
            single => std::slice::from_ref(single),
        }
    }

    /// The names of the symbols within, each once, in the order of their appearance.
    #[must_use]
    pub fn symbols(&self) -> Vec<&str> {
        let mut names: Vec<&str> = vec![];
        let mut pending = vec![self];
        while let Some(math) = pending.pop() {
            match math {
                Math::Symbol(symbol) if !names.contains(&symbol.name.as_str()) => {
                    names.push(&symbol.name);
                }
                _ => pending.extend(math.parts().into_iter().rev()),
            }
        }
        names
    }

    /// Whether any piece within, including the layouts of symbols, has an upper index.
    #[must_use]
    pub fn has_upper_index(&self) -> bool {
        let mut pending = vec![self];
        while let Some(math) = pending.pop() {
            match math {
                Math::Symbol(symbol) => pending.push(&symbol.shape),
                Math::Script(script) if script.upper.is_some() => return true,
                _ => pending.extend(math.parts()),
            }
        }
        false
    }

    /// Whether the lower index ends with the name of an axis, as those of the components of a vector do.
    #[must_use]
    pub fn is_like_component(&self) -> bool {
        match self {
            Math::Symbol(symbol) => symbol.shape.is_like_component(),
            Math::Script(script) => {
                match script.lower.as_ref().and_then(|lower| lower.pieces().last()) {
                    Some(Math::Letter('x' | 'y' | 'z')) => true,
                    Some(index) => index.is_like_component(),
                    None => false,
                }
            }
            _ => false,
        }
    }

    /// Whether the piece is a function, possibly with an exponent, whose argument follows.
    #[must_use]
    pub fn is_function(&self) -> bool {
        match self {
            Math::Function(_) => true,
            Math::Script(script) => script.base.is_function(),
            _ => false,
        }
    }

    /// Whether a thin space separates the piece from the preceding one: both are factors, and one of them is a symbol
    /// of several letters, such as `mp`, or a word in italics, such as `ZZR` with an index.
    #[must_use]
    pub fn is_apart_from(&self, before: &Math) -> bool {
        let is_factor = |piece: &Math| {
            !matches!(piece, Math::Sign(_) | Math::Fenced(..) | Math::Fraction(_))
                && !piece.is_function()
        };
        (self.is_word() || before.is_word()) && is_factor(self) && is_factor(before)
    }

    fn is_word(&self) -> bool {
        match self {
            Math::Symbol(symbol) => symbol.shape.is_word() || symbol.shape.is_upright_word(),
            Math::Script(script) => script.base.is_word(),
            Math::Styled(Font::Italic, inside) => matches!(**inside, Math::Row(_)),
            _ => false,
        }
    }

    /// Whether the piece is an upright word, with or without indices. Beside other pieces of a symbol, such a word needs
    /// no space.
    fn is_upright_word(&self) -> bool {
        match self {
            Math::Word(_) => true,
            Math::Script(script) => script.base.is_upright_word(),
            _ => false,
        }
    }

    /// The pieces directly within this one; none for a symbol, whose layout is a formula of its own.
    #[must_use]
    pub fn parts(&self) -> Vec<&Math> {
        match self {
            Math::Row(pieces) => pieces.iter().collect(),
            Math::Script(script) => {
                std::iter::once(&script.base).chain(&script.lower).chain(&script.upper).collect()
            }
            Math::Accent(_, inside)
            | Math::Styled(_, inside)
            | Math::Root(inside)
            | Math::Fenced(_, inside) => vec![inside],
            Math::Fraction(parts) => parts.iter().collect(),
            Math::Matrix(rows) => rows.iter().flatten().collect(),
            Math::Lines(lines) => lines.iter().map(|line| &line.math).collect(),
            _ => vec![],
        }
    }
}
