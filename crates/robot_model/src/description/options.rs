//! What the caller may ask of a reader.

use robot_symbolic::Rational;

use crate::diagnostic::Severity;

/// The format of a robot file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The project's own, in TOML.
    Toml,
    /// The format of ROS, in XML.
    Urdf,
}

/// How a file is read: what is taken that is an error otherwise, and what it does not say itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Lets moving links have no mass; the errors become warnings.
    pub allow_massless: bool,
    /// Takes masses and inertias that no body can have; the errors become warnings.
    pub allow_unphysical: bool,
    /// Takes the friction of joints in URDF: damping as viscous, friction as constant dry friction. Without
    /// this it is left out of the robot.
    pub friction: bool,
    /// Values of parameters in place of the nominal ones; every check sees these. Names that are none of
    /// the robot's parameters have no effect.
    pub values: Vec<(String, Rational)>,
}

impl Options {
    /// The value of a parameter in place of its nominal one.
    pub(super) fn value(&self, parameter: &str) -> Option<&Rational> {
        self.values.iter().find(|(name, _)| name == parameter).map(|(_, value)| value)
    }

    /// How grave an inertia or a mass is that no body can have.
    pub(super) fn unphysical(&self) -> Severity {
        if self.allow_unphysical { Severity::Warning } else { Severity::Error }
    }

    /// How grave a moving link without mass is.
    pub(super) fn massless(&self) -> Severity {
        if self.allow_massless { Severity::Warning } else { Severity::Error }
    }
}
