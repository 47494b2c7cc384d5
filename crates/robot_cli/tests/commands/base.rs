//! `base`: the formulas of base parameters can be read back and have the printed values.

use robot_symbolic::Formula;
use serde_json::Value;

use crate::{complaint, folder, output, robot, run};

fn base(name: &str, frames: &str) -> Value {
    let robot = robot(name);
    let arguments = ["base", &robot, "--format", "json", "--base-frames", frames];
    let shown = run(&arguments);
    assert_eq!(shown.code, 0, "{}", shown.errors);
    serde_json::from_str(&shown.output).unwrap()
}

/// Checks that the formula of a base parameter agrees with its coefficients, and that both can be read back.
fn assert_formula_agrees(entry: &Value) {
    let parse = |text: &Value| Formula::parse(text.as_str().unwrap()).unwrap();
    parse(&entry["value"]);
    // Each name has a different value, so that the coefficients must be those of the formula.
    let value = |name: &str| name.bytes().fold(0.5, |sum, byte| sum * 0.7 + f64::from(byte));
    let formula = parse(&entry["formula"]).evaluate(value);
    let coefficients = entry["coefficients"].as_object().unwrap().iter();
    let sum: f64 = coefficients
        .map(|(name, coefficient)| parse(coefficient).evaluate(value) * value(name))
        .sum();
    assert!((formula - sum).abs() <= 1e-9 * sum.abs(), "{entry}");
}

#[test]
fn formulas_and_values_read_back() {
    for (name, count) in [("puma560", 36), ("trttr1", 20), ("planar_3r", 9)] {
        let set = base(name, "file");
        let list = set["base"].as_array().unwrap();
        assert_eq!(list.len(), count, "{name}");
        for entry in list {
            assert_formula_agrees(entry);
            let kept =
                set["standard"][entry["column"].as_u64().unwrap() as usize].as_str().unwrap();
            assert_eq!(entry["name"].as_str().unwrap().replacen("R_", "_", 1), kept);
            assert_eq!(entry["coefficients"][kept], "1");
        }
    }
}

#[test]
fn moments_in_other_frames_are_written_in_the_parameters_of_the_file() {
    for (name, count) in [("puma560", 36), ("trttr1", 20), ("planar_3r", 9)] {
        let set = base(name, "denavit_hartenberg");
        assert_eq!(set["frames"], "denavit_hartenberg");
        let list = set["base"].as_array().unwrap();
        assert_eq!(list.len(), count, "{name}");
        for entry in list {
            assert_formula_agrees(entry);
            let drive = entry["name"].as_str().unwrap().starts_with(['F', 'I']);
            assert_eq!(entry["column"].is_null(), !drive, "{name}: {entry}");
        }
    }
    let shown = output(&["base", &robot("planar_2r"), "--base-frames", "denavit_hartenberg"], "");
    for line in [
        "planar_2r: 6 base parameters of 20, moments in Denavit-Hartenberg frames, formulas in the frames of the file",
        "MXR_1 = MX_1 + l1*M_2",
        "SYY_2 = ZZ_2",
    ] {
        assert!(shown.lines().any(|shown| shown == line), "{line} is not in {shown}");
    }
}

#[test]
fn lengths_stay_symbols() {
    let shown = output(&["base", &robot("planar_2r")], "");
    for line in
        ["planar_2r: 6 base parameters of 20", "ZZR_1 = ZZ_1 + l1^2*M_2", "MXR_1 = MX_1 + l1*M_2"]
    {
        assert!(shown.lines().any(|shown| shown == line), "{line} is not in {shown}");
    }
}

#[test]
fn latex_is_an_environment_of_amsmath() {
    let shown = output(&["base", &robot("planar_2r"), "--format", "latex"], "");
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(lines.first(), Some(&r"\begin{align*}"));
    assert_eq!(lines.last(), Some(&r"\end{align*}"));
    let formula =
        r"  \mathit{ZZR}_1 &= \mathit{ZZ}_1 + l_1^{2} M_2 = m_1 r_1^{2} + I_1 + m_2 l_1^{2} \\";
    assert!(lines.contains(&formula), "{shown}");
    let narrow = output(&["base", &robot("puma560"), "--format", "latex", "--width", "8cm"], "");
    assert!(narrow.contains(r"    &\quad "), "{narrow}");
}

