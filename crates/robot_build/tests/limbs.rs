//! Limbs that are alike, which are computed in lanes.
#![allow(clippy::unwrap_used, reason = "a test that fails panics")]

use robot_build::{
    Functions, Limbs, Options, Source, Trigonometry, functions_named, programs, read,
};
use robot_codegen::interpreter::evaluate;
use robot_codegen::module::Function;
use robot_codegen::program::Source as Load;

const QUADRUPED: &str = include_str!("../../../tests/fixtures/limbs/quadruped.toml");

fn source(text: &str) -> Source {
    Source { name: "quadruped.toml".to_owned(), text: text.to_owned() }
}

fn functions(source: &Source) -> Functions {
    let names = ["inverse_dynamics", "gravity", "mass_matrix", "forward_dynamics"];
    functions_named(&names.map(str::to_owned), &read(source).unwrap().robot).unwrap()
}

/// Computes the results of a function from its inputs and fields.
fn results(function: &Function, inputs: &[f64], fields: &[f64]) -> Vec<f64> {
    let load = |source: Load| match source {
        Load::Input(index) => inputs[index as usize],
        Load::Field(index) => fields[index as usize],
        _ => f64::NAN,
    };
    let angles = evaluate(&function.angles, Trigonometry::Polynomial, load);
    evaluate(&function.core, Trigonometry::Polynomial, |source| match source {
        Load::Sin(index) => angles[index as usize].sin(),
        Load::Cos(index) => angles[index as usize].cos(),
        _ => load(source),
    })
}

/// Computes the results limb by limb, lane by lane.
fn by_limbs(function: &Function, inputs: &[f64]) -> Vec<f64> {
    let limbs = function.limbs.as_ref().unwrap();
    let of_call = limbs.calls.iter().map(|call| {
        let lanes = call.inputs.iter().enumerate().map(|(lane, entries)| {
            let own: Vec<f64> = entries.iter().map(|entry| inputs[*entry]).collect();
            let fields: Vec<f64> = call.fields.iter().map(|numbers| numbers[lane]).collect();
            results(&call.function, &own, &fields)
        });
        lanes.collect::<Vec<_>>()
    });
    let of_call: Vec<_> = of_call.collect();
    let places = limbs.results.iter();
    places.map(|place| place.map_or(0.0, |at| of_call[at.call][at.lane][at.result])).collect()
}

#[test]
fn limbs_compute_what_the_whole_computes() {
    let source = source(QUADRUPED);
    let options = Options { functions: functions(&source), ..Options::default() };
    let module = programs(&source, &options).unwrap().module;
    for function in &module.functions {
        let count: usize = function.inputs.iter().map(|input| input.symbols.len()).sum();
        let inputs: Vec<f64> = (0..count).map(|n| (n as f64 * 0.77 + 0.3).sin()).collect();
        let expected = results(function, &inputs, &[]);
        let found = by_limbs(function, &inputs);
        let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
        assert_eq!(function.limbs.as_ref().unwrap().calls.len(), 1);
        for (found, expected) in found.iter().zip(&expected) {
            let error = (found - expected).abs() / size;
            assert!(error < 1e-13, "{}: {found} {expected}", function.name);
        }
    }
}

#[test]
fn limbs_that_are_not_alike_stay_apart() {
    let other_axis = QUADRUPED.replacen("axis = \"y\"", "axis = \"z\"", 1);
    let calls = |text: &str, limbs: Limbs| {
        let source = source(text);
        let options = Options { functions: functions(&source), limbs, ..Options::default() };
        let module = programs(&source, &options).unwrap().module;
        module.functions[0].limbs.as_ref().map(|limbs| limbs.calls.len())
    };
    assert_eq!(calls(QUADRUPED, Limbs::SideBySide), Some(1));
    assert_eq!(calls(QUADRUPED, Limbs::Apart), None);
    // Three limbs that are alike, and one of another.
    assert_eq!(calls(&other_axis, Limbs::SideBySide), Some(2));
}
