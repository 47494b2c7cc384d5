//! Identifiers of Rust from any text.

use proc_macro2::{Ident, Span};
use rustc_hash::FxHashSet;

/// The words that cannot be identifiers, or mean something else in the places where names stand.
const RESERVED: [&str; 56] = [
    "Self",
    "abstract",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "const",
    "continue",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "let",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "struct",
    "super",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "union",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
    "macro_rules",
    "raw",
    "safe",
];

/// Gives names in one scope: each is an identifier, and none is given twice.
#[derive(Clone, Debug, Default)]
pub(super) struct Namer {
    taken: FxHashSet<String>,
}

impl Namer {
    /// A namer whose scope already has some names.
    pub(super) fn with(names: &[&str]) -> Namer {
        Namer { taken: names.iter().map(|name| (*name).to_owned()).collect() }
    }

    /// An identifier as near to `text` as can be.
    pub(super) fn name(&mut self, text: &str) -> Ident {
        let base = identifier(text);
        let mut name = base.clone();
        let mut number = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{base}_{number}");
            number += 1;
        }
        Ident::new(&name, Span::call_site())
    }
}

/// ASCII letters, digits and underscores of the text; a keyword gets an underscore.
#[must_use]
pub fn identifier(text: &str) -> String {
    let mut name = String::new();
    for character in text.chars().take(64) {
        match character {
            'a'..='z' | 'A'..='Z' | '0'..='9' => name.push(character),
            // Other letters by their code point: few enough that nobody needs a table.
            _ if character.is_alphabetic() => {
                name.push_str(&format!("u{:x}", u32::from(character)));
            }
            _ if name.ends_with('_') || name.is_empty() => {}
            _ => name.push('_'),
        }
    }
    while name.ends_with('_') {
        name.pop();
    }
    if name.is_empty() || name.starts_with(|first: char| first.is_ascii_digit()) {
        name.insert(0, 'n');
    }
    if RESERVED.contains(&name.as_str()) {
        name.push('_');
    }
    name
}

/// `link_wrenches` becomes `LinkWrenches`.
pub(super) fn type_name(text: &str) -> String {
    let words = identifier(text);
    let mut name = String::new();
    for word in words.split('_') {
        let mut characters = word.chars();
        name.extend(characters.next().map(|first| first.to_ascii_uppercase()));
        name.push_str(characters.as_str());
    }
    if RESERVED.contains(&name.as_str()) {
        name.push('_');
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_becomes_an_identifier() {
        for (text, expected) in [
            ("q1", "q1"),
            ("M_l5", "M_l5"),
            ("type", "type_"),
            ("}fn x(){}", "fn_x"),
            ("5th joint", "n5th_joint"),
            ("", "n"),
            ("___", "n"),
            ("θ1", "u3b81"),
            ("a\nb", "a_b"),
            ("elbow-yaw", "elbow_yaw"),
        ] {
            assert_eq!(identifier(text), expected);
            assert!(syn::parse_str::<Ident>(&identifier(text)).is_ok(), "{text}");
        }
        assert_eq!(type_name("link_wrenches"), "LinkWrenches");
        assert_eq!(type_name("self"), "Self_");
    }

    #[test]
    fn names_are_given_once() {
        let mut namer = Namer::with(&["q"]);
        assert_eq!(namer.name("q"), "q_2");
        assert_eq!(namer.name("q 2"), "q_2_2");
        assert_eq!(namer.name("q"), "q_3");
    }
}
