//! Help, wrong usage, and the demonstration.

use crate::{complaint, output, run};

const COMMANDS: [&str; 8] =
    ["equations", "generate", "crate", "eval", "stats", "search", "show", "demo"];

#[test]
fn every_command_has_help_with_an_example() {
    let overview = output(&["--help"], "");
    for command in COMMANDS {
        assert!(overview.contains(&format!("\n  {command} ")), "{overview}");
        let help = output(&[command, "--help"], "");
        assert!(help.contains(&format!("Example:\n  robot-symbolic {command}")), "{help}");
    }
}

#[test]
fn wrong_usage_has_its_own_code() {
    for arguments in [&["equation"][..], &["stats"], &["stats", "a", "b"], &["--snap"]] {
        assert!(complaint(2, arguments, "").contains("error:"), "{arguments:?}");
    }
    assert!(complaint(1, &["stats", "none.toml"], "").contains("there is no such file"));
}

#[test]
fn without_a_command_the_demonstration_runs() {
    let shown = output(&[], "");
    assert_eq!(shown, output(&["demo"], ""));
    for part in ["Q1 = ", "Q5 = ", "sin(q2)", "tau = ", "generated code"] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    assert_eq!(
        run(&["--version"]).output,
        format!("robot-symbolic {}\n", env!("CARGO_PKG_VERSION"))
    );
}
