//! Every robot of this project, compiled as users compile it: flat, without panics, and no calls
//! but those of sines and cosines.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::path::{Path, PathBuf};

use robot_build::{Options, RobotFile, Trigonometry};
use robot_evidence::{Compiler, Evidence, Module, Profile, prove};

const PROFILES: [Profile; 2] = [Profile::Dev, Profile::Release];

/// The robot files of this project, in the order of their names.
fn robots() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    files.sort();
    assert!(files.len() >= 9);
    files
}

fn proved(path: &Path, trigonometry: Trigonometry) -> Vec<Module> {
    let file = RobotFile::read(path).unwrap();
    let options = Options { trigonometry, ..Options::default() };
    let options = file.with_pin(&options).unwrap();
    prove(&file.source, &options, &Compiler::default(), &PROFILES).unwrap()
}

/// Asserts the claim, and that something was read at all.
fn assert_flat(path: &Path, module: &Module) {
    let name = path.file_stem().unwrap().to_string_lossy();
    let violations: Vec<String> = module
        .violations()
        .map(|(function, violation)| format!("{name}, {function}: {violation}"))
        .collect();
    assert!(violations.is_empty(), "{}\n{}", module.profile.name(), violations.join("\n"));
    for function in &module.functions {
        let Evidence { name: function, figures, .. } = function;
        assert!(figures.instructions > 2 && figures.bytes > 8, "{name}, {function}: {figures:?}");
        assert!(figures.stack >= figures.frame && figures.frame >= 8, "{name}, {function}");
    }
    assert!(module.functions.iter().any(|function| function.name == "Model::inverse_dynamics"));
}

#[test]
fn every_robot_is_flat_with_the_standard_library() {
    for path in robots() {
        for module in proved(&path, Trigonometry::Standard) {
            assert_flat(&path, &module);
        }
    }
}

#[test]
fn every_robot_is_flat_with_the_polynomials() {
    for path in robots() {
        for module in proved(&path, Trigonometry::Polynomial) {
            assert_flat(&path, &module);
            if module.profile == Profile::Release {
                let called = module.functions.iter().flat_map(|function| &function.calls);
                assert_eq!(called.count(), 0, "{}", path.display());
            }
        }
    }
}
