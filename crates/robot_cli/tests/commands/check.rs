//! `check`.

use std::path::Path;

use serde_json::Value;

use crate::{complaint, folder, output, robot, run};

const HEAD: &str = "format = 1\n[robot]\nname = \"arm\"\n";
const LINK: &str = "[[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = \"z\" }\nmass = 2\n\
                    center_of_mass = [0.1, 0, 0]\n";
const TENSOR: &str = "inertia = { xx = 0.01, yy = 0.02, zz = 0.02 }\n";
const GRAMS: &str = "inertia = { xx = 10000, yy = 20000, zz = 20000 }\n";

/// A clean file, one with a warning, one with an error, and one that does not exist.
fn files(test: &str) -> [String; 4] {
    let folder = folder(test);
    let file = |name: &str, text: Option<String>| {
        let path = folder.join(name);
        if let Some(text) = text {
            std::fs::write(&path, text).unwrap();
        }
        path.to_str().unwrap().to_owned()
    };
    [
        file("clean.toml", Some(format!("{HEAD}{LINK}{TENSOR}"))),
        file("slip.toml", Some(format!("{HEAD}{LINK}{GRAMS}"))),
        file("wrong.toml", Some(format!("{HEAD}{LINK}{TENSOR}mas = 1\n"))),
        file("none.toml", None),
    ]
}

#[test]
fn exit_codes_tell_errors_and_denied_warnings() {
    let [clean, slip, wrong, none] = files("check_codes");
    assert_eq!(output(&["check", &clean], ""), format!("{clean}: no errors, no warnings\n"));
    let warned = complaint(0, &["check", &slip], "");
    assert!(warned.contains("warning[R0605]") && warned.contains("slip.toml:9:11\n"), "{warned}");
    assert!(complaint(1, &["check", &slip, "--deny", "warnings"], "").contains("R0605"));
    output(&["check", &slip, "--deny", "warnings", "--allow", "R0605"], "");
    let found = complaint(1, &["check", &wrong], "");
    assert!(found.contains("error[R0101]") && found.contains("wrong.toml:10:1\n"), "{found}");
    // Errors cannot be allowed.
    let allowed = complaint(1, &["check", &wrong, "--allow", "R0101"], "");
    assert!(allowed.starts_with(&format!("{found}note: --allow R0101 hides ")), "{allowed}");
    assert!(complaint(1, &["check", &none], "").contains("there is no such file"));
    assert!(complaint(2, &["check", &clean, "--allow", "R9999"], "").contains("no code `R9999`"));
    assert!(complaint(2, &["check"], "").contains("error:"));
}

#[test]
fn all_files_are_told_of() {
    let [clean, slip, wrong, none] = files("check_all");
    let outcome = run(&["check", &none, &wrong, &slip, &clean]);
    assert_eq!(outcome.code, 1);
    assert!(outcome.output.contains("clean.toml: no errors"), "{}", outcome.output);
    let at = |part: &str| outcome.errors.find(part).unwrap();
    assert!(at("none.toml") < at("R0101") && at("R0101") < at("R0605"), "{}", outcome.errors);
}

#[test]
fn json_has_an_object_for_each_diagnostic() {
    let [clean, slip, wrong, none] = files("check_json");
    let outcome = run(&["check", &none, &wrong, &slip, &clean, "--format", "json"]);
    assert_eq!((outcome.code, outcome.errors.as_str()), (1, ""));
    let document: Value = serde_json::from_str(&outcome.output).unwrap();
    let counts = ["version", "errors", "warnings", "notes"].map(|key| document[key].as_u64());
    assert_eq!(counts, [1, 2, 1, 0].map(Some));
    let list = document["diagnostics"].as_array().unwrap();
    let keys: Vec<&str> = list[0].as_object().unwrap().keys().map(String::as_str).collect();
    for one in list {
        let own: Vec<&str> = one.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(own, keys);
    }
    let named = list.iter().map(|one| (one["code"].as_str(), one["severity"].as_str().unwrap()));
    let named: Vec<_> = named.collect();
    assert_eq!(named, [(None, "error"), (Some("R0101"), "error"), (Some("R0605"), "warning")]);
    let slipped = &list[2];
    let place = ["line", "column", "end_line", "end_column"].map(|key| slipped[key].as_u64());
    assert_eq!(place, [9, 11, 9, 49].map(Some));
    assert_eq!(Path::new(slipped["file"].as_str().unwrap()).file_name().unwrap(), "slip.toml");
    assert!(slipped["remedy"].as_str().unwrap().contains("kg m^2"), "{slipped}");
    assert_eq!(slipped["related"][0]["line"], 7);
}

#[test]
fn codes_are_explained() {
    let page = output(&["check", "--explain", "r0608"], "");
    assert!(page.starts_with("# R0608: ") && page.contains("```toml"), "{page}");
    assert!(complaint(2, &["check", "--explain", "R0698"], "").contains("no code `R0698`"));
}

#[test]
fn notes_are_lines() {
    let shown = run(&["check", &robot("planar_2r")]);
    assert_eq!(shown.errors, "");
    let urdf = folder("check_notes").join("arm.urdf");
    let link = "<link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1e-2\" ixy=\"0\" \
                ixz=\"0\" iyy=\"1e-2\" iyz=\"0\" izz=\"1e-2\"/></inertial></link>";
    let joint = "<joint name=\"j\" type=\"continuous\"><parent link=\"base\"/><child link=\"a\"/>\
                 <axis xyz=\"0 0 1\"/></joint>";
    let text = format!("<robot name=\"arm\"><link name=\"base\"/>{link}{joint}</robot>");
    std::fs::write(&urdf, text).unwrap();
    let urdf = urdf.to_str().unwrap();
    let shown = run(&["check", urdf, "--deny", "warnings"]);
    assert_eq!((shown.code, shown.output), (0, format!("{urdf}: no errors, no warnings\n")));
    assert!(
        shown.errors.contains(&format!("note[R0704]: {urdf}:1:1: gravity is")),
        "{}",
        shown.errors
    );
}
