//! `completions`: scripts with which shells complete the command line.

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use robot_build::{MARKER, Ownership};

use crate::delivery::{Kind, OutputArguments};
use crate::failure::Failure;
use crate::{Cli, NAME, Terminal};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic completions bash -o robot-symbolic.bash
  robot-symbolic completions zsh -o _robot-symbolic
  robot-symbolic completions fish -o robot-symbolic.fish

Where to put the file: for bash, ~/.local/share/bash-completion/completions/, under the command's name; for zsh,
a folder of $fpath; for fish, ~/.config/fish/completions/.")]
pub(crate) struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let shell = self.shell.to_string();
        let doc = format!("this is a script for {shell}");
        let kind = Kind { doc: &doc, ending: &shell };
        let output = self.output.open_kind(kind, Ownership::Marked, [])?;
        let mut script = vec![];
        clap_complete::generate(self.shell, &mut Cli::command(), NAME, &mut script);
        let mut script = String::from_utf8_lossy(&script).into_owned();
        if self.shell == Shell::Bash {
            // The labels of clap_complete's cases for a name with a hyphen are not those that it looks for:
            // https://github.com/clap-rs/clap/issues/6421.
            script = script.replace("robot__subcmd__symbolic", "robot__symbolic");
        }
        output.deliver(&marked(&script), terminal)
    }
}

/// Adds this program's mark to the script, as a comment, which has the same syntax in all of these shells. The first
/// line of the script for zsh must stay first.
fn marked(script: &str) -> String {
    match script.split_once('\n') {
        Some((first, rest)) if first.starts_with("#compdef") => {
            format!("{first}\n# {MARKER}\n{rest}")
        }
        _ => format!("# {MARKER}\n{script}"),
    }
}
