//! Conversion between bytes of a text and the positions of the protocol: the number of a line, from 0, and the number of
//! UTF-16 code units before the place in this line.

use serde_json::{Value, json};

/// The distance of the bytes up to which code units are counted in advance.
const STRIDE: usize = 256;

/// A text with its lines, which end with `\n`, `\r\n` or `\r`.
pub(super) struct Lines<'t> {
    text: &'t str,
    /// The first byte of each line.
    starts: Vec<usize>,
    /// The number of code units before the first character at or after every `STRIDE`th byte.
    units: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub(super) fn new(text: &'t str) -> Lines<'t> {
        let (mut starts, mut units, mut count) = (vec![0], vec![], 0);
        let bytes = text.as_bytes();
        for (byte, character) in text.char_indices() {
            while units.len() * STRIDE <= byte {
                units.push(count);
            }
            count += character.len_utf16();
            if character == '\n' || character == '\r' && bytes.get(byte + 1) != Some(&b'\n') {
                starts.push(byte + 1);
            }
        }
        while units.len() * STRIDE <= text.len() {
            units.push(count);
        }
        Lines { text, starts, units }
    }

    /// The number of code units before a byte at which a character begins.
    fn units(&self, byte: usize) -> usize {
        let counted = byte / STRIDE;
        let mut start = counted * STRIDE;
        while !self.text.is_char_boundary(start) {
            start += 1;
        }
        let rest = self.text.get(start..byte).unwrap_or_default();
        let before = self.units.get(counted).copied().unwrap_or_default();
        before + rest.chars().map(char::len_utf16).sum::<usize>()
    }

    /// The position of a byte. A byte within a character, or after the text, has that of the character or of the end.
    pub(super) fn position(&self, byte: usize) -> Value {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= byte).saturating_sub(1);
        let start = self.starts.get(line).copied().unwrap_or_default();
        json!({ "line": line, "character": self.units(byte) - self.units(start) })
    }

    /// The range of bytes as a range of the protocol.
    pub(super) fn range(&self, span: &std::ops::Range<usize>) -> Value {
        let end = span.end.max(span.start);
        json!({ "start": self.position(span.start), "end": self.position(end) })
    }

    /// The byte of a position: that of the end of the line, without its line end, if the line is shorter; `None` if
    /// there is no such line.
    pub(super) fn byte(&self, position: &Value) -> Option<usize> {
        let number = |name| usize::try_from(position.get(name)?.as_u64()?).ok();
        let (line, character) = (number("line")?, number("character")?);
        let start = *self.starts.get(line)?;
        let mut units = 0;
        let rest = self.text.get(start..)?;
        let stop = |(_, one): &(usize, char)| {
            let is_over = units >= character || matches!(one, '\n' | '\r');
            units += one.len_utf16();
            is_over
        };
        Some(start + rest.char_indices().find(stop).map_or(rest.len(), |(byte, _)| byte))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions as the protocol defines them, counted from the start of the text.
    fn counted(text: &str, byte: usize) -> Value {
        let (mut line, mut character) = (0, 0);
        let mut before = text[..byte].chars().peekable();
        while let Some(one) = before.next() {
            let next = before.peek().copied().or_else(|| text[byte..].chars().next());
            if one == '\n' || one == '\r' && next != Some('\n') {
                (line, character) = (line + 1, 0);
            } else {
                character += one.len_utf16();
            }
        }
        json!({ "line": line, "character": character })
    }

    #[test]
    fn positions_are_in_code_units_of_utf_16() {
        let pattern = "a é 𝒒̇ = \"中\" # 🦾🦾\r\nb\rc\n\n𝒒";
        for text in [pattern.to_owned(), pattern.repeat(40), "𝒒é".repeat(500), String::new()] {
            let lines = Lines::new(&text);
            for (byte, _) in text.char_indices().chain([(text.len(), ' ')]) {
                let position = lines.position(byte);
                assert_eq!(position, counted(&text, byte), "{text:?} {byte}");
                let is_within_end = text[..byte].ends_with('\r') && text[byte..].starts_with('\n');
                if !is_within_end {
                    assert_eq!(lines.byte(&position), Some(byte), "{text:?} {byte}");
                }
            }
        }
    }

    #[test]
    fn places_out_of_the_text_are_brought_in() {
        let lines = Lines::new("é𝒒\nab");
        assert_eq!(lines.position(1), lines.position(0));
        assert_eq!(lines.position(5), json!({ "line": 0, "character": 1 }));
        assert_eq!(lines.position(900), json!({ "line": 1, "character": 2 }));
        assert_eq!(lines.byte(&json!({ "line": 0, "character": 2 })), Some(6));
        assert_eq!(lines.byte(&json!({ "line": 0, "character": 99 })), Some(6));
        assert_eq!(lines.byte(&json!({ "line": 1, "character": 99 })), Some(9));
        assert_eq!(lines.byte(&json!({ "line": 2, "character": 0 })), None);
        for wrong in [json!(null), json!({ "line": -1, "character": 0 }), json!({ "line": 0 })] {
            assert_eq!(lines.byte(&wrong), None, "{wrong}");
        }
    }
}
