//! Passes over programs: each takes a [`Program`] and returns one that computes the same results.
//!
//! The cost of a program is mainly determined by the recursion that made the expressions. The passes save a few
//! percent of the operations, more if a recursion repeats itself, and order the rest.
//!
//! Each pass is a function in a file of its own. Tests on random programs check that it keeps the values:
//! to the last bit if it does not reassociate, otherwise up to rounding.

mod arrival;
mod dead_code;
mod factoring;
pub(crate) mod fusing;
mod latency;
mod nary;
mod pair_reuse;
pub(crate) mod product_last;
mod resubstitution;
mod schedule;
mod signs;
#[cfg(test)]
mod testing;
mod value_numbering;
mod waiting;

use self::resubstitution::Samples;
pub use self::schedule::Schedule;
use crate::cost::Cost;
use crate::counts::{Counts, PassCounts};
use crate::program::Program;

/// The number of values, summed over the rounds, after which no further round begins. The first round saves nearly
/// everything, and for functions of dozens of joints each round takes a second. Functions of arms have a few thousand
/// values.
const MAX_WORK: usize = 100_000;

/// The passes that run, and the cost that they minimize.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Whether `factoring` of sums runs.
    pub factoring: bool,
    /// Whether `pair_reuse` in sums and products runs.
    pub pair_reuse: bool,
    /// The effort of `resubstitution`.
    pub resubstitution: Resubstitution,
    /// The most rounds of these passes. The rounds end when no pass saves anything.
    pub rounds: usize,
    /// Whether sums and products are reordered: by `product_last` if multiply-adds follow, otherwise by `arrival`.
    pub arrival: bool,
    /// Whether `signs` moves changes of sign into differences.
    pub signs: bool,
    /// Whether products and sums become multiply-adds.
    pub fused: Fused,
    /// The order of statements.
    pub schedule: Schedule,
    /// The measure by which the result of a pass is taken or discarded.
    pub cost: Cost,
}

impl Default for Options {
    /// All passes except multiply-adds; minimizes the number of operations.
    fn default() -> Options {
        Options {
            factoring: true,
            pair_reuse: true,
            resubstitution: Resubstitution::Multiples,
            rounds: 4,
            arrival: true,
            signs: true,
            fused: Fused::Never,
            schedule: Schedule::Throughput,
            cost: Cost::Operations,
        }
    }
}

impl Options {
    /// No passes except the removal of dead code: the program as the expressions were built. The difference in cost
    /// is the saving of the other passes.
    #[must_use]
    pub fn none() -> Options {
        Options {
            factoring: false,
            pair_reuse: false,
            resubstitution: Resubstitution::Off,
            arrival: false,
            signs: false,
            schedule: Schedule::Construction,
            ..Options::default()
        }
    }
}

/// The effort of `resubstitution`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resubstitution {
    /// The pass does not run.
    Off,
    /// Searches for equal values and multiples; quick.
    #[default]
    Multiples,
    /// Also searches for sums and products of two values; the time grows with the square of the program's length.
    Pairs,
}

/// Whether products and sums become multiply-adds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fused {
    /// Never, so that the bits are the same on every target.
    #[default]
    Never,
    /// If the target has the instruction; otherwise the same code multiplies and adds.
    WhereTarget,
}

/// Runs the passes that save operations on a program that loads parameters, and reports the
/// counts after each, including those that save nothing. `angles` are the arguments of its sines and cosines.
pub(crate) fn run(
    program: &Program,
    angles: &Program,
    options: &Options,
) -> (Program, Vec<PassCounts>) {
    let samples = Samples::new(angles);
    let mut runner = Runner { program: program.clone(), cost: options.cost, report: vec![] };
    runner.note("as built");
    runner.take("value numbering", value_numbering::run);
    runner.take("dead code", dead_code::run);
    let mut work = 0;
    for round in 0..options.rounds {
        work += runner.program.operations().len();
        let factored = options.factoring && runner.attempt("factoring", factoring::run);
        let reused = options.pair_reuse && runner.attempt("pair reuse", pair_reuse::run);
        if round > 0 && !factored && !reused {
            // The program has not changed since resubstitution, which had already taken all that it found.
            break;
        }
        let effort = options.resubstitution;
        let replaced = effort != Resubstitution::Off
            && runner.attempt("resubstitution", |program| {
                resubstitution::run(program, &samples, effort)
            });
        if !(factored || reused || replaced) || work > MAX_WORK {
            break;
        }
    }
    (runner.program, runner.report)
}

