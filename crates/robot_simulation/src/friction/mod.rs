//! Dry friction without smoothing: which coordinates stick, and how the others accelerate.
//!
//! Between two events each coordinate has a [`Mode`], and for given modes the equations are smooth ([`balance`]). An
//! event occurs when a sliding coordinate comes to rest, or when the force required to hold one at rest exceeds what
//! its friction can supply; then the modes are chosen again ([`modes`]).

mod balance;
mod modes;

pub(crate) use balance::{Balance, Holding, balance};
pub(crate) use modes::{chosen, starting};

/// The mode of a coordinate until the next event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// Without dry friction, or with smoothed dry friction.
    Free,
    /// Sliding in the direction 1 or −1; dry friction acts against it.
    Sliding(f64),
    /// At rest, held by dry friction.
    Held,
}
