//! `report`: a page about a robot.

use std::path::{Path, PathBuf};

use clap::Args;
use robot_build::{Options, Ownership, Programs, Source, planned, shown};
use robot_evidence::{Compiler, Profile, prove};
use robot_report::{Accuracy, Compiled, Input, report};

use crate::Terminal;
use crate::delivery::{Delivery, Kind, OutputArguments};
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::watched;
use crate::robot::{PRINT_SNAP, RobotArgument};
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic report robots/trttr1.toml -o trttr1.html
  robot-symbolic report robots/planar_2r.toml --without-compiler --open
  robot-symbolic report robots/panda.toml -o panda.html --without-compiler

The page is a single file that needs no other file and no network: the kinematic scheme, tables of joints,
masses and parameters, the equations of motion, the structure of the matrices, operations by function, stage and
option, and evidence. It works on dark and light screens, in print and with screen readers; hover over a link,
a parameter or a term to highlight everything related to it.

For the evidence, rustc compiles the code (the variable RUSTC, or `rustc`); if there is no compiler, the page
says so.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    output: OutputArguments,
    /// Show the page in the browser; without --output, the page is NAME.html in the current folder, where NAME is
    /// that of the robot file
    #[arg(long, conflicts_with = "check")]
    open: bool,
    /// Do not start a compiler: the page then has no evidence about machine code
    #[arg(long)]
    without_compiler: bool,
    /// Leave out the part in which the robot moves, and its script
    #[arg(long)]
    without_live: bool,
}

/// What a report is written as.
pub(crate) const PAGE: Kind<'_> = Kind { doc: "a report is an HTML page", ending: "html" };

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let output = self.output(terminal)?;
        let options = self.robot.options(terminal)?;
        // The robot is read first, so that warnings are shown and the compiler is not started for an invalid robot.
        let robot = self.robot.read(terminal)?.robot;
        text::lacking(&robot, &options, terminal)?;
        self.robot.snapped(&robot, terminal)?;
        let source = self.robot.source()?;
        let page = watched("writing", terminal, || self.page(&source, &planned(&robot, &options)))?;
        output.deliver(&page, terminal)?;
        match output.path().filter(|_| self.open) {
            Some(path) => show(path),
            None => Ok(()),
        }
    }

    /// The destination of the page, which must not be a terminal.
    fn output(&self, terminal: &Terminal<'_>) -> Result<Delivery<'_>, Failure> {
        let inputs = self.robot.inputs();
        if !self.output.is_open() {
            let output = self.output.open_kind(PAGE, Ownership::Marked, inputs)?;
            if self.open && output.path().is_none() {
                let message = "--open shows a file, and `-` is standard output; name a file";
                return Err(Failure::Usage(vec![message.to_owned()]));
            }
            return Ok(output);
        }
        let usual = PathBuf::from(self.robot.path().file_name().unwrap_or_default());
        let usual = usual.with_extension("html");
        if self.open {
            return self.output.open_at(usual, inputs);
        }
        if terminal.screen.is_some() {
            let name = shown(&usual);
            let message = format!(
                "the page is HTML, for browsers: show it with --open, write it with -o {name}, or \
                 print it with -o -"
            );
            return Err(Failure::Usage(vec![message]));
        }
        self.output.open(inputs)
    }

    fn page(&self, source: &Source, options: &Options) -> Result<String, Failure> {
        let compiled = if self.without_compiler {
            Compiled::Unread { reason: "the page was made without a compiler.".to_owned() }
        } else {
            compiled(source, options)?
        };
        Ok(report(&input(source, options, &compiled, !self.without_live))?)
    }
}

/// The input of a page; `live` is whether the robot moves in it.
pub(crate) fn input<'a>(
    source: &'a Source,
    options: &'a Options,
    compiled: &'a Compiled,
    live: bool,
) -> Input<'a> {
    Input { source, options, snap: PRINT_SNAP, compiled, compare: compare_with_solver, live }
}

/// Opens a file with the system's program for such files.
fn show(path: &Path) -> Result<(), Failure> {
    open::that_detached(path).map_err(|_| {
        let file = shown(path);
        let wanted = "the page is written, but could not be shown";
        Failure::input(format!("{wanted}; open {file} in a browser"))
    })
}

/// Compares the programs with the numeric solver; returns the largest deviations.
fn compare_with_solver(programs: &Programs) -> Result<Accuracy, String> {
    let worst = robot_check::accuracy::worst(programs)?;
    let worst = worst.into_iter().map(|(function, error)| (function.to_owned(), error)).collect();
    Ok(Accuracy { states: robot_check::accuracy::states(), worst })
}

/// Compiles the usual functions and measures their code.
fn compiled(source: &Source, options: &Options) -> Result<Compiled, Failure> {
    interrupt::remove_folders();
    let compiler = Compiler::default();
    let read = || -> Result<Compiled, robot_evidence::Error> {
        let description = compiler.description()?;
        let profiles = [Profile::Dev, Profile::Release];
        let modules = prove(source, options, &compiler, &profiles)?;
        Ok(Compiled::Read { compiler: description, modules })
    };
    match read() {
        Ok(compiled) => Ok(compiled),
        Err(robot_evidence::Error::Robot(errors)) => Err(Failure::Robot(errors)),
        Err(other) => Ok(Compiled::Unread { reason: other.to_string() }),
    }
}
