//! Identities that must hold exactly between the functions of a robot, independently of how each function was derived:
//!
//! | identity | check |
//! |---|---|
//! | M symmetric and positive definite, T = ½ q̇ᵀ M q̇ | `mass_matrix` |
//! | τ = M q̈ + h, h = C q̇ + g | `torques` |
//! | Ṁ − 2 C skew, q̇ᵀ (Ṁ − 2 C) q̇ = 0 | `coriolis_matrix` |
//! | g = ∂V/∂q, d(T + V)/dt = q̇ᵀ τ | `energies` |
//! | forward after inverse dynamics gives q̈; M ∂q̈/∂τ = 1 | `forward_dynamics` |
//! | J from the rates of poses, J̇ q̇ from the rate of J | `jacobians` |
//! | ∂τ/∂q, ∂τ/∂q̇, ∂q̈/∂q, ∂q̈/∂q̇ from τ and q̈ | `derivatives` |
//!
//! Time derivatives are computed by the complex step. Y π = τ is tested in `regressor.rs`, the power balance with
//! wrenches at the tips from poses alone in `power.rs`, and Lagrange's equations as polynomials in `lagrange.rs`.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix, DVector, Matrix3};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::{Effects, FrameRef, FunctionKind};
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::{Expr, Graph};

use robot_testing::complex_step::derivative;
use robot_testing::place::{Layout, Off};
use robot_testing::{evaluate, magnitude, robot_files, with_free_axes};

const STATES: usize = 3;
const TOLERANCE: f64 = 1e-11;

/// The functions that are compared.
const KINDS: [FunctionKind; 12] = [
    FunctionKind::MassMatrix,
    FunctionKind::CoriolisMatrix,
    FunctionKind::Gravity,
    FunctionKind::Bias,
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::ForwardDynamics(Effects::NONE),
    FunctionKind::Energies,
    FunctionKind::FramePoses,
    FunctionKind::Jacobian,
    FunctionKind::JacobianDotQd,
    FunctionKind::InverseDynamicsDerivatives,
    FunctionKind::ForwardDynamicsDerivatives,
];