/// Runs the passes that depend on the final operations, on a program that loads fields.
pub(crate) fn finish(program: &Program, options: &Options) -> (Program, Vec<PassCounts>) {
    let mut runner = Runner { program: program.clone(), cost: options.cost, report: vec![] };
    runner.take("constructor", dead_code::run);
    let fused = options.fused == Fused::WhereTarget;
    if options.arrival && fused {
        runner.take_order("product last", fusing::run, product_last::run);
    } else if options.arrival {
        runner.take_order("arrival", Program::clone, arrival::run);
    }
    if fused {
        runner.take("fusing", fusing::run);
    }
    if options.signs {
        runner.take("signs", |program| dead_code::run(&signs::run(program)));
    }
    runner.take("schedule", |program| schedule::run(&dead_code::run(program), options.schedule));
    (runner.program, runner.report)
}

/// Runs the passes for programs that are not part of a call's arithmetic.
pub(crate) fn tidy(program: &Program) -> Program {
    dead_code::run(&signs::run(&dead_code::run(program)))
}

struct Runner {
    program: Program,
    cost: Cost,
    report: Vec<PassCounts>,
}

impl Runner {
    /// Takes the result of a pass if it costs less.
    fn attempt(&mut self, name: &'static str, pass: impl Fn(&Program) -> Program) -> bool {
        let candidate = dead_code::run(&pass(&self.program));
        let saves = self.cost.of(&candidate) < self.cost.of(&self.program);
        if saves {
            self.program = candidate;
        }
        self.note(name);
        saves
    }

    /// Takes the result of a pass.
    fn take(&mut self, name: &'static str, pass: impl Fn(&Program) -> Program) {
        self.program = pass(&self.program);
        self.note(name);
    }

    /// Takes the result of a pass if, after `finished`, the last result is not later and no operation is added. It can be
    /// later if a tree of sums has become a chain.
    fn take_order(
        &mut self,
        name: &'static str,
        finished: impl Fn(&Program) -> Program,
        pass: impl Fn(&Program) -> Program,
    ) {
        let measure = |program: &Program| {
            let program = finished(program);
            (waiting::longest_chain(&program), Counts::of(&program).operations())
        };
        let candidate = pass(&self.program);
        let ((wait, count), (longest, most)) = (measure(&candidate), measure(&self.program));
        if wait <= longest && count <= most {
            self.program = candidate;
        }
        self.note(name);
    }

    fn note(&mut self, pass: &'static str) {
        let counts = Counts::of_calls(&self.program);
        self.report.push(PassCounts { pass, counts });
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{assert_same_bits, assert_same_values};
    use super::*;
    use crate::program::{Builder, Source};

    #[test]
    fn dead_code_and_value_numbering_keep_bits() {
        assert_same_bits("dead code", dead_code::run);
        assert_same_bits("value numbering", value_numbering::run);
    }

    #[test]
    fn all_together_keep_values() {
        for fused in [Fused::Never, Fused::WhereTarget] {
            for cost in [Cost::Operations, Cost::Instructions] {
                let options = Options { fused, cost, ..Options::default() };
                let all = |program: &Program| {
                    finish(&run(program, &Program::default(), &options).0, &options).0
                };
                assert_same_values("all passes", all);
            }
        }
    }

    #[test]
    fn without_passes_a_program_is_as_built_but_for_dead_code() {
        let none = Options::none();
        assert_eq!(
            (none.factoring, none.pair_reuse, none.arrival, none.signs),
            (false, false, false, false)
        );
        for seed in 0..50 {
            let program = testing::random_program(seed);
            let run = run(&program, &Program::default(), &none).0;
            assert_eq!(run, dead_code::run(&value_numbering::run(&program)), "seed {seed}");
            assert_eq!(finish(&run, &none).0, run, "seed {seed}");
        }
    }

    #[test]
    fn tidying_keeps_bits() {
        assert_same_bits("tidy", tidy);
    }

    #[test]
    fn no_pass_that_is_taken_costs_more() {
        for seed in 0..100 {
            let program = testing::random_program(seed);
            let (_, report) = run(&program, &Program::default(), &Options::default());
            let costs: Vec<usize> = report.iter().map(|pass| pass.counts.operations()).collect();
            assert!(costs.is_sorted_by(|before, after| before >= after), "{costs:?}");
        }
    }

    fn names(report: &[PassCounts]) -> Vec<&'static str> {
        report.iter().map(|counts| counts.pass).collect()
    }

