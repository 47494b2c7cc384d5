//! WebAssembly modules are valid and stay within the limits of engines. `robot_languages` runs them in Node.js and
//! compares their bits with the interpreter.

use std::collections::BTreeSet;

use robot_codegen::backend::flat::FlatOptions;
use robot_codegen::backend::wasm::Wasm;
use robot_codegen::program::{Builder, Program, Source};
use robot_codegen::{Error, Module, Scalar, Trigonometry};
use wasmparser::{Parser, Payload, Validator, WasmFeatures};

use crate::coverage;

fn bytes(module: &Module, scalar: Scalar, batch: bool) -> Vec<u8> {
    let options = FlatOptions { scalar, ..FlatOptions::default() };
    Wasm { options, batch }.bytes(module).unwrap()
}

/// Checks that a module is valid in the second edition of the standard, which has several results and lanes of 128
/// bits.
fn validate(bytes: &[u8]) {
    Validator::new_with_features(WasmFeatures::WASM2).validate_all(bytes).unwrap();
}

fn exports(bytes: &[u8]) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for payload in Parser::new(0).parse_all(bytes) {
        match payload.unwrap() {
            Payload::ExportSection(section) => {
                names.extend(section.into_iter().map(|export| export.unwrap().name.to_owned()));
            }
            Payload::ImportSection(_) => panic!("nothing is imported"),
            _ => {}
        }
    }
    names
}

/// The number of locals and the bytes of each function.
fn sizes(bytes: &[u8]) -> Vec<(u32, usize)> {
    let mut sizes = vec![];
    for payload in Parser::new(0).parse_all(bytes) {
        if let Payload::CodeSectionEntry(body) = payload.unwrap() {
            let locals = body.get_locals_reader().unwrap().into_iter();
            let count = locals.map(|group| group.unwrap().0).sum();
            let range = body.range();
            sizes.push((count, (range.end - range.start) as usize));
        }
    }
    sizes
}

#[test]
fn every_operation_is_valid_in_both_types() {
    let module = coverage::module("every");
    let names = ["create_model", "heap_base", "memory", "plain", "turned"];
    for scalar in [Scalar::F64, Scalar::F32] {
        let single = bytes(&module, scalar, false);
        validate(&single);
        assert_eq!(exports(&single), names.map(str::to_owned).into());
        let batch = bytes(&module, scalar, true);
        validate(&batch);
        let mut all: BTreeSet<String> = names.map(str::to_owned).into();
        all.extend(["plain_batch", "turned_batch"].map(str::to_owned));
        assert_eq!(exports(&batch), all);
        assert_eq!(batch, bytes(&module, scalar, true), "the same module, the same bytes");
    }
}

/// A program of a number of statements, whose values are alive to the end.
fn long(statements: usize) -> Program {
    let mut b = Builder::new();
    let x = b.load(Source::Input(0));
    let mut values = vec![x];
    for index in 0..statements {
        let constant = b.constant(index as f64 + 0.5);
        let product = b.mul(values[index / 2], constant);
        let value = b.add(product, values[index]);
        values.push(value);
    }
    b.finish(values)
}

#[test]
fn long_functions_are_cut_where_engines_have_limits() {
    let mut module = coverage::module("long");
    let core = long(60_000);
    module.functions.truncate(1);
    module.functions[0].outputs[0].shape = vec![core.results().len()];
    module.functions[0].core = core;
    let bytes = bytes(&module, Scalar::F64, true);
    validate(&bytes);
    let sizes = sizes(&bytes);
    assert!(sizes.len() > 100, "{}", sizes.len());
    for (locals, size) in sizes {
        // https://webassembly.github.io/spec/js-api/index.html#limits
        assert!(locals < 50_000 && size < 7_654_321, "{locals} locals, {size} bytes");
    }
}

#[test]
fn what_webassembly_does_not_have_is_refused() {
    let module = coverage::module("every");
    let options = FlatOptions { trigonometry: Trigonometry::Standard, ..FlatOptions::default() };
    let errors = Wasm { options, batch: false }.bytes(&module).unwrap_err();
    assert!(matches!(errors.as_slice().first(), Some(Error::Trigonometry { .. })), "{errors}");
}
