//! Units of parameters.

/// A unit as products of powers of the SI base units of mechanics and the radian.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// The text in the file, `kg m^2`.
    pub text: String,
    /// The exponents of kilogram, metre and second; radians are dimensionless.
    pub dimension: Dimension,
}

/// Exponents of kilogram, metre and second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the second.
    pub time: i8,
}
