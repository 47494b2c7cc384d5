//! The lexer, which splits text into tokens.

use std::ops::Range;

use super::error::ParseError;
use crate::rational::{MAX_DIGITS, Rational};

/// The allowed form of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Names {
    /// `[A-Za-z_][A-Za-z0-9_]*`.
    Plain,
    /// Names with parts joined by dots.
    Dotted,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    Number(Rational),
    Name,
    /// One of `+ - * / ^ ( )`.
    Symbol(u8),
    End,
}

pub(super) struct Lexer<'t> {
    text: &'t str,
    position: usize,
    names: Names,
}

pub(super) const fn starts_name(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

pub(super) const fn continues_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

impl<'t> Lexer<'t> {
    pub(super) fn new(text: &'t str, names: Names) -> Lexer<'t> {
        Lexer { text, position: 0, names }
    }

    /// Returns the next token and its bytes; at the end of the text [`Token::End`] with an empty range.
    pub(super) fn next(&mut self) -> Result<(Token, Range<usize>), ParseError> {
        self.skip(|byte| byte.is_ascii_whitespace());
        let start = self.position;
        let token = match self.byte(start) {
            None => Token::End,
            Some(b'*') if self.byte(start + 1) == Some(b'*') => {
                return Err(ParseError::new(start..start + 2, "`**` is not an operator")
                    .help("write a power as `x^2`"));
            }
            Some(byte @ (b'+' | b'-' | b'*' | b'/' | b'^' | b'(' | b')')) => {
                self.position += 1;
                Token::Symbol(byte)
            }
            Some(byte) if starts_name(byte) => self.name(start)?,
            Some(byte) if byte.is_ascii_digit() || byte == b'.' => self.number(start)?,
            Some(_) => return Err(self.unknown_character(start)),
        };
        Ok((token, start..self.position))
    }

    fn byte(&self, position: usize) -> Option<u8> {
        self.text.as_bytes().get(position).copied()
    }

    fn skip(&mut self, member: impl Fn(u8) -> bool) {
        while self.byte(self.position).is_some_and(&member) {
            self.position += 1;
        }
    }

    fn name(&mut self, start: usize) -> Result<Token, ParseError> {
        self.skip(continues_name);
        while self.byte(self.position) == Some(b'.') {
            let part = self.byte(self.position + 1).is_some_and(starts_name);
            if self.names == Names::Plain || !part {
                let span = start..self.position + 1;
                return Err(ParseError::new(span, "names cannot contain a dot")
                    .help("names are letters, digits and `_`, such as `l_5`"));
            }
            self.position += 1;
            self.skip(continues_name);
        }
        Ok(Token::Name)
    }

    fn number(&mut self, start: usize) -> Result<Token, ParseError> {
        self.skip(|byte| byte.is_ascii_digit() || byte == b'.' || byte == b'_');
        let exponent = self.exponent();
        let span = start..self.position;
        let text = self.text.get(span.clone()).unwrap_or_default();
        let separated = text.contains('_');
        let value = Rational::from_decimal(text).filter(|_| !separated);
        match value {
            // A number without an exponent is limited by its digits alone, so long integers are exact.
            Some(value) if !exponent || in_range(&value) => Ok(Token::Number(value)),
            None if separated => Err(ParseError::new(span, "numbers cannot contain `_`")
                .help(format!("write `{}`", text.replace('_', "")))),
            None if text.matches('.').count() > 1 || text == "." => {
                Err(ParseError::new(span, format!("`{text}` is not a number"))
                    .help("write a decimal number with one point, such as `0.35`"))
            }
            None if text.bytes().filter(u8::is_ascii_digit).count() > MAX_DIGITS => {
                Err(ParseError::new(span, "the number has too many digits")
                    .help(format!("write at most {MAX_DIGITS} digits")))
            }
            _ => {
                let message = "the number is outside the range of floating-point numbers";
                Err(ParseError::new(span, message)
                    .help("write 0 or a magnitude from 5e-324 to 1.79e308"))
            }
        }
    }

    /// Consumes an exponent such as `e12` or `E-3` and returns whether there is one; without digits, the letter begins
    /// a name.
    fn exponent(&mut self) -> bool {
        let mut end = self.position;
        if !matches!(self.byte(end), Some(b'e' | b'E')) {
            return false;
        }
        end += 1;
        if matches!(self.byte(end), Some(b'+' | b'-')) {
            end += 1;
        }
        let digits = self.byte(end).is_some_and(|byte| byte.is_ascii_digit());
        if digits {
            self.position = end;
            self.skip(|byte| byte.is_ascii_digit());
        }
        digits
    }

    /// The error for a character that cannot occur in a formula.
    fn unknown_character(&self, start: usize) -> ParseError {
        let rest = self.text.get(start..).unwrap_or_default();
        let character = rest.chars().next().unwrap_or_default();
        let span = start..start + character.len_utf8();
        let digit = |position: Option<usize>| {
            position
                .and_then(|position| self.byte(position))
                .is_some_and(|byte| byte.is_ascii_digit())
        };
        let around = digit(start.checked_sub(1)) && digit(Some(start + 1));
        let (message, help) = match character {
            ',' if around => (
                "use a decimal point".to_owned(),
                "write `1.5` instead of \
                `1,5`",
            ),
            ',' => (
                "`,` has no meaning in an expression".to_owned(),
                "every function takes one argument; a value is one expression",
            ),
            '·' | '×' | '∗' | '⋅' => (unknown(character), "write a product as `a*b`"),
            '÷' | '∕' => (unknown(character), "write a quotient as `a/b`"),
            '−' | '–' | '—' => {
                (unknown(character), "use the minus sign of the keyboard, `-`")
            }
            'π' => (unknown(character), "write `pi`"),
            '°' => (unknown(character), "write an angle of 30 degrees as `30*pi/180`"),
            '²' | '³' => (unknown(character), "write a power as `x^2`"),
            '√' => (unknown(character), "write a root as `sqrt(x)`"),
            '[' | ']' | '{' | '}' => (unknown(character), "use parentheses, `(` and `)`"),
            ';' => (unknown(character), "an expression is one value; give several one by one"),
            '=' | '<' | '>' | '!' => {
                (unknown(character), "an expression is a value, not a relation")
            }
            _ => (
                unknown(character),
                "names are ASCII letters, digits and `_`; the operators are + - * / ^ ( )",
            ),
        };
        ParseError::new(span, message).help(help)
    }
}

/// A character in a message: `\\` and quotes as they are, control characters escaped.
fn shown(character: char) -> String {
    match character {
        '\\' | '"' | '\'' => character.to_string(),
        _ => character.escape_debug().collect(),
    }
}

fn unknown(character: char) -> String {
    format!("`{}` has no meaning in an expression", shown(character))
}

/// Whether the nearest `f64` is finite, and is 0 only for the number 0.
fn in_range(value: &Rational) -> bool {
    let float = value.to_f64();
    float.is_finite() && (float != 0.0 || value.is_zero())
}
