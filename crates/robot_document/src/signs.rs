//! Greek letters, signs, accents and fonts, with the commands that LaTeX has for them.

use crate::math::{Accent, Style};

/// Commands for one character.
pub(crate) const CHARACTERS: &[(&str, char)] = &[
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ϵ'),
    ("varepsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("vartheta", 'ϑ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("pi", 'π'),
    ("varpi", 'ϖ'),
    ("rho", 'ρ'),
    ("varrho", 'ϱ'),
    ("sigma", 'σ'),
    ("varsigma", 'ς'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'ϕ'),
    ("varphi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Xi", 'Ξ'),
    ("Pi", 'Π'),
    ("Sigma", 'Σ'),
    ("Upsilon", 'Υ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
    ("ell", 'ℓ'),
    ("star", '⋆'),
    ("ast", '∗'),
    ("prime", '′'),
    ("circ", '∘'),
    ("bullet", '∙'),
    ("dagger", '†'),
    ("infty", '∞'),
    ("perp", '⟂'),
    ("parallel", '∥'),
    ("pm", '±'),
    ("nabla", '∇'),
    ("sum", '∑'),
    ("times", '×'),
    ("partial", '∂'),
];

/// Commands that put a sign above their argument.
pub(crate) const ACCENTS: &[(&str, Accent)] = &[
    ("dot", Accent::Dot),
    ("ddot", Accent::DoubleDot),
    ("bar", Accent::Bar),
    ("hat", Accent::Hat),
    ("tilde", Accent::Tilde),
    ("vec", Accent::Vector),
    ("check", Accent::Check),
    ("breve", Accent::Breve),
    ("overline", Accent::Overline),
    ("underline", Accent::Underline),
    ("widehat", Accent::WideHat),
    ("widetilde", Accent::WideTilde),
];

/// Commands that set their argument in another font.
pub(crate) const STYLES: &[(&str, Style)] = &[
    ("mathrm", Style::Upright),
    ("mathbf", Style::Bold),
    ("mathit", Style::Italic),
    ("mathsf", Style::SansSerif),
    ("mathcal", Style::Calligraphic),
    ("boldsymbol", Style::BoldSymbol),
];

/// What a table has for a command.
pub(crate) fn of_command<T: Copy>(table: &[(&'static str, T)], command: &str) -> Option<T> {
    table.iter().find(|(known, _)| *known == command).map(|(_, value)| *value)
}

/// The command for a value of a table.
pub(crate) fn command_of<T: PartialEq>(
    table: &[(&'static str, T)],
    value: &T,
) -> Option<&'static str> {
    table.iter().find(|(_, known)| known == value).map(|(command, _)| *command)
}
