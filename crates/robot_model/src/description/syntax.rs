//! Parses TOML text into tables and explains TOML errors in terms of robot files.

use toml::Spanned;
use toml::de::DeTable;

use super::value::is_hidden;
use crate::diagnostic::{Diagnostic, Span, code};

/// Parses the text. The tables are usable only if there are no diagnostics.
pub(super) fn parse(text: &str) -> (Spanned<DeTable<'_>>, Vec<Diagnostic>) {
    let start = text.len() - text.trim_start().len();
    if text[start..].starts_with('<') {
        let message = "the file is XML, not TOML".to_owned();
        let diagnostic = Diagnostic::error(code::SYNTAX, message).at(&(start..start + 1), "");
        let help = "the name of a URDF file ends in `.urdf`: rename the file";
        return (DeTable::parse_recoverable("").0, vec![diagnostic.help(help)]);
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut found = Vec::new();
    // The keys below a duplicate header would be reported as duplicates, too; they are skipped.
    let mut header: Option<Span> = None;
    // An error without a place is at the end of the file, which is taken as the end of the last
    // line with text.
    let end = text.trim_end().len();
    let commas = decimal_commas(text, &errors);
    let strings = open_strings(&errors);
    // What is read as entries of a list or inline table with a wrong bracket; the errors there are consequences.
    let mut swallowed: Vec<Span> = vec![];
    for error in &errors {
        let span = error.span().unwrap_or(end..end);
        let duplicate = error.message() == "duplicate key";
        if duplicate && header.as_ref().is_some_and(|table| table.contains(&span.start)) {
            continue;
        }
        if duplicate && line_of(text, span.start).starts_with('[') {
            header = Some(span.start..next_header(text, span.end));
        }
        if is_within(&commas, span.start) || is_within(&swallowed, span.start) {
            continue;
        }
        if let Some(bracket) = wrong_bracket(text, error.message(), span.start) {
            // A string that is not closed is reported instead: it contains the closing bracket.
            let string = strings[..strings.partition_point(|at| *at < span.start)].last();
            if string.is_none_or(|at| is_within(&swallowed, *at)) {
                let message = format!("invalid TOML: {}", bracket.message);
                let diagnostic = Diagnostic::error(code::SYNTAX, message).at(&span, "");
                found.push(diagnostic.help(bracket.help));
            }
            swallowed.push(bracket.swallowed);
            continue;
        }
        let message = words(error.message());
        let help = remedy(text, error.message(), &span);
        let mut diagnostic = Diagnostic::error(code::SYNTAX, message).at(&span, "");
        diagnostic.help = help.map(str::to_owned);
        found.push(diagnostic);
    }
    if found.len() > 1 && !is_robot_file(text) {
        let place = errors.iter().find_map(toml::de::Error::span).unwrap_or(end..end);
        found = vec![no_robot_file(&place)];
    }
    (table, found)
}

fn no_robot_file(place: &Span) -> Diagnostic {
    Diagnostic::error(code::SYNTAX, "the text is not a robot file")
        .at(place, "neither TOML nor XML")
        .because("it has neither `format = 1` nor a table such as `[robot]`")
        .help("check which file is meant; a robot file is TOML or URDF")
}

/// Whether a text with errors has the marks of a robot file in TOML, or explains itself, as JSON does.
fn is_robot_file(text: &str) -> bool {
    let is_mark = |line: &str| {
        let key = line.split_once('=').map(|(key, _)| key.trim());
        line.starts_with('[') || key == Some("format")
    };
    text.trim_start().starts_with('{') || text.lines().map(str::trim_start).any(is_mark)
}

/// The text from the start of the line that contains the byte.
fn line_of(text: &str, byte: usize) -> &str {
    let before = text.get(..byte).unwrap_or_default();
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    text.get(start..).unwrap_or_default()
}

/// A list or an inline table with a missing or wrong bracket.
struct WrongBracket {
    message: &'static str,
    help: &'static str,
    /// The text that the parser reads as entries because of the bracket.
    swallowed: Span,
}

/// The list or inline table with a wrong bracket that is the cause of an error of the parser at a byte.
fn wrong_bracket(text: &str, error: &str, byte: usize) -> Option<WrongBracket> {
    let rest = rest_of_line(text, byte);
    let in_list = error.starts_with("missing comma between array elements");
    let in_table = error.starts_with("missing comma between key-value pairs");
    let mut end = usize::MAX;
    let (message, help) = if in_list && rest.starts_with('}') {
        ("`}` does not close a list", "close the list with `]`")
    } else if error.starts_with("invalid inline table element") && rest.starts_with(']') {
        ("`]` does not close an inline table", "close the table with `}`")
    } else if in_list && begins_a_line(text, byte) {
        ("a list before this line is not closed", "add the missing `]` at the end of the list")
    } else if in_table && begins_a_line(text, byte) {
        let message = "an inline table before this line is not closed";
        (message, "add the missing `}` at the end of the table")
    } else if error.starts_with("extra comma in inline table") && opens_with_number(text, byte) {
        if rest.contains('}') {
            end = byte + rest.len() + 1;
        }
        let message = "the entries of an inline table are `key = value`, not numbers";
        (message, "write a list in brackets, such as `[0.1, 0, 0]`")
    } else {
        return None;
    };
    Some(WrongBracket { message, help, swallowed: byte..end })
}

/// Whether a number in an inline table that it opens ends at the byte.
fn opens_with_number(text: &str, byte: usize) -> bool {
    let before = text.get(..byte).unwrap_or_default();
    let entry = before.rsplit_once('{').map(|(_, entry)| entry.trim());
    entry.is_some_and(|entry| entry.parse::<f64>().is_ok())
}

/// The starts of the strings that are not closed, in order.
fn open_strings(errors: &[toml::de::Error]) -> Vec<usize> {
    let is_open = |error: &&toml::de::Error| {
        let message = error.message();
        message.starts_with("invalid basic string") || message.starts_with("invalid literal string")
    };
    let mut starts: Vec<usize> =
        errors.iter().filter(is_open).filter_map(|error| Some(error.span()?.start)).collect();
    starts.sort_unstable();
    starts
}

/// Whether a byte is in the last span that begins before or at it; the spans are in order.
fn is_within(spans: &[Span], byte: usize) -> bool {
    let before = spans.partition_point(|span| span.start <= byte);
    spans[..before].last().is_some_and(|span| byte < span.end)
}

/// Whether a header or a key with its value begins at a byte, the first of its line that is not a space.
fn begins_a_line(text: &str, byte: usize) -> bool {
    let line = line_of(text, byte).lines().next().unwrap_or_default();
    let rest = rest_of_line(text, byte);
    let key = rest.split(['=', ' ']).next().unwrap_or_default();
    let is_key =
        !key.is_empty() && key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    line.trim_start() == rest && (rest.starts_with('[') || is_key && rest.contains('='))
}

/// The text from the byte to the end of its line.
fn rest_of_line(text: &str, byte: usize) -> &str {
    text.get(byte..).and_then(|rest| rest.lines().next()).unwrap_or_default()
}

/// What follows each decimal comma on its line, in order; the errors there are consequences of the comma.
fn decimal_commas(text: &str, errors: &[toml::de::Error]) -> Vec<Span> {
    let places = errors.iter().filter_map(|error| Some(error.span()?.start));
    let commas = places.filter(|place| is_decimal_comma(text, *place));
    let mut rests: Vec<Span> =
        commas.map(|place| place + 1..place + rest_of_line(text, place).len()).collect();
    rests.sort_unstable_by_key(|rest| rest.start);
    rests
}

/// Whether an error at a byte is a comma in a number, such as that of `0,5`: the byte is the comma or the one after the
/// digits behind it.
fn is_decimal_comma(text: &str, byte: usize) -> bool {
    let before = text.get(..byte).unwrap_or_default();
    let is_digit = |character: char| character.is_ascii_digit();
    let after = text.get(byte..).and_then(|rest| rest.strip_prefix(','));
    match after {
        Some(after) if after.starts_with(is_digit) => before.ends_with(is_digit),
        _ => {
            let digits = before.trim_end_matches(is_digit);
            let number = digits.strip_suffix(',').filter(|_| digits.len() < before.len());
            number.is_some_and(|number| number.ends_with(is_digit))
        }
    }
}

/// The start of the first line after the byte that begins with `[`.
fn next_header(text: &str, byte: usize) -> usize {
    let rest = text.get(byte..).unwrap_or_default();
    rest.find("\n[").map_or(text.len(), |at| byte + at + 1)
}

/// The remedy for a table that appears again, by its header.
fn repeated_table(header: &str) -> &'static str {
    let name = header.split(']').next().unwrap_or_default().trim_start_matches('[');
    match name.trim() {
        "tip" => "write each tip as `[[tip]]`, with double brackets",
        "frame" => "write each frame as `[[frame]]`, with double brackets",
        "link" => "write each link as `[[link]]`, with double brackets",
        "budget" => "write each budget as `[[budget]]`, with double brackets",
        _ => "this table may appear only once: write its keys under one header",
    }
}

