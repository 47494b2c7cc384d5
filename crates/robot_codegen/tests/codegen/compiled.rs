//! Generated Rust, compiled and run, compared with the interpreter of the same program.

use std::fmt::Write;

use crate::support::{
    self,
    random::{ENTRIES, real},
};
use robot_codegen::backend::rust::{LANGUAGE, RustOptions, Wrapping, generate};
use robot_codegen::program::{Limits, Statements};
use robot_codegen::spec::{Function, ModuleSpec, ParameterSpec};
use robot_codegen::{Fused, Interpreter, Module, Options, Scalar, Trigonometry};
use robot_symbolic::{Graph, Random};

const STATES: usize = 20;

/// The text of a `main` that prints the bits of `f` at the states.
fn main_text(states: &[[f64; 2 * ENTRIES]]) -> String {
    main_text_of("f", states)
}

/// The text of a `main` that prints the bits of a method at the states.
fn main_text_of(method: &str, states: &[[f64; 2 * ENTRIES]]) -> String {
    let mut text = String::from("fn main() {\n");
    for state in states {
        let (q, v) = state.split_at(ENTRIES);
        writeln!(
            text,
            "for y in random::Model::new(&random::Parameters::NOMINAL).{method}(&{q:?}.map(|x: f64| x), &{v:?}) {{ println!(\"{{}}\", y.to_bits()); }}"
        )
        .unwrap();
    }
    text.push_str("}\n");
    text
}

fn states(random: &mut Random) -> Vec<[f64; 2 * ENTRIES]> {
    (0..STATES).map(|_| std::array::from_fn(|_| real(random))).collect()
}

/// Compares the bits that a program printed with the results of the interpreter, and returns these.
#[track_caller]
fn hold(label: &str, module: &Module, states: &[[f64; 2 * ENTRIES]], printed: &str) -> Vec<f64> {
    hold_with(Trigonometry::default(), label, module, states, printed)
}

#[track_caller]
fn hold_with(
    trigonometry: Trigonometry,
    label: &str,
    module: &Module,
    states: &[[f64; 2 * ENTRIES]],
    printed: &str,
) -> Vec<f64> {
    let bits: Vec<u64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    let mut found = bits.into_iter().map(f64::from_bits);
    let interpreter = Interpreter::new(module, &[]).unwrap().with_trigonometry(trigonometry);
    let mut all = vec![];
    for (index, state) in states.iter().enumerate() {
        let (q, v) = state.split_at(ENTRIES);
        let outputs = interpreter.call("f", &[("q", q), ("v", v)]).unwrap();
        let name = &outputs[0].name;
        for (entry, expected) in outputs[0].values.iter().enumerate() {
            let found = found.next().unwrap();
            assert!(
                found.to_bits() == expected.to_bits(),
                "{label}, state {index}: {name}[{entry}] is {found:e}, of the interpreter {expected:e}"
            );
            all.push(*expected);
        }
    }
    assert_eq!(found.next(), None, "{label}: more values than outputs");
    all
}

#[test]
fn compiled_code_gives_the_bits_of_the_interpreter() {
    let sources = [Trigonometry::Polynomial, Trigonometry::Standard];
    for (seed, trigonometry) in (0..4).zip(sources.into_iter().cycle()) {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let spec = support::random::module(&graph, &mut random, 400);
        let module = Module::compile(&spec, &Options::default()).unwrap();
        let states = states(&mut random);
        let options = RustOptions { trigonometry, ..RustOptions::default() };
        let code = generate(&module, &options).unwrap().to_text();
        let text = format!("#![deny(warnings)]\n{code}\n{}", main_text(&states));
        let printed = support::rustc::output_of(&format!("bits-{seed}"), &text, &["-O"]);
        let label = format!("seed {seed}");
        let values = hold_with(trigonometry, &label, &module, &states, &printed);
        assert!(values.iter().all(|value| value.is_finite()));
    }
}

#[test]
fn a_program_of_twenty_thousand_statements_compiles_in_the_dev_profile() {
    let mut random = Random::new(7);
    let graph = Graph::new();
    let spec = support::random::module(&graph, &mut random, 30_000);
    let module = Module::compile(&spec, &Options::default()).unwrap();
    // Each operation has a name, which gives the most statements that the program can have.
    let limits = Limits { expression: 1, ..LANGUAGE.limits };
    assert!(Statements::new(&module.functions[0].core, &limits).count() > 20_000);
    let states = states(&mut random);
    let options = RustOptions { limits, ..RustOptions::default() };
    let code = generate(&module, &options).unwrap().to_text();
    let text = format!("#![deny(warnings)]\n{code}\n{}", main_text(&states[..1]));
    let start = std::time::Instant::now();
    let printed = support::rustc::output_of("long", &text, &["-C", "debuginfo=2"]);
    println!("{:?} for {} lines", start.elapsed(), code.lines().count());
    hold("long", &module, &states[..1], &printed);
}

