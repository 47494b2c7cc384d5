//! LaTeX to tokens.

use std::ops::Range;

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

/// Fonts, which tell no symbols apart.
pub(super) const FONTS: [&str; 12] = [
    r"\mathrm",
    r"\mathbf",
    r"\mathit",
    r"\mathsf",
    r"\mathcal",
    r"\boldsymbol",
    r"\text",
    r"\textrm",
    r"\rm",
    r"\bm",
    r"\mathnormal",
    r"\textit",
];

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
        !matches!(token.text, "{" | "}" | r"\left" | r"\right") && !FONTS.contains(&token.text)
    });
    shown.map(|token| token.text).collect()
}
