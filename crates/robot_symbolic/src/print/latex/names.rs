//! Names of symbols, spelt in LaTeX.

pub(super) const GREEK: [&str; 40] = [
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
