//! A package that uses the macro.

use crate::package::{Package, dependency};
use crate::reference;

#[test]
fn a_macro_follows_its_file() {
    let runtime = dependency("robot_runtime", "");
    let macros = dependency("robot_macros", "");
    let package = Package::new("by_macro", &format!("[dependencies]\n{runtime}{macros}"));
    let module = "robot_macros::include_robot!(\"robots/trttr1.toml\");";
    package.write("src/main.rs", &reference::main_text(module));
    package.write("robots/trttr1.toml", reference::ROBOT);
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));

    package.write("robots/trttr1.toml", &reference::broken());
    reference::assert_shows_what_is_broken(&package.failure(&["build"]));
    let short = package.failure(&["build", "--message-format", "short"]);
    let headline = "error: robots/trttr1.toml:";
    assert!(
        short.lines().any(|line| line.contains(headline) && line.contains(": error R")),
        "{short}"
    );

    let edited = reference::edited();
    package.write("robots/trttr1.toml", &edited);
    assert_eq!(package.run(&["run"]), reference::torques(&edited));

    // A wrong option causes an error at its place in the source.
    let module = "robot_macros::include_robot!(\n    \"robots/trttr1.toml\",\n    snapp = 1e-8\n);";
    package.write("src/main.rs", &reference::main_text(module));
    let messages = package.failure(&["build"]);
    assert!(messages.contains("there is no option `snapp`"), "{messages}");
    assert!(messages.contains("src/main.rs:5:5"), "{messages}");
}

#[test]
fn a_plan_that_comes_or_goes_is_noticed() {
    let runtime = dependency("robot_runtime", ", features = [\"std\"]");
    let macros = dependency("robot_macros", "");
    let package = Package::new("by_pinned_macro", &format!("[dependencies]\n{runtime}{macros}"));
    let module = "robot_macros::include_robot!(\"robots/arm.toml\");";
    package.write("src/main.rs", &reference::main_text(module));
    package.write("robots/arm.toml", reference::ROBOT);
    package.assert_notices_plans();
    assert_eq!(package.run(&["run"]), reference::torques(reference::ROBOT));
}
