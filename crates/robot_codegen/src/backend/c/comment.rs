//! Comments in C.

use crate::backend::common::{comment_line, comment_lines};

/// Escapes text within a comment, so that it neither ends the comment nor starts another or contains a trigraph.
fn inside(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
}

/// Prints a comment of one line.
pub(super) fn of_line(text: &str) -> String {
    format!("/* {} */", inside(&comment_line(text)))
}

/// Prints the comment of an item, made of paragraphs or lines of a list.
pub(super) fn of_paragraphs(paragraphs: &[String]) -> Vec<String> {
    let lines: Vec<String> = comment_lines(paragraphs).iter().map(|line| inside(line)).collect();
    let mut comment = vec!["/**".to_owned()];
    comment.extend(lines.iter().map(|line| format!(" * {line}").trim_end().to_owned()));
    comment.push(" */".to_owned());
    comment
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_ends_a_comment() {
        assert_eq!(of_line("a */ b /* c\n d"), "/* a * / b / * c  d */");
        assert_eq!(of_line("**//"), "/* ** // */");
        assert_eq!(of_line("a???/"), "/* a? ??/ */");
        for text in ["*/", "**//", "*\u{200b}/", "/*/", "*/*/*/"] {
            let comment = of_paragraphs(&[text.to_owned()]).join("\n");
            assert_eq!(comment.matches("*/").count(), 1, "{comment}");
            assert_eq!(comment.matches("/*").count(), 1, "{comment}");
        }
    }
}
