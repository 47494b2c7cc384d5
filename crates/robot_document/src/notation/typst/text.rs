//! Text from robot files as Typst source that only prints it, whatever it contains.

use crate::notation::words;

/// Text for paragraphs. Characters that would be markup at their place are escaped, and characters that are not
/// printable, such as those that change the direction of writing, are printed as their code: `[U+202E]`.
#[must_use]
pub fn text(text: &str) -> String {
    let mut typst = String::new();
    for (place, piece) in words::pieces(text).into_iter().enumerate() {
        if place > 0 {
            typst.push_str("\\u{200b}");
        }
        push(piece, &mut typst);
    }
    typst
}

/// Appends text without breaks of its own.
fn push(text: &str, typst: &mut String) {
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '\n' | '\t' => typst.push(' '),
            '!'..='~' => {
                if is_markup(typst, character, characters.peek().copied()) {
                    typst.push('\\');
                }
                typst.push(character);
            }
            other if other == ' ' || is_printed(other) => typst.push(other),
            other => typst.push_str(&format!("\\[U+{:04X}\\]", u32::from(other))),
        }
    }
}

/// Whether a character of ASCII would be markup after the source `before`. A text can stand at the start of a line,
/// where lists and headings start, or after code, which it could continue.
fn is_markup(before: &str, character: char, next: Option<char>) -> bool {
    let is_first =
        before.trim_start_matches(|one: char| one == ' ' || one.is_ascii_digit()).is_empty();
    match character {
        'a'..='z' | 'A'..='Z' | '0'..='9' => false,
        ',' | ':' | '!' | '?' | '%' | '&' | ')' | '{' | '}' | '^' | '|' => false,
        // Several dots are an ellipsis.
        '.' => match (is_first, next) {
            (true, None | Some(' ')) => !before.is_empty(),
            (true, _) | (_, Some('.')) => true,
            (false, _) => before.ends_with('.'),
        },
        ';' | '(' | '+' | '=' => is_first,
        // A minus sign before a digit, several hyphens and comments are printed in another way.
        '-' | '/' => {
            let is_after_word = before.ends_with(|one: char| one.is_ascii_alphanumeric());
            !(is_after_word && next.is_some_and(|one| one.is_ascii_alphabetic()))
        }
        _ => true,
    }
}

/// Text in quotation marks for Typst formulas and code.
pub(super) fn quoted(text: &str) -> String {
    let mut typst = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => {
                typst.push('\\');
                typst.push(character);
            }
            ' '..='~' => typst.push(character),
            other if is_printed(other) => typst.push(other),
            other => typst.push_str(&format!("[U+{:04X}]", u32::from(other))),
        }
    }
    typst.push('"');
    typst
}

/// Whether New Computer Modern has a character; combining marks and invisible characters are excluded.
fn is_printed(character: char) -> bool {
    matches!(character,
        'À'..='ſ' | 'Α'..='Ω' | 'α'..='ω' | '–' | '—' | '‘' | '’' | '“' | '”' | '…' | '§' | '°' | '·'
        | '±' | '²' | '³' | 'µ')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_never_markup() {
        assert_eq!(text("#import $x$ *a* _b_ @c <d>"), r"\#import \$x\$ \*a\* \_b\_ \@c \<d\>");
        assert_eq!(text("`\\ // [] = - + é ω"), r"\`\\ \/\/ \[\] = \- + é ω");
        assert_eq!(text("abcdefghijk12"), r"abcdefghijk1\u{200b}2");
        assert_eq!(text("a\u{202e}b\u{4e2d}\n"), r"a\[U+202E\]b\[U+4E2D\] ");
    }

    #[test]
    fn prose_has_no_needless_escapes() {
        let prose = "Newton-Euler (link by link), in kg m/s: 100% of a = b + c; q1, q2. End.";
        assert_eq!(text(prose), prose);
    }

    #[test]
    fn no_text_starts_a_list_or_continues_code() {
        for (plain, typst) in [
            ("= a", r"\= a"),
            (" - a", r" \- a"),
            ("+ a", r"\+ a"),
            ("/ a: b", r"\/ a: b"),
            ("12. a", r"12\. a"),
            ("(a)", r"\(a)"),
            (".a", r"\.a"),
            (";", r"\;"),
            (". A", ". A"),
            ("a -- b...", r"a \-\- b\.\.\."),
            ("a -1 --", r"a \-1 \-\-"),
            ("https://a.b", r"https:\/\/a.b"),
        ] {
            assert_eq!(text(plain), typst);
        }
    }

    #[test]
    fn quotation_marks_do_not_end_quoted_text() {
        assert_eq!(quoted("a\"b\\#c"), r#""a\"b\\#c""#);
    }
}