    /// A round that follows a saving round ends after its first two passes if these save nothing more.
    #[test]
    fn rounds_end_when_nothing_is_saved() {
        let program = |saves: bool| {
            let mut b = Builder::new();
            let [x, y, z, w] = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
            let (first, second) = (b.mul(x, y), b.mul(if saves { x } else { w }, z));
            let sum = b.add(first, second);
            b.finish(vec![sum])
        };
        let start = ["as built", "value numbering", "dead code"];
        let round = ["factoring", "pair reuse", "resubstitution"];
        let of = |saves: bool, options: Options| {
            names(&run(&program(saves), &Program::default(), &options).1)
        };
        let all = Options::default();
        assert_eq!(of(false, all), [&start[..], &round].concat());
        assert_eq!(of(true, all), [&start[..], &round, &round[..2]].concat());
        assert_eq!(of(true, Options { rounds: 1, ..all }), [&start[..], &round].concat());
        let off = Options { resubstitution: Resubstitution::Off, ..all };
        assert_eq!(of(true, off), [&start[..], &round[..2], &round[..2]].concat());
        assert_eq!(
            of(true, Options { factoring: false, ..off }),
            [&start[..], &round[1..2]].concat()
        );
        assert_eq!(
            of(true, Options { pair_reuse: false, ..off }),
            [&start[..], &round[..1], &round[..1]].concat()
        );
        assert_eq!(of(true, Options { rounds: 0, ..all }), start);
        // (x z + y z)/z, if x + y is computed too: only resubstitution saves operations.
        let mut b = Builder::new();
        let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
        let (sum, xz, yz) = (b.add(x, y), b.mul(x, z), b.mul(y, z));
        let other = b.add(xz, yz);
        let results = vec![sum, xz, yz, b.div(other, z)];
        let report = run(&b.finish(results), &Program::default(), &all).1;
        assert_eq!(names(&report), [&start[..], &round, &round[..2]].concat());
    }

    /// Thousands of sums x y + x z, one program with fewer values than the limit of the rounds and one with more.
    #[test]
    fn large_programs_have_one_round() {
        let rounds = |sums: u32| {
            let mut b = Builder::new();
            let mut results = vec![];
            for index in 0..sums {
                let [x, y, z] = [0, 1, 2].map(|input| b.load(Source::Input(3 * index + input)));
                let (first, second) = (b.mul(x, y), b.mul(x, z));
                results.push(b.add(first, second));
            }
            let program = b.finish(results);
            let options = Options {
                pair_reuse: false,
                resubstitution: Resubstitution::Off,
                ..Options::default()
            };
            let (found, report) = run(&program, &Program::default(), &options);
            assert_eq!(Counts::of_calls(&found).operations(), 2 * sums as usize);
            names(&report).into_iter().filter(|name| *name == "factoring").count()
        };
        // Six values for each sum.
        let most = MAX_WORK as u32 / 6;
        assert_eq!((rounds(most - 10), rounds(most + 10)), (2, 1));
    }

    #[test]
    fn the_last_passes_are_those_asked_for() {
        let program = testing::random_program(1);
        let of = |options: Options| names(&finish(&program, &options).1);
        let all = Options::default();
        assert_eq!(of(all), ["constructor", "arrival", "signs", "schedule"]);
        let fused = Options { fused: Fused::WhereTarget, ..all };
        assert_eq!(of(fused), ["constructor", "product last", "fusing", "signs", "schedule"]);
        let built = Options { arrival: false, ..fused };
        assert_eq!(of(built), ["constructor", "fusing", "signs", "schedule"]);
        assert_eq!(
            of(Options { signs: false, arrival: false, ..all }),
            ["constructor", "schedule"]
        );
    }

    /// The result of a pass is discarded unless it costs less than before; that of a reordering is discarded if its
    /// longest chain is longer or if it has more operations.
    #[test]
    fn results_of_passes_are_taken_if_they_are_better() {
        let program = |value: u32| {
            let mut b = Builder::new();
            let [x, y] = [0, 1].map(|index| b.load(Source::Input(index)));
            let sum = b.add(x, y);
            let result = match value {
                0 => b.div(sum, x),
                1 => b.mul(sum, x),
                2 => sum,
                _ => {
                    let product = b.mul(sum, x);
                    b.add(product, y)
                }
            };
            b.finish(vec![result])
        };
        let runner =
            |first: u32| Runner { program: program(first), cost: Cost::Operations, report: vec![] };
        for (first, second, taken) in [(0, 1, false), (1, 0, false), (0, 2, true), (2, 0, false)] {
            let mut runner = runner(first);
            assert_eq!(runner.attempt("pass", |_| program(second)), taken);
            assert_eq!(runner.program, program(if taken { second } else { first }));
            assert_eq!(runner.report.len(), 1);
        }
        for (first, second, taken) in [(0, 1, true), (1, 0, false), (0, 2, true), (0, 3, false)] {
            let mut runner = runner(first);
            runner.take_order("order", Program::clone, |_| program(second));
            assert_eq!(runner.program, program(if taken { second } else { first }), "{second}");
        }
    }

    /// All passes together, over several rounds, leave fewer operations than one round does, and fewer than without one
    /// of the passes.
    #[test]
    fn together_passes_save_more_than_each() {
        let left = |options: Options| {
            testing::operations_left(|program| run(program, &Program::default(), &options).0).1
        };
        let all = left(Options::default());
        let one = left(Options { rounds: 1, ..Options::default() });
        let factoring = left(Options { factoring: false, ..Options::default() });
        let reuse = left(Options { pair_reuse: false, ..Options::default() });
        assert!(
            all < one && all < factoring && all < reuse && all <= 4726,
            "{all} {one} {factoring} {reuse}"
        );
    }
}
