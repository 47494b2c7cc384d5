//! Robots without forward dynamics, because the mass matrix is singular in every configuration.

use serde_json::Value;

use crate::{complaint, folder, run};

/// Two links about one axis, the first without mass.
const ARM: &str = "format = 1\n[robot]\nname = \"arm\"\n\
    [[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\n\
    [[link]]\nname = \"2\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = 2\n\
    center_of_mass = [0.1, 0, 0]\ninertia = { xx = 0.01, yy = 0.02, zz = 0.02 }\n";

const WHY: &str =
    "the robot has no forward_dynamics, forward_dynamics_derivatives: the mass matrix is singular";

fn arm(test: &str) -> String {
    let path = folder(test).join("arm.toml").to_str().unwrap().to_owned();
    std::fs::write(&path, ARM).unwrap();
    path
}

/// Checks that a command reports missing functions in one line.
#[track_caller]
fn assert_one_note(errors: &str) {
    let lines: Vec<&str> = errors.lines().filter(|line| line.contains(WHY)).collect();
    assert_eq!(lines.len(), 1, "{errors}");
    assert!(lines[0].starts_with("note: ") && lines[0].contains("`1`"), "{errors}");
}

#[test]
fn the_other_functions_are_counted() {
    let arm = arm("singular_stats");
    let shown = run(&["stats", &arm, "--allow-massless"]);
    assert_eq!(shown.code, 0, "{}", shown.errors);
    assert_one_note(&shown.errors);
    let counts: Value = serde_json::from_str(&shown.output).unwrap();
    let functions = counts["functions"].as_object().unwrap();
    assert!(functions.contains_key("mass_matrix") && functions.contains_key("bias"));
    assert!(functions.keys().all(|name| !name.starts_with("forward_dynamics")), "{functions:?}");
    for more in ["--passes", "--options"] {
        let shown = run(&["stats", &arm, "--allow-massless", more]);
        assert_eq!(shown.code, 0, "{}", shown.errors);
        assert_one_note(&shown.errors);
    }
    let shown = run(&["show", &arm, "--allow-massless"]);
    let reason = shown.output.split("not available: forward_dynamics").nth(1).unwrap();
    assert!(
        reason.contains("\n    the mass matrix is singular in every configuration\n"),
        "{reason}"
    );
}

#[test]
fn a_page_is_about_the_other_functions() {
    let shown = run(&["report", &arm("singular_report"), "--allow-massless", "--without-compiler"]);
    assert_eq!(shown.code, 0, "{}", shown.errors);
    assert_one_note(&shown.errors);
    assert!(shown.output.contains(WHY) && shown.output.contains("<code>mass_matrix</code>"));
    assert!(!shown.output.contains("<code>forward_dynamics</code>"));
    assert!(!shown.output.contains("were not compared with the numeric solver"));
}

#[test]
fn all_functions_are_those_that_there_are() {
    let arm = arm("singular_all");
    let all = run(&["generate", &arm, "--allow-massless", "--function", "all"]);
    assert_eq!(all.code, 0, "{}", all.errors);
    assert_one_note(&all.errors);
    assert!(all.output.contains("fn mass_matrix") && !all.output.contains("forward_dynamics"));
    // If such a function is named, that is an error.
    let function = ["--function", "forward_dynamics"];
    let named =
        complaint(1, &[&["generate", &arm, "--allow-massless"][..], &function].concat(), "");
    assert!(named.contains("forward dynamics has no solution"), "{named}");
    // With the usual functions, missing ones are not reported.
    let usual = run(&["generate", &arm, "--allow-massless"]);
    assert!(!usual.output.contains("forward_dynamics"), "{}", usual.output);
}
