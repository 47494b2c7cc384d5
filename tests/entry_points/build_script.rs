//! A package with a build script.

use crate::package::{Package, dependency};
use crate::reference;

fn package(name: &str) -> Package {
    let runtime = dependency("robot_runtime", "");
    let build = dependency("robot_build", "");
    let tables = format!("[dependencies]\n{runtime}\n[build-dependencies]\n{build}");
    let package = Package::new(name, &tables);
    package.write(
        "build.rs",
        "fn main() -> Result<(), robot_build::Errors> {\n    \
             robot_build::compile(\"robots/trttr1.toml\")\n\
         }\n",
    );
    package.write("robots/trttr1.toml", reference::ROBOT);
    let module = "include!(concat!(env!(\"OUT_DIR\"), \"/trttr1.rs\"));";
    package.write("src/main.rs", &reference::main_text(module));
    package.write(
        "examples/code.rs",
        "//! Prints the generated text.\n\
         fn main() {\n    \
             print!(\"{}\", include_str!(concat!(env!(\"OUT_DIR\"), \"/trttr1.rs\")));\n\
         }\n",
    );
    package
}

#[test]
fn a_build_script_generates_what_an_edited_file_says() {
    let package = package("by_build_script");
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));
    // Another process and another profile of the generator give the same bytes.
    assert_eq!(package.run(&["run", "--example", "code"]), reference::code(reference::ROBOT));
    let edited = reference::edited();
    package.write("robots/trttr1.toml", &edited);
    let torques = package.run(&["run"]);
    assert_eq!(torques, reference::torques(&edited));
    assert_ne!(torques, reference::torques(reference::ROBOT));
}

/// The robot file does not have the name of its robot, and the program includes the generated file under the expected
/// name.
#[test]
fn a_plan_that_comes_or_goes_is_noticed() {
    let package = package("by_pinned_build_script");
    package.write("build.rs", "fn main() { robot_build::compile(\"robots/arm.toml\").unwrap() }\n");
    std::fs::rename(package.path("robots/trttr1.toml"), package.path("robots/arm.toml")).unwrap();
    let module = "include!(concat!(env!(\"OUT_DIR\"), \"/arm.rs\"));";
    package.write("src/main.rs", &reference::main_text(module));
    package.assert_notices_plans();
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));
}

/// Without the feature for the standard library's sines, the compiler reports the missing feature instead of a missing
/// name.
#[test]
fn a_missing_feature_is_named() {
    let package = package("by_featureless_build_script");
    let runtime = dependency("robot_runtime", ", default-features = false");
    let build = dependency("robot_build", "");
    let manifest = std::fs::read_to_string(package.path("Cargo.toml")).unwrap();
    let (head, _) = manifest.split_once("[dependencies]").unwrap();
    let tables = format!("{head}[dependencies]\n{runtime}\n[build-dependencies]\n{build}");
    package.write("Cargo.toml", &tables);
    package.write(
        "build.rs",
        "fn main() -> Result<(), robot_build::Errors> {\n    \
             let builder = robot_build::Builder::new();\n    \
             let sines = robot_build::Trigonometry::Standard;\n    \
             builder.trigonometry(sines).compile(&[\"robots/trttr1.toml\"])\n\
         }\n",
    );
    let messages = package.failure(&["build"]);
    for part in [
        "need the feature `std` of `robot_runtime`",
        "features = [\"std\"]",
        "trigonometry = \"polynomial\"",
    ] {
        assert!(messages.contains(part), "{part} is not in:\n{messages}");
    }
    assert!(!messages.contains("cannot find"), "{messages}");
}

#[test]
fn a_broken_file_fails_the_build_with_its_own_errors() {
    let package = package("by_broken_build_script");
    package.write("robots/trttr1.toml", &reference::broken());
    let messages = package.failure(&["build"]);
    reference::assert_shows_what_is_broken(&messages);
    let headline = "error: by_broken_build_script@0.0.0: robots/trttr1.toml:";
    assert!(messages.lines().any(|line| line.starts_with(headline)), "{messages}");
    package.write("robots/trttr1.toml", reference::ROBOT);
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));
}
