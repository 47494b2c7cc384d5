//! The command, called as a user calls it, but for the process.

#![allow(clippy::unwrap_used, clippy::panic)]

mod base;
mod book;
mod check;
mod code;
mod compare;
mod diff;
mod equations;
mod eval;
mod files;
mod help;
mod json_schema;
#[path = "../../../../tests/common/pages.rs"]
mod pages;
mod prove;
mod report;
mod schema;
mod shell;
mod simulate;
mod stats;
mod usage;

use std::path::PathBuf;

/// What a command has done.
struct Outcome {
    code: u8,
    output: String,
    errors: String,
}

/// Runs `robot-symbolic` with arguments and standard input.
fn run_with(arguments: &[&str], mut input: &[u8]) -> Outcome {
    let (mut output, mut errors) = (vec![], vec![]);
    let mut terminal = robot_cli::Terminal {
        input: &mut input,
        output: &mut output,
        errors: &mut errors,
        colours: false,
        progress: false,
    };
    let arguments = std::iter::once("robot-symbolic").chain(arguments.iter().copied());
    let code = robot_cli::run(arguments, &mut terminal);
    let [output, errors] = [output, errors].map(|bytes| String::from_utf8(bytes).unwrap());
    Outcome { code, output, errors }
}

fn run(arguments: &[&str]) -> Outcome {
    run_with(arguments, b"")
}

/// What a command prints that does its work without complaint.
fn output(arguments: &[&str], input: &str) -> String {
    let Outcome { code, output, errors } = run_with(arguments, input.as_bytes());
    assert_eq!((code, errors.as_str()), (0, ""), "{arguments:?}");
    output
}

/// What a command complains of that ends with a code.
fn complaint(code: u8, arguments: &[&str], input: &str) -> String {
    let outcome = run_with(arguments, input.as_bytes());
    assert_eq!((outcome.code, outcome.output.as_str()), (code, ""), "{}", outcome.errors);
    outcome.errors
}

/// The path of a robot file of this project.
fn robot(name: &str) -> String {
    format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// An empty folder for a test.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
