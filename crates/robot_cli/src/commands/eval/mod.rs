//! `eval`: a function of a robot at given states.

mod digits;
mod infinite;
mod output;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::functions::named;
use robot_build::{
    Bundle, Effects, FunctionKind, Functions, Options, Programs, Source, Trigonometry, programs_of,
};
use robot_codegen::module::Function;
use robot_codegen::{Interpreter, OutputValues};
use robot_model::description::Described;
use robot_model::robot::Robot;
use robot_model::variable::WRENCH;

use self::digits::Digits;
use crate::Terminal;
use crate::failure::Failure;
use crate::files;
use crate::options::help;
use crate::progress::watched;
use crate::robot::{RobotArgument, trigonometry};
use crate::settings::Settings;
use crate::states::{Layout, State, StateArguments};
use crate::suggested::FUNCTION;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic eval robots/planar_2r.toml --function gravity --q pi/2,-30deg
  robot-symbolic eval robots/planar_2r.toml --function inverse_dynamics --states - <<'END'
  [{\"q\": [0.3, 0.5], \"qd\": [0, 1], \"qdd\": [2, 0]}]
  END

States are a JSON array of objects with the keys q, qd, qdd, tau and wrench (fx, fy, fz, mx, my, mz;
wrench_NAME for each of several tips), or CSV with a header such as q1,q2,qd1,qd2,fx,fy,fz,mx,my,mz.
A function needs all its inputs except the wrench, whose default is 0. The wrench is the one that the tip
exerts on its surroundings. If a state has a nonzero wrench, inverse_dynamics means inverse_dynamics_wrench,
inverse_dynamics_friction means inverse_dynamics_wrench_friction, and likewise for forward_dynamics. Values
are computed by the straight-line program that the generated code is printed from.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// The function, or a bundle of the robot file's [code]; `jacobian_NAME` and `jacobian_dot_qd_NAME` for
    /// one frame or moving link
    #[arg(long, value_name = "NAME", value_parser = FUNCTION)]
    function: String,
    /// The file with the states; `-` for standard input
    #[arg(long, value_name = "FILE")]
    states: Option<PathBuf>,
    #[command(flatten)]
    state: StateArguments,
    #[command(flatten)]
    settings: Settings,
    #[arg(long, help = help("trigonometry"), default_value = "polynomial", value_parser = trigonometry())]
    trigonometry: Trigonometry,
    /// Output format
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
        if self.states.is_none() && !self.state.is_given() {
            let message = "a state is needed: --q, --qd, …, or --states with a file of states";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        let file = self.robot.open()?;
        let described = file.read(terminal)?;
        let Described { robot, code, .. } = &described;
        let bundles = code.bundles.iter().filter(|bundle| bundle.name == self.function);
        let bundles: Vec<Bundle> = bundles.cloned().collect();
        let kind = if bundles.is_empty() { Some(self.kind(robot)?) } else { None };
        let mut wrong = self.settings.wrong(robot);
        if wrong.is_empty() {
            self.settings.check(&file, &described, terminal)?;
        }
        let states = self.states(robot, terminal, &mut wrong)?;
        let kind = kind.map(|kind| with_wrench(kind, robot, &states, &mut wrong));
        let functions = kind.map_or(Functions::Usual, |kind| Functions::Chosen(vec![kind]));
        let options = Options { functions, bundles, ..file.options(terminal)? };
        let (name, robot) = (&file.source().name, robot.clone());
        let programs = watched("deriving", terminal, || programs_of(robot, name, &options))?;
        let digits = Digits::of(&programs, &options, &self.settings.pairs(), self.trigonometry)?;
        let results = self.results(file.source(), &programs, &states, wrong, &digits)?;
        digits.warn(&states, terminal)?;
        let shown = match self.format {
            Format::Json => output::json(&results),
            Format::Csv => output::csv(&results),
        };
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }

    /// The one function of that name.
    fn kind(&self, robot: &Robot) -> Result<FunctionKind, Failure> {
        let kind = named(robot, &self.function)
            .map_err(|wrong| Failure::Usage(vec![wrong.to_string()]))?;
        let parts = kind.parts(robot);
        if parts.is_empty() {
            return Ok(kind);
        }
        let names: Vec<String> = parts.iter().map(|part| part.full_name(robot)).collect();
        let (kind, names) = (kind.name(), names.join("`, `"));
        Err(Failure::Usage(vec![format!(
            "`{kind}` exists for each of several frames; choose one of `{names}`"
        )]))
    }

    fn states(
        &self,
        robot: &Robot,
        terminal: &mut Terminal<'_>,
        wrong: &mut Vec<String>,
    ) -> Result<Vec<State>, Failure> {
        let layout = Layout::of(robot);
        let Some(path) = &self.states else {
            let (state, found) = self.state.state(robot, &layout);
            return if found.is_empty() { Ok(vec![state]) } else { Err(Failure::Usage(found)) };
        };
        let (name, text) = files::read(path, terminal)?;
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
        let Some(function) = programs.module.functions.first() else {
            return Err(Failure::input(format!(
                "the robot does not have the function `{}`",
                self.function
            )));
        };
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
            .with_trigonometry(self.trigonometry);
        let callable = interpreter.function(&function.name).map_err(failed)?;
        let inputs = inputs(function, states);
        let given: Vec<(&str, &[Vec<f64>])> =
            inputs.iter().map(|(name, entries)| (*name, entries.as_slice())).collect();
        let values = callable.states(states.len(), &given).map_err(failed)?;
        let mut results = vec![];
        for (state, values) in states.iter().zip(values) {
            let outputs = callable.named(values);
            wrong.extend(infinite::messages(
                &programs.robot,
                &self.settings.pairs(),
                state,
                &outputs,
                digits,
                self.trigonometry,
            ));
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
    if let Some(why) = FunctionKind::InverseDynamics(Effects::WRENCH).missing_in(robot) {
        wrong
            .extend(loaded.iter().map(|state| format!("{}: has a wrench, but {why}", state.place)));
        return kind;
    }
    kind.with_effects(Effects { wrench: true, ..kind.effects() }).unwrap_or(kind)
}

/// The inputs that a state lacks; a wrench is 0 where it is not given.
fn missing_inputs(function: &Function, state: &State) -> Vec<String> {
    let missing = function
        .inputs
        .iter()
        .filter(|input| !input.name.starts_with(WRENCH) && state.array(&input.name).is_none());
    missing
        .map(|input| {
            format!("{}: `{}` is missing; {} needs it", state.place, input.name, function.name)
        })
        .collect()
}

/// The inputs of a function, each at all states; a wrench that is not given is 0.
fn inputs<'f>(function: &'f Function, states: &[State]) -> Vec<(&'f str, Vec<Vec<f64>>)> {
    let inputs = function.inputs.iter().map(|input| {
        let entries = |state: &State| {
            let entries = state.array(&input.name).map(<[f64]>::to_vec);
            entries.unwrap_or_else(|| vec![0.0; input.symbols.len()])
        };
        (input.name.as_str(), states.iter().map(entries).collect())
    });
    inputs.collect()
}
