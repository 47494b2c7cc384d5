//! The letters and symbols for which LaTeX has a command.

/// A letter, or a symbol of the size of a letter. Typst, MathML and plain text contain the character itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Letter {
    /// The LaTeX command, without the backslash.
    pub latex: &'static str,
    /// The character.
    pub character: char,
    /// The places where it may occur.
    pub used: Use,
}

/// The places where a letter or symbol may occur.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// In names, in which it is spelled like its command: `alpha1`.
    Greek,
    /// In LaTeX that is given for a symbol.
    Symbol,
    /// Only in formulas.
    Formula,
}

impl Letter {
    /// The letter of a LaTeX command, given without the backslash.
    #[must_use]
    pub fn of_latex(command: &str) -> Option<&'static Letter> {
        LETTERS.iter().find(|letter| letter.latex == command)
    }

    /// The letter of a character.
    #[must_use]
    pub fn of_character(character: char) -> Option<&'static Letter> {
        LETTERS.iter().find(|letter| letter.character == character)
    }

    /// The Greek letter with a name such as `alpha`.
    #[must_use]
    pub fn greek(name: &str) -> Option<&'static Letter> {
        Letter::of_latex(name).filter(|letter| letter.used == Use::Greek)
    }

    /// Whether LaTeX that is given for a symbol may contain it.
    #[must_use]
    pub fn is_in_symbols(&self) -> bool {
        self.used != Use::Formula
    }
}

const fn row(latex: &'static str, character: char, used: Use) -> Letter {
    Letter { latex, character, used }
}

/// All letters and symbols.
pub const LETTERS: &[Letter] = &[
    row("alpha", 'α', Use::Greek),
    row("beta", 'β', Use::Greek),
    row("gamma", 'γ', Use::Greek),
    row("delta", 'δ', Use::Greek),
    row("epsilon", 'ϵ', Use::Greek),
    row("varepsilon", 'ε', Use::Greek),
    row("zeta", 'ζ', Use::Greek),
    row("eta", 'η', Use::Greek),
    row("theta", 'θ', Use::Greek),
    row("vartheta", 'ϑ', Use::Greek),
    row("iota", 'ι', Use::Greek),
    row("kappa", 'κ', Use::Greek),
    row("lambda", 'λ', Use::Greek),
    row("mu", 'μ', Use::Greek),
    row("nu", 'ν', Use::Greek),
    row("xi", 'ξ', Use::Greek),
    row("pi", 'π', Use::Greek),
    row("varpi", 'ϖ', Use::Greek),
    row("rho", 'ρ', Use::Greek),
    row("varrho", 'ϱ', Use::Greek),
    row("sigma", 'σ', Use::Greek),
    row("varsigma", 'ς', Use::Greek),
    row("tau", 'τ', Use::Greek),
    row("upsilon", 'υ', Use::Greek),
    row("phi", 'ϕ', Use::Greek),
    row("varphi", 'φ', Use::Greek),
    row("chi", 'χ', Use::Greek),
    row("psi", 'ψ', Use::Greek),
    row("omega", 'ω', Use::Greek),
    row("Gamma", 'Γ', Use::Greek),
    row("Delta", 'Δ', Use::Greek),
    row("Theta", 'Θ', Use::Greek),
    row("Lambda", 'Λ', Use::Greek),
    row("Xi", 'Ξ', Use::Greek),
    row("Pi", 'Π', Use::Greek),
    row("Sigma", 'Σ', Use::Greek),
    row("Upsilon", 'Υ', Use::Greek),
    row("Phi", 'Φ', Use::Greek),
    row("Psi", 'Ψ', Use::Greek),
    row("Omega", 'Ω', Use::Greek),
    row("ell", 'ℓ', Use::Symbol),
    row("star", '⋆', Use::Symbol),
    row("ast", '∗', Use::Symbol),
    row("prime", '′', Use::Symbol),
    row("circ", '∘', Use::Symbol),
    row("bullet", '∙', Use::Symbol),
    row("dagger", '†', Use::Symbol),
    row("infty", '∞', Use::Symbol),
    row("perp", '⟂', Use::Symbol),
    row("parallel", '∥', Use::Symbol),
    row("pm", '±', Use::Symbol),
    row("cdot", '·', Use::Symbol),
    row("nabla", '∇', Use::Symbol),
    row("sum", '∑', Use::Formula),
    row("times", '×', Use::Formula),
    row("partial", '∂', Use::Formula),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_and_every_character_occurs_once() {
        for letter in LETTERS {
            assert_eq!(Letter::of_latex(letter.latex), Some(letter));
            assert_eq!(Letter::of_character(letter.character), Some(letter));
        }
        assert_eq!(Letter::greek("omega").map(|letter| letter.character), Some('ω'));
        assert_eq!(Letter::greek("infty"), None);
    }
}
