//! `search --tune`: among the plans with the fewest operations, the one with the fastest code on this machine.

use std::hint::black_box;
use std::time::Instant;

use robot_build::{Effects, FunctionKind, Functions, Options, Trigonometry};
use robot_codegen::Module;
use robot_dynamics::economical::search::{Found, Measure, search_several};
use robot_dynamics::mechanism::MechanismOptions;
use robot_jit::Compiled;
use robot_model::robot::Robot;
use robot_symbolic::Random;

use crate::failure::Failure;

/// The rows of a table; the first is the header.
type Rows = Vec<Vec<String>>;

/// The function whose operations the search minimizes.
const FUNCTION: FunctionKind =
    FunctionKind::InverseDynamics(Effects { wrench: false, friction: false });
/// The largest number of plans that are timed.
const MOST: usize = 32;
/// The factor by which another plan must be faster than the plan with the fewest operations. Two measurements of
/// the same code differ by about half of this margin.
const CLEARLY: f64 = 0.99;
/// The number of states of a batch, which stay in the cache.
const STATES: usize = 64;
/// The number of batches of each plan, which alternate with those of the other plans.
const ROUNDS: usize = 600;
/// The number of places in memory for the code of a plan, because some places are slow.
const PLACES: usize = 3;

/// The most rows of the table: the fastest plans and the plan with the fewest operations.
const ROWS: usize = 10;

/// A plan, and the times of its inverse dynamics.
struct Timed {
    found: Found,
    /// The time of a call, in ns.
    call: f64,
    /// The time of a state among many in columns, in ns.
    state: f64,
}

/// The machine code of a plan, with the states at which it is called.
struct Contender<'m> {
    found: Found,
    places: Vec<Compiled<'m>>,
    rows: Vec<Vec<f64>>,
    columns: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    least: [f64; 2],
}

/// Returns the plan to pin, and the rows of a table of the times; `None` if there are no plans for the robot.
pub(super) fn search(
    robot: &Robot,
    (options, measure): (&MechanismOptions, Measure),
    code: &Options,
) -> Result<Option<(Found, Rows)>, Failure> {
    let Some(several) = search_several(robot, options, measure, MOST) else { return Ok(None) };
    let timed = timed(robot, several, code)?;
    let chosen = fastest(&timed);
    let rows = rows(&timed, chosen);
    let found = timed.into_iter().nth(chosen).map(|timed| timed.found);
    // If times did not change the choice, the plan is pinned as without tuning.
    Ok(found.map(|found| (Found { tuned: chosen > 0, ..found }, rows)))
}

/// The rows of a table of times, with the fastest call first.
fn rows(timed: &[Timed], chosen: usize) -> Rows {
    let title = ["", "operations", "with multiply-adds", "ns per call", "ns per state of many"]
        .map(str::to_owned);
    let mut order: Vec<usize> = (0..timed.len()).collect();
    order.sort_by(|a, b| timed[*a].call.total_cmp(&timed[*b].call));
    let is_shown = |(place, index): &(usize, usize)| *place < ROWS || *index == 0;
    let shown = order.into_iter().enumerate().filter(is_shown).map(|(_, index)| {
        let Timed { found, call, state } = &timed[index];
        let mark = match index {
            _ if index == chosen => "chosen",
            0 => "fewest operations",
            _ => "",
        };
        let counts = [found.operations, found.instructions].map(|count| count.to_string());
        let [operations, instructions] = counts;
        vec![mark.to_owned(), operations, instructions, format!("{call:.1}"), format!("{state:.2}")]
    });
    [title.to_vec()].into_iter().chain(shown).collect()
}

/// Times the inverse dynamics under each plan; plans whose programs are the same are timed once.
fn timed(robot: &Robot, several: Vec<Found>, options: &Options) -> Result<Vec<Timed>, Failure> {
    let mut programs: Vec<(Found, Module)> = vec![];
    for found in several {
        let options = Options {
            functions: Functions::Chosen(vec![FUNCTION]),
            plan: Some(found.plan.clone()),
            trigonometry: Trigonometry::Polynomial,
            search: false,
            ..options.clone()
        };
        let module = robot_build::programs_of(robot.clone(), &robot.name, &options)?.module;
        let same = |(_, other): &(Found, Module)| {
            let both = other.functions.iter().zip(&module.functions);
            both.into_iter().all(|(a, b)| a.core == b.core && a.angles == b.angles)
        };
        if !programs.iter().any(same) {
            programs.push((robot_build::counted(robot, found, options.snap)?, module));
        }
    }
    let contenders: Result<Vec<Contender<'_>>, Failure> = programs
        .iter()
        .map(|(found, module)| Contender::new(found, module, options.fused))
        .collect();
    let mut contenders = contenders?;
    for round in 0..ROUNDS {
        for contender in &mut contenders {
            contender.run(round % PLACES)?;
        }
    }
    let timed = contenders.into_iter().map(|contender| {
        let [call, state] = contender.least.map(|least| least / STATES as f64);
        Timed { found: contender.found, call, state }
    });
    Ok(timed.collect())
}

/// The index of the plan to pin: the first, unless a call under another plan is clearly faster.
fn fastest(timed: &[Timed]) -> usize {
    let by_call = |(_, a): &(usize, &Timed), (_, b): &(usize, &Timed)| a.call.total_cmp(&b.call);
    let least = timed.iter().enumerate().min_by(by_call);
    let first = timed.first().map_or(0.0, |first| first.call);
    least.filter(|(_, least)| least.call < CLEARLY * first).map_or(0, |(index, _)| index)
}

