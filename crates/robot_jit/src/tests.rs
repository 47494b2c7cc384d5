//! Random functions compared with the interpreter and a reference, and checks of all addresses that code accesses.

use iced_x86::{Decoder, DecoderOptions, InstructionInfoFactory, Mnemonic, OpAccess, Register};
use robot_codegen::module::Function;
use robot_codegen::program::{Builder, Operation, Program, Source, Value};
use robot_codegen::{Callable, Interpreter, Module, Trigonometry};
use robot_symbolic::Random;

use crate::emit::{Entry, Target, emit_lanes, emit_single};
use crate::testing::{Size, module, number, reference};
use crate::{Compiled, Error, Executable, Options, Registers, compile_with};

/// The number of modules, with `FUNCTIONS` functions each; one half has multiply-adds.
const MODULES: u64 = 250;
const FUNCTIONS: usize = 40;
const STATES: usize = 13;

/// The number of modules with small functions, `SMALL_FUNCTIONS` each.
const SMALL_MODULES: u64 = 20;
const SMALL_FUNCTIONS: usize = 50;
/// The number of states: one more than a register of eight numbers has, or than two of four have.
const SMALL_STATES: usize = 9;

fn registers() -> Vec<Registers> {
    let both = [Registers::Avx2, Registers::Avx512, Registers::Bits128].into_iter();
    both.filter(|registers| registers.check().is_ok()).collect()
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Which multiply-adds round once: those of the program, and those in sines.
#[derive(Clone, Copy)]
struct Fused {
    program: bool,
    sines: bool,
}

impl Fused {
    fn of(seed: u64) -> Fused {
        Fused { program: seed.is_multiple_of(2), sines: seed.is_multiple_of(5) }
    }

    /// Three of sixty seeds have multiply-adds that round once.
    fn rarely(seed: u64) -> Fused {
        Fused { program: [0, 1].contains(&(seed % 60)), sines: [1, 2].contains(&(seed % 60)) }
    }

    /// Whether the interpreter has other bits, because it rounds each product.
    fn any(self) -> bool {
        self.program || self.sines
    }
}

/// The columns of inputs, and the rows of expected outputs.
struct Expected {
    inputs: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
}

/// Random states with their expected outputs, which are those of the reference; checks that they equal those of the
/// interpreter if nothing is fused.
fn expected(
    function: Callable<'_>,
    program: &Function,
    random: &mut Random,
    fused: Fused,
    states: usize,
) -> Expected {
    let size = function.input_size();
    let rarely = [3, 20, 1000][random.index(3)];
    let rows: Vec<Vec<f64>> =
        (0..states).map(|_| (0..size).map(|_| number(random, rarely)).collect()).collect();
    let outputs: Vec<Vec<f64>> =
        rows.iter().map(|row| reference(program, row, fused.sines)).collect();
    if !fused.any() {
        let mut interpreted = vec![0.0; function.output_size()];
        for (row, right) in rows.iter().zip(&outputs) {
            function.entries(row, &mut interpreted).unwrap();
            let is_same = interpreted.iter().zip(right).all(|(a, b)| same(*a, *b));
            assert!(is_same, "{}: {interpreted:?} is not {right:?}", function.name());
        }
    }
    let inputs = (0..size).map(|entry| rows.iter().map(|row| row[entry]).collect()).collect();
    Expected { inputs, outputs }
}

/// Calls a function state by state and over columns, and compares the results with the expected ones.
fn compare(place: &str, function: crate::Function<'_>, expected: &Expected) {
    let states = expected.outputs.len();
    let inputs: Vec<&[f64]> = expected.inputs.iter().map(Vec::as_slice).collect();
    // A number before and one after each column, which must not be written.
    let size = function.output_size();
    let mut lanes = vec![vec![7.5; states + 2]; size];
    let mut outputs: Vec<&mut [f64]> =
        lanes.iter_mut().map(|column| &mut column[1..=states]).collect();
    function.columns(&inputs, &mut outputs).unwrap();
    let mut row = vec![0.0; inputs.len()];
    let mut single = vec![7.5; size + 2];
    for (state, expected) in expected.outputs.iter().enumerate() {
        row.iter_mut().zip(&inputs).for_each(|(entry, column)| *entry = column[state]);
        function.entries(&row, &mut single[1..=size]).unwrap();
        assert_eq!([single[0], single[size + 1]], [7.5; 2], "{place}");
        for (entry, right) in expected.iter().enumerate() {
            let [one, many] = [single[entry + 1], lanes[entry][state + 1]];
            assert!(same(one, *right), "{place}: [{entry}] is {one:e}, not {right:e}");
            assert!(same(many, *right), "{place}: [{entry}] in lanes is {many:e}, not {right:e}");
        }
    }
    assert!(lanes.iter().all(|column| column[0] == 7.5 && column[states + 1] == 7.5));
}

/// Compares all functions of a module, for all registers of this machine.
fn compare_module(
    module: &Module,
    registers: &[Registers],
    (seed, fused): (u64, Fused),
    states: usize,
) {
    let mut random = Random::new(seed);
    let interpreter = Interpreter::new(module, &[]).unwrap();
    let compiled: Vec<Compiled<'_>> = registers
        .iter()
        .map(|registers| {
            let registers = Some(*registers);
            let options = Options { registers, fused: fused.sines, ..Options::default() };
            compile_with(module, &[], &options).unwrap()
        })
        .collect();
    for program in &module.functions {
        let name = &program.name;
        let function = interpreter.function(name).unwrap();
        let expected = expected(function, program, &mut random, fused, states);
        for compiled in &compiled {
            let place = format!("{} {name} {:?}", module.name, compiled.registers());
            compare(&place, compiled.function(name).unwrap(), &expected);
        }
    }
}

/// Reads a number from an environment variable.
fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|number| number.parse().unwrap())
}

