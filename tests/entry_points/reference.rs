//! The robot file of the packages, and the results of its functions by the interpreter.

use robot_build::{Options, Source, Trigonometry, generate, programs};
use robot_codegen::Interpreter;

/// The robot file of TRTTR1.
pub(crate) const ROBOT: &str = include_str!("../../robots/trttr1.toml");

pub(crate) const Q: [f64; 5] = [0.1, -0.7, 0.2, 0.3, 1.1];
pub(crate) const QD: [f64; 5] = [0.4, 1.2, -0.3, 0.6, -0.9];
pub(crate) const QDD: [f64; 5] = [-1.0, 0.5, 0.8, -0.2, 2.0];

/// The file with another value of the mass of link 5.
pub(crate) fn edited() -> String {
    changed("M5 = { value = 3.2,", "M5 = { value = 4.7,")
}

/// The file with a misspelled key.
pub(crate) fn broken() -> String {
    changed("mass = \"M5\"", "mss = \"M5\"")
}

/// Asserts that the messages of a build show the error in [`broken`] at its place.
pub(crate) fn assert_shows_what_is_broken(messages: &str) {
    let line = broken().lines().position(|line| line.starts_with("mss =")).unwrap() + 1;
    for part in
        [&format!("robots/trttr1.toml:{line}:1"), "mss = \"M5\"", "`mss`", "did you mean `mass`"]
    {
        assert!(messages.contains(part), "{part} is not in:\n{messages}");
    }
}

fn changed(from: &str, to: &str) -> String {
    assert_eq!(ROBOT.matches(from).count(), 1, "{from}");
    ROBOT.replace(from, to)
}

fn source(text: &str) -> Source {
    Source { name: "robots/trttr1.toml".to_owned(), text: text.to_owned() }
}

/// The text of the generated module.
pub(crate) fn code(text: &str) -> String {
    generate(&source(text), &Options::default()).unwrap().code
}

/// The torques for a robot file in the state above, as [`MAIN`] prints them.
pub(crate) fn torques(text: &str) -> String {
    torques_under(text, &Options::default())
}

/// The torques like those of [`torques`], computed as by the command, which searches for the cheapest form if none is
/// pinned and uses the standard library's sines.
pub(crate) fn searched_torques(text: &str) -> String {
    let trigonometry = Trigonometry::Standard;
    torques_under(text, &Options { search: true, trigonometry, ..Options::default() })
}

fn torques_under(text: &str, options: &Options) -> String {
    let programs = programs(&source(text), options).unwrap();
    let interpreter =
        Interpreter::new(&programs.module, &[]).unwrap().with_trigonometry(options.trigonometry);
    let inputs = [("q", &Q[..]), ("qd", &QD[..]), ("qdd", &QDD[..])];
    let outputs = interpreter.call("inverse_dynamics", &inputs).unwrap();
    format!("{:?}\n", outputs[0].values)
}

/// A program that prints the torques of the module `trttr1` in the state above; `module` brings the module into scope.
/// Warnings are errors, because generated code must not cause any.
pub(crate) fn main_text(module: &str) -> String {
    format!(
        "//! Prints torques.\n\
         #![deny(warnings, missing_docs, unused, clippy::all)]\n\
         {module}\n\
         fn main() {{\n    \
             let model = trttr1::Model::new(&trttr1::Parameters::NOMINAL);\n    \
             let tau = model.inverse_dynamics(&{Q:?}, &{QD:?}, &{QDD:?});\n    \
             println!(\"{{tau:?}}\");\n\
         }}\n"
    )
}
