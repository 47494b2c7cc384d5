//! Checks the base parameters: their number is the rank of stacked regressors, and they give the same joint torques.

use nalgebra::DMatrix;
use robot_dynamics::base_parameters::{BaseParameters, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::FunctionKind;
use robot_model::functions::out_of_reach;
use robot_model::robot::{BaseFrames, Robot};
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::{Expr, Formula, Graph, Number, Rational};

use robot_testing::place::{Layout, Off};
use robot_testing::{evaluate, magnitude, read, robot_files, with_free_axes};

const STATES: usize = 6;
const TOLERANCE: f64 = 1e-11;
/// Singular values below this fraction of the largest one indicate dependent columns.
const RANK: f64 = 1e-9;
const OPTIONS: MechanismOptions = MechanismOptions::ROUNDED;

fn output<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Expr<'g>> {
    let [function] = &derivation.functions(kind)[..] else { panic!("one function") };
    let [output] = &function.outputs[..] else { panic!("one output") };
    assert_eq!(output.values.len(), output.shape.iter().product::<usize>());
    output.values.clone()
}

/// States with different speeds, including states at rest.
fn states(random: &mut Random, solver: &robot_numeric::Mechanism, count: usize) -> Vec<State> {
    let slow = |(index, mut state): (usize, State)| {
        let factor = [1.0, 1.0, 0.1, 0.01, 0.0][index % 5];
        state.qd.iter_mut().for_each(|speed| *speed *= factor);
        state
    };
    (0..count).map(|_| random.state(solver)).enumerate().map(slow).collect()
}

/// The rank of a regressor's columns over many states, after each column is scaled to length 1.
fn rank(robot: &Robot, regressor: &[Expr<'_>], states: &[State], label: &str) -> usize {
    let rows = robot.degrees_of_freedom();
    let columns = regressor.len() / rows;
    let entries: Vec<f64> =
        states.iter().flat_map(|state| evaluate(robot, regressor, state)).collect();
    let mut stacked = DMatrix::from_row_slice(rows * states.len(), columns, &entries);
    for mut column in stacked.column_iter_mut() {
        let length = column.norm();
        if length > 1e-12 {
            column /= length;
        } else {
            column.fill(0.0);
        }
    }
    let values = stacked.singular_values();
    let largest = values.max();
    let rank = values.iter().filter(|value| **value > RANK * largest).count();
    let near = |value: &&f64| (1e-12..1e-7).contains(&(**value / largest));
    assert_eq!(values.iter().filter(near).count(), 0, "{label}: no clear rank in {values}");
    rank
}

/// Checks all properties of the base parameters, in both choices of frames.
fn check(robot: &Robot, seed: u64, name: &str) -> usize {
    let [count, others] = BaseFrames::ALL.map(|base_frames| {
        let robot = Robot { base_frames, ..robot.clone() };
        // If a joint axis is a parameter, there are base parameters only in the file's frames.
        out_of_reach(&robot).is_none().then(|| check_set(&robot, seed, name))
    });
    assert!(others.is_none() || others == count, "{name}, seed {seed}: {others:?} in other frames");
    count.unwrap()
}

/// Checks all properties of one set of base parameters.
fn check_set(robot: &Robot, seed: u64, name: &str) -> usize {
    let mut robot = robot.clone();
    for link in &mut robot.links {
        // Friction that depends on the contact force is not linear in the parameters.
        link.friction.coulomb = Formula::number(&Rational::ZERO);
    }
    let label = format!("{name}, seed {seed}, {}", robot.base_frames.name());
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &OPTIONS, None);
    let found = base_parameters(&derivation).unwrap();
    let full = output(&derivation, FunctionKind::Regressor);
    let kept = output(&derivation, FunctionKind::RegressorBase);
    let values = output(&derivation, FunctionKind::BaseParameters);
    let (count, all) = (found.base.len(), found.standard.len());
    assert_eq!([kept.len(), full.len()], [count, all].map(|n| n * robot.degrees_of_freedom()));
    assert_eq!(values.len(), count);

    let mut random = Random::new(seed);
    let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
    let many = states(&mut random, &solver, 3 * count / robot.degrees_of_freedom() + 12);
    assert_eq!(rank(&robot, &full, &many, &label), count, "{label}: the number");

    for state in states(&mut random, &solver, STATES) {
        let (full, kept) = (evaluate(&robot, &full, &state), evaluate(&robot, &kept, &state));
        check_columns(&robot, &found, &state, [&full, &kept], &label);
        let values = evaluate(&robot, &values, &state);
        let loads = robot_numeric::Loads { wrenches: vec![], friction: true };
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let expected = solver.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
        let size = magnitude(&expected).max(1e-3);
        let exact: Vec<Expr<'_>> =
            values.iter().map(|value| graph.number(Number::real(*value))).collect();
        let representative = evaluate(&robot, &found.representative(&exact), &state);
        for (columns, values) in [(&kept, &values), (&full, &representative)] {
            let product = |row: &[f64]| row.iter().zip(values).map(|(y, p)| y * p).sum::<f64>();
            let forces: Vec<f64> = columns.chunks(values.len()).map(product).collect();
            let layout = Layout::per_joint(&robot, "driving forces");
            let off = Off::of(&layout, &forces, expected.as_slice(), size);
            assert!(off.error <= TOLERANCE, "{label}: {off}");
        }
    }
    count
}

