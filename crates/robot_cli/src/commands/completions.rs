//! `completions`: what a shell needs to complete the command line.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use crate::delivery::OutputArguments;
use crate::failure::Failure;
use crate::{Cli, NAME, Terminal};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic completions bash -o robot-symbolic.bash
  robot-symbolic completions zsh -o _robot-symbolic
  robot-symbolic completions fish -o robot-symbolic.fish

Where shells look: bash in ~/.local/share/bash-completion/completions/ for a file of the command's name; zsh
in the folders of $fpath; fish in ~/.config/fish/completions/.")]
pub(crate) struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let mut script = vec![];
        clap_complete::generate(self.shell, &mut Cli::command(), NAME, &mut script);
        self.output.deliver(String::from_utf8_lossy(&script).into_owned(), terminal)
    }
}
