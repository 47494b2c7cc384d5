//! Derivatives of inverse and forward dynamics.

use nalgebra::{Complex, DMatrix};
use robot_model::variable::JointVariable::Acceleration;

use super::{
    error::NumericError,
    mechanism::{Mechanism, Wrench},
    newton_euler::inverse_dynamics,
    scalar::{derivative, step},
};

/// The derivatives of the joint torques τ(q, q̇, q̈), n × n each; row i belongs to τ_i.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDynamicsDerivatives {
    /// ∂τ/∂q.
    pub dq: DMatrix<f64>,
    /// ∂τ/∂q̇.
    pub dqd: DMatrix<f64>,
    /// ∂τ/∂q̈ = M.
    pub dqdd: DMatrix<f64>,
}

/// The derivatives of the accelerations q̈(q, q̇, τ), n × n each; row i belongs to q̈_i.
#[derive(Debug, Clone, PartialEq)]
pub struct ForwardDynamicsDerivatives {
    /// ∂q̈/∂q.
    pub dq: DMatrix<f64>,
    /// ∂q̈/∂q̇.
    pub dqd: DMatrix<f64>,
    /// ∂q̈/∂τ = M⁻¹.
    pub dtau: DMatrix<f64>,
}

impl Mechanism {
    /// The derivatives of [`Mechanism::inverse_dynamics`], without friction, with wrenches that are constant in the
    /// axes of their frames (one for each frame, or none at all). They are as exact as the torques, because complex
    /// steps are propagated through the same recursion instead of taking differences.
    ///
    /// # Errors
    ///
    /// [`NumericError::Lengths`] if an argument has the wrong length.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        wrenches: &[Wrench],
    ) -> Result<InverseDynamicsDerivatives, NumericError> {
        self.check_state(q, qd, (Acceleration.name(), qdd), wrenches)?;
        let torques = |q: &[Complex<f64>], qd: &[Complex<f64>]| {
            inverse_dynamics(self, q, qd, &plain(qdd), wrenches)
        };
        let n = self.coordinates();
        Ok(InverseDynamicsDerivatives {
            dq: columns(n, |k| torques(&step(q, k), &plain(qd))),
            dqd: columns(n, |k| torques(&plain(q), &step(qd, k))),
            dqdd: self.mass_matrix(q)?,
        })
    }

    /// The derivatives of [`Mechanism::forward_dynamics`], with wrenches as for
    /// [`Mechanism::inverse_dynamics_derivatives`]: ∂q̈/∂x = −M⁻¹ ∂τ/∂x at the accelerations that the torques cause (J.
    /// Carpentier, N. Mansard, "Analytical Derivatives of Rigid Body Dynamics Algorithms", RSS 2018). Their accuracy is
    /// limited by the condition number of M.
    ///
    /// # Errors
    ///
    /// The errors of [`Mechanism::forward_dynamics`].
    pub fn forward_dynamics_derivatives(
        &self,
        q: &[f64],
        qd: &[f64],
        tau: &[f64],
        wrenches: &[Wrench],
    ) -> Result<ForwardDynamicsDerivatives, NumericError> {
        let qdd = self.forward_dynamics(q, qd, tau, wrenches)?;
        let inverse = self.inverse_dynamics_derivatives(q, qd, qdd.as_slice(), wrenches)?;
        let mass = self.decomposed_mass_matrix(q)?;
        Ok(ForwardDynamicsDerivatives {
            dq: -mass.solve(&inverse.dq),
            dqd: -mass.solve(&inverse.dqd),
            dtau: mass.inverse(),
        })
    }
}

fn plain(numbers: &[f64]) -> Vec<Complex<f64>> {
    numbers.iter().map(|&x| Complex::new(x, 0.0)).collect()
}

/// The matrix of derivatives; `stepped` computes the results of a complex step on one coordinate.
fn columns(n: usize, stepped: impl Fn(usize) -> Vec<Complex<f64>>) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(n, n);
    for k in 0..n {
        for (row, result) in stepped(k).into_iter().enumerate() {
            matrix[(row, k)] = derivative(result);
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forward_dynamics::articulated_body;
    use crate::random::{Random, Recipe};

    /// An independent computation of the derivatives: complex steps through the articulated-body algorithm.
    #[test]
    fn forward_derivatives_agree_with_steps_through_the_articulated_body_algorithm() {
        for seed in 0..40 {
            let mut random = Random::new(seed);
            let recipe =
                Recipe { branching: seed % 2 == 1, ..Recipe::serial(1 + seed as usize % 8) };
            let mechanism = random.mechanism(&recipe);
            let state = random.state(&mechanism);
            let (q, qd, tau, wrenches) = (&state.q, &state.qd, &state.tau, &state.wrenches);
            let found = mechanism.forward_dynamics_derivatives(q, qd, tau, wrenches).unwrap();
            let n = mechanism.coordinates();
            let stepped = |which: usize| {
                columns(n, |k| {
                    let place = |slot| if slot == which { k } else { n };
                    let (q, qd, tau) = (step(q, place(0)), step(qd, place(1)), step(tau, place(2)));
                    articulated_body(&mechanism, &q, &qd, &tau, wrenches).unwrap()
                })
            };
            for (which, matrix) in [&found.dq, &found.dqd, &found.dtau].into_iter().enumerate() {
                let expected = stepped(which);
                let error = (matrix - &expected).abs().max() / expected.abs().max().max(1.0);
                assert!(error < 1e-10, "seed {seed}, derivative {which}: {error:e}");
            }
        }
    }
}