/// The beginnings of the parser's messages about numbers.
const NUMBER: [&str; 7] = [
    "invalid float",
    "invalid integer",
    "invalid fraction",
    "invalid exponent",
    "invalid mantissa",
    "unexpected leading zero",
    "`_` may only",
];

fn first_character(text: &str) -> &str {
    let end = text.chars().next().map_or(0, char::len_utf8);
    text.get(..end).unwrap_or_default()
}

/// The message of the parser.
fn words(message: &str) -> String {
    let message = message.strip_suffix(", expected nothing").unwrap_or(message);
    if message.contains("recurs") {
        return "the file is nested too deeply".to_owned();
    }
    format!("invalid TOML: {message}")
}

/// A remedy for the most frequent messages of the parser.
fn remedy(text: &str, message: &str, span: &Span) -> Option<&'static str> {
    let rest = text.get(span.start..).unwrap_or_default();
    let starts = |start: &str| message.starts_with(start);
    let found = text.get(span.clone()).filter(|found| !found.is_empty());
    let found = found.unwrap_or_else(|| first_character(rest));
    let is_space = |character: char| character.is_whitespace() && !character.is_ascii();
    if is_decimal_comma(text, span.start) {
        Some("use a decimal point: write `0.5` instead of `0,5`")
    } else if found.contains(is_space) {
        Some(
            "this space is not the usual one, but for example the no-break space of web pages: type it again",
        )
    } else if found.contains(is_hidden) {
        Some("remove the invisible character")
    } else if found.starts_with(['“', '”', '„', '«', '‘', '’']) {
        Some("write straight quotes, as in name = \"arm\"")
    } else if starts("invalid unquoted key") || message.contains("expected letters") {
        Some("a key consists of ASCII letters, digits, `-` and `_`")
    } else if starts("carriage return must") {
        Some(
            "save the file with line feeds at the ends of its lines; it has carriage returns alone",
        )
    } else if rest.starts_with('{') && text.get(..span.start).unwrap_or_default().trim().is_empty()
    {
        Some("the file appears to be JSON; a robot file is TOML, with lines such as `format = 1`")
    } else if starts("unexpected key or value") {
        Some("write one `key = value` per line")
    } else if starts("duplicate key") && line_of(text, span.start).starts_with('[') {
        Some(repeated_table(line_of(text, span.start)))
    } else if starts("duplicate key") {
        Some("the table already contains this key: keep one of them")
    } else if starts("string values must be quoted") {
        Some(
            "put names and expressions in quotes, such as \"l1/2\", and separate the entries of a list by commas",
        )
    } else if starts("missing escaped value") {
        Some(
            "write a backslash as `\\\\`, or put the text in single quotes, which take it \
            literally",
        )
    } else if starts("invalid basic string") || starts("invalid literal string") {
        Some(
            "close the string with the quote that opens it, on the same line; control characters must be escaped",
        )
    } else if starts("missing comma between") {
        Some("separate the entries of an inline table by commas, and close it with `}`")
    } else if starts("unclosed") {
        Some("add the missing closing bracket or quotation mark")
    } else if NUMBER.into_iter().any(starts) {
        Some("write a number as `12`, `-0.35` or `1.5e-3`")
    } else if message.contains("recurs") {
        Some("use at most four levels, which is enough for every robot file")
    } else {
        None
    }
}
