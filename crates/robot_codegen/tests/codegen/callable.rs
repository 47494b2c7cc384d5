//! Functions that are looked up once, at one state and at many, compared with calls by name.

use robot_codegen::{Callable, Error, Interpreter, Module, Options, Trigonometry};
use robot_symbolic::{Graph, Random};

use crate::support;
use crate::support::random::{ENTRIES, real};

/// Converts rows of entries to columns.
fn columns(rows: &[Vec<f64>], entries: usize) -> Vec<Vec<f64>> {
    (0..entries).map(|entry| rows.iter().map(|row| row[entry]).collect()).collect()
}

/// Computes all states in columns; returns the results as rows.
fn by_columns(callable: Callable<'_>, inputs: &[Vec<f64>], states: usize) -> Vec<Vec<f64>> {
    let inputs: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
    let mut found = vec![vec![0.0; states]; callable.output_size()];
    let mut slices: Vec<&mut [f64]> = found.iter_mut().map(Vec::as_mut_slice).collect();
    callable.columns(&inputs, &mut slices).unwrap();
    columns(&found, states)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// `compiled.rs` compares calls by name with compiled code.
#[test]
fn many_states_have_the_bits_of_calls_by_name() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let spec = support::random::module(&graph, &mut random, 150);
        let module = Module::compile(&spec, &Options::default()).unwrap();
        let sources = [Trigonometry::Polynomial, Trigonometry::Standard];
        let interpreter = Interpreter::new(&module, &[]).unwrap();
        let interpreter = interpreter.with_trigonometry(sources[seed as usize % 2]);
        let callable = interpreter.function("f").unwrap();
        assert_eq!((callable.input_size(), callable.name()), (2 * ENTRIES, "f"));
        // Numbers of states near the length of a block.
        for states in [0, 1, 15, 16, 17, 50] {
            let mut rows = || -> Vec<Vec<f64>> {
                let row = |_| (0..ENTRIES).map(|_| real(&mut random)).collect();
                (0..states).map(row).collect()
            };
            let (q, v) = (rows(), rows());
            let by_rows = callable.states(states, &[("v", &v), ("q", &q)]).unwrap();
            let inputs = [columns(&q, ENTRIES), columns(&v, ENTRIES)].concat();
            let by_columns = by_columns(callable, &inputs, states);
            assert_eq!((by_rows.len(), by_columns.len()), (states, states));
            for (state, (rows, columns)) in by_rows.iter().zip(&by_columns).enumerate() {
                let given: [(&str, &[f64]); 2] = [("q", &q[state]), ("v", &v[state])];
                let expected = interpreter.call("f", &given).unwrap();
                let expected = bits(&expected[0].values);
                assert_eq!(expected.len(), callable.output_size());
                assert_eq!(bits(rows), expected, "seed {seed}, state {state}");
                assert_eq!(bits(columns), expected, "seed {seed}, state {state}");
                assert_eq!(bits(&callable.call(&given).unwrap()), expected, "seed {seed}");
            }
        }
    }
}

#[test]
fn wrong_columns_and_states_are_told() {
    let graph = Graph::new();
    let module = Module::compile(&support::arm::planar_arm(&graph), &Options::default()).unwrap();
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let callable = interpreter.function("mass_matrix").unwrap();
    let (long, short) = ([0.5; 3], [0.5; 2]);
    let run = |inputs: &[&[f64]], outputs: usize| {
        let mut found = vec![[0.0; 3]; outputs];
        let mut slices: Vec<&mut [f64]> = found.iter_mut().map(|row| &mut row[..]).collect();
        callable.columns(inputs, &mut slices).map_err(|errors| errors.as_slice().to_vec())
    };
    assert_eq!(run(&[&long, &long], 5), Ok(()));
    let found = run(&[&long], 4).unwrap_err();
    assert!(matches!(found[0], Error::Columns { kind: "inputs", expected: 2, found: 1, .. }));
    assert!(matches!(found[1], Error::Columns { kind: "outputs", expected: 5, found: 4, .. }));
    let found = run(&[&long, &short], 5).unwrap_err();
    assert!(matches!(found[..], [Error::States { expected: 3, found: 2, .. }]));
    let states = |rows: &[Vec<f64>]| {
        let found = callable.states(2, &[("q", rows)]);
        found.map_err(|errors| errors.as_slice().to_vec())
    };
    assert!(states(&[vec![0.0; 2], vec![0.0; 2]]).is_ok());
    let found = states(&[vec![0.0; 2]]).unwrap_err();
    assert!(matches!(found[..], [Error::States { expected: 2, found: 1, .. }]));
    let found = states(&[vec![0.0; 2], vec![0.0; 3]]).unwrap_err();
    assert!(matches!(found[..], [Error::InputLength { expected: 2, found: 3, .. }]));
}

/// `cargo test -p robot_codegen --test codegen speed -- --nocapture` prints the time for a log of states.
#[test]
fn speed_of_a_log_of_states() {
    let mut random = Random::new(3);
    let graph = Graph::new();
    let module =
        Module::compile(&support::random::module(&graph, &mut random, 300), &Options::default());
    let module = module.unwrap();
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let callable = interpreter.function("f").unwrap();
    let states = 2000;
    let mut rows = || -> Vec<Vec<f64>> {
        (0..states).map(|_| (0..ENTRIES).map(|_| real(&mut random)).collect()).collect()
    };
    let (q, v) = (rows(), rows());
    let inputs = [columns(&q, ENTRIES), columns(&v, ENTRIES)].concat();
    let start = std::time::Instant::now();
    let pairs = q.iter().zip(&v);
    let named = pairs.map(|(q, v)| interpreter.call("f", &[("q", q), ("v", v)]).unwrap());
    let named: f64 = named.flat_map(|outputs| outputs[0].values.clone()).sum();
    let by_name = start.elapsed();
    let start = std::time::Instant::now();
    let found: f64 = by_columns(callable, &inputs, states).iter().flatten().sum();
    println!("{states} states: {by_name:?} by name, {:?} by columns", start.elapsed());
    assert_eq!(found, named);
}
