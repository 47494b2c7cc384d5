//! `cargo run --release -p robot_languages [-- [--write] [--robot=NAME]… [RUNNER…]]`: runs every language whose tools
//! are installed on all robots and says which are not; `--write` writes the digests anew, from the interpreter. Names of
//! robots and runners run those alone.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::process::ExitCode;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

use robot_codegen::Scalar;
use robot_languages::digests::{self, committed, digest};
use robot_languages::files;
use robot_languages::runners::{self, Found, Runner};
use robot_languages::work::{Work, robots};

fn main() -> ExitCode {
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// The number of functions whose bits differ.
fn run() -> Result<usize, String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (flags, names): (Vec<_>, Vec<_>) =
        arguments.into_iter().partition(|argument| argument.starts_with("--"));
    if flags.iter().any(|flag| flag == "--write") {
        return write();
    }
    let only: Vec<&str> = flags.iter().filter_map(|flag| flag.strip_prefix("--robot=")).collect();
    let mut runners = vec![];
    for runner in runners::all() {
        let is_chosen = names.is_empty() || names.iter().any(|name| name == runner.name());
        match runner.missing().filter(|_| is_chosen) {
            Some(why) => println!("{}: not run, {why}", runner.name()),
            None if is_chosen => runners.push(runner),
            None => {}
        }
    }
    let mut different = 0;
    for scalar in [Scalar::F64, Scalar::F32] {
        let mut chosen = robots()?;
        chosen.retain(|robot| only.is_empty() || only.contains(&robot.as_str()));
        let works =
            chosen.iter().map(|robot| Work::new(robot, scalar)).collect::<Result<Vec<_>, _>>()?;
        different += compare(&runners, &works, scalar)?;
    }
    Ok(different)
}

/// Runs all of them on the robots, and compares: in double precision with the interpreter, in single precision, which it
/// does not have, with the first.
fn compare(runners: &[Box<dyn Runner>], works: &[Work], scalar: Scalar) -> Result<usize, String> {
    let mut different = 0;
    let mut reference: BTreeMap<String, String> = match scalar {
        Scalar::F64 => committed()?,
        Scalar::F32 => BTreeMap::new(),
    };
    for runner in runners.iter().filter(|runner| runner.has(scalar)) {
        let (mut compared, before, start) = (0, different, Instant::now());
        for (work, ways) in works.iter().zip(run_all(runner.as_ref(), works)) {
            for found in ways? {
                for (calls, results) in work.functions.iter().zip(found.results) {
                    let Some(results) = results else { continue };
                    let name = digests::name(work, &calls.name);
                    let digest = digest(&results);
                    let stated = reference.entry(name.clone()).or_insert_with(|| digest.clone());
                    compared += 1;
                    if *stated != digest {
                        different += 1;
                        println!("{}, {}: {name} has other bits", runner.name(), found.way);
                    }
                }
            }
        }
        println!(
            "{} {}: {compared} functions, {} with other bits ({} s)",
            runner.name(),
            digests::type_name(scalar),
            different - before,
            start.elapsed().as_secs()
        );
    }
    Ok(different)
}

/// Runs one of them on all robots, as many at a time as there are cores; the results in the order of the robots.
fn run_all(runner: &dyn Runner, works: &[Work]) -> Vec<Result<Vec<Found>, String>> {
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = vec![];
        while let Some((index, work)) =
            Some(next.fetch_add(1, Relaxed)).and_then(|index| Some((index, works.get(index)?)))
        {
            let folder = tempfile::tempdir().map_err(|error| error.to_string());
            done.push((index, folder.and_then(|folder| runner.run(work, folder.path()))));
        }
        done
    };
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let mut all = std::thread::scope(|scope| {
        let started: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
        let ended = started
            .into_iter()
            .map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        ended.flatten().collect::<Vec<_>>()
    });
    all.sort_unstable_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, found)| found).collect()
}

/// Writes the digests of what the interpreter gives.
fn write() -> Result<usize, String> {
    let mut digests = BTreeMap::new();
    for robot in robots()? {
        let work = Work::new(&robot, Scalar::F64)?;
        for calls in &work.functions {
            digests.insert(digests::name(&work, &calls.name), digest(&calls.expected));
        }
    }
    files::write(&files::root(), digests::FILE, digests::text(&digests).as_bytes())?;
    Ok(0)
}
