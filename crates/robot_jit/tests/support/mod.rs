//! Code that the tests share.

#![allow(dead_code)]

use robot_codegen::Callable;
use robot_jit::{Function, Registers};

/// The registers that this machine has. Empty if it has none for which code is made, so that nothing is compared.
pub(crate) fn registers() -> Vec<Registers> {
    let both = [Registers::Avx2, Registers::Avx512, Registers::Bits128].into_iter();
    both.filter(|registers| registers.check().is_ok()).collect()
}

/// Whether two numbers have equal bits or are both NaN, whose bits depend on the order of operands.
pub(crate) fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Compares all ways to call a function at the states in these columns.
#[track_caller]
pub(crate) fn assert_same_function(
    place: &str,
    expected: Callable<'_>,
    found: Function<'_>,
    columns: &[Vec<f64>],
    states: usize,
) {
    // The number of states of a function without inputs is that of its outputs.
    let inputs: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut outputs = [(); 2].map(|()| vec![vec![0.0; states]; expected.output_size()]);
    let [ours, theirs] = &mut outputs;
    let mut slices: Vec<&mut [f64]> = theirs.iter_mut().map(Vec::as_mut_slice).collect();
    expected.columns(&inputs, &mut slices).unwrap();
    let mut slices: Vec<&mut [f64]> = ours.iter_mut().map(Vec::as_mut_slice).collect();
    found.columns(&inputs, &mut slices).unwrap();
    let mut entries = vec![0.0; inputs.len()];
    let mut single = vec![0.0; theirs.len()];
    for state in 0..states {
        for (entry, column) in entries.iter_mut().zip(columns) {
            *entry = column[state];
        }
        found.entries(&entries, &mut single).unwrap();
        for (entry, value) in single.iter().enumerate() {
            let (lanes, right) = (ours[entry][state], theirs[entry][state]);
            assert!(
                same(lanes, right),
                "{place}: lanes[{entry}] at {state}: {lanes:e} for {right:e}"
            );
            assert!(
                same(*value, right),
                "{place}: single[{entry}] at {state}: {value:e} for {right:e}"
            );
        }
    }
}
