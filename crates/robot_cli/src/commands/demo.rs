//! `demo`: the equations of TRTTR1, and its generated code at a check state.

use std::fmt::Write as _;

use clap::Args;
use robot_build::{Options, Source, Trigonometry, check, programs};
use robot_document::{EquationOptions, equations};
use robot_dynamics::economical::pin::Pin;

use super::equations::plain;
use crate::Terminal;
use crate::failure::Failure;

// Generated once and committed, so that building the command does not need a second build of the generator; a test
// compares it with newly generated code.
include!("../../demo/trttr1.rs");

/// The robot file from which the code above was generated.
const ROBOT: &str = include_str!("../../demo/trttr1.toml");
/// The plan with which it was generated.
const PLAN: &str = include_str!("../../demo/trttr1.plan");

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic demo")]
pub(crate) struct Arguments {}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let source = Source { name: "robots/trttr1.toml".to_owned(), text: ROBOT.to_owned() };
        let robot = robot_build::read(&source)?.robot;
        let equations = equations(&robot, &EquationOptions::default())
            .map_err(|error| Failure::input(error.to_string()))?;
        let mut shown = String::from(
            "The equations of motion of TRTTR1, joint torques without friction, expanded:\n\n",
        );
        shown.push_str(&plain(&equations.readable(None)));
        let function = "inverse_dynamics";
        let plan = Pin::from_text(PLAN).ok().map(|pin| pin.plan);
        let programs = programs(&source, &Options { plan, ..Options::default() })?;
        let state = check::check_value(&source.name, &programs, function, Trigonometry::default())?;
        shown.push_str("\nInverse dynamics at a check state, nominal parameters:\n\n");
        // Writing to a string does not fail.
        for (name, entries) in &state.inputs {
            let _ = writeln!(shown, "  {name} = {entries:?}");
        }
        let interpreted: Vec<f64> =
            state.outputs.iter().flat_map(|output| output.values.iter().copied()).collect();
        let _ = writeln!(shown, "  tau = {interpreted:?}, interpreted");
        let inputs: Vec<Option<[f64; trttr1::DOF]>> =
            state.inputs.iter().map(|(_, entries)| entries.as_slice().try_into().ok()).collect();
        if let [Some(q), Some(qd), Some(qdd)] = inputs.as_slice() {
            let tau = trttr1::Model::NOMINAL.inverse_dynamics(q, qd, qdd);
            let _ = writeln!(shown, "  tau = {tau:?}, from the generated code");
        }
        shown.push_str("\n`robot-symbolic --help` lists all commands.\n");
        Ok(terminal.output.write_all(shown.as_bytes())?)
    }
}
