//! Generated Rust, compiled and run, against the interpreter of the same program.

use std::fmt::Write;

use crate::support::{
    self,
    random::{ENTRIES, Random},
};
use robot_codegen::backend::rust::{RustOptions, Wrapping, generate};
use robot_codegen::program::{Layout, Limits};
use robot_codegen::{Interpreter, Module, Options};
use robot_symbolic::Graph;

const STATES: usize = 20;

/// The text of a `main` that prints the bits of `f` at the states.
fn main_text(states: &[[f64; 2 * ENTRIES]]) -> String {
    let mut text = String::from("fn main() {\n");
    for state in states {
        let (q, v) = state.split_at(ENTRIES);
        writeln!(
            text,
            "for y in random::Model::new(&random::Parameters::NOMINAL).f(&{q:?}, &{v:?}) {{ println!(\"{{}}\", y.to_bits()); }}"
        )
        .unwrap();
    }
    text.push_str("}\n");
    text
}

fn states(random: &mut Random) -> Vec<[f64; 2 * ENTRIES]> {
    (0..STATES).map(|_| std::array::from_fn(|_| random.real())).collect()
}

/// The bits that the interpreter gives.
fn interpreted(module: &Module, states: &[[f64; 2 * ENTRIES]]) -> Vec<u64> {
    let interpreter = Interpreter::new(module, &[]).unwrap();
    let values = states.iter().flat_map(|state| {
        let (q, v) = state.split_at(ENTRIES);
        let outputs = interpreter.call("f", &[("q", q), ("v", v)]).unwrap();
        outputs[0].values.clone()
    });
    values.map(f64::to_bits).collect()
}

#[test]
fn compiled_code_gives_the_bits_of_the_interpreter() {
    for seed in 0..4 {
        let mut random = Random(seed);
        let graph = Graph::new();
        let spec = support::random::module(&graph, &mut random, 400);
        let module = Module::compile(&spec, &Options::default()).unwrap();
        let states = states(&mut random);
        let code = generate(&module, &RustOptions::default()).unwrap().to_text();
        let text = format!("#![deny(warnings)]\n{code}\n{}", main_text(&states));
        let printed = support::rustc::output_of(&format!("bits-{seed}"), &text, &["-O"]);
        let bits: Vec<u64> = printed.lines().map(|line| line.parse().unwrap()).collect();
        let expected = interpreted(&module, &states);
        assert_eq!(bits.len(), expected.len());
        let wrong = bits.iter().zip(&expected).position(|(a, b)| a != b);
        assert_eq!(
            wrong,
            None,
            "seed {seed}: {:?}",
            wrong.map(|at| { (f64::from_bits(bits[at]), f64::from_bits(expected[at])) })
        );
        assert!(expected.iter().all(|bits| f64::from_bits(*bits).is_finite()));
    }
}

#[test]
fn a_program_of_twenty_thousand_statements_compiles_in_the_dev_profile() {
    let mut random = Random(7);
    let graph = Graph::new();
    let spec = support::random::module(&graph, &mut random, 30_000);
    let module = Module::compile(&spec, &Options::default()).unwrap();
    // A name for each operation: the most statements that the program can have.
    let limits = Limits { expression: 1, ..Limits::default() };
    assert!(Layout::new(&module.functions[0].core, &limits).statements() > 20_000);
    let states = states(&mut random);
    let options = RustOptions { limits, ..RustOptions::default() };
    let code = generate(&module, &options).unwrap().to_text();
    let text = format!("#![deny(warnings)]\n{code}\n{}", main_text(&states[..1]));
    let start = std::time::Instant::now();
    let printed = support::rustc::output_of("long", &text, &["-C", "debuginfo=2"]);
    println!("{:?} for {} lines", start.elapsed(), code.lines().count());
    let bits: Vec<u64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(bits, interpreted(&module, &states[..1]));
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
