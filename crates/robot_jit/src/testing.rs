//! Random functions for the tests.

use std::f64::consts::FRAC_2_PI;

use robot_codegen::module::Function;
use robot_codegen::program::{Builder, Operation, Program, Source, Value};
use robot_codegen::{Input, Module, Output};
use robot_runtime::trig::double::{COSINE, HALF_PI, LIMIT, SHIFT, SINE};
use robot_runtime::{Scalar, trig};
use robot_symbolic::{Function as Call, Random};

/// All functions that a program can call.
const CALLS: [Call; 7] =
    [Call::Sin, Call::Cos, Call::Sqrt, Call::Abs, Call::Sign, Call::Tanh, Call::RecipPositive];

/// Special numbers, which need separate handling.
const SPECIAL: [f64; 20] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    1e-310,
    f64::MAX,
    f64::MIN,
    1.0,
    -1.0,
    1073741824.0,
    1073741823.9999999,
    -1073741824.0,
    22.0,
    -22.000000000000004,
    1e5,
];

/// A random number; one of `rarely` numbers is a special one.
pub(crate) fn number(random: &mut Random, rarely: usize) -> f64 {
    match random.index(rarely) {
        0 => SPECIAL[random.index(SPECIAL.len())],
        1 => random.uniform(-1e6, 1e6),
        _ => random.uniform(-3.0, 3.0),
    }
}

/// The length of functions.
#[derive(Clone, Copy)]
pub(crate) enum Size {
    /// From one operation to 2,500.
    Any,
    /// From ten operations to sixty, with up to eight inputs and three angles and with few calls, so that many can be
    /// tested quickly.
    Small,
}

/// A module without parameters, with random functions `f0`, `f1` and so on; with multiply-adds if `fused`.
pub(crate) fn module(seed: u64, functions: usize, size: Size, fused: bool) -> Module {
    let mut random = Random::new(seed);
    let functions = (0..functions).map(|index| function(&mut random, index, size, fused)).collect();
    Module {
        name: format!("seed {seed}"),
        doc: vec![],
        parameters: vec![],
        constructor: Builder::new().finish(vec![]),
        functions,
    }
}

fn function(random: &mut Random, index: usize, size: Size, fused: bool) -> Function {
    let inputs = 1 + random.index(if let Size::Any = size { 24 } else { 8 });
    let angles = match size {
        Size::Any => angles(random, inputs, 9),
        Size::Small if random.index(3) == 0 => angles(random, inputs, 1),
        Size::Small => Builder::new().finish(vec![]),
    };
    let core = core(random, inputs, angles.results().len(), size, fused);
    let symbols = (0..inputs).map(|entry| format!("x{entry}")).collect();
    let output = Output {
        name: "y".to_owned(),
        doc: String::new(),
        shape: vec![core.results().len()],
        values: (),
        unit: String::new(),
    };
    Function {
        name: format!("f{index}"),
        doc: vec![],
        inputs: vec![Input {
            name: "x".to_owned(),
            doc: String::new(),
            symbols,
            unit: String::new(),
        }],
        outputs: vec![output],
        angles,
        core,
        passes: vec![],
        limbs: None,
    }
}

/// A program of angles: up to `most` neighboring inputs, then up to two computed angles.
fn angles(random: &mut Random, inputs: usize, most: usize) -> Program {
    let mut builder = Builder::new();
    let plain = random.index(most + 1).min(inputs);
    let first = random.index(inputs - plain + 1);
    let load = |builder: &mut Builder, entry: usize| builder.load(Source::Input(entry as u32));
    let mut results: Vec<Value> =
        (0..plain).map(|angle| load(&mut builder, first + angle)).collect();
    for _ in 0..random.index(3) {
        let [a, b] = [0; 2].map(|_| load(&mut builder, random.index(inputs)));
        let sum = builder.push(Operation::Add(a, b));
        results.push(sum);
    }
    builder.finish(results)
}

/// A random number of operations.
fn length(random: &mut Random, size: Size) -> usize {
    let longest = match size {
        Size::Small => return 10 + random.index(51),
        // The longest functions are ordered in another way.
        Size::Any => match random.index(60) {
            0 => 2500,
            short => [10, 60, 300][short % 3],
        },
    };
    1 + random.index(longest)
}

