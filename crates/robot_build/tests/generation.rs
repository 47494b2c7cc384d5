//! The driver on the robot files of this project.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use robot_build::{
    Commands, Functions, OPTIONS, OptionSpec, Options, RobotFile, Source, Trigonometry, generate,
    package, programs,
};

fn robot_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(paths.len() >= 9);
    paths
}

fn source(name: &str) -> Source {
    let paths = robot_files();
    let path = paths.iter().find(|path| path.ends_with(name)).unwrap();
    RobotFile::read(path).unwrap().source
}

#[test]
fn every_robot_is_generated_the_same_twice() {
    for path in robot_files() {
        let source = RobotFile::read(&path).unwrap().source;
        let [first, second] = [0, 1].map(|_| generate(&source, &Options::default()).unwrap());
        assert_eq!(first.code, second.code);
        let stem = path.file_stem().unwrap().to_str().unwrap();
        assert_eq!(first.module_name, stem);
        assert!(first.code.contains(&format!("pub mod {stem} {{")));
        assert_eq!(first.files_read, [source.name]);
        let costs = first.counts.iter().map(|(name, counts)| (name.as_str(), counts.call.mul));
        assert!(costs.clone().any(|(name, mul)| name == "inverse_dynamics" && mul > 0));
        assert!(costs.clone().any(|(name, _)| name == "link_wrenches"));
    }
}

#[test]
fn the_code_does_not_say_where_the_file_lies() {
    let here = source("trttr1.toml");
    let there = Source { name: "/some/where\\trttr1.toml".to_owned(), text: here.text.clone() };
    let code = |source| generate(source, &Options::default()).unwrap().code;
    assert_eq!(code(&here), code(&there));
    assert!(!code(&here).contains(env!("CARGO_MANIFEST_DIR")));
}

#[test]
fn parameters_are_documented() {
    let code = generate(&source("trttr1.toml"), &Options::default()).unwrap().code;
    for line in ["/// mass of link 5, in kg; nominally 3.2.", "pub M5: f64"] {
        assert!(code.contains(line), "{line}");
    }
}

#[test]
fn only_the_chosen_functions_are_generated() {
    let functions = Functions::Chosen(vec![robot_build::FunctionKind::LinkWrenches]);
    let options = Options { functions, ..Options::default() };
    let programs = programs(&source("trttr1.toml"), &options).unwrap();
    let names: Vec<_> = programs.module.functions.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["link_wrenches"]);
}

/// The documentation also states the range of angles.
#[test]
fn the_sine_is_the_runtimes_unless_asked_otherwise() {
    let source = source("planar_2r.toml");
    let limit = "1073741824 rad";
    assert_eq!(robot_runtime::trig::double::LIMIT, 1073741824.0);
    assert_eq!(robot_runtime::trig::single::LIMIT, 131072.0);
    let standard = Options { trigonometry: Trigonometry::Standard, ..Options::default() };
    for (options, is_standard) in [(Options::default(), false), (standard, true)] {
        let readme = package::package(&source, &options).unwrap().swap_remove(1);
        assert_eq!(readme.path, "README.md");
        let code = generate(&source, &options).unwrap().code;
        assert_eq!(code.contains("std_sin_cos_array"), is_standard);
        for text in [readme.contents.text().unwrap().to_owned(), code] {
            let (of_limit, of_any) = (text.contains(limit), text.contains("of any size"));
            assert_eq!((of_limit, of_any), (!is_standard, is_standard), "{text}");
            assert_eq!(text.contains("131072 rad"), !is_standard);
        }
    }
}

#[test]
fn hostile_text_stays_text() {
    let hostile = "*/ ]] ``` \\n}fn evil() {} <script> /// #![doc] \"";
    let text = source("planar_2r.toml").text;
    let line = text.lines().find(|line| line.starts_with("description")).unwrap();
    let text =
        text.replace(line, &format!("description = '''{hostile}\n```\nfn evil2() {{}}\n'''"));
    let hostile_source = Source { name: "x.toml".to_owned(), text };
    let code = generate(&hostile_source, &Options::default()).unwrap().code;
    for line in code.lines().filter(|line| line.contains("evil")) {
        assert!(line.trim_start().starts_with("///"), "{line}");
    }
    for file in package::package(&hostile_source, &Options::default()).unwrap() {
        let text = file.contents.text().unwrap();
        let fences = text.lines().filter(|line| line.trim_start().starts_with("```"));
        assert_eq!(fences.count() % 2, 0, "{}", file.path);
        for line in text.lines().filter(|line| line.contains("evil")) {
            assert_eq!(file.path, "README.md", "{line}");
            assert!(!line.contains("```"), "{line}");
        }
    }
}

/// Each option of code changes the module, and the options of the table are set apart from each other.
#[test]
fn every_option_of_code_reaches_the_module() {
    const QUADRUPED: &str = include_str!("../../../tests/fixtures/limbs/quadruped.toml");
    let source = Source { name: "quadruped.toml".to_owned(), text: QUADRUPED.to_owned() };
    let batches = Options { batch: Some(8), ..Options::default() };
    let plain = generate(&source, &Options::default()).unwrap().code;
    let plain_batches = generate(&source, &batches).unwrap().code;
    let mut codes = vec![plain.clone(), plain_batches.clone()];
    let is_of_code =
        |option: &&OptionSpec| matches!(option.commands, Commands::Code | Commands::Module);
    for option in OPTIONS.iter().filter(is_of_code) {
        let example = if option.name == "runtime" { "\"crate::rt\"" } else { option.example };
        // Functions and bundles are in tests of their own.
        let Some(value) = option.value(example) else { continue };
        let mut options =
            if option.requires.is_some() { batches.clone() } else { Options::default() };
        option.set(&mut options, value).unwrap();
        let code = generate(&source, &options).unwrap().code;
        assert!(!codes.contains(&code), "{}", option.name);
        codes.push(code);
    }
    assert_eq!(codes.len(), 2 + 8);
}

/// The torques of three pendulums do not depend on velocities, so nothing is stored in that matrix.
#[test]
fn a_matrix_of_zeros_is_not_mutable() {
    let link = |name: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\nparent = \"base\"\n\
             joint = {{ type = \"revolute\", axis = \"z\" }}\nmass = 1\n\
             center_of_mass = [0.1, 0.2, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n"
        )
    };
    let links = ["1", "2", "3", "4"].map(link).concat();
    let text = format!("format = 1\n[robot]\nname = \"clocks\"\ngravity = [0, -9.81, 0]\n{links}");
    let source = Source { name: "clocks.toml".to_owned(), text };
    let functions = robot_build::FunctionKind::from_name("inverse_dynamics_derivatives").unwrap();
    let functions = Functions::Chosen(vec![functions]);
    let options = Options { batch: Some(4), functions, ..Options::default() };
    let code = generate(&source, &options).unwrap().code;
    assert!(code.contains("let mut dtau_dq = [[[0.0; 4]; 4]; 4];"), "{code}");
    assert!(code.contains("let dtau_dqd = [[[0.0; 4]; 4]; 4];"), "{code}");
}
