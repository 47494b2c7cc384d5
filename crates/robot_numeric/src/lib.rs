//! The numeric recursive solver: rigid-body dynamics with 6-D spatial vectors, computed in numbers from the start,
//! following R. Featherstone, "Rigid Body Dynamics Algorithms", Springer 2008.
//!
//! It is independent of the symbolic derivations of this project and therefore suitable for checking them: the
//! project's tests compare every generated function with it. It is written for reliability rather than speed.
//!
//! # Conventions
//!
//! - Units are SI, with angles in radians. Frames are right-handed. The acceleration of gravity in the base frame
//!   points down.
//! - The frame of a link is its joint frame ([`Link::placement`] in the frame of the parent), moved by the joint about
//!   or along an axis through its origin.
//! - Inertia tensors are about the center of mass, in the axes of the link frame.
//! - A wrench is the force and moment that a frame exerts on its surroundings ([`Wrench`]).
//! - τ = M(q) q̈ + C(q, q̇) q̇ + g(q), with friction and wrenches only if requested.
//! - q, q̇, q̈ and τ are slices over the coordinates; matrices have one row for each torque or acceleration.
//!
//! # Example
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use robot_numeric::{Joint, Link, Mechanism, Pose};
//!
//! // A pendulum: a point mass of 2 kg, half a meter from a horizontal axis.
//! let bob = Vector3::new(0.5, 0.0, 0.0);
//! let joint = Joint::revolute(Vector3::y(), 0);
//! let link = Link::new(None, Pose::identity(), joint, 2.0, bob, Matrix3::zeros());
//! let pendulum = Mechanism::new(Vector3::new(0.0, 0.0, -9.81), vec![link], vec![])?;
//!
//! let torque = pendulum.inverse_dynamics(&[0.0], &[0.0], &[0.0])?;
//! assert!((torque[0] + 2.0 * 9.81 * 0.5).abs() < 1e-12);
//! # Ok::<(), robot_numeric::NumericError>(())
//! ```

mod coriolis;
mod derivatives;
mod energy;
mod error;
mod forward_dynamics;
mod friction;
mod from_robot;
mod jacobian;
mod kinematics;
mod mass_matrix;
mod mechanism;
mod newton_euler;
mod pose;
pub mod random;
mod regressor;
pub mod robots;
mod scalar;
mod singular;
mod spatial;
mod validate;

pub use derivatives::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
pub use energy::Energies;
pub use error::{Fault, Mismatch, NumericError};
pub use friction::{Friction, Sign};
pub use from_robot::{Evaluation, direction};
pub use kinematics::Placements;
pub use mechanism::{Frame, Joint, JointKind, Link, Mechanism, Wrench};
pub use newton_euler::{LinkDynamics, Loads};
pub use pose::Pose;
pub use regressor::DRIVE_PARAMETERS;
pub use scalar::Number;
