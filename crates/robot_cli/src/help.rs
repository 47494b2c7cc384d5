//! The help of the command line, as wide as the terminal, with styles and useful tips.

use clap::builder::styling::{AnsiColor, Style};
use clap::builder::{StyledStr, Styles};
use clap::error::{ContextKind, ContextValue};
use clap::{Command, CommandFactory};

use crate::Cli;
use crate::screen::Screen;

/// The heading under which options about the model are listed, after those of the command.
pub(crate) const MODEL: &str = "Model options";

/// The width of help that is not shown on a terminal.
const USUAL: usize = 100;
/// The smallest width; narrower terminals break lines themselves.
const NARROWEST: usize = 40;

const HEADING: Style = AnsiColor::Green.on_default().bold();
const LITERAL: Style = AnsiColor::Cyan.on_default().bold();

const STYLES: Styles = Styles::styled()
    .header(HEADING)
    .usage(HEADING)
    .literal(LITERAL)
    .placeholder(AnsiColor::Cyan.on_default());

/// Makes the command line, with help for a terminal or for other output.
pub(crate) fn command(screen: Option<Screen>) -> Command {
    let columns = screen.and_then(|screen| screen.columns).unwrap_or(USUAL);
    shaped(Cli::command(), columns.clamp(NARROWEST, USUAL))
}

fn shaped(command: Command, columns: usize) -> Command {
    let after = command.get_after_help().map(|text| after(&text.to_string(), columns));
    let command = command.term_width(columns).styles(STYLES);
    let command = match after {
        Some(after) => command.after_help(StyledStr::from(after)),
        None => command,
    };
    command.mut_subcommands(|command| shaped(command, columns))
}

/// Wraps the text after the options: headings, examples and paragraphs. Text before them has its own line breaks.
fn after(text: &str, columns: usize) -> String {
    let mut shown: Vec<String> = vec![];
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let indent = indent(line);
        let is_definition = line.trim_start().starts_with(|c: char| c.is_ascii_digit());
        if line.is_empty() {
            shown.push(String::new());
        } else if line.ends_with(':') && indent == 0 && line.len() < USUAL / 2 {
            shown.push(format!("{HEADING}{line}{HEADING:#}"));
        } else if indent > 0 && !is_definition {
            shown.push(example(line, columns));
        } else {
            let mut whole = line.to_owned();
            let goes_on = |next: &&str| {
                !next.is_empty()
                    && if indent == 0 {
                        self::indent(next) == 0
                    } else {
                        self::indent(next) > indent
                    }
            };
            while let Some(next) = lines.next_if(|next| goes_on(next)) {
                whole += " ";
                whole += next.trim_start();
            }
            // In `  0  done`, further lines start below `done`.
            let hanging = if is_definition { indent + 3 } else { 0 };
            shown.push(wrapped(&whole, columns, hanging));
        }
    }
    shown.join("\n")
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// Wraps a text into lines of at most `columns` columns. The first `hanging` bytes are the start of the first line, and
/// further lines are indented by this length. Longer words are not broken.
pub(crate) fn wrapped(text: &str, columns: usize, hanging: usize) -> String {
    let (start, words) = text.split_at_checked(hanging).unwrap_or(("", text));
    let (mut lines, mut line, mut has_words) = (vec![], start.to_owned(), false);
    for word in words.split_whitespace() {
        if has_words && line.chars().count() + 1 + word.chars().count() > columns {
            lines.push(std::mem::replace(&mut line, " ".repeat(hanging)));
            has_words = false;
        }
        if has_words {
            line.push(' ');
        }
        line.push_str(word);
        has_words = true;
    }
    lines.push(line);
    lines.join("\n")
}

/// Breaks a shell command before options, with `\` at the ends of lines, if it is too long.
fn example(line: &str, columns: usize) -> String {
    const AGAIN: &str = " \\\n      ";
    let (mut shown, mut column) = (String::new(), 0);
    for part in parts(line) {
        let width = part.chars().count();
        // Room for ` \`.
        if column > 0 && column + width + 2 > columns {
            shown.push_str(AGAIN);
            shown.push_str(part.trim_start());
            column = 5 + width;
        } else {
            shown.push_str(part);
            column += width;
        }
    }
    shown
}

/// Splits a line before options that are outside of quotes.
fn parts(line: &str) -> Vec<&str> {
    let (mut parts, mut start, mut quoted) = (vec![], 0, false);
    for (place, character) in line.char_indices() {
        quoted ^= character == '"';
        if !quoted && place > start && line[place..].starts_with(" -") && place > indent(line) {
            parts.push(&line[start..place]);
            start = place;
        }
    }
    parts.push(&line[start..]);
    parts
}

