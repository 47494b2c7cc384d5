//! Kinetic and potential energy.

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};
use crate::plain;

/// The function for the energies of the links and drives.
pub(super) fn energies<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let (kinetic, potential) = match &derivation.recursion {
        Some(recursion) => (recursion.kinetic_energy(), recursion.potential_energy()),
        None => {
            let matrix = mass_matrix::matrix(derivation);
            (plain::kinetic_energy(derivation, &matrix), plain::potential_energy(derivation))
        }
    };
    let output = |name, doc, value| Output::new(name, doc, "J", vec![], vec![value]);
    derivation.of_kind(
        FunctionKind::Energies,
        &["Kinetic energy ½ q̇ᵀ M q̇, including the drives' reflected inertias, and potential \
            energy of gravity, −Σ m g · c with the centers of mass c in the base frame: zero if \
            all mass is at the origin of the base frame. Its gradient is g(q)."],
        vec![
            output("kinetic", "Kinetic energy", kinetic),
            output("potential", "Potential energy", potential),
        ],
    )
}
