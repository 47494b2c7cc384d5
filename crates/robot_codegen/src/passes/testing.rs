//! Random programs for the tests of passes.

use robot_symbolic::{Function, Random};

use super::dead_code;
use crate::counts::Counts;
use crate::program::{Builder, Operation, Program, Source, Value};

/// A random number between 1/4 and 7/4, or the negative of such a number.
fn real(random: &mut Random) -> f64 {
    let size = random.uniform(0.25, 1.75);
    if random.index(2) == 0 { size } else { -size }
}

const SEEDS: u64 = 200;

/// The functions in random programs, without square roots, because a sum can round to just below 0.
const FUNCTIONS: [Function; 5] =
    [Function::Abs, Function::Sin, Function::Cos, Function::Sign, Function::Tanh];

/// The bound of a value if rounding may have determined a sign, so that nothing follows from the value.
const UNDECIDED: f64 = 1e100;

/// Returns a program with loads of parameters and inputs, many sums and products, and some other operations.
pub(super) fn random_program(seed: u64) -> Program {
    let mut random = Random::new(seed);
    let mut builder = Builder::new();
    let mut pool: Vec<Value> = (0..4).map(|index| builder.load(Source::Parameter(index))).collect();
    pool.extend((0..4).map(|index| builder.load(Source::Input(index))));
    pool.extend([Source::Sin(0), Source::Cos(0)].map(|source| builder.load(source)));
    for constant in [2.0, 0.5, 1.0, -3.0] {
        pool.push(builder.constant(constant));
    }
    for _ in 0..20 + random.index(60) {
        let [a, b, c] = [0; 3].map(|_| pool[random.index(pool.len())]);
        let value = match random.index(24) {
            0..=5 => builder.add(a, b),
            6..=8 => builder.sub(a, b),
            9..=15 => builder.mul(a, b),
            16 | 17 => builder.neg(a),
            18 => builder.push(Operation::MulAdd(a, b, c)),
            19 => builder.div(a, b),
            function => builder.call(FUNCTIONS[(function + random.index(2)) % 5], a),
        };
        pool.push(value);
    }
    let results = (0..1 + random.index(5)).map(|_| pool[pool.len() - 1 - random.index(12)]);
    builder.finish(results.collect())
}

/// Returns sums of products of few loads, some of them of parameters, with many common factors, pairs and equal values.
pub(super) fn random_polynomials(seed: u64) -> Program {
    let mut random = Random::new(seed ^ 0x9017);
    let mut builder = Builder::new();
    let mut pool: Vec<Value> = (0..3).map(|index| builder.load(Source::Parameter(index))).collect();
    pool.extend((0..4).map(|index| builder.load(Source::Input(index))));
    let mut results = vec![];
    for _ in 0..2 + random.index(5) {
        let mut sum: Option<Value> = None;
        for _ in 0..2 + random.index(5) {
            let mut product = pool[random.index(pool.len())];
            for _ in 0..random.index(4) {
                let factor = pool[random.index(pool.len())];
                product = builder.mul(product, factor);
            }
            sum = Some(match sum {
                None => product,
                Some(sum) if random.index(3) == 0 => builder.sub(sum, product),
                Some(sum) => builder.add(sum, product),
            });
        }
        results.extend(sum);
        if random.index(3) == 0 {
            pool.extend(sum);
        }
    }
    builder.finish(results)
}

/// Returns the program with inputs instead of parameters.
pub(super) fn inputs_only(program: &Program) -> Program {
    let mut b = Builder::new();
    let mut values: Vec<Value> = vec![];
    for operation in program.operations() {
        values.push(match *operation {
            Operation::Load(Source::Parameter(index)) => b.load(Source::Input(20 + index)),
            operation => b.apply(operation.map(|value| values[value.index()])),
        });
    }
    let results = program.results().iter().map(|value| values[value.index()]);
    dead_code::run(&b.finish(results.collect()))
}

/// Returns the operations at calls of many programs of sums and products, before and after a pass; checks that the pass
/// adds none to any program.
pub(super) fn operations_left(pass: impl Fn(&Program) -> Program) -> (usize, usize) {
    let (mut before, mut after) = (0, 0);
    for seed in 0..SEEDS {
        let program = dead_code::run(&random_polynomials(seed));
        let [old, new] =
            [&program, &pass(&program)].map(|program| Counts::of_calls(program).operations());
        assert!(new <= old, "seed {seed}: {old} became {new}");
        (before, after) = (before + old, after + new);
    }
    (before, after)
}

