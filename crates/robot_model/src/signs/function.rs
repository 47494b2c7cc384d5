//! The names of functions in printed formulas.

use robot_symbolic::Function;

/// A function that is printed by its name. Roots, absolute values and reciprocals have their own notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is its own name")]
pub enum FunctionName {
    Sine,
    Cosine,
    HyperbolicTangent,
    Sign,
}

impl FunctionName {
    /// All names.
    pub const ALL: [FunctionName; 4] = [
        FunctionName::Sine,
        FunctionName::Cosine,
        FunctionName::HyperbolicTangent,
        FunctionName::Sign,
    ];

    /// The function, its name in upright letters, and its LaTeX.
    const fn row(self) -> (Function, &'static str, &'static str) {
        match self {
            FunctionName::Sine => (Function::Sin, "sin", r"\sin"),
            FunctionName::Cosine => (Function::Cos, "cos", r"\cos"),
            FunctionName::HyperbolicTangent => (Function::Tanh, "tanh", r"\tanh"),
            FunctionName::Sign => (Function::Sign, "sgn", r"\operatorname{sgn}"),
        }
    }

    /// The name of a function; `None` if the function has its own notation.
    #[must_use]
    pub fn of(function: Function) -> Option<FunctionName> {
        FunctionName::ALL.into_iter().find(|name| name.function() == function)
    }

    /// The function that the name denotes.
    #[must_use]
    pub const fn function(self) -> Function {
        self.row().0
    }

    /// The name in upright letters, as in text, Typst and MathML.
    #[must_use]
    pub const fn text(self) -> &'static str {
        self.row().1
    }

    /// The LaTeX command, including the backslash.
    #[must_use]
    pub const fn latex(self) -> &'static str {
        self.row().2
    }
}
