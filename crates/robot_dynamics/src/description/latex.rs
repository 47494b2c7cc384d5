//! LaTeX of a symbol, from a small grammar: nothing that passes can do more than print.

use super::reader::Reader;
use super::strings;
use super::table::Value;
use crate::diagnostic::{Diagnostic, code};

const MAX_LENGTH: usize = 64;
const MAX_DEPTH: usize = 8;

/// Commands that stand for one sign.
const SIGNS: &[&str] = &[
    "alpha",
    "beta",
    "gamma",
    "delta",
    "epsilon",
    "varepsilon",
    "zeta",
    "eta",
    "theta",
    "vartheta",
    "iota",
    "kappa",
    "lambda",
    "mu",
    "nu",
    "xi",
    "pi",
    "varpi",
    "rho",
    "varrho",
    "sigma",
    "varsigma",
    "tau",
    "upsilon",
    "phi",
    "varphi",
    "chi",
    "psi",
    "omega",
    "Gamma",
    "Delta",
    "Theta",
    "Lambda",
    "Xi",
    "Pi",
    "Sigma",
    "Upsilon",
    "Phi",
    "Psi",
    "Omega",
    "ell",
    "star",
    "ast",
    "prime",
    "circ",
    "bullet",
    "dagger",
    "infty",
    "perp",
    "parallel",
];

/// Commands that take a group.
const ACCENTS: &[&str] = &[
    "bar",
    "hat",
    "tilde",
    "vec",
    "dot",
    "ddot",
    "check",
    "breve",
    "overline",
    "underline",
    "widehat",
    "widetilde",
    "mathrm",
    "mathbf",
    "mathit",
    "mathsf",
    "mathcal",
    "boldsymbol",
];

/// A place in the text where it leaves the grammar, and why.
type Fault = (std::ops::Range<usize>, &'static str);

impl Reader<'_> {
    /// The LaTeX of a symbol.
    pub(super) fn latex(&mut self, value: Value<'_>) -> Option<String> {
        let text = self.string(value, "the LaTeX of a symbol in quotes")?;
        let Err((range, reason)) = check(text) else {
            return Some(text.to_string());
        };
        let span = strings::place(self.text, &value.span(), text, range);
        self.report(
            Diagnostic::error(code::LATEX, "this is not LaTeX of a symbol")
                .at(&span, reason)
                .because("it is printed as it is, and LaTeX is a programming language")
                .help(
                    "use letters, digits, `_`, `^`, `{…}`, Greek letters such as `\\theta`, and \
                     accents such as `\\bar{x}`; in a basic string each backslash is written `\\\\`",
                ),
        );
        None
    }
}

/// What the grammar needs to know of the group that it is in.
#[derive(Clone, Copy, Default)]
struct Group {
    start: usize,
    /// Something that an index may belong to has been seen.
    base: bool,
    lower: bool,
    upper: bool,
}

/// Accepts `item*`, where an item is a letter, digit, sign or group, with at most one `_` and one
/// `^` after it, each followed by an item.
fn check(text: &str) -> Result<(), Fault> {
    if text.is_empty() {
        return Err((0..0, "empty"));
    }
    if text.len() > MAX_LENGTH {
        return Err((0..text.len(), "longer than 64 bytes"));
    }
    let mut groups = vec![Group::default()];
    // An accent or an index waits for its argument.
    let mut waiting: Option<Fault> = None;
    let mut position = 0;
    while let Some(byte) = text.as_bytes().get(position).copied() {
        let start = position;
        position = token_end(text, start);
        let here = start..position;
        let token = text.get(here.clone()).unwrap_or_default();
        let depth = groups.len();
        let Some(group) = groups.last_mut() else {
            return Err((here, "closes nothing"));
        };
        match byte {
            b'{' => {
                item(group, waiting.take().is_some());
                if depth > MAX_DEPTH {
                    return Err((here, "too many groups within groups"));
                }
                groups.push(Group { start, ..Group::default() });
            }
            b'}' if waiting.is_some() || depth == 1 || !group.base => {
                return Err((here, "a group ends without content, or closes nothing"));
            }
            b'}' => {
                groups.pop();
            }
            b'_' | b'^' => {
                let taken = if byte == b'_' { &mut group.lower } else { &mut group.upper };
                if waiting.is_some() || *taken || !group.base {
                    return Err((here, "a second index, or one that belongs to nothing"));
                }
                *taken = true;
                waiting = Some((here, "an index without content"));
            }
            b'\\' if ACCENTS.contains(&token.get(1..).unwrap_or_default()) => {
                item(group, waiting.take().is_some());
                if text.as_bytes().get(position) != Some(&b'{') {
                    return Err((here, "takes a group `{…}`"));
                }
                waiting = Some((here, "takes a group `{…}`"));
            }
            b'\\' if !SIGNS.contains(&token.get(1..).unwrap_or_default()) => {
                return Err((here, "this command is not allowed"));
            }
            b' ' if waiting.is_none() => {}
            _ if byte == b'\\' || byte.is_ascii_alphanumeric() || b"*',+-".contains(&byte) => {
                item(group, waiting.take().is_some());
            }
            _ => return Err((here, "this character is not allowed")),
        }
    }
    match (waiting, groups.as_slice()) {
        (Some(fault), _) => Err(fault),
        (None, [whole]) if whole.base => Ok(()),
        (None, [_]) => Err((0..text.len(), "nothing to print")),
        (None, [.., open]) => Err((open.start..open.start + 1, "never closed")),
        (None, []) => Ok(()),
    }
}

/// An item of a group: a new base, or the argument of what waited for it.
fn item(group: &mut Group, argument: bool) {
    if !argument {
        group.lower = false;
        group.upper = false;
    }
    group.base = true;
}

fn token_end(text: &str, start: usize) -> usize {
    let rest = text.get(start..).unwrap_or_default();
    let letters = |part: &str| part.bytes().take_while(u8::is_ascii_alphabetic).count();
    match rest.strip_prefix('\\') {
        Some(name) if letters(name) > 0 => start + 1 + letters(name),
        Some(name) => start + 1 + name.chars().next().map_or(0, char::len_utf8),
        None => start + rest.chars().next().map_or(1, char::len_utf8),
    }
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn symbols_pass() {
        for text in [
            "l_1",
            "J_x^{*5}",
            "F_{l_x}^6",
            "\\theta_{12}",
            "\\bar{J}_{z}^{*}",
            "b_5",
            "q'",
            "\\mathrm{I}_{xx}",
            "{J_x}^2",
            "\\ell_1",
            "m_{1,2}",
            "\\alpha\\beta_1",
            "J _x",
        ] {
            assert_eq!(check(text), Ok(()), "{text}");
        }
    }

    #[test]
    fn programs_and_errors_do_not() {
        for text in [
            "",
            "\\input{x}",
            "\\write18{x}",
            "\\def\\x{y}",
            "\\catcode",
            "a_",
            "a^",
            "_a",
            "a_b_c",
            "a^b^c",
            "{",
            "}",
            "{}",
            "a}{b",
            "a%b",
            "$a$",
            "a&b",
            "a#1",
            "a~b",
            "\\\\",
            "\\bar x",
            "\\bar",
            "a_{}",
            "a_ b",
            "\\",
            "é",
            "a\nb",
            "\\^a",
            "\u{202e}",
            "{{{{{{{{{{a}}}}}}}}}}",
            " ",
        ] {
            assert!(check(text).is_err(), "{text}");
        }
        assert!(check(&"a".repeat(65)).is_err());
    }
}