/// `ROBOT_JIT_MODULES` sets the number of modules, if 250 take too long.
#[test]
fn random_functions_have_the_bits_of_the_reference() {
    let registers = registers();
    for seed in 0..variable("ROBOT_JIT_MODULES").unwrap_or(MODULES) {
        let fused = Fused::of(seed);
        let module = module(seed, FUNCTIONS, Size::Any, fused.program);
        compare_module(&module, &registers, (seed, fused), STATES);
    }
    for seed in 0..SMALL_MODULES {
        let fused = Fused::rarely(seed);
        let module = module(seed, SMALL_FUNCTIONS, Size::Small, fused.program);
        compare_module(&module, &registers, (seed, fused), SMALL_STATES);
    }
}

/// Millions of small functions: `ROBOT_JIT_FUNCTIONS=10000000` is the number of functions without multiply-adds, which
/// are compared with the interpreter; further functions with multiply-adds are compared with the reference.
/// `ROBOT_JIT_FIRST` is the first seed; each seed makes fifty functions for one kind of registers, in turn:
///
/// ```text
/// cargo test --release -p robot_jit --lib -- --ignored --nocapture
/// ```
#[test]
#[ignore = "takes minutes"]
fn many_random_functions_have_the_bits_of_the_interpreter() {
    let first = variable("ROBOT_JIT_FIRST").unwrap_or(SMALL_MODULES);
    let asked = variable("ROBOT_JIT_FUNCTIONS").unwrap_or(100_000);
    let registers = registers();
    assert!(!registers.is_empty());
    // The number of functions compared with the interpreter, and of those compared only with the reference.
    let mut compared = [0u64; 2];
    for seed in first.. {
        let fused = Fused::rarely(seed);
        let module = module(seed, SMALL_FUNCTIONS, Size::Small, fused.program);
        let kind = seed as usize % registers.len();
        compare_module(&module, &registers[kind..=kind], (seed, fused), SMALL_STATES);
        compared[usize::from(fused.any())] += SMALL_FUNCTIONS as u64;
        let is_done = compared[0] >= asked;
        if is_done || (seed + 1 - first).is_multiple_of(10_000) {
            let [interpreted, fused] = compared;
            println!(
                "{registers:?}, seeds {first} to {seed}: {interpreted} functions have the bits of the interpreter, {fused} \
                 fused ones those of the reference"
            );
        }
        if is_done {
            break;
        }
    }
}

