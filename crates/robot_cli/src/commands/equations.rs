//! `equations`: the equations of motion of a robot.

use clap::{Args, ValueEnum};
use robot_document::{Equation, Equations, equations, tidied_text};
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::displayed::{LayoutArguments, Notation};
use crate::failure::Failure;
use crate::forms::{EquationArguments, FormName, failed};
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic equations robots/trttr1.toml
  robot-symbolic equations robots/trttr1.toml --quantity Q,F_l --format json
  robot-symbolic equations robots/trttr1.toml --form grouped --format latex --trig short
  robot-symbolic equations robots/panda.toml --form compact --format latex --width 8.5cm

Quantities: a_c accelerations of the centers of mass, F and M_c inertia forces and moments of the links,
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
        self.equations.check(&[self.form.into()], typeset)?;
        self.layout.check(typeset)?;
        if matches!(self.format, Format::Markdown) {
            self.layout.check_markdown()?;
        }
        if self.equations.digits().is_some() && matches!(self.format, Format::Json) {
            let message = "--digits has no effect on JSON, whose equations are exact; leave it out";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let options = self.equations.options(&self.robot, self.form.into())?;
        let robot = self.robot.printed(terminal)?;
        self.robot.check_base_frames(&[self.form.into()], terminal)?;
        self.equations.check_friction(&self.robot, &robot)?;
        let failed = |error| failed(&self.robot, &error);
        let equations =
            watched("deriving", terminal, || equations(&robot, &options)).map_err(failed)?;
        let displayed = |notation| {
            self.layout.displayed(&robot.name, &equations.groups, notation).map_err(failed)
        };
        let shown = match self.format {
            Format::Text => plain(&equations, options.digits),
            Format::Latex => displayed(Notation::Latex)?,
            Format::Typst => displayed(Notation::Typst)?,
            Format::Markdown => displayed(Notation::Markdown)?,
            Format::Mathml => displayed(Notation::Mathml)?,
            Format::Json => json(&robot.name, &equations),
        };
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }
}

/// `Q1 = …`, long sums on several lines.
pub(super) fn plain(equations: &Equations, digits: Option<usize>) -> String {
    let mut shown = String::new();
    for group in &equations.groups {
        if equations.groups.len() > 1 {
            let gap = if shown.is_empty() { "" } else { "\n" };
            shown.push_str(&format!("{gap}{}\n\n", group.title));
        }
        for equation in &group.equations {
            let right = tidied_text(&equation.text, digits);
            shown.push_str(&text::sum(&format!("{} = {right}", equation.name)));
        }
    }
    shown
}

/// `{"robot": …, "definitions": {…}, "quantities": {"Q1": …, …}}`; the definitions, each before it is
/// used by another, are left out where there are none.
fn json(robot: &str, equations: &Equations) -> String {
    let all = |list: &mut dyn Iterator<Item = &Equation>| -> Map<String, Value> {
        list.map(|equation| (equation.name.clone(), Value::String(equation.text.clone()))).collect()
    };
    let definitions = all(&mut equations.definitions());
    let quantities = all(&mut equations.quantities());
    let shown = match definitions.is_empty() {
        true => json!({ "robot": robot, "quantities": quantities }),
        false => json!({ "robot": robot, "definitions": definitions, "quantities": quantities }),
    };
    format!("{shown:#}\n")
}