impl<'m> Contender<'m> {
    fn new(found: &Found, module: &'m Module, fused: bool) -> Result<Contender<'m>, Failure> {
        let refused = |error: robot_jit::Error| {
            Failure::input(format!(
                "--tune times machine code, and there is none: {error}; search without --tune"
            ))
        };
        // The values of parameters do not affect the time.
        let missing = module.parameters.iter().filter(|parameter| parameter.nominal.is_none());
        let given: Vec<(&str, f64)> = missing.map(|parameter| (&*parameter.name, 1.0)).collect();
        let options = robot_jit::Options { fused, ..robot_jit::Options::default() };
        let place = |_| robot_jit::compile_with(module, &given, &options).map_err(refused);
        let places = (0..PLACES).map(place).collect::<Result<Vec<_>, Failure>>()?;
        let inputs = module.functions.iter().flat_map(|function| &function.inputs);
        let inputs: usize = inputs.map(|input| input.symbols.len()).sum();
        let outputs = module.functions.iter().map(|function| function.core.results().len()).sum();
        let mut random = Random::new(1);
        let columns: Vec<Vec<f64>> =
            (0..inputs).map(|_| (0..STATES).map(|_| random.uniform(-3.0, 3.0)).collect()).collect();
        let row = |state: usize| columns.iter().map(|column| column[state]).collect();
        let rows = (0..STATES).map(row).collect();
        let outputs = vec![vec![0.0; STATES]; outputs];
        let least = [f64::INFINITY; 2];
        Ok(Contender { found: found.clone(), places, rows, columns, outputs, least })
    }

    /// Runs a batch of calls and one of columns with the code in one place, and keeps the shortest times.
    fn run(&mut self, place: usize) -> Result<(), Failure> {
        let name = FUNCTION.name();
        let failed = |error: robot_jit::Error| Failure::input(error.to_string());
        let function = self.places[place].function(name).map_err(failed)?;
        let mut torques = vec![0.0; self.outputs.len()];
        let start = Instant::now();
        for row in &self.rows {
            let called = function.entries(black_box(row), black_box(&mut torques));
            called.map_err(|errors| Failure::input(errors.to_string()))?;
        }
        let call = start.elapsed();
        let inputs: Vec<&[f64]> = self.columns.iter().map(Vec::as_slice).collect();
        let mut outputs: Vec<&mut [f64]> = self.outputs.iter_mut().map(Vec::as_mut_slice).collect();
        let start = Instant::now();
        let called = function.columns(black_box(&inputs), black_box(&mut outputs));
        let columns = start.elapsed();
        called.map_err(|errors| Failure::input(errors.to_string()))?;
        for (least, time) in self.least.iter_mut().zip([call, columns]) {
            *least = least.min(time.as_nanos() as f64);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use robot_dynamics::economical::Plan;
    use robot_dynamics::economical::search::Measure;

    use super::*;

    fn timed(calls: &[f64]) -> Vec<Timed> {
        let found = Found {
            plan: Plan { links: vec![], unit_length: None },
            measure: Measure::Operations,
            operations: 1,
            instructions: 1,
            tried: 1,
            cut_short: false,
            tuned: false,
        };
        calls.iter().map(|call| Timed { found: found.clone(), call: *call, state: 1.0 }).collect()
    }

    #[test]
    fn only_what_is_clearly_faster_replaces_the_fewest_operations() {
        assert_eq!(fastest(&timed(&[50.0, 49.8, 60.0])), 0);
        assert_eq!(fastest(&timed(&[50.0, 60.0, 45.0, 48.0])), 2);
        assert_eq!(fastest(&timed(&[50.0])), 0);
    }

    #[test]
    fn the_table_has_the_fastest_plans_and_the_one_with_the_fewest_operations() {
        let calls: Vec<f64> = [90.0].into_iter().chain((1..=12).map(f64::from)).collect();
        let mut plans = timed(&calls);
        for (index, plan) in plans.iter_mut().enumerate() {
            plan.found.operations = 100 + index;
            plan.found.instructions = 200 + index;
            plan.state = 0.5 * plan.call;
        }
        let table = rows(&plans, 1);
        assert_eq!(table[0].len(), 5);
        // The plan with the fewest operations is the slowest, and is shown after the ten fastest.
        assert_eq!(table.len(), 1 + ROWS + 1);
        let first = ["chosen", "101", "201", "1.0", "0.50"].map(str::to_owned).to_vec();
        assert_eq!(table[1], first);
        for (place, row) in table[2..=ROWS].iter().enumerate() {
            let index = place + 2;
            let expected = [
                String::new(),
                format!("{}", 100 + index),
                format!("{}", 200 + index),
                format!("{index}.0"),
                format!("{:.2}", 0.5 * index as f64),
            ];
            assert_eq!(row[..], expected);
        }
        let last = ["fewest operations", "100", "200", "90.0", "45.00"].map(str::to_owned).to_vec();
        assert_eq!(table.last(), Some(&last));
        // Nothing is shown twice.
        let few = rows(&timed(&[3.0, 2.0, 1.0]), 0);
        let marks: Vec<&str> = few[1..].iter().map(|row| row[0].as_str()).collect();
        assert_eq!(marks, ["", "", "chosen"]);
        assert_eq!(rows(&timed(&[3.0]), 0).len(), 2);
    }
}
