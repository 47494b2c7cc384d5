//! Conversions between states, with one array for each state, and lanes, with one state in each lane.

use super::lanes::Lanes;
use super::scalar::Scalar;

/// Converts states to lanes: lane n of entry d is coordinate d of state n.
#[inline(always)]
pub fn lanes_from_states<T: Scalar, const D: usize, const N: usize>(
    states: &[[T; D]; N],
) -> [Lanes<T, N>; D] {
    core::array::from_fn(|d| Lanes::from_array(core::array::from_fn(|n| states[n][d])))
}

/// The inverse of [`lanes_from_states`].
#[inline(always)]
pub fn states_from_lanes<T: Scalar, const D: usize, const N: usize>(
    lanes: &[Lanes<T, N>; D],
) -> [[T; D]; N] {
    let lanes = lanes.map(Lanes::to_array);
    core::array::from_fn(|n| core::array::from_fn(|d| lanes[d][n]))
}

/// Returns the first `N` states, padded with zeros, for the remainder of a slice that is processed in blocks of `N`.
#[inline(always)]
pub fn padded_states<T: Scalar, const D: usize, const N: usize>(states: &[[T; D]]) -> [[T; D]; N] {
    let mut block = [[T::ZERO; D]; N];
    for (to, from) in block.iter_mut().zip(states) {
        *to = *from;
    }
    block
}
