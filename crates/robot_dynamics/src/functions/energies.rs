//! Kinetic and potential energy.

use super::{Derivation, Function, FunctionKind, Output, mass_matrix};
use crate::plain;

/// The energies of the links and drives.
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
        &["Kinetic energy ½ q̇ᵀ M q̇, the drives' reflected inertias included, and potential energy \
           of the weight, −Σ m g · c with the mass centres c in the base frame: zero where all mass \
           is in the base frame's origin. Its gradient is g(q)."],
        vec![
            output("kinetic", "Kinetic energy", kinetic),
            output("potential", "Potential energy", potential),
        ],
    )
}
