//! Measures the time from a robot file's text to Rust code and to equations.
//!
//! `cargo bench -p robots --bench generation` measures the generator with optimization. Build scripts and macros
//! run without optimization unless the user's manifest changes this; to measure that, run
//!
//! ```text
//! CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo bench -p robots --bench generation --profile dev
//! ```
#![allow(clippy::unwrap_used, reason = "a benchmark that fails panics")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use robot_build::{Options, Source, generate};
use robot_document::{EquationOptions, equations};
use robot_dynamics::quantity::Kind;

/// The time for each measurement.
const BUDGET: Duration = Duration::from_millis(400);

fn main() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/robots");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    let optimized = if cfg!(debug_assertions) { "with debug assertions" } else { "optimised" };
    println!("median milliseconds, generator {optimized}");
    println!("{:<12} {:>10} {:>10} {:>10}", "robot", "code", "KiB", "equations");
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let source = Source { name, text };
        let options = Options::default();
        let size = generate(&source, &options).unwrap().code.len() as f64 / 1024.0;
        let code = median(|| generate(&source, &options).unwrap().code.len());
        // All quantities of the paper for TRTTR1, which are usually printed; only the joint torques for other
        // robots.
        let kinds =
            if source.name == "trttr1" { Kind::ALL.to_vec() } else { vec![Kind::JointTorque] };
        let options = EquationOptions { kinds, ..EquationOptions::default() };
        let read = || robot_build::read(&source).unwrap().robot;
        let printed = median(|| equations(&read(), &options).unwrap().groups.len());
        println!("{:<12} {code:>10.2} {size:>10.1} {printed:>10.2}", source.name);
    }
}

/// The median time of a call, in milliseconds.
fn median(mut call: impl FnMut() -> usize) -> f64 {
    let mut times = vec![];
    let start = Instant::now();
    while times.len() < 3 || start.elapsed() < BUDGET {
        let before = Instant::now();
        black_box(call());
        times.push(before.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
