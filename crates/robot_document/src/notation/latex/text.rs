//! Text from robot files as LaTeX that only prints it, whatever it contains.

use robot_model::signs::Letter;

use crate::notation::words;

/// Letters outside ASCII that LaTeX writes with an accent, and the accent.
const ACCENTED: &[(&str, &str)] = &[
    ("ÀÈÌÒÙàèòù", "`"),
    ("ÁÉÍÓÚÝáéóúýĆćŃńŚśŹź", "'"),
    ("ÂÊÎÔÛâêôû", "^"),
    ("ÄËÏÖÜäëöüÿ", "\""),
    ("ÃÑÕãñõ", "~"),
];
/// The same letters without accents, in the same order.
const BARE: &[&str] = &["AEIOUaeou", "AEIOUYaeouyCcNnSsZz", "AEIOUaeou", "AEIOUaeouy", "ANOano"];

/// The LaTeX of other characters.
const OTHERS: &[(char, &str)] = &[
    ('\\', r"\textbackslash{}"),
    ('~', r"\textasciitilde{}"),
    ('^', r"\textasciicircum{}"),
    ('<', r"\(<\)"),
    ('>', r"\(>\)"),
    ('|', r"\(|\)"),
    ('"', "''"),
    ('ß', r"\ss{}"),
    ('æ', r"\ae{}"),
    ('Æ', r"\AE{}"),
    ('ø', r"\o{}"),
    ('Ø', r"\O{}"),
    ('å', r"\aa{}"),
    ('Å', r"\AA{}"),
    ('ł', r"\l{}"),
    ('Ł', r"\L{}"),
    ('ç', r"\c{c}"),
    ('Ç', r"\c{C}"),
    ('í', r"\'{\i}"),
    ('ì', r"\`{\i}"),
    ('î', r"\^{\i}"),
    ('ï', "\\\"{\\i}"),
    ('–', "--"),
    ('—', "---"),
    ('‘', "`"),
    ('’', "'"),
    ('“', "``"),
    ('”', "''"),
    ('…', r"\dots{}"),
    ('§', r"\S{}"),
    ('°', r"\(^\circ\)"),
    ('·', r"\(\cdot\)"),
    ('×', r"\(\times\)"),
    ('±', r"\(\pm\)"),
    ('²', r"\(^2\)"),
    ('³', r"\(^3\)"),
    ('µ', r"\(\mu\)"),
    ('\u{a0}', "~"),
];

/// Text for paragraphs. Characters that Computer Modern lacks are printed as their code: `[U+4E2D]`.
#[must_use]
pub fn text(text: &str) -> String {
    let mut latex = String::new();
    for (place, piece) in words::pieces(text).into_iter().enumerate() {
        if place > 0 {
            latex.push_str(r"\allowbreak{}");
        }
        push(piece, &mut latex);
    }
    latex
}

/// Appends text without breaks of its own.
fn push(text: &str, latex: &mut String) {
    for character in text.chars() {
        match character {
            '#' | '$' | '%' | '&' | '{' | '}' | '_' => {
                latex.push('\\');
                latex.push(character);
            }
            // Two of these in a row would become a dash or a ligature.
            '-' | '`' | '\'' | ',' | '?' | '!' if latex.ends_with(character) => {
                latex.push_str("{}");
                latex.push(character);
            }
            '\n' | '\t' => latex.push(' '),
            ' '..='~' if OTHERS.iter().all(|(other, _)| *other != character) => {
                latex.push(character);
            }
            other => latex.push_str(&outside(other)),
        }
    }
}

/// The LaTeX of a character that cannot be written as it is.
fn outside(character: char) -> String {
    if let Some((_, latex)) = OTHERS.iter().find(|(other, _)| *other == character) {
        return (*latex).to_owned();
    }
    if let Some(letter) = Letter::of_character(character) {
        return format!(r"\(\{}\)", letter.latex);
    }
    for ((letters, accent), bare) in ACCENTED.iter().zip(BARE) {
        let place = letters.chars().position(|letter| letter == character);
        if let Some(letter) = place.and_then(|place| bare.chars().nth(place)) {
            return format!(r"\{accent}{{{letter}}}");
        }
    }
    format!("[U+{:04X}]", u32::from(character))
}

/// The LaTeX of an upright word in a formula.
pub(super) fn in_math(word: &str) -> String {
    let mut latex = String::new();
    for character in word.chars() {
        match character {
            '#' | '$' | '%' | '&' | '{' | '}' | '_' => {
                latex.push('\\');
                latex.push(character);
            }
            ' ' => latex.push_str(r"\ "),
            '!'..='~' if !matches!(character, '\\' | '^' | '~') => latex.push(character),
            other => latex.push_str(&format!("[U+{:04X}]", u32::from(other))),
        }
    }
    latex
}
