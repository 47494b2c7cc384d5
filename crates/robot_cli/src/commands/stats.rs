//! `stats`: the operations of a robot's functions.

use clap::Args;
use robot_build::ablation::{Ablation, ablation};
use robot_build::{Functions, Options, programs, snapping};
use robot_codegen::backend::rust::LANGUAGE;
use robot_codegen::{CodeSize, Counts, FunctionCounts, Module};
use robot_model::description::Described;
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::counts;
use crate::failure::Failure;
use crate::format::Format;
use crate::function::functions;
use crate::progress::watched;
use crate::robot::{BundleArguments, RobotArgument};
use crate::suggested::FUNCTIONS;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic stats robots/puma560.toml --format text
  robot-symbolic stats robots/puma560.toml --function inverse_dynamics --passes
  robot-symbolic stats robots/puma560.toml --function inverse_dynamics --options
  robot-symbolic stats robots/puma560.toml --function mass_matrix,bias --bundle both=mass_matrix,bias

Subtractions count as additions; sign changes are not counted, and a fused multiply-add counts as two
operations. `other` counts absolute values, signs and hyperbolic tangents. The operations of the constructor,
once per set of parameters, are counted separately. All functions are derived in one graph, and the passes
depend on its order, so the count of a function can differ by a few operations from that of the function alone.

The size of the code is an estimate for x86-64, usually within a tenth. Code larger than 32 KB does not fit the
instruction cache of most processors: a call then takes at least the time to fetch it.

--passes shows the operations of each function after each pass; `as built` is the result of the recursion,
`constructor` what remains for calls. The last row adds sines, cosines and sums of angles. --options shows the operations of each function without one option of the
recursion or one pass; the savings do not add up, because the options interact.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Functions to count [default without --bundle: every function of the robot, and the bundles of
    /// the robot file's [code]]
    #[arg(long = "function", value_name = "NAME", value_delimiter = ',',
          value_parser = FUNCTIONS)]
    functions: Vec<String>,
    #[command(flatten)]
    bundles: BundleArguments,
    /// Show the operations after each pass
    #[arg(long)]
    passes: bool,
    /// Show the savings of each option of the recursion and each pass
    #[arg(long, conflicts_with = "passes")]
    options: bool,
    /// Output format [default: text on a terminal, else json]
    #[arg(long, value_enum)]
    format: Option<Format>,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let source = self.robot.source()?;
        let Described { robot, code, .. } = self.robot.read(terminal)?;
        let (functions, bundles) = match (self.functions.as_slice(), self.bundles.bundles(&robot)?)
        {
            ([], bundles) if bundles.is_empty() => (Functions::All, code.bundles),
            ([], bundles) => (Functions::Usual, bundles),
            (names, bundles) => (functions(names, &robot)?, bundles),
        };
        self.robot.check_base_frames_of(&functions, &bundles, terminal)?;
        let options = Options { functions, bundles, ..self.robot.options(terminal)? };
        if options.functions == Functions::All {
            text::lacking(&robot, &options, terminal)?;
        }
        if self.options {
            let counted = watched("counting", terminal, || ablation(&source, &options))?;
            return self.show(&ablated(&counted), terminal);
        }
        let programs = watched("counting", terminal, || programs(&source, &options))?;
        let module = &programs.module;
        if self.passes {
            return self.show(&passes(module), terminal);
        }
        let counts: Vec<(&str, FunctionCounts, CodeSize)> = module
            .functions
            .iter()
            .map(|function| {
                let counts = module.counts(function).laid_out(function, &LANGUAGE.limits);
                (function.name.as_str(), counts, CodeSize::of(function, &counts.call))
            })
            .collect();
        match self.format(terminal) {
            Format::Json => {
                let functions: Map<String, Value> = counts
                    .iter()
                    .map(|(name, counts, size)| ((*name).to_owned(), counts::json(counts, *size)))
                    .collect();
                let snapping = snapping(&programs.robot, options.snap, options.plan.as_ref())?;
                let shown = json!({
                    "robot": programs.robot.name,
                    "functions": functions,
                    "snap": counts::snapping_json(&snapping),
                });
                writeln!(terminal.output, "{shown:#}")?;
            }
            Format::Text => {
                let sizes: Vec<String> =
                    counts.iter().map(|(name, _, size)| counts::size_line(name, *size)).collect();
                let (table, sizes) = (text::table(&rows(&counts)), sizes.concat());
                write!(terminal.output, "{table}\n{sizes}")?;
            }
        }
        Ok(())
    }
}

