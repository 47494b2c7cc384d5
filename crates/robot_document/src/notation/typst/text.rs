//! Text from robot files as Typst source that only prints it, whatever it contains.

/// The number of letters after which a longer word can be broken.
const LONG_WORD: usize = 12;

/// Text for paragraphs. Every character that could be markup is escaped, and characters that are not printable, such as
/// those that change the direction of writing, are printed as their code: `[U+202E]`.
#[must_use]
pub fn text(text: &str) -> String {
    let mut typst = String::new();
    let mut letters = 0;
    for character in text.chars() {
        letters = if character == ' ' { 0 } else { letters + 1 };
        if letters > LONG_WORD {
            typst.push_str("\\u{200b}");
            letters = 1;
        }
        match character {
            '\n' | '\t' => typst.push(' '),
            ' ' | 'a'..='z' | 'A'..='Z' | '0'..='9' => typst.push(character),
            '!'..='~' => {
                typst.push('\\');
                typst.push(character);
            }
            other if is_printed(other) => typst.push(other),
            other => typst.push_str(&format!("\\[U\\+{:04X}\\]", u32::from(other))),
        }
    }
    typst
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
        assert_eq!(text("`\\ // [] = - + é ω"), r"\`\\ \/\/ \[\] \= \- \+ é ω");
        assert_eq!(text("abcdefghijklmn"), r"abcdefghijkl\u{200b}mn");
        assert_eq!(text("a\u{202e}b\u{4e2d}\n"), r"a\[U\+202E\]b\[U\+4E2D\] ");
    }

    #[test]
    fn quotation_marks_do_not_end_quoted_text() {
        assert_eq!(quoted("a\"b\\#c"), r#""a\"b\\#c""#);
    }
}
