//! `prove`.

use serde_json::Value;

use crate::{complaint, output, robot};

#[test]
fn evidence_is_shown_as_text_and_as_json() {
    let file = robot("planar_2r");
    let function = ["--function", "inverse_dynamics"];
    let shown = output(&[&["prove", &file][..], &function].concat(), "");
    for part in
        ["rustc 1.", "dev: function", "release: function", "Model::inverse_dynamics_sc", "flat"]
    {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    assert!(!shown.contains("BROKEN"), "{shown}");

    let more = ["--format", "json", "--profile", "release", "--trigonometry", "polynomial"];
    let shown = output(&[&["prove", &file][..], &function, &more].concat(), "");
    let shown: Value = serde_json::from_str(&shown).unwrap();
    let profiles = shown["profiles"].as_array().unwrap();
    assert_eq!((profiles.len(), &profiles[0]["profile"]), (1, &Value::from("release")));
    let functions = profiles[0]["functions"].as_array().unwrap();
    let function =
        functions.iter().find(|function| function["name"] == "Model::inverse_dynamics").unwrap();
    for key in ["instructions", "frame", "stack", "bytes"] {
        assert!(function[key].as_u64() > Some(7), "{function}");
    }
    for key in ["jumps", "panics"] {
        assert_eq!(function[key], 0, "{function}");
    }
    assert_eq!(function["calls"].as_object().unwrap().len(), 0);
    assert_eq!(function["violations"].as_array().unwrap().len(), 0);
}

#[test]
fn without_a_compiler_there_is_no_evidence() {
    let shown = complaint(1, &["prove", &robot("planar_2r"), "--rustc", "/nowhere/rustc"], "");
    assert!(shown.contains("/nowhere/rustc") && shown.contains("rustup.rs"), "{shown}");
}

#[test]
fn what_the_compiler_refuses_is_told_by_its_option() {
    let file = robot("planar_2r");
    let failed = |arguments: &[&str]| {
        let function = ["prove", &file, "--function", "gravity", "--profile", "release"];
        complaint(1, &[&function[..], arguments].concat(), "")
    };
    let shown = failed(&["--target", "no-such-target"]);
    assert!(shown.contains("the target `no-such-target` is unknown"), "{shown}");
    let shown = failed(&["--target-cpu", "foo"]);
    let first = shown.lines().next().unwrap();
    assert!(first.contains("'foo' is not a recognized processor"), "{shown}");
    assert!(first.contains("the processor `foo`") && first.contains("target-cpus"), "{shown}");
    assert!(!shown.contains("rustup target add"), "{shown}");
    for program in ["/bin/false", "/bin/echo", "/bin/cat"] {
        let shown = failed(&["--rustc", program]);
        assert!(shown.contains(&format!("{program} is not a Rust compiler")), "{shown}");
        assert!(shown.contains("--rustc") && shown.lines().count() == 1, "{shown}");
    }
}
