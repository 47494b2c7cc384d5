//! Forward dynamics: accelerations from joint torques.

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, walk};

use super::{Derivation, Effects, Function, FunctionKind, Output, inverse_dynamics, mass_matrix};
use crate::economical::Solver;
use crate::matrix::Pivots;

/// Up to this number of coordinates, only the decomposition of M is used, unless pivots may be small. The
/// articulated-body algorithm needs fewer operations only from about ten joints on, and it shares no expressions with
/// other functions of a bundle.
const FEW: usize = 8;
/// Above this number of coordinates, the decomposition of M is not tried, because its operations grow with the third
/// power of the number.
const MANY: usize = 16;

/// The number of iterations that determine the accelerations together with the load-dependent dry friction that they
/// cause. Each iteration multiplies the error by approximately the coefficient of friction.
const FRICTION_ITERATIONS: usize = 8;

/// The function for the solution q̈ of M q̈ = τ − C q̇ − g or, with friction, of M q̈ = τ − C q̇ − g − Q_f.
pub(super) fn forward_dynamics<'g>(
    derivation: &Derivation<'_, 'g>,
    kind: FunctionKind,
) -> Function<'g> {
    let Effects { wrench, friction } = kind.effects();
    let values = match friction {
        true => with_friction(derivation, wrench),
        false => {
            accelerations(derivation, wrench, &derivation.coordinate_symbols(JointVariable::Torque))
        }
    };
    let output = Output::new(
        JointVariable::Acceleration.name(),
        JointVariable::Acceleration.meaning(),
        &derivation.coordinate_unit(JointVariable::Acceleration),
        vec![values.len()],
        values,
    );
    let what = match friction {
        true => FRICTION_DOC,
        false => {
            "Forward dynamics: the accelerations that the joint torques `tau` cause, the \
             solution of M q̈ = τ − C q̇ − g. Friction is not included: subtract it from `tau`."
        }
    };
    let mut function = derivation.of_kind(kind, &[what], vec![output]);
    function.doc.extend(method(derivation));
    function
}

/// The documentation of the method by which a robot's functions solve M q̈ = b, of the digits that may be lost, and of
/// the effect of an invalid pivot.
pub(super) fn method(derivation: &Derivation<'_, '_>) -> Vec<String> {
    let solution = if derivation.recursion_for_small_pivots().is_some() {
        "Uses the articulated-body algorithm: at the nominal parameters the mass matrix is \
         nearly singular in some configurations, where its decomposition would lose digits that this \
         algorithm keeps, above all in wrists."
    } else {
        "Digits are lost if a pivot of the mass matrix (the inertia of a joint with the joints \
         farther out free) is much smaller than the diagonal entry of the joint: as many digits \
         as their ratio has zeros."
    };
    let wrong = match derivation.pivots_known() {
        Pivots::Checked => {
            "There is no branch: if a pivot is not positive and finite (a coordinate that moves \
             no mass in that configuration, a negative inertia), the accelerations that depend on it \
             are NaN."
        }
        Pivots::Positive => {
            "No configuration with a small pivot was found for this robot, and the code does not check \
             for one."
        }
    };
    vec![solution.to_owned(), wrong.to_owned()]
}

/// The documentation of the friction in the function.
const FRICTION_DOC: &str = "Forward dynamics with joint friction, viscous and dry: the \
    accelerations that the joint torques `tau` cause, the solution of M q̈ = τ − C q̇ − g − Q_f. \
    Dry friction uses the sign of the velocity, or its smooth version if the robot file sets \
    `smoothing`; the sign of 0 is 0, so the discontinuous sign does not model stiction. \
    Load-dependent friction depends on q̈ itself: starting from q̈ without it, eight iterations \
    use the friction of the previous one, and each reduces the error by about a factor of the \
    friction coefficient. Without load-dependent friction the result is exact.";

/// The accelerations q̈ with friction, for the symbols τ.
fn with_friction<'g>(derivation: &Derivation<'_, 'g>, wrench: bool) -> Vec<Expr<'g>> {
    let graph = derivation.mechanism.graph;
    let tau = derivation.coordinate_symbols(JointVariable::Torque);
    let friction = inverse_dynamics::friction_forces(&derivation.mechanism, wrench);
    let by_load = derivation.mechanism.links.iter().any(|link| !link.friction.coulomb.is_zero());
    let iterations = if by_load { FRICTION_ITERATIONS } else { 1 };
    let mut found = match by_load {
        true => accelerations(derivation, wrench, &tau),
        false => tau.clone(),
    };
    for _ in 0..iterations {
        let value = |name: &str| {
            let (variable, coordinate) = JointVariable::parse(name)?;
            found.get(coordinate).copied().filter(|_| variable == JointVariable::Acceleration)
        };
        let friction = walk::rebuild(&friction, graph, |name| {
            value(name).unwrap_or_else(|| graph.symbol(name))
        });
        let driving: Vec<Expr<'g>> =
            tau.iter().zip(friction).map(|(tau, friction)| *tau - friction).collect();
        found = accelerations(derivation, wrench, &driving);
    }
    found
}

