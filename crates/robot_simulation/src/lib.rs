//! Motions of robots.
//!
//! [`simulate`] integrates the motion q(t), the forward dynamics (7) of the paper, of any [`Dynamics`]: the program of
//! a robot ([`RobotProgram`]), generated code or a closure. [`torque_contributions`] computes the inverse dynamics
//! along a [`Trajectory`], divided into contributions. Both give values over time, which [`Table`] writes as CSV and
//! [`plot`] draws.
//!
//! ```
//! use robot_simulation::{SimulationOptions, State, Torques, from_fn, simulate};
//!
//! // A pendulum of length 1 m.
//! let pendulum = from_fn(1, |state, tau| vec![tau[0] - 9.81 * state.q[0].sin()]);
//! let start = State { q: vec![0.5], qd: vec![0.0] };
//! let options = SimulationOptions { duration: 2.0, ..SimulationOptions::default() };
//! let motion = simulate(&pendulum, &Torques::none(1), &start, &options, &mut |_| {})?;
//! assert_eq!(motion.t.last(), Some(&2.0));
//! # Ok::<(), robot_simulation::Error>(())
//! ```

mod contributions;
pub mod csv;
mod dynamics;
mod error;
mod events;
mod expressions;
mod features;
mod friction;
mod grid;
mod integration;
mod kinks;
mod limits;
mod motion;
pub mod plot;
mod program;
mod samples;
mod simulation;
mod system;
mod table;
mod torques;
mod trajectory;

pub use contributions::{TorqueContributions, torque_contributions};
pub use dynamics::{DryFriction, Dynamics, Features, State, TorqueLaw, from_fn};
pub use error::{Cause, Error};
pub use motion::{Energies, Motion, is_energy};
pub use program::RobotProgram;
pub use samples::Samples;
pub use simulation::{SimulationOptions, simulate};
pub use table::Table;
pub use torques::Torques;
pub use trajectory::Trajectory;
