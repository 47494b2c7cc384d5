//! The reader that turns LaTeX into layouts; it accepts the part of LaTeX that this project prints.

use robot_model::signs::{Accent, Font, FunctionName, Letter};

use crate::math::{Fence, Line, Math, Script};

/// The deepest nesting of groups; deeper nesting is an error.
const MAX_DEPTH: usize = 200;

/// The error for LaTeX that this project does not print.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at byte {place}: {message}")]
pub struct ReadError {
    /// The position of the error in the text, in bytes.
    pub place: usize,
    /// The problem.
    pub message: &'static str,
}

/// Reads a formula from LaTeX for math mode, in which parentheses are fences.
///
/// # Errors
///
/// The first place that is not in the part of LaTeX that this project prints.
pub fn read(latex: &str) -> Result<Math, ReadError> {
    Reader { latex, place: 0, depth: 0, fences: true }.whole()
}

/// Reads the LaTeX of a symbol, in which parentheses are plain signs.
pub(crate) fn read_symbol(latex: &str) -> Result<Math, ReadError> {
    Reader { latex, place: 0, depth: 0, fences: false }.whole()
}

struct Reader<'t> {
    latex: &'t str,
    place: usize,
    depth: usize,
    fences: bool,
}

/// What ends a row.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Text,
    Brace,
    Parenthesis,
    Right(char),
    /// The end of an entry of a matrix or of a line.
    Entry,
}

impl<'t> Reader<'t> {
    fn whole(mut self) -> Result<Math, ReadError> {
        self.row(End::Text)
    }

    fn fault<T>(&self, message: &'static str) -> Result<T, ReadError> {
        Err(ReadError { place: self.place, message })
    }

