//! Finds where the characters of a TOML string are in the file.

use crate::diagnostic::Span;

/// The place in the file of `range` within a decoded string. `span` is the place of the string including its quotes; it
/// is returned if the place of the range cannot be determined.
pub(super) fn place(file: &str, span: &Span, decoded: &str, range: Span) -> Span {
    let raw = file.get(span.clone()).unwrap_or_default();
    let (Some(start), Some(end)) = (
        offset(raw, decoded, range.start, true),
        offset(raw, decoded, range.end, range.is_empty()),
    ) else {
        return span.clone();
    };
    span.start + start..span.start + end
}

/// The offset in the raw string at which `target` bytes of the decoded string are complete. With `onward`, a line
/// continuation at this offset is skipped.
fn offset(raw: &str, decoded: &str, target: usize, onward: bool) -> Option<usize> {
    let (mut position, basic) = opening(raw)?;
    let mut done = 0;
    while done < target {
        let rest = raw.get(position..)?;
        let character = rest.chars().next()?;
        let (produced, consumed) = match character {
            '\\' if basic => escape(rest)?,
            '\r' if rest.starts_with("\r\n") && decoded.get(done..)?.starts_with('\n') => (1, 2),
            _ => (character.len_utf8(), character.len_utf8()),
        };
        done += produced;
        position += consumed;
    }
    if let Some((0, consumed)) = raw.get(position..).filter(|_| onward && basic).and_then(escape) {
        position += consumed;
    }
    (done == target && decoded.is_char_boundary(target)).then_some(position)
}

/// The offset of the content of a raw string, and whether the string can have escapes.
fn opening(raw: &str) -> Option<(usize, bool)> {
    let quote = raw.chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
    let basic = quote == '"';
    let triple = quote.to_string().repeat(3);
    if !raw.starts_with(&triple) || raw.len() < 6 {
        return Some((1, basic));
    }
    let rest = raw.get(3..)?;
    let newline = if rest.starts_with("\r\n") { 2 } else { usize::from(rest.starts_with('\n')) };
    Some((3 + newline, basic))
}

/// The number of decoded bytes that an escape stands for, and the number of bytes that it occupies.
fn escape(rest: &str) -> Option<(usize, usize)> {
    rest.strip_prefix('\\')?;
    let digits = match rest.chars().nth(1)? {
        'x' => 2,
        'u' => 4,
        'U' => 8,
        ' ' | '\t' | '\r' | '\n' => {
            let kept = rest.get(1..)?.trim_start_matches([' ', '\t', '\r', '\n']);
            return Some((0, rest.len() - kept.len()));
        }
        _ => return Some((1, 2)),
    };
    let value = u32::from_str_radix(rest.get(2..2 + digits)?, 16).ok()?;
    Some((char::from_u32(value)?.len_utf8(), 2 + digits))
}

#[cfg(test)]
mod tests {
    use super::place;

    /// The text in the file that corresponds to `needle` within the string that is the value of `a`.
    fn shown<'f>(file: &'f str, needle: &str) -> &'f str {
        let (table, errors) = toml::de::DeTable::parse_recoverable(file);
        assert!(errors.is_empty(), "{file}: {errors:?}");
        let value = table.get_ref().get("a").unwrap();
        let decoded = value.get_ref().as_str().unwrap();
        let start = decoded.find(needle).unwrap();
        let range = start..start + needle.len();
        &file[place(file, &value.span(), decoded, range)]
    }

    #[test]
    fn places_follow_quotes_and_escapes() {
        assert_eq!(shown("a = \"l1 + x\"", "x"), "x");
        assert_eq!(shown("a = 'l\\1 + x'", "x"), "x");
        assert_eq!(shown("a = \"\\t\\\"l1 + \\u0078\"", "x"), "\\u0078");
        assert_eq!(shown("a = \"\\x41\\U0001F600 + x\"", "x"), "x");
        assert_eq!(shown("a = \"é + x\"", "é"), "é");
        assert_eq!(shown("a = \"\"\"\r\nl1 + \\\r\n   x\"\"\"", "x"), "x");
        assert_eq!(shown("a = '''\nl1 +\n x'''", "x"), "x");
        assert_eq!(shown("a = '''l1 +\r\n x'''", "x"), "x");
        assert_eq!(shown("a = \"\\e\\\\ x\"", "x"), "x");
        // An empty string in six quotes is between the third and the fourth.
        assert_eq!(place("a = \"\"\"\"\"\"", &(4..10), "", 0..0), 7..7);
    }

    #[test]
    fn a_place_out_of_the_string_is_the_string() {
        assert_eq!(place("a = 'x'", &(4..7), "x", 0..9), 4..7);
        assert_eq!(place("a = x", &(4..5), "x", 0..1), 4..5);
    }
}
