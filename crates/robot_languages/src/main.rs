//! `cargo run --release -p robot_languages [-- [--write | --standard] [--robot=NAME]… [RUNNER…]]` runs every language
//! whose tools are installed on all robots, and prints which tools are not installed. `--standard` uses sines and
//! cosines of the languages' libraries, in double precision. `--write` writes the digests of the interpreter again. If
//! robots or runners are named, only these are run.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::process::ExitCode;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

use robot_codegen::{Scalar, Trigonometry};
use robot_languages::digests::{self, committed, digest};
use robot_languages::files;
use robot_languages::runners::{self, Found, Runner};
use robot_languages::ulps;
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

/// Runs the check; returns the number of functions whose bits differ.
fn run() -> Result<usize, String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (flags, names): (Vec<_>, Vec<_>) =
        arguments.into_iter().partition(|argument| argument.starts_with("--"));
    if flags.iter().any(|flag| flag == "--write") {
        return write();
    }
    let only: Vec<&str> = flags.iter().filter_map(|flag| flag.strip_prefix("--robot=")).collect();
    let trigonometry = match flags.iter().any(|flag| flag == "--standard") {
        true => Trigonometry::Standard,
        false => Trigonometry::Polynomial,
    };
    let runners = chosen(&names);
    let mut different = 0;
    for scalar in [Scalar::F64, Scalar::F32] {
        if trigonometry == Trigonometry::Standard && scalar == Scalar::F32 {
            continue;
        }
        let mut chosen = robots()?;
        chosen.retain(|robot| only.is_empty() || only.contains(&robot.as_str()));
        let works = chosen.iter().map(|robot| Work::with(robot, scalar, trigonometry));
        let works = works.collect::<Result<Vec<_>, _>>()?;
        let mut comparison = Comparison::new(scalar, trigonometry)?;
        for runner in &runners {
            if comparison.takes(runner.as_ref()) {
                different += comparison.run(runner.as_ref(), &works)?;
            }
        }
    }
    Ok(different)
}

/// The runners with these names, or all runners, whose tools are installed.
fn chosen(names: &[String]) -> Vec<Box<dyn Runner>> {
    let mut chosen = vec![];
    for runner in runners::all() {
        let is_chosen = names.is_empty() || names.iter().any(|name| name == runner.name());
        match runner.missing().filter(|_| is_chosen) {
            Some(why) => println!("{}: not run, {why}", runner.name()),
            None if is_chosen => chosen.push(runner),
            None => {}
        }
    }
    chosen
}

/// The largest permitted distance of a result with a library's sines from that of the interpreter, in units in the last
/// place of the function's largest output over all states.
const STANDARD: f64 = 4.0;

/// The same for functions with quotients: a solution with the mass matrix amplifies errors in the last bit of a sine by
/// the condition number. The largest distance so far was 28, for the derivatives of the Panda's forward dynamics in
/// Node.js.
const SOLVED: f64 = 32.0;

/// Compares results with those of the interpreter, by bits in double precision or in units in the last place. In single
/// precision, which the interpreter does not support, compares bits with those of the first runner.
struct Comparison {
    scalar: Scalar,
    trigonometry: Trigonometry,
    /// The digests, by name.
    reference: BTreeMap<String, String>,
    compared: usize,
    different: usize,
    /// The largest distances, and their functions.
    farthest: [(f64, String); 2],
}

impl Comparison {
    fn new(scalar: Scalar, trigonometry: Trigonometry) -> Result<Comparison, String> {
        let reference = match scalar {
            Scalar::F64 => committed()?,
            Scalar::F32 => BTreeMap::new(),
        };
        let farthest = Default::default();
        Ok(Comparison { scalar, trigonometry, reference, compared: 0, different: 0, farthest })
    }

    fn takes(&self, runner: &dyn Runner) -> bool {
        let has_sines =
            self.trigonometry == Trigonometry::Polynomial || runner.has_standard_sines();
        runner.has(self.scalar) && has_sines
    }

    /// Runs a runner on all robots; returns the number of functions that differ.
    fn run(&mut self, runner: &dyn Runner, works: &[Work]) -> Result<usize, String> {
        let start = Instant::now();
        (self.compared, self.different, self.farthest) = Default::default();
        let bounds = match self.trigonometry {
            Trigonometry::Standard => Some([STANDARD, SOLVED]),
            Trigonometry::Polynomial => runner.bound().map(|bound| [bound; 2]),
        };
        for (work, ways) in works.iter().zip(run_all(runner, works)) {
            for found in ways? {
                self.compare(runner, work, found, bounds);
            }
        }
        let how = match (bounds, &self.farthest) {
            (None, _) => "with other bits".to_owned(),
            (Some([bound, solved]), [(far, name), (of_state, other)]) => format!(
                "farther than {bound} ulp of the function's largest output, or {solved} where it has quotients; at most {far:.1} \
                 ({name}), and {of_state:.1} of the state's largest output ({other})"
            ),
        };
        println!(
            "{} {}: {} functions, {} {how} ({} s)",
            runner.name(),
            digests::type_name(self.scalar),
            self.compared,
            self.different,
            start.elapsed().as_secs()
        );
        Ok(self.different)
    }

    fn compare(
        &mut self,
        runner: &dyn Runner,
        work: &Work,
        found: Found,
        bounds: Option<[f64; 2]>,
    ) {
        let module = &work.programs.module;
        let functions = module.functions.iter().zip(&work.functions).zip(found.results);
        for ((function, calls), results) in functions {
            let Some(results) = results else { continue };
            let name = digests::name(work, &calls.name);
            self.compared += 1;
            let differs = match bounds {
                None => {
                    let digest = digest(&results);
                    *self.reference.entry(name.clone()).or_insert_with(|| digest.clone()) != digest
                }
                Some([usual, solved]) => {
                    let has_quotients = module.counts(function).call.div > 0;
                    let bound = if has_quotients { solved } else { usual };
                    let any = runner.bound().is_some();
                    let far = ulps::distances(calls, &results, self.scalar, any);
                    for (known, far) in
                        self.farthest.iter_mut().zip([far.of_function, far.of_state])
                    {
                        if far > known.0 {
                            *known = (far, name.clone());
                        }
                    }
                    far.of_function > bound
                }
            };
            if differs {
                self.different += 1;
                println!("{}, {}: {name} differs", runner.name(), found.way);
            }
        }
    }
}

/// Runs a runner on all robots, as many at a time as there are cores; returns the results in the order of the robots.
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

/// Writes the digests of the interpreter's results.
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
