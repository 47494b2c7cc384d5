//! `eval`: a function of a robot at given states.

mod digits;
mod evaluation;
mod infinite;
mod output;

use std::ffi::OsStr;
use std::io::Read;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::functions::named;
use robot_build::{
    Bundle, Effects, FunctionKind, Functions, Options, Ownership, Programs, Trigonometry, Writer,
    programs_of,
};
use robot_codegen::module::Function;
use robot_jit::Executable;
use robot_model::description::Described;
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, WRENCH};

use self::digits::Digits;
use self::evaluation::{Evaluation, Task, failed};
use self::output::Printer;
use crate::Terminal;
use crate::delivery::{ForceArgument, Kind, file_of};
use crate::failure::Failure;
use crate::format::contradicts_name;
use crate::limits;
use crate::options::help;
use crate::outgoing::Outgoing;
use crate::progress::watched;
use crate::robot::{RobotArgument, trigonometry};
use crate::settings::Settings;
use crate::states::{Input, Layout, Sink, State, StateArguments};
use crate::suggested::FUNCTION;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic eval robots/planar_2r.toml --function gravity --q pi/2,-30deg
  robot-symbolic eval robots/planar_2r.toml --function inverse_dynamics --states - <<'END'
  [{\"q\": [0.3, 0.5], \"qd\": [0, 1], \"qdd\": [2, 0]}]
  END

States are a JSON array of objects with the keys q, qd, qdd, tau and wrench (fx, fy, fz, mx, my, mz; wrench_NAME
for each of several tips), or CSV with a header such as q1,q2,qd1,qd2,fx,fy,fz,mx,my,mz. A function needs all
its inputs except the wrench, whose default is 0. States may have more of these keys and columns than it needs,
and the columns t, kinetic, potential and energy of a simulated motion, but no others. The wrench is the one that the tip exerts on its surroundings.
If a state has a nonzero wrench, inverse_dynamics means inverse_dynamics_wrench, inverse_dynamics_friction means
inverse_dynamics_wrench_friction, and likewise for forward_dynamics. The values come from the same straight-line
program from which the code is printed. States are read, and their outputs printed, one by one, however many
there are; -o writes the file once all are computed.")]
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
    /// The file to write once all states are computed; `-` is standard output, state by state [default: -]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgument,
    /// Output format [default: csv for a file NAME.csv, else json]
    #[arg(long, value_enum)]
    format: Option<Format>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Json,
    Csv,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        self.settings.check_once()?;
        let (path, writer) = (file_of(self.output.as_deref()), self.writer()?);
        let format = self.format()?;
        let file = self.robot.open()?;
        let described = file.read(terminal)?;
        let Described { robot, code, .. } = &described;
        let bundles = code.bundles.iter().filter(|bundle| bundle.name == self.function);
        let bundles: Vec<Bundle> = bundles.cloned().collect();
        let kind = if bundles.is_empty() { Some(self.kind(robot)?) } else { None };
        self.check_state(kind)?;
        let functions = Functions::Chosen(kind.into_iter().collect());
        self.robot.check_base_frames_of(&functions, &bundles, terminal)?;
        let takes_wrench = kind.is_some_and(|kind| kind.effects().wrench);
        let before = self.settings.wrong(robot);
        if before.is_empty() {
            self.settings.check(&file, &described, terminal)?;
        }
        let layout = Layout::of(robot);
        let mut nothing = std::io::empty();
        let (standard, mut terminal) = terminal.without_input(&mut nothing);
        let terminal = &mut terminal;
        let mut states = self.states(robot, &layout, standard, terminal)?;
        let found = kind.map(|kind| with_wrench(kind, robot, &layout, &mut states)).transpose()?;
        let (kind, no_wrench) = found.unzip();
        let functions = kind.map_or(Functions::Usual, |kind| Functions::Chosen(vec![kind]));
        let options = Options { functions, bundles, ..file.options(terminal)? };
        let (name, robot) = (&file.source().name, robot.clone());
        let programs = watched("deriving", terminal, || programs_of(robot, name, &options))?;
        let (settings, known) = (&self.settings.pairs(), before.is_empty().then_some(&programs));
        let digits = Digits::of(known, &options, settings, self.trigonometry)?;
        let executable = known.map(|one| self.executable(name, one)).transpose()?;
        let Some(function) = programs.module.functions.first() else {
            let message = format!("the robot does not have the function `{}`", self.function);
            return Err(Failure::input(message));
        };
        states.check(&self.state, function, no_wrench.as_ref().is_some_and(Option::is_some))?;
        let handle = executable.as_ref().map(|one| one.function(&function.name));
        let handle = handle.transpose().map_err(|errors| failed(name, &errors))?;
        let task = Task {
            robot: &programs.robot,
            settings,
            trigonometry: self.trigonometry,
            digits: &digits,
            function,
            handle,
            no_wrench: no_wrench.flatten(),
            takes_wrench,
            printer: Printer::new(format, &function.outputs),
            file: name,
            source: states.source(),
        };
        let begin = |path| Ok::<_, Failure>((writer.begin(path, Ownership::Edited)?, path));
        let pending = path.map(begin).transpose()?;
        let outgoing = Outgoing::new(pending, terminal.output, terminal.errors);
        let before = before.into_iter().collect();
        let mut evaluation = Evaluation::new(task, &layout, before, outgoing);
        states.read(&layout, &mut evaluation)?;
        evaluation.end()
    }

    /// Checks that a state is given, unless the function has no inputs.
    fn check_state(&self, kind: Option<FunctionKind>) -> Result<(), Failure> {
        let needs_state = kind.is_none_or(|kind| !kind.inputs().is_empty());
        if self.states.is_none() && !self.state.is_given() && needs_state {
            let message = "a state is needed: --q, --qd, …, or --states with a file of states";
            return Err(Failure::Usage(vec![message.to_owned()]));
        }
        Ok(())
    }

    /// The writer of the output.
    fn writer(&self) -> Result<Writer, Failure> {
        let inputs = self.robot.inputs().into_iter().chain(self.states.clone());
        let path = file_of(self.output.as_deref());
        let writer = self.force.writer(inputs, path.is_some())?;
        if let Some(path) = path {
            writer.check(&[(path, Ownership::Edited)])?;
        }
        Ok(writer)
    }

    /// The format that is chosen, or else the one given by the ending of the file's name.
    fn format(&self) -> Result<Format, Failure> {
        let Some(path) = file_of(self.output.as_deref()) else {
            return Ok(self.format.unwrap_or(Format::Json));
        };
        let extension = path.extension().map(OsStr::to_ascii_lowercase);
        let named = match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("csv") => Some(Format::Csv),
            Some("json") => Some(Format::Json),
            _ => None,
        };
        if named.is_none() {
            Kind { doc: "results are JSON or CSV", ending: "json" }.check(path)?;
        }
        if let (Some(format), Some(named)) = (self.format, named)
            && format != named
        {
            return Err(contradicts_name(path));
        }
        Ok(self.format.or(named).unwrap_or(Format::Json))
    }

    /// Compiles the programs with the parameter values that are set.
    fn executable<'p>(
        &self,
        file: &str,
        programs: &'p Programs,
    ) -> Result<Executable<'p>, Failure> {
        Executable::new(&programs.module, &self.settings.pairs(), self.trigonometry)
            .map_err(|errors| failed(file, &errors))
    }

    /// Finds the function with the given name.
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

    fn states<'l, 't>(
        &self,
        robot: &Robot,
        layout: &'l Layout,
        standard: &'t mut dyn Read,
        terminal: &mut Terminal<'_>,
    ) -> Result<States<'l, 't>, Failure> {
        let Some(path) = &self.states else {
            let (state, wrong) = self.state.state(robot, layout);
            if !wrong.is_empty() {
                return Err(Failure::Usage(wrong));
            }
            let positions = state.array(JointVariable::Position.name()).unwrap_or_default();
            limits::note(("--q", self.state.positions()), positions, robot, terminal)?;
            return Ok(States::Given(state));
        };
        Ok(States::Read(Input::open(path, standard)?))
    }
}

