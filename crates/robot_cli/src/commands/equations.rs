//! `equations`: the equations of motion of a robot.

use clap::{Args, ValueEnum};
use robot_document::{Equation, Equations, Form, Room, equations};
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::displayed::{LayoutArguments, Notation};
use crate::failure::Failure;
use crate::forms::{EquationArguments, FormName, NO_DIGITS};
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic equations robots/trttr1.toml
  robot-symbolic equations robots/trttr1.toml --quantity Q,F_l --format json
  robot-symbolic equations robots/trttr1.toml --form grouped --format latex --trig short
  robot-symbolic equations robots/trttr1.toml --style paper --format latex
  robot-symbolic equations robots/trttr1.toml --like docs/trttr1.printed --format latex
  robot-symbolic equations robots/panda.toml --form compact --format latex --width 8.5cm

Quantities: a_c accelerations of the centers of mass, F and M_c resultant forces and moments on the links,
F_l and M_l contact forces and moments in the joints, Q joint torques; vectors are in link frames. In the
expanded form, products are multiplied out, even powers of sines are replaced by cosines, and like terms are
merged. The order of factors is: wrenches, masses and inertias, other parameters, sines and cosines, symbols
that a form defines, coordinates, velocities, accelerations, each by number; terms are in the order of their
factors. Symbols are q1, qd1, qdd1, … and the names in the robot file.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    equations: EquationArguments,
    /// Form of the equations
    #[arg(long, value_enum, default_value_t = FormName::Expanded)]
    form: FormName,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
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
        let typeset = !matches!(self.format, Format::Text | Format::Json);
        let forms = self.equations.forms(&[self.form]);
        self.equations.check(&forms, typeset)?;
        self.layout.check(typeset)?;
        if matches!(self.format, Format::Markdown) {
            self.layout.check_markdown()?;
        }
        if self.equations.digits().is_some() && matches!(self.format, Format::Json) {
            return Err(Failure::Usage(vec![NO_DIGITS.to_owned()]));
        }
        let form = forms.first().copied().unwrap_or_default();
        let mut options = self.equations.options(&self.robot, form)?;
        let robot = self.robot.printed(terminal)?;
        options.order = self.equations.order(&self.robot, &robot)?;
        options.rounds_roots &= !matches!(self.format, Format::Json);
        self.robot.check_base_frames(&forms, terminal)?;
        self.equations.check_friction(&self.robot, &robot)?;
        let failed = |error| self.equations.failed(&self.robot, &error);
        let equations =
            watched("deriving", terminal, || equations(&robot, &options)).map_err(failed)?;
        self.equations.check_layout(&equations)?;
        self.equations.note_differences(equations.differences, terminal)?;
        if !matches!(self.format, Format::Json) {
            self.equations.note_rounding(&equations, terminal)?;
        }
        let has_arrays = self.equations.has_arrays(&forms, typeset);
        if has_arrays {
            equations.check_array_names(typeset).map_err(failed)?;
        }
        let displayed = |notation| {
            let room = Room::Points(self.layout.line());
            let shown = if has_arrays { equations.arranged(room) } else { equations.listed() };
            self.layout.displayed(&robot.name, &shown.groups, notation).map_err(failed)
        };
        let shown = match self.format {
            Format::Text => {
                let equations = equations.readable(options.digits);
                let room = Room::Characters(text::COLUMNS);
                plain(&if has_arrays { equations.arranged(room) } else { equations.listed() })
            }
            Format::Json if has_arrays => json(&robot.name, &equations, Some(arrays(&equations))),
            Format::Latex => displayed(Notation::Latex)?,
            Format::Typst => displayed(Notation::Typst)?,
            Format::Markdown => displayed(Notation::Markdown)?,
            Format::Mathml => displayed(Notation::page(terminal)?)?,
            Format::Json => json(&robot.name, &equations, None),
        };
        if matches!(form, Form::Collected | Form::Expanded) && matches!(self.format, Format::Text) {
            note_length(shown.lines().count(), terminal)?;
        }
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }
}

/// The number of lines that people read at once, two or three pages.
const LONG: usize = 120;

/// Prints a note on a terminal if there are shorter forms of long equations.
fn note_length(lines: usize, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
    if terminal.progress && lines > LONG {
        let shorter = "--form grouped, with matrices, and --form compact, with names for what is repeated, are usually shorter";
        writeln!(terminal.errors, "note: {lines} lines; {shorter}")?;
    }
    Ok(())
}

/// Prints equations as `Q1 = …`; long sums take several lines.
pub(super) fn plain(equations: &Equations) -> String {
    let mut shown = String::new();
    for group in &equations.groups {
        if equations.groups.len() > 1 {
            let gap = if shown.is_empty() { "" } else { "\n" };
            shown.push_str(&format!("{gap}{}\n\n", group.title));
        }
        for equation in &group.equations {
            let head = format!("{} = ", equation.name);
            match equation.text.starts_with("[ ") {
                true => shown.push_str(&rows(&head, &equation.text)),
                false => shown.push_str(&text::sum(&format!("{head}{}", equation.text))),
            }
        }
    }
    shown
}

/// Prints the rows of a matrix below each other, after its name.
fn rows(head: &str, rows: &str) -> String {
    let indent = format!("\n{}", " ".repeat(head.len()));
    format!("{head}{}\n", rows.lines().collect::<Vec<_>>().join(&indent))
}

/// The rows of each matrix and column, with entries by name or in terms of definitions.
fn arrays(equations: &Equations) -> Map<String, Value> {
    equations.arrays().map(|array| (array.name.clone(), json!(array.names()))).collect()
}

/// Prints `{"robot": …, "definitions": {…}, "quantities": {"Q1": …, …}}`. Each definition comes before those that
/// use it; `definitions` is omitted if there are none. A joint torque that a definition uses is in both.
fn json(robot: &str, equations: &Equations, arrays: Option<Map<String, Value>>) -> String {
    let all = |list: &mut dyn Iterator<Item = &Equation>| -> Map<String, Value> {
        list.map(|equation| (equation.name.clone(), Value::String(equation.text.clone()))).collect()
    };
    let definitions = all(&mut equations.definitions());
    let quantities = all(&mut equations.quantities());
    let mut shown = match definitions.is_empty() {
        true => json!({ "robot": robot, "quantities": quantities }),
        false => json!({ "robot": robot, "definitions": definitions, "quantities": quantities }),
    };
    if let Some(arrays) = arrays {
        shown["arrays"] = Value::Object(arrays);
    }
    format!("{shown:#}\n")
}