/// Decodes code and checks every address that it can access.
fn check_addresses(entry: &Entry, lanes: usize, place: &str) {
    let mut decoder = Decoder::new(64, &entry.code, DecoderOptions::NONE);
    let mut information = InstructionInfoFactory::new();
    let in_columns = lanes > 1;
    // Whether the register for pointers to columns points to an input or an output.
    let mut column = Register::None;
    let mut instructions = 0;
    // Long code advances two pointers before it uses them.
    let mut moved = [0u64; 2];
    for instruction in &mut decoder {
        assert!(!instruction.is_invalid(), "{place}");
        instructions += 1;
        if instruction.mnemonic() == Mnemonic::Add {
            match instruction.op0_register() {
                Register::RCX => moved[0] += instruction.immediate(1),
                Register::RDX => moved[1] += instruction.immediate(1),
                other => assert!(in_columns && other == Register::R8, "{place}"),
            }
            assert!(instructions <= 2 || instruction.op0_register() == Register::R8, "{place}");
        }
        for memory in information.info(&instruction).used_memory() {
            if instruction.mnemonic() == Mnemonic::Ret {
                continue;
            }
            let place = format!("{place}: {instruction:?} {memory:?}");
            let from = memory.displacement().wrapping_add(match memory.base() {
                Register::RCX => moved[0],
                Register::RDX => moved[1],
                _ => 0,
            });
            let size = memory.memory_size().size() as u64;
            let writes = matches!(memory.access(), OpAccess::Write | OpAccess::ReadWrite);
            let end = from.checked_add(size).unwrap();
            let most = match memory.base() {
                Register::RDI => entry.inputs,
                Register::RSI => entry.outputs,
                Register::RDX => entry.pool.len(),
                Register::RCX => entry.working,
                Register::RAX => {
                    assert!(in_columns && memory.index() == Register::R8, "{place}");
                    assert!(
                        from == 0 && memory.scale() == 8 && size <= 8 * lanes as u64,
                        "{place}"
                    );
                    assert_eq!(writes, column == Register::RSI, "{place}");
                    continue;
                }
                _ => panic!("{place}"),
            };
            assert_eq!(memory.index(), Register::None, "{place}");
            assert!(end <= 8 * most as u64, "{place}: {end} of {most} numbers");
            let may_write = match memory.base() {
                Register::RCX => true,
                Register::RSI => !in_columns,
                _ => false,
            };
            assert!(!writes || may_write, "{place}");
            if instruction.op0_register() == Register::RAX {
                column = memory.base();
            }
        }
    }
    assert!(instructions > 1, "{place}");
}

#[test]
fn code_touches_nothing_but_its_memory() {
    for seed in 0..40 {
        let module = module(seed, FUNCTIONS, Size::Any, seed % 2 == 0);
        for function in &module.functions {
            for registers in [Registers::Avx2, Registers::Avx512] {
                let place = format!("seed {seed} {} {registers:?}", function.name);
                let target = Target { registers, fused: seed % 3 == 0 };
                let single = emit_single(function, &[], target).unwrap().0;
                check_addresses(&single, 1, &place);
                let lanes = emit_lanes(function, &[], target).unwrap().0;
                check_addresses(&lanes, registers.lanes(), &place);
            }
        }
    }
}

#[test]
fn wrong_sizes_are_refused() {
    let Some(registers) = registers().pop() else { return };
    let module = module(3, 1, Size::Any, false);
    let options = Options { registers: Some(registers), ..Options::default() };
    let compiled = compile_with(&module, &[], &options).unwrap();
    let function = compiled.function("f0").unwrap();
    let (taken, given) = (function.input_size(), function.output_size());
    let column = vec![0.5; 16];
    let short = vec![0.5; 9];
    for (inputs, outputs) in [(taken + 1, given), (taken - 1, given), (taken, given + 1), (0, 0)] {
        assert!(function.entries(&vec![0.0; inputs], &mut vec![0.0; outputs]).is_err());
        let columns = vec![column.as_slice(); inputs];
        let mut results = vec![vec![0.0; 16]; outputs];
        let mut results: Vec<&mut [f64]> = results.iter_mut().map(Vec::as_mut_slice).collect();
        assert!(function.columns(&columns, &mut results).is_err());
    }
    let mut columns = vec![column.as_slice(); taken];
    columns[taken - 1] = &short;
    let mut results = vec![vec![0.0; 16]; given];
    let mut results: Vec<&mut [f64]> = results.iter_mut().map(Vec::as_mut_slice).collect();
    assert!(function.columns(&columns, &mut results).is_err());
    assert!(function.call(&[("x", &[0.0])]).is_err() || taken == 1);
    assert!(function.call(&[]).is_err());
    assert!(function.states(2, &[("x", &[vec![0.0; taken]])]).is_err());
    assert_eq!(function.states(0, &[("x", &[])]).unwrap(), Vec::<Vec<f64>>::new());
}