/// The states: one from the command line, or many from a file.
enum States<'l, 't> {
    Given(State<'l>),
    Read(Input<'t>),
}

impl<'l> States<'l, '_> {
    /// The name of the file of states, if there is one.
    fn source(&self) -> Option<String> {
        match self {
            States::Given(_) => None,
            States::Read(input) => Some(input.name().to_owned()),
        }
    }

    /// Returns an error for options of the state that have no effect on a function. Files may have further columns and
    /// keys, so that one file is for all functions. A wrench that the robot must not have is another error.
    fn check(
        &self,
        given: &StateArguments,
        function: &Function,
        is_refused: bool,
    ) -> Result<(), Failure> {
        let States::Given(state) = self else { return Ok(()) };
        let inputs: Vec<&str> = function.inputs.iter().map(|input| input.name.as_str()).collect();
        let mut unused = given.unused(&inputs);
        let takes_wrench = inputs.iter().any(|input| input.starts_with(WRENCH));
        if state.has_wrench() && !takes_wrench && !is_refused {
            unused.push(WRENCH);
        }
        let (name, inputs) = (&function.name, inputs.join(", "));
        let takes = if inputs.is_empty() { "nothing".to_owned() } else { inputs };
        let wrong: Vec<String> = unused
            .iter()
            .map(|option| {
                format!("--{option} has no effect on {name}, which takes {takes}; leave it out")
            })
            .collect();
        if wrong.is_empty() { Ok(()) } else { Err(Failure::Usage(wrong)) }
    }

    /// Whether any state has a wrench.
    fn have_wrench(&mut self, layout: &Layout) -> Result<bool, Failure> {
        match self {
            States::Given(state) => Ok(state.has_wrench()),
            States::Read(input) => input.has_wrench(layout),
        }
    }

    fn read(self, layout: &'l Layout, sink: &mut dyn Sink<'l>) -> Result<(), Failure> {
        match self {
            States::Given(mut state) => {
                let _ = sink.state(&mut state);
                Ok(())
            }
            States::Read(mut input) => input.read(layout, sink),
        }
    }
}

/// Replaces the function with the one that takes wrenches, if states have any and there is one; also returns the
/// reason if the robot has no such function.
fn with_wrench(
    kind: FunctionKind,
    robot: &Robot,
    layout: &Layout,
    states: &mut States<'_, '_>,
) -> Result<(FunctionKind, Option<String>), Failure> {
    if !states.have_wrench(layout)? {
        return Ok((kind, None));
    }
    if let Some(why) = FunctionKind::InverseDynamics(Effects::WRENCH).missing_in(robot) {
        return Ok((kind, Some(why.to_owned())));
    }
    let extended = kind.with_effects(Effects { wrench: true, ..kind.effects() });
    Ok((extended.unwrap_or(kind), None))
}
