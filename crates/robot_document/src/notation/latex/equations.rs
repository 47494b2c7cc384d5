//! Displayed equations in an environment of amsmath, broken into lines.

use crate::breaking::{number_width, right_side};
use crate::document::NumberedEquation;
use crate::error::Error;
use crate::latex::formula;
use crate::math::{Line, Math};
use crate::width::{text_width, width};

/// The lines on which equations must fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// The width of a line in printer's points, 72.27 per inch.
    pub width: f64,
    /// The largest number of an equation, for which lines leave room.
    pub numbers: usize,
}

/// The largest number of lines in one environment. Longer ones are split, because TeX sets an environment as a whole,
/// and its time grows with the square of the length.
const LONGEST: usize = 40;
/// An upper bound for the error of estimated widths, in pt.
const MARGIN: f64 = 2.0;

impl Layout {
    /// A line of this width in centimeters.
    #[must_use]
    pub fn of_centimeters(width: f64) -> Layout {
        Layout { width: width / 2.54 * 72.27, numbers: 9999 }
    }

    /// The same line for equations with these numbers at most.
    #[must_use]
    pub fn numbered(self, numbers: usize) -> Layout {
        Layout { numbers, ..self }
    }

    /// The width of the number of an equation with its distance from the equation, in pt.
    pub(in crate::notation) fn number(self, equation: &NumberedEquation) -> f64 {
        match (&equation.label, &equation.number) {
            (Some(_), Some(own)) => {
                number_width(self.numbers).max(number_width(1) + text_width(own))
            }
            (Some(_), None) => number_width(self.numbers),
            (None, _) => 0.0,
        }
    }
}

/// Writes equations one below the other, aligned at their equals signs; those with a label are numbered.
///
/// # Errors
///
/// If a piece of an equation cannot be broken and does not fit on a line.
pub fn equations(list: &[NumberedEquation], layout: Layout) -> Result<String, Error> {
    let numbered = list.iter().any(|equation| equation.label.is_some());
    let left = list.iter().map(|one| width(&one.equation.left)).fold(0.0, f64::max);
    let available = layout.width - left - MARGIN;
    let mut writer = Writer { numbered, latex: String::new(), rows: vec![], is_within: false };
    for equation in list {
        writer.add(equation, available, layout.number(equation))?;
    }
    writer.end(Cut::Between);
    Ok(writer.latex)
}

struct Writer {
    numbered: bool,
    latex: String,
    /// The lines of the current environment.
    rows: Vec<String>,
    /// Whether the current environment continues an equation from the preceding one.
    is_within: bool,
}

impl Writer {
    fn add(&mut self, numbered: &NumberedEquation, available: f64, room: f64) -> Result<(), Error> {
        let NumberedEquation { label, number, equation } = numbered;
        let lines = right_side(equation, available, room)?;
        let left = formula(&equation.left);
        let last = lines.len().saturating_sub(1);
        // An equation is kept in one environment if possible.
        if self.rows.len() + lines.len() > LONGEST {
            self.end(Cut::Between);
        }
        for (place, line) in lines.iter().enumerate() {
            if self.rows.len() >= LONGEST {
                self.end(Cut::Within);
            }
            let mut row = match (place, self.rows.is_empty()) {
                (0, _) if equation.is_name() => format!("  {left} &"),
                (0, _) => format!("  {left} &= {}", formula(&line.math)),
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
        // The next equation has another left side, so it starts a new environment.
        if self.is_within {
            self.end(Cut::Between);
        }
        Ok(())
    }

    /// Ends the environment. If the cut is within an equation, its lines continue at the usual distance.
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

/// Whether an environment ends between equations or within one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Cut {
    Between,
    Within,
}

/// A further line of an equation: the sign at its beginning has the same spaces as within a sum.
pub(in crate::notation) fn continued(line: &Line) -> String {
    let indent = r"\quad ".repeat(line.indent);
    match line.math.pieces() {
        [sign @ Math::Sign(_), rest @ ..] => {
            format!("{indent}{{}}{} {}", formula(sign), formula(&Math::Row(rest.to_vec())))
        }
        _ => format!("{indent}{}", formula(&line.math)),
    }
}
