//! Joints that share a coordinate: fewer parameters are identifiable than with a coordinate for each joint.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Number, Random, SymbolId, walk};

use super::columns::base_columns;
use super::regroup::{Kept, add};
use super::scalar::Scalar;
use crate::derivation::Derivation;

/// The seed of the states.
const SEED: u64 = 19_900_402;
/// A column is dependent on others if its residual is below this fraction of its norm.
const DEPENDENT: f64 = 1e-9;
/// Coefficients below this value are taken as rounding errors of 0.
const ROUNDING: f64 = 1e-10;

/// The kept parameters without those whose columns at seeded states depend on the columns of others.
pub(super) fn reduced<'g>(derivation: &Derivation<'_, 'g>, kept: &[Kept<'g>]) -> Vec<Kept<'g>> {
    let columns = sampled(derivation, kept);
    let mut basis: Vec<(usize, Vec<f64>)> = vec![];
    let mut found: Vec<Kept<'g>> = vec![];
    let mut triangle: Vec<Vec<f64>> = vec![];
    for (index, column) in columns.iter().enumerate() {
        let (rest, projections) = orthogonal(column, &basis);
        let size = norm(column);
        if norm(&rest) > DEPENDENT * size {
            let length = norm(&rest);
            triangle.push(projections.into_iter().chain([length]).collect());
            basis.push((index, rest.iter().map(|entry| entry / length).collect()));
            found.push(kept[index].clone());
            continue;
        }
        for (place, coefficient) in solved(&triangle, projections).into_iter().enumerate() {
            if coefficient.abs() > ROUNDING {
                let coefficient = derivation.mechanism.graph.number(Number::real(coefficient));
                add(&mut found[place].1, &kept[index].1, Scalar::new(coefficient));
            }
        }
    }
    found
}

/// Solves R x = `projections`, in which `triangle` contains the columns of R.
fn solved(triangle: &[Vec<f64>], mut projections: Vec<f64>) -> Vec<f64> {
    for (column, entries) in triangle.iter().enumerate().rev() {
        let coefficient = projections[column] / entries[column];
        for (row, entry) in entries.iter().take(column).enumerate() {
            projections[row] -= coefficient * entry;
        }
        projections[column] = coefficient;
    }
    projections
}

/// The residual of `column` and its coefficients in `basis`, by Gram–Schmidt orthogonalization with
/// reorthogonalization.
fn orthogonal(column: &[f64], basis: &[(usize, Vec<f64>)]) -> (Vec<f64>, Vec<f64>) {
    let (mut rest, mut projections) = (column.to_vec(), vec![0.0; basis.len()]);
    for _ in 0..2 {
        for ((_, unit), projection) in basis.iter().zip(&mut projections) {
            let part: f64 = rest.iter().zip(unit).map(|(a, b)| a * b).sum();
            *projection += part;
            for (entry, other) in rest.iter_mut().zip(unit) {
                *entry -= part * other;
            }
        }
    }
    (rest, projections)
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// The columns of the kept parameters at enough states to distinguish them; a few of the states are at rest.
fn sampled<'g>(derivation: &Derivation<'_, 'g>, kept: &[Kept<'g>]) -> Vec<Vec<f64>> {
    let graph = derivation.mechanism.graph;
    let all = base_columns(derivation);
    let rows = derivation.mechanism.degrees_of_freedom;
    let entries: Vec<Expr<'g>> = kept.iter().flat_map(|(column, _)| all[*column].clone()).collect();
    let states = 3 * kept.len() / rows.max(1) + 12;
    let mut random = Random::new(SEED);
    let mut columns = vec![vec![]; kept.len()];
    // Parameters on which no coefficient depends, such as the widths of smooth signs, also get random values.
    let mut values: Vec<f64> =
        (0..graph.symbol_count()).map(|_| random.uniform(0.5, 1.5)).collect();
    for state in 0..states {
        for (variable, size) in JointVariable::MOTION.into_iter().zip([3.0, 2.0, 5.0]) {
            for name in variable.symbols(rows) {
                let rests = variable == JointVariable::Velocity && state % 6 == 0;
                let value = if rests { 0.0 } else { random.uniform(-size, size) };
                let symbol = graph.find_symbol(&name).and_then(Expr::as_symbol);
                if let Some(place) = symbol.and_then(|symbol| values.get_mut(symbol.index())) {
                    *place = value;
                }
            }
        }
        let value = |symbol: SymbolId| values.get(symbol.index()).copied().unwrap_or(f64::NAN);
        let found = walk::evaluate(&entries, value);
        for (column, part) in columns.iter_mut().zip(found.chunks(rows.max(1))) {
            column.extend_from_slice(part);
        }
    }
    columns
}
