//! `man`: the manual pages.

use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_mangen::Man;
use robot_build::{File, MARKER};

use crate::delivery::{ForceArgument, deliver_folder};
use crate::failure::Failure;
use crate::{Cli, Terminal};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic man man1
  robot-symbolic man > robot-symbolic.1

The pages contain the text of --help. `man -l man1/robot-symbolic-equations.1` shows one; if they are in a
folder man1 below a folder in MANPATH, man finds them by name.")]
pub(crate) struct Arguments {
    /// The folder to write, with a page for the program and one for each command. Without a folder, the program's own
    /// page goes to standard output
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Compare the files with what would be written, and write nothing
    #[arg(long, requires = "folder")]
    check: bool,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        // The command `help` is left out, because it has no options to describe.
        let mut command = Cli::command().disable_help_subcommand(true);
        command.build();
        let own = page(&command)?;
        let writer = self.force.writer([], self.folder.is_some() && !self.check)?;
        let Some(folder) = &self.folder else {
            return Ok(terminal.output.write_all(own.contents.bytes())?);
        };
        let mut pages = vec![own];
        for command in command.get_subcommands() {
            pages.push(page(command)?);
        }
        deliver_folder(folder, &pages, self.check, &writer, terminal)
    }
}

fn page(command: &clap::Command) -> Result<File, Failure> {
    let man = Man::new(command.clone());
    let mut text = vec![];
    man.render(&mut text)?;
    let text = format!(".\\\" {MARKER}\n{}", String::from_utf8_lossy(&text));
    Ok(File::text(&man.get_filename(), text))
}