/// A mass M_3 of the file that is a base parameter is not printed as the equation M_3 = M_3, and text distinguishes the
/// two.
#[test]
fn a_parameter_of_the_file_is_a_name_alone_where_it_looks_like_its_own() {
    let shown = |format: &str| run(&["base", &robot("trttr1"), "--format", format]).output;
    for (format, line) in [
        ("latex", "  M_3 & \\\\"),
        ("typst", "$ M_3 & $"),
        ("markdown", "M_3"),
        ("text", "M_3 = M3"),
    ] {
        let shown = shown(format);
        assert!(shown.lines().any(|shown| shown == line), "{line} is not in {shown}");
        assert!(!shown.contains("M_3 = M_3") && !shown.contains("M_3 &= M_3"), "{shown}");
    }
    assert_eq!(shown("mathml").matches("<mtd></mtd>").count(), 1);
}

#[test]
fn typst_numbers_the_formulas() {
    let shown = output(
        &["base", &robot("planar_2r"), "--format", "typst", "--width", "8cm", "--numbers"],
        "",
    );
    assert!(shown.contains("italic(Z Z)_1 + l_1^2 M_2 = "), "{shown}");
    assert!(shown.contains("<eq:ZZR-1>"), "{shown}");
}

#[test]
fn what_is_out_of_reach_is_told() {
    let text = std::fs::read_to_string(robot("planar_2r")).unwrap();
    let path = folder("base").join("arm.toml");
    let (first, second) = text.split_once("name = \"2\"").unwrap();
    let second = second.replacen("axis = \"z\"", "axis = \"z\", mimic = { joint = \"1\" }", 1);
    std::fs::write(&path, format!("{first}name = \"2\"{second}")).unwrap();
    let errors = complaint(1, &["base", path.to_str().unwrap()], "");
    assert!(errors.contains("joints share a coordinate"), "{errors}");
}

/// On a vertical slide with a drive and dry friction, motions do not separate the mass, the drive's inertia and the
/// friction; without one of these, or on a horizontal slide, they do.
#[test]
fn what_motions_do_not_separate_is_named() {
    let path = folder("inseparable").join("arm.toml");
    let link = |name: &str, joint: &str, more: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ {joint} }}\norigin = {{ xyz = [0.3, 0, 0] }}\nmass = 1.5\n\
             center_of_mass = [0.1, 0, 0.02]\ninertia = {{ xx = 0.01, yy = 0.03, zz = 0.03 }}\n{more}"
        )
    };
    let (turn, vertical) =
        ("type = \"revolute\", axis = \"z\"", "type = \"prismatic\", axis = \"z\"");
    let drive = "drive = { armature = 1.2 }\n";
    let friction = "friction = { coulomb_force = 12, viscous = 5 }\n";
    for (first, slide, more, named) in [
        (turn, vertical, format!("{drive}{friction}"), Some("ZZR_1, M_2, IA_2, FP_2, FN_2")),
        (
            "type = \"prismatic\", axis = \"y\"",
            vertical,
            format!("{drive}{friction}"),
            Some("M_1, M_2, IA_2, FP_2, FN_2"),
        ),
        (vertical, vertical, format!("{drive}{friction}"), None),
        (turn, vertical, drive.to_owned(), None),
        (turn, vertical, friction.to_owned(), None),
        (turn, "type = \"prismatic\", axis = \"x\"", format!("{drive}{friction}"), None),
        ("type = \"revolute\", axis = \"x\"", vertical, format!("{drive}{friction}"), None),
    ] {
        let links = link("a", first, "") + &link("b", slide, &more);
        std::fs::write(&path, format!("format = 1\n[robot]\nname = \"arm\"\n{links}")).unwrap();
        let shown = run(&["base", path.to_str().unwrap()]);
        let note = shown.errors.lines().find(|line| line.contains("linearly dependent"));
        match named {
            Some(named) => assert!(
                note.is_some_and(|note| note.starts_with(&format!("note: {named}: "))),
                "{}",
                shown.errors
            ),
            None => assert_eq!(note, None, "{first} {slide} {more}"),
        }
    }
}
