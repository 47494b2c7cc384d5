//! LaTeX to tokens.

use std::ops::Range;

use robot_model::signs::{Accent, Font, FunctionName, Letter};

/// A token, without the spaces around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    /// `\frac`, `q`, `1.5`, `{`, `+`.
    pub(super) text: &'t str,
    /// Its bytes.
    pub(super) span: Range<usize>,
}

/// Commands that print nothing but space, and marks of alignment.
const SPACES: [&str; 17] = [
    "&",
    "~",
    r"\,",
    r"\;",
    r"\:",
    r"\!",
    r"\ ",
    r"\>",
    r"\quad",
    r"\qquad",
    r"\nonumber",
    r"\notag",
    r"\displaystyle",
    r"\limits",
    r"\hfill",
    r"\allowbreak",
    r"\noindent",
];

/// Fonts of papers, beside those that formulas of this project have.
const OTHER_FONTS: [&str; 6] = ["text", "textrm", "rm", "bm", "mathnormal", "textit"];

/// Accents of papers, beside those that formulas of this project have.
const OTHER_ACCENTS: [&str; 2] = ["dddot", "overrightarrow"];

/// Whether a token sets the font of the next piece; fonts do not distinguish symbols.
pub(super) fn is_font(token: &str) -> bool {
    let known = |command| Font::of_latex(command).is_some() || OTHER_FONTS.contains(&command);
    token.strip_prefix('\\').is_some_and(known)
}

/// Whether a token puts a sign over a letter, which is part of the symbol.
pub(super) fn is_accent(token: &str) -> bool {
    let known = |command| Accent::of_latex(command).is_some() || OTHER_ACCENTS.contains(&command);
    token.strip_prefix('\\').is_some_and(known)
}

/// Whether a token is the command of a Greek letter or of another sign that symbols are made of.
pub(super) fn is_letter(token: &str) -> bool {
    let letter = token.strip_prefix('\\').and_then(Letter::of_latex);
    letter.is_some_and(Letter::is_in_symbols)
}

/// The function in infix text that a command means.
pub(super) fn function(token: &str) -> Option<&'static str> {
    match token {
        r"\tan" => Some("tan"),
        r"\sgn" => Some(FunctionName::Sign.function().name()),
        _ => {
            let name = FunctionName::ALL.into_iter().find(|name| name.latex() == token)?;
            Some(name.function().name())
        }
    }
}

impl Token<'_> {
    pub(super) fn is_space(&self) -> bool {
        SPACES.contains(&self.text)
    }
}

/// All tokens but spaces; a line break stays.
pub(super) fn tokens(latex: &str) -> Vec<Token<'_>> {
    let mut tokens = vec![];
    let mut place = 0;
    while let Some(first) = latex.get(place..).and_then(|rest| rest.chars().next()) {
        let length = match first.is_ascii_digit() && takes_digit(&tokens) {
            true => 1,
            false => length(latex.get(place..).unwrap_or_default(), first),
        };
        let span = place..place + length;
        place = span.end;
        let token = Token { text: latex.get(span.clone()).unwrap_or_default(), span };
        if !first.is_whitespace() && !token.is_space() {
            tokens.push(token);
        }
    }
    tokens
}

/// Fractions, whose arguments may be single digits.
pub(super) const FRACTIONS: [&str; 3] = [r"\frac", r"\dfrac", r"\tfrac"];

/// Whether a digit that comes next is an argument of its own, as both are in `\frac12`.
fn takes_digit(tokens: &[Token<'_>]) -> bool {
    let fraction = |token: &Token<'_>| FRACTIONS.contains(&token.text);
    match tokens {
        [.., last] if fraction(last) => true,
        [.., command, last] => fraction(command) && last.text.len() == 1 && last.text != "{",
        _ => false,
    }
}

/// The bytes of the token that begins with `first`.
fn length(rest: &str, first: char) -> usize {
    let run = |text: &str, member: fn(&u8) -> bool| text.bytes().take_while(member).count();
    match first {
        '\\' => {
            let name = rest.get(1..).unwrap_or_default();
            match run(name, u8::is_ascii_alphabetic) {
                0 => 1 + name.chars().next().map_or(0, char::len_utf8),
                letters => 1 + letters,
            }
        }
        '0'..='9' => run(rest, |byte| byte.is_ascii_digit() || *byte == b'.'),
        _ => first.len_utf8(),
    }
}

/// The text of tokens without braces and fonts.
pub(super) fn key(tokens: &[Token<'_>]) -> String {
    let shown = tokens.iter().filter(|token| {
        !matches!(token.text, "{" | "}" | r"\left" | r"\right") && !is_font(token.text)
    });
    shown.map(|token| token.text).collect()
}