/// Removes the tip that suggests using an unknown option as a value. If it is the value of an option, adds a tip with
/// this option.
pub(crate) fn with_tips(
    mut error: clap::Error,
    arguments: &[std::ffi::OsString],
    command: &Command,
) -> clap::Error {
    let Some(ContextValue::String(argument)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    let known = values(argument.trim_start_matches('-'), arguments, command);
    let tips = match error.remove(ContextKind::Suggested) {
        Some(ContextValue::StyledStrs(tips)) => tips,
        _ => vec![],
    };
    let mut tips: Vec<StyledStr> =
        tips.into_iter().filter(|tip| !tip.to_string().contains("as a value")).collect();
    tips.extend(
        known
            .iter()
            .map(|known| StyledStr::from(format!("did you mean '{LITERAL}{known}{LITERAL:#}'?"))),
    );
    let is_file = |name: &&std::ffi::OsString| {
        name.to_string_lossy().starts_with('-')
            && name.len() > 1
            && std::path::Path::new(name).is_file()
    };
    tips.extend(arguments.iter().skip(1).filter(is_file).map(|name| {
        let name = robot_build::shown(std::path::Path::new(name));
        StyledStr::from(format!("write the file as '{LITERAL}./{name}{LITERAL:#}'"))
    }));
    if !tips.is_empty() {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
    error
}

/// The options of the given command that can have this value, such as `--format latex`.
fn values(value: &str, arguments: &[std::ffi::OsString], command: &Command) -> Vec<String> {
    let named =
        |name: &&std::ffi::OsString| name.to_str().and_then(|name| command.find_subcommand(name));
    let Some(command) = arguments.iter().skip(1).find_map(|name| named(&name)) else {
        return vec![];
    };
    let options = command.get_opts().filter_map(|option| {
        let values = option.get_value_parser().possible_values()?;
        let is_value = values.into_iter().any(|known| known.matches(value, false));
        is_value.then(|| Some(format!("--{} {value}", option.get_long()?)))?
    });
    options.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_are_wrapped_and_examples_continued() {
        let text = "Example:\n  robot-symbolic simulate a.toml --torque \"2 = -40 - 8\" --time 3\n\nOne two\nthree \
                    four five.\n  0  done or\n     wrong";
        let plain = StyledStr::from(after(text, 40)).to_string();
        assert_eq!(
            plain,
            "Example:\n  robot-symbolic simulate a.toml \\\n      --torque \"2 = -40 - 8\" --time 3\n\nOne two \
             three four five.\n  0  done or wrong"
        );
        assert_eq!(wrapped("  0  done or wrong", 12, 5), "  0  done or\n     wrong");
        assert_eq!(wrapped("one two three", 7, 0), "one two\nthree");
    }

    #[test]
    fn a_command_is_split_before_options_outside_of_quotes() {
        for (line, expected) in [
            ("  a b", &["  a b"][..]),
            ("  a -b c --d", &["  a", " -b c", " --d"]),
            // After a quoted text, options count again.
            ("  a --b \"c -d\" -e \"f -g\" -h", &["  a", " --b \"c -d\"", " -e \"f -g\"", " -h"]),
            ("  -a -b", &["  -a", " -b"]),
            ("", &[""]),
        ] {
            assert_eq!(parts(line), expected, "{line}");
        }
        let line = "  robot-symbolic a.toml --torque \"2 = -40 - 8\" --time 3";
        assert_eq!(
            example(line, 50),
            "  robot-symbolic a.toml --torque \"2 = -40 - 8\" \\\n      --time 3"
        );
        // The last part ends two columns before the last, where ` \\` has room.
        for (columns, breaks) in [(17, false), (16, true)] {
            let between = if breaks { " \\\n      " } else { " " };
            assert_eq!(example("  a --bcd --efg", columns), format!("  a --bcd{between}--efg"));
        }
    }

    #[test]
    fn no_line_of_help_is_longer_than_the_terminal() {
        for columns in [60, 80, 100] {
            let mut whole = command(Some(Screen { columns: Some(columns), colors: true }));
            whole.build();
            for command in whole.get_subcommands_mut() {
                let help = command.render_long_help().to_string();
                for line in help.lines().filter(|line| line.chars().count() > columns) {
                    // Single words and shell commands are not broken.
                    let words = line.split_whitespace().count();
                    let is_usage = line.starts_with("Usage:");
                    let is_text = is_usage
                        || line.starts_with("  [{")
                        || line.starts_with("  robot-symbolic torques");
                    assert!(words <= 2 || is_text, "{columns} columns: {line}");
                }
            }
        }
    }
}
