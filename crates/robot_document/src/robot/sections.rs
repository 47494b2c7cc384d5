//! The equations of a document: a section for each form, with its groups as parts.

use robot_dynamics::quantity::Kind;

use super::paragraph;
use crate::document::{Block, Inline, Table};
use crate::forms::{Equation, EquationOptions, Equations, Form, Group};
use crate::math::Math;

/// The blocks of the section of a form. Each equation is numbered, and its label consists of the form and its name.
pub(super) fn blocks(form: Form, part: &Equations, options: &EquationOptions) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(1, format!("Equations of motion, {}", form.name()))];
    let own = part.groups.iter().find(|group| !group.definitions);
    match own.map_or("", |group| &group.introduction) {
        "" => blocks.extend(introduction(form, part)),
        text => blocks.push(paragraph(text)),
    }
    for group in &part.groups {
        if part.groups.len() > 1 {
            blocks.push(Block::Heading(2, title(form, group, options)));
        }
        if group.definitions && !group.introduction.is_empty() {
            blocks.push(paragraph(&group.introduction));
        }
        let (constant, other): (Vec<&Equation>, Vec<&Equation>) = match group.definitions {
            true => group.equations.iter().partition(|equation| is_constant(equation)),
            false => (vec![], group.equations.iter().collect()),
        };
        let is_table = constant.len() >= FEWEST;
        blocks.extend(is_table.then(|| constants(&constant)));
        let shown = if is_table { other } else { group.equations.iter().collect() };
        if shown.is_empty() {
            continue;
        }
        let numbered = |equation: &Equation| {
            group.numbered(equation, Some(format!("{}:{}", form.name(), equation.label())))
        };
        blocks.push(Block::Equations(shown.into_iter().map(numbered).collect()));
    }
    blocks
}

/// The smallest number of constants that are shown as a table.
const FEWEST: usize = 4;

/// Whether the right side is a number, such as `√2/2` or `2·10⁻⁵`, and the left side is not a component of a vector.
fn is_constant(equation: &Equation) -> bool {
    !equation.name.contains('.') && equation.right.pieces().iter().all(is_number)
}

fn is_number(piece: &Math) -> bool {
    match piece {
        Math::Number(_) | Math::Sign('-' | '·') => true,
        // A power, such as that of ten.
        Math::Script(script) => {
            let parts = std::iter::once(&script.base).chain(&script.lower).chain(&script.upper);
            parts.flat_map(Math::pieces).all(is_number)
        }
        Math::Root(inside) => inside.pieces().iter().all(is_number),
        Math::Fraction(parts) => parts.iter().flat_map(Math::pieces).all(is_number),
        _ => false,
    }
}

/// A table of constants.
fn constants(equations: &[&Equation]) -> Block {
    let row = |equation: &&Equation| {
        [&equation.left, &equation.right].map(|side| vec![Inline::Math(side.clone())]).into()
    };
    Block::Table(Table {
        caption: "Constants.".to_owned(),
        head: ["Constant", "Value"].map(|name| vec![Inline::text(name)]).into(),
        rows: equations.iter().map(row).collect(),
        keys: 1,
    })
}

/// The title of a group.
fn title(form: Form, group: &Group, options: &EquationOptions) -> String {
    let has_all = matches!(form, Form::Expanded | Form::Collected | Form::Compact);
    match options.kinds.as_slice() {
        _ if group.definitions => group.title.clone(),
        [Kind::JointTorque] => "Joint torques".to_owned(),
        _ if has_all => "Quantities".to_owned(),
        _ => "Joint torques".to_owned(),
    }
}

/// The text at the beginning of a section whose groups have no introduction.
fn introduction(form: Form, part: &Equations) -> Option<Block> {
    let has_names = part.definitions().next().is_some();
    match form {
        Form::Recursive => Some(recursion()),
        Form::Compact if has_names => Some(paragraph(
            "Expressions that occur several times have names, each defined before it is used.",
        )),
        _ => None,
    }
}

fn recursion() -> Block {
    let letter = |letter| Inline::Math(Math::Letter(letter));
    let indexed = |base, index| Inline::Math(Math::Letter(base).with_lower(Math::Letter(index)));
    let text = |text: &str| Inline::text(text);
    Block::Paragraph(vec![
        text(
            "The recursive Newton-Euler algorithm, link by link. Outward, from the base to the tips, the angular velocity ",
        ),
        letter('ω'),
        text(" and the angular acceleration "),
        letter('ε'),
        text(" of a link, the acceleration "),
        letter('a'),
        text(" of the origin of its frame and the acceleration "),
        indexed('a', 'c'),
        text(" of its center of mass follow from those of its parent, and from them the force "),
        letter('F'),
        text(" and the moment "),
        indexed('M', 'c'),
        text(
            " about the center of mass that move the link. Inward, from the tips to the base, the force ",
        ),
        indexed('F', 'l'),
        text(" and the moment "),
        indexed('M', 'l'),
        text(
            " about the origin of the frame that a link receives through its joint follow from those of the links that it carries. Gravity is included as an acceleration of the base. Components are in the axes of the link's own frame; a bar marks the column of the components along x, y and z. The upper index of a quantity of a link, and of its components, is the number of the link and not a power. Quantities that are 0 or equal to an earlier one are left out.",
        ),
    ])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails panics")]

    use super::*;
    use crate::latex::read;

    #[test]
    fn powers_of_ten_are_constants() {
        let is_constant = |right: &str| {
            let [left, right] = ["k_1", right].map(|text| read(text).unwrap());
            is_constant(&Equation { name: "k1".to_owned(), text: String::new(), left, right })
        };
        assert!(is_constant(r"9.356 \cdot 10^{-5}") && is_constant(r"-\frac{\sqrt{2}}{2}"));
        assert!(!is_constant(r"2 \cdot l_1^{2}") && !is_constant("2 q_1"));
    }
}
