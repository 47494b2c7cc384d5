//! The source of sines and cosines.

/// The source of the sines and cosines of a function's angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trigonometry {
    /// The runtime's branch-free polynomials: fast, with the same bits on every machine, and without the
    /// standard library. From 2³⁰ rad on (2¹⁷ rad in `f32`) they give NaN.
    #[default]
    Polynomial,
    /// The standard library: angles of any size. The runtime needs its feature `std`.
    Standard,
}

impl Trigonometry {
    /// The sentence in generated documentation about the range of angles.
    #[must_use]
    pub fn range_of_angles(self) -> &'static str {
        match self {
            Trigonometry::Polynomial => {
                "The magnitude of an angle must be below 2³⁰ = 1073741824 rad (in f32 below 2¹⁷ = \
                 131072 rad): beyond that, the sines and cosines, and everything computed from \
                 them, are NaN. Wrap angles that grow without bound."
            }
            Trigonometry::Standard => {
                "Angles may be of any size: sines and cosines come from the standard library."
            }
        }
    }
}
