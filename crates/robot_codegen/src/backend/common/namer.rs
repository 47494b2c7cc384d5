//! Names in printed code, made from any text.

use rustc_hash::FxHashSet;

use crate::module::Module;

/// Words that cannot be names, in lists that are each sorted.
pub type Reserved = [&'static [&'static str]];

/// Makes the names of one scope: each is an identifier that is not reserved in the language, and no two are equal.
#[derive(Clone, Debug)]
pub struct Namer {
    reserved: &'static Reserved,
    taken: FxHashSet<String>,
}

impl Namer {
    /// Makes a namer for a language with these reserved words, whose scope already has the names in `taken`.
    #[must_use]
    pub fn new(reserved: &'static Reserved, taken: &[&str]) -> Namer {
        Namer { reserved, taken: taken.iter().map(|name| (*name).to_owned()).collect() }
    }

    /// Makes an identifier that is as close to `text` as possible.
    pub fn name(&mut self, text: &str) -> String {
        let base = identifier(text, self.reserved);
        let mut name = base.clone();
        let mut number = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{base}_{number}");
            number += 1;
        }
        name
    }

    /// Makes an identifier for each of several texts. A text that is a valid identifier is its own name, whatever the
    /// other texts are: if `match_` is among them, the reserved word `match` becomes `match__2`, in any order.
    pub fn names<'t>(&mut self, texts: impl IntoIterator<Item = &'t str>) -> Vec<String> {
        let texts = texts.into_iter().map(|text| {
            let fits = identifier(text, self.reserved) == text;
            (text, fits && self.taken.insert(text.to_owned()))
        });
        let texts: Vec<(&str, bool)> = texts.collect();
        let name = |(text, stands): (&str, bool)| {
            if stands { text.to_owned() } else { self.name(text) }
        };
        texts.into_iter().map(name).collect()
    }
}

/// Makes an identifier of the ASCII letters, digits and underscores of a text; a reserved word gets an underscore.
#[must_use]
pub fn identifier(text: &str, reserved: &Reserved) -> String {
    let mut name = String::new();
    for character in text.chars().take(64) {
        match character {
            'a'..='z' | 'A'..='Z' | '0'..='9' => name.push(character),
            // Other letters are replaced with their code points; they are too rare to need a table.
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
    unreserved(name, reserved)
}

/// Makes the name of a type: `link_wrenches` becomes `LinkWrenches`.
#[must_use]
pub fn type_name(text: &str, reserved: &Reserved) -> String {
    let words = identifier(text, reserved);
    let mut name = String::new();
    for word in words.split('_') {
        let mut characters = word.chars();
        name.extend(characters.next().map(|first| first.to_ascii_uppercase()));
        name.push_str(characters.as_str());
    }
    unreserved(name, reserved)
}

/// Adds an underscore to a reserved name.
pub(in crate::backend) fn unreserved(mut name: String, reserved: &Reserved) -> String {
    if reserved.iter().any(|words| words.binary_search(&name.as_str()).is_ok()) {
        name.push('_');
    }
    name
}

/// Makes names for the fields of a model: a field that copies a parameter has the parameter's name; the others are
/// `k1`, `k2` and so on, without those that are names of parameters.
pub fn field_names(module: &Module, namer: &mut Namer) -> Vec<String> {
    let parameters = namer.names(module.parameters.iter().map(|one| one.name.as_str()));
    let mut count = 0;
    let name = |field: usize| parameters.get(module.field_parameter(field)?).cloned();
    let mut numbered = || {
        count += 1;
        namer.name(&format!("k{count}"))
    };
    let fields = 0..module.constructor.results().len();
    fields.map(|field| name(field).unwrap_or_else(&mut numbered)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RESERVED: &Reserved = &[&["Self", "self"], &["match", "n", "type"]];

    #[test]
    fn any_text_becomes_an_identifier() {
        for (text, expected) in [
            ("q1", "q1"),
            ("M_l5", "M_l5"),
            ("type", "type_"),
            ("}fn x(){}", "fn_x"),
            ("5th joint", "n5th_joint"),
            ("", "n_"),
            ("___", "n_"),
            ("θ1", "u3b81"),
            ("a\nb", "a_b"),
            ("elbow-yaw", "elbow_yaw"),
        ] {
            assert_eq!(identifier(text, RESERVED), expected);
        }
        assert_eq!(type_name("link_wrenches", RESERVED), "LinkWrenches");
        assert_eq!(type_name("self", RESERVED), "Self_");
    }

    #[test]
    fn names_are_given_once() {
        let mut namer = Namer::new(RESERVED, &["q"]);
        assert_eq!(namer.name("q"), "q_2");
        assert_eq!(namer.name("q 2"), "q_2_2");
        assert_eq!(namer.name("q"), "q_3");
    }

    #[test]
    fn names_that_can_stand_stay_whatever_the_others_are() {
        let given = |texts: &[&str]| {
            Namer::new(RESERVED, &["taken"]).names(texts.iter().copied()).join(" ")
        };
        assert_eq!(given(&["match", "self", "a"]), "match_ self_ a");
        assert_eq!(
            given(&["tool-0", "match", "tool_0", "taken"]),
            "tool_0_2 match_ tool_0 taken_2"
        );
        assert_eq!(given(&["a", "a", "a_2"]), "a a_3 a_2");
    }
}
