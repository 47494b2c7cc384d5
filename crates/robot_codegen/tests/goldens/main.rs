//! Tests of the results of committed generated files.
//!
//! `tests/codegen` tests that they equal the current output of the generator.

// Helpers of tests may panic, as tests do.
#![allow(clippy::unwrap_used)]

#[path = "../support/arm.rs"]
mod arm;

use robot_codegen::{Interpreter, Module, Options, Trigonometry};
use robot_runtime::{F64x4, lanes_from_states, states_from_lanes};
use robot_symbolic::Graph;

// Included as users of a build script do it.
include!("planar_arm.rs");

fn compiled(graph: &Graph) -> Module {
    Module::compile(&arm::planar_arm(graph), &Options::default()).unwrap()
}

/// States far from each other, made from multiples of irrational numbers.
fn states() -> Vec<[[f64; 2]; 3]> {
    let entry = |state: usize, input: usize, joint: usize| {
        let turns = (state + 1) as f64 * f64::sqrt([2.0, 3.0, 5.0][input]) * [1.0, 0.7][joint];
        4.0 * turns.fract() - 2.0
    };
    let state = |state| {
        std::array::from_fn(|input| std::array::from_fn(|joint| entry(state, input, joint)))
    };
    (0..21).map(state).collect()
}

#[test]
fn it_computes_what_the_interpreter_computes() {
    let graph = Graph::new();
    let module = compiled(&graph);
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let interpreter = interpreter.with_trigonometry(Trigonometry::Polynomial);
    for [q, qd, qdd] in states() {
        let tau = planar_arm::Model::NOMINAL.inverse_dynamics(&q, &qd, &qdd);
        let inputs: [(&str, &[f64]); 3] = [("q", &q), ("qd", &qd), ("qdd", &qdd)];
        let outputs = interpreter.call("inverse_dynamics", &inputs).unwrap();
        assert_eq!(tau.to_vec(), outputs[0].values);
        let mass = planar_arm::Model::NOMINAL.mass_matrix(&q);
        let outputs = interpreter.call("mass_matrix", &[("q", &q)]).unwrap();
        assert_eq!(mass.m.concat(), outputs[0].values);
        assert_eq!(vec![mass.trace], outputs[1].values);
    }
}

#[test]
fn batches_of_any_length_compute_what_calls_compute() {
    let model = planar_arm::Model::new(&planar_arm::Parameters {
        m2: 2.25,
        ..planar_arm::Parameters::default()
    });
    let states = states();
    let column = |index: usize| states.iter().map(|state| state[index]).collect::<Vec<_>>();
    let (q, qd, qdd) = (column(0), column(1), column(2));
    for length in [0, 1, 7, 8, 9, 21] {
        let mut tau = vec![[0.5; 2]; states.len()];
        let count = model.inverse_dynamics_batch(&q[..length], &qd, &qdd, &mut tau);
        assert_eq!(count, length);
        let (mut m, mut trace) = (vec![[[0.0; 2]; 2]; length], vec![0.0; states.len()]);
        assert_eq!(model.mass_matrix_batch(&q, &mut m, &mut trace), length);
        for (index, [q, qd, qdd]) in states.iter().enumerate() {
            if index < length {
                let single = model.mass_matrix(q);
                assert_eq!(tau[index], model.inverse_dynamics(q, qd, qdd));
                assert_eq!((m[index], trace[index]), (single.m, single.trace));
            } else {
                assert_eq!((tau[index], trace[index]), ([0.5; 2], 0.0));
            }
        }
    }
}

#[test]
fn it_computes_the_closed_form() {
    let parameters = planar_arm::Parameters::NOMINAL;
    let (l1, l2, m1, m2, g) =
        (parameters.l1, parameters.l2, parameters.m1, parameters.m2, parameters.g);
    // Stretched out and at rest, with gravity only, the torques are the moments of the two weights.
    let tau = planar_arm::Model::NOMINAL.inverse_dynamics(&[0.0; 2], &[0.0; 2], &[0.0; 2]);
    let expected = [m1 * g * l1 + m2 * g * (l1 + l2), m2 * g * l2];
    assert!((tau[0] - expected[0]).abs() < 1e-14 && (tau[1] - expected[1]).abs() < 1e-14);
    assert_eq!((planar_arm::DOF, planar_arm::COORDINATES), (2, ["q1", "q2"]));
}

/// The models of four robots in the lanes of one model, and states in lanes: each lane has the bits of a call.
#[test]
fn lanes_have_parameters_of_their_own() {
    let nominal = planar_arm::Parameters::NOMINAL;
    let parameters = [0.0, 1.0, 2.0, 3.0].map(|step| planar_arm::Parameters {
        m2: nominal.m2 + 0.3 * step,
        l1: nominal.l1 - 0.1 * step,
        ..nominal
    });
    let model = planar_arm::Model::new_lanes(&parameters);
    let states = states();
    let [q, qd, qdd] = [0, 1, 2].map(|input| {
        let block: [[f64; 2]; 4] = std::array::from_fn(|lane| states[lane][input]);
        lanes_from_states(&block)
    });
    let tau = states_from_lanes(&model.inverse_dynamics_generic(&q, &qd, &qdd));
    let mass = model.mass_matrix_generic(&q);
    for (lane, [q, qd, qdd]) in states.iter().take(4).enumerate() {
        let single = planar_arm::Model::new(&parameters[lane]);
        assert_eq!(tau[lane], single.inverse_dynamics(q, qd, qdd));
        assert_eq!(mass.m[1][0].to_array()[lane], single.mass_matrix(q).m[1][0]);
    }
    assert_ne!(
        planar_arm::Model::new(&parameters[1]).inverse_dynamics(&[0.5; 2], &[0.0; 2], &[0.0; 2]),
        planar_arm::Model::NOMINAL.inverse_dynamics(&[0.5; 2], &[0.0; 2], &[0.0; 2]),
    );
}

#[test]
fn lanes_compute_what_calls_compute() {
    let model = planar_arm::Model::NOMINAL;
    let states = states();
    let [q, qd, qdd] = [0, 1, 2].map(|input| {
        let block: [[f64; 2]; 4] = std::array::from_fn(|lane| states[lane][input]);
        lanes_from_states(&block)
    });
    let tau = states_from_lanes(&model.inverse_dynamics_generic::<F64x4>(&q, &qd, &qdd));
    let mass = model.mass_matrix_generic(&q);
    for (lane, [q, qd, qdd]) in states.iter().take(4).enumerate() {
        assert_eq!(tau[lane], model.inverse_dynamics(q, qd, qdd));
        let single = model.mass_matrix(q);
        assert_eq!(mass.trace.to_array()[lane], single.trace);
        assert_eq!(mass.m[1][0].to_array()[lane], single.m[1][0]);
    }
}