impl Arguments {
    fn format(&self, terminal: &Terminal<'_>) -> Format {
        let usual = if terminal.screen.is_some() { Format::Text } else { Format::Json };
        self.format.unwrap_or(usual)
    }

    /// Prints the counts of functions as one table, or as an object of lists.
    fn show(&self, steps: &[Step], terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        match self.format(terminal) {
            Format::Json => {
                let steps: Vec<Value> = steps.iter().map(Step::json).collect();
                writeln!(terminal.output, "{:#}", Value::Array(steps))?;
            }
            Format::Text => {
                let mut title =
                    ["function", "step", "M + A + D", "neg"].map(str::to_owned).to_vec();
                title.extend(counts::COLUMNS.iter().map(|(name, _)| (*name).to_owned()));
                let rows = std::iter::once(title).chain(steps.iter().map(Step::row));
                write!(terminal.output, "{}", text::table(&rows.collect::<Vec<_>>()))?;
            }
        }
        Ok(())
    }
}

/// The counts of a function at a step of the passes, or without an option.
struct Step {
    function: String,
    step: String,
    counts: Counts,
}

impl Step {
    fn row(&self) -> Vec<String> {
        let cells = counts::COLUMNS.iter().map(|(_, count)| count(&self.counts).to_string());
        let operations = self.counts.operations().to_string();
        let neg = self.counts.neg.to_string();
        let first = [self.function.clone(), self.step.clone(), operations, neg];
        first.into_iter().chain(cells).collect()
    }

    fn json(&self) -> Value {
        json!({
            "function": self.function,
            "step": self.step,
            "operations": self.counts.operations(),
            "neg": self.counts.neg,
            "counts": counts::cells(&self.counts),
        })
    }
}

/// The operations of each function after each pass.
fn passes(module: &Module) -> Vec<Step> {
    let steps = module.functions.iter().flat_map(|function| {
        let step = |step: &str, counts: Counts| Step {
            function: function.name.clone(),
            step: step.to_owned(),
            counts,
        };
        let all = module.counts(function).laid_out(function, &LANGUAGE.limits).call;
        let passes = function.passes.iter().map(move |pass| step(pass.pass, pass.counts));
        passes.chain(std::iter::once(step("with angles", all)))
    });
    steps.collect()
}

/// The operations of each function without each option, function by function.
fn ablated(found: &[Ablation]) -> Vec<Step> {
    let functions = found.first().map_or(&[][..], |all| all.counts.as_slice());
    let of = |index: usize| {
        found.iter().filter_map(move |ablation| {
            let (function, counts) = ablation.counts.get(index)?;
            let step = match ablation.without {
                "none" => "with all".to_owned(),
                option => format!("without {option}"),
            };
            Some(Step { function: function.clone(), step, counts: counts.call })
        })
    };
    (0..functions.len()).flat_map(of).collect()
}

/// A row for each function, and one for its part of the constructor, if there is one.
fn rows(counts: &[(&str, FunctionCounts, CodeSize)]) -> Vec<Vec<String>> {
    let mut title = vec!["function".to_owned()];
    title.extend(counts::COLUMNS.iter().map(|(name, _)| (*name).to_owned()));
    let mut rows = vec![title];
    for (name, counts, _) in counts {
        let cells = |counts: &Counts| -> Vec<String> {
            counts::COLUMNS.iter().map(|(_, count)| count(counts).to_string()).collect()
        };
        rows.push([vec![(*name).to_owned()], cells(&counts.call)].concat());
        let once = cells(&counts.constructor);
        if once.iter().any(|count| count != "0") {
            rows.push([vec![format!("  once for {name}")], once].concat());
        }
    }
    rows
}
