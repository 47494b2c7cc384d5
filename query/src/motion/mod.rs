//! Motions for identification: periodic trajectories, and logs of them with noise.

mod excite;
mod generate;
mod trajectory;

pub use excite::{Excitation, excite};
pub use generate::{Generation, Layout, generate};
pub use trajectory::{Limits, Trajectory, limits};