/// Returns the value of each result and a bound on its rounding error, in units of 2⁻⁵³.
fn values_with_bounds(program: &Program, load: impl Fn(Source) -> f64) -> Vec<(f64, f64)> {
    let mut values: Vec<(f64, f64)> = vec![];
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        let (value, bound) = match *operation {
            Operation::Constant(constant) => (constant.get(), 0.0),
            Operation::Load(source) => (load(source), 0.0),
            Operation::Add(a, b) => (at(a).0 + at(b).0, at(a).1 + at(b).1),
            Operation::Sub(a, b) => (at(a).0 - at(b).0, at(a).1 + at(b).1),
            Operation::Mul(a, b) => {
                (at(a).0 * at(b).0, at(a).1 * at(b).0.abs() + at(a).0.abs() * at(b).1)
            }
            Operation::MulAdd(a, b, c) => {
                let product = at(a).1 * at(b).0.abs() + at(a).0.abs() * at(b).1;
                (at(a).0 * at(b).0 + at(c).0, product + (at(a).0 * at(b).0).abs() + at(c).1)
            }
            Operation::Div(a, b) => {
                let value = at(a).0 / at(b).0;
                (value, (at(a).1 + value.abs() * at(b).1) / at(b).0.abs())
            }
            Operation::Neg(a) => (-at(a).0, at(a).1),
            Operation::Call(Function::Sign, a) => {
                let decided = at(a).0.abs() > 1e-15 * at(a).1;
                (Function::Sign.apply(at(a).0), if decided { 0.0 } else { UNDECIDED })
            }
            // The slopes of all other functions are at most 1.
            Operation::Call(function, a) => (function.apply(at(a).0), at(a).1),
        };
        values.push((value, bound + value.abs()));
    }
    program.results().iter().map(|value| values[value.index()]).collect()
}

/// Evaluates both programs at random loads; returns pairs of values with the bound of the first.
fn compare(program: &Program, other: &Program, seed: u64) -> Vec<(f64, f64, f64)> {
    let mut random = Random::new(seed ^ 0x5eed);
    let table: Vec<f64> = (0..16).map(|_| real(&mut random)).collect();
    let load = |source: Source| match source {
        Source::Parameter(index) => table[index as usize],
        Source::Input(index) => table[4 + index as usize],
        Source::Sin(_) => table[8],
        Source::Cos(_) => table[9],
        Source::Field(index) => table[10 + index as usize],
    };
    let expected = values_with_bounds(program, load);
    let found = values_with_bounds(other, load);
    assert_eq!(expected.len(), found.len());
    let pairs = expected.into_iter().zip(found);
    pairs.map(|((a, bound), (b, other))| (a, b, bound.max(other))).collect()
}

/// Checks a pass that may reassociate: the values stay the same up to rounding.
pub(super) fn assert_same_values(name: &str, pass: impl Fn(&Program) -> Program) {
    let mut finite = 0;
    for seed in 0..2 * SEEDS {
        let program = if seed < SEEDS { random_program(seed) } else { random_polynomials(seed) };
        for (expected, found, bound) in compare(&program, &pass(&program), seed) {
            // Divisors that canceled to almost nothing make a comparison meaningless.
            if !bound.is_finite() || bound > 1e9 {
                continue;
            }
            finite += 1;
            let error = (expected - found).abs();
            assert!(
                error <= 1e-15 * bound,
                "{name}, seed {seed}: {expected} became {found}, bound {bound:e}\n{program:?}"
            );
        }
    }
    assert!(finite > 2 * SEEDS, "{finite} results compared");
}

/// Checks a pass that does not reassociate: the bits stay the same.
pub(super) fn assert_same_bits(name: &str, pass: impl Fn(&Program) -> Program) {
    for seed in 0..SEEDS {
        let program = random_program(seed);
        for (expected, found, _) in compare(&program, &pass(&program), seed) {
            let same = expected == found || !expected.is_finite();
            assert!(same, "{name}, seed {seed}: {expected:e} became {found:e}\n{program:?}");
        }
    }
}
