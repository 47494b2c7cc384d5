//! Displayed equations in Markdown, each between `$$`, as GitHub and others render them.

use crate::breaking::right_side;
use crate::document::NumberedEquation;
use crate::error::Error;
use crate::latex::{Layout, formula};
use crate::width::width;

/// Equations one below the other, each broken into lines; labels are not shown.
///
/// # Errors
///
/// A piece of an equation that cannot be broken and does not fit a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let mut shown = String::new();
    for NumberedEquation { equation, .. } in list {
        let lines = right_side(equation, layout.width - width(&equation.left))?;
        let lines: Vec<String> = lines.iter().map(formula).collect();
        let left = formula(&equation.left);
        let display = match lines.as_slice() {
            [single] => format!("{left} = {single}"),
            lines => {
                let lines = lines.join(" \\\\\n&\\quad ");
                format!("\\begin{{aligned}}\n{left} &= {lines}\n\\end{{aligned}}")
            }
        };
        // GitHub takes no \operatorname, others no space in place of a column.
        let display = display.replace(r"\operatorname{", r"\mathrm{").replace("{@{}l@{}}", "{l}");
        shown.push_str(&format!("\n$$\n{display}\n$$\n"));
    }
    Ok(shown)
}
