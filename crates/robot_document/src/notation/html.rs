//! A page of HTML with equations in MathML: one file that needs no other, no script and no font.

use crate::breaking::right_side;
use crate::error::Error;
use crate::forms::{Equation, Group};
use crate::latex::Layout;
use crate::math::Math;
use crate::mathml::{self, Content, Markup};
use crate::width::width;

/// The number of an equation and its distance from the equation, pt.
const NUMBER: f64 = 44.0;

/// Right sides start in one line below each other; further lines are indented by an empty piece.
const STYLE: &str = "\
body { color-scheme: light dark; margin: 2rem; font-family: serif; line-height: 1.4 }
p { max-width: 45rem }
math { font-size: 1.1rem; margin: 0 0 1.5rem }
mtd { text-align: left; padding: 0.25rem 0 }
mtd:first-child { text-align: right; text-align: -webkit-right }
mtd:nth-child(3) { padding-left: 2rem; text-align: right; text-align: -webkit-right }";

/// The page: a heading and a table of equations for each group, lines broken as in LaTeX.
///
/// # Errors
///
/// A piece of an equation that cannot be broken and does not fit a line.
pub fn page(
    title: &str,
    groups: &[Group],
    layout: Layout,
    numbered: bool,
) -> Result<String, Error> {
    let mut body = vec![text("h1", title)];
    let mut numbers = numbered.then_some(1);
    for group in groups {
        body.push(text("h2", &group.title));
        if !group.introduction.is_empty() {
            body.push(text("p", &group.introduction));
        }
        let mut rows = vec![];
        for equation in &group.equations {
            rows.extend(self::rows(equation, layout, numbers)?);
            numbers = numbers.map(|number| number + 1);
        }
        let table = holding("mtable", rows)
            .with("columnalign", "right left right")
            .with("displaystyle", "true");
        body.push(holding("math", vec![table]).with("display", "block"));
    }
    let title = text("title", title);
    let body: String = body.iter().map(|part| format!("{part}\n")).collect();
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{title}\n<style>\n{STYLE}\n\
         </style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    ))
}

/// The lines of an equation, the number at the last one.
fn rows(equation: &Equation, layout: Layout, number: Option<usize>) -> Result<Vec<Markup>, Error> {
    let apart = if number.is_some() { NUMBER } else { 0.0 };
    let lines = right_side(equation, layout.width - width(&equation.left) - apart)?;
    let last = lines.len().saturating_sub(1);
    let mut rows = vec![];
    for (place, line) in lines.iter().enumerate() {
        let (left, right) = match place {
            0 => {
                let equals = mathml::formula(&Math::Sign('=')).with("form", "infix");
                (mathml::formula(&equation.left), vec![equals, mathml::formula(line)])
            }
            _ => {
                let indent = holding("mspace", vec![]).with("width", "2em");
                (holding("mrow", vec![]), vec![indent, mathml::continued(line)])
            }
        };
        let mut cells = vec![holding("mtd", vec![left]), holding("mtd", right)];
        if let Some(number) = number.filter(|_| place == last) {
            cells.push(holding("mtd", vec![text("mtext", &format!("({number})"))]));
        }
        rows.push(holding("mtr", cells));
    }
    Ok(rows)
}

fn holding(name: &'static str, elements: Vec<Markup>) -> Markup {
    Markup { name, attributes: vec![], content: Content::Elements(elements) }
}

fn text(name: &'static str, text: &str) -> Markup {
    Markup { name, attributes: vec![], content: Content::Text(text.to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(right: Math) -> Group {
        let left = Math::Letter('Q').with_lower(Math::integer(1));
        let equation = Equation { name: "Q1".to_owned(), text: String::new(), left, right };
        Group::of_definitions("Forces & moments", vec![equation])
    }

    #[test]
    fn long_sums_take_several_rows() {
        let term = [Math::Sign('+'), Math::Letter('m')];
        let sum = Math::Row(term.iter().cycle().take(60).cloned().collect());
        let page = page("arm", &[group(sum)], Layout::of_centimeters(8.0), true).unwrap();
        assert!(page.matches("<mtr>").count() > 2, "{page}");
        assert_eq!(page.matches("<mtext>(1)</mtext>").count(), 1);
        assert!(page.contains("<mo form=\"infix\">+</mo>"), "{page}");
        assert!(page.contains("<h2>Forces &amp; moments</h2>"), "{page}");
    }

    #[test]
    fn text_of_a_robot_is_never_markup() {
        let hostile = "</title><script>alert(1)</script>&";
        let word = Math::Word(hostile.to_owned());
        let page = page(hostile, &[group(word)], Layout::of_centimeters(30.0), false).unwrap();
        assert!(!page.contains("<script"), "{page}");
        assert_eq!(page.matches("&lt;script&gt;").count(), 3);
    }
}
