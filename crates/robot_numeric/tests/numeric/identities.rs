//! Quantities that are computed in different ways must agree.

use nalgebra::{Cholesky, DMatrix, DVector};
use robot_numeric::Loads;

use crate::measure::{Worst, cases};

#[test]
fn inverse_dynamics_is_mass_matrix_and_coriolis_matrix_and_gravity() {
    let mut worst = Worst::default();
    for case in cases(120) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let tau = mechanism.inverse_dynamics(q, qd, qdd).unwrap();
        let mass = mechanism.mass_matrix(q).unwrap();
        let bias = mechanism.bias(q, qd).unwrap();
        let gravity = mechanism.gravity_torques(q).unwrap();
        let coriolis = mechanism.coriolis_matrix(q, qd).unwrap();
        let (velocity, acceleration) =
            (DVector::from_column_slice(qd), DVector::from_column_slice(qdd));
        let sum = &mass * acceleration + &bias;
        worst.compare("M a + h", name, sum.as_slice(), tau.as_slice(), 1e-3);
        let sum = coriolis * velocity + gravity;
        worst.compare("C v + g", name, sum.as_slice(), bias.as_slice(), 1.0);
        assert_eq!(mass, mass.transpose(), "{name}: M must be symmetric to the last bit");
    }
    worst.check(|_| 1e-13);
}

#[test]
fn coriolis_matrix_is_that_of_the_christoffel_symbols() {
    let mut worst = Worst::default();
    for case in cases(60) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let velocity = DVector::from_column_slice(&state.qd);
        let coriolis = mechanism.coriolis_matrix(&state.q, &state.qd).unwrap();
        let symbols = mechanism.christoffel_symbols(&state.q).unwrap();
        let n = symbols.len();
        let by_symbols: Vec<DVector<f64>> =
            symbols.iter().map(|symbol| symbol * &velocity).collect();
        let expected = DMatrix::from_fn(n, n, |k, j| by_symbols[k][j]);
        worst.compare("C", name, coriolis.as_slice(), expected.as_slice(), 1.0);
        let slopes = mechanism.mass_matrix_derivatives(&state.q).unwrap();
        let mass_rate = slopes
            .iter()
            .zip(&state.qd)
            .fold(DMatrix::zeros(n, n), |sum: DMatrix<f64>, (slope, rate)| sum + slope * *rate);
        let skew = &mass_rate - coriolis * 2.0;
        let symmetric_part = &skew + skew.transpose();
        let scale = mass_rate.abs().max().max(1.0);
        worst.note("symmetric part of Mdot - 2C", name, symmetric_part.abs().max() / scale);
        let power = (skew * &velocity).dot(&velocity);
        worst.note("v' (Mdot - 2C) v", name, power.abs() / (scale * velocity.norm_squared()));
    }
    worst.check(|_| 1e-13);
}

/// Inverse dynamics of the accelerations from forward dynamics gives the original torques, up to rounding errors of the
/// largest torque involved. The error of the accelerations themselves depends on the condition number of M.
#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    let mut worst = Worst::default();
    for case in cases(120) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let (q, qd, wrenches) = (&state.q, &state.qd, &state.wrenches);
        let loads = Loads { wrenches: wrenches.clone(), friction: false };
        let torques = |qdd: &DVector<f64>| {
            mechanism.inverse_dynamics_with(q, qd, qdd.as_slice(), &loads).unwrap()
        };
        let qdd = DVector::from_column_slice(&state.qdd);
        let tau = torques(&qdd);
        let bias = torques(&DVector::zeros(qdd.len()));
        let scale = tau.amax().max(bias.amax());
        let mut note = |what: &str, found: &DVector<f64>| {
            worst.compare(what, name, torques(found).as_slice(), tau.as_slice(), scale);
            let largest = mechanism.inverse_mass_matrix(q).unwrap().norm() * scale;
            worst.note(what, name, (found - &qdd).amax() / largest);
        };
        let found = mechanism.forward_dynamics(q, qd, tau.as_slice(), wrenches).unwrap();
        note("by the mass matrix", &found);
        if !case.recipe.mimic {
            let found = mechanism.articulated_body(q, qd, tau.as_slice(), wrenches).unwrap();
            note("by articulated bodies", &found);
        }
    }
    worst.check(|_| 1e-13);
}

#[test]
fn kinetic_energy_is_that_of_the_mass_matrix_which_is_positive_definite() {
    let mut worst = Worst::default();
    for case in cases(120) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let mass = mechanism.mass_matrix(&state.q).unwrap();
        let velocity = DVector::from_column_slice(&state.qd);
        let kinetic = mechanism.energies(&state.q, &state.qd).unwrap().kinetic;
        let expected = (&mass * &velocity).dot(&velocity) / 2.0;
        worst.compare("kinetic energy", name, &[kinetic], &[expected], 1e-3);
        let inverse = mechanism.inverse_mass_matrix(&state.q).unwrap();
        let unity = &inverse * &mass - DMatrix::identity(mass.nrows(), mass.ncols());
        worst.note("M M^-1", name, unity.amax() / (mass.norm() * inverse.norm()));
        assert!(Cholesky::new(mass).is_some(), "{name}: M must be positive definite");
    }
    worst.check(|_| 1e-13);
}

#[test]
fn torques_are_linear_in_the_parameters() {
    let mut worst = Worst::default();
    for case in cases(120) {
        let (mechanism, state, name) = (&case.mechanism, &case.state, &case.name);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let tau = mechanism.inverse_dynamics(q, qd, qdd).unwrap();
        let drives = mechanism.drive_regressor(qd, qdd).unwrap();
        let rotors = DVector::from_iterator(
            drives.ncols(),
            mechanism.links().iter().flat_map(|link| [link.rotor_inertia, 0.0, 0.0, 0.0, 0.0]),
        );
        let regressor = mechanism.regressor(q, qd, qdd).unwrap();
        let found = regressor * mechanism.parameters() + drives * rotors;
        worst.compare("Y pi", name, found.as_slice(), tau.as_slice(), 1e-3);
    }
    worst.check(|_| 1e-13);
}
