//! The commands, each in a file of its own.

mod base;
mod check;
mod compare;
mod completions;
mod demo;
mod diff;
mod document;
mod equations;
mod eval;
mod generate;
mod import;
mod init;
mod lsp;
mod man;
mod package;
mod prove;
mod report;
mod schema;
mod scheme;
mod search;
mod show;
mod simulate;
mod stats;
mod torques;
mod watch;

use clap::Subcommand;

use crate::Terminal;
use crate::failure::Failure;

/// What the command line asks for.
#[derive(Subcommand)]
pub(crate) enum Command {
    /// Write a first robot file, to be edited
    Init(init::Arguments),
    /// Print the equations of motion of a robot
    Equations(equations::Arguments),
    /// Write a document about a robot: tables, equations, symbols and a check value
    Document(document::Arguments),
    /// Print the base parameters of a robot
    Base(base::Arguments),
    /// Write the module of a robot, in Rust or another language
    Generate(generate::Arguments),
    /// Write a crate, or a package in another language, with the functions of a robot
    Crate(package::Arguments),
    /// Compute a function of a robot at given states
    Eval(eval::Arguments),
    /// Simulate the motion q(t) of a robot, with torques and energies
    Simulate(simulate::Arguments),
    /// Compute the torques along a trajectory, split by cause
    Torques(torques::Arguments),
    /// Count the operations of a robot's functions
    Stats(stats::Arguments),
    /// Compile a robot's code and check the machine code
    Prove(prove::Arguments),
    /// Write a page about a robot: scheme, tables, equations, structure, operations, evidence
    Report(report::Arguments),
    /// Draw the kinematic scheme of a robot as SVG or PDF
    Scheme(scheme::Arguments),
    /// Search for the form of the recursion with the fewest operations
    Search(search::Arguments),
    /// Write a URDF file as a robot file
    Import(import::Arguments),
    /// Check robot files for errors and likely mistakes
    Check(check::Arguments),
    /// Compare published equations with the derived ones, term by term
    Compare(compare::Arguments),
    /// Show how two robots differ: parameters, terms, operations, torques
    Diff(diff::Arguments),
    /// Derive a robot again at each save of its file, and show what has changed
    Watch(watch::Arguments),
    /// Print the JSON schema of robot files, for editors
    Schema(schema::Arguments),
    /// Show errors and likely mistakes in an editor while robot files are written
    Lsp(lsp::Arguments),
    /// Show the contents of a robot file
    Show(show::Arguments),
    /// Print a completion script for a shell
    Completions(completions::Arguments),
    /// Write the manual pages
    Man(man::Arguments),
    /// Show the equations of the robot TRTTR1 and run its generated code
    Demo(demo::Arguments),
}

/// The default command is the demonstration, for users who do not have a robot file yet.
impl Default for Command {
    fn default() -> Command {
        Command::Demo(demo::Arguments {})
    }
}

impl Command {
    /// Runs the command.
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        match self {
            Command::Init(arguments) => arguments.run(terminal),
            Command::Scheme(arguments) => arguments.run(terminal),
            Command::Equations(arguments) => arguments.run(terminal),
            Command::Document(arguments) => arguments.run(terminal),
            Command::Base(arguments) => arguments.run(terminal),
            Command::Generate(arguments) => arguments.run(terminal),
            Command::Crate(arguments) => arguments.run(terminal),
            Command::Eval(arguments) => arguments.run(terminal),
            Command::Simulate(arguments) => arguments.run(terminal),
            Command::Torques(arguments) => arguments.run(terminal),
            Command::Stats(arguments) => arguments.run(terminal),
            Command::Prove(arguments) => arguments.run(terminal),
            Command::Report(arguments) => arguments.run(terminal),
            Command::Search(arguments) => arguments.run(terminal),
            Command::Import(arguments) => arguments.run(terminal),
            Command::Check(arguments) => arguments.run(terminal),
            Command::Compare(arguments) => arguments.run(terminal),
            Command::Diff(arguments) => arguments.run(terminal),
            Command::Watch(arguments) => arguments.run(terminal),
            Command::Schema(arguments) => arguments.run(terminal),
            Command::Lsp(arguments) => arguments.run(terminal),
            Command::Show(arguments) => arguments.run(terminal),
            Command::Completions(arguments) => arguments.run(terminal),
            Command::Man(arguments) => arguments.run(terminal),
            Command::Demo(arguments) => arguments.run(terminal),
        }
    }
}
