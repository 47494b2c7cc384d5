//! `equations`: the equations of motion of a robot.

use clap::{Args, ValueEnum};
use robot_build::equations::{EquationOptions, Equations, Notation, equations};
use robot_dynamics::quantity::Kind;
use robot_symbolic::print::latex::Trigonometry;
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;

/// The width of text, in columns.
const COLUMNS: usize = 100;
/// The width of a line of LaTeX, in printed characters.
const CHARACTERS: usize = 80;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic equations robots/trttr1.toml
  robot-symbolic equations robots/trttr1.toml --quantity Q,F_l --format json
  robot-symbolic equations robots/trttr1.toml --format latex --trig paper

Quantities: a_c accelerations of the mass centres, F and M_c inertia forces and moments of the links,
F_l and M_l forces and moments in the joints, Q driving forces; vectors in link frames. The expanded
form has products multiplied out, sines of even powers replaced by cosines, and like terms merged.
Symbols are q1, qd1, qdd1, … and the names of the robot file.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Quantities: a_c, F, M_c, F_l, M_l, Q, or all
    #[arg(long = "quantity", value_name = "NAMES", value_delimiter = ',', default_value = "Q")]
    quantities: Vec<String>,
    /// The form of the equations
    #[arg(long, value_enum, default_value_t = Form::Expanded)]
    form: Form,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Sines and cosines in LaTeX
    #[arg(long, value_enum, default_value_t = TrigonometryStyle::Named)]
    trig: TrigonometryStyle,
    /// Include friction in the driving forces
    #[arg(long)]
    friction: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Form {
    /// Sums of products, like terms merged
    Expanded,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Latex,
    Json,
}

#[derive(Clone, Copy, ValueEnum)]
enum TrigonometryStyle {
    /// \sin q_2
    Named,
    /// s_2
    Short,
    /// sq_2
    Paper,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let options = EquationOptions {
            kinds: kinds(&self.quantities)?,
            friction: self.friction,
            snap: self.robot.snap(),
            notation: self.notation(),
        };
        // There is one form as yet.
        let Form::Expanded = self.form;
        let source = self.robot.source()?;
        let equations = watched("expanding", terminal, || equations(&source, &options))?;
        text::warnings(&equations.warnings, terminal)?;
        let shown = match self.format {
            Format::Text => plain(&equations),
            Format::Latex => latex(&equations),
            Format::Json => json(&equations),
        };
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }

    fn notation(&self) -> Notation {
        match (self.format, self.trig) {
            (Format::Text | Format::Json, _) => Notation::Text,
            (Format::Latex, TrigonometryStyle::Named) => Notation::Latex(Trigonometry::Named),
            (Format::Latex, TrigonometryStyle::Short) => Notation::Latex(Trigonometry::Short),
            (Format::Latex, TrigonometryStyle::Paper) => Notation::Latex(Trigonometry::Paper),
        }
    }
}

/// The quantities of those names, each once.
fn kinds(names: &[String]) -> Result<Vec<Kind>, Failure> {
    let (mut kinds, mut wrong): (Vec<Kind>, _) = (vec![], vec![]);
    let mut known: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    known.push("all");
    for name in names {
        match (name.as_str(), Kind::from_name(name)) {
            ("all", _) => kinds.extend(Kind::ALL),
            (_, Some(kind)) => kinds.push(kind),
            _ => wrong.push(text::unknown("quantity", name, &known)),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Usage(wrong));
    }
    let mut seen: Vec<Kind> = vec![];
    for kind in kinds {
        if !seen.contains(&kind) {
            seen.push(kind);
        }
    }
    Ok(seen)
}

/// `Q1 = …`, long sums on several lines.
pub(super) fn plain(equations: &Equations) -> String {
    let mut shown = String::new();
    for equation in &equations.list {
        let whole = format!("{} = {}", equation.name, equation.right());
        for (place, line) in text::wrapped(&whole, COLUMNS).iter().enumerate() {
            shown.push_str(if place == 0 { "" } else { "    " });
            shown.push_str(line);
            shown.push('\n');
        }
    }
    shown
}

/// An environment of amsmath with all equations, long sums on several lines.
fn latex(equations: &Equations) -> String {
    let mut lines = vec![];
    for equation in &equations.list {
        for (place, line) in equation.lines(CHARACTERS).iter().enumerate() {
            lines.push(match place {
                0 => format!("  {} &= {line}", equation.left),
                _ => format!("    &\\quad {line}"),
            });
        }
    }
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n"))
}

/// `{"robot": …, "quantities": {"Q1": …, …}}`
fn json(equations: &Equations) -> String {
    let quantities: Map<String, Value> = equations
        .list
        .iter()
        .map(|equation| (equation.name.clone(), Value::String(equation.right())))
        .collect();
    let shown = json!({ "robot": equations.robot.name, "quantities": quantities });
    format!("{shown:#}\n")
}
