//! The check of LaTeX that is given for names. It accepts a small grammar, so that accepted text can only print a
//! symbol.
//!
//! All such LaTeX passes this check: in robot files when they are read, and in robots that were built in code when they
//! are printed.

use std::ops::Range;

use super::{Accent, Font, Letter};

/// The error for LaTeX that may do more than print a symbol.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct LatexError {
    /// The offending bytes.
    pub span: Range<usize>,
    /// The problem.
    pub message: &'static str,
}

const MAX_LENGTH: usize = 64;
const MAX_DEPTH: usize = 8;

/// The state of the grammar within one group.
#[derive(Clone, Copy, Default)]
struct Group {
    start: usize,
    /// Whether the group already contains an item to which an index can be attached.
    base: bool,
    lower: bool,
    upper: bool,
    /// Whether this is an index or within one, where digits and signs are read as a name.
    is_index: bool,
    /// Whether this is the argument of an accent or a font or within one, where several letters are read as a name.
    is_word: bool,
    /// Whether the letters are calligraphic; LaTeX has only capital ones, and prints other signs for small letters.
    is_calligraphic: bool,
}

impl Group {
    /// A group of the same kind, within this one.
    fn nested(self) -> Group {
        let Group { is_index, is_word, is_calligraphic, .. } = self;
        Group { is_index, is_word, is_calligraphic, ..Group::default() }
    }

    /// This group as the argument of an accent or a font.
    fn argument(self, command: &str) -> Group {
        let is_calligraphic =
            self.is_calligraphic || Font::of_latex(command) == Some(Font::Calligraphic);
        Group { is_word: true, is_calligraphic, ..self }
    }
}

/// Checks that LaTeX given for a name only prints a symbol.
///
/// The grammar is `item*`. An item is a letter, a digit, one of `* + - , . ( )`, a Greek letter or another symbol, a
/// group `{…}`, or an accent or a font followed by a group. After an item, at most one `_` and one `^` are allowed,
/// each followed by an item; primes can take the place of the latter. The length is limited to 64 bytes.
///
/// Outside of indices, a sign `* + - , . ( )`, a digit at the beginning, and a second item are refused: they would read
/// as a formula or a number, and not as one symbol. Accents and fonts take several letters.
///
/// # Errors
///
/// The first place at which the text violates the grammar, and the reason.
pub fn check_latex(latex: &str) -> Result<(), LatexError> {
    let fault = |span: Range<usize>, message| Err(LatexError { span, message });
    if latex.is_empty() {
        return fault(0..0, "empty");
    }
    if latex.len() > MAX_LENGTH {
        return fault(0..latex.len(), "longer than 64 bytes");
    }
    let mut walk = Walk { latex, groups: vec![Group::default()], waiting: None };
    let mut position = 0;
    while position < latex.len() {
        let end = token_end(latex, position);
        if let Err(message) = walk.token(position..end) {
            return fault(position..end, message);
        }
        position = end;
    }
    match (walk.waiting, walk.groups.as_slice()) {
        (Some(waiting), _) => fault(waiting.place, waiting.message),
        (None, [whole]) if whole.base => Ok(()),
        (None, [_]) => fault(0..latex.len(), "empty"),
        (None, [.., open]) => fault(open.start..open.start + 1, "is never closed"),
        (None, []) => Ok(()),
    }
}

/// The state of the check at a position in the text.
struct Walk<'l> {
    latex: &'l str,
    groups: Vec<Group>,
    /// An accent or an index that still needs its argument.
    waiting: Option<Waiting>,
}

/// An accent or an index without its argument.
struct Waiting {
    place: Range<usize>,
    /// The problem if no argument follows.
    message: &'static str,
    /// The kind of a group that is the argument.
    inner: Group,
}

impl Walk<'_> {
    fn token(&mut self, here: Range<usize>) -> Result<(), &'static str> {
        let token = self.latex.get(here.clone()).unwrap_or_default();
        let command = token.strip_prefix('\\').unwrap_or_default();
        let next = self.latex.as_bytes().get(here.end).copied();
        let before =
            here.start.checked_sub(1).and_then(|at| self.latex.as_bytes().get(at)).copied();
        let depth = self.groups.len();
        let Some(group) = self.groups.last_mut() else {
            return Err("closes nothing");
        };
        let inner = self.waiting.as_ref().map_or(group.nested(), |waiting| waiting.inner);
        if self.waiting.is_none() {
            check_name(token, group)?;
        }
        match token.as_bytes() {
            [b'{'] => {
                item(group, self.waiting.take().is_some());
                if depth > MAX_DEPTH {
                    return Err("groups are nested too deeply");
                }
                self.groups.push(Group { start: here.start, ..inner });
            }
            [b'}'] if self.waiting.is_some() || depth == 1 || !group.base => {
                return Err("a group ends without content, or closes nothing");
            }
            [b'}'] => {
                self.groups.pop();
            }
            [index @ (b'_' | b'^')] => {
                let taken = if *index == b'_' { &mut group.lower } else { &mut group.upper };
                if self.waiting.is_some() || *taken || !group.base {
                    return Err("a second subscript, or one without a base");
                }
                *taken = true;
                let inner = Group { is_index: true, ..inner };
                let message = "a subscript or superscript without content";
                self.waiting = Some(Waiting { place: here, message, inner });
            }
            [b'\''] => prime(group, before, self.waiting.is_some())?,
            [b'\\', ..] if takes_group(command) => {
                item(group, self.waiting.take().is_some());
                if next != Some(b'{') {
                    return Err("needs a group `{…}`");
                }
                let (message, inner) = ("needs a group `{…}`", inner.argument(command));
                self.waiting = Some(Waiting { place: here, message, inner });
            }
            [b'\\', ..] => {
                if !Letter::of_latex(command).is_some_and(Letter::is_in_symbols) {
                    return Err("this command is not allowed");
                }
                item(group, self.waiting.take().is_some());
            }
            [b' '] if self.waiting.is_none() => {}
            [b'a'..=b'z'] if inner.is_calligraphic => return Err(CALLIGRAPHIC),
            [byte] if byte.is_ascii_alphanumeric() || b"*+-,.()".contains(byte) => {
                item(group, self.waiting.take().is_some());
            }
            _ => return Err("this character is not allowed"),
        }
        Ok(())
    }
}

