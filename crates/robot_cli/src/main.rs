//! The command `robot-symbolic`: robot files to equations, code and numbers.

use std::process::ExitCode;

fn main() -> ExitCode {
    let (mut input, mut output, mut errors) =
        (std::io::stdin().lock(), std::io::stdout().lock(), std::io::stderr().lock());
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output: &mut output,
        errors: &mut errors,
        colours: std::io::IsTerminal::is_terminal(&std::io::stderr()),
    };
    ExitCode::from(robot_cli::run(std::env::args_os(), &mut terminal))
}
