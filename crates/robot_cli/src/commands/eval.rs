//! `eval`: a function of a robot at given states.

mod digits;
mod output;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::{
    Bundle, FunctionKind, Functions, Options, Programs, Source, Trigonometry, programs,
};
use robot_codegen::module::Function;
use robot_codegen::{Interpreter, OutputValues};
use robot_dynamics::description::Described;
use robot_dynamics::model::Robot;

use self::digits::Digits;
use crate::Terminal;
use crate::failure::Failure;
use crate::files;
use crate::progress::watched;
use crate::robot::{RobotArgument, TrigonometryName, unknown_function};
use crate::settings::Settings;
use crate::states::{Layout, State, WRENCH};
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic eval robots/planar_2r.toml --function inverse_dynamics --states - <<'END'
  [{\"q\": [0.3, 0.5], \"qd\": [0, 1], \"qdd\": [2, 0]}]
  END

States are a JSON array of objects with the keys q, qd, qdd, tau and wrench (fx, fy, fz, mx, my, mz;
wrench_NAME for each of several tips), or CSV with a header such as q1,q2,qd1,qd2,fx,fy,fz,mx,my,mz.
A function needs all its inputs but the wrench, which is 0 where it is not given. Where a state has a
wrench other than 0, inverse_dynamics means inverse_dynamics_wrench, inverse_dynamics_friction means
inverse_dynamics_wrench_friction, and forward_dynamics means forward_dynamics_wrench. Numbers come
from the straight-line program that the generated code prints.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// The function, or a bundle of the robot file's [code]
    #[arg(long, value_name = "NAME")]
    function: String,
    /// The file with the states; `-` for standard input
    #[arg(long, value_name = "FILE")]
    states: PathBuf,
    #[command(flatten)]
    settings: Settings,
    /// Where sines and cosines come from
    #[arg(long, value_enum, default_value_t = TrigonometryName::Standard)]
    trigonometry: TrigonometryName,
    /// How to print the outputs
    #[arg(long, value_enum, default_value_t = Format::Json)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Json,
    Csv,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let source = self.robot.source()?;
        let Described { robot, code, .. } = robot_build::read(&source)?;
        let bundles = code.bundles.into_iter().filter(|bundle| bundle.name == self.function);
        let bundles: Vec<Bundle> = bundles.collect();
        let kind = if bundles.is_empty() { Some(self.kind(&robot)?) } else { None };
        let mut wrong = self.settings.wrong(&robot);
        let states = self.states(&Layout::of(&robot), terminal, &mut wrong)?;
        let kind = kind.map(|kind| with_wrench(kind, &robot, &states, &mut wrong));
        let functions = kind.map_or(Functions::Usual, |kind| Functions::Chosen(vec![kind]));
        let options = Options { functions, bundles, ..self.robot.options()? };
        let programs = watched("deriving", terminal, || programs(&source, &options))?;
        text::warnings(&programs.warnings, terminal)?;
        let digits = Digits::of(&programs, &options, &self.settings.pairs(), self.trigonometry)?;
        let results = self.results(&source, &programs, &states, wrong, &digits)?;
        digits.warn(&states, terminal)?;
        let shown = match self.format {
            Format::Json => output::json(&results),
            Format::Csv => output::csv(&results),
        };
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }

    /// The kind of the function: its name is the kind's, or has that of a frame behind it where
    /// there is one for each frame.
    fn kind(&self, robot: &Robot) -> Result<FunctionKind, Failure> {
        let suffixed = FunctionKind::ALL.iter().copied().find(|kind| {
            let suffix = self.function.strip_prefix(kind.name());
            let frame = suffix.and_then(|suffix| suffix.strip_prefix('_'));
            FunctionKind::from_name(&self.function).is_none()
                && kind.missing_in(robot).is_none()
                && frame.is_some_and(|frame| robot.frames.iter().any(|one| one.name == frame))
        });
        let known = suffixed.or_else(|| FunctionKind::from_name(&self.function));
        known.ok_or_else(|| Failure::Usage(vec![unknown_function(&self.function, &[])]))
    }

    /// The function among those of its kind.
    fn chosen<'p>(&self, programs: &'p Programs) -> Result<&'p Function, Failure> {
        match programs.module.functions.as_slice() {
            [function] => Ok(function),
            several => {
                let names: Vec<&str> =
                    several.iter().map(|function| function.name.as_str()).collect();
                let found = several.iter().find(|function| function.name == self.function);
                let choice = || {
                    let (kind, names) = (&self.function, names.join("`, `"));
                    format!("`{kind}` is a function of each named frame; choose one of `{names}`")
                };
                found.ok_or_else(|| Failure::Usage(vec![choice()]))
            }
        }
    }

    fn states(
        &self,
        layout: &Layout,
        terminal: &mut Terminal<'_>,
        wrong: &mut Vec<String>,
    ) -> Result<Vec<State>, Failure> {
        let (name, text) = files::read(&self.states, terminal)?;
        let (states, found) = layout.read(&text);
        wrong.extend(found.into_iter().map(|message| format!("{name}: {message}")));
        Ok(states)
    }

    /// The outputs at every state, where nothing is wrong.
    fn results(
        &self,
        source: &Source,
        programs: &Programs,
        states: &[State],
        mut wrong: Vec<String>,
        digits: &Digits,
    ) -> Result<Vec<Vec<OutputValues>>, Failure> {
        let function = self.chosen(programs)?;
        wrong.extend(states.iter().flat_map(|state| missing_inputs(function, state)));
        if !wrong.is_empty() {
            return Err(Failure::Input(wrong));
        }
        let failed = |errors: robot_codegen::Errors| {
            let errors = errors.as_slice().iter();
            Failure::Input(errors.map(|error| format!("{}: {error}", source.name)).collect())
        };
        let interpreter = Interpreter::new(&programs.module, &self.settings.pairs())
            .map_err(failed)?
            .with_trigonometry(Trigonometry::from(self.trigonometry));
        let mut results = vec![];
        for state in states {
            let inputs = inputs(function, state);
            let given: Vec<(&str, &[f64])> =
                inputs.iter().map(|(name, entries)| (*name, entries.as_slice())).collect();
            let outputs = interpreter.call(&function.name, &given).map_err(failed)?;
            let infinite: Vec<String> = infinite(state, &outputs).collect();
            let singular = digits.singular(state).filter(|_| !infinite.is_empty());
            wrong.extend(singular.map_or(infinite, |reason| vec![reason]));
            results.push(outputs);
        }
        if wrong.is_empty() { Ok(results) } else { Err(Failure::Input(wrong)) }
    }
}

