//! Names of symbols.

use std::ops::Range;

/// LaTeX given for a name that does more than print a symbol.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct LatexNameError {
    /// The offending bytes.
    pub span: Range<usize>,
    /// What is wrong, and what a name may hold.
    pub message: String,
}

const GREEK: [&str; 40] = [
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
];

/// Accents and fonts, which take what follows.
const ARGUMENT: [&str; 10] =
    ["dot", "ddot", "bar", "hat", "tilde", "vec", "mathrm", "mathit", "mathbf", "mathcal"];

/// Signs that names may hold.
const SIGNS: [&str; 11] =
    ["prime", "star", "ast", "ell", "circ", "infty", "parallel", "perp", "pm", "cdot", "nabla"];

/// The longest LaTeX that a name may have, in bytes.
const MAX_LENGTH: usize = 200;

/// Whether LaTeX given for a name only prints a symbol: letters, digits, `* ' + - , . ( )`, sub- and
/// superscripts, balanced braces, Greek letters, accents and fonts.
///
/// # Errors
///
/// The first thing that a name may not hold, with its place.
pub fn check_name(latex: &str) -> Result<(), LatexNameError> {
    let error = |span, message: &str| Err(LatexNameError { span, message: message.to_owned() });
    if latex.trim().is_empty() || latex.len() > MAX_LENGTH {
        return error(0..latex.len(), "a LaTeX name has 1 to 200 characters");
    }
    let bytes = latex.as_bytes();
    let (mut open, mut place) = (vec![], 0);
    while let Some(byte) = bytes.get(place) {
        let start = place;
        place += 1;
        match byte {
            b'\\' => {
                while bytes.get(place).is_some_and(u8::is_ascii_alphabetic) {
                    place += 1;
                }
                let command = latex.get(start + 1..place).unwrap_or_default();
                let after = latex.get(place..).unwrap_or_default().trim_start();
                if ARGUMENT.contains(&command)
                    && !after
                        .starts_with(|c: char| c.is_ascii_alphanumeric() || c == '{' || c == '\\')
                {
                    return error(start..place, "expected what the accent or font is for");
                }
                if !GREEK.contains(&command)
                    && !ARGUMENT.contains(&command)
                    && !SIGNS.contains(&command)
                {
                    let end = latex.ceil_char_boundary(place.max(start + 2).min(latex.len()));
                    return error(
                        start..end,
                        "a LaTeX name may hold Greek letters, accents (\\dot, \\bar, …) and fonts \
                         (\\mathrm, …), no other commands",
                    );
                }
            }
            b'{' => open.push(start),
            b'}' => {
                if open.pop().is_none() {
                    return error(start..place, "this `}` closes nothing");
                }
            }
            b'_' | b'^' => {
                let argument = bytes.get(place).copied();
                if !argument
                    .is_some_and(|byte| byte.is_ascii_alphanumeric() || b"{\\*+-".contains(&byte))
                {
                    return error(start..place, "expected what is set below or above");
                }
            }
            b' ' | b'*' | b'\'' | b'+' | b'-' | b',' | b'.' | b'(' | b')' => {}
            byte if byte.is_ascii_alphanumeric() => {}
            _ => {
                let end = latex.ceil_char_boundary(place);
                return error(
                    start..end,
                    "a LaTeX name may hold letters, digits, `* ' + - , . ( )`, `_`, `^` and braces",
                );
            }
        }
    }
    if latex.contains('\'') && latex.contains('^') {
        return error(0..latex.len(), "a prime is a superscript already; write `^{\\prime …}`");
    }
    match open.pop() {
        Some(start) => error(start..start + 1, "this `{` is not closed"),
        None if repeated_script(latex) => error(
            0..latex.len(),
            "two superscripts or two subscripts follow each other; use braces",
        ),
        None => Ok(()),
    }
}

