//! `base`: the base parameters of a robot.

use clap::{Args, ValueEnum};
use robot_build::BaseFrames;
use robot_document::DIGITS;
use robot_document::base_parameters::{BaseEntry, BaseSet, base};
use robot_model::robot::{Friction, Robot};
use robot_symbolic::Formula;
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::delivery::size;
use crate::displayed::{LayoutArguments, Notation};
use crate::failure::Failure;
use crate::forms::{NO_DIGITS, failed, note_rounding};
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;
use crate::values::whole;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic base robots/puma560.toml
  robot-symbolic base robots/puma560.toml --format latex --width 8.5cm
  robot-symbolic base robots/puma560.toml --format json

The base parameters are the smallest set of combinations of link and drive parameters that determines the joint
torques. Each is shown with its formula and value, under the name that Khalil and Dombre use: XX to ZZ are the
entries of a link's inertia tensor about the origin of its frame, MX, MY, MZ its first moment, M its mass; IA is
a drive's reflected inertia (armature), FV its viscous friction, FP and FN its dry friction forward and
backward, FO its friction offset, IC the coupling of its rotor. The number of the link follows. In JSON,
`column` is the parameter's column in the full regressor; the function regressor_base has only these columns.

With --base-frames denavit_hartenberg the base parameters are first and second moments (SXX is the integral of
x^2 dm) in Denavit-Hartenberg frames; their formulas still use the parameters in the file's frames, and they do
not correspond to single columns of the full regressor.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Output format; LaTeX needs amsmath
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Significant digits of decimals; 17 prints all [default: 10]
    #[arg(long, value_name = "N", value_parser = whole(1..=17_u8), allow_negative_numbers = true)]
    digits: Option<u8>,
    #[command(flatten)]
    layout: LayoutArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    #[value(alias = "tex")]
    Latex,
    Typst,
    /// Markdown with formulas between $$
    Markdown,
    /// An HTML page with formulas in MathML
    Mathml,
    Json,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        self.layout.check(!matches!(self.format, Format::Text | Format::Json))?;
        if matches!(self.format, Format::Markdown) {
            self.layout.check_markdown()?;
        }
        if self.digits.is_some() && matches!(self.format, Format::Json) {
            return Err(Failure::Usage(vec![NO_DIGITS.to_owned()]));
        }
        // Values are those of the file; what people read has multiples of π/2 for rounded angles, as equations have.
        let robot = match self.format {
            Format::Json => self.robot.read(terminal)?.robot,
            _ => self.robot.printed(terminal)?,
        };
        let failed = |error| failed(&self.robot, &error);
        let snap = self.robot.snap();
        let exact = watched("deriving", terminal, || base(&robot, snap)).map_err(failed)?;
        let (set, is_rounded) = exact.readable(self.digits.map_or(DIGITS, usize::from));
        if !matches!(self.format, Format::Json) {
            note_rounding(is_rounded && self.digits.is_none(), terminal)?;
        }
        let displayed =
            |notation| self.layout.displayed(&robot.name, &[set.group()], notation).map_err(failed);
        let shown = match self.format {
            Format::Text => plain(&robot, &set),
            Format::Latex => displayed(Notation::Latex)?,
            Format::Typst => displayed(Notation::Typst)?,
            Format::Markdown => displayed(Notation::Markdown)?,
            Format::Mathml => displayed(Notation::page(terminal)?)?,
            Format::Json => json(&robot, &exact),
        };
        if shown.len() > LONG && !matches!(self.format, Format::Json) {
            writeln!(
                terminal.errors,
                "note: the formulas take {}; the function base_parameters computes their values",
                size(shown.len())
            )?;
        }
        note_friction(&robot, terminal)?;
        note_inseparable(&set, terminal)?;
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }
}

fn acts(formula: &Formula) -> bool {
    formula.as_number().is_none_or(|one| one.to_f64() != 0.0)
}

