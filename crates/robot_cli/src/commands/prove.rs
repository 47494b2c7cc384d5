//! `prove`: properties of a robot's compiled code.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use robot_build::languages::Language;
use robot_evidence::{Compiler, Evidence, Measurements, Module, Profile, prove};
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::delivery::answered;
use crate::failure::Failure;
use crate::format::Format;
use crate::function::check_values_once;
use crate::interrupt;
use crate::progress::watched;
use crate::robot::{CodeArguments, RobotArgument};
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic prove robots/ur5.toml
  robot-symbolic prove robots/ur5.toml --function inverse_dynamics --scalar f32 \\
      --target thumbv7em-none-eabihf

Compiles the generated code and analyzes the object file. This command and `report` start another program:
rustc, which must be installed. Nothing is linked, so a target needs only `rustup target add`.

The claim: no conditional jump, except those by which a function chooses its copy for the processor
(`choices`); no panic, and no call except those of sines and cosines. The exit code is 1 if the claim is
false. In dev builds the runtime's sines and cosines loop over the angles, and are shown but not part of the
claim; arrays may be copied by memcpy. Functions of several states (batches, columns, blocks) loop over the
states; nothing is claimed about them in dev builds.

The counts of a function include all functions of the claim that it calls, each once. `frame` is the function's own stack, `stack`
that of the deepest chain of calls, in bytes; the stack of sin and cos is not included.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    code: CodeArguments,
    /// Cargo profiles to compile with
    #[arg(long, value_enum, value_delimiter = ',', default_values_t = [ProfileName::Dev, ProfileName::Release])]
    profile: Vec<ProfileName>,
    /// Target triple [default: this machine]
    #[arg(long, value_name = "TRIPLE")]
    target: Option<String>,
    /// Processor of the target, such as `native` [default: the target's baseline]
    #[arg(long, value_name = "CPU")]
    target_cpu: Option<String>,
    /// The compiler [default: the variable RUSTC, else rustc]
    #[arg(long, value_name = "PATH")]
    rustc: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ProfileName {
    Dev,
    Release,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        check_values_once("--profile", &self.profile)?;
        let robot = self.robot.read(terminal)?;
        let options = self.code.options(&self.robot, &robot, Language::Rust, terminal)?;
        if options.parallel {
            let note =
                "note: the parallel forms of batches need the crate rayon and are not compiled";
            writeln!(terminal.errors, "{note}")?;
        }
        let compiler = Compiler {
            rustc: self.rustc.clone(),
            target: self.target.clone(),
            cpu: self.target_cpu.clone(),
        };
        let profiles: Vec<Profile> = self.profile.iter().map(|profile| (*profile).into()).collect();
        let failed = |error: robot_evidence::Error| match error {
            robot_evidence::Error::Robot(errors) => Failure::Robot(errors),
            other => Failure::input(other.to_string()),
        };
        let description = compiler.description().map_err(failed)?;
        interrupt::remove_folders();
        let source = self.robot.source()?;
        let compiled = || prove(&source, &options, &compiler, &profiles);
        let modules = watched("compiling", terminal, compiled).map_err(failed)?;
        match self.format {
            Format::Text => {
                let tables = modules.iter().map(|module| format!("\n{}", text_of(module)));
                let tables: String = tables.collect();
                answered(&format!("{description}\n{tables}"), terminal)?;
            }
            Format::Json => {
                let modules: Vec<Value> = modules.iter().map(json_of).collect();
                let shown = json!({ "compiler": description, "profiles": modules });
                answered(&format!("{shown:#}\n"), terminal)?;
            }
        }
        let broken: Vec<String> = modules.iter().flat_map(violations).collect();
        if broken.is_empty() { Ok(()) } else { Err(Failure::Input(broken)) }
    }
}

impl From<ProfileName> for Profile {
    fn from(name: ProfileName) -> Profile {
        match name {
            ProfileName::Dev => Profile::Dev,
            ProfileName::Release => Profile::Release,
        }
    }
}

/// A named value of the measurements.
type Column = (&'static str, fn(&Measurements) -> u64);

const COLUMNS: [Column; 8] = [
    ("functions", |measurements| measurements.functions as u64),
    ("instructions", |measurements| measurements.instructions as u64),
    ("jumps", |measurements| measurements.conditional_jumps as u64),
    ("choices", |measurements| measurements.choices as u64),
    ("panics", |measurements| measurements.panics as u64),
    ("frame", |measurements| measurements.frame),
    ("stack", |measurements| measurements.stack),
    ("bytes", |measurements| measurements.bytes as u64),
];

/// Prints the table of a profile.
fn text_of(module: &Module) -> String {
    let mut title = vec![format!("{}: function", module.profile.name())];
    title.extend(COLUMNS.iter().map(|(name, _)| (*name).to_owned()));
    title.extend(["claim", "calls"].map(str::to_owned));
    let mut rows = vec![title];
    rows.extend(module.functions.iter().map(|function| {
        let claim = match (function.takes_states, function.violations.as_slice()) {
            (true, []) if module.profile == Profile::Dev => "none",
            (true, []) => "loops",
            (false, []) => "flat",
            _ => "BROKEN",
        };
        row(function, claim)
    }));
    rows.extend(module.trigonometry.iter().map(|function| row(function, "-")));
    text::table(&rows)
}

fn row(function: &Evidence, claim: &str) -> Vec<String> {
    let calls = function.calls.iter().map(|(symbol, count)| format!("{count} {symbol}"));
    let mut row = vec![function.name.clone()];
    row.extend(
        COLUMNS.iter().map(|(_, measurement)| measurement(&function.measurements).to_string()),
    );
    row.extend([claim.to_owned(), calls.collect::<Vec<_>>().join(", ")]);
    row
}

fn json_of(module: &Module) -> Value {
    let list = |functions: &[Evidence]| -> Vec<Value> { functions.iter().map(entry).collect() };
    json!({
        "profile": module.profile.name(),
        "flags": module.profile.flags(),
        "functions": list(&module.functions),
        "trigonometry": list(&module.trigonometry),
    })
}

fn entry(function: &Evidence) -> Value {
    let mut object = Map::new();
    object.insert("name".to_owned(), json!(function.name));
    for (name, measurement) in COLUMNS {
        object.insert(name.to_owned(), json!(measurement(&function.measurements)));
    }
    let calls = function.calls.iter().map(|(symbol, count)| (symbol.clone(), json!(count)));
    object.insert("calls".to_owned(), Value::Object(calls.collect()));
    object.insert("takes_states".to_owned(), json!(function.takes_states));
    let violations: Vec<String> = function.violations.iter().map(ToString::to_string).collect();
    object.insert("violations".to_owned(), json!(violations));
    Value::Object(object)
}

fn violations(module: &Module) -> Vec<String> {
    let profile = module.profile.name();
    let violations = module.violations();
    violations.map(|(function, violation)| format!("{profile}, {function}: {violation}")).collect()
}
