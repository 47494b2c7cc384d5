//! Displayed equations, as several commands print them.

use clap::Args;
use robot_document::document::NumberedEquation;
use robot_document::latex::{self, Layout};
use robot_document::{Equation, Error, Group, typst};

/// The narrowest and the widest line, cm.
const WIDTHS: std::ops::RangeInclusive<f64> = 3.0..=100.0;

/// How displayed equations are laid out.
#[derive(Args)]
pub(crate) struct LayoutArguments {
    /// The width of the lines of LaTeX and Typst, such as 8.5cm
    #[arg(long, value_name = "WIDTH", value_parser = centimetres, default_value = "16cm")]
    width: f64,
    /// Number the equations of LaTeX and Typst, each with a label such as eq:Q1
    #[arg(long)]
    numbers: bool,
}

/// A notation of displayed equations.
#[derive(Clone, Copy)]
pub(crate) enum Notation {
    Latex,
    Typst,
}

impl LayoutArguments {
    /// Displayed equations, a comment before each group where there are several.
    pub(crate) fn displayed(&self, groups: &[Group], notation: Notation) -> Result<String, Error> {
        let comment = match notation {
            Notation::Latex => "%",
            Notation::Typst => "//",
        };
        let mut shown = String::new();
        let layout = Layout::of_centimetres(self.width);
        for group in groups {
            if groups.len() > 1 {
                shown.push_str(&format!("{comment} {}\n", group.title));
            }
            let numbered = |equation: &Equation| NumberedEquation {
                label: self.numbers.then(|| equation.label()),
                equation: equation.clone(),
            };
            let list: Vec<NumberedEquation> = group.equations.iter().map(numbered).collect();
            shown.push_str(&match notation {
                Notation::Latex => latex::equations(&list, layout),
                Notation::Typst => typst::equations(&list, layout),
            }?);
        }
        Ok(shown)
    }
}

/// `8.5cm` or `8.5`, in centimetres.
pub(crate) fn centimetres(text: &str) -> Result<f64, String> {
    let digits = text.strip_suffix("cm").unwrap_or(text).trim();
    let width: Option<f64> = digits.parse().ok();
    let width = width.filter(|width| WIDTHS.contains(width));
    width
        .ok_or_else(|| "a width is a number of centimetres from 3 to 100, such as 8.5cm".to_owned())
}