/// Checks that each column of the full regressor is the product of the kept columns and the coefficients of its
/// parameter.
fn check_columns(
    robot: &Robot,
    found: &BaseParameters<'_>,
    state: &State,
    [full, kept]: [&[f64]; 2],
    label: &str,
) {
    let size = magnitude(full).max(1e-3);
    let (count, all) = (found.base.len(), found.standard.len());
    let mut coefficients = DMatrix::zeros(count, all);
    for (row, parameter) in found.base.iter().enumerate() {
        for (column, coefficient) in &parameter.terms {
            coefficients[(row, *column)] = evaluate(robot, &[*coefficient], state)[0];
        }
    }
    let kept = DMatrix::from_row_slice(kept.len() / count, count, kept);
    let expected = DMatrix::from_row_slice(kept.nrows(), all, full);
    let (product, expected) = ((kept * coefficients).transpose(), expected.transpose());
    let layout = Layout::new(robot, "columns", &[robot.degrees_of_freedom(), all]);
    let off = Off::of(&layout, product.as_slice(), expected.as_slice(), size);
    assert!(off.error <= TOLERANCE, "{label}: {off}");
}

#[test]
fn base_parameters_of_every_robot_file() {
    let known = [("puma560", 36), ("stanford", 33), ("iiwa", 43), ("panda", 43), ("ur5", 36)];
    for (name, text) in robot_files() {
        let count = check(&read(&name, &text), 5, &name);
        println!("{name}: {count}");
        if let Some((_, expected)) = known.iter().find(|(robot, _)| *robot == name) {
            assert_eq!(count, *expected, "{name}");
        }
    }
}

#[test]
fn base_parameters_of_random_chains() {
    for seed in 0..50 {
        let recipe = Recipe::serial(1 + seed as usize % 7);
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "chain");
    }
}

#[test]
fn base_parameters_of_random_trees_with_drives() {
    for seed in 1000..1050 {
        let joints = 1 + seed as usize % 8;
        let recipe = Recipe { drives: true, fixed: true, ..Recipe::tree(joints) };
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "tree");
    }
}

#[test]
fn base_parameters_where_joints_share_coordinates() {
    for seed in 2000..2020 {
        let joints = 2 + seed as usize % 6;
        let recipe = Recipe { drives: true, mimic: true, ..Recipe::tree(joints) };
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "shared");
    }
}

#[test]
fn shared_coordinates_and_free_axes_are_out_of_reach() {
    let robots: Vec<Robot> = (3000..3010).map(with_free_axes).collect();
    let reached = robots.iter().filter(|robot| out_of_reach(robot).is_none());
    for (seed, robot) in (0..).zip(reached) {
        check(robot, seed, "free axes");
    }
    assert!(robots.iter().any(|robot| out_of_reach(robot).is_some()));
}