/// The accelerations q̈ for the joint torques `tau` without friction, by the solver that needs fewer operations.
fn accelerations<'g>(
    derivation: &Derivation<'_, 'g>,
    wrench: bool,
    tau: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let coordinates = derivation.mechanism.degrees_of_freedom;
    if let Some(values) = by_small_pivots(derivation, wrench, tau) {
        return values;
    }
    let articulated = match &derivation.recursion {
        Some(recursion) if coordinates > FEW => {
            let pivots = derivation.pivots_known();
            recursion.forward_dynamics(tau, wrench, Solver::ArticulatedBodies, pivots)
        }
        _ => None,
    };
    match articulated {
        Some(values) if coordinates > MANY => values,
        Some(values) => {
            let by_matrix = by_matrix(derivation, wrench, tau);
            let cost = |values: &[Expr<'g>]| derivation.operations(values).flops();
            if cost(&values) < cost(&by_matrix) { values } else { by_matrix }
        }
        None => by_matrix(derivation, wrench, tau),
    }
}

/// The accelerations q̈ for the joint torques `tau` if pivots of M may be small; `None` otherwise.
fn by_small_pivots<'g>(
    derivation: &Derivation<'_, 'g>,
    wrench: bool,
    tau: &[Expr<'g>],
) -> Option<Vec<Expr<'g>>> {
    let recursion = derivation.recursion_for_small_pivots()?;
    recursion.forward_dynamics(tau, wrench, Solver::SmallPivots, Pivots::Checked)
}

/// The accelerations q̈ for the symbols τ in derivatives, which solve M x = b for many vectors b. They are computed by
/// the decomposition of M, unless pivots may be small.
pub(super) fn for_derivatives<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    let tau = derivation.coordinate_symbols(JointVariable::Torque);
    let careful = by_small_pivots(derivation, false, &tau);
    careful.unwrap_or_else(|| by_matrix(derivation, false, &tau))
}

/// Solves M x = b for several vectors b, each ordered by coordinates.
pub(super) fn solve_all<'g>(
    derivation: &Derivation<'_, 'g>,
    right: Vec<Vec<Expr<'g>>>,
) -> Vec<Vec<Expr<'g>>> {
    match derivation.recursion_for_small_pivots() {
        Some(recursion) => right.iter().map(|side| recursion.solve_articulated(side)).collect(),
        None => mass_matrix::matrix(derivation).solve_all(right, derivation.pivots_known()),
    }
}

/// The pivots D of M = Lᵀ D L, ordered by coordinates, as forward dynamics uses them. Where it chooses by the number of
/// operations, they are those of M, which equal the other ones up to rounding.
pub(super) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    let small = derivation.recursion_for_small_pivots();
    let small = small.and_then(|recursion| recursion.pivots(Solver::SmallPivots));
    let long = || {
        let is_long = derivation.mechanism.degrees_of_freedom > MANY;
        let recursion = derivation.recursion.as_ref().filter(|_| is_long);
        recursion.and_then(|recursion| recursion.pivots(Solver::ArticulatedBodies))
    };
    small.or_else(long).unwrap_or_else(|| mass_matrix::matrix(derivation).pivots(Pivots::Checked))
}

/// The accelerations q̈ for the joint torques `tau`, by the decomposition of M.
fn by_matrix<'g>(derivation: &Derivation<'_, 'g>, wrench: bool, tau: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let pivots = derivation.pivots_known();
    let recursion = derivation.recursion.as_ref();
    let by_recursion = recursion
        .and_then(|recursion| recursion.forward_dynamics(tau, wrench, Solver::MassMatrix, pivots));
    by_recursion.unwrap_or_else(|| {
        let bias = derivation.paper_torques(wrench, &[JointVariable::Acceleration]);
        let excess = tau.iter().zip(bias).map(|(tau, bias)| *tau - bias).collect();
        mass_matrix::matrix(derivation).solve(excess, pivots)
    })
}
