//! Documentation of printed code. Text from outside becomes plain Markdown only here; each printer also escapes what
//! would end its comments. Markdown from the caller keeps its marks.

use crate::counts::Counts;
use crate::module::Function;
use crate::spec::ParameterSpec;

/// Escapes lines of untrusted text, so that as Markdown they are plain text: without line breaks
/// other than those between lines, code fences, indented blocks (which would be compiled as examples),
/// links, HTML, and characters that change the direction of text.
#[must_use]
pub fn markdown(text: &str) -> Vec<String> {
    text.lines().map(markdown_line).collect()
}

/// Escapes untrusted text as one line.
#[must_use]
pub fn markdown_line(text: &str) -> String {
    let mut line = String::new();
    for character in text.chars() {
        match character {
            '[' | ']' | '<' | '>' | '`' | '~' | '\\' | '#' | '*' | '|' => {
                line.push('\\');
                line.push(character);
            }
            _ if character.is_whitespace() || character.is_control() => {
                // Any run of spaces becomes one, and none remains at the start, where four would make a code block.
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

/// Returns the lines of the caller's Markdown, or the name of the documented item if there are none.
#[must_use]
pub fn paragraphs(texts: &[String], name: &str) -> Vec<String> {
    let lines: Vec<String> = texts.iter().flat_map(|text| text.lines()).map(comment_line).collect();
    if lines.iter().all(String::is_empty) {
        vec![format!("{}.", markdown_line(name))]
    } else {
        lines
    }
}

/// Prints `meaning, in unit; 3 rows of 4.` The meaning is Markdown; if it is empty, the name is used.
#[must_use]
pub fn quantity(meaning: &str, name: &str, unit: &str, shape: &[usize]) -> String {
    let mut line = if meaning.is_empty() { markdown_line(name) } else { comment_line(meaning) };
    if !matches!(unit, "" | "1") {
        line.push_str(&format!(", in {}", markdown_line(unit)));
    }
    if let [rows, columns] = shape {
        let rows = if *rows == 1 { "1 row".to_owned() } else { format!("{rows} rows") };
        line.push_str(&format!("; {rows} of {columns}"));
    }
    line.push('.');
    line
}

/// The documentation of a parameter: `mass of link 1, in kg; nominally 12.`
#[must_use]
pub fn parameter(spec: &ParameterSpec) -> String {
    let mut line = quantity(&markdown_line(&spec.doc), &spec.name, &spec.unit, &[]);
    if let Some(value) = spec.nominal {
        line.pop();
        line.push_str(&format!("; nominally {value:?}."));
    }
    line
}

/// The documentation of a function: its own paragraphs, then each input by its name in the code, the
/// output if there is only one, and the operations of a call.
#[must_use]
pub fn function<'n>(
    function: &Function,
    inputs: impl IntoIterator<Item = &'n str>,
    counts: &Counts,
) -> Vec<String> {
    let mut lines = paragraphs(&function.doc, &function.name);
    lines.push(String::new());
    for (input, name) in function.inputs.iter().zip(inputs) {
        let meaning = quantity(&input.doc, &input.name, &input.unit, &[]);
        lines.push(format!("- `{name}`: {meaning}"));
    }
    if let [output] = function.outputs.as_slice() {
        let meaning = quantity(&output.doc, &output.name, &output.unit, &output.shape);
        lines.extend([String::new(), format!("Returns: {meaning}")]);
    }
    lines.extend([String::new(), format!("{}.", operations(counts))]);
    lines
}

/// Adds the results of a function, if it has several, to its documentation, after the line `heading` if there is one: each by
/// its name in the code.
pub fn add_results<'n>(
    lines: &mut Vec<String>,
    heading: Option<&str>,
    function: &Function,
    names: impl IntoIterator<Item = &'n str>,
) {
    if function.outputs.len() < 2 {
        return;
    }
    let outputs = function.outputs.iter().zip(names).map(|(output, name)| {
        let meaning = quantity(&output.doc, &output.name, &output.unit, &output.shape);
        format!("- `{name}`: {meaning}")
    });
    // The last two lines are those of the operations.
    let place = lines.len().saturating_sub(2);
    let heading = heading.map(str::to_owned);
    let added: Vec<String> = [String::new()].into_iter().chain(heading).chain(outputs).collect();
    lines.splice(place..place, added);
}

/// `12 multiplications, 8 additions, 1 division`
#[must_use]
pub fn operations(counts: &Counts) -> String {
    let kinds = [
        (counts.mul, "multiplication"),
        (counts.add, "addition"),
        (counts.div, "division"),
        (counts.sqrt, "square root"),
        (counts.other, "other function"),
        (counts.sin, "sine"),
        (counts.cos, "cosine"),
    ];
    let texts: Vec<String> = kinds
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, kind)| format!("{count} {kind}{}", if count == 1 { "" } else { "s" }))
        .collect();
    if texts.is_empty() { "No operations".to_owned() } else { texts.join(", ") }
}

/// Turns text into a comment of one line.
#[must_use]
pub fn comment_line(text: &str) -> String {
    let visible = text.chars().filter(|character| !is_invisible(*character));
    let one_line = visible.map(|c| if c.is_control() || c.is_whitespace() { ' ' } else { c });
    one_line.collect::<String>().trim_end().to_owned()
}

/// Whether a character is a mark of direction, a joiner or similar, which can make text look like other text.
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
        let line = quantity("Of `q`", "x", "rad; m at [2]", &[2, 3]);
        assert_eq!(line, "Of `q`, in rad; m at \\[2\\]; 2 rows of 3.");
    }

    #[test]
    fn nothing_but_text_is_left() {
        assert_eq!(markdown("a\r\n    ```\n\tb\u{202e}c"), ["a", "\\`\\`\\`", "bc"]);
        assert_eq!(markdown_line("see [x](y) */ <script>"), "see \\[x\\](y) \\*/ \\<script\\>");
        assert_eq!(comment_line("x\n}fn y(){}\u{2028}"), "x }fn y(){}");
    }
}
