//! Every robot of this project, compiled as users compile it, is flat and cannot panic, and its only calls are those of
//! sines and cosines.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::path::{Path, PathBuf};

use robot_build::{Functions, Options, RobotFile, Scalar, Source, Trigonometry, programs};
use robot_codegen::backend::rust::stack;
use robot_evidence::{Compiler, Evidence, Module, Profile, Violation, prove};

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

/// The options of a build that uses the pinned plan.
fn options(path: &Path, trigonometry: Trigonometry, functions: Functions) -> Options {
    let options = Options { trigonometry, functions, ..Options::default() };
    RobotFile::read(path).unwrap().with_pin(&options).unwrap()
}

fn proved(path: &Path, options: &Options) -> Vec<Module> {
    let file = RobotFile::read(path).unwrap();
    prove(&file.source, options, &Compiler::default(), &PROFILES).unwrap()
}

/// Asserts that the estimated stack is at least the stack that functions take. In dev, this excludes the runtime's
/// sines and cosines, which are calls there.
fn assert_estimated(path: &Path, options: &Options, modules: &[Module]) {
    let file = RobotFile::read(path).unwrap();
    for function in &programs(&file.source, options).unwrap().module.functions {
        let estimate = stack::estimate(function, 8) as u64;
        for module in modules {
            let frame = |name: &str| {
                let of_name = |found: &&Evidence| found.name == format!("Model::{name}");
                module.functions.iter().find(of_name).map_or(0, |found| found.measurements.frame)
            };
            let name = &function.name;
            let frames = frame(name) + frame(&format!("{name}_sc"));
            println!("{} {name} {} {frames} of {estimate}", path.display(), module.profile.name());
            assert!(frames > 0 && frames <= estimate, "{name}: {frames} > {estimate}");
        }
    }
}

/// Asserts the claim, and that code was read at all.
fn assert_flat(path: &Path, module: &Module) {
    let name = path.file_stem().unwrap().to_string_lossy();
    let violations: Vec<String> = module
        .violations()
        .map(|(function, violation)| format!("{name}, {function}: {violation}"))
        .collect();
    assert!(violations.is_empty(), "{}\n{}", module.profile.name(), violations.join("\n"));
    for function in &module.functions {
        let Evidence { name: function, measurements, .. } = function;
        assert!(
            measurements.instructions > 2 && measurements.bytes > 8,
            "{name}, {function}: {measurements:?}"
        );
        assert!(
            measurements.stack >= measurements.frame && measurements.frame >= 8,
            "{name}, {function}"
        );
    }
    assert!(module.functions.iter().any(|function| function.name == "Model::inverse_dynamics"));
}

#[test]
fn every_robot_is_flat_with_the_standard_library() {
    for path in robots() {
        let options = options(&path, Trigonometry::Standard, Functions::Usual);
        let modules = proved(&path, &options);
        for module in &modules {
            assert_flat(&path, module);
        }
        assert_estimated(&path, &options, &modules);
    }
}

#[test]
fn every_robot_is_flat_with_the_polynomials() {
    for path in robots() {
        let options = options(&path, Trigonometry::Polynomial, Functions::Usual);
        for module in proved(&path, &options) {
            assert_flat(&path, &module);
            if module.profile == Profile::Release {
                let called = module.functions.iter().flat_map(|function| &function.calls);
                assert_eq!(called.count(), 0, "{}", path.display());
            }
        }
    }
}

/// All functions, for an arm whose programs have several blocks.
#[test]
fn every_function_is_flat() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/stanford.toml");
    let options = options(&path, Trigonometry::Standard, Functions::All);
    let modules = proved(&path, &options);
    for module in &modules {
        assert!(module.functions.len() > 30);
        assert_flat(&path, module);
        // Only functions with many zeros in their results call a function that fills them in.
        for function in module.functions.iter().filter(|_| module.profile == Profile::Release) {
            let fills = function.calls.iter().any(|(symbol, _)| symbol.contains("memset"));
            let loops = function.takes_states;
            assert!(loops || !fills || function.name.contains("regressor"), "{}", function.name);
        }
    }
    assert_estimated(&path, &options, &modules);
}

/// Batches, columns and blocks loop over states; they do not panic, and call no other function than those that copy and
/// fill memory.
#[test]
fn functions_of_several_states_only_loop() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/planar_2r.toml");
    let options = options(&path, Trigonometry::Polynomial, Functions::All);
    for module in proved(&path, &Options { batch: Some(8), ..options }) {
        assert_eq!(module.violations().collect::<Vec<_>>(), []);
        for form in ["_batch", "_columns", "_block"] {
            let name = format!("Model::inverse_dynamics{form}");
            let function = module.functions.iter().find(|function| function.name == name).unwrap();
            let may_panic = module.profile == Profile::Dev;
            assert!(
                function.takes_states && (may_panic || function.measurements.panics == 0),
                "{name}"
            );
        }
    }
}

#[test]
fn more_stack_than_the_budget_is_a_violation_of_release_builds() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/planar_2r.toml");
    let options = options(&path, Trigonometry::Standard, Functions::Usual);
    let [dev, release] =
        proved(&path, &Options { max_stack: Some(90), ..options }).try_into().unwrap();
    assert_eq!(dev.violations().count(), 0);
    let violations: Vec<_> = release.violations().collect();
    let of_dynamics = violations.iter().find(|(name, _)| *name == "Model::inverse_dynamics");
    let (_, violation) = of_dynamics.unwrap();
    assert!(matches!(violation, Violation::Stack { bytes: 91.., limit: 90 }), "{violation}");
}

/// A constructor computes the sines of angles that are parameters.
#[test]
fn a_model_with_an_angle_as_parameter_is_flat() {
    let path = Path::new("tilted.toml");
    let text = "format = 1\n[robot]\nname = \"tilted\"\n[parameters]\n\
        beta = { value = 0.6, unit = \"rad\" }\n[[link]]\nname = \"1\"\n\
        joint = { type = \"revolute\", axis = \"z\" }\norigin = { rpy = [\"beta\", 0, 0] }\nmass = 1\n\
        center_of_mass = [0.5, 0, 0]\ninertia = { xx = 0.01, yy = 0.1, zz = 0.1 }\n";
    let source = Source { name: "tilted.toml".to_owned(), text: text.to_owned() };
    for trigonometry in [Trigonometry::Standard, Trigonometry::Polynomial] {
        for scalar in [Scalar::F64, Scalar::F32] {
            let options = Options { trigonometry, scalar, ..Options::default() };
            for module in prove(&source, &options, &Compiler::default(), &PROFILES).unwrap() {
                assert!(module.functions.iter().any(|one| one.name == "Model::new"));
                assert_flat(path, &module);
            }
        }
    }
}