/// The LaTeX of a symbol by its name: `q2` is `q_2`, `qd2` and `qdd2` are `\dot{q}_2` and
/// `\ddot{q}_2`, `l4` is `l_4`, `Jx1` is `J_{x1}`, `alpha1` is `\alpha_1`, `v_max` is
/// `v_{\mathrm{max}}`, `payload` is `\mathrm{payload}`.
#[must_use]
pub fn symbol_latex(name: &str) -> String {
    let mut parts = name.split(['_', '.']).filter(|part| !part.is_empty());
    let (base, mut subscripts) = base_latex(parts.next().unwrap_or_default());
    subscripts.extend(parts.map(word));
    if base.is_empty() {
        return format!(r"\mathrm{{{}}}", escaped(name));
    }
    match subscripts.join(",") {
        empty if empty.is_empty() => base,
        single if single.len() == 1 => format!("{base}_{single}"),
        subscript => format!("{base}_{{{subscript}}}"),
    }
}

/// The letter of a name, and what goes below it.
fn base_latex(part: &str) -> (String, Vec<String>) {
    let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits: Vec<String> = part
        .get(letters.len()..)
        .filter(|digits| !digits.is_empty())
        .map(str::to_owned)
        .into_iter()
        .collect();
    let mut characters = letters.chars();
    let first = characters.next();
    let tail = characters.as_str();
    match (letters, first) {
        ("qd", _) => (r"\dot{q}".to_owned(), digits),
        ("qdd", _) => (r"\ddot{q}".to_owned(), digits),
        (greek, _) if GREEK.contains(&greek) => (format!(r"\{greek}"), digits),
        // J, Jx, Ixx: a letter with axes below.
        (_, Some(first)) if first.is_ascii_uppercase() && !tail.is_empty() && is_axes(tail) => {
            (first.to_string(), vec![format!("{tail}{}", digits.concat())])
        }
        (_, None) => (digits.concat(), vec![]),
        _ => (word(letters), digits),
    }
}

fn is_axes(text: &str) -> bool {
    text.len() <= 2 && text.bytes().all(|byte| matches!(byte, b'x' | b'y' | b'z'))
}

/// A word as LaTeX: a letter or a number as it is, a Greek letter by its name, else upright text.
fn word(text: &str) -> String {
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    match text {
        greek if GREEK.contains(&greek) => format!(r"\{greek}"),
        short if letters.len() <= 1 => escaped(short),
        axes if is_axes(axes) => escaped(axes),
        long => format!(r"\mathrm{{{}}}", escaped(long)),
    }
}

/// Text with all but ASCII letters and digits made harmless.
fn escaped(text: &str) -> String {
    let mut latex = String::new();
    for character in text.chars() {
        match character {
            letter if letter.is_ascii_alphanumeric() => latex.push(letter),
            '-' | '+' | '*' | '.' | ',' | ':' | ';' | '/' | '(' | ')' => latex.push(character),
            '#' | '$' | '%' | '&' | '{' | '}' | '_' => {
                latex.push('\\');
                latex.push(character);
            }
            '\\' => latex.push_str(r"\backslash{}"),
            other => latex.push_str(&format!("u{:x}", u32::from(other))),
        }
    }
    latex
}

/// Whether `x^a^b` or `x_a_b` occurs, which LaTeX refuses. Braces are balanced.
fn repeated_script(latex: &str) -> bool {
    let mut levels = vec![[false; 2]];
    let mut characters = latex.bytes().peekable();
    let mut argument = false;
    while let Some(byte) = characters.next() {
        let script = match byte {
            b'^' => Some(0),
            b'_' => Some(1),
            _ => None,
        };
        match (byte, script, levels.last_mut()) {
            (_, Some(script), Some(level)) => {
                if std::mem::replace(&mut level[script], true) {
                    return true;
                }
                argument = true;
                continue;
            }
            (b'{', ..) => {
                if !argument && let Some(level) = levels.last_mut() {
                    *level = [false; 2];
                }
                levels.push([false; 2]);
            }
            (b'}', ..) => {
                levels.pop();
            }
            (b'\\', ..) => {
                while characters.next_if(u8::is_ascii_alphabetic).is_some() {}
                if !argument && let Some(level) = levels.last_mut() {
                    *level = [false; 2];
                }
            }
            (b' ', ..) => continue,
            (_, _, Some(level)) if !argument => *level = [false; 2],
            _ => {}
        }
        argument = false;
    }
    false
}
