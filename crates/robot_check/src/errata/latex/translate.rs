//! Translates tokens to infix text by recursive descent; groups may be nested at most [`MAX_DEPTH`] deep.

use std::num::IntErrorKind;
use std::ops::Range;

use robot_model::diagnostic::quote;
use robot_symbolic::ParseError;
use robot_symbolic::formula::{MAX_DEPTH, MAX_EXPONENT, MAX_TOKENS};

use super::lexer::{self, FRACTIONS, Token, is_accent, is_font};
use super::{Infix, Names};

/// The commands for sizes of brackets.
const SIZES: [&str; 14] = [
    r"\left", r"\right", r"\big", r"\Big", r"\bigg", r"\Bigg", r"\bigl", r"\Bigl", r"\biggl",
    r"\Biggl", r"\bigr", r"\Bigr", r"\biggr", r"\Biggr",
];

/// Opening brackets, with the brackets that close them.
const BRACKETS: [(&str, &str); 4] =
    [("(", ")"), ("[", "]"), (r"\{", r"\}"), (r"\lvert", r"\rvert")];

/// Translates LaTeX to infix text.
pub(super) fn translate(latex: &str, names: &Names<'_>) -> Result<Infix, ParseError> {
    let tokens = lexer::tokens(latex);
    if tokens.len() > MAX_TOKENS {
        let message = format!("the formula has more than {MAX_TOKENS} tokens");
        return Err(
            ParseError::new(0..latex.len(), message).help("take common factors out of its sums")
        );
    }
    let infix = Infix { text: String::new(), pieces: vec![], end: latex.len() };
    let mut translator = Translator { tokens: &tokens, place: 0, depth: 0, names, infix };
    translator.sum(None)?;
    Ok(translator.infix)
}

/// The LaTeX that is being read, and the text that has been written so far.
pub(super) struct Translator<'t, 'n> {
    pub(super) tokens: &'t [Token<'t>],
    pub(super) place: usize,
    depth: usize,
    pub(super) names: &'n Names<'n>,
    infix: Infix,
}

