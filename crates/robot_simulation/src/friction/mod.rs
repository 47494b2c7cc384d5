//! Dry friction with a sharp sign: which coordinates stick, and what accelerates the others.
//!
//! Between two events each coordinate has a [`Mode`], and under given modes the equations are smooth
//! ([`balance`]). An event is a sliding coordinate that comes to rest, or one at rest of which more is
//! asked than friction can give; then the modes are chosen anew ([`modes`]).

mod balance;
mod modes;

pub(crate) use balance::{Balance, Holding, balance};
pub(crate) use modes::{chosen, starting};

/// The mode of a coordinate until the next event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// Without dry friction that has a sharp sign.
    Free,
    /// In the direction 1 or −1, which its dry friction opposes.
    Sliding(f64),
    /// At rest, held by dry friction.
    Held,
}
