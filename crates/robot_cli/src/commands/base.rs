//! `base`: the base parameters of a robot.

use clap::{Args, ValueEnum};
use robot_build::base::{BaseEntry, BaseSet, base};
use robot_build::equations::{Notation, joined, lines};
use robot_symbolic::print::latex::Trigonometry;
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::failure::Failure;
use crate::robot::RobotArgument;
use crate::text;

/// The width of text, in columns.
const COLUMNS: usize = 100;
/// The width of a line of LaTeX, in printed characters.
const CHARACTERS: usize = 80;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic base robots/puma560.toml
  robot-symbolic base robots/puma560.toml --format latex
  robot-symbolic base robots/puma560.toml --format json

The base parameters are the fewest combinations of the parameters of links and drives that determine the
driving forces. Each is shown by its formula in these, which are named as by Khalil and Dombre, and by its
value: XX to ZZ are entries of a link's inertia tensor about the origin of its frame, MX, MY, MZ its first
moment, M its mass; IA is a drive's reflected inertia, FV, FP, FN its friction, FO its offset, IC the
coupling of its rotor. The number of the link follows. In JSON `column` is the column of the full regressor
that is the parameter's own; the function regressor_base has these columns alone.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// How to print them; LaTeX is for amsmath
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Latex,
    Json,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let notation = match self.format {
            Format::Text | Format::Json => Notation::Text,
            Format::Latex => Notation::Latex(Trigonometry::Named),
        };
        let set = base(&self.robot.source()?, self.robot.snap(), notation)?;
        text::warnings(&set.warnings, terminal)?;
        let shown = match self.format {
            Format::Text => plain(&set),
            Format::Latex => latex(&set),
            Format::Json => json(&set),
        };
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }
}

/// `ZZR_2 = …`, its value below, long sums on several lines.
fn plain(set: &BaseSet) -> String {
    let (count, all) = (set.list.len(), set.standard.len());
    let mut shown = format!("{}: {count} base parameters of {all}", set.robot.name);
    shown.push_str(if set.rounded { ", with rounded figures\n" } else { "\n" });
    for entry in &set.list {
        let formula = format!("{} = {}", entry.name, joined(&entry.formula));
        let value = format!("  = {}", joined(&entry.value));
        for (whole, indent) in [(formula, "    "), (value, "    ")] {
            for (place, line) in text::wrapped(&whole, COLUMNS).iter().enumerate() {
                shown.push_str(if place == 0 { "" } else { indent });
                shown.push_str(line);
                shown.push('\n');
            }
        }
    }
    shown
}

/// An environment of amsmath with all formulas and values, long sums on several lines.
fn latex(set: &BaseSet) -> String {
    let mut rows = vec![];
    for BaseEntry { left, formula, value, .. } in &set.list {
        for (side, terms) in [(left.as_str(), formula), ("", value)] {
            for (place, line) in lines(terms, CHARACTERS).iter().enumerate() {
                rows.push(match place {
                    0 => format!("  {side} &= {line}"),
                    _ => format!("    &\\quad {line}"),
                });
            }
        }
    }
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", rows.join(" \\\\\n"))
}

/// `{"robot": …, "standard": […], "base": [{"name": …, "column": …, "formula": …, "figures": {…},
/// "value": …}, …]}`
fn json(set: &BaseSet) -> String {
    let entry = |entry: &BaseEntry| {
        let figures: Map<String, Value> = entry
            .figures
            .iter()
            .filter_map(|(column, figure)| {
                Some((set.standard.get(*column)?.clone(), Value::String(figure.clone())))
            })
            .collect();
        json!({
            "name": entry.name,
            "column": entry.column,
            "formula": joined(&entry.formula),
            "figures": figures,
            "value": joined(&entry.value),
        })
    };
    let shown = json!({
        "robot": set.robot.name,
        "rounded": set.rounded,
        "standard": set.standard,
        "base": set.list.iter().map(entry).collect::<Vec<_>>(),
    });
    format!("{shown:#}\n")
}
