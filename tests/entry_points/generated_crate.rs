//! Generated crates: one on which another package depends, and one for every robot.

use std::fmt::Write as _;
use std::path::Path;

use crate::package::Package;
use crate::reference;

/// Runs `robot-symbolic`; returns the exit code and the messages.
fn command(arguments: &[&str]) -> (u8, String) {
    let (mut output, mut errors) = (vec![], vec![]);
    let mut terminal = robot_cli::Terminal {
        input: &mut std::io::empty(),
        output: &mut output,
        errors: &mut errors,
        colors: false,
        progress: false,
        screen: None,
    };
    let arguments = std::iter::once("robot-symbolic").chain(arguments.iter().copied());
    let code = robot_cli::run(arguments, &mut terminal);
    (code, String::from_utf8(errors).unwrap())
}

/// Generates a crate from a robot file.
fn generate(file: &Path, folder: &Path, more: &[&str]) {
    let arguments = ["crate", file.to_str().unwrap(), "-o", folder.to_str().unwrap()];
    let (code, errors) = command(&[&arguments[..], more].concat());
    assert_eq!(code, 0, "{errors}");
}

#[test]
fn a_package_depends_on_a_generated_crate() {
    let package = Package::new(
        "by_crate",
        "[dependencies]\ntrttr1 = { path = \"generated\", features = [\"std\"] }\n",
    );
    package.write("src/main.rs", &reference::main_text("pub use trttr1;"));
    let file = package.path("robots/trttr1.toml");
    package.write("robots/trttr1.toml", reference::ROBOT);
    let standard = ["--trigonometry", "standard"];
    generate(&file, &package.path("generated"), &standard);
    assert_eq!(package.run(&["run"]), reference::searched_torques(reference::ROBOT));

    let edited = reference::edited();
    package.write("robots/trttr1.toml", &edited);
    let generated = package.path("generated");
    let check = ["crate", file.to_str().unwrap(), "-o", generated.to_str().unwrap(), "--check"];
    let (code, errors) = command(&[&check[..], &standard].concat());
    assert_eq!(code, 1);
    assert!(errors.contains("model.rs"), "{errors}");
    generate(&file, &generated, &standard);
    assert_eq!(package.run(&["run"]), reference::searched_torques(&edited));
}

/// Builds every function in the dev and release profiles; the crates' own tests compare their check values.
#[test]
fn every_robot_builds_in_both_profiles() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(files.len() >= 9);
    let mut dependencies = "[dependencies]\n".to_owned();
    for file in &files {
        let name = file.file_stem().unwrap().to_str().unwrap();
        writeln!(dependencies, "{name} = {{ path = \"{name}\" }}").unwrap();
    }
    let package = Package::new("every_robot", &dependencies);
    package.write("src/lib.rs", "//! Nothing but its dependencies.\n");
    let functions: Vec<&str> =
        robot_build::DEFAULT_FUNCTIONS.iter().map(|function| function.name()).collect();
    assert!(functions.contains(&"link_wrenches"));
    for file in &files {
        generate(file, &package.path(file.file_stem().unwrap().to_str().unwrap()), &[]);
    }
    for profile in ["dev", "release"] {
        package.run(&["build", "--profile", profile]);
    }
    let shown = package.run(&["test", "--workspace", "--tests"]);
    assert!(shown.matches("inverse_dynamics_gives_its_check_value ... ok").count() >= files.len());
    // The check values are the same without the standard library.
    let shown = package.run(&["test", "--package", "trttr1", "--features", "trttr1/std"]);
    assert!(shown.contains("link_wrenches_gives_its_check_value ... ok"), "{shown}");
}

/// A test in the generated crate of the next test: a model with two sets of parameters in lanes.
const PARAMETERS_IN_LANES: &str = "\
    use match_::{Model, Parameters};\n\
    use match_::runtime::Lanes;\n\
    #[test]\n\
    fn each_lane_has_its_parameters() {\n    \
        let parameters = [3.0, 7.0].map(|f64_| Parameters { f64_, ..Parameters::NOMINAL });\n    \
        let (q, qd, qdd) = ([[0.3, -1.1], [2.0, 0.4]], [[0.5; 2], [-0.7; 2]], [[1.5; 2], [0.1; 2]]);\n    \
        let lanes = |states: [[f64; 2]; 2]| match_::runtime::lanes_from_states::<f64, 2, 2>(&states);\n    \
        let tau = Model::new_lanes(&parameters).inverse_dynamics_generic(&lanes(q), &lanes(qd), &lanes(qdd));\n    \
        for lane in 0..2 {\n        \
            let single = Model::new(&parameters[lane]).inverse_dynamics(&q[lane], &qd[lane], &qdd[lane]);\n        \
            assert_eq!(tau.map(Lanes::to_array).map(|tau| tau[lane]), single);\n    \
        }\n\
    }\n";

/// Names of the robot, of parameters and of bundles that Rust reserves or that the generated module uses itself. The
/// crate's own tests compare the check values.
#[test]
fn a_robot_with_words_of_rust_for_names_builds() {
    let package = Package::new("reserved", "[dependencies]\nmatch_ = { path = \"generated\" }\n");
    package.write("src/lib.rs", "//! Nothing but its dependency.\n");
    let robot = r#"
        format = 1
        [robot]
        name = "match"
        gravity = [0, "-self", 0]
        [parameters]
        self = 9.81
        match = 1.0
        fn = 0.5
        crate = 5.0
        gen = 0.42
        f64 = 3.0
        parameters = 0.4
        [code]
        functions = ["inverse_dynamics", "mass_matrix"]
        bundles = { new = ["bias", "mass_matrix"], inverse_dynamics_sc = ["gravity"], fn = ["energies"] }
        [[link]]
        name = "fn"
        joint = { type = "revolute", axis = "z" }
        mass = "crate"
        center_of_mass = ["fn", 0, 0]
        inertia = { zz = "gen", unchecked = true }
        [[link]]
        name = "impl"
        joint = { type = "revolute", axis = "z" }
        origin = { xyz = ["match", 0, 0] }
        mass = "f64"
        center_of_mass = ["parameters", 0, 0]
        inertia = { zz = "gen", unchecked = true }
    "#;
    package.write("match.toml", robot);
    generate(&package.path("match.toml"), &package.path("generated"), &["--batch=8", "--generic"]);
    package.write("generated/tests/lanes.rs", PARAMETERS_IN_LANES);
    let shown = package.run(&["test", "--package", "match_", "--tests"]);
    assert!(shown.contains("test each_lane_has_its_parameters ... ok"), "{shown}");
    for function in ["inverse_dynamics", "mass_matrix", "new_2", "inverse_dynamics_sc", "fn"] {
        let test = format!("test {function}_gives_its_check_value ... ok");
        assert!(shown.contains(&test), "{test}: {shown}");
    }
}