impl<'t> Translator<'t, '_> {
    pub(super) fn peek(&self) -> &'t str {
        self.tokens.get(self.place).map_or("", |token| token.text)
    }

    /// The bytes of the current token; empty at the end.
    pub(super) fn here(&self) -> Range<usize> {
        let end = self.infix.end;
        self.tokens.get(self.place).map_or(end..end, |token| token.span.clone())
    }

    fn take(&mut self, text: &str) -> bool {
        let found = self.peek() == text;
        self.place += usize::from(found);
        found
    }

    pub(super) fn emit(&mut self, text: &str, source: Range<usize>) {
        self.infix.pieces.push((self.infix.text.len(), source));
        self.infix.text.push_str(text);
    }

    pub(super) fn fault<T>(&self, message: impl Into<String>, help: &str) -> Result<T, ParseError> {
        Err(ParseError::new(self.here(), message).help(help))
    }

    fn deeper(&mut self) -> Result<(), ParseError> {
        self.depth += 1;
        match self.depth > MAX_DEPTH {
            true => self.fault(
                format!("the formula is nested deeper than {MAX_DEPTH} levels"),
                "introduce names for the inner parts",
            ),
            false => Ok(()),
        }
    }

    /// Translates a sum up to the token `close`, which is consumed, or up to the end if `close` is `None`.
    fn sum(&mut self, close: Option<&str>) -> Result<(), ParseError> {
        self.deeper()?;
        let open = self.here();
        let (mut after_operand, mut divided) = (false, false);
        // The plus or minus sign before a line break, which may be repeated after it.
        let mut broken = None;
        loop {
            let (text, here) = (self.peek(), self.here());
            if self.closes(close) {
                break;
            }
            match text {
                "" => {
                    return Err(
                        ParseError::new(open, "a bracket or group is not closed").help("close it")
                    );
                }
                r"\\" => {
                    let last = self.infix.text.chars().next_back();
                    broken = last.filter(|sign| matches!(sign, '+' | '-'));
                    self.place += 1;
                    continue;
                }
                "+" | "-" | "*" | "/" | r"\cdot" | r"\times" | r"\ast" => {
                    self.place += 1;
                    let repeated = broken.take().is_some_and(|sign| text.starts_with(sign));
                    // A leading plus sign has no effect.
                    let needed = text != "+" || after_operand;
                    if needed && !repeated {
                        self.emit(if text.len() > 1 { "*" } else { text }, here);
                    }
                    (after_operand, divided) = (false, text == "/");
                    continue;
                }
                "{" if self.tokens.get(self.place + 1).is_some_and(|next| next.text == "}") => {
                    self.place += 2;
                    continue;
                }
                _ => {}
            }
            if after_operand {
                if divided {
                    return self.fault(
                        "a factor without a sign follows a divisor",
                        r"write `\frac{a}{b} c` or `\frac{a}{b c}`: readers take `a/b c` for either",
                    );
                }
                self.separate_digits()?;
                self.emit("*", here.start..here.start);
            }
            self.operand()?;
            after_operand = true;
            broken = None;
        }
        self.depth -= 1;
        Ok(())
    }

    /// Refuses a number after a number, as in `1\,000`, which is not the product of the two.
    fn separate_digits(&self) -> Result<(), ParseError> {
        let before = self.infix.text.rsplit(|sign: char| "+-*/(".contains(sign)).next();
        let is_digit = |byte: u8| byte.is_ascii_digit() || byte == b'.';
        let is_number = before.is_some_and(|text| !text.is_empty() && text.bytes().all(is_digit));
        if is_number && first_digit(self.peek()).is_some() {
            return self.fault(
                "a number follows a number",
                r"write 1\,000 as 1000, and a product of numbers with `\cdot`",
            );
        }
        Ok(())
    }

    /// Consumes the token that closes a sum, including its size command.
    fn closes(&mut self, close: Option<&str>) -> bool {
        let Some(close) = close else {
            return self.peek().is_empty();
        };
        let sized = SIZES.contains(&self.peek())
            && self.tokens.get(self.place + 1).is_some_and(|next| next.text == close);
        self.place += usize::from(sized);
        self.take(close)
    }

    fn operand(&mut self) -> Result<(), ParseError> {
        let sized = SIZES.contains(&self.peek());
        while SIZES.contains(&self.peek()) {
            self.place += 1;
        }
        let (text, here) = (self.peek(), self.here());
        if sized && text == "|" {
            return self.bracket("abs(", "|");
        }
        if first_digit(text).is_some() {
            self.place += 1;
            self.emit(text, here);
            return self.power();
        }
        if let Some((_, close)) = BRACKETS.iter().find(|(open, _)| *open == text) {
            return self.bracket(if text == r"\lvert" { "abs(" } else { "(" }, close);
        }
        if let Some(name) = lexer::function(text) {
            self.place += 1;
            return self.function(name, here);
        }
        match text {
            "{" => self.group(),
            _ if FRACTIONS.contains(&text) => self.fraction(),
            r"\sqrt" => {
                self.place += 1;
                if self.peek() == "[" {
                    return self.fault(
                        "a root with an index is not supported",
                        r"write a square root as `\sqrt{x}`",
                    );
                }
                self.emit("sqrt", here);
                self.argument()?;
                self.power()
            }
            r"\operatorname" | r"\mathop" => {
                self.place += 1;
                match lexer::operator(&self.capture()?) {
                    Some(name) => self.function(name, here),
                    None => Err(unknown(text, here)),
                }
            }
            _ => {
                self.refuse_prose()?;
                self.refuse_bare_function()?;
                self.refuse_font()?;
                match self.upright_function() {
                    Some(name) => self.function(name, here),
                    None => self.symbol(),
                }
            }
        }
    }

    /// Translates a sum in brackets, of which the opening one is the current token, and its power.
    fn bracket(&mut self, open: &str, close: &str) -> Result<(), ParseError> {
        let here = self.here();
        self.place += 1;
        self.emit(open, here);
        self.sum(Some(close))?;
        self.closed();
        self.power()
    }

    /// Emits `)`, with the preceding token as its source.
    fn closed(&mut self) {
        let before = self.tokens.get(self.place.saturating_sub(1));
        let source = before.map_or(0..0, |token| token.span.clone());
        self.emit(")", source);
    }

    /// Translates a group, which acts as an invisible bracket, or as the base of a symbol with an index.
    fn group(&mut self) -> Result<(), ParseError> {
        let end = self.group_end(self.place);
        if self.tokens.get(end).is_some_and(|next| next.text == "_") {
            return self.symbol();
        }
        self.bracket("(", "}")
    }

    /// The index of the token after a group.
    pub(super) fn group_end(&self, start: usize) -> usize {
        let mut open = 0_usize;
        for (place, token) in self.tokens.iter().enumerate().skip(start) {
            match token.text {
                "{" => open += 1,
                "}" => open = open.saturating_sub(1),
                _ => {}
            }
            if open == 0 {
                return place + 1;
            }
        }
        self.tokens.len()
    }

    /// Translates the argument of a command to a sum in brackets; it is a group or a single token.
    pub(super) fn argument(&mut self) -> Result<(), ParseError> {
        let here = self.here();
        self.deeper()?;
        self.emit("(", here.clone());
        if self.take("{") {
            self.sum(Some("}"))?;
        } else if let Some(digit) = first_digit(self.peek()) {
            self.emit(digit, here);
            self.place += 1;
        } else {
            self.operand()?;
        }
        self.closed();
        self.depth -= 1;
        Ok(())
    }

    fn fraction(&mut self) -> Result<(), ParseError> {
        let here = self.here();
        self.place += 1;
        self.refuse_derivative(&here)?;
        self.emit("(", here.clone());
        self.argument()?;
        self.emit("/", here);
        self.argument()?;
        self.closed();
        self.power()
    }

    /// Translates a power such as `^2`, if one follows.
    fn power(&mut self) -> Result<(), ParseError> {
        let here = self.here();
        if !self.take("^") {
            return Ok(());
        }
        let exponent = self.capture()?;
        self.exponent(&exponent, here)?;
        match self.peek() {
            "^" => self.fault("a second power", "put the first one in parentheses"),
            _ => Ok(()),
        }
    }

    pub(super) fn exponent(
        &mut self,
        exponent: &str,
        start: Range<usize>,
    ) -> Result<(), ParseError> {
        let span = start.start..self.before().max(start.end);
        match exponent.parse::<i64>() {
            Ok(value) if value < 0 => self.emit(&format!("^({value})"), span),
            Ok(value) => self.emit(&format!("^{value}"), span),
            Err(error)
                if matches!(
                    error.kind(),
                    IntErrorKind::PosOverflow | IntErrorKind::NegOverflow
                ) =>
            {
                let message = format!("the exponent is beyond ±{MAX_EXPONENT}");
                return Err(
                    ParseError::new(span, message).help("write the power as a product of powers")
                );
            }
            Err(_) => {
                let message = "expected an integer as the exponent";
                return Err(ParseError::new(span, message).help(r"write a root as `\sqrt{x}`"));
            }
        }
        Ok(())
    }

    /// The end of the preceding token.
    pub(super) fn before(&self) -> usize {
        let before = self.place.checked_sub(1).and_then(|place| self.tokens.get(place));
        before.map_or(0, |token| token.span.end)
    }

    /// The key of a group, or of a single letter, digit or command.
    pub(super) fn capture(&mut self) -> Result<String, ParseError> {
        let start = self.place;
        match self.peek() {
            "{" => {
                self.place = self.group_end(start);
                let tokens = self.tokens.get(start..self.place).unwrap_or_default();
                match tokens.last() {
                    Some(last) if last.text == "}" => Ok(lexer::key(tokens)),
                    _ => {
                        self.place = start;
                        self.fault("this group is not closed", "add `}`")
                    }
                }
            }
            "" | "}" | "_" | "^" | r"\\" => self.fault(
                "expected a group in braces, a letter, a digit or a command",
                "a subscript, a power, an accent, a font or `\\operatorname` needs an argument",
            ),
            text if is_font(text) || is_accent(text) => {
                self.place += 1;
                self.deeper()?;
                let inside = self.capture()?;
                self.depth -= 1;
                Ok(if is_font(text) { inside } else { format!("{text}{inside}") })
            }
            // Without braces, only one digit is the argument; more digits are a mistake, because LaTeX prints them
            // differently.
            text => match first_digit(text) {
                Some(_) if text.len() > 1 => self.fault(
                    format!("`{text}` without braces: LaTeX takes only its first digit"),
                    &format!("write `{{{text}}}`"),
                ),
                _ => {
                    self.place += 1;
                    Ok(text.to_owned())
                }
            },
        }
    }

    /// Translates a function given by its command: an optional power, then the argument.
    fn function(&mut self, name: &str, start: Range<usize>) -> Result<(), ParseError> {
        let here = self.here();
        let exponent = if self.take("^") { Some((self.capture()?, here)) } else { None };
        if let Some((exponent, place)) = exponent.as_ref().filter(|(text, _)| text.starts_with('-'))
        {
            let message =
                format!(r"`\{name}^{{{}}}`: the inverse function or a quotient?", quote(exponent));
            let help =
                format!(r"write `\frac{{1}}{{\{name} x}}`; inverse functions are not supported");
            return Err(ParseError::new(place.start..self.before(), message).help(help));
        }
        self.applied(name, start, exponent)
    }

    /// Translates the application of a function to what follows: a bracket, or a symbol with an optional number before
    /// it.
    pub(super) fn applied(
        &mut self,
        name: &str,
        start: Range<usize>,
        exponent: Option<(String, Range<usize>)>,
    ) -> Result<(), ParseError> {
        let here = self.here();
        self.emit(name, start);
        self.emit("(", here.clone());
        self.deeper()?;
        let number = first_digit(self.peek()).is_some();
        let is_fraction = FRACTIONS.contains(&self.peek());
        self.operand()?;
        if is_fraction && self.starts_symbol() {
            return self.fault(
                "a symbol follows the fraction in the argument of a function",
                r"put the argument in parentheses: `\sin(\frac{1}{2} x)`",
            );
        }
        if number && self.starts_symbol() {
            self.emit("*", here.clone());
            self.operand()?;
        }
        self.depth -= 1;
        let last = self.infix.pieces.last().and_then(|(place, _)| self.infix.text.get(*place..));
        if last.is_some_and(|piece| piece.starts_with('^')) {
            let message = "a power of the function or of its argument?";
            let help = format!(r"write `\{name}^{{2}} x` or `\{name}({{x^{{2}}}})`");
            return Err(ParseError::new(here.start..self.before(), message).help(help));
        }
        self.closed();
        match exponent {
            Some((exponent, place)) => self.exponent(&exponent, place),
            None => Ok(()),
        }
    }
}

fn first_digit(text: &str) -> Option<&str> {
    text.get(..1).filter(|first| first.as_bytes().iter().all(u8::is_ascii_digit))
}

pub(super) fn unknown(text: &str, span: Range<usize>) -> ParseError {
    let shown: String = text.chars().take(24).collect();
    let shown = quote(&shown);
    let message = match text {
        "" => "the formula is incomplete".to_owned(),
        _ => format!("`{shown}` is not supported here"),
    };
    if text == "=" {
        return ParseError::new(span, message)
            .help("leave one right side: a chain `Q1 = a = b` is not read");
    }
    if text == r"\begin" {
        let help = "write the terms without this environment; alternatives are not compared";
        return ParseError::new(span, message).help(help);
    }
    ParseError::new(span, message).help(match text.starts_with(',') {
        true => {
            "write decimals with a point, and write out what a function such as h(q, \\dot q) stands for: equations of \
             matrices and vectors are not compared"
        }
        false => {
            "write symbols, numbers, + - * /, \\cdot, \\frac, \\sqrt, \\sin, \\cos, parentheses, subscripts and powers"
        }
    })
}
