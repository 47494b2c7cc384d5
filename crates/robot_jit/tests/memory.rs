//! Memory use over many compilations, in a process of its own.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

use robot_codegen::module::Function;
use robot_codegen::program::{Builder, Operation, Source};
use robot_codegen::{Input, Module, Output};
use robot_jit::{Registers, compile};

/// A module with a function that returns the squared sine of its only input.
fn module() -> Module {
    let mut angles = Builder::new();
    let angle = angles.load(Source::Input(0));
    let mut core = Builder::new();
    let sine = core.load(Source::Sin(0));
    let square = core.push(Operation::Mul(sine, sine));
    let (name, doc, unit) = ("x".to_owned(), String::new(), String::new());
    let output = Output {
        name: name.clone(),
        doc: doc.clone(),
        shape: vec![],
        values: (),
        unit: unit.clone(),
    };
    let function = Function {
        name: "f".to_owned(),
        doc: vec![],
        inputs: vec![Input { name: name.clone(), doc, symbols: vec![name], unit }],
        outputs: vec![output],
        angles: angles.finish(vec![angle]),
        core: core.finish(vec![square]),
        passes: vec![],
        limbs: None,
    };
    Module {
        name: "m".to_owned(),
        doc: vec![],
        parameters: vec![],
        constructor: Builder::new().finish(vec![]),
        functions: vec![function],
    }
}

/// The numbers of resident pages and of mappings of this process.
fn memory() -> [usize; 2] {
    let pages = std::fs::read_to_string("/proc/self/statm").unwrap();
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    [pages.split(' ').nth(1).unwrap().parse().unwrap(), maps.lines().count()]
}

#[test]
fn a_hundred_thousand_compilations_leave_no_memory_behind() {
    if Registers::detect().is_err() {
        return;
    }
    let module = module();
    let compile = || drop(compile(&module, &[]).unwrap());
    (0..1000).for_each(|_| compile());
    let before = memory();
    (0..100_000).for_each(|_| compile());
    let after = memory();
    assert!(after[0] < before[0] + 100 && after[1] < before[1] + 10, "{before:?}, {after:?}");
}
