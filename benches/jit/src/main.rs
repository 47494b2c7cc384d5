//! Machine code in memory beside the same functions compiled by rustc for this processor: calls in turn within one
//! process, the least of many short batches. The sines of both round once, and all bits must be the same; with
//! `portable` those of machine code are the interpreter's, which take longer.
//!
//! ```text
//! RUSTFLAGS="-C target-cpu=native" cargo run --release -- [ROUNDS] [FUNCTION] [portable]
//! ```

use std::array::from_fn;
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use functions::{FUNCTIONS, Function, options};
use robot_symbolic::Random;

/// The states of a batch, which stay in the cache.
const STATES: usize = 64;

/// The numbers of one batch, aligned as a vector register is.
#[repr(align(64))]
struct Column([f64; STATES]);

fn filled(count: usize, random: &mut Random) -> Vec<Column> {
    (0..count).map(|_| Column(from_fn(|_| random.uniform(-3.0, 3.0)))).collect()
}

fn slices(columns: &mut [Column]) -> Vec<&mut [f64]> {
    columns.iter_mut().map(|column| &mut column.0[..]).collect()
}

/// The least time of so many runs, in nanoseconds.
fn least_of(count: usize, mut run: impl FnMut()) -> f64 {
    let times = (0..count).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed().as_nanos() as f64
    });
    times.fold(f64::INFINITY, f64::min)
}

/// What this thread has had of a processor, in nanoseconds, and not what others had between. 0 if the system does not say.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|time| time.parse().ok()).unwrap_or_default()
}

/// How often a batch is run to take some ten microseconds.
fn repeats(run: impl FnMut()) -> usize {
    (10e3 / least_of(20, run)).ceil() as usize
}

/// The least times of two that are run in turn, in nanoseconds a state.
fn in_turn(rounds: usize, mut one: impl FnMut(), mut other: impl FnMut()) -> [f64; 2] {
    let repeats = repeats(&mut one);
    let mut least = [f64::INFINITY; 2];
    let mut time = |which: usize, run: &mut dyn FnMut()| {
        run();
        let start = Instant::now();
        (0..repeats).for_each(|_| run());
        let time = start.elapsed().as_nanos() as f64 / (repeats * STATES) as f64;
        least[which] = least[which].min(time);
    };
    for _ in 0..rounds {
        time(0, &mut one);
        time(1, &mut other);
    }
    least
}

/// Over so many the time to compile is averaged.
const COMPILATIONS: u32 = 50;

/// How often code is placed in memory: in some 3 % of the places it is slower by a factor, whoever made it.
const PLACES: usize = 3;

/// The ratios of single calls and of columns.
fn compare(
    function: &Function,
    module: &robot_codegen::Module,
    (rounds, fused): (usize, bool),
) -> Result<[f64; 2], Box<dyn Error>> {
    let options = robot_jit::Options {
        functions: Some(vec![function.name.to_owned()]),
        fused,
        ..robot_jit::Options::default()
    };
    let start = processor_time();
    for _ in 0..COMPILATIONS {
        drop(black_box(robot_jit::compile_with(module, &[], &options)?));
    }
    let compile = (processor_time() - start) / f64::from(COMPILATIONS);
    let places: Result<Vec<_>, _> =
        (0..PLACES).map(|_| robot_jit::compile_with(module, &[], &options)).collect();
    let places = places?;
    let jits: Result<Vec<_>, _> =
        places.iter().map(|place| place.function(function.name)).collect();
    let jits = jits?;
    let (taken, given) = (jits[0].input_size(), jits[0].output_size());
    let mut random = Random::new(3);
    let inputs = filled(taken, &mut random);
    let inputs: Vec<&[f64]> = inputs.iter().map(|column| &column.0[..]).collect();
    let rows: Vec<Vec<f64>> =
        (0..STATES).map(|state| inputs.iter().map(|column| column[state]).collect()).collect();
    let mut states = [(); 2].map(|()| vec![0.0; given]);
    let mut columns = [(); 2].map(|()| filled(given, &mut random));
    let [a, b] = &mut states;
    let [mut c, mut d] = columns.each_mut().map(|columns| slices(columns));
    let mut least = [[f64::INFINITY; 2]; 2];
    for jit in &jits {
        let calls = in_turn(
            rounds,
            || {
                let call = |row| jit.entries(black_box(row), black_box(a)).unwrap_or_default();
                rows.iter().map(Vec::as_slice).for_each(call);
            },
            || rows.iter().for_each(|row| (function.single)(black_box(row), black_box(b))),
        );
        let batches = in_turn(
            rounds,
            || jit.columns(black_box(&inputs), black_box(&mut c)).unwrap_or_default(),
            || (function.columns)(black_box(&inputs), black_box(&mut d)),
        );
        for (least, times) in least.iter_mut().zip([calls, batches]) {
            *least = [least[0].min(times[0]), least[1].min(times[1])];
        }
    }
    if fused && (states[0] != states[1] || c != d) {
        return Err(format!("{} {}: other bits", function.robot, function.name).into());
    }
    let [[ours, theirs], [ours_columns, theirs_columns]] = least;
    let ratios = least.map(|[ours, theirs]| ours / theirs);
    println!(
        "| {} {} | {ours:.1} | {theirs:.1} | {:.2} | {ours_columns:.2} | {theirs_columns:.2} | {:.2} | {:.2} |",
        function.robot,
        function.name,
        ratios[0],
        ratios[1],
        compile / 1e6,
    );
    Ok(ratios)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rounds = arguments.next().map_or(Ok(100), |rounds| rounds.parse())?;
    let filter = arguments.next().unwrap_or_default();
    let fused = arguments.next().is_none_or(|word| word != "portable");
    println!(
        "| function | code in memory ns | rustc ns | ratio | columns | rustc | ratio | compiled in ms |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let mut ratios = [vec![], vec![]];
    for robot in options::ROBOTS {
        let (file, options) = options::robot(robot)?;
        let module = robot_build::programs(&file.source, &options)?.module;
        for function in FUNCTIONS.iter().filter(|function| function.robot == robot) {
            if format!("{robot} {}", function.name).contains(&filter) {
                let found = compare(function, &module, (rounds, fused))?;
                for (all, ratio) in ratios.iter_mut().zip(found) {
                    all.push(ratio);
                }
            }
        }
    }
    for (what, ratios) in ["calls", "columns"].iter().zip(&mut ratios) {
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
