//! Pages of HTML with equations in MathML. A page is one file that contains its font and needs no other file and no
//! script.

use crate::breaking::right_side;
use crate::error::Error;
use crate::forms::{Equation, Group};
use crate::latex::Layout;
use crate::markup::{Element, Node, element, holding};
use crate::math::Math;
use crate::math_font;
use crate::mathml;
use crate::width::width;

/// The width of the number of an equation and of its distance from the equation, in pt.
const NUMBER: f64 = 44.0;

/// The style sheet. The right sides of equations are aligned at the left; further lines are indented by an empty piece.
const STYLE: &str = "\
body { color-scheme: light dark; margin: 2rem; font-family: serif; line-height: 1.4 }
p { max-width: 45rem }
math { font-size: 1.1rem; margin: 0 0 1.5rem }
mtd { text-align: left; padding: 0.25rem 0 }
mtd:first-child { text-align: right; text-align: -webkit-right }
mtd:nth-child(3) { padding-left: 2rem; text-align: right; text-align: -webkit-right }
mtd mtd:nth-child(n) { text-align: center; text-align: -webkit-center; padding: 0.15rem 0.4rem }
mtd mtd[columnalign=left]:nth-child(n) { text-align: left; text-align: -webkit-left }
mtable[columnalign=left] mtd:nth-child(n) { text-align: left; text-align: -webkit-left; padding: 0 }";

/// The options of a page.
#[derive(Clone, Copy, Debug)]
pub struct PageOptions {
    /// The width of lines.
    pub layout: Layout,
    /// Whether equations are numbered.
    pub numbered: bool,
    /// Whether the page contains the font of its equations, 64 kB; otherwise browsers use an installed one.
    pub has_font: bool,
}

/// Makes a page with a heading and a table of equations for each group, with lines broken as in LaTeX.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn page(title: &str, groups: &[Group], options: PageOptions) -> Result<String, Error> {
    let PageOptions { layout, numbered, has_font } = options;
    let mut body = vec![holding("h1", title)];
    let mut numbers = numbered.then_some(1);
    for group in groups {
        body.push(holding("h2", group.title.as_str()));
        if !group.introduction.is_empty() {
            body.push(holding("p", group.introduction.as_str()));
        }
        let mut rows = vec![];
        for equation in &group.equations {
            let running = numbers.map(|number| number.to_string());
            let number = match group.numbers.is_empty() {
                true => running,
                false => running.and_then(|_| group.numbers.get(&equation.name).cloned()),
            };
            rows.extend(self::rows(equation, layout, number.as_deref())?);
            numbers = numbers.map(|number| number + 1);
        }
        let table = element("mtable")
            .with_all(rows)
            .attribute("columnalign", "right left right")
            .attribute("displaystyle", "true");
        body.push(holding("math", table).attribute("display", "block"));
    }
    let font = if has_font { math_font::RULES.as_str() } else { "" };
    let style = element("style")
        .with("\n")
        .with(Node::Verbatim(font))
        .with(Node::Verbatim(STYLE))
        .with("\n");
    let head = [element("meta").attribute("charset", "utf-8"), holding("title", title), style];
    let html = element("html").attribute("lang", "en").with("\n");
    let html = [lines("head", head), lines("body", body)]
        .into_iter()
        .fold(html, |html, part| html.with(part).with("\n"));
    Ok(format!("<!DOCTYPE html>\n{html}\n"))
}

/// An element with each child on a line of its own.
fn lines(name: &'static str, children: impl IntoIterator<Item = Element>) -> Element {
    let start = element(name).with("\n");
    children.into_iter().fold(start, |all, child| all.with(child).with("\n"))
}

/// The lines of an equation as rows of a table; the last one has the number.
fn rows(equation: &Equation, layout: Layout, number: Option<&str>) -> Result<Vec<Element>, Error> {
    let apart = if number.is_some() { NUMBER } else { 0.0 };
    let lines = right_side(equation, layout.width - width(&equation.left) - apart, 0.0)?;
    let last = lines.len().saturating_sub(1);
    let mut rows = vec![];
    for (place, line) in lines.iter().enumerate() {
        let (left, right) = match place {
            0 if equation.is_name() => (mathml::formula(&equation.left), vec![]),
            0 => {
                let equals = mathml::formula(&Math::Sign('=')).attribute("form", "infix");
                (mathml::formula(&equation.left), vec![equals, mathml::formula(&line.math)])
            }
            _ => {
                let indent = mathml::space(2 + line.indent);
                (element("mrow"), vec![indent, mathml::continued(&line.math)])
            }
        };
        let mut cells = vec![holding("mtd", left), element("mtd").with_all(right)];
        if let Some(number) = number.filter(|_| place == last) {
            cells.push(holding("mtd", holding("mtext", format!("({number})"))));
        }
        rows.push(element("mtr").with_all(cells));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(width: f64, numbered: bool) -> PageOptions {
        PageOptions { layout: Layout::of_centimeters(width), numbered, has_font: true }
    }

    #[test]
    fn a_page_without_the_font_is_short() {
        let one = |has_font| {
            let options = PageOptions { has_font, ..options(8.0, false) };
            page("arm", &[group(Math::Letter('m'))], options).unwrap()
        };
        assert!(one(true).contains("data:font/woff2") && one(true).len() > 50_000);
        assert!(!one(false).contains("font/woff2") && one(false).len() < 2_000, "{}", one(false));
    }

    fn group(right: Math) -> Group {
        let left = Math::Letter('Q').with_lower(Math::integer(1));
        let equation = Equation { name: "Q1".to_owned(), text: String::new(), left, right };
        Group::of_definitions("Forces & moments", vec![equation])
    }

    #[test]
    fn long_sums_take_several_rows() {
        let term = [Math::Sign('+'), Math::Letter('m')];
        let sum = Math::Row(term.iter().cycle().take(60).cloned().collect());
        let page = page("arm", &[group(sum)], options(8.0, true)).unwrap();
        assert!(page.matches("<mtr>").count() > 2, "{page}");
        assert_eq!(page.matches("<mtext>(1)</mtext>").count(), 1);
        assert!(page.contains("<mo form=\"infix\">+</mo>"), "{page}");
        assert!(page.contains("<h2>Forces &amp; moments</h2>"), "{page}");
    }

    #[test]
    fn text_of_a_robot_is_never_markup() {
        let hostile = "</title><script>alert(1)</script>&";
        let word = Math::Word(hostile.to_owned());
        let page = page(hostile, &[group(word)], options(30.0, false)).unwrap();
        assert!(!page.contains("<script"), "{page}");
        assert_eq!(page.matches("&lt;script&gt;").count(), 3);
    }
}
