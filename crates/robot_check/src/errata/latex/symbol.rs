//! Symbols with their indices, and functions of angles in the short spellings `s_2`, `c_{23}`.

use std::ops::Range;

use robot_model::diagnostic::quote;
use robot_model::signs::{Letter, Use};
use robot_symbolic::ParseError;
use robot_symbolic::formula::is_reserved;

use super::lexer::{is_accent, is_font, is_letter};
use super::translate::{Translator, unknown};

/// Whether a token is a sign such as ± or ∘, which is a symbol only if the robot has a symbol of that name. The signs of
/// products are read elsewhere.
fn is_sign(token: &str) -> bool {
    let letter = token.strip_prefix('\\').and_then(Letter::of_latex);
    letter.is_some_and(|letter| {
        letter.used == Use::Symbol && !matches!(letter.character, 'ℓ' | '∗' | '·')
    })
}

/// An index of a symbol.
#[derive(Clone)]
struct Index {
    key: String,
    /// The index of its first token.
    place: usize,
    span: Range<usize>,
}

impl Translator<'_, '_> {
    /// Whether a symbol, or an angle in brackets, follows.
    pub(super) fn starts_symbol(&self) -> bool {
        let text = self.peek();
        let accented = is_font(text) || is_accent(text);
        accented || text.starts_with(|letter: char| letter.is_ascii_alphabetic()) || is_letter(text)
    }

    /// Translates a symbol with its indices, or a sine or cosine in a short spelling.
    pub(super) fn symbol(&mut self) -> Result<(), ParseError> {
        let first = self.here();
        if !(self.starts_symbol() || self.peek() == "{") {
            return Err(unknown(self.peek(), first));
        }
        let text = self.peek();
        let base = self.capture()?;
        let [lower, upper] = self.indices()?;
        let span = first.start..self.before();
        let key = match &lower {
            Some(index) => format!("{base}_{}", index.key),
            None => base.clone(),
        };
        let whole = upper.as_ref().map(|index| format!("{key}^{}", index.key));
        if let Some(name) = whole.as_ref().and_then(|whole| (self.names)(whole)) {
            self.emit(&name, span);
            return Ok(());
        }
        if is_sign(text) && (self.names)(&key).is_none() {
            return Err(unknown(text, first));
        }
        let function = match base.as_str() {
            "s" => "sin",
            "c" => "cos",
            _ => "",
        };
        let integer = upper.as_ref().is_none_or(|index| index.key.parse::<i64>().is_ok());
        if !function.is_empty() && integer && (self.names)(&key).is_none() {
            let exponent = upper.clone().map(|index| (index.key, index.span));
            match &lower {
                Some(index) => return self.of_index(function, first, index, exponent),
                None if self.starts_symbol() || matches!(self.peek(), "(" | r"\left") => {
                    return self.applied(function, first, exponent);
                }
                None => {}
            }
        }
        if let Some(index) = lower.filter(|index| is_arithmetic(&index.key))
            && (self.names)(&key).is_none()
        {
            let message =
                format!("`{}` is not the index of a symbol of the robot", quote(&index.key));
            return Err(calculated(index.span, message, "index"));
        }
        if let Some(index) = upper.as_ref().filter(|index| is_arithmetic(&index.key)) {
            let message = "expected an integer as the exponent".to_owned();
            return Err(calculated(index.span.clone(), message, "exponent"));
        }
        match upper {
            Some(index) if integer => {
                self.name(&key, span);
                self.exponent(&index.key, index.span)
            }
            _ => {
                self.name(whole.as_ref().unwrap_or(&key), span);
                Ok(())
            }
        }
    }

    /// Reads the subscript and the superscript that follow, in either order.
    fn indices(&mut self) -> Result<[Option<Index>; 2], ParseError> {
        let mut indices = [None, None];
        loop {
            let here = self.here();
            let side = match self.peek() {
                "_" => 0,
                "^" => 1,
                _ => return Ok(indices),
            };
            if indices.get(side).is_some_and(Option::is_some) {
                return self.fault("a second subscript on one symbol", "put the first in braces");
            }
            self.place += 1;
            let place = self.place;
            let key = self.capture()?;
            let index = Some(Index { key, place, span: here.start..self.before() });
            if let Some(free) = indices.get_mut(side) {
                *free = index;
            }
        }
    }

    /// Translates `s_2`, `c_{23}` or `s_{\theta}`: a function of the sum of numbered joint positions, or of an angle.
    fn of_index(
        &mut self,
        function: &str,
        first: Range<usize>,
        index: &Index,
        exponent: Option<(String, Range<usize>)>,
    ) -> Result<(), ParseError> {
        match joints(&index.key) {
            Some(angle) => {
                self.emit(function, first);
                self.emit(&format!("({angle})"), index.span.clone());
            }
            None => {
                let after = self.place;
                self.emit(function, first);
                self.place = index.place;
                self.argument()?;
                self.place = after;
            }
        }
        match exponent {
            Some((exponent, place)) => self.exponent(&exponent, place),
            None => Ok(()),
        }
    }

    /// Emits the name of a symbol, or a plain name made of its LaTeX.
    fn name(&mut self, key: &str, span: Range<usize>) {
        let name = (self.names)(key).unwrap_or_else(|| plain(key));
        self.emit(&name, span);
    }
}

/// Whether an index is a calculation, such as `1+1`, whose operators a name would lose.
fn is_arithmetic(index: &str) -> bool {
    let has_digit = index.bytes().any(|byte| byte.is_ascii_digit());
    let has_operator = index.trim_start_matches('-').contains(['+', '-', '/', '^', '(', ')']);
    let is_number_with_index =
        index.starts_with(|first: char| first.is_ascii_digit()) && index.contains('_');
    (has_digit && has_operator) || is_number_with_index
}

/// The error of an index or an exponent that is a calculation.
fn calculated(span: Range<usize>, message: String, what: &str) -> ParseError {
    let help = format!("write the {what} as one number, or the symbol as `equations` prints it");
    ParseError::new(span, message).help(help)
}

/// The angle of joint numbers: `q2+q3` for `23`, `q2-q3` for `2-3`, `q2+q10` for `2,10`.
fn joints(index: &str) -> Option<String> {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let apart = index.contains(',');
    let mut angle = String::new();
    let mut rest = index;
    while !rest.is_empty() {
        let minus = rest.starts_with('-');
        rest = rest.strip_prefix(['-', '+', ',']).unwrap_or(rest);
        let end = rest.find(['-', '+', ',']).unwrap_or(rest.len());
        let (numbers, after) = rest.split_at(end);
        if !digits(numbers) {
            return None;
        }
        let single = !apart && !numbers.contains('0');
        let count = if single { 1 } else { numbers.len() };
        for number in 0..numbers.len() / count {
            let joint = numbers.get(number * count..(number + 1) * count)?;
            angle.push(if minus && number == 0 { '-' } else { '+' });
            angle.push('q');
            angle.push_str(joint);
        }
        rest = after;
    }
    angle.strip_prefix('+').map(str::to_owned).or((!angle.is_empty()).then_some(angle))
}

/// A name made of the letters and digits of a key; signs that tell a symbol from another one are words.
fn plain(key: &str) -> String {
    if key == r"\pi" {
        return "pi".to_owned();
    }
    let words = key.replace('*', "star").replace('+', "plus").replace('-', "minus");
    let name: String = words.chars().filter(char::is_ascii_alphanumeric).collect();
    let begins = name.starts_with(|first: char| first.is_ascii_alphabetic());
    if begins && !is_reserved(&name) { name } else { format!("_{name}") }
}
