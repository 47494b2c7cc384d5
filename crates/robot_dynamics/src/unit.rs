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

impl Dimension {
    /// A pure number or an angle.
    pub const NONE: Dimension = Dimension::new(0, 0, 0);
    /// m/s².
    pub const ACCELERATION: Dimension = Dimension::new(0, 1, -2);
    /// N.
    pub const FORCE: Dimension = Dimension::new(1, 1, -2);
    /// N m.
    pub const MOMENT: Dimension = Dimension::new(1, 2, -2);

    /// kg^`mass` m^`length` s^`time`.
    #[must_use]
    pub const fn new(mass: i8, length: i8, time: i8) -> Dimension {
        Dimension { mass, length, time }
    }
}
