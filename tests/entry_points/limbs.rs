//! Similar limbs, compiled to the lanes of one call: the values must equal those of the interpreter, which computes the
//! limbs separately.

use std::fmt::Write as _;

use robot_build::{Functions, Options, Programs, Source, Trigonometry, generate, programs};
use robot_codegen::Interpreter;
use robot_model::functions::{Effects, FunctionKind};
use robot_numeric::random::Random;

use crate::package::{Package, dependency};

const QUADRUPED: &str = include_str!("../fixtures/limbs/quadruped.toml");
const STATES: usize = 7;

const FUNCTIONS: [FunctionKind; 6] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::Bias,
    FunctionKind::Gravity,
    FunctionKind::MassMatrix,
    FunctionKind::ForwardDynamics(Effects::NONE),
    FunctionKind::InverseDynamicsDerivatives,
];

fn options(fused: bool, trigonometry: Trigonometry) -> Options {
    let functions = Functions::Chosen(FUNCTIONS.to_vec());
    Options { functions, fused, trigonometry, ..Options::default() }
}

fn source() -> Source {
    Source { name: "quadruped.toml".to_owned(), text: QUADRUPED.to_owned() }
}

/// The inputs of a function in each state.
fn inputs(programs: &Programs, function: &str) -> Vec<Vec<(String, Vec<f64>)>> {
    let mut random = Random::new(11);
    let function = programs.module.function(function).unwrap();
    let mut state = || {
        let inputs = function.inputs.iter();
        let inputs = inputs.map(|input| {
            let entries = input.symbols.iter().map(|_| random.uniform(-2.0, 2.0));
            (input.name.clone(), entries.collect())
        });
        inputs.collect()
    };
    (0..STATES).map(|_| state()).collect()
}

/// A program that prints all results in all states, one line for each state.
fn main_text(programs: &Programs) -> String {
    let mut text = "#![deny(warnings)]\nmod robot;\nuse robot::quadruped::Model;\n\
        trait Flat { fn flat(&self) -> Vec<f64>; }\n\
        impl Flat for f64 { fn flat(&self) -> Vec<f64> { vec![*self] } }\n\
        impl<T: Flat, const N: usize> Flat for [T; N] {\n    \
            fn flat(&self) -> Vec<f64> { self.iter().flat_map(Flat::flat).collect() }\n}\n\
        fn main() {\n"
        .to_owned();
    for function in &programs.module.functions {
        for state in inputs(programs, &function.name) {
            let arguments: Vec<String> =
                state.iter().map(|(_, entries)| format!("&{entries:?}")).collect();
            let call = format!("Model::NOMINAL.{}({})", function.name, arguments.join(", "));
            let values = match function.outputs.as_slice() {
                [_] => format!("{call}.flat()"),
                outputs => {
                    let fields = outputs.iter().map(|output| format!("r.{}.flat()", output.name));
                    let fields = fields.collect::<Vec<_>>().join(", ");
                    format!("{{ let r = {call}; [{fields}].concat() }}")
                }
            };
            writeln!(text, "println!(\"{{:?}}\", {values});").unwrap();
        }
    }
    text.push_str("}\n");
    text
}

/// Compares the printed values with those of the interpreter.
fn hold(programs: &Programs, trigonometry: Trigonometry, printed: &str) {
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let interpreter = interpreter.with_trigonometry(trigonometry);
    let mut lines = printed.lines();
    for function in &programs.module.functions {
        for state in inputs(programs, &function.name) {
            let given: Vec<(&str, &[f64])> =
                state.iter().map(|(name, entries)| (name.as_str(), &entries[..])).collect();
            let outputs = interpreter.call(&function.name, &given).unwrap();
            let expected: Vec<f64> = outputs.into_iter().flat_map(|output| output.values).collect();
            let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            let line = lines.next().unwrap().trim_matches(['[', ']']);
            let found: Vec<f64> = line.split(", ").map(|value| value.parse().unwrap()).collect();
            assert_eq!(found.len(), expected.len(), "{}", function.name);
            for (entry, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let error = (found - expected).abs() / size;
                assert!(error < 1e-11, "{}, entry {entry}: off by {error:e}", function.name);
            }
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn legs_side_by_side_give_the_values_of_legs_apart() {
    let runtime = dependency("robot_runtime", ", features = [\"std\"]");
    let package = Package::new("limbs", &format!("[dependencies]\n{runtime}"));
    let trigonometry = Trigonometry::Polynomial;
    for fused in [false, true] {
        let options = options(fused, trigonometry);
        let programs = programs(&source(), &options).unwrap();
        let code = generate(&source(), &options).unwrap().code;
        assert!(code.contains("LanesOn"), "the legs are apart");
        package.write("src/robot.rs", &code);
        package.write("src/main.rs", &main_text(&programs));
        hold(&programs, trigonometry, &package.run(&["run"]));
    }
}
