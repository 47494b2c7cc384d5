//! Options and values that have no effect, and those that are given twice, are noticed.

use crate::{complaint, folder, output, robot, run, run_with};

/// The notes of a command that does its work.
fn notes(arguments: &[&str]) -> String {
    let done = run(arguments);
    assert_eq!(done.code, 0, "{arguments:?}: {}", done.errors);
    done.errors
}

#[test]
fn friction_that_is_in_no_base_parameter_is_noticed() {
    let note = |name: &str| notes(&["base", &robot(name)]);
    let found = note("trttr1");
    let start = "note: 1, 2, 3, 4, 5: friction that depends on the load (`coulomb`) is not part of";
    assert!(found.starts_with(start), "{found}");
    assert!(!note("planar_2r").contains("coulomb"));
}

/// Positions in degrees would otherwise be read as many turns.
#[test]
fn states_outside_the_limits_are_noted_once() {
    let arguments = ["eval", &robot("ur5"), "--function", "gravity", "--states", "-"];
    let states = |first: &str| format!("q1,q2,q3,q4,q5,q6\n{first}\n0,90,0,0,0,0\n0,-90,1,0,0,0\n");
    for (first, all) in
        [("0,0,0,0,0,0", "line 3: q2 = 90 rad"), ("7,0,0,0,0,0", "line 2: q1 = 7 rad")]
    {
        let done = run_with(&arguments, states(first).as_bytes());
        assert_eq!(done.code, 0, "{}", done.errors);
        let start = format!("note: standard input: {all} is outside its limits, ");
        assert!(done.errors.starts_with(&start), "{}", done.errors);
        assert!(done.errors.contains("angles in files are in radians ("), "{}", done.errors);
        assert_eq!(done.errors.lines().count(), 1, "{}", done.errors);
    }
    output(&arguments, "q1,q2,q3,q4,q5,q6\n0,1,0,0,0,0\n");
}

#[test]
fn frames_of_base_parameters_are_noticed_where_there_are_none() {
    let arm = robot("planar_2r");
    let frames = ["--base-frames", "denavit_hartenberg"];
    let note = "note: --base-frames has no effect here, only on base parameters";
    for arguments in [
        &["eval", &arm, "--function", "gravity", "--q", "0,0"][..],
        &["generate", &arm],
        &["stats", &arm, "--function", "gravity"],
        &["simulate", &arm, "--time", "0.01"],
        &["torques", &arm, "--expressions", "q1 = t; q2 = 0", "--time", "0.01"],
        &["show", &arm],
        &["search", &arm, "--dry-run"],
        &["scheme", &arm],
    ] {
        let found = notes(&[arguments, &frames].concat());
        assert!(found.contains(note), "{arguments:?}: {found}");
        assert!(!notes(arguments).contains(note), "{arguments:?}");
    }
    for arguments in [
        &["eval", &arm, "--function", "base_parameters"][..],
        &["generate", &arm, "--function", "regressor_base"],
        &["generate", &arm, "--bundle", "both=gravity,regressor_base"],
        &["stats", &arm],
        &["base", &arm],
    ] {
        let found = notes(&[arguments, &frames].concat());
        assert!(!found.contains(note), "{arguments:?}: {found}");
    }
}

#[test]
fn options_of_code_are_noticed_in_languages_that_do_not_have_them() {
    let arm = robot("planar_2r");
    let of = |options: &[&str]| notes(&[&["generate", &arm][..], options].concat());
    for words in ["apart", "side_by_side"] {
        let limbs = ["--limbs", words];
        let found = of(&[&["--language", "python"][..], &limbs].concat());
        assert!(found.contains("note: --limbs has no effect outside Rust"), "{found}");
        let found = of(&limbs);
        assert!(found.contains("note: --limbs has no effect on this robot: it has"), "{found}");
        let quadruped = "tests/fixtures/limbs/quadruped.toml";
        let quadruped = format!("{}/../../{quadruped}", env!("CARGO_MANIFEST_DIR"));
        let bias = ["--function", "bias"];
        assert_eq!(notes(&[&["generate", &quadruped][..], &bias, &limbs].concat()), "");
    }
    let standard = ["--trigonometry", "standard", "--limbs"];
    let found = of(&[&standard[..], &["side_by_side"]].concat());
    assert!(found.contains("note: --limbs has no effect with --trigonometry standard"), "{found}");
    let found = of(&[&standard[..], &["apart"]].concat());
    assert!(found.contains("note: --limbs has no effect on this robot"), "{found}");
    let found = of(&["--language", "python", "--fused"]);
    assert!(found.contains("note: --fused: `python` has no instruction"), "{found}");
    assert_eq!(of(&["--fused"]), "");
}

#[test]
fn what_is_given_twice_is_an_error() {
    let arm = robot("planar_2r");
    for (arguments, expected) in [
        (&["generate", &arm, "--function", "bias,bias"][..], "--function: `bias` is given twice"),
        (
            &["stats", &arm, "--function", "all,bias"],
            "`all` stands alone: it selects every function",
        ),
        (&["generate", &arm, "--bundle", "d=bias,bias"], "--bundle d: `bias` is given twice"),
        (&["equations", &arm, "--quantity", "Q,Q"], "--quantity: `Q` is given twice"),
        (&["equations", &arm, "--quantity", "all,Q"], "`all` selects all quantities"),
        (&["document", &arm, "--form", "grouped,grouped"], "--form: `grouped` is given twice"),
        (&["check", &arm, "--allow", "R0602,R0602"], "--allow: `R0602` is given twice"),
        (&["prove", &arm, "--profile", "dev,dev"], "--profile: `dev` is given twice"),
    ] {
        let found = complaint(2, arguments, "");
        assert!(found.contains(expected), "{arguments:?}: {found}");
    }
}

#[test]
fn imported_friction_that_no_joint_has_is_noticed() {
    let joint = |dynamics: &str| {
        format!(
            "<robot name='a'><link name='base'/><link name='b'><inertial><mass value='1'/>\
            <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>\
            <joint name='j' type='continuous'><parent link='base'/><child link='b'/>{dynamics}</joint></robot>"
        )
    };
    let path = folder("effects_import").join("arm.urdf");
    let file = path.to_str().unwrap();
    let note = "--friction has no effect, because no joint has `<dynamics>`";
    for (dynamics, expected) in
        [("", true), ("<dynamics damping='0'/>", true), ("<dynamics damping='1'/>", false)]
    {
        std::fs::write(&path, joint(dynamics)).unwrap();
        assert_eq!(notes(&["import", file, "--friction"]).contains(note), expected, "{dynamics}");
        assert!(!notes(&["import", file]).contains(note), "{dynamics}");
    }
}

#[test]
fn a_document_has_the_format_of_its_name_and_a_title() {
    let folder = folder("effects_document");
    let arm = robot("planar_2r");
    let path = folder.join("arm.typ");
    let path = path.to_str().unwrap();
    let wrong = complaint(2, &["document", &arm, "--format", "latex", "-o", path], "");
    assert!(wrong.contains("--format contradicts the name of a file .typ"), "{wrong}");
    assert!(run(&["document", &arm, "--format", "typst", "-o", path]).code == 0);
    let wrong = complaint(2, &["document", &arm, "--title", ""], "");
    assert!(wrong.contains("--title"), "{wrong}");
}
