//! Functions of a bundle that are computed from other functions of the bundle, if this needs fewer operations.

use robot_model::variable::JointVariable;
use robot_symbolic::Expr;

use super::{Derivation, Effects, Function, FunctionKind};
use crate::matrix::SymmetricMatrix;

/// An alternative derivation of a function's first output from other functions; `None` if the bundle does not contain
/// one of them.
type Reuse = for<'g> fn(&Derivation<'_, 'g>, &[Function<'g>]) -> Option<Vec<Expr<'g>>>;

/// The alternatives, in an order in which each one only uses functions whose form is already decided.
const REUSES: [(FunctionKind, Reuse); 5] = [
    (FunctionKind::CoriolisMatrix, coriolis_matrix),
    (FunctionKind::Bias, bias),
    (FunctionKind::InverseDynamics(Effects::NONE), inverse_dynamics),
    (FunctionKind::ForwardDynamics(Effects::NONE), forward_dynamics),
    (FunctionKind::Energies, kinetic_energy),
];

/// Applies each alternative that reduces the number of operations of all functions together.
pub(super) fn share<'g>(derivation: &Derivation<'_, 'g>, functions: &mut [Function<'g>]) {
    let mut least = derivation.cost(functions);
    derivatives_in_other_forms(derivation, functions, &mut least);
    for (kind, reuse) in REUSES {
        let Some(mut values) = reuse(derivation, functions) else { continue };
        let Some(index) = functions.iter().position(|one| one.name == kind.name()) else {
            continue;
        };
        swap(functions, index, &mut values);
        let operations = derivation.cost(functions);
        if operations < least {
            least = operations;
        } else {
            swap(functions, index, &mut values);
        }
    }
}

/// Chooses the form of the derivatives of inverse dynamics with which all functions together need the fewest
/// operations. One of the forms shares its wrenches with inverse dynamics.
fn derivatives_in_other_forms<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &mut [Function<'g>],
    least: &mut usize,
) {
    let name = FunctionKind::InverseDynamicsDerivatives.name();
    let (Some(index), Some(recursion)) =
        (functions.iter().position(|one| one.name == name), &derivation.recursion)
    else {
        return;
    };
    for form in recursion.torque_derivatives() {
        let mut other = functions[index].clone();
        for (output, matrix) in other.outputs.iter_mut().zip([form.positions, form.velocities]) {
            output.values = matrix.rows();
        }
        let known =
            std::mem::replace(&mut functions[index], derivation.of_acting_parameters(other));
        let operations = derivation.cost(functions);
        if operations < *least {
            *least = operations;
        } else {
            functions[index] = known;
        }
    }
}

/// Exchanges the values of a function's first output with the given ones.
fn swap<'g>(functions: &mut [Function<'g>], index: usize, values: &mut Vec<Expr<'g>>) {
    if let Some(output) = functions.get_mut(index).and_then(|one| one.outputs.first_mut()) {
        std::mem::swap(&mut output.values, values);
    }
}

/// The values of an output of a function; `None` if the bundle does not contain it.
fn values<'f, 'g>(
    functions: &'f [Function<'g>],
    kind: FunctionKind,
    output: usize,
) -> Option<&'f [Expr<'g>]> {
    let function = functions.iter().find(|function| function.name == kind.name())?;
    Some(&function.outputs.get(output)?.values)
}

/// ½ ∂τ/∂q̇. This is a Coriolis matrix, because C q̇ is a quadratic form in q̇ whose coefficients are the Christoffel
/// symbols.
fn coriolis_matrix<'g>(
    _: &Derivation<'_, 'g>,
    functions: &[Function<'g>],
) -> Option<Vec<Expr<'g>>> {
    let slopes = values(functions, FunctionKind::InverseDynamicsDerivatives, 1)?;
    Some(slopes.iter().map(|slope| *slope / 2).collect())
}

/// The bias torques C q̇ + g, from the Coriolis matrix and the gravity terms.
fn bias<'g>(derivation: &Derivation<'_, 'g>, functions: &[Function<'g>]) -> Option<Vec<Expr<'g>>> {
    let matrix = values(functions, FunctionKind::CoriolisMatrix, 0)?;
    let gravity = values(functions, FunctionKind::Gravity, 0)?;
    Some(sum(&product(matrix, &derivation.coordinate_symbols(JointVariable::Velocity)), gravity))
}

/// The joint torques M q̈ + C q̇ + g, from the mass matrix and the bias torques.
fn inverse_dynamics<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &[Function<'g>],
) -> Option<Vec<Expr<'g>>> {
    let matrix = values(functions, FunctionKind::MassMatrix, 0)?;
    let bias = values(functions, FunctionKind::Bias, 0)?;
    Some(sum(&product(matrix, &derivation.coordinate_symbols(JointVariable::Acceleration)), bias))
}

/// The accelerations q̈, the solution of M q̈ = τ − C q̇ − g.
fn forward_dynamics<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &[Function<'g>],
) -> Option<Vec<Expr<'g>>> {
    if derivation.recursion_for_small_pivots().is_some() {
        return None;
    }
    let rows = values(functions, FunctionKind::MassMatrix, 0)?;
    let bias = values(functions, FunctionKind::Bias, 0)?;
    let mut matrix = SymmetricMatrix::zero(derivation.mechanism.graph, bias.len());
    for (row, entries) in rows.chunks(bias.len().max(1)).enumerate() {
        for (column, entry) in entries.iter().enumerate().skip(row) {
            matrix.set(row, column, *entry);
        }
    }
    let forces = derivation.coordinate_symbols(JointVariable::Torque);
    let excess = forces.iter().zip(bias).map(|(force, bias)| *force - *bias).collect();
    Some(matrix.solve(excess, derivation.pivots_known()))
}

/// The kinetic energy ½ q̇ᵀ M q̇.
fn kinetic_energy<'g>(
    derivation: &Derivation<'_, 'g>,
    functions: &[Function<'g>],
) -> Option<Vec<Expr<'g>>> {
    let matrix = values(functions, FunctionKind::MassMatrix, 0)?;
    let rates = derivation.coordinate_symbols(JointVariable::Velocity);
    let twice = product(&product(matrix, &rates), &rates);
    Some(twice.into_iter().map(|twice| twice / 2).collect())
}

/// The product of a matrix, stored row by row, and a vector.
fn product<'g>(matrix: &[Expr<'g>], vector: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let row = |row: &[Expr<'g>]| row.iter().zip(vector).map(|(a, b)| *a * *b).reduce(|a, b| a + b);
    matrix.chunks(vector.len().max(1)).filter_map(row).collect()
}

fn sum<'g>(left: &[Expr<'g>], right: &[Expr<'g>]) -> Vec<Expr<'g>> {
    left.iter().zip(right).map(|(a, b)| *a + *b).collect()
}
