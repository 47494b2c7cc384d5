//! The command `robot-symbolic`: robot files to equations, code and numbers.

use std::io::IsTerminal;
use std::process::ExitCode;

fn main() -> ExitCode {
    let (mut input, mut output, mut errors) =
        (std::io::stdin().lock(), std::io::stdout().lock(), std::io::stderr().lock());
    let is_terminal = std::io::stderr().is_terminal();
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output: &mut output,
        errors: &mut errors,
        colors: robot_cli::colors(is_terminal, std::env::var_os("NO_COLOR").as_deref()),
        progress: is_terminal,
    };
    ExitCode::from(robot_cli::run(std::env::args_os(), &mut terminal))
}
