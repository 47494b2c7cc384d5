//! Robot files with hostile names and texts, and checks of the code that is printed from them.

use std::fmt::Write as _;

use robot_build::languages::{Language, package_of};
use robot_build::{Options, Scalar, Source, programs};

/// A mark in free texts of the robot files, which must not occur in code outside of comments and strings.
pub(crate) const MARK: &str = "qZ7mark";

/// Names that any robot can have.
pub(crate) const PLAIN: [&str; 8] =
    ["robot1", "mass1", "length1", "first1", "second1", "joint1", "joint2", "both1"];

/// The parts of a robot file that its author chooses freely.
#[derive(Debug, Default)]
pub(crate) struct Chosen {
    /// The names of the robot, two parameters, two links, two joints and a bundle.
    pub(crate) names: [String; 8],
    /// The description and the meanings of the two parameters. [`MARK`] is added to them.
    pub(crate) texts: [String; 3],
}

impl Chosen {
    /// Replaces names that a robot file cannot have with plain names, and such texts with empty ones.
    pub(crate) fn accepted(self) -> Chosen {
        let mut accepted = Chosen { names: PLAIN.map(str::to_owned), ..Chosen::default() };
        for (place, text) in self.texts.into_iter().enumerate() {
            accepted.texts[place] = text;
            if !accepted.is_robot() {
                accepted.texts[place].clear();
            }
        }
        for (place, name) in self.names.into_iter().enumerate() {
            let plain = std::mem::replace(&mut accepted.names[place], name);
            if !accepted.is_robot() {
                accepted.names[place] = plain;
            }
        }
        accepted
    }

    fn is_robot(&self) -> bool {
        let source = Source { name: "hostile.toml".to_owned(), text: self.file() };
        programs(&source, &Options::default()).is_ok()
    }

    /// Prints the robot file.
    pub(crate) fn file(&self) -> String {
        let names = self.names.each_ref().map(|name| quoted(name));
        let [robot, mass, length, first, second, joint, other, bundle] = names;
        let texts = self.texts.each_ref();
        let [about, mass_doc, length_doc] =
            texts.map(|text| quoted(&format!("{MARK}{text}{MARK}\n{MARK} {text}")));
        format!(
            "format = 1
[robot]
name = {robot}
description = {about}
gravity = [0, -9.81, 0]
[parameters]
{mass} = {{ value = 2.0, unit = \"kg\", doc = {mass_doc} }}
{length} = {{ value = 0.5, unit = \"m\", doc = {length_doc} }}
[[link]]
name = {first}
joint = {{ name = {joint}, type = \"revolute\", axis = \"z\" }}
mass = {mass}
center_of_mass = [{length}, 0, 0]
inertia = {{ zz = 0.3, unchecked = true }}
[[link]]
name = {second}
joint = {{ name = {other}, type = \"prismatic\", axis = \"x\" }}
mass = 1.5
center_of_mass = [0.25, 0, 0]
inertia = {{ zz = 0.2, unchecked = true }}
[code]
functions = [\"gravity\"]
[code.bundles]
{bundle} = [\"gravity\", \"energies\"]
"
        )
    }
}

/// Prints a TOML string.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => {
                let _ = write!(quoted, "\\{character}");
            }
            _ if character.is_control() => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(character));
            }
            _ => quoted.push(character),
        }
    }
    quoted.push('"');
    quoted
}

/// Prints the package of a robot in every language; returns whether the file is accepted as a robot.
///
/// # Panics
///
/// A text of the file became code, or a description is not JSON.
pub(crate) fn in_every_language(chosen: &Chosen) -> bool {
    let source = Source { name: "hostile.toml".to_owned(), text: chosen.file() };
    let Ok(found) = programs(&source, &Options::default()) else { return false };
    for language in Language::ALL {
        let single = [Language::Wgsl, Language::Arduino].contains(language);
        let scalar = if single { Scalar::F32 } else { Scalar::F64 };
        let options = Options { scalar, ..Options::default() };
        let files = package_of(&found, &source, &options, *language);
        let files = files.unwrap_or_else(|error| panic!("{}: {error}", language.name()));
        for file in files {
            let Some(text) = file.contents.text() else { continue };
            let place = format!("{}, {}\n{}", language.name(), file.path, chosen.file());
            assert!(is_portable(&file.path), "a name of a file: {place}");
            match file.path.rsplit_once('.').map_or("", |(_, ending)| ending) {
                "json" => {
                    let read: Result<serde_json::Value, _> = serde_json::from_str(text);
                    assert!(read.is_ok(), "{place}");
                }
                "md" => {
                    let fences = text.lines().filter(|line| line.trim_start().starts_with("```"));
                    assert_eq!(fences.count() % 2, 0, "{place}");
                }
                ending => {
                    let code = code(text, &Syntax::of(ending));
                    assert!(!code.contains(MARK), "{place}\n{code}");
                }
            }
        }
    }
    true
}

/// Whether a path has only plain characters.
fn is_portable(path: &str) -> bool {
    path.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+_-./".contains(&byte))
}

/// The syntax of comments and strings in a language.
struct Syntax {
    line_comment: &'static str,
    has_blocks: bool,
    quotes: &'static [&'static str],
}

impl Syntax {
    fn of(ending: &str) -> Syntax {
        let c = Syntax { line_comment: "//", has_blocks: true, quotes: &["\""] };
        match ending {
            "mjs" | "mts" => Syntax { quotes: &["\"", "'", "`"], ..c },
            "wgsl" => Syntax { has_blocks: true, quotes: &[], ..c },
            "py" => Syntax {
                line_comment: "#",
                has_blocks: false,
                quotes: &["\"\"\"", "'''", "\"", "'"],
            },
            "txt" | "toml" | "properties" => {
                Syntax { line_comment: "#", has_blocks: false, quotes: &["\""] }
            }
            "m" => Syntax { line_comment: "%", has_blocks: false, quotes: &["\""] },
            _ => c,
        }
    }
}

/// The text that is neither in a comment nor in a string.
fn code(text: &str, syntax: &Syntax) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(character) = rest.chars().next() {
        let quote = syntax.quotes.iter().find(|quote| rest.starts_with(**quote));
        let skipped = if rest.starts_with(syntax.line_comment) {
            rest.find('\n').unwrap_or(rest.len())
        } else if syntax.has_blocks && rest.starts_with("/*") {
            rest[2..].find("*/").map_or(rest.len(), |end| end + 4)
        } else if let Some(quote) = quote {
            string(rest, quote)
        } else {
            code.push(character);
            character.len_utf8()
        };
        rest = &rest[skipped..];
    }
    code
}

/// The length of a string literal that starts and ends with a quote.
fn string(text: &str, quote: &str) -> usize {
    let mut place = quote.len();
    while let Some(character) = text[place..].chars().next() {
        if text[place..].starts_with(quote) {
            return place + quote.len();
        }
        place += character.len_utf8();
        if character == '\\' {
            place += text[place..].chars().next().map_or(0, char::len_utf8);
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_strings_are_no_code() {
        let c = "a /* b */ c // d\ne \"f\\\" /* g\" h";
        assert_eq!(code(c, &Syntax::of("h")).split_whitespace().collect::<String>(), "aceh");
        let python = "a = '''b ' # \n''' # c\nd \"\"\"e\\\"\"\"\" f";
        assert_eq!(code(python, &Syntax::of("py")).split_whitespace().collect::<String>(), "a=df");
    }
}
