//! The options of readers.

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

/// The options of reading a file: errors that become warnings, and values that the file does not have.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Lets moving links have no mass; the errors become warnings.
    pub allow_massless: bool,
    /// Takes masses and inertias that no body can have; the errors become warnings.
    pub allow_unphysical: bool,
    /// Takes the friction of joints in URDF: damping as viscous, friction as constant dry friction. Without
    /// this it is left out of the robot.
    pub friction: bool,
    /// Values of parameters in place of the nominal ones; every check uses these. Names that are not
    /// the robot's parameters have no effect.
    pub values: Vec<(String, Rational)>,
}

impl Options {
    /// The value of a parameter in place of its nominal one.
    pub(super) fn value(&self, parameter: &str) -> Option<&Rational> {
        self.values.iter().find(|(name, _)| name == parameter).map(|(_, value)| value)
    }

    /// The severity of an inertia or a mass that no body can have.
    pub(super) fn unphysical(&self) -> Severity {
        if self.allow_unphysical { Severity::Warning } else { Severity::Error }
    }

    /// The severity of a moving link without mass.
    pub(super) fn massless(&self) -> Severity {
        if self.allow_massless { Severity::Warning } else { Severity::Error }
    }
}
