//! Documentation of generated code. Text from outside is made harmless in this one place; what the caller wrote
//! is Markdown and stays it.

use syn::{Attribute, parse_quote};

/// Documentation attributes, one for each line.
pub(super) fn attributes(lines: &[String]) -> Vec<Attribute> {
    let lines = lines.iter().map(|line| {
        let line = if line.is_empty() { line.clone() } else { format!(" {line}") };
        parse_quote!(#[doc = #line])
    });
    lines.collect()
}

/// Lines of text that nobody controls, as Markdown that means nothing but the text: no line breaks
/// other than those between lines, no code fences or indented blocks (which would be compiled as
/// examples), no links, no HTML, no characters that change the direction of text.
#[must_use]
pub fn sanitise(text: &str) -> Vec<String> {
    text.lines().map(sanitise_line).collect()
}

/// One line of such text.
pub(super) fn sanitise_line(text: &str) -> String {
    let mut line = String::new();
    for character in text.chars() {
        match character {
            '[' | ']' | '<' | '>' | '`' | '~' | '\\' | '#' | '*' | '|' => {
                line.push('\\');
                line.push(character);
            }
            _ if character.is_whitespace() || character.is_control() => {
                // One space for any run, none at the start: four would make a code block.
                if !line.is_empty() && !line.ends_with(' ') {
                    line.push(' ');
                }
            }
            _ if is_invisible(character) => {}
            _ => line.push(character),
        }
    }
    line.trim_end().to_owned()
}

/// Lines of the caller's Markdown; the name of what is documented where there are none.
pub(super) fn paragraphs(texts: &[String], name: &str) -> Vec<String> {
    let lines: Vec<String> = texts.iter().flat_map(|text| text.lines()).map(comment_line).collect();
    if lines.iter().all(String::is_empty) {
        vec![format!("{}.", sanitise_line(name))]
    } else {
        lines
    }
}

/// `meaning, in unit; 3 rows of 4.` The meaning is Markdown; the name stands where there is none.
pub(super) fn array(meaning: &str, name: &str, unit: &str, shape: &[usize]) -> String {
    let mut line = if meaning.is_empty() { sanitise_line(name) } else { comment_line(meaning) };
    if !unit.is_empty() {
        line.push_str(&format!(", in {}", sanitise_line(unit)));
    }
    if let [rows, columns] = shape {
        line.push_str(&format!("; {rows} rows of {columns}"));
    }
    line.push('.');
    line
}

/// Text in a `//` comment: one line.
pub(super) fn comment_line(text: &str) -> String {
    let visible = text.chars().filter(|character| !is_invisible(*character));
    let one_line = visible.map(|c| if c.is_control() || c.is_whitespace() { ' ' } else { c });
    one_line.collect::<String>().trim_end().to_owned()
}

/// Marks of direction, joiners and the like, with which text can look like other text.
fn is_invisible(character: char) -> bool {
    matches!(
        character,
        '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{61c}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markdown_of_the_caller_stays() {
        let texts = ["The `q` of\r\n[`Model`]".to_owned(), "\n".to_owned()];
        assert_eq!(paragraphs(&texts, "f"), ["The `q` of", "[`Model`]", ""]);
        assert_eq!(paragraphs(&[], "a[b]"), ["a\\[b\\]."]);
        let line = array("Of `q`", "x", "rad; m at [2]", &[2, 3]);
        assert_eq!(line, "Of `q`, in rad; m at \\[2\\]; 2 rows of 3.");
    }

    #[test]
    fn nothing_but_text_is_left() {
        assert_eq!(sanitise("a\r\n    ```\n\tb\u{202e}c"), ["a", "\\`\\`\\`", "bc"]);
        assert_eq!(sanitise_line("see [x](y) */ <script>"), "see \\[x\\](y) \\*/ \\<script\\>");
        assert_eq!(comment_line("x\n}fn y(){}\u{2028}"), "x }fn y(){}");
    }
}
