//! Compares machine code in memory with the same functions compiled by rustc for this processor, and by cranelift.
//! All are called in turn within one process, and the least time of many short repetitions counts. In all three,
//! the multiply-adds of the sines round once, and all bits must be the same. With `portable`, the sines of machine code are the
//! interpreter's, which take longer.
//!
//! ```text
//! RUSTFLAGS="-C target-cpu=native" cargo run --release -- [ROUNDS] [FUNCTION] [portable]
//! ```

use std::array::from_fn;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use functions::{FUNCTIONS, Function, options};
use robot_codegen::Module;
use robot_jit::{Compiled, Options, Registers};
use robot_symbolic::Random;

/// The number of states of a repetition, which stay in the cache.
const STATES: usize = 64;

/// A column of numbers, aligned like a vector register.
#[repr(align(64))]
struct Column([f64; STATES]);

fn filled(count: usize, random: &mut Random) -> Vec<Column> {
    (0..count).map(|_| Column(from_fn(|_| random.uniform(-3.0, 3.0)))).collect()
}

fn slices(columns: &mut [Column]) -> Vec<&mut [f64]> {
    columns.iter_mut().map(|column| &mut column.0[..]).collect()
}

/// The least time of this number of runs, in nanoseconds.
fn least_of(count: usize, mut run: impl FnMut()) -> f64 {
    let times = (0..count).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_nanos() as f64
    });
    times.fold(f64::INFINITY, f64::min)
}

/// The processor time of this thread, in nanoseconds; 0 if the system does not provide it.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|time| time.parse().ok()).unwrap_or_default()
}

/// The number of runs that take about ten microseconds.
fn repeats(run: impl FnMut()) -> usize {
    (10e3 / least_of(20, run)).ceil() as usize
}

/// The least times of functions that are run in turn, in nanoseconds per state.
fn in_turn<const N: usize>(rounds: usize, mut contenders: [&mut dyn FnMut(); N]) -> [f64; N] {
    let repeats = repeats(&mut contenders[0]);
    let mut least = [f64::INFINITY; N];
    for _ in 0..rounds {
        for (least, run) in least.iter_mut().zip(&mut contenders) {
            run();
            let start = Instant::now();
            (0..repeats).for_each(|_| run());
            let time = start.elapsed().as_nanos() as f64 / (repeats * STATES) as f64;
            *least = least.min(time);
        }
    }
    least
}

/// The number of compilations over which the time to compile is averaged.
const COMPILATIONS: u32 = 50;

/// The number of places in memory in which code is tried: in about 3 % of all places any code is several times
/// slower.
const PLACES: usize = 3;

/// A function for which code is made in memory.
struct Compared<'a> {
    function: &'a Function,
    module: &'a Module,
    options: Options,
}

