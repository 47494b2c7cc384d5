//! Derivatives of inverse and forward dynamics.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, differentiate, walk};

use super::{Derivation, Function, FunctionKind, Output, forward_dynamics};
use crate::economical::TorqueDerivatives;
use crate::matrix::SquareMatrix;

/// The function for ∂Q/∂q and ∂Q/∂q̇.
pub(super) fn inverse_dynamics<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let TorqueDerivatives { positions, velocities } = cheapest(derivation);
    let output = |name, doc, per, matrix: SquareMatrix<'g>| {
        matrix_output(name, doc, &format!("the unit of tau per {per}"), &matrix)
    };
    derivation.of_kind(
        FunctionKind::InverseDynamicsDerivatives,
        &["The exact partial derivatives of inverse dynamics without friction and wrenches: row \
            i, column j is the derivative of joint torque i with respect to position or velocity \
            j. The derivative with respect to the accelerations is the mass matrix."],
        vec![
            output("dtau_dq", "∂τ/∂q, row by row", "rad or m", positions),
            output("dtau_dqd", "∂τ/∂q̇, row by row", "rad/s or m/s", velocities),
        ],
    )
}

fn matrix_output<'g>(name: &str, doc: &str, unit: &str, matrix: &SquareMatrix<'g>) -> Output<'g> {
    Output::new(name, doc, unit, vec![matrix.order(), matrix.order()], matrix.rows())
}

/// The derivatives by composite quantities in one of their forms, or by forward or reverse differentiation of the
/// torques, whichever needs the fewest operations.
fn cheapest<'g>(derivation: &Derivation<'_, 'g>) -> TorqueDerivatives<'g> {
    let (torques, composite) = match &derivation.recursion {
        Some(recursion) => (recursion.inverse_dynamics(false), recursion.torque_derivatives()),
        None => (derivation.paper_torques(false, &[]), vec![]),
    };
    let symbols: Vec<Expr<'g>> = [JointVariable::Position, JointVariable::Velocity]
        .into_iter()
        .flat_map(|variable| derivation.coordinate_symbols(variable))
        .collect();
    let order = torques.len();
    let split = |rows: Vec<Vec<Expr<'g>>>| {
        let part = |skip: usize| {
            let entries = rows.iter().flat_map(|row| row.iter().skip(skip).take(order).copied());
            SquareMatrix::from_rows(entries.collect(), order)
        };
        TorqueDerivatives { positions: part(0), velocities: part(order) }
    };
    let by_forward = split(differentiate::forward(&torques, &symbols));
    let others = composite
        .into_iter()
        .chain([split(differentiate::reverse(&torques, &symbols)), by_forward.clone()]);
    fewest(derivation, others.collect()).unwrap_or(by_forward)
}

/// The form with the fewest operations; `None` if there are no forms.
pub(super) fn fewest<'g>(
    derivation: &Derivation<'_, 'g>,
    forms: Vec<TorqueDerivatives<'g>>,
) -> Option<TorqueDerivatives<'g>> {
    cheapest_form(forms, |derivatives| cost(derivation, derivatives))
}

fn cost<'g>(derivation: &Derivation<'_, 'g>, derivatives: &TorqueDerivatives<'g>) -> usize {
    let TorqueDerivatives { positions, velocities } = derivatives;
    derivation.operations(&[positions.rows(), velocities.rows()].concat()).flops()
}

/// The form with the lowest cost. The first form, which is relative to the links, is preferred unless another one saves
/// more than a sixty-fourth of its cost: it has more repeated expressions, which later passes over programs eliminate.
fn cheapest_form<T>(forms: impl IntoIterator<Item = T>, cost: impl Fn(&T) -> usize) -> Option<T> {
    let forms = forms.into_iter().enumerate().map(|(index, form)| {
        let cost = cost(&form);
        (if index == 0 { cost - cost / 64 } else { cost }, form)
    });
    forms.min_by_key(|(cost, _)| *cost).map(|(_, form)| form)
}

