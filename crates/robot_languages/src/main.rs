//! `cargo run --release -p robot_languages [-- [--write] [--robot=NAME]… [RUNNER…]]`: runs every language whose tools
//! are installed on all robots and says which are not; `--write` writes the digests anew, from the interpreter. Names of
//! robots and runners run those alone.

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Instant;

use robot_codegen::Scalar;
use robot_languages::digests::{self, committed, digest};
use robot_languages::files;
use robot_languages::runners::{self, Runner};
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
        for work in works {
            let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
            for found in runner.run(work, folder.path())? {
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
