//! The layouts of quantities and defined symbols.

use crate::math::{Math, Script};

/// A component such as `ω_x^2` or `J_{xy}^2`: the upper index is the link, as in the paper.
pub(super) fn component(letter: char, number: usize, axes: &[usize]) -> Math {
    let lower = Some(Math::row(axes.iter().map(|place| axis(*place)).collect()));
    let upper = Some(Math::integer(number));
    Math::Script(Box::new(Script { base: Math::Letter(letter), lower, upper }))
}

/// A letter with numbers as its lower index: `M_{12}`, with commas if a number has several digits.
pub(super) fn indexed(letter: char, numbers: &[usize]) -> Math {
    let apart = numbers.iter().any(|number| *number > 9);
    let mut pieces = vec![];
    let mut joined = String::new();
    for (place, number) in numbers.iter().enumerate() {
        if apart && place > 0 {
            pieces.push(Math::Number(std::mem::take(&mut joined)));
            pieces.push(Math::Sign(','));
        }
        joined.push_str(&number.to_string());
    }
    pieces.push(Math::Number(joined));
    Math::Letter(letter).with_lower(Math::row(pieces))
}

/// The name of an indexed symbol in text, such as `M_1_2`.
pub(super) fn indexed_name(letter: &str, numbers: &[usize]) -> String {
    let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
    format!("{letter}_{}", numbers.join("_"))
}

fn axis(component: usize) -> Math {
    Math::Letter(axis_name(component).chars().next().unwrap_or('z'))
}

/// The name of an axis: `x`, `y` or `z`.
pub(super) fn axis_name(component: usize) -> &'static str {
    ["x", "y", "z"].get(component).copied().unwrap_or("z")
}
