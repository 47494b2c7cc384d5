//! LaTeX given for names: whether it only prints a symbol.

use std::ops::Range;

use super::names::GREEK;

/// LaTeX given for a name that does more than print a symbol.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct LatexNameError {
    /// The offending bytes.
    pub span: Range<usize>,
    /// What is wrong, and what a name may hold.
    pub message: String,
}

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
    let whole = 0..latex.len();
    if latex.trim().is_empty() || latex.len() > MAX_LENGTH {
        return error(whole, "a LaTeX name has 1 to 200 characters");
    }
    let (mut open, mut place) = (vec![], 0);
    while let Some(byte) = latex.as_bytes().get(place) {
        let start = place;
        place += 1;
        match byte {
            b'\\' => place = command(latex, start)?,
            b'{' => open.push(start),
            b'}' if open.pop().is_none() => {
                return error(start..place, "this `}` closes nothing");
            }
            b'_' | b'^' => {
                let argument = latex.as_bytes().get(place).copied().unwrap_or_default();
                if !argument.is_ascii_alphanumeric() && !b"{\\*+-".contains(&argument) {
                    return error(start..place, "expected what is set below or above");
                }
            }
            b'}' | b' ' | b'*' | b'\'' | b'+' | b'-' | b',' | b'.' | b'(' | b')' => {}
            byte if byte.is_ascii_alphanumeric() => {}
            _ => {
                let message =
                    "a LaTeX name may hold letters, digits, `* ' + - , . ( )`, `_`, `^` and braces";
                return error(start..latex.ceil_char_boundary(place), message);
            }
        }
    }
    if let Some(start) = open.pop() {
        return error(start..start + 1, "this `{` is not closed");
    }
    if latex.contains('\'') && latex.contains('^') {
        return error(whole, "a prime is a superscript already; write `^{\\prime …}`");
    }
    if repeated_script(latex) {
        return error(whole, "two superscripts or two subscripts follow each other; use braces");
    }
    Ok(())
}

/// The end of the command that begins at `start`.
fn command(latex: &str, start: usize) -> Result<usize, LatexNameError> {
    let rest = latex.get(start + 1..).unwrap_or_default();
    let letters = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
    let (name, after) = rest.split_at_checked(letters).unwrap_or_default();
    let end = start + 1 + letters;
    if ARGUMENT.contains(&name) {
        let argument = |c: char| c.is_ascii_alphanumeric() || c == '{' || c == '\\';
        if !after.trim_start().starts_with(argument) {
            return error(start..end, "expected what the accent or font is for");
        }
    } else if !GREEK.contains(&name) && !SIGNS.contains(&name) {
        let end = latex.ceil_char_boundary(end.max(start + 2).min(latex.len()));
        let message = "a LaTeX name may hold Greek letters, accents (\\dot, \\bar, …) and fonts \
                       (\\mathrm, …), no other commands";
        return error(start..end, message);
    }
    Ok(end)
}

fn error<T>(span: Range<usize>, message: &str) -> Result<T, LatexNameError> {
    Err(LatexNameError { span, message: message.to_owned() })
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
