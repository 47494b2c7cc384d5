//! Words in formulas: functions in a font, prose, and letters that look like a function or a derivative.

use std::ops::Range;

use robot_symbolic::ParseError;

use super::lexer::{is_font, is_text, operator};
use super::translate::Translator;

impl Translator<'_, '_> {
    /// Refuses `\text` with several words or signs, which is not a symbol.
    pub(super) fn refuse_prose(&mut self) -> Result<(), ParseError> {
        let (start, here) = (self.place, self.here());
        if !is_text(self.peek()) {
            return Ok(());
        }
        self.place += 1;
        let end = self.group_end(self.place);
        let tokens = self.tokens.get(self.place + 1..end.saturating_sub(1)).unwrap_or_default();
        let has_space =
            tokens.windows(2).any(|pair| matches!(pair, [a, b] if a.span.end < b.span.start));
        let has_sign = tokens.iter().any(|token| matches!(token.text, "(" | ")" | "," | "." | ":"));
        let word: String = tokens.iter().map(|token| token.text).collect();
        let has_index =
            matches!(self.tokens.get(end), Some(next) if matches!(next.text, "_" | "^"));
        let is_unknown = word.len() > 1 && !has_index && (self.names)(&word).is_none();
        let end = tokens.last().map_or(here.end, |last| last.span.end + 1);
        self.place = start;
        if !(has_space || has_sign || is_unknown && operator(&word).is_none()) {
            return Ok(());
        }
        let error = ParseError::new(here.start..end, "words are not a factor of a term");
        Err(error.help("leave them out, or put `%` and a line break before them"))
    }

    /// Consumes the name of a function that is set in a font, such as `\mathrm{sgn}`, if one follows.
    pub(super) fn upright_function(&mut self) -> Option<&'static str> {
        if !is_font(self.peek()) {
            return None;
        }
        let start = self.place;
        let word = self.capture().ok().filter(|word| (self.names)(word).is_none());
        let function = word.as_deref().and_then(operator);
        if function.is_none() {
            self.place = start;
        }
        function
    }

    /// Refuses `sin`, `cos` and `tan` without a backslash, which would be products of letters.
    pub(super) fn refuse_bare_function(&self) -> Result<(), ParseError> {
        let Some([first, second, third]) = self.tokens.get(self.place..self.place + 3) else {
            return Ok(());
        };
        let word = format!("{}{}{}", first.text, second.text, third.text);
        let is_word = first.span.end == second.span.start && second.span.end == third.span.start;
        if !(is_word && matches!(word.as_str(), "sin" | "cos" | "tan")) {
            return Ok(());
        }
        let message = format!("`{word}` is a product of letters in LaTeX");
        let error = ParseError::new(first.span.start..third.span.end, message);
        Err(error.help(format!(r"write `\{word}`")))
    }

    /// Refuses `\rm` except before one letter, because a word behind it would be a product of letters, and other fonts
    /// around numbers and signs, which would be symbols.
    pub(super) fn refuse_font(&mut self) -> Result<(), ParseError> {
        let (start, font) = (self.place, self.peek());
        if !is_font(font) {
            return Ok(());
        }
        if font == r"\rm" {
            return self.refuse_switch();
        }
        let content = self.capture();
        let end = self.before();
        let here = self.tokens.get(start).map_or(end, |token| token.span.start);
        self.place = start;
        if content.map_or(true, |text| text.chars().any(char::is_alphabetic)) {
            return Ok(());
        }
        let message = format!("`{font}` is not read around a number or a sign");
        Err(ParseError::new(here..end, message).help("leave the font out"))
    }

    fn refuse_switch(&self) -> Result<(), ParseError> {
        let rest = self.tokens.get(self.place..).unwrap_or_default();
        let Some((switch, behind)) = rest.split_first() else { return Ok(()) };
        let is_part = |text: &str| text.chars().all(char::is_alphanumeric);
        let word: Vec<_> = behind.iter().take_while(|token| is_part(token.text)).collect();
        let is_letter = |text: &str| text.chars().all(char::is_alphabetic);
        let end = match (word.as_slice(), behind) {
            ([one], _) if is_letter(one.text) => return Ok(()),
            ([], [greek, ..]) if super::lexer::is_letter(greek.text) => return Ok(()),
            ([.., last], _) => last.span.end,
            ([], _) => switch.span.end,
        };
        let word: String = word.iter().map(|token| token.text).collect();
        let message = r"`\rm` is read only before one letter";
        let error = ParseError::new(switch.span.start..end, message);
        Err(error.help(match operator(&word) {
            Some(_) => format!(r"write `\operatorname{{{word}}}`"),
            None if word.starts_with(char::is_alphabetic) => {
                format!(
                    r"write `\mathrm{{{word}}}` for one symbol, or leave `\rm` out for a product"
                )
            }
            None => "leave it out".to_owned(),
        }))
    }

    /// Refuses a fraction such as `\frac{d}{dt}`, which is not a quotient of symbols.
    pub(super) fn refuse_derivative(&mut self, fraction: &Range<usize>) -> Result<(), ParseError> {
        let start = self.place;
        let parts = self.capture().and_then(|over| Ok((over, self.capture()?)));
        let end = self.before();
        self.place = start;
        let is_derivative = parts.is_ok_and(|(over, under)| {
            over.starts_with('d') && (under == "dt" || under.starts_with("dt^"))
        });
        if !is_derivative {
            return Ok(());
        }
        let message = "derivatives are not read";
        let error = ParseError::new(fraction.start..end, message);
        Err(error
            .help(r"write `\dot q_1` and `\ddot q_1`, and carry out the derivative of a product"))
    }
}
