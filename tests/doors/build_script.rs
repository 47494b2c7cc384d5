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
    // Another process, another profile of the generator: the same bytes.
    assert_eq!(package.run(&["run", "--example", "code"]), reference::code(reference::ROBOT));
    let edited = reference::edited();
    package.write("robots/trttr1.toml", &edited);
    let torques = package.run(&["run"]);
    assert_eq!(torques, reference::torques(&edited));
    assert_ne!(torques, reference::torques(reference::ROBOT));
}

#[test]
fn a_broken_file_fails_the_build_with_its_own_errors() {
    let package = package("by_broken_build_script");
    package.write("robots/trttr1.toml", &reference::broken());
    reference::assert_shows_what_is_broken(&package.failure(&["build"]));
    package.write("robots/trttr1.toml", reference::ROBOT);
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));
}
