//! Splits LaTeX into tokens.

use std::ops::Range;

use robot_model::signs::{Accent, Font, FunctionName, Letter};

/// A token, without the spaces around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    /// The text of the token, such as `\frac`, `q`, `1.5`, `{` or `+`.
    pub(super) text: &'t str,
    /// The bytes of the token.
    pub(super) span: Range<usize>,
}

/// Commands that only print space, and alignment marks.
const SPACES: [&str; 19] = [
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
    r"\IEEEnonumber",
    r"\IEEEyesnumber",
    r"\displaystyle",
    r"\limits",
    r"\hfill",
    r"\allowbreak",
    r"\noindent",
];

/// Fonts that occur in papers but not in the formulas of this project.
const OTHER_FONTS: [&str; 6] = ["text", "textrm", "rm", "bm", "mathnormal", "textit"];

/// Accents that occur in papers but not in the formulas of this project.
const OTHER_ACCENTS: [&str; 2] = ["dddot", "overrightarrow"];

/// Whether a token sets the font of the next part; fonts do not distinguish symbols.
pub(super) fn is_font(token: &str) -> bool {
    let known = |command| Font::of_latex(command).is_some() || OTHER_FONTS.contains(&command);
    token.strip_prefix('\\').is_some_and(known)
}

/// Whether a token begins text, which may be several words.
pub(super) fn is_text(token: &str) -> bool {
    matches!(token, r"\text" | r"\textrm" | r"\textit")
}

/// Whether a token puts an accent on a letter; the accent is part of the symbol.
pub(super) fn is_accent(token: &str) -> bool {
    let known = |command| Accent::of_latex(command).is_some() || OTHER_ACCENTS.contains(&command);
    token.strip_prefix('\\').is_some_and(known)
}

/// Whether a token is the command of a Greek letter or of another character that symbols may contain.
pub(super) fn is_letter(token: &str) -> bool {
    let letter = token.strip_prefix('\\').and_then(Letter::of_latex);
    letter.is_some_and(Letter::is_in_symbols)
}

/// The name in infix text of the function that a command denotes, such as `\sin`.
pub(super) fn function(token: &str) -> Option<&'static str> {
    token.strip_prefix('\\').filter(|word| *word != "sign").and_then(operator)
}

/// The name in infix text of the function that is written as a word, as in `\operatorname{sgn}`.
pub(super) fn operator(word: &str) -> Option<&'static str> {
    match word {
        "tan" => Some("tan"),
        "sign" => Some(FunctionName::Sign.function().name()),
        _ => {
            let name = FunctionName::ALL.into_iter().find(|name| name.text() == word)?;
            Some(name.function().name())
        }
    }
}

impl Token<'_> {
    pub(super) fn is_space(&self) -> bool {
        SPACES.contains(&self.text)
    }
}

/// All tokens except spaces; line breaks are kept.
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

/// The commands of fractions, whose arguments may be single digits.
pub(super) const FRACTIONS: [&str; 3] = [r"\frac", r"\dfrac", r"\tfrac"];

/// Whether the next digit is an argument by itself, like both digits in `\frac12`.
fn takes_digit(tokens: &[Token<'_>]) -> bool {
    let fraction = |token: &Token<'_>| FRACTIONS.contains(&token.text);
    match tokens {
        [.., last] if fraction(last) => true,
        [.., command, last] => fraction(command) && last.text.len() == 1 && last.text != "{",
        _ => false,
    }
}

/// The number of bytes of the token that begins with `first`.
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

/// The text of the tokens without braces and fonts.
pub(super) fn key(tokens: &[Token<'_>]) -> String {
    let shown = tokens.iter().filter(|token| {
        !matches!(token.text, "{" | "}" | r"\left" | r"\right") && !is_font(token.text)
    });
    shown.map(|token| token.text).collect()
}
