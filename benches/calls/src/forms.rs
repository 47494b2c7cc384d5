//! Inverse dynamics of the UR5 over many states: columns, and lanes.

use std::hint::black_box;

use calls::{BATCH, Random, double, single};
use robot_runtime::Lanes;

use crate::timing::nanoseconds;

/// Random columns, one for each joint.
fn columns(random: &mut Random) -> [Vec<f64>; 6] {
    std::array::from_fn(|_| random.array::<BATCH>().to_vec())
}

fn narrow(columns: &[Vec<f64>; 6]) -> [Vec<f32>; 6] {
    columns.each_ref().map(|column| column.iter().map(|number| *number as f32).collect())
}

fn slices<T>(columns: &[Vec<T>; 6]) -> [&[T]; 6] {
    columns.each_ref().map(Vec::as_slice)
}

/// Random states in lanes.
fn lanes(random: &mut Random) -> Vec<[Lanes<f64, 8>; 6]> {
    let mut lane = || Lanes::from_array(random.array::<8>());
    (0..BATCH / 8).map(|_| std::array::from_fn(|_| lane())).collect()
}

/// Measures each form and reports its name and the nanoseconds per state.
pub fn time(report: impl Fn(&'static str, f64)) {
    let mut random = Random::default();
    let per_state = |ns: f64| ns / BATCH as f64;

    let (q, qd, qdd) = (columns(&mut random), columns(&mut random), columns(&mut random));
    let mut tau = columns(&mut random);
    let model = black_box(double::ur5::Model::NOMINAL);
    let ns = nanoseconds(1, |_| {
        let tau = tau.each_mut().map(Vec::as_mut_slice);
        black_box(model.inverse_dynamics_columns(slices(&q), slices(&qd), slices(&qdd), tau));
    });
    report("inverse_dynamics_columns", per_state(ns));

    let (q, qd, qdd, mut tau) = (narrow(&q), narrow(&qd), narrow(&qdd), narrow(&tau));
    let model = black_box(single::ur5::Model::NOMINAL);
    let ns = nanoseconds(1, |_| {
        let tau = tau.each_mut().map(Vec::as_mut_slice);
        black_box(model.inverse_dynamics_columns(slices(&q), slices(&qd), slices(&qdd), tau));
    });
    report("inverse_dynamics_columns_f32", per_state(ns));

    let (q, qd, qdd) = (lanes(&mut random), lanes(&mut random), lanes(&mut random));
    let model = black_box(double::ur5::Model::NOMINAL);
    let ns = nanoseconds(q.len(), |i| {
        black_box(model.inverse_dynamics_generic(&q[i], &qd[i], &qdd[i]));
    });
    report("inverse_dynamics_lanes", ns / 8.0);
}