/// Prints notes about joints whose friction is not part of the base parameters, and about those whose offset cannot be
/// distinguished from their constant dry friction while they move.
fn note_friction(robot: &Robot, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    let is_dry = |friction: &Friction| {
        [&friction.coulomb_positive, &friction.coulomb_negative].into_iter().any(acts)
    };
    let mut note = |concerns: &dyn Fn(&Friction) -> bool, message: &str| -> Result<(), Failure> {
        let joints = robot.links.iter().filter(|link| concerns(&link.friction));
        let names: Vec<&str> = joints.map(|link| link.joint.name.as_str()).collect();
        if !names.is_empty() {
            writeln!(terminal.errors, "note: {}: {message}", names.join(", "))?;
        }
        Ok(())
    };
    note(
        &|friction| acts(&friction.coulomb),
        "friction that depends on the load (`coulomb`) is not part of the base parameters: it is a product of its \
         coefficient and a contact force, so the joint torques are not linear in both",
    )?;
    note(
        &|friction| acts(&friction.offset) && is_dry(friction),
        "the column of FO differs from that of FP minus that of FN only at rest or, with a smoothing, at low \
         velocities; to fit logs of motion, leave `offset` out: FP and FN then include it",
    )
}

/// Prints a note for each group of base parameters that logs of motion do not separate.
fn note_inseparable(set: &BaseSet, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    for group in &set.inseparable {
        let names = group.iter().filter_map(|place| set.list.get(*place));
        let names: Vec<&str> = names.map(|entry| entry.name.as_str()).collect();
        writeln!(
            terminal.errors,
            "note: {}: their columns are linearly dependent while the joints move, because gravity on a slide is \
             constant; to fit logs of motion, give one of them its known value, or leave `drive` out",
            names.join(", ")
        )?;
    }
    Ok(())
}

/// The number of bytes of formulas that people can read, those of some thirty pages.
const LONG: usize = 100_000;

/// Prints each base parameter as `ZZR_2 = …`, with its value below; long sums take several lines.
fn plain(robot: &Robot, set: &BaseSet) -> String {
    let (count, all) = (set.list.len(), set.standard.len());
    let mut shown = format!("{}: {} of {all}", robot.name, text::counted(count, "base parameter"));
    if robot.base_frames == BaseFrames::DenavitHartenberg {
        shown
            .push_str(", moments in Denavit-Hartenberg frames, formulas in the frames of the file");
    }
    shown.push_str(if set.rounded { ", with rounded coefficients\n" } else { "\n" });
    for entry in &set.list {
        if entry.formula.text == entry.name {
            shown.push_str(&text::sum(&format!("{} = {}", entry.name, entry.value.text)));
            continue;
        }
        shown.push_str(&text::sum(&format!("{} = {}", entry.name, entry.formula.text)));
        shown.push_str(&text::sum(&format!("  = {}", entry.value.text)));
    }
    shown
}

/// Prints the base parameters as `{"robot": …, "frames": …, "rounded": …, "standard": […], "base": [{"name": …,
/// "column": …, "formula": …, "coefficients": {…}, "value": …}, …]}`.
fn json(robot: &Robot, set: &BaseSet) -> String {
    let entry = |entry: &BaseEntry| {
        let coefficients: Map<String, Value> = entry
            .coefficients
            .iter()
            .filter_map(|(column, coefficient)| {
                Some((set.standard.get(*column)?.clone(), Value::String(coefficient.clone())))
            })
            .collect();
        json!({
            "name": entry.name,
            "column": entry.column,
            "formula": entry.formula.text,
            "coefficients": coefficients,
            "value": entry.value.text,
        })
    };
    let shown = json!({
        "robot": robot.name,
        "frames": robot.base_frames.name(),
        "rounded": set.rounded,
        "standard": set.standard,
        "base": set.list.iter().map(entry).collect::<Vec<_>>(),
    });
    format!("{shown:#}\n")
}
