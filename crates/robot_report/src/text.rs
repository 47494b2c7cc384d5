//! Words and numbers for values of robot files.

use robot_document::robot::words;
use robot_model::robot::{Move, Placement, Robot};
use robot_symbolic::Formula;

/// The nominal value of a formula; NaN if one of its parameters has no value.
pub(crate) fn value(robot: &Robot, formula: &Formula) -> f64 {
    formula.evaluate(|name| robot.nominal_value(name))
}

/// A formula as text, followed by its nominal value if it has parameters.
pub(crate) fn with_value(robot: &Robot, formula: &Formula) -> String {
    let text = plain(formula);
    let value = value(robot, formula);
    if formula.is_constant() || !value.is_finite() {
        return text;
    }
    format!("{text} = {}", number(value))
}

/// The number of characters above which a number is rounded in tables.
const LONG: usize = 12;

/// A formula as people write it; a long number is rounded to six digits.
pub(crate) fn plain(formula: &Formula) -> String {
    if let Some(long) = formula.as_number().filter(|_| formula.text().len() > LONG) {
        return number(long.to_f64());
    }
    let is_word = |character: char| character.is_ascii_alphanumeric() || character == '_';
    let words = formula.text().split_inclusive(|character| !is_word(character));
    let words = words.map(|piece| match piece.strip_prefix("pi") {
        Some(rest) if !rest.starts_with(is_word) => format!("π{rest}"),
        _ => piece.to_owned(),
    });
    words.collect::<String>().replace('-', "−")
}

/// Formats a number with up to six digits.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = 5 - value.abs().log10().floor() as i32;
    if !(0..=12).contains(&digits) {
        return format!("{value:.3e}").replace('-', "−");
    }
    let text = format!("{value:.*}", usize::try_from(digits).unwrap_or_default());
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    text.replace('-', "−")
}

/// A pose such as `translate (l4, 0, l3), rotate z by π/2`, with the nominal values of formulas with parameters.
pub(crate) fn pose(robot: &Robot, placement: &Placement) -> String {
    let text = |formula: &Formula| with_value(robot, formula);
    let one = |step: &Move| match step {
        Move::Translate(by) => format!("translate {}", words::vector(by, text)),
        Move::Rotate(about, angle) => format!("rotate {} by {}", words::axis(*about), text(angle)),
    };
    let moves: Vec<String> = words::moves(placement).map(one).collect();
    if moves.is_empty() { "none".to_owned() } else { moves.join(", ") }
}

/// A unit as people write it, for example `kg·m²` for `kg m^2`.
pub(crate) fn unit(name: &str) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4'..='9' => char::from_u32(0x2070 + u32::from(digit) - u32::from('0')).unwrap_or(digit),
        other => other,
    };
    let mut written = String::new();
    let mut is_power = false;
    for letter in name.replace([' ', '*'], "·").chars() {
        is_power = letter == '^' || is_power && (letter == '-' || letter.is_ascii_digit());
        match letter {
            '^' => {}
            _ if is_power => written.push(raised(letter)),
            _ => written.push(letter),
        }
    }
    written
}

/// A name with the number at its end as a subscript: `l₄`.
pub(crate) fn symbol(name: &str) -> String {
    let stem = name.trim_end_matches(|digit: char| digit.is_ascii_digit());
    let digits = name.get(stem.len()..).unwrap_or_default().bytes();
    let below = digits.filter_map(|digit| char::from_u32(0x2080 + u32::from(digit - b'0')));
    stem.chars().chain(below).collect()
}

/// Shortens a text to at most `characters` characters in its middle, because similar names differ at their ends.
pub(crate) fn shortened(text: &str, characters: usize) -> String {
    let count = text.chars().count();
    if count <= characters {
        return text.to_owned();
    }
    let kept = characters.saturating_sub(1);
    let start = text.chars().take(kept - kept / 2).chain(['…']);
    start.chain(text.chars().skip(count - kept / 2)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_word_pi_is_pi() {
        let shown = |text| plain(&Formula::parse(text).unwrap());
        assert_eq!(shown("-pi/2 + pitch*pi"), "−π/2 + pitch*π");
        assert_eq!(shown("-1.5707963267949"), "−1.5708");
    }

    #[test]
    fn only_numbers_at_the_end_go_below() {
        assert_eq!(["l4", "q12", "a_2b", "7"].map(symbol), ["l₄", "q₁₂", "a_2b", "₇"]);
        assert_eq!((shortened("abcd", 4), shortened("abcde", 4)), ("abcd".into(), "ab…e".into()));
        let names = ["left_hand_index_finger_link_1", "left_hand_index_finger_link_2"];
        assert_eq!(shortened(names[0], 22), "left_hand_i…ger_link_1");
        assert_eq!(shortened(names[1], 22), "left_hand_i…ger_link_2");
    }

    #[test]
    fn units_have_powers_and_dots() {
        let shown = ["kg m^2", "kg*m^2", "N m s/rad", "m^-1", "m/s^2", ""].map(unit);
        assert_eq!(shown, ["kg·m²", "kg·m²", "N·m·s/rad", "m⁻¹", "m/s²", ""]);
    }

    #[test]
    fn numbers_have_up_to_six_digits() {
        let shown = [0.4318, 1234567.0, -0.000_02, 1e-13, 0.1 + 0.2, 45.0, 100.0].map(number);
        assert_eq!(shown, ["0.4318", "1.235e6", "−0.00002", "1.000e−13", "0.3", "45", "100"]);
    }
}