/// The problem of a small letter in the calligraphic font.
const CALLIGRAPHIC: &str = "calligraphic letters are capitals, such as `\\mathcal{K}`";

/// The problem of a prime without a base, or after an upper index.
const PRIME: &str = "a second superscript, or a prime without a base";

/// Notes a prime. One or several consecutive primes form one upper index.
fn prime(group: &mut Group, before: Option<u8>, waits: bool) -> Result<(), &'static str> {
    let again = before == Some(b'\'');
    if waits || !group.base || (group.upper && !again) {
        return Err(PRIME);
    }
    group.upper = true;
    Ok(())
}

/// Returns an error if a token outside of indices would read as a part of a formula.
fn check_name(token: &str, group: &Group) -> Result<(), &'static str> {
    match token.as_bytes() {
        _ if group.is_index => Ok(()),
        [byte] if b"*+-,.()".contains(byte) => {
            Err("outside of an index, this reads as a part of a formula")
        }
        [b'0'..=b'9'] if !group.base => Err("a symbol that begins with a digit reads as a number"),
        [b'_' | b'^' | b'\'' | b'}' | b' '] => Ok(()),
        _ if group.base && (!group.is_word || group.lower || group.upper) => {
            Err("several symbols read as a product; `\\mathrm{…}` makes one of several letters")
        }
        _ => Ok(()),
    }
}

/// Whether a command, without its backslash, is an accent or a font.
fn takes_group(command: &str) -> bool {
    Accent::of_latex(command).is_some() || Font::of_latex(command).is_some()
}

/// Notes an item in a group: a new base, or the argument of the accent or index that needed one.
fn item(group: &mut Group, argument: bool) {
    if !argument {
        group.lower = false;
        group.upper = false;
    }
    group.base = true;
}

/// The end of the token that begins at `start`: a command or a single character.
fn token_end(text: &str, start: usize) -> usize {
    let rest = text.get(start..).unwrap_or_default();
    let letters = |part: &str| part.bytes().take_while(u8::is_ascii_alphabetic).count();
    match rest.strip_prefix('\\') {
        Some(name) if letters(name) > 0 => start + 1 + letters(name),
        Some(name) => start + 1 + name.chars().next().map_or(0, char::len_utf8),
        None => start + rest.chars().next().map_or(1, char::len_utf8),
    }
}

#[cfg(test)]
mod tests {
    use super::check_latex;

    #[test]
    fn symbols_pass() {
        for text in [
            "l_1",
            "J_x^{*5}",
            "F_{l_x}^6",
            "\\theta_{12}",
            "\\bar{J}_{z}^{*}",
            "b_5",
            "q'",
            "\\mathrm{I}_{xx}",
            "{J_x}^2",
            "\\ell_1",
            "m_{1,2}",
            "\\mathrm{mg2}_1",
            "J _x",
            "q''_1",
            "q_1'",
            "v_{(1.5)}",
            "l_\\mathrm{2}",
            "m_\\mathrm{max,1}",
            "m^\\mathrm{(1)}",
            "x_\\bar{1}",
            "J_{*+-,.(1)}^{2x}",
        ] {
            assert_eq!(check_latex(text), Ok(()), "{text}");
        }
    }

    #[test]
    fn programs_and_errors_do_not() {
        for text in [
            "",
            "\\input{x}",
            "\\write18{x}",
            "\\def\\x{y}",
            "\\catcode",
            "a_",
            "a^",
            "_a",
            "a_b_c",
            "a^b^c",
            "a'^b",
            "a^b'",
            "'",
            "a_'",
            "{",
            "}",
            "{}",
            "a}",
            "{a_}b",
            "a}{b",
            "a%b",
            "$a$",
            "a&b",
            "a#1",
            "a~b",
            "\\\\",
            "\\bar x",
            "\\bar",
            "a_{}",
            "a_ b",
            "\\",
            "é",
            "a\nb",
            "\\^a",
            "\u{202e}",
            "{{{{{{{{{{a}}}}}}}}}}",
            " ",
            "r+1",
            "-r",
            "2",
            "2r",
            "\\bar{2}",
            "{r-1}_2",
            "r_1 l_1",
            "J'_1 l",
            "f(x)",
            "l2",
            "\\alpha\\beta_1",
            "r\\dot{q}_1",
            "\\mathrm{r+1}",
            "v_(1.5)",
            // Only capitals have a calligraphic form.
            "\\mathcal{a}",
            "\\mathcal{{a}}",
            "\\mathcal{A{b}}",
        ] {
            assert!(check_latex(text).is_err(), "{text}");
        }
        assert!(check_latex(&"a".repeat(65)).is_err());
    }
}