#[test]
fn nothing_generated_is_unused() {
    let graph = Graph::new();
    let spec = support::arm::planar_arm(&graph);
    let module = Module::compile(&spec, &Options::default()).unwrap();
    for generic in [false, true] {
        let options = RustOptions {
            wrapping: Wrapping::Items,
            generic,
            batch: generic.then_some(8),
            ..RustOptions::default()
        };
        let code = generate(&module, &options).unwrap().to_text();
        let text =
            format!("//! Code.\n#![deny(warnings, unused, missing_docs)]\n#![no_std]\n{code}");
        support::rustc::compile(&format!("unused-{generic}"), &text, &["--crate-type", "lib"]);
    }
}

/// If the target does not have the feature `fma`, a multiply-add is a product and a sum, as in the interpreter. Code
/// that is dispatched by the processor rounds once if the processor has the instruction.
#[test]
fn fused_code_gives_the_bits_of_the_interpreter() {
    let mut random = Random::new(11);
    let graph = Graph::new();
    let spec = support::random::module(&graph, &mut random, 300);
    let options = Options { fused: Fused::WhereTarget, ..Options::default() };
    let module = Module::compile(&spec, &options).unwrap();
    assert!(module.counts(&module.functions[0]).call.fused > 10);
    let states = states(&mut random);
    let options = RustOptions { generic: true, ..RustOptions::default() };
    let code = generate(&module, &options).unwrap().to_text();
    assert!(code.contains("A::mul_add(") && code.contains("Scalar::mul_add("));
    let text =
        |method: &str| format!("#![deny(warnings)]\n{code}\n{}", main_text_of(method, &states));
    let printed = support::rustc::output_of("fused", &text("f_generic"), &["-O"]);
    let expected = hold("fused", &module, &states, &printed);

    let printed = support::rustc::output_of("fused-dispatched", &text("f"), &["-O"]);
    let found = printed.lines().map(|line| f64::from_bits(line.parse().unwrap()));
    let found: Vec<f64> = found.collect();
    assert_eq!(found.len(), expected.len());
    let mut differ = 0;
    for (found, expected) in found.iter().zip(&expected) {
        let scale = expected.abs().max(1.0);
        assert!((found - expected).abs() < 1e-9 * scale, "{found:e}, not {expected:e}");
        differ += usize::from(found.to_bits() != expected.to_bits());
    }
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        assert!(differ > 0, "no multiply-add rounded once");
    }
}

#[test]
fn single_precision_is_near_to_double() {
    let graph = Graph::new();
    let module = Module::compile(&support::arm::planar_arm(&graph), &Options::default()).unwrap();
    let options = RustOptions { scalar: Scalar::F32, ..RustOptions::default() };
    let code = generate(&module, &options).unwrap().to_text();
    let inputs = [[0.3, -0.7], [0.5, 1.25], [-1.5, 2.0]];
    let [q, qd, qdd] = inputs;
    let text = format!(
        "#![deny(warnings)]\n{code}\nfn main() {{\n\
         let tau: [f32; 2] = planar_arm::Model::NOMINAL.inverse_dynamics(&{q:?}, &{qd:?}, &{qdd:?});\n\
         for tau in tau {{ println!(\"{{tau:?}}\"); }}\n}}\n"
    );
    let printed = support::rustc::output_of("single", &text, &["-O"]);
    let found: Vec<f64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let given: [(&str, &[f64]); 3] = [("q", &q), ("qd", &qd), ("qdd", &qdd)];
    let expected = interpreter.call("inverse_dynamics", &given).unwrap()[0].values.clone();
    assert_eq!(found.len(), expected.len());
    for (entry, (found, expected)) in found.iter().zip(&expected).enumerate() {
        // A few rounding errors of single precision, of terms of a few tens.
        assert!((found - expected).abs() < 1e-5 * 40.0, "tau[{entry}] is {found}, not {expected}");
        assert_ne!(found, expected);
    }
}

