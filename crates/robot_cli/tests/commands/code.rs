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
    assert!(shown.contains("run the same command without --check"), "{shown}");
    // Without --check, the command would not replace a file of others.
    fs::write(&path, "// mine\n").unwrap();
    let shown = complaint(1, &check, "");
    assert!(shown.contains("is not replaced") && !shown.contains("without --check"), "{shown}");
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

/// Options for reading the robot change the code as the builder's do.
#[test]
fn options_of_the_robot_reach_the_code() {
    let link = |name: &str, angle: &str, rest: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n\
             origin = {{ xyz = [0.3, 0, 0.1], rpy = [{angle}, 0, 0] }}\n{rest}\n"
        )
    };
    let solid =
        "mass = 1\ncenter_of_mass = [0.2, 0.1, 0]\ninertia = { xx = 0.01, yy = 0.12, zz = 0.12 }";
    let light = solid.replace("0.12, zz = 0.12", "0.02, zz = 0.9");
    let start = "format = 1\n[robot]\nname = \"arm\"\ngravity = [0, 0, -9.81]\n";
    let arm = |first: &str, second: &str| {
        format!("{start}{}{}", link("1", "0.3", first), link("2", "1.5708", second))
    };
    let wanted = |options| robot_build::Options { search: true, ..options };
    let usual = robot_build::Options::default;
    let snapped = robot_build::Options { snap: Some(1e-3), ..usual() };
    let base_frames = Some(robot_build::BaseFrames::DenavitHartenberg);
    let frames = robot_build::Options { base_frames, ..usual() };
    let unphysical = robot_build::Options { allow_unphysical: true, ..usual() };
    let massless = robot_build::Options { allow_massless: true, ..usual() };
    let folder = folder("code_of_robot");
    let path = folder.join("arm.toml");
    let at = path.to_str().unwrap();
    let functions = ["inverse_dynamics", "regressor_base"];
    for (text, flags, options) in [
        (arm(solid, solid), &["--snap", "1e-3"][..], snapped),
        (arm(solid, solid), &["--base-frames", "denavit_hartenberg"], frames),
        (arm(solid, &light), &["--allow-unphysical"], unphysical),
        (arm("", solid), &["--allow-massless"], massless),
    ] {
        fs::write(&path, &text).unwrap();
        let source = robot_build::RobotFile::read(&path).unwrap().source;
        let robot = robot_build::read_with(&source, &options).unwrap().robot;
        let functions = functions.map(str::to_owned);
        let functions = robot_build::functions_named(&functions, &robot).unwrap();
        let options = wanted(robot_build::Options { functions, ..options });
        let code = robot_build::generate(&source, &options).unwrap().code;
        let generate = ["generate", at, "--function", "inverse_dynamics,regressor_base"];
        assert_eq!(run(&[&generate[..], flags].concat()).output, code, "{flags:?}");
        assert_ne!(run(&generate).output, code, "{flags:?}");
    }
}

#[test]
fn a_module_of_several_files_is_for_a_folder() {
    let file = robot("planar_2r");
    let generate = ["generate", &file, "--function", "gravity,bias", "--language"];
    let refused = complaint(1, &[&generate[..], &["matlab"]].concat(), "");
    let message = "a module in `matlab` has several files; write them with `robot-symbolic crate`";
    assert!(refused.contains(message), "{refused}");
    let header = output(&[&generate[..], &["c"]].concat(), "");
    assert!(
        header.contains("planar_2r_gravity(") && header.contains("planar_2r_bias("),
        "{header}"
    );
}

/// Base parameters that are infinite at the nominal values are a warning of both commands, which print the code
/// nevertheless.
#[test]
fn infinite_base_parameters_are_a_warning() {
    let link = |name: &str, kind: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"{kind}\", axis = \"x\" }}\n\
             origin = {{ xyz = [0.1, 0, 0], rpy = [0, \"d\", 0] }}\nmass = 1\n\
             center_of_mass = [0.1, 0.2, 0.3]\ninertia = {{ xx = 0.1, yy = 0.11, zz = 0.12 }}\n"
        )
    };
    let links = [link("a", "revolute"), link("b", "prismatic"), link("c", "revolute")].concat();
    let folder = folder("infinite");
    let file = folder.join("arm.toml");
    let text =
        |d: &str| format!("format = 1\n[robot]\nname = \"arm\"\n[parameters]\nd = {d}\n{links}");
    fs::write(&file, text("0")).unwrap();
    let (file, out) = (file.to_str().unwrap(), folder.join("arm"));
    let base = ["--language", "c", "--function", "base_parameters"];
    for command in [&["generate", file][..], &["crate", file, "-o", out.to_str().unwrap()]] {
        let outcome = run(&[command, &base].concat());
        assert_eq!(outcome.code, 0, "{}", outcome.errors);
        let warning = "warning[R0804]: `base_parameters` has no finite value";
        assert_eq!(outcome.errors.matches(warning).count(), 1, "{}", outcome.errors);
        let outcome = run(&[command, &["--language", "c"]].concat());
        assert!(!outcome.errors.contains("R0804"), "{}", outcome.errors);
    }
    assert!(out.join("arm.h").is_file());
    fs::write(file, text("0.3")).unwrap();
    let outcome = run(&[&["generate", file], &base[..]].concat());
    assert_eq!((outcome.code, outcome.errors.contains("R0804")), (0, false), "{}", outcome.errors);
}

#[test]
fn languages_have_the_names_that_people_write() {
    let file = robot("planar_2r");
    let names =
        [("c++", "cpp"), ("octave", "matlab"), ("js", "javascript"), ("node", "javascript")];
    for (other, name) in names {
        let [a, b] = [other, name].map(|name| run(&["generate", &file, "--language", name]));
        assert_eq!((a.code, a.output, a.errors), (b.code, b.output, b.errors));
    }
}