    fn rest(&self) -> &'t str {
        self.latex.get(self.place..).unwrap_or_default()
    }

    fn take(&mut self, expected: &str) -> bool {
        let found = self.rest().starts_with(expected);
        self.place += if found { expected.len() } else { 0 };
        found
    }

    fn skip_space(&mut self, end: End) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start();
            self.place += rest.len() - trimmed.len();
            let space = [r"\,", r"\;", r"\ ", r"\quad", "{}", r"\bigl", r"\bigr", "&"]
                .iter()
                .filter(|space| end != End::Entry || **space != "&")
                .any(|space| self.take(space));
            if !space {
                return;
            }
        }
    }

    fn row(&mut self, end: End) -> Result<Math, ReadError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return self.fault("groups are nested too deeply");
        }
        let mut pieces = vec![];
        loop {
            self.skip_space(end);
            if self.ends(end)? {
                break;
            }
            let piece = self.piece()?;
            pieces.push(self.indexed(piece)?);
        }
        self.depth -= 1;
        Ok(Math::row(pieces))
    }

    fn ends(&mut self, end: End) -> Result<bool, ReadError> {
        let ended = match end {
            End::Text => self.rest().is_empty(),
            End::Brace => self.take("}"),
            End::Parenthesis => self.take(")"),
            End::Entry => ["&", r"\\", r"\end{"].iter().any(|end| self.rest().starts_with(end)),
            End::Right(fence) => {
                let closed = self.take(r"\right");
                if closed && !self.take(fence.encode_utf8(&mut [0; 4])) {
                    return self.fault("another fence was opened");
                }
                closed
            }
        };
        if !ended && self.rest().is_empty() {
            return self.fault("a group is never closed");
        }
        Ok(ended)
    }

    /// Reads a piece without its indices.
    fn piece(&mut self) -> Result<Math, ReadError> {
        let Some(first) = self.rest().chars().next() else {
            return self.fault("something is missing");
        };
        self.place += first.len_utf8();
        match first {
            '\\' => self.command(),
            '{' => self.row(End::Brace),
            '(' if self.fences => {
                Ok(Math::Fenced(Fence::Parentheses, Box::new(self.row(End::Parenthesis)?)))
            }
            '0'..='9' => {
                let start = self.place - 1;
                let is_digit = |c: char| c.is_ascii_digit() || (self.fences && c == '.');
                let tail = self.rest();
                self.place += tail.len() - tail.trim_start_matches(is_digit).len();
                Ok(Math::Number(self.latex.get(start..self.place).unwrap_or_default().to_owned()))
            }
            'a'..='z' | 'A'..='Z' => Ok(Math::Letter(first)),
            '+' | '-' | '=' | ',' | '.' | ':' | ';' | '/' | '*' | '(' | ')' => {
                Ok(Math::Sign(first))
            }
            _ => {
                self.place -= first.len_utf8();
                self.fault("not a sign of a formula")
            }
        }
    }

    fn command(&mut self) -> Result<Math, ReadError> {
        for name in FunctionName::ALL {
            let latex = name.latex().trim_start_matches('\\');
            let after = self.rest().strip_prefix(latex);
            if after.is_some_and(|after| !after.starts_with(|c: char| c.is_ascii_alphabetic())) {
                self.place += latex.len();
                return Ok(Math::Function(name));
            }
        }
        let rest = self.rest();
        let length = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        let command = rest.get(..length).unwrap_or_default();
        self.place += length;
        match command {
            "frac" => Ok(Math::Fraction(Box::new([self.argument()?, self.argument()?]))),
            "sqrt" => Ok(Math::Root(Box::new(self.argument()?))),
            "left" => self.fenced(),
            "cdot" => Ok(Math::Sign('·')),
            "times" => Ok(Math::Sign('×')),
            "begin" if self.take("{bmatrix}") => Ok(Math::Matrix(self.entries("bmatrix")?)),
            "begin" if self.take("{array}[b]{@{}l@{}}") => self.lines(),
            "" => match self.rest().chars().next() {
                Some(sign @ ('#' | '$' | '%' | '&' | '{' | '}' | '_')) => {
                    self.place += 1;
                    Ok(Math::Word(sign.to_string()))
                }
                _ => self.fault("not a sign of a formula"),
            },
            _ => self.named(command),
        }
    }

    /// Reads the rest of a command for a character, an accent or a font.
    fn named(&mut self, command: &str) -> Result<Math, ReadError> {
        if let Some(letter) = Letter::of_latex(command) {
            return Ok(Math::Letter(letter.character));
        }
        if let Some(accent) = Accent::of_latex(command) {
            return Ok(Math::Accent(accent, Box::new(self.argument()?)));
        }
        match Font::of_latex(command) {
            Some(Font::Upright) => Ok(upright(self.argument()?)),
            Some(font) => Ok(Math::Styled(font, Box::new(self.argument()?))),
            None => self.fault("an unknown command"),
        }
    }

    fn fenced(&mut self) -> Result<Math, ReadError> {
        if self.take("(") {
            let inside = self.row(End::Right(')'))?;
            return Ok(Math::Fenced(Fence::Parentheses, Box::new(inside)));
        }
        if self.take("|") {
            return Ok(Math::Fenced(Fence::Bars, Box::new(self.row(End::Right('|'))?)));
        }
        if self.take(r"[\begin{array}{@{}l@{}}") {
            let column = Math::Matrix(self.entries("array")?);
            return if self.take(r"\right]") { Ok(column) } else { self.fault("no right bracket") };
        }
        if self.take("[") {
            return Ok(Math::Fenced(Fence::Brackets, Box::new(self.row(End::Right(']'))?)));
        }
        self.fault("an unknown fence")
    }

    /// Reads the rows of entries up to the end of an environment.
    fn entries(&mut self, environment: &str) -> Result<Vec<Vec<Math>>, ReadError> {
        let mut rows = vec![vec![]];
        loop {
            let entry = self.row(End::Entry)?;
            if let Some(row) = rows.last_mut() {
                row.push(entry);
            }
            if self.take("&") {
                continue;
            }
            if self.take(r"\\") {
                let _ = self.take("[6pt]") || self.take("[2pt]");
                rows.push(vec![]);
                continue;
            }
            return match self.take(&format!(r"\end{{{environment}}}")) {
                true => Ok(rows),
                false => self.fault("another environment was opened"),
            };
        }
    }

    /// Reads the lines of a sum as one line, because a parenthesis can open in one line and close in another.
    fn lines(&mut self) -> Result<Math, ReadError> {
        let end = r"\end{array}";
        let Some((lines, _)) = self.rest().split_once(end) else {
            return self.fault("an environment is never closed");
        };
        let sum = Reader { latex: &lines.replace(r"\\", " "), place: 0, ..*self }.whole()?;
        self.place += lines.len() + end.len();
        Ok(Math::Lines(vec![Line { math: sum, indent: 0 }]))
    }

    /// Reads an argument: a group, or a single piece.
    fn argument(&mut self) -> Result<Math, ReadError> {
        self.skip_space(End::Text);
        if self.take("{") {
            return self.row(End::Brace);
        }
        // Without braces, only one digit is the argument.
        if let Some(digit) = self.rest().chars().next().filter(char::is_ascii_digit) {
            self.place += 1;
            return Ok(Math::Number(digit.to_string()));
        }
        self.piece()
    }

    fn indexed(&mut self, base: Math) -> Result<Math, ReadError> {
        let (mut lower, mut upper) = (None, None);
        loop {
            self.place += self.rest().len() - self.rest().trim_start().len();
            if self.take("_") && lower.is_none() {
                lower = Some(self.argument()?);
            } else if self.take("^") && upper.is_none() {
                upper = Some(self.argument()?);
            } else if self.rest().starts_with('\'') && upper.is_none() {
                let count = self.rest().bytes().take_while(|byte| *byte == b'\'').count();
                self.place += count;
                upper = Some(Math::row(vec![Math::Letter('′'); count]));
            } else {
                break;
            }
        }
        Ok(match (&lower, &upper) {
            (None, None) => base,
            _ => Math::Script(Box::new(Script { base, lower, upper })),
        })
    }
}

/// Makes a word of upright letters.
fn upright(inside: Math) -> Math {
    let word: Option<String> = inside
        .pieces()
        .iter()
        .map(|piece| match piece {
            Math::Letter(letter) if letter.is_ascii() => Some(letter.to_string()),
            Math::Number(digits) => Some(digits.clone()),
            Math::Word(word) => Some(word.clone()),
            Math::Sign(sign) => Some(sign.to_string()),
            _ => None,
        })
        .collect();
    match word {
        Some(word) => Math::Word(word),
        None => Math::Styled(Font::Upright, Box::new(inside)),
    }
}