#[test]
fn states_are_calls() {
    let Some(registers) = registers().pop() else { return };
    let module = module(5, 3, Size::Any, false);
    let options = Options { registers: Some(registers), ..Options::default() };
    let compiled = compile_with(&module, &[], &options).unwrap();
    let function = compiled.function("f2").unwrap();
    let mut random = Random::new(1);
    for count in [1, 7, 8, 63, 64, 65, 200] {
        let rows: Vec<Vec<f64>> = (0..count)
            .map(|_| (0..function.input_size()).map(|_| number(&mut random, 50)).collect())
            .collect();
        let found = function.states(count, &[("x", &rows)]).unwrap();
        for (row, found) in rows.iter().zip(&found) {
            let expected = function.call(&[("x", row)]).unwrap();
            assert!(expected.iter().zip(found).all(|(a, b)| same(*a, *b)), "{count}");
        }
    }
}

#[test]
fn what_cannot_be_compiled_is_an_error() {
    let Some(registers) = registers().pop() else {
        assert!(matches!(Registers::detect(), Err(Error::Processor { .. })));
        return;
    };
    let mut module = module(1, 2, Size::Any, false);
    let standard = Options { trigonometry: Trigonometry::Standard, ..Options::default() };
    let found = compile_with(&module, &[], &standard);
    assert!(matches!(found, Err(Error::Trigonometry)));
    assert!(compile_with(&module, &[("mass", 1.0)], &Options::default()).is_err());
    let one = Options { functions: Some(vec!["f1".to_owned()]), ..Options::default() };
    let compiled = compile_with(&module, &[], &one).unwrap();
    assert!(matches!(compiled.function("f0"), Err(Error::NotCompiled { .. })));
    assert!(matches!(compiled.function("g"), Err(Error::Module(_))));
    assert_eq!(compiled.registers(), Registers::detect().unwrap());
    // A function that declares fewer inputs than it loads.
    module.functions[0].inputs.clear();
    let options = Options { registers: Some(registers), ..Options::default() };
    assert!(matches!(compile_with(&module, &[], &options), Err(Error::Load { .. })));
}

/// A program whose second half needs all values of the first.
fn wide_program(values: usize) -> Program {
    let mut builder = Builder::new();
    let x = builder.load(Source::Input(0));
    let products: Vec<Value> = (0..values)
        .map(|index| {
            let constant = builder.constant(1.0 + index as f64);
            builder.push(Operation::Mul(x, constant))
        })
        .collect();
    let mut sum = |sum, next: &Value| builder.push(Operation::Add(sum, *next));
    let upwards = products.iter().fold(x, &mut sum);
    let downwards = products.iter().rev().fold(x, &mut sum);
    builder.finish(vec![upwards, downwards])
}

#[test]
fn a_function_without_code_is_interpreted_and_others_are_not() {
    if registers().is_empty() {
        return;
    }
    let mut module = module(1, 2, Size::Small, false);
    module.functions[0].core = wide_program(1 << 17);
    module.functions[0].outputs[0].shape = vec![2];
    assert!(matches!(
        compile_with(&module, &[], &Options::default()),
        Err(Error::Size { function, .. }) if function == "f0"
    ));
    let executable = Executable::new(&module, &[], Trigonometry::Polynomial).unwrap();
    let [long, short] = ["f0", "f1"].map(|name| executable.function(name).unwrap());
    assert!(!long.is_native() && short.is_native());
    let mut found = [0.0; 2];
    long.entries(&vec![1.0; long.input_size()], &mut found).unwrap();
    let numbers = f64::from(1 << 17);
    assert_eq!(found, [1.0 + numbers * (numbers + 1.0) / 2.0; 2]);
}

#[test]
fn code_is_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Compiled<'static>>();
    shared::<crate::Function<'static>>();
}
