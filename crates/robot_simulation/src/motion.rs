//! Simulated motions.

use std::ops::Range;

use robot_model::variable::JointVariable;

use crate::dynamics::State;
use crate::error::Error;
use crate::program::RobotProgram;
use crate::table::Table;

/// A simulated motion, with one sample for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// The times t in s, in ascending order.
    pub t: Vec<f64>,
    /// The states q and q̇.
    pub states: Vec<State>,
    /// The joint accelerations q̈, in rad/s² or m/s².
    pub qdd: Vec<Vec<f64>>,
    /// The joint torques τ, in N m or N.
    pub tau: Vec<Vec<f64>>,
    /// The number of steps that the integrator took, including rejected ones.
    pub steps: usize,
}

/// The energies of a motion in J, with one sample for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Energies {
    /// The kinetic energy ½ q̇ᵀ M q̇.
    pub kinetic: Vec<f64>,
    /// The potential energy of the weight.
    pub potential: Vec<f64>,
    /// The sum of both.
    pub total: Vec<f64>,
}

impl Motion {
    pub(crate) fn push(&mut self, t: f64, state: State, qdd: Vec<f64>, tau: Vec<f64>) {
        self.t.push(t);
        self.states.push(state);
        self.qdd.push(qdd);
        self.tau.push(tau);
    }

    /// Computes the energies along the motion.
    ///
    /// # Errors
    ///
    /// If the program has another number of coordinates.
    pub fn energies(&self, program: &RobotProgram<'_>) -> Result<Energies, Error> {
        let mut energies = Energies::default();
        for state in &self.states {
            let [kinetic, potential] = program.energies(state)?;
            energies.kinetic.push(kinetic);
            energies.potential.push(potential);
            energies.total.push(kinetic + potential);
        }
        Ok(energies)
    }

    /// The table with the columns t, q1 …, qd1 …, qdd1 …, tau1 …, kinetic, potential, energy.
    #[must_use]
    pub fn table(&self, energies: &Energies) -> Table {
        self.table_of(energies, 0..self.t.len())
    }

    /// [`Motion::table`] with only some of the samples; indices beyond the end are ignored.
    #[must_use]
    pub fn table_of(&self, energies: &Energies, samples: Range<usize>) -> Table {
        let range = samples.start.min(self.t.len())..samples.end.min(self.t.len());
        let states = &self.states[range.clone()];
        let q: Vec<&[f64]> = states.iter().map(|state| state.q.as_slice()).collect();
        let qd: Vec<&[f64]> = states.iter().map(|state| state.qd.as_slice()).collect();
        let mut table = Table::default();
        table.push("t", self.t[range.clone()].to_vec());
        table.push_numbered(JointVariable::Position.name(), &q);
        table.push_numbered(JointVariable::Velocity.name(), &qd);
        table.push_numbered(JointVariable::Acceleration.name(), &self.qdd[range.clone()]);
        table.push_numbered(JointVariable::Torque.name(), &self.tau[range.clone()]);
        table.push("kinetic", energies.kinetic[range.clone()].to_vec());
        table.push("potential", energies.potential[range.clone()].to_vec());
        table.push("energy", energies.total[range].to_vec());
        table
    }
}

/// Whether a column of a table is one of the energies of [`Motion::table`].
#[must_use]
pub fn is_energy(column: &str) -> bool {
    matches!(column, "kinetic" | "potential" | "energy")
}
