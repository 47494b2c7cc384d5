//! Which columns depend on others at seeded states: if joints share a coordinate, fewer parameters are identifiable than
//! with a coordinate for each joint; while joints move, dry friction can be confused with gravity.

use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Number, Random, Rational, SymbolId, walk};

use super::columns::base_columns;
use super::regroup::{Kept, add};
use super::scalar::Scalar;
use super::standard::{Quantity, StandardParameter};
use super::{BaseParameter, BaseParameters};
use crate::derivation::Derivation;

/// The seed of the states.
const SEED: u64 = 19_900_402;
/// A column is dependent on others if its residual is below this fraction of its norm.
const DEPENDENT: f64 = 1e-9;
/// Coefficients below this value are taken as rounding errors of 0.
const ROUNDING: f64 = 1e-10;
/// Coefficients above this value belong to a dependence that is named.
const INVOLVED: f64 = 1e-6;

/// The kept parameters without those whose columns at seeded states depend on the columns of others.
pub(super) fn reduced<'g>(derivation: &Derivation<'_, 'g>, kept: &[Kept<'g>]) -> Vec<Kept<'g>> {
    let places: Vec<usize> = kept.iter().map(|(column, _)| *column).collect();
    let mut found: Vec<Kept<'g>> = vec![];
    for (one, dependence) in kept.iter().zip(dependences(&sampled(derivation, &places, true))) {
        let Some(coefficients) = dependence else {
            found.push(one.clone());
            continue;
        };
        for (place, coefficient) in coefficients.into_iter().enumerate() {
            if coefficient.abs() > ROUNDING {
                let coefficient = derivation.mechanism.graph.number(Number::real(coefficient));
                add(&mut found[place].1, &one.1, Scalar::new(coefficient));
            }
        }
    }
    found
}

/// Base parameters that rows with all joints in motion do not separate, as places in [`BaseParameters::base`]: those of
/// a slide along which gravity is constant, with a drive and constant dry friction. The friction offset of a joint with
/// dry friction, which is confused with it in the same way, is left out.
///
/// The columns are taken at seeded states, at the nominal values of the parameters.
#[must_use]
pub fn inseparable<'g>(
    derivation: &Derivation<'_, 'g>,
    parameters: &BaseParameters<'g>,
) -> Vec<Vec<usize>> {
    let base = &parameters.base;
    let has = |link: usize, quantity: Quantity| {
        base.iter().any(|one| one.kept == StandardParameter { link, quantity })
    };
    let is_dry =
        |link| has(link, Quantity::ForwardFriction) && has(link, Quantity::BackwardFriction);
    let links = derivation.mechanism.links.iter().enumerate();
    let mut slides = links.filter(|(_, link)| link.kind == JointKind::Prismatic);
    if !slides.any(|(link, _)| is_dry(link) && has(link, Quantity::ReflectedInertia)) {
        return vec![];
    }
    let is_offset =
        |one: &BaseParameter<'_>| one.kept.quantity == Quantity::Offset && is_dry(one.kept.link);
    let places: Vec<usize> = (0..base.len()).filter(|place| !is_offset(&base[*place])).collect();
    let columns: Vec<usize> = places.iter().map(|place| base[*place].column).collect();
    let sampled = sampled(derivation, &columns, false);
    if !sampled.iter().flatten().all(|entry| entry.is_finite()) {
        return vec![];
    }
    let (mut independent, mut groups) = (vec![], vec![]);
    for (place, dependence) in places.into_iter().zip(dependences(&sampled)) {
        let Some(coefficients) = dependence else {
            independent.push(place);
            continue;
        };
        let involved = independent.iter().zip(coefficients);
        let involved = involved.filter(|(_, coefficient)| coefficient.abs() > INVOLVED);
        groups.push(involved.map(|(place, _)| *place).chain([place]).collect());
    }
    groups
}

/// For each column, `None` if it is independent of those before it, or else its coefficients in the independent ones.
fn dependences(columns: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
    let mut basis: Vec<Vec<f64>> = vec![];
    let mut triangle: Vec<Vec<f64>> = vec![];
    let of_column = |column: &Vec<f64>| {
        let (rest, projections) = orthogonal(column, &basis);
        let length = norm(&rest);
        if length > DEPENDENT * norm(column) {
            triangle.push(projections.into_iter().chain([length]).collect());
            basis.push(rest.iter().map(|entry| entry / length).collect());
            return None;
        }
        Some(solved(&triangle, projections))
    };
    columns.iter().map(of_column).collect()
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
fn orthogonal(column: &[f64], basis: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
    let (mut rest, mut projections) = (column.to_vec(), vec![0.0; basis.len()]);
    for _ in 0..2 {
        for (unit, projection) in basis.iter().zip(&mut projections) {
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

/// The given columns at enough states to distinguish them. Either a few of the states are at rest and all parameters
/// have random values, or joints move in all states and parameters have their nominal values, if the file gives them.
fn sampled(derivation: &Derivation<'_, '_>, kept: &[usize], rests: bool) -> Vec<Vec<f64>> {
    let graph = derivation.mechanism.graph;
    let all = base_columns(derivation);
    let rows = derivation.mechanism.degrees_of_freedom;
    let entries: Vec<Expr<'_>> = kept.iter().flat_map(|column| all[*column].clone()).collect();
    let states = 3 * kept.len() / rows.max(1) + 12;
    let mut random = Random::new(SEED);
    let mut columns = vec![vec![]; kept.len()];
    // Parameters on which no coefficient depends, such as the widths of smooth signs, also get random values.
    let mut values: Vec<f64> =
        (0..graph.symbol_count()).map(|_| random.uniform(0.5, 1.5)).collect();
    let place = |name: &str| Some(graph.find_symbol(name)?.as_symbol()?.index());
    for parameter in derivation.robot.parameters.iter().filter(|_| !rests) {
        let value = parameter.value.as_ref().map(Rational::to_f64);
        if let Some((place, value)) = place(&parameter.name).zip(value) {
            values[place] = value;
        }
    }
    for state in 0..states {
        for (variable, size) in JointVariable::MOTION.into_iter().zip([3.0, 2.0, 5.0]) {
            for name in variable.symbols(rows) {
                let rests = rests && variable == JointVariable::Velocity && state % 6 == 0;
                let value = if rests { 0.0 } else { random.uniform(-size, size) };
                if let Some(place) = place(&name) {
                    values[place] = value;
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