#[test]
fn a_module_without_parameters_has_functions_of_its_own() {
    let graph = Graph::new();
    let (q1, q2) = (graph.symbol("q1"), graph.symbol("q2"));
    let values = vec![q1.sin() * 3 + q2, (q1 + q2).cos() * q2];
    let spec = ModuleSpec {
        name: "plain".into(),
        doc: vec![],
        parameters: vec![],
        functions: vec![Function {
            name: "f".into(),
            doc: vec![],
            inputs: vec![support::arm::joints("q", "rad")],
            outputs: vec![support::arm::vector("y", "", values)],
        }],
    };
    let module = Module::compile(&spec, &Options::default()).unwrap();
    let code = generate(&module, &RustOptions::default()).unwrap().to_text();
    let main = "fn main() { let q = [0.4, -1.1]; assert_eq!(plain::f(&q), plain::Model.f(&q)); \
        for y in plain::f(&q) { println!(\"{}\", y.to_bits()); } }";
    let text = format!("#![deny(warnings)]\n{code}\n{main}\n");
    let printed = support::rustc::output_of("plain", &text, &["-O"]);
    let bits: Vec<u64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let expected = interpreter.call("f", &[("q", &[0.4, -1.1])]).unwrap()[0].values.clone();
    assert_eq!(bits, expected.into_iter().map(f64::to_bits).collect::<Vec<_>>());
}

/// The sine of a parameter, computed once, has the same source as the sine of an input; checked at angles at which the
/// two sources differ.
#[test]
fn sines_of_the_constructor_come_from_where_those_of_calls_come_from() {
    let graph = Graph::new();
    let module = tilted(&graph);
    let mut differing = 0;
    for n in 1..2000 {
        let angle = f64::from(n) * 0.1;
        for trigonometry in [Trigonometry::Polynomial, Trigonometry::Standard] {
            let interpreter = Interpreter::new(&module, &[("p", angle)]).unwrap();
            let interpreter = interpreter.with_trigonometry(trigonometry);
            let stored = interpreter.call("f", &[("q", &[1.0, 0.0])]).unwrap()[0].values[0];
            let called = interpreter.call("f", &[("q", &[angle, 0.0])]).unwrap()[0].values[1];
            assert_eq!(stored.to_bits(), called.to_bits(), "{trigonometry:?} at {angle}");
            let is_the_library = stored.to_bits() == angle.sin().to_bits();
            match trigonometry {
                Trigonometry::Standard => assert!(is_the_library),
                Trigonometry::Polynomial => differing += usize::from(!is_the_library),
            }
        }
    }
    assert!(differing > 0);
}

/// In both number types and with both sources of sines, including the sine of the parameter.
#[test]
fn each_lane_has_the_bits_of_a_call_with_its_parameters() {
    let graph = Graph::new();
    let module = tilted(&graph);
    let mut text = "#![deny(warnings)]\nuse robot_runtime::Lanes;\n".to_owned();
    let mut calls = String::new();
    for scalar in [Scalar::F64, Scalar::F32] {
        for trigonometry in [Trigonometry::Polynomial, Trigonometry::Standard] {
            let options =
                RustOptions { generic: true, scalar, trigonometry, ..RustOptions::default() };
            let name = format!("{scalar:?}_{trigonometry:?}").to_lowercase();
            let code = generate(&module, &options).unwrap().to_text();
            writeln!(text, "mod {name} {{ {code} }}").unwrap();
            writeln!(
                calls,
                "{{ use {name}::tilted::{{Model, Parameters}};\n\
                 let parameters = [0.1, -0.7, 1.9].map(|p| Parameters {{ p }});\n\
                 let model = Model::new_lanes(&parameters);\n\
                 let q = [Lanes::from([0.3, 0.4, -2.5]), Lanes::splat(0.0)];\n\
                 let y = model.f_generic(&q).map(Lanes::to_array);\n\
                 let of_one = Model::new(&parameters[1]).f_generic(&q);\n\
                 for lane in 0..3 {{\n    \
                   let single = Model::new(&parameters[lane]);\n    \
                   let q = q.map(|q| q.to_array()[lane]);\n    \
                   assert_eq!(y.map(|y| y[lane]), single.f(&q));\n    \
                   assert_eq!(of_one.map(|y| y.to_array()[lane]), Model::new(&parameters[1]).f(&q));\n\
                 }} }}"
            )
            .unwrap();
        }
    }
    writeln!(text, "fn main() {{\n{calls}}}").unwrap();
    support::rustc::output_of("lanes-of-models", &text, &["-O"]);
}

/// A module with the sine of a parameter times an input, and the sine of this input.
fn tilted(graph: &Graph) -> Module {
    let (p, q1) = (graph.symbol("p"), graph.symbol("q1"));
    let tilt =
        ParameterSpec { name: "p".into(), doc: String::new(), unit: "rad".into(), nominal: None };
    let spec = ModuleSpec {
        name: "tilted".into(),
        doc: vec![],
        parameters: vec![tilt],
        functions: vec![Function {
            name: "f".into(),
            doc: vec![],
            inputs: vec![support::arm::joints("q", "rad")],
            outputs: vec![support::arm::vector("y", "", vec![q1 * p.sin(), q1.sin()])],
        }],
    };
    Module::compile(&spec, &Options::default()).unwrap()
}
