//! `diff`: exit codes, JSON and text.

use serde_json::Value;

use crate::{complaint, folder, output, robot, run};

#[test]
fn nothing_differs_of_a_robot_and_itself() {
    let shown = output(&["diff", &robot("planar_2r"), &robot("planar_2r"), "--states", "5"], "");
    assert_eq!(shown.matches("  no differences\n").count(), 3, "{shown}");
}

#[test]
fn a_value_is_found_in_text_and_json() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("diff").join("changed.toml");
    std::fs::write(&path, text.replace("m2 = { value = 3.0", "m2 = { value = 3.5")).unwrap();
    let files = [robot("planar_2r"), path.to_str().unwrap().to_owned()];
    let outcome = run(&["diff", &files[0], &files[1], "--states", "5", "--format", "json"]);
    assert_eq!((outcome.code, outcome.errors.as_str()), (1, ""));
    let found: Value = serde_json::from_str(&outcome.output).unwrap();
    assert_eq!(found["changes"][0]["properties"]["value"], serde_json::json!(["3", "3.5"]));
    assert_eq!((&found["same"], found["equations"].as_array().unwrap().len()), (&false.into(), 0));
    assert_eq!(found["torques"]["joints"].as_array().unwrap().len(), 2);
    let text = run(&["diff", &files[0], &files[1], "--states", "5"]).output;
    assert!(text.contains("~ parameter m2: value 3 -> 3.5\n"), "{text}");
}

#[test]
fn properties_have_the_same_names_in_text_and_json() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("diff_names").join("moved.toml");
    let moved =
        text.replace(r#"center_of_mass = ["r1", 0, 0]"#, r#"center_of_mass = ["l1", 0, 0]"#);
    assert_ne!(moved, text);
    std::fs::write(&path, moved).unwrap();
    let files = [robot("planar_2r"), path.to_str().unwrap().to_owned()];
    let json = run(&["diff", &files[0], &files[1], "--states", "5", "--format", "json"]).output;
    let found: Value = serde_json::from_str(&json).unwrap();
    assert!(found["changes"][0]["properties"]["center of mass"].is_array(), "{json}");
    let text = run(&["diff", &files[0], &files[1], "--states", "5"]).output;
    assert!(text.contains(": center of mass to (r1, 0, 0) -> to (l1, 0, 0)"), "{text}");
}

#[test]
fn a_parameter_without_a_value_is_named() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("diff_value").join("unknown.toml");
    std::fs::write(&path, text.replace("m2 = { value = 3.0,", "m2 = {")).unwrap();
    let shown = run(&["diff", &robot("planar_2r"), path.to_str().unwrap(), "--states", "5"]).output;
    assert!(shown.contains("no nominal value is given for `m2`\n"), "{shown}");
}

#[test]
fn an_added_joint_is_shown_without_what_it_does_not_have() {
    let shown = run(&["diff", &robot("planar_2r"), &robot("planar_3r"), "--states", "5"]).output;
    for line in [
        "~ frame tip: link 2 -> 3; pose to (l2, 0, 0) -> to (l3, 0, 0)",
        "+ link 3: parent 2; pose to (l2, 0, 0); mass m3; center of mass to (r3, 0, 0); Izz I3",
        "+ joint 3: moves 3; kind revolute; axis (0, 0, 1); coordinate q3",
    ] {
        assert!(shown.lines().any(|found| found == line), "{line}\n{shown}");
    }
    assert!(!shown.contains("placement"), "{shown}");
}

#[test]
fn wrong_files_are_no_difference() {
    assert!(complaint(2, &["diff", &robot("planar_2r"), "nowhere.toml"], "").contains("nowhere"));
    assert!(complaint(2, &["diff", &robot("planar_2r")], "").contains("<B>"));
}

#[test]
fn states_are_limited() {
    for states in ["0", "100001", "18446744073709551615"] {
        let file = robot("planar_2r");
        let shown = complaint(2, &["diff", &file, &file, "--states", states], "");
        assert!(shown.contains("--states"), "{shown}");
    }
}
