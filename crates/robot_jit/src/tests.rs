//! Random functions against the interpreter and a reference, and what code reads and writes.

use iced_x86::{Decoder, DecoderOptions, InstructionInfoFactory, Mnemonic, OpAccess, Register};
use robot_codegen::{Interpreter, Module, Trigonometry};
use robot_symbolic::Random;

use crate::emit::{Entry, Target, emit_lanes, emit_single};
use crate::testing::{module, number, reference};
use crate::{Error, Options, Registers, compile_with};

/// Modules of so many functions each, one half with multiply-adds.
const MODULES: u64 = 250;
const FUNCTIONS: usize = 40;
const STATES: usize = 13;

fn registers() -> Vec<Registers> {
    let both = [Registers::Avx2, Registers::Avx512].into_iter();
    both.filter(|registers| registers.check().is_ok()).collect()
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// The columns of inputs, and for each state the expected outputs.
fn states(
    module: &Module,
    name: &str,
    random: &mut Random,
    fused: bool,
) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let function = module.function(name).unwrap();
    let size = function.inputs[0].symbols.len();
    let rarely = [3, 20, 1000][random.index(3)];
    let rows: Vec<Vec<f64>> =
        (0..STATES).map(|_| (0..size).map(|_| number(random, rarely)).collect()).collect();
    let expected = rows.iter().map(|row| reference(function, row, fused)).collect();
    let columns = (0..size).map(|entry| rows.iter().map(|row| row[entry]).collect()).collect();
    (columns, expected)
}

/// `fused`: the program's multiply-adds round once, and those of sines.
fn compare(module: &Module, registers: Registers, random: &mut Random, fused: [bool; 2]) {
    let [fused, fused_sines] = fused;
    let options = Options { registers: Some(registers), fused: fused_sines, ..Options::default() };
    let compiled = compile_with(module, &[], &options).unwrap();
    let interpreter = Interpreter::new(module, &[]).unwrap();
    for function in &module.functions {
        let place = format!("{} {} {registers:?}", module.name, function.name);
        let (columns, expected) = states(module, &function.name, random, fused_sines);
        let jit = compiled.function(&function.name).unwrap();
        let inputs: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        // A number before and behind each column that nobody may write.
        let mut lanes = vec![vec![7.5; STATES + 2]; jit.output_size()];
        let mut outputs: Vec<&mut [f64]> =
            lanes.iter_mut().map(|column| &mut column[1..=STATES]).collect();
        jit.columns(&inputs, &mut outputs).unwrap();
        for (state, expected) in expected.iter().enumerate() {
            let row: Vec<f64> = columns.iter().map(|column| column[state]).collect();
            let named = [("x", row.as_slice())];
            let mut single = vec![7.5; expected.len() + 2];
            jit.entries(&row, &mut single[1..=expected.len()]).unwrap();
            assert_eq!([single[0], single[expected.len() + 1]], [7.5; 2], "{place}");
            let interpreted = interpreter.function(&function.name).unwrap().call(&named).unwrap();
            for (entry, right) in expected.iter().enumerate() {
                let [one, many] = [single[entry + 1], lanes[entry][state + 1]];
                assert!(same(one, *right), "{place}: [{entry}] is {one:e}, not {right:e}");
                assert!(
                    same(many, *right),
                    "{place}: [{entry}] in lanes is {many:e}, not {right:e}"
                );
                assert!(
                    fused || fused_sines || same(interpreted[entry], *right),
                    "{place}: {right:e}"
                );
            }
        }
        assert!(lanes.iter().all(|column| column[0] == 7.5 && column[STATES + 1] == 7.5));
    }
}

#[test]
fn random_functions_have_the_bits_of_the_reference() {
    for seed in 0..MODULES {
        let fused = seed % 2 == 0;
        let module = module(seed, FUNCTIONS, fused);
        let mut random = Random::new(seed);
        for registers in registers() {
            compare(&module, registers, &mut random, [fused, seed % 5 == 0]);
        }
    }
}

/// `ROBOT_JIT_MODULES=10000 cargo test --release -p robot_jit -- --ignored --nocapture`, of forty functions each, and
/// `ROBOT_JIT_FIRST` the first seed.
#[test]
#[ignore = "takes minutes"]
fn many_random_functions_have_the_bits_of_the_reference() {
    let number = |name: &str| std::env::var(name).ok().map(|number| number.parse().unwrap());
    let first: u64 = number("ROBOT_JIT_FIRST").unwrap_or(MODULES);
    let end = first + number("ROBOT_JIT_MODULES").unwrap_or(10_000);
    for seed in first..end {
        let fused = seed % 2 == 0;
        let module = module(seed, FUNCTIONS, fused);
        let mut random = Random::new(seed);
        for registers in registers() {
            compare(&module, registers, &mut random, [fused, seed % 5 == 0]);
        }
        if (seed + 1 - first).is_multiple_of(100) {
            println!("seeds {first} to {seed}: {} functions", (seed + 1 - first) * 40);
        }
    }
}

/// Decodes code and checks every address that it may touch.
fn check_addresses(entry: &Entry, lanes: usize, place: &str) {
    let mut decoder = Decoder::new(64, &entry.code, DecoderOptions::NONE);
    let mut information = InstructionInfoFactory::new();
    let in_columns = lanes > 1;
    // What the register for pointers to columns points to: inputs or outputs.
    let mut column = Register::None;
    let mut instructions = 0;
    // Long code moves two pointers before it uses them.
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
        let module = module(seed, FUNCTIONS, seed % 2 == 0);
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
    let module = module(3, 1, false);
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
    let module = module(5, 3, false);
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
    let mut module = module(1, 2, false);
    let standard = Options { trigonometry: Trigonometry::Standard, ..Options::default() };
    let found = compile_with(&module, &[], &standard);
    assert!(matches!(found, Err(Error::Trigonometry)));
    assert!(compile_with(&module, &[("mass", 1.0)], &Options::default()).is_err());
    let one = Options { functions: Some(vec!["f1".to_owned()]), ..Options::default() };
    let compiled = compile_with(&module, &[], &one).unwrap();
    assert!(matches!(compiled.function("f0"), Err(Error::NotCompiled { .. })));
    assert!(matches!(compiled.function("g"), Err(Error::Module(_))));
    assert_eq!(compiled.registers(), Registers::detect().unwrap());
    // A function that says to have fewer inputs than it loads.
    module.functions[0].inputs.clear();
    let options = Options { registers: Some(registers), ..Options::default() };
    assert!(matches!(compile_with(&module, &[], &options), Err(Error::Load { .. })));
}

#[test]
fn code_is_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<crate::Compiled<'static>>();
    shared::<crate::Function<'static>>();
}
