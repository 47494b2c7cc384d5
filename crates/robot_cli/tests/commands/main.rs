//! The command, called as a user calls it, but within the process of the test.

#![allow(clippy::unwrap_used, clippy::panic)]

mod aliases;
mod base;
mod book;
mod check;
mod code;
mod compare;
mod demo;
mod diff;
mod edited;
mod effects;
mod equations;
mod eval;
mod files;
mod functions;
mod help;
mod interrupted;
mod json_schema;
mod lsp;
mod outputs;
mod paper;
mod people;
mod pictures;
mod plans;
mod printing;
mod prove;
mod reading;
mod reasons;
mod report;
mod schema;
mod shell;
mod simulate;
mod singular;
mod stats;
mod streams;
mod usage;
mod watch;

use std::path::PathBuf;

/// The result of a command.
struct Outcome {
    code: u8,
    output: String,
    errors: String,
}

/// Runs `robot-symbolic` with streams that are not terminals; returns the exit code.
fn run_between(
    arguments: &[&str],
    input: &[u8],
    output: &mut dyn std::io::Write,
    errors: &mut dyn std::io::Write,
) -> u8 {
    run_shown(None, arguments, input, output, errors)
}

/// Runs it with standard output that can be a terminal.
fn run_on(screen: Option<robot_cli::Screen>, arguments: &[&str]) -> Outcome {
    let (mut output, mut errors) = (vec![], vec![]);
    let code = run_shown(screen, arguments, b"", &mut output, &mut errors);
    let [output, errors] = [output, errors].map(|bytes| String::from_utf8(bytes).unwrap());
    Outcome { code, output, errors }
}

/// The messages of a command whose standard error is a terminal without colors.
fn messages_on_terminal(arguments: &[&str]) -> String {
    let (mut input, mut output, mut errors) = (&b""[..], vec![], vec![]);
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output: &mut output,
        errors: &mut errors,
        colors: false,
        progress: true,
        screen: None,
    };
    let arguments = std::iter::once("robot-symbolic").chain(arguments.iter().copied());
    assert_eq!(robot_cli::run(arguments, &mut terminal), 0);
    String::from_utf8(errors).unwrap()
}

fn run_shown(
    screen: Option<robot_cli::Screen>,
    arguments: &[&str],
    mut input: &[u8],
    output: &mut dyn std::io::Write,
    errors: &mut dyn std::io::Write,
) -> u8 {
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output,
        errors,
        colors: false,
        progress: false,
        screen,
    };
    let arguments = std::iter::once("robot-symbolic").chain(arguments.iter().copied());
    robot_cli::run(arguments, &mut terminal)
}

/// Runs `robot-symbolic` with arguments and standard input.
fn run_with(arguments: &[&str], input: &[u8]) -> Outcome {
    let (mut output, mut errors) = (vec![], vec![]);
    let code = run_between(arguments, input, &mut output, &mut errors);
    let [output, errors] = [output, errors].map(|bytes| String::from_utf8(bytes).unwrap());
    Outcome { code, output, errors }
}

fn run(arguments: &[&str]) -> Outcome {
    run_with(arguments, b"")
}

/// The output of a command that succeeds without messages.
#[track_caller]
fn output(arguments: &[&str], input: &str) -> String {
    let Outcome { code, output, errors } = run_with(arguments, input.as_bytes());
    assert_eq!((code, errors.as_str()), (0, ""), "{arguments:?}");
    output
}

/// The output of a command that writes files and has no other messages.
#[track_caller]
fn output_beside_files(arguments: &[&str]) -> String {
    let Outcome { code, output, errors } = run(arguments);
    let complaints: Vec<&str> = errors.lines().filter(|line| !line.starts_with("wrote ")).collect();
    assert_eq!((code, complaints), (0, vec![]), "{arguments:?}");
    output
}

/// The messages of a command that ends with an exit code.
#[track_caller]
fn complaint(code: u8, arguments: &[&str], input: &str) -> String {
    let outcome = run_with(arguments, input.as_bytes());
    let command = arguments.join(" ");
    assert_eq!(
        (outcome.code, outcome.output.as_str()),
        (code, ""),
        "{command}: {}",
        outcome.errors
    );
    outcome.errors
}

/// The path of a robot file of this project.
fn robot(name: &str) -> String {
    format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// A wrist whose mass matrix is singular if q2 is 0.
const WRIST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures/gimbals/wrist.toml");

/// A pendulum in URDF.
const URDF: &str = r#"<robot name="pendulum">
  <link name="base"/>
  <link name="rod">
    <inertial>
      <origin xyz="0.5 0 0" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.01" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="swing" type="revolute">
    <parent link="base"/>
    <child link="rod"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
</robot>
"#;

/// An empty folder for a test.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
