//! Standard error for messages, whose text cannot control a terminal.

use std::fmt::Write as _;
use std::io::Write;

use robot_model::diagnostic::is_invisible;

/// Standard error. Control characters, invisible characters and characters that reorder text are escaped, except ends
/// of lines, tabs and, on a terminal, this program's own terminal commands. Text that cannot be written is dropped,
/// because a message that nobody reads must not stop the work.
pub(crate) struct Messages<'a> {
    pub(crate) stream: &'a mut dyn Write,
    /// Whether colors and lines of progress are shown.
    pub(crate) commands: bool,
}

impl Write for Messages<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let text = String::from_utf8_lossy(bytes);
        let _ = self.stream.write_all(escaped(&text, self.commands).as_bytes());
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let _ = self.stream.flush();
        Ok(())
    }
}

/// Escapes characters that would control a terminal.
fn escaped(text: &str, commands: bool) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(character) = rest.chars().next() {
        let length = match own_command(rest).filter(|_| commands) {
            Some(length) => length,
            None => character.len_utf8(),
        };
        let (taken, after) = rest.split_at(length);
        let hides = character.is_control() || is_invisible(character);
        if length == character.len_utf8() && hides && !matches!(character, '\n' | '\t') {
            // Writing to a string does not fail.
            let _ = write!(shown, "{}", character.escape_unicode());
        } else {
            shown.push_str(taken);
        }
        rest = after;
    }
    shown
}

/// The length of a terminal command of this program at the start of the text: a color, or a return to the start of the
/// line.
fn own_command(text: &str) -> Option<usize> {
    const ANEW: &str = "\r\x1b[K";
    if text.starts_with(ANEW) {
        return Some(ANEW.len());
    }
    let parameters = text.strip_prefix("\x1b[")?;
    let end = parameters.find(|c: char| !matches!(c, '0'..='9' | ';'))?;
    parameters[end..].starts_with('m').then_some("\x1b[".len() + end + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_obeys_no_text_of_messages() {
        let text = "a\x1b]0;title\x07 \x1b[2J\u{9b}31m\r\0 é\tb\n";
        let plain = "a\\u{1b}]0;title\\u{7} \\u{1b}[2J\\u{9b}31m\\u{d}\\u{0} é\tb\n";
        assert_eq!(escaped(text, false), plain);
        assert_eq!(escaped(text, true), plain);
        assert_eq!(escaped("a\u{2028}\u{202e}b\u{feff}", false), "a\\u{2028}\\u{202e}b\\u{feff}");
        let own = "\x1b[1;31merror\x1b[0m\r\x1b[K1 s";
        assert_eq!(escaped(own, true), own);
        assert_eq!(escaped(own, false), "\\u{1b}[1;31merror\\u{1b}[0m\\u{d}\\u{1b}[K1 s");
    }
}
