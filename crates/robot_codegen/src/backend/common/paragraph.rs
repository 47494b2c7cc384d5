//! Wrapping of comments into lines.

use super::text::comment_line;

/// The largest width of a line of a comment, in characters.
const WIDTH: usize = 100;

/// Wraps a paragraph into lines of at most 100 characters, except for longer words. The later lines of an item of a
/// list are indented by two spaces.
#[must_use]
pub fn wrapped(paragraph: &str) -> Vec<String> {
    let text = comment_line(paragraph);
    let indent = if text.starts_with("- ") { "  " } else { "" };
    let mut lines = vec![];
    let mut line = String::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, indent.trim_end().to_owned()));
            line.push_str(indent);
        }
        if !line.is_empty() && !line.ends_with(' ') {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
    lines
}

/// Wraps the paragraphs of a comment into lines, with at most one empty line between two paragraphs and none at the
/// start or the end.
#[must_use]
pub fn comment_lines(paragraphs: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for line in paragraphs.iter().flat_map(|paragraph| wrapped(paragraph)) {
        if !line.is_empty() || lines.last().is_some_and(|last| !last.is_empty()) {
            lines.push(line);
        }
    }
    while lines.last().is_some_and(String::is_empty) {
        lines.pop();
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_paragraphs_are_wrapped_and_lists_indented() {
        let words = "- ".to_owned() + &"word ".repeat(30);
        let lines = wrapped(&words);
        assert_eq!(lines.len(), 2);
        assert!(lines[0].starts_with("- word"), "{lines:?}");
        assert!(lines[1].starts_with("  word"), "{lines:?}");
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH), "{lines:?}");
        assert_eq!(wrapped(""), [""]);
        assert_eq!(wrapped("one\nline"), ["one line"]);
    }
}