/// A program of random operations, whose operands are recent values or, in some programs, any earlier ones.
fn core(random: &mut Random, inputs: usize, angles: usize, size: Size, fused: bool) -> Program {
    let mut builder = Builder::new();
    let mut pool: Vec<Value> =
        (0..inputs).map(|entry| builder.load(Source::Input(entry as u32))).collect();
    for angle in 0..angles as u32 {
        pool.push(builder.load(Source::Sin(angle)));
        pool.push(builder.load(Source::Cos(angle)));
    }
    for _ in 0..1 + random.index(6) {
        let constant = builder.constant(number(random, 4));
        pool.push(constant);
    }
    let length = length(random, size);
    let window = [8, 40, 1000][random.index(3)];
    // Calls become long code, so small functions have fewer.
    let kinds = if let Size::Any = size { 24 } else { 23 };
    for _ in 0..length {
        let [a, b, c] = [0; 3].map(|_| pool[pool.len() - 1 - random.index(window.min(pool.len()))]);
        let operation = match random.index(kinds) {
            0..=5 => Operation::Add(a, b),
            6..=9 => Operation::Sub(a, b),
            10..=15 => Operation::Mul(a, b),
            16 => Operation::Neg(a),
            17 => Operation::Div(a, b),
            18..=21 if fused => Operation::MulAdd(a, b, c),
            18..=21 => Operation::Mul(a, a),
            _ => Operation::Call(CALLS[random.index(CALLS.len())], a),
        };
        let value = builder.push(operation);
        pool.push(value);
    }
    let mut results: Vec<Value> =
        (0..1 + random.index(12)).map(|_| pool[random.index(pool.len())]).collect();
    results.extend(pool.last());
    // Neighboring constants, as in the matrices of poses.
    for _ in 0..random.index(3) {
        let at = random.index(results.len() + 1);
        let constants = [0.0, 1.0].map(|number| builder.constant(number));
        let row = (0..random.index(12)).map(|_| constants[random.index(2)]);
        let row: Vec<Value> = row.collect();
        results.splice(at..at, row);
    }
    builder.finish(results)
}

/// Sine and cosine with multiply-adds that round once, as in the runtime on targets that have the instruction.
fn fused_sin_cos(x: f64) -> (f64, f64) {
    let shifted = x.mul_add(FRAC_2_PI, SHIFT);
    let k = shifted - SHIFT;
    let angle = if x.abs() < LIMIT { x } else { f64::NAN };
    let r = k.mul_add(-HALF_PI[1], k.mul_add(-HALF_PI[0], angle));
    let (z, rest) = (r * r, k * HALF_PI[2]);
    let polynomial = |c: &[f64; 6]| {
        let [low, middle, high] = [0, 2, 4].map(|at| c[at + 1].mul_add(z, c[at]));
        high.mul_add(z * z, middle).mul_add(z * z, low)
    };
    let sine = r + (r * z).mul_add(polynomial(&SINE), -rest);
    let cosine = z.mul_add(z.mul_add(polynomial(&COSINE), -0.5), 1.0);
    match shifted.to_bits() & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

fn sin_cos(x: f64, fused: bool) -> (f64, f64) {
    if fused { fused_sin_cos(x) } else { trig::double::portable_sin_cos(x) }
}

fn call(function: Call, x: f64, fused: bool) -> f64 {
    match function {
        Call::Sin => sin_cos(x, fused).0,
        Call::Cos => sin_cos(x, fused).1,
        Call::Sqrt => x.sqrt(),
        Call::Abs => x.abs(),
        Call::Sign => x.signum0(),
        Call::Tanh => Scalar::tanh(x),
        Call::RecipPositive => x.recip_positive(),
    }
}

fn values(program: &Program, fused: bool, load: impl Fn(Source) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = vec![];
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        values.push(match *operation {
            Operation::Constant(constant) => constant.get(),
            Operation::Load(source) => load(source),
            Operation::Add(a, b) => at(a) + at(b),
            Operation::Sub(a, b) => at(a) - at(b),
            Operation::Mul(a, b) => at(a) * at(b),
            Operation::Div(a, b) => at(a) / at(b),
            Operation::Neg(a) => -at(a),
            Operation::MulAdd(a, b, c) => at(a).mul_add(at(b), at(c)),
            Operation::Call(function, a) => call(function, at(a), fused),
        });
    }
    program.results().iter().map(|value| values[value.index()]).collect()
}

/// The outputs of a function at a state, with multiply-adds that round once, also those in sines if `fused`.
pub(crate) fn reference(function: &Function, inputs: &[f64], fused: bool) -> Vec<f64> {
    let input = |source| match source {
        Source::Input(entry) => inputs[entry as usize],
        other => panic!("{other:?}"),
    };
    let angles = values(&function.angles, fused, input);
    values(&function.core, fused, |source| match source {
        Source::Sin(angle) => call(Call::Sin, angles[angle as usize], fused),
        Source::Cos(angle) => call(Call::Cos, angles[angle as usize], fused),
        other => input(other),
    })
}