/// The function for ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ.
pub(super) fn forward_dynamics<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let order = derivation.mechanism.degrees_of_freedom;
    let solved = solutions(derivation);
    let part = |first: usize| {
        let mut part = SquareMatrix::zero(derivation.mechanism.graph, order);
        for (column, entries) in solved.iter().skip(first).take(order).enumerate() {
            for (row, entry) in entries.iter().enumerate() {
                part.add(row, column, *entry);
            }
        }
        part
    };
    let output = |name, doc, per, matrix: SquareMatrix<'g>| {
        matrix_output(name, doc, &format!("the unit of qdd per {per}"), &matrix)
    };
    let mut function = derivation.of_kind(
        FunctionKind::ForwardDynamicsDerivatives,
        &["The exact partial derivatives of forward dynamics without friction and wrenches: row \
            i, column j is the derivative of acceleration i with respect to position, velocity \
            or joint torque j: ∂q̈/∂x = −M⁻¹ ∂τ/∂x at the accelerations that the joint torques \
            cause, and ∂q̈/∂τ = M⁻¹ (J. Carpentier, N. Mansard, RSS 2018)."],
        vec![
            output("dqdd_dq", "∂q̈/∂q, row by row", "rad or m", part(0)),
            output("dqdd_dqd", "∂q̈/∂q̇, row by row", "rad/s or m/s", part(order)),
            output("dqdd_dtau", "∂q̈/∂τ = M⁻¹, row by row", "N m or N", part(2 * order)),
        ],
    );
    function.doc.extend(forward_dynamics::method(derivation));
    function
}

/// The columns of ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ, with the derivatives of the torques in the form that needs the fewest
/// operations.
fn solutions<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Vec<Expr<'g>>> {
    let accelerations = forward_dynamics::for_derivatives(derivation);
    let recursion = derivation.recursion.as_ref();
    let mut forms = recursion
        .map(|recursion| recursion.torque_derivatives_at(&accelerations))
        .unwrap_or_default();
    if forms.is_empty() {
        forms.push(at(derivation, cheapest(derivation), &accelerations));
    }
    let graph = derivation.mechanism.graph;
    let order = accelerations.len();
    let solutions = forms.iter().map(|torques| {
        let negative = |matrix: &SquareMatrix<'g>, column| {
            matrix.column(column).into_iter().map(|entry| -entry).collect()
        };
        let unit = |column| {
            (0..order).map(|row| graph.integer(i64::from(row == column))).collect::<Vec<_>>()
        };
        let sides = (0..order).map(|column| negative(&torques.positions, column));
        let sides = sides.chain((0..order).map(|column| negative(&torques.velocities, column)));
        let sides = sides.chain((0..order).map(unit)).collect();
        forward_dynamics::solve_all(derivation, sides)
    });
    let cost = |solved: &Vec<Vec<Expr<'g>>>| derivation.operations(&solved.concat()).flops();
    cheapest_form(solutions, cost).unwrap_or_default()
}

/// The derivatives with the given accelerations substituted for the symbols q̈.
fn at<'g>(
    derivation: &Derivation<'_, 'g>,
    derivatives: TorqueDerivatives<'g>,
    accelerations: &[Expr<'g>],
) -> TorqueDerivatives<'g> {
    let graph = derivation.mechanism.graph;
    let names = JointVariable::Acceleration.symbols(accelerations.len());
    let replaced = |matrix: &SquareMatrix<'g>| {
        let rows = walk::rebuild(&matrix.rows(), graph, |name| {
            let place = names.iter().position(|qdd| qdd == name);
            place.map_or_else(|| graph.symbol(name), |place| accelerations[place])
        });
        SquareMatrix::from_rows(rows, matrix.order())
    };
    let TorqueDerivatives { positions, velocities } = derivatives;
    TorqueDerivatives { positions: replaced(&positions), velocities: replaced(&velocities) }
}
