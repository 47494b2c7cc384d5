//! Displayed equations, broken into lines, in an environment of amsmath.

use crate::breaking::{is_within_product, right_side};
use crate::document::NumberedEquation;
use crate::error::Error;
use crate::latex::formula;
use crate::math::Math;
use crate::width::width;

/// The lines that equations are to fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// The width of a line, in printer's points, 72.27 to an inch.
    pub width: f64,
}

/// Lines in one environment; longer ones are cut, for TeX sets an environment as a whole, in a time that
/// grows with the square of its length.
const LONGEST: usize = 40;
/// The number of an equation, pt.
const NUMBER: f64 = 36.0;
/// The error of estimates, pt.
const MARGIN: f64 = 2.0;

impl Layout {
    /// A line of so many centimeters.
    #[must_use]
    pub fn of_centimeters(width: f64) -> Layout {
        Layout { width: width / 2.54 * 72.27 }
    }
}

/// Equations one below the other, aligned at their equals signs; those with a label are numbered.
///
/// # Errors
///
/// A piece of an equation that cannot be broken and does not fit a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let numbered = list.iter().any(|equation| equation.label.is_some());
    let left = list.iter().map(|one| width(&one.equation.left)).fold(0.0, f64::max);
    let available = layout.width - left - MARGIN;
    let mut writer = Writer { numbered, latex: String::new(), rows: vec![], is_within: false };
    for equation in list {
        writer.add(equation, available)?;
    }
    writer.end(Cut::Between);
    Ok(writer.latex)
}

struct Writer {
    numbered: bool,
    latex: String,
    /// The lines of the environment that is being filled.
    rows: Vec<String>,
    /// Whether it goes on with an equation that started in the one before.
    is_within: bool,
}

impl Writer {
    fn add(&mut self, numbered: &NumberedEquation, available: f64) -> Result<(), Error> {
        let NumberedEquation { label, number, equation } = numbered;
        let lines = right_side(equation, available, if label.is_some() { NUMBER } else { 0.0 })?;
        let left = formula(&equation.left);
        let last = lines.len().saturating_sub(1);
        // Equations stay whole if they can.
        if self.rows.len() + lines.len() > LONGEST {
            self.end(Cut::Between);
        }
        for (place, line) in lines.iter().enumerate() {
            if self.rows.len() >= LONGEST {
                self.end(Cut::Within);
            }
            let mut row = match (place, self.rows.is_empty()) {
                (0, _) if equation.is_name() => format!("  {left} &"),
                (0, _) => format!("  {left} &= {}", formula(line)),
                (_, true) => format!(r"  \phantom{{{left}}} &\quad {}", continued(line)),
                (_, false) => format!(r"    &\quad {}", continued(line)),
            };
            match label {
                Some(label) if place == last => {
                    let tag = number.as_ref().map(|number| format!(r" \tag{{{number}}}"));
                    row.push_str(&format!(r"{} \label{{eq:{label}}}", tag.unwrap_or_default()));
                }
                _ if self.numbered => row.push_str(r" \notag"),
                _ => {}
            }
            self.rows.push(row);
        }
        // What follows has a left side of its own.
        if self.is_within {
            self.end(Cut::Between);
        }
        Ok(())
    }

    /// Ends an environment; within an equation the lines go on at the usual distance.
    fn end(&mut self, cut: Cut) {
        if self.rows.is_empty() {
            return;
        }
        let name = if self.numbered { "align" } else { "align*" };
        let rows = std::mem::take(&mut self.rows).join(" \\\\\n");
        let mut skips = String::new();
        if self.is_within {
            skips.push_str(r"\abovedisplayskip=\jot");
        }
        if cut == Cut::Within {
            skips.push_str(r"\belowdisplayskip=0pt");
        }
        let environment = format!("\\begin{{{name}}}\n{rows}\n\\end{{{name}}}");
        self.latex.push_str(&match skips.as_str() {
            "" => format!("{environment}\n"),
            _ => format!("{{{skips}\n{environment}}}%\n"),
        });
        self.is_within = cut == Cut::Within;
    }
}

/// Where an environment ends.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Cut {
    Between,
    Within,
}

/// A further line: the sign that it starts with is set apart from what follows, as in a sum.
pub(in crate::notation) fn continued(line: &Math) -> String {
    match line.pieces() {
        [Math::Sign(_), rest @ ..] => {
            let sign = formula(&Math::row(line.pieces().iter().take(1).cloned().collect()));
            let indent = if is_within_product(line.pieces()) { r"\quad " } else { "" };
            format!("{indent}{{}}{sign} {}", formula(&Math::Row(rest.to_vec())))
        }
        _ => formula(line),
    }
}
