//! Where sines and cosines come from.

/// Where the sines and cosines of a function's angles come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trigonometry {
    /// The standard library: accurate at any angle. The runtime needs its feature `std`.
    #[default]
    Standard,
    /// The runtime's branch-free polynomials: fast, and without the standard library.
    Polynomial,
}