impl<'a> Compared<'a> {
    fn new(function: &'a Function, module: &'a Module, fused: bool) -> Compared<'a> {
        let functions = Some(vec![function.name.to_owned()]);
        Compared { function, module, options: Options { functions, fused, ..Options::default() } }
    }

    fn compile(&self, registers: Registers) -> Result<Compiled<'a>, robot_jit::Error> {
        let options = Options { registers: Some(registers), ..self.options.clone() };
        robot_jit::compile_with(self.module, &[], &options)
    }

    /// The time to compile, in milliseconds.
    fn compilation(&self, registers: Registers) -> Result<f64, robot_jit::Error> {
        let start = processor_time();
        for _ in 0..COMPILATIONS {
            drop(black_box(self.compile(registers)?));
        }
        Ok((processor_time() - start) / f64::from(COMPILATIONS) / 1e6)
    }

    /// The times of this project's code, rustc's and cranelift's in nanoseconds: per call, and per state in
    /// columns.
    fn times(&self, rounds: usize) -> Result<[[f64; 3]; 2], Box<dyn Error>> {
        let name = self.function.name;
        let best = Registers::detect()?;
        let mut random = Random::new(3);
        let mut least = [[f64::INFINITY; 3]; 2];
        for _ in 0..PLACES {
            let compiled = [self.compile(best)?, self.compile(Registers::Bits128)?];
            let [ours, cranelift] = [compiled[0].function(name)?, compiled[1].function(name)?];
            let inputs = filled(ours.input_size(), &mut random);
            let inputs: Vec<&[f64]> = inputs.iter().map(|column| &column.0[..]).collect();
            let row = |state: usize| inputs.iter().map(|column| column[state]).collect();
            let rows: Vec<Vec<f64>> = (0..STATES).map(row).collect();
            let mut states = [(); 3].map(|()| vec![0.0; ours.output_size()]);
            let mut columns = [(); 3].map(|()| filled(ours.output_size(), &mut random));
            let single = |code: robot_jit::Function<'_>, state: &mut [f64]| {
                for row in &rows {
                    code.entries(black_box(row), black_box(&mut *state)).unwrap_or_default();
                }
            };
            let single_rustc = |state: &mut [f64]| {
                for row in &rows {
                    (self.function.single)(black_box(row), black_box(&mut *state));
                }
            };
            let [a, b, c] = &mut states;
            let calls: [&mut dyn FnMut(); 3] =
                [&mut || single(ours, a), &mut || single_rustc(b), &mut || single(cranelift, c)];
            let calls = in_turn(rounds, calls);
            let [mut a, mut b, mut c] = columns.each_mut().map(|columns| slices(columns));
            let many = |code: robot_jit::Function<'_>, outputs: &mut [&mut [f64]]| {
                code.columns(black_box(&inputs), black_box(outputs)).unwrap_or_default();
            };
            let batches: [&mut dyn FnMut(); 3] = [
                &mut || many(ours, &mut a),
                &mut || (self.function.columns)(black_box(&inputs), black_box(&mut b)),
                &mut || many(cranelift, &mut c),
            ];
            let batches = in_turn(rounds, batches);
            let same = states[0] == states[2] && a == c;
            if !same || self.options.fused && (states[0] != states[1] || a != b) {
                return Err(format!("{} {name}: other bits", self.function.robot).into());
            }
            for (least, time) in
                least.as_flattened_mut().iter_mut().zip([calls, batches].as_flattened())
            {
                *least = least.min(*time);
            }
        }
        Ok(least)
    }
}

/// The ratios of times to those of rustc's code, for calls and for columns, first of this project's code and then
/// of cranelift's.
fn compare(compared: &Compared<'_>, rounds: usize) -> Result<[f64; 4], Box<dyn Error>> {
    let milliseconds =
        [Registers::detect()?, Registers::Bits128].map(|registers| compared.compilation(registers));
    let [ours, cranelift] = milliseconds;
    let [calls, columns] = compared.times(rounds)?;
    let ratios = [calls, columns].map(|[ours, rustc, cranelift]| [ours / rustc, cranelift / rustc]);
    println!(
        "| {} {} | {:.1} | {:.1} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
        compared.function.robot,
        compared.function.name,
        calls[0],
        calls[1],
        ratios[0][0],
        ratios[0][1],
        columns[0],
        columns[1],
        ratios[1][0],
        ratios[1][1],
        ours?,
        cranelift?,
    );
    Ok([ratios[0][0], ratios[1][0], ratios[0][1], ratios[1][1]])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rounds = arguments.next().map_or(Ok(100), |rounds| rounds.parse())?;
    let filter = arguments.next().unwrap_or_default();
    let fused = arguments.next().is_none_or(|word| word != "portable");
    println!(
        "| function | call ns | rustc ns | ratio | cranelift's | column ns | rustc ns | ratio | cranelift's \
         | compiled in ms | by cranelift |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    let mut ratios = [const { vec![] }; 4];
    for robot in options::ROBOTS {
        let (file, options) = options::robot(robot)?;
        let module = robot_build::programs(&file.source, &options)?.module;
        for function in FUNCTIONS.iter().filter(|function| function.robot == robot) {
            if format!("{robot} {}", function.name).contains(&filter) {
                let found = compare(&Compared::new(function, &module, fused), rounds)?;
                for (all, ratio) in ratios.iter_mut().zip(found) {
                    all.push(ratio);
                }
            }
        }
    }
    let names = ["calls", "columns", "cranelift's calls", "cranelift's columns"];
    for (what, ratios) in names.iter().zip(&mut ratios) {
        ratios.sort_by(f64::total_cmp);
        let logarithms: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
        let mean = (logarithms / ratios.len() as f64).exp();
        let worst = ratios.last().copied().unwrap_or_default();
        println!(
            "{what}: geometric mean of {} functions {mean:.3}, worst {worst:.3}",
            ratios.len()
        );
    }
    Ok(())
}
