//! Left sides that are refused: what is not a quantity of the robot, and what the right side repeats.

use robot_model::diagnostic::{Diagnostic, code, quote};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::Formula;

use super::printed::PrintedEquation;
use super::symbols;

/// Whether the right side of an equation contains its left side.
pub(super) fn is_repeated(equation: &PrintedEquation) -> bool {
    let mut names = equation.terms.iter().flat_map(Formula::symbols);
    names.any(|(name, _)| symbols::in_text(name) == equation.quantity)
}

/// The error for an equation whose right side contains its left side.
pub(super) fn repeated(equation: &PrintedEquation) -> Diagnostic {
    let message = format!("the right side contains `{}`, the left side", quote(&equation.quantity));
    Diagnostic::error(code::EXPRESSION, message)
        .at(&equation.span, "")
        .because("such an equation says nothing, or is not solved for its left side")
        .help("write the terms of the equation, or the name of another quantity")
}

/// The error for more equations than `most` for each quantity, which cannot all be of this robot.
pub(super) fn too_many(equation: &PrintedEquation, most: usize) -> Diagnostic {
    let message = format!("there are more than {most} equations for each quantity of the robot");
    let error = Diagnostic::error(code::LIMIT, message).at(&equation.span, "");
    error.help("put them into several files")
}

/// The error for a left side that is not a quantity of the robot.
pub(super) fn unknown(equation: &PrintedEquation, robot: &Robot) -> Diagnostic {
    let is_number = equation.quantity.parse::<f64>().is_ok();
    if is_number || equation.quantity.contains(['+', '-', '*']) {
        let what = if is_number { "number" } else { "sum or a product" };
        let message = format!("the left side is a {what}");
        return Diagnostic::error(code::EXPRESSION, message)
            .at(&equation.span, "")
            .help("solve the equation for one quantity: `Q1 = …`, in LaTeX `\\tau_1 = …`");
    }
    let mut words = equation.quantity.split_whitespace();
    let left = words.clone().collect::<Vec<_>>().join(" ");
    let message = format!("the robot does not have the quantity `{}`", quote(&left));
    if matches!(JointVariable::parse(&left), Some((JointVariable::Torque, _))) && equation.is_latex
    {
        return Diagnostic::error(code::UNKNOWN_WORD, message)
            .at(&equation.span, "this is not LaTeX")
            .help("write `\\tau_{1}`, or read the file as text if all of it is");
    }
    if words.clone().count() > 1 && words.any(is_word) {
        return Diagnostic::error(code::UNKNOWN_WORD, message).at(&equation.span, "").help(
            "put the equation on a line of its own or in a display, or begin the line with `%`",
        );
    }
    let vector = [".x", ".y", ".z"].iter().find_map(|axis| equation.quantity.strip_suffix(axis));
    if let Some(vector) = vector.filter(|vector| vector.contains('\\')) {
        let message = format!("`{}` is not a vector that is compared", quote(vector));
        return Diagnostic::error(code::UNKNOWN_WORD, message).at(&equation.span, "").help(
            "the vectors that are compared are a_{c}^{1}, F^{1}, M_{c}^{1}, F_{l}^{1} and M_{l}^{1} of each link; \
             write an equation for each entry of any other, such as `\\tau_1 = …`",
        );
    }
    let (links, last) = (robot.links.len(), robot.degrees_of_freedom());
    Diagnostic::error(code::UNKNOWN_WORD, message).at(&equation.span, "").help(format!(
        "the quantities are a_c1.x to a_c{links}.z, F, M_c, F_l and M_l likewise, and Q1 to \
         Q{last}, also written tau1 and so on; in LaTeX a_{{c_x}}^{{1}}, F_{{x}}^{{1}}, M_{{c_x}}^{{1}}, F_{{l_x}}^{{1}}, \
         M_{{l_x}}^{{1}} and Q_{{1}} or \\tau_{{1}}"
    ))
}

/// Whether text is a word of prose instead of a symbol.
fn is_word(text: &str) -> bool {
    text.chars().count() > 2 && text.chars().all(char::is_alphabetic)
}
