//! Every error of the crate, caused through its public interface.

use robot_codegen::backend::rust::{RustOptions, generate};
use robot_codegen::spec::*;
use robot_codegen::{Error, Errors, Interpreter, Module, Options, Scalar};
use robot_symbolic::{Expr, Graph};

use crate::support::arm::{joints, vector};

/// A module with one parameter `p` and one function `f` of `q1`, `q2`.
fn module<'g>(value: Expr<'g>) -> ModuleSpec<'g> {
    let parameter =
        ParameterSpec { name: "p".into(), doc: String::new(), unit: String::new(), nominal: None };
    let function = Function {
        name: "f".into(),
        doc: vec![],
        inputs: vec![joints("q", "rad")],
        outputs: vec![vector("y", "", vec![value])],
    };
    ModuleSpec {
        name: "m".into(),
        doc: vec![],
        parameters: vec![parameter],
        functions: vec![function],
    }
}

fn compiled(spec: &ModuleSpec<'_>) -> Result<Module, Errors> {
    Module::compile(spec, &Options::default())
}

/// Returns the single error of a result; checks that its text contains each of `parts`.
fn one<T: std::fmt::Debug>(result: Result<T, Errors>, parts: &[&str]) -> Error {
    let errors = result.unwrap_err();
    let [error] = errors.as_slice() else { panic!("{errors}") };
    for part in parts {
        assert!(error.to_string().contains(part), "{part} is not in: {error}");
    }
    error.clone()
}

#[test]
fn of_specifications() {
    let graph = Graph::new();
    let value = graph.symbol("q1") * graph.symbol("p");
    assert!(compiled(&module(value)).is_ok());

    let found = one(compiled(&module(value + graph.symbol("z"))), &["`z`", "`y`", "`f`"]);
    assert!(matches!(found, Error::UnknownSymbol { .. }));

    let mut spec = module(value);
    spec.functions.push(spec.functions[0].clone());
    let found = one(compiled(&spec), &["function `f`", "twice"]);
    assert!(matches!(found, Error::Duplicate { .. }));

    let mut spec = module(value);
    spec.functions[0].outputs[0].shape = vec![2, 2];
    let found = one(compiled(&spec), &["[2, 2]", "1 values"]);
    assert!(matches!(found, Error::Shape { .. }));

    let mut spec = module(value);
    spec.functions[0].outputs.clear();
    assert!(matches!(one(compiled(&spec), &["`f`"]), Error::NoOutputs { .. }));

    let (other, mut spec) = (Graph::new(), module(value));
    spec.functions[0].outputs.push(vector("far", "", vec![other.symbol("q1")]));
    let found = one(compiled(&spec), &["`far`", "a different graph"]);
    assert!(matches!(found, Error::ForeignGraph { .. }));

    let undefined = value / (graph.symbol("q1") - graph.symbol("q1"));
    let found = one(compiled(&module(undefined)), &["`y`", "finite"]);
    assert!(matches!(found, Error::NotFinite { .. }));

    let mut spec = module(value);
    spec.parameters[0].nominal = Some(f64::INFINITY);
    assert!(matches!(one(compiled(&spec), &["`p`"]), Error::NominalNotFinite { .. }));
}

#[test]
fn of_calls() {
    let graph = Graph::new();
    let module = compiled(&module(graph.symbol("q1") * graph.symbol("p"))).unwrap();
    let missing = Interpreter::new(&module, &[]).map(|_| ());
    assert!(matches!(one(missing, &["`p`"]), Error::MissingParameter { .. }));
    let unknown = Interpreter::new(&module, &[("p", 1.0), ("r", 1.0)]).map(|_| ());
    assert!(matches!(one(unknown, &["`r`", "`p`"]), Error::UnknownParameter { .. }));

    let interpreter = Interpreter::new(&module, &[("p", 1.0)]).unwrap();
    let q: (&str, &[f64]) = ("q", &[1.0, 2.0]);
    assert_eq!(interpreter.call("f", &[q]).unwrap()[0].values, [1.0]);
    let found = one(interpreter.call("g", &[q]), &["`g`", "`f`"]);
    assert!(matches!(found, Error::UnknownFunction { .. }));
    let found = one(interpreter.call("f", &[]), &["`q`", "2"]);
    assert!(matches!(found, Error::MissingInput { .. }));
    let found = one(interpreter.call("f", &[q, ("v", &[])]), &["`v`", "`q`"]);
    assert!(matches!(found, Error::UnknownInput { .. }));
    for (entries, message) in
        [(&[1.0][..], "2 entries, not 1"), (&[1.0, 2.0, 3.0], "2 entries, not 3"), (&[], "not 0")]
    {
        let found = one(interpreter.call("f", &[("q", entries)]), &["`q`", message]);
        assert!(matches!(found, Error::InputLength { .. }));
    }
}

#[test]
fn of_generation() {
    let graph = Graph::new();
    let large = graph.integer(10).powi(40) * graph.symbol("q1");
    let module = compiled(&module(large)).unwrap();
    let generated = |options: RustOptions| generate(&module, &options).map(|_| ());
    generated(RustOptions::default()).unwrap();
    let options = RustOptions { runtime: "not a path".into(), ..RustOptions::default() };
    assert!(matches!(one(generated(options), &["not a path"]), Error::RuntimePath { .. }));
    let options = RustOptions { scalar: Scalar::F32, ..RustOptions::default() };
    let found = one(generated(options), &["1e40", "`f`", "f64"]);
    assert!(matches!(found, Error::BeyondSinglePrecision { .. }));
}

#[test]
fn constants_that_single_precision_rounds_to_nothing_are_refused() {
    let generated = |power: i32, scalar| {
        let graph = Graph::new();
        let module = compiled(&module(graph.integer(10).powi(power) * graph.symbol("q1"))).unwrap();
        generate(&module, &RustOptions { scalar, ..RustOptions::default() }).map(|_| ())
    };
    // Rounds to 0 in single precision, or to a number of few digits.
    for power in [-50, -40] {
        let found =
            one(generated(power, Scalar::F32), &[&format!("1e{power}"), "function `f`", "f64"]);
        assert!(matches!(found, Error::BelowSinglePrecision { .. }));
        generated(power, Scalar::F64).unwrap();
    }
    generated(-37, Scalar::F32).unwrap();
    generated(38, Scalar::F32).unwrap();
}
