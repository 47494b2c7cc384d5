//! The command `robot-symbolic`, which turns robot files into equations, code and numbers.

use std::io::IsTerminal;
use std::process::ExitCode;

fn main() -> ExitCode {
    let (mut input, mut output, mut errors) =
        (std::io::stdin(), std::io::stdout().lock(), std::io::stderr().lock());
    let is_terminal = std::io::stderr().is_terminal();
    let no_color = std::env::var_os("NO_COLOR");
    let screen = std::io::stdout().is_terminal().then(|| robot_cli::Screen {
        columns: terminal_size::terminal_size_of(std::io::stdout())
            .map(|(width, _)| usize::from(width.0)),
        colors: robot_cli::colors(true, no_color.as_deref()),
    });
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output: &mut output,
        errors: &mut errors,
        colors: robot_cli::colors(is_terminal, no_color.as_deref()),
        progress: is_terminal,
        screen,
    };
    ExitCode::from(robot_cli::run(std::env::args_os(), &mut terminal))
}
