//! The check that every name in a file must pass.
//!
//! Only names that pass it reach generated code, equations and file names. Identifiers name robots, parameters and
//! wrench components; labels name links, joints and frames.

use super::reader::{Named, Reader};
use super::table::Value;
use crate::diagnostic::{Diagnostic, Span, code, quote};
use crate::variable::{JointVariable, WRENCH};

/// The maximum length of a name.
pub(super) const MAX_NAME: usize = 64;

/// Names that are reserved because equations and states use them, and the names of functions in formulas.
const OWN: &[&str] = &[
    "t", WRENCH, "abs", "acos", "asin", "atan", "atan2", "cos", "exp", "log", "pi", "pow", "sign",
    "sin", "sqrt", "tan", "tanh",
];

/// The kind of a name, which determines the characters that it may have.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// `[A-Za-z_][A-Za-z0-9_]{0,63}` without another meaning in a robot file or an equation.
    Identifier,
    /// `[A-Za-z0-9_][A-Za-z0-9_.-]{0,63}` other than `base`.
    Label,
}

impl Reader<'_> {
    /// Reads a string of the file as a name; `what` is the kind of thing that it names.
    pub(super) fn name(&mut self, value: Value<'_>, what: &str, kind: Kind) -> Option<Named> {
        let text = self.string(value, &format!("the name of {what} in quotes"))?;
        self.check_name(text, &value.span(), what, kind)
    }

    /// Checks a key or string of the file as a name.
    pub(super) fn check_name(
        &mut self,
        text: &str,
        span: &Span,
        what: &str,
        kind: Kind,
    ) -> Option<Named> {
        let shape = match kind {
            Kind::Identifier => is_identifier(text),
            Kind::Label => is_label(text),
        };
        if !shape {
            self.report(misshapen(text, span, what, kind));
            return None;
        }
        let owner = match kind {
            Kind::Identifier => reserved(text),
            Kind::Label => (text == "base").then(|| "the base frame".into()),
        };
        if let Some(owner) = owner {
            // `q_1` would be printed like the variable `q1`.
            let other = match kind {
                Kind::Identifier => format!("{text}_a"),
                Kind::Label => format!("{text}_1"),
            };
            self.report(
                Diagnostic::error(code::RESERVED, format!("`{text}` cannot be the name of {what}"))
                    .at(span, format!("reserved: {owner}"))
                    .help(format!("choose another name, such as `{other}`")),
            );
            return None;
        }
        Some(Named { name: text.to_owned(), span: span.clone() })
    }
}

pub(super) fn is_identifier(text: &str) -> bool {
    let mut bytes = text.bytes();
    let first = |byte: u8| byte.is_ascii_alphabetic() || byte == b'_';
    text.len() <= MAX_NAME
        && bytes.next().is_some_and(first)
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && text.bytes().any(|byte| byte != b'_')
}

fn is_label(text: &str) -> bool {
    let mut bytes = text.bytes();
    let first = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    text.len() <= MAX_NAME
        && bytes.next().is_some_and(first)
        && bytes.all(|byte| first(byte) || byte == b'.' || byte == b'-')
}

fn misshapen(text: &str, span: &Span, what: &str, kind: Kind) -> Diagnostic {
    let label = if text.is_empty() {
        "empty".to_owned()
    } else if text.len() > MAX_NAME {
        format!("{} bytes long; at most {MAX_NAME}", text.len())
    } else {
        "not a valid name".to_owned()
    };
    let rule = match kind {
        Kind::Identifier => {
            "use letters, digits and `_`, not beginning with a digit and not `_` alone, as in `l_5`; the key \
             `latex` of a parameter sets how it is printed"
        }
        Kind::Label => "use letters, digits, `_`, `-` and `.`, not beginning with `-` or `.`",
    };
    Diagnostic::error(code::NAME, format!("`{}` cannot be the name of {what}", quote(text)))
        .at(span, label)
        .because("names are used in equations, code and file names")
        .help(rule)
}

/// The reason why a name is reserved; `None` if it is not. Keywords of the languages in which code is generated are not
/// reserved: the printers rename them.
pub(super) fn reserved(name: &str) -> Option<String> {
    if OWN.contains(&name) || JointVariable::from_name(name).is_some() {
        return Some("a symbol of the equations".to_owned());
    }
    const COORDINATE: &str = "a joint's position, velocity, acceleration or torque";
    // `q_1` is printed like `q1`.
    let plain: String = name.chars().filter(|letter| *letter != '_').collect();
    match is_coordinate(&plain) {
        true if plain == name => Some(COORDINATE.to_owned()),
        true => Some(format!("`{plain}` is {COORDINATE}")),
        false => None,
    }
}

