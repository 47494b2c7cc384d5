//! A quantity that equals one printed before has no equation of its own.

use std::fs;

use crate::{complaint, folder, output, robot};

/// The equations that a form prints, as pairs of the left and the right side.
fn equations(name: &str, form: &str) -> Vec<(String, String)> {
    let shown = output(&["equations", &robot(name), "--form", form, "--format", "json"], "");
    let lines = shown.lines().filter_map(|line| line.trim().split_once(": "));
    let bare = |text: &str| text.trim_matches(['"', ',']).to_owned();
    lines.map(|(left, right)| (bare(left), bare(right))).collect()
}

/// The equations whose right side is only another defined symbol.
fn renamed(equations: &[(String, String)]) -> Vec<&(String, String)> {
    let is_defined = |name: &str| equations.iter().any(|(left, _)| left == name);
    let all = equations.iter().filter(|(left, _)| !left.starts_with('Q'));
    all.filter(|(_, right)| is_defined(right.trim_start_matches('-'))).collect()
}

#[test]
fn equal_coefficients_have_one_equation() {
    for name in ["planar_2r", "planar_3r", "scara", "stanford", "puma560", "ur5"] {
        for form in ["grouped", "regrouped", "compact"] {
            let found = equations(name, form);
            assert!(
                found.len() > 1 && renamed(&found).is_empty(),
                "{name} {form}: {:?}",
                renamed(&found)
            );
        }
    }
    let found = equations("ur5", "grouped");
    let torque = &found.iter().find(|(left, _)| left == "Q2").unwrap().1;
    assert!(torque.contains("+ b_2_2_4*(qd2 + qd3)*qd4"), "{torque}");
    let apart = output(
        &["equations", &robot("ur5"), "--form", "grouped", "--no-references", "--format", "json"],
        "",
    );
    assert!(apart.contains("\"b_2_3_4\""), "{apart}");
}

/// Inertia tensors of links are given by numbers, not by names of numbers.
#[test]
fn parameters_of_links_are_not_renamed() {
    let found = equations("ur5", "recursive");
    let one =
        |name: &str| found.iter().find(|(left, _)| left == name).map(|(_, right)| right.as_str());
    assert_eq!(one("k_1"), None);
    assert!(one("J2.xx").is_some_and(|right| right.starts_with("0.2268")), "{:?}", one("J2.xx"));
    // Link 1 turns about z alone.
    assert_eq!(one("J1.xx"), None);
}

#[test]
fn a_document_has_a_name_of_its_notation() {
    let file = robot("planar_2r");
    let found = complaint(2, &["document", &file, "-o", "arm.docx"], "");
    assert!(found.contains("a document is not written as .docx"), "{found}");
    // No advice to replace a file that cannot be replaced so, and none about the name of an input.
    let folder = folder("named_otherwise");
    let other = folder.join("notes.docx");
    fs::write(&other, "notes of somebody").unwrap();
    let found = complaint(2, &["document", &file, "-o", other.to_str().unwrap()], "");
    assert!(found.contains("a document is not written as .docx"), "{found}");
    let input = folder.join("arm.toml");
    fs::copy(&file, &input).unwrap();
    let input = input.to_str().unwrap();
    let found = complaint(1, &["document", input, "-o", input], "");
    assert!(found.contains("an output never replaces an input"), "{found}");
}

#[test]
fn angles_are_summed_by_the_numbers_of_their_joints() {
    let shown =
        output(&["equations", &robot("planar_3r"), "--form", "grouped", "--format", "latex"], "");
    assert!(shown.contains(r"\cos\left(q_1 + q_2 + q_3\right)"), "{shown}");
}
