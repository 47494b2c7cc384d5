//! `report`: the page about a robot.

use crate::{complaint, folder, output, robot, run};

#[test]
fn a_page_is_written_and_says_what_the_compiler_made() {
    let path = folder("report").join("planar.html");
    let outcome = run(&["report", &robot("planar_2r"), "-o", path.to_str().unwrap()]);
    assert_eq!(outcome.code, 0, "{}", outcome.errors);
    let page = std::fs::read_to_string(path).unwrap();
    for part in ["<svg", "scheme-link-2", "Model::inverse_dynamics", "Profile release", "flat"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn without_a_compiler_the_page_says_so() {
    let page = output(&["report", &robot("planar_2r"), "--without-compiler"], "");
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("machine code was not analyzed"));
    assert!(!page.contains("Profile release"));
}

#[test]
fn base_parameters_of_a_page_are_in_the_frames_that_are_asked_for() {
    let file = robot("planar_2r");
    let page = |frames: &str| {
        output(&["report", &file, "--without-compiler", "--base-frames", frames], "")
    };
    let [own, other] = ["file", "denavit_hartenberg"].map(page);
    // The moment of inertia about the first joint axis is ZZ in the file's frames, and a second moment in the others.
    let has = |page: &str, name: &str| page.contains(&format!("id=\"regrouped-{name}\""));
    assert!(has(&own, "ZZR-1") && !has(&own, "SYYR-1"));
    assert!(has(&other, "SYYR-1") && !has(&other, "ZZR-1"));
    assert_eq!(own, output(&["report", &file, "--without-compiler"], ""));
}

#[test]
fn there_is_no_page_about_a_file_that_is_wrong() {
    assert!(complaint(1, &["report", "none.toml"], "").contains("there is no such file"));
}