/// The function that takes the wrenches which the states have.
fn with_wrench(
    kind: FunctionKind,
    robot: &Robot,
    states: &[State],
    wrong: &mut Vec<String>,
) -> FunctionKind {
    let loaded: Vec<&State> =
        states.iter().filter(|state| state.wrenches().next().is_some()).collect();
    if loaded.is_empty() {
        return kind;
    }
    if let Some(why) = FunctionKind::InverseDynamicsWrench.missing_in(robot) {
        wrong.extend(loaded.iter().map(|state| format!("{}: a wrench, but {why}", state.place)));
        return kind;
    }
    match kind {
        FunctionKind::InverseDynamics => FunctionKind::InverseDynamicsWrench,
        FunctionKind::InverseDynamicsFriction => FunctionKind::InverseDynamicsWrenchFriction,
        FunctionKind::ForwardDynamics => FunctionKind::ForwardDynamicsWrench,
        other => other,
    }
}

/// The inputs that a state lacks; a wrench is 0 where it is not given.
fn missing_inputs(function: &Function, state: &State) -> Vec<String> {
    let missing = function
        .inputs
        .iter()
        .filter(|input| !input.name.starts_with(WRENCH) && state.array(&input.name).is_none());
    missing
        .map(|input| {
            format!("{}: `{}` is missing; {} takes it", state.place, input.name, function.name)
        })
        .collect()
}

/// The inputs of a function at a state; a wrench that is not given is 0.
fn inputs<'f>(function: &'f Function, state: &State) -> Vec<(&'f str, Vec<f64>)> {
    let inputs = function.inputs.iter().map(|input| {
        let entries = state.array(&input.name).map(<[f64]>::to_vec);
        (input.name.as_str(), entries.unwrap_or_else(|| vec![0.0; input.symbols.len()]))
    });
    inputs.collect()
}

/// Outputs that JSON cannot hold.
fn infinite<'s>(
    state: &'s State,
    outputs: &'s [OutputValues],
) -> impl Iterator<Item = String> + use<'s> {
    let wrong =
        outputs.iter().filter(|output| output.values.iter().any(|value| !value.is_finite()));
    wrong.map(|output| {
        format!("{}: `{}` has no finite value; look at the parameters", state.place, output.name)
    })
}
