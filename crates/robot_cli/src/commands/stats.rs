//! `stats`: the operations of a robot's functions.

use clap::{Args, ValueEnum};
use robot_build::{Functions, Options, programs, snapping};
use robot_codegen::FunctionCounts;
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::counts;
use crate::failure::Failure;
use crate::robot::{RobotArgument, functions};
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic stats robots/puma560.toml --format text

Subtractions count as additions, changes of sign not at all, a fused multiply-add as both of its
operations. `other` are absolute values, signs and hyperbolic tangents. What the constructor computes,
once for each set of parameters, is counted apart.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Functions to count; all that the robot has without this
    #[arg(long = "function", value_name = "NAME", value_delimiter = ',')]
    functions: Vec<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Json)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Json,
    Text,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let functions = match self.functions.as_slice() {
            [] => Functions::All,
            names => functions(names)?,
        };
        let source = self.robot.source()?;
        let options = Options { functions, ..self.robot.options()? };
        let programs = programs(&source, &options)?;
        text::warnings(&programs.warnings, terminal)?;
        let module = &programs.module;
        let counts: Vec<(&str, FunctionCounts)> = module
            .functions
            .iter()
            .map(|function| (function.name.as_str(), module.counts(function)))
            .collect();
        match self.format {
            Format::Json => {
                let functions: Map<String, Value> = counts
                    .iter()
                    .map(|(name, counts)| ((*name).to_owned(), counts::json(counts)))
                    .collect();
                let snapping = snapping(&programs.robot, options.snap, options.plan.as_ref())?;
                let shown = json!({
                    "robot": programs.robot.name,
                    "functions": functions,
                    "snap": counts::snapping_json(&snapping),
                });
                writeln!(terminal.output, "{shown:#}")?;
            }
            Format::Text => write!(terminal.output, "{}", text::table(&rows(&counts)))?,
        }
        Ok(())
    }
}

/// A row for each function, and one for what the constructor does of it.
fn rows(counts: &[(&str, FunctionCounts)]) -> Vec<Vec<String>> {
    let mut title = vec!["function".to_owned()];
    title.extend(counts::FIGURES.iter().map(|(name, _)| (*name).to_owned()));
    let mut rows = vec![title];
    for (name, counts) in counts {
        for (name, counts) in
            [((*name).to_owned(), counts.call), (format!("  once for {name}"), counts.constructor)]
        {
            let figures = counts::FIGURES.iter().map(|(_, figure)| figure(&counts).to_string());
            rows.push(std::iter::once(name).chain(figures).collect());
        }
    }
    rows
}