/// Whether a name is that of a joint variable in equations, such as `q1`, `qd1`, `qdd1`, `Q1` or `tau1`.
pub(super) fn is_coordinate(name: &str) -> bool {
    let letters = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    letters.len() < name.len() && (letters == "Q" || JointVariable::from_name(letters).is_some())
}

/// A set of names of one kind, which must be unique.
pub(super) struct Registry {
    what: &'static str,
    /// Whether names that differ only in case or underscores count as different.
    exact: bool,
    names: Vec<Named>,
    folded: std::collections::BTreeMap<String, usize>,
}

impl Registry {
    pub(super) fn new(what: &'static str) -> Registry {
        Registry {
            what,
            exact: false,
            names: Vec::new(),
            folded: std::collections::BTreeMap::new(),
        }
    }

    /// Creates a registry in which names may differ only in case or underscores.
    pub(super) fn exact(what: &'static str) -> Registry {
        Registry { exact: true, ..Registry::new(what) }
    }

    /// Adds a name. Returns a diagnostic if the registry already contains the name, or one that differs only in case or
    /// underscores.
    pub(super) fn add(&mut self, named: &Named) -> Option<Diagnostic> {
        let folded: String = if self.exact {
            named.name.clone()
        } else {
            named.name.replace('_', "").to_lowercase()
        };
        let Some(first) = self.folded.get(&folded).and_then(|at| self.names.get(*at)) else {
            self.folded.insert(folded, self.names.len());
            self.names.push(named.clone());
            return None;
        };
        let (what, name, other) = (self.what, &named.name, &first.name);
        let diagnostic = if name == other {
            Diagnostic::error(code::DUPLICATE, format!("the {what} `{name}` is defined twice"))
                .at(&named.span, "defined again here")
        } else {
            let message =
                format!("the names of the {what}s `{other}` and `{name}` are too similar");
            Diagnostic::error(code::ALIKE, message)
                .at(&named.span, "differs only in case or underscores")
                .because("readers confuse them, some file systems ignore case, and typeset equations have names without underscores")
        };
        let help = match (name == other, self.what) {
            (false, "symbol") => "rename one of them; its key `latex` can print any letter",
            _ => "rename one of them",
        };
        Some(diagnostic.and_at(&first.span, "first defined here").help(help))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_and_labels_have_their_shapes() {
        for name in ["l1", "_x", "Jx1", "a_very_long_name_0"] {
            assert!(is_identifier(name), "{name}");
        }
        let [most, long] = [64, 65].map(|length| "x".repeat(length));
        assert!(is_identifier(&most) && is_label(&most));
        for name in ["", "_", "__", "1a", "a-b", "é", "a b", "}fn x(){}", "a\u{202e}", &long] {
            assert!(!is_identifier(name), "{name}");
        }
        for label in ["1", "ee_link", "wrist_3_link-tool0_fixed_joint", "a.b"] {
            assert!(is_label(label), "{label}");
        }
        for label in ["", ".a", "-a", "a b", "a/b", "../x", "a\n", &long] {
            assert!(!is_label(label), "{label}");
        }
        let told = |name: &str| {
            let found = misshapen(name, &(0..1), "a link", Kind::Label);
            found.primary.map(|place| place.text).unwrap_or_default()
        };
        assert_eq!(told(&long), "65 bytes long; at most 64");
        assert_eq!(told(&long.replacen("xx", "-", 1)), "not a valid name");
        assert_eq!(told(""), "empty");
    }

    #[test]
    fn words_of_equations_are_reserved_and_those_of_code_are_not() {
        for name in ["q1", "qdd12", "Q3", "sin", "t", "pi", "tau", "wrench"] {
            assert!(reserved(name).is_some(), "{name}");
        }
        let of_code = ["fn", "Self", "lambda", "double", "end", "f64", "parameters"];
        for name in ["c1", "s1", "q1x", "g", "Fx6", "qx", "m", "T"].into_iter().chain(of_code) {
            assert!(reserved(name).is_none(), "{name}");
        }
    }
}
