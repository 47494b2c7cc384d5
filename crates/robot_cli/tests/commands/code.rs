//! `generate` and `crate`.

use std::fs;

use crate::{complaint, folder, output, robot, run};

#[test]
fn the_module_is_that_of_the_builder() {
    let file = robot("trttr1");
    let shown = output(&["generate", &file], "");
    let robot_file = robot_build::RobotFile::read(file.as_ref()).unwrap();
    let options = robot_file.with_pin(&robot_build::Options::default()).unwrap();
    let generated = robot_build::generate(&robot_file.source, &options).unwrap();
    assert_eq!(shown, generated.code);
    let path = folder("generate").join("new/trttr1.rs");
    let outcome = run(&["generate", &file, "-o", path.to_str().unwrap()]);
    assert_eq!((outcome.code, outcome.output.as_str()), (0, ""));
    assert!(outcome.errors.starts_with("wrote "), "{}", outcome.errors);
    assert_eq!(fs::read_to_string(&path).unwrap(), generated.code);
    // If nothing changes, nothing is written.
    assert_eq!(output(&["generate", &file, "-o", path.to_str().unwrap()], ""), "");
}

#[test]
fn options_reach_the_code() {
    let file = robot("trttr1");
    let arguments = ["generate", &file, "--function", "link_wrenches", "--scalar", "f32"];
    let more = ["--trigonometry", "standard", "--runtime", "crate::rt"];
    let shown = output(&[&arguments[..], &more].concat(), "");
    for (part, is_there) in [
        ("pub fn link_wrenches", true),
        ("[f32; 5]", true),
        ("crate::rt::std_sin_cos_array", true),
        ("robot_runtime", false),
        ("pub fn inverse_dynamics", false),
    ] {
        assert_eq!(shown.contains(part), is_there, "{part}");
    }
    let forms = ["generate", &file, "--function", "all", "--generic", "--batch", "--fused"];
    let shown = output(&forms, "");
    assert!(!shown.contains("std_sin_cos_array") && !shown.contains("StdTrig"));
    for part in [
        "::robot_runtime::sin_cos_array",
        "pub fn inverse_dynamics_generic<T: ::robot_runtime::Scalar>",
        "pub fn mass_matrix_batch",
        "as_chunks::<8>",
        "::robot_runtime::Scalar::mul_add",
        "pub fn forward_dynamics_derivatives",
    ] {
        assert!(shown.contains(part), "{part}");
    }
    let shown = output(&["generate", &file, "--batch=4"], "");
    assert!(shown.contains("as_chunks::<4>"));
    assert!(!shown.contains("mul_add") && !shown.contains("_generic"));
    let shown = output(&["generate", &file, "--batch", "--parallel"], "");
    assert!(shown.contains("::rayon::join") && !shown.contains("feature = \"rayon\""));
    assert!(complaint(2, &["generate", &file, "--parallel"], "").contains("--batch"));
    let shown = complaint(2, &["generate", &file, "--batch=0"], "");
    assert!(shown.contains("choose 1 to 64"), "{shown}");
    let shown = complaint(2, &["generate", &file, "--function", "a,link_wrench"], "");
    assert_eq!(shown.lines().count(), 2);
    let shown = complaint(2, &["generate", &file, "--runtime", "a b"], "");
    assert!(shown.contains("`a b`"), "{shown}");
}

#[test]
fn a_module_out_of_date_is_found() {
    let path = folder("generate-check").join("trttr1.rs");
    let (file, at) = (robot("trttr1"), path.to_str().unwrap());
    let check = ["generate", &file, "-o", at, "--check"];
    assert!(complaint(1, &check, "").contains("trttr1.rs is missing"));
    run(&["generate", &file, "-o", at]);
    assert_eq!(output(&check, ""), "");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(output(&check, ""), "");
    fs::write(&path, text.replacen("pub mod", "mod", 1)).unwrap();
    let line = text.lines().position(|line| line.contains("pub mod")).unwrap() + 1;
    let shown = complaint(1, &check, "");
    assert!(shown.contains(&format!("trttr1.rs:{line} is out of date")), "{shown}");
    assert!(complaint(2, &["generate", &file, "--check"], "").contains("--output"));
}

#[test]
fn files_of_a_crate_out_of_date_are_all_named() {
    let path = folder("crate-check").join("trttr1");
    let (file, at) = (robot("trttr1"), path.to_str().unwrap());
    let check = ["crate", &file, "-o", at, "--check"];
    assert_eq!(run(&["crate", &file, "-o", at]).code, 0);
    assert_eq!(output(&check, ""), "");
    fs::remove_file(path.join("README.md")).unwrap();
    fs::write(path.join("src/runtime/root.rs"), "\n").unwrap();
    let shown = complaint(1, &check, "");
    assert!(shown.contains("README.md is missing"), "{shown}");
    assert!(shown.contains("root.rs:1 is out of date"), "{shown}");
    assert_eq!(shown.lines().count(), 3);
    // With other options it would be another crate.
    let other = [&check[..], &["--function", "link_wrenches"]].concat();
    assert!(complaint(1, &other, "").contains("model.rs"));
}

#[test]
fn bundles_are_functions_of_their_own() {
    let robot = robot("planar_2r");
    let generate = |bundle| vec!["generate", &robot, "--bundle", bundle];
    let code = output(&generate("dynamics=mass_matrix,bias"), "");
    for part in ["pub struct Dynamics {", "pub mass_matrix: [[f64; 2]; 2]", "-> Dynamics"] {
        assert!(code.contains(part), "{part} is not in\n{code}");
    }
    assert!(!code.contains("fn inverse_dynamics("), "{code}");
    for (bundle, part) in [
        ("dynamics", "such as dynamics=mass_matrix,bias"),
        ("dynamics=mass_matrx", "Did you mean `mass_matrix`?"),
    ] {
        let shown = complaint(2, &generate(bundle), "");
        assert!(shown.contains(part), "{shown}");
    }
    let shown = complaint(2, &generate("bias=mass_matrix"), "");
    assert!(shown.contains("the bundle `bias`: the name is not allowed"), "{shown}");
}