/// The name of a derivative, its expressions, the expressions that are differentiated, and the entries of the state
/// with respect to which they are.
type Way<'v, 'g> = (&'v str, &'v [Expr<'g>], &'v [Expr<'g>], fn(&mut State) -> &mut Vec<f64>);

/// The functions of a robot in a state.
struct Subject<'r, 'g> {
    name: String,
    robot: &'r Robot,
    outputs: &'r BTreeMap<FunctionKind, Vec<Vec<Expr<'g>>>>,
    state: State,
}

impl<'g> Subject<'_, 'g> {
    /// The outputs of the functions of a kind, one after another.
    fn roots(&self, kind: FunctionKind) -> &[Vec<Expr<'g>>] {
        &self.outputs[&kind]
    }

    /// The first output of a function.
    fn root(&self, kind: FunctionKind) -> &[Expr<'g>] {
        &self.roots(kind)[0]
    }

    fn values(&self, roots: &[Expr<'g>]) -> Vec<f64> {
        evaluate(self.robot, roots, &self.state)
    }

    fn vector(&self, kind: FunctionKind) -> DVector<f64> {
        DVector::from_vec(self.values(self.root(kind)))
    }

    fn matrix(&self, roots: &[Expr<'g>]) -> DMatrix<f64> {
        let values = self.values(roots);
        let order = self.state.q.len();
        DMatrix::from_row_slice(values.len() / order, order, &values)
    }

    /// The rates of the state in which all entries are 0 except those that `set` changes.
    fn rate(&self, set: impl FnOnce(&mut State)) -> State {
        let mut rate = self.state.clone();
        for entries in [&mut rate.q, &mut rate.qd, &mut rate.qdd, &mut rate.tau] {
            entries.fill(0.0);
        }
        rate.wrenches.fill(robot_numeric::Wrench::zero());
        set(&mut rate);
        rate
    }

    /// The time derivatives of values if q changes with the velocity q̇.
    fn in_motion(&self, roots: &[Expr<'g>]) -> Vec<f64> {
        let rate = self.rate(|rate| rate.q.clone_from(&self.state.qd));
        derivative(self.robot, roots, &self.state, &rate)
    }

    /// The derivatives of values with respect to entries of the state, one column for each entry.
    fn slopes(&self, roots: &[Expr<'g>], entries: fn(&mut State) -> &mut Vec<f64>) -> DMatrix<f64> {
        let columns: Vec<DVector<f64>> = (0..self.state.q.len())
            .map(|k| {
                let rate = self.rate(|rate| entries(rate)[k] = 1.0);
                DVector::from_vec(derivative(self.robot, roots, &self.state, &rate))
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    /// Compares a value, one value for each coordinate, or a matrix stored column by column with one row for each
    /// coordinate. The tolerance is relative to `size` or, if that is larger, to the largest value.
    fn assert_agrees(&self, what: &str, found: &[f64], expected: &[f64], size: f64) {
        let rows = self.state.q.len();
        if found.len() < rows {
            return self.assert_rows_agree(what, found, expected, size);
        }
        let by_rows = |values: &[f64]| -> Vec<f64> {
            let columns = values.len() / rows;
            (0..values.len())
                .map(|place| values[place % columns * rows + place / columns])
                .collect()
        };
        let layout = Layout::new(self.robot, what, &[rows, found.len() / rows]);
        self.assert_agrees_as(&layout, &by_rows(found), &by_rows(expected), size);
    }

    /// Compares values whose rows are not coordinates.
    fn assert_rows_agree(&self, what: &str, found: &[f64], expected: &[f64], size: f64) {
        self.assert_agrees_as(
            &Layout::new(self.robot, what, &[1, found.len()]),
            found,
            expected,
            size,
        );
    }

    fn assert_agrees_as(&self, layout: &Layout<'_>, found: &[f64], expected: &[f64], size: f64) {
        let size = magnitude(expected).max(size).max(1e-3);
        let off = Off::of(layout, found, expected, size);
        assert!(off.error <= TOLERANCE, "{}: {off}", self.name);
    }

    fn check(&self) {
        self.mass_matrix();
        self.torques();
        self.coriolis_matrix();
        self.energies();
        self.forward_dynamics();
        self.jacobians();
        self.derivatives();
    }

    fn mass_matrix(&self) {
        let mass = self.matrix(self.root(FunctionKind::MassMatrix));
        assert_eq!(mass, mass.transpose(), "{}: M is not symmetric", self.name);
        assert!(Cholesky::new(mass.clone()).is_some(), "{}: M is not positive definite", self.name);
        let rates = DVector::from_column_slice(&self.state.qd);
        let energy = rates.dot(&(mass * &rates)) / 2.0;
        let kinetic = self.vector(FunctionKind::Energies)[0];
        self.assert_rows_agree("T of M", &[energy], &[kinetic], 0.0);
    }

    fn torques(&self) {
        let mass = self.matrix(self.root(FunctionKind::MassMatrix));
        let coriolis = self.matrix(self.root(FunctionKind::CoriolisMatrix));
        let [gravity, bias, torques] = [
            FunctionKind::Gravity,
            FunctionKind::Bias,
            FunctionKind::InverseDynamics(Effects::NONE),
        ]
        .map(|kind| self.vector(kind));
        let [rates, accelerations] =
            [&self.state.qd, &self.state.qdd].map(|entries| DVector::from_column_slice(entries));
        let inertial = mass * accelerations;
        let (sum, size) = (&inertial + &bias, inertial.amax().max(bias.amax()));
        self.assert_agrees("M q̈ + h", sum.as_slice(), torques.as_slice(), size);
        let wrench_of_unit_rate = coriolis * rates;
        let (sum, size) =
            (&wrench_of_unit_rate + &gravity, wrench_of_unit_rate.amax().max(gravity.amax()));
        self.assert_agrees("C q̇ + g", sum.as_slice(), bias.as_slice(), size);
    }

    fn coriolis_matrix(&self) {
        let order = self.state.q.len();
        let rate = self.in_motion(self.root(FunctionKind::MassMatrix));
        let rate = DMatrix::from_row_slice(order, order, &rate);
        let coriolis = self.matrix(self.root(FunctionKind::CoriolisMatrix));
        let size = rate.amax().max(coriolis.amax());
        let skew = rate - coriolis * 2.0;
        let opposite = -skew.transpose();
        self.assert_agrees("Ṁ − 2 C", skew.as_slice(), opposite.as_slice(), size);
        let rates = DVector::from_column_slice(&self.state.qd);
        let power = rates.dot(&(skew * &rates));
        self.assert_rows_agree("q̇ᵀ (Ṁ − 2 C) q̇", &[power], &[0.0], size * rates.norm_squared());
    }

    fn energies(&self) {
        let energies = self.roots(FunctionKind::Energies).concat();
        let gradient = self.slopes(&energies[1..], |state| &mut state.q);
        let gravity = self.vector(FunctionKind::Gravity);
        self.assert_agrees("∂V/∂q", gradient.as_slice(), gravity.as_slice(), 0.0);
        let rate = self.rate(|rate| {
            rate.q.clone_from(&self.state.qd);
            rate.qd.clone_from(&self.state.qdd);
        });
        let gain: f64 = derivative(self.robot, &energies, &self.state, &rate).iter().sum();
        let torques = self.vector(FunctionKind::InverseDynamics(Effects::NONE));
        let powers = torques.component_mul(&DVector::from_column_slice(&self.state.qd));
        self.assert_rows_agree("d(T + V)/dt", &[gain], &[powers.sum()], powers.abs().sum());
    }

    fn forward_dynamics(&self) {
        let mass = self.matrix(self.root(FunctionKind::MassMatrix));
        let torques = self.vector(FunctionKind::InverseDynamics(Effects::NONE));
        let bias = self.vector(FunctionKind::Bias);
        let driven = State { tau: torques.as_slice().to_vec(), ..self.state.clone() };
        let found =
            evaluate(self.robot, self.root(FunctionKind::ForwardDynamics(Effects::NONE)), &driven);
        // The effect of M⁻¹ on rounding errors of torques depends on the condition number of M.
        let inverse = mass.clone().try_inverse().unwrap();
        let size = inverse.norm() * torques.amax().max(bias.amax());
        self.assert_agrees("q̈ after τ", &found, &self.state.qdd, size);
        let mobility = self.matrix(&self.roots(FunctionKind::ForwardDynamicsDerivatives)[2]);
        let (unity, one) =
            (&mass * &mobility, DMatrix::<f64>::identity(mass.nrows(), mass.nrows()));
        let size = mass.norm() * mobility.norm();
        self.assert_agrees("M ∂q̈/∂τ", unity.as_slice(), one.as_slice(), size);
    }

    fn jacobians(&self) {
        if FunctionKind::FramePoses.missing_in(self.robot).is_some() {
            return;
        }
        let poses = self.roots(FunctionKind::FramePoses);
        let (rotations, positions) = (&poses[0], &poses[1]);
        let jacobians = self.roots(FunctionKind::Jacobian);
        let drifts = self.roots(FunctionKind::JacobianDotQd);
        let frames = FrameRef::usual(self.robot);
        assert_eq!((jacobians.len(), drifts.len()), (frames.len(), frames.len()));
        for (frame, (jacobian, drift)) in frames.into_iter().zip(jacobians.iter().zip(drifts)) {
            // The poses are those of named frames.
            let FrameRef::Named(frame) = frame else { continue };
            let found = self.matrix(jacobian);
            let origin = self.slopes(&positions[3 * frame..][..3], |state| &mut state.q);
            let rotation = &rotations[9 * frame..][..9];
            let turned = Matrix3::from_row_slice(&self.values(rotation)).transpose();
            let turning = self.slopes(rotation, |state| &mut state.q);
            for (k, column) in found.column_iter().enumerate() {
                // Ṙ Rᵀ = [ω]×
                let entries: Vec<f64> = turning.column(k).iter().copied().collect();
                let spin = Matrix3::from_row_slice(&entries) * turned;
                let omega = [spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]];
                let expected = [origin.column(k).as_slice(), &omega].concat();
                self.assert_rows_agree(
                    &format!("J by q{}", k + 1),
                    column.as_slice(),
                    &expected,
                    found.amax().max(1.0),
                );
            }
            let rate = self.in_motion(jacobian);
            let rates = DVector::from_column_slice(&self.state.qd);
            let rate = DMatrix::from_row_slice(6, rates.len(), &rate);
            let (expected, size) = (&rate * &rates, rate.amax() * rates.amax());
            self.assert_rows_agree("J̇ q̇", &self.values(drift), expected.as_slice(), size);
        }
    }

    fn derivatives(&self) {
        let torques = self.root(FunctionKind::InverseDynamics(Effects::NONE));
        let by_torques = self.roots(FunctionKind::InverseDynamicsDerivatives);
        let accelerations = self.root(FunctionKind::ForwardDynamics(Effects::NONE));
        let by_accelerations = self.roots(FunctionKind::ForwardDynamicsDerivatives);
        let ways: [Way<'_, 'g>; 6] = [
            ("∂τ/∂q", torques, &by_torques[0], |state| &mut state.q),
            ("∂τ/∂q̇", torques, &by_torques[1], |state| &mut state.qd),
            ("∂τ/∂q̈", torques, self.root(FunctionKind::MassMatrix), |state| &mut state.qdd),
            ("∂q̈/∂q", accelerations, &by_accelerations[0], |state| &mut state.q),
            ("∂q̈/∂q̇", accelerations, &by_accelerations[1], |state| &mut state.qd),
            ("∂q̈/∂τ", accelerations, &by_accelerations[2], |state| &mut state.tau),
        ];
        for (what, values, derivatives, entries) in ways {
            let expected = self.slopes(values, entries);
            let found = self.matrix(derivatives);
            self.assert_agrees(what, found.as_slice(), expected.as_slice(), 0.0);
        }
    }
}

fn check(robot: &Robot, seed: u64, name: &str) {
    let graph = Graph::new();
    let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
    let outputs = KINDS.into_iter().map(|kind| {
        let outputs = derivation.functions(kind).into_iter().flat_map(|function| function.outputs);
        (kind, outputs.map(|output| output.values).collect())
    });
    let outputs = outputs.collect();
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let mut random = Random::new(seed);
    for _ in 0..STATES {
        let state = random.state(&solver);
        let name = format!("{name}, seed {seed}");
        Subject { name, robot, outputs: &outputs, state }.check();
    }
}

#[test]
fn identities_of_every_robot_file() {
    for (name, text) in robot_files() {
        check(&robot_testing::read(&name, &text), 5, &name);
    }
}

#[test]
fn identities_of_random_chains() {
    for seed in 0..24 {
        let recipe = Recipe::serial(1 + seed as usize % 8);
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "chain");
    }
}

#[test]
fn identities_of_random_trees() {
    for seed in 1000..1024 {
        let joints = 2 + seed as usize % 9;
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "tree");
    }
}

#[test]
fn identities_of_robots_with_parameters_and_with_free_axes() {
    for seed in 2000..2006 {
        let robot = robots::robot(&mut Random::new(seed), &Recipe::tree(1 + seed as usize % 5));
        check(&robots::parameterized(&robot), seed, "parameters");
    }
    for seed in 3000..3004 {
        check(&with_free_axes(seed), seed, "free axes");
    }
}
