//! Measures the time to compile functions of the UR5 and the Panda, and the time of their calls as machine code and in
//! the interpreter. All are timed in turn in one run; the least time of many short batches counts.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use robot_build::{Functions, Options, Source};
use robot_codegen::{Interpreter, Module};
use robot_jit::Registers;
use robot_symbolic::Random;

const FUNCTIONS: [&str; 5] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
];
/// The states of a batch; all of one function stay in the cache.
const STATES: usize = 256;
const ROUNDS: usize = 400;

/// The least time of many, in nanoseconds.
struct Least(f64);

impl Least {
    fn time(&mut self, run: impl FnOnce()) {
        let start = Instant::now();
        run();
        self.0 = self.0.min(start.elapsed().as_nanos() as f64);
    }
}

type Problem = Box<dyn std::error::Error>;

fn main() -> Result<(), Problem> {
    println!(
        "| robot, function | registers | compile ms | code of | single ns | interpreter | lanes ns | interpreter |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for robot in ["ur5", "panda"] {
        let name = format!("{robot}.toml");
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(&name);
        let source = Source { name, text: std::fs::read_to_string(path)? };
        let options = Options { functions: Functions::All, ..Options::default() };
        let programs = robot_build::programs(&source, &options)?;
        for registers in [Registers::Avx2, Registers::Avx512] {
            if registers.check().is_ok() {
                for function in FUNCTIONS {
                    measure(robot, &programs.module, function, registers)?;
                }
            }
        }
    }
    Ok(())
}

fn measure(
    robot: &str,
    module: &Module,
    function: &str,
    registers: Registers,
) -> Result<(), Problem> {
    let options = robot_jit::Options {
        registers: Some(registers),
        functions: Some(vec![function.to_owned()]),
        ..robot_jit::Options::default()
    };
    let mut compile = Least(f64::INFINITY);
    for _ in 0..20 {
        compile.time(|| drop(black_box(robot_jit::compile_with(module, &[], &options))));
    }
    let compiled = robot_jit::compile_with(module, &[], &options)?;
    let interpreter = Interpreter::new(module, &[])?;
    let (jit, interpreted) = (compiled.function(function)?, interpreter.function(function)?);

    let mut random = Random::new(3);
    let mut numbers =
        |count: usize| -> Vec<f64> { (0..count).map(|_| random.uniform(-3.0, 3.0)).collect() };
    let columns: Vec<Vec<f64>> = (0..jit.input_size()).map(|_| numbers(STATES)).collect();
    let rows: Vec<Vec<f64>> = (0..STATES).map(|_| numbers(jit.input_size())).collect();
    let inputs: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut outputs = vec![vec![0.0; STATES]; jit.output_size()];
    let mut outputs: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    let mut row = vec![0.0; jit.output_size()];
    let names: Vec<(&str, usize)> =
        jit.inputs().iter().map(|input| (input.name.as_str(), input.symbols.len())).collect();

    let mut least = [(); 4].map(|()| Least(f64::INFINITY));
    let [single, single_interpreted, lanes, lanes_interpreted] = &mut least;
    for round in 0..ROUNDS {
        single.time(|| {
            rows.iter().for_each(|inputs| {
                black_box(jit.entries(black_box(inputs), &mut row)).unwrap_or_default();
            });
        });
        lanes.time(|| black_box(jit.columns(&inputs, &mut outputs)).unwrap_or_default());
        if round % 8 == 0 {
            lanes_interpreted
                .time(|| black_box(interpreted.columns(&inputs, &mut outputs)).unwrap_or_default());
            single_interpreted.time(|| {
                rows.iter().for_each(|inputs| {
                    let mut rest = inputs.as_slice();
                    let named: Vec<(&str, &[f64])> = names
                        .iter()
                        .map(|(name, length)| {
                            let (entries, after) = rest.split_at(*length);
                            rest = after;
                            (*name, entries)
                        })
                        .collect();
                    drop(black_box(interpreted.call(&named)));
                });
            });
        }
    }
    let [single, single_interpreted, lanes, lanes_interpreted] =
        least.map(|least| least.0 / STATES as f64);
    println!(
        "| {robot} {function} | {registers:?} | {:.3} | {} bytes | {single:.1} | {single_interpreted:.0} | {lanes:.2} | {lanes_interpreted:.0} |",
        compile.0 / 1e6,
        compiled.code_size(),
    );
    Ok(())
}
