//! All functions of all robots: machine code has the bits of the interpreter.

#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use std::path::Path;

use robot_build::{Functions, Options, Source};
use robot_codegen::{Interpreter, Trigonometry};
use robot_jit::Executable;
use robot_symbolic::Random;
use support::{assert_same_function, registers};

/// The number of states for each function, unless `ROBOT_JIT_STATES` sets another.
const STATES: usize = 203;

#[test]
fn all_functions_of_all_robots_have_the_bits_of_the_interpreter() {
    let states = std::env::var("ROBOT_JIT_STATES").ok();
    let states = states.map_or(STATES, |states| states.parse().unwrap());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(paths.len() >= 9, "{}", paths.len());
    for path in paths {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let source = Source { name, text: std::fs::read_to_string(&path).unwrap() };
        let bundles = robot_build::read(&source).unwrap().code.bundles;
        let options = Options { functions: Functions::All, bundles, ..Options::default() };
        let programs = robot_build::programs(&source, &options).unwrap();
        let module = &programs.module;
        let missing = module.parameters.iter().filter(|parameter| parameter.nominal.is_none());
        let given: Vec<(&str, f64)> =
            missing.map(|parameter| (parameter.name.as_str(), 0.7)).collect();
        let interpreter = Interpreter::new(module, &given).unwrap();
        for registers in registers() {
            let options = robot_jit::Options { registers: Some(registers), ..Default::default() };
            let compiled = robot_jit::compile_with(module, &given, &options).unwrap();
            for function in &module.functions {
                let mut random = Random::new(7);
                let expected = interpreter.function(&function.name).unwrap();
                let columns: Vec<Vec<f64>> = (0..expected.input_size())
                    .map(|_| (0..states).map(|_| random.uniform(-3.0, 3.0)).collect())
                    .collect();
                let found = compiled.function(&function.name).unwrap();
                let place = format!("{} {} {registers:?}", source.name, function.name);
                assert_same_function(&place, expected, found, &columns, states);
            }
        }
    }
}

#[test]
fn an_executable_has_the_bits_of_the_interpreter_whatever_the_options() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/puma560.toml");
    let source =
        Source { name: "puma560.toml".to_owned(), text: std::fs::read_to_string(path).unwrap() };
    let inputs = [[0.3, -0.7, 1.1, 0.2, -1.9, 0.6], [0.1; 6], [-0.4; 6]].concat();
    for fused in [false, true] {
        let options = Options { fused, ..Options::default() };
        let programs = robot_build::programs(&source, &options).unwrap();
        for trigonometry in [Trigonometry::Polynomial, Trigonometry::Standard] {
            let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
            let interpreter = interpreter.with_trigonometry(trigonometry);
            let executable = Executable::new(&programs.module, &[], trigonometry).unwrap();
            let handle = executable.function("inverse_dynamics").unwrap();
            let is_plain = !fused && trigonometry == Trigonometry::Polynomial;
            assert_eq!(handle.is_native(), is_plain && !registers().is_empty());
            let [mut expected, mut found] = [[0.0; 6]; 2];
            let callable = interpreter.function("inverse_dynamics").unwrap();
            callable.entries(&inputs, &mut expected).unwrap();
            handle.entries(&inputs, &mut found).unwrap();
            assert_eq!(found, expected, "fused: {fused}, {trigonometry:?}");
        }
    }
}
