//! The documentation of generated modules.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use robot_build::{Bundle, FunctionKind, Functions, Options, RobotFile, Source, generate};

const ROBOTS: [&str; 9] =
    ["iiwa", "panda", "planar_2r", "planar_3r", "puma560", "scara", "stanford", "trttr1", "ur5"];

fn source(name: &str) -> Source {
    let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    RobotFile::read(path.as_ref()).unwrap().source
}

/// The lines of documentation of a module.
fn docs(source: &Source, options: &Options) -> Vec<String> {
    let code = generate(source, options).unwrap().code;
    let lines = code.lines().map(str::trim_start).filter(|line| line.starts_with("///"));
    lines.map(str::to_owned).collect()
}

#[test]
fn code_stands_in_code_spans_and_nothing_points_to_a_paper() {
    let functions = vec![FunctionKind::MassMatrix, FunctionKind::FramePoses, FunctionKind::Bias];
    for name in ROBOTS {
        let source = source(name);
        let options = Options {
            functions: Functions::All,
            bundles: vec![Bundle { name: "together".to_owned(), functions: functions.clone() }],
            generic: true,
            batch: Some(8),
            ..Options::default()
        };
        let docs = docs(&source, &options);
        assert!(docs.iter().any(|line| line.contains("accelerations `qdd`")), "{name}");
        for line in &docs {
            assert!(!line.contains(r"\`"), "{name}: {line}");
            assert_eq!(line.matches('`').count() % 2, 0, "{name}: {line}");
            let numbered = ["equation (", "equations (", "Equation ("];
            assert!(!numbered.iter().any(|words| line.contains(words)), "{name}: {line}");
        }
    }
}

#[test]
fn a_module_tells_what_else_there_is() {
    let told = |functions, bundles| {
        let docs = docs(&source("scara"), &Options { functions, bundles, ..Options::default() });
        let line = docs.iter().position(|line| line.contains("`functions = [\"…\"]`"))?;
        Some(docs[line + 1].clone())
    };
    let usual = told(Functions::Usual, vec![]).unwrap();
    assert!(usual.contains("`mass_matrix`") && usual.contains("`forward_dynamics`"), "{usual}");
    assert!(!usual.contains("`inverse_dynamics`"), "{usual}");
    let functions = vec![FunctionKind::MassMatrix];
    let bundle = Bundle { name: "together".to_owned(), functions };
    let bundled = told(Functions::Usual, vec![bundle]).unwrap();
    assert!(
        !bundled.contains("`mass_matrix`") && bundled.contains("`inverse_dynamics`"),
        "{bundled}"
    );
    assert_eq!(told(Functions::All, vec![]), None);
}
