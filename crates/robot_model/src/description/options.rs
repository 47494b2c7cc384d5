//! The options of readers.

use robot_symbolic::Rational;

use crate::diagnostic::Severity;

/// The format of a robot file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The format of this project, in TOML.
    Toml,
    /// URDF, the format of ROS, in XML.
    Urdf,
}

/// The options of reading a file: which errors become warnings, whether friction is read, and values of parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Whether moving links without mass are accepted; the errors become warnings.
    pub allow_massless: bool,
    /// Whether masses and inertias that are physically impossible are accepted; the errors become warnings.
    pub allow_unphysical: bool,
    /// Whether the friction of joints in URDF is read: damping as viscous friction, friction as constant dry friction.
    /// If false, the robot has no friction.
    pub friction: bool,
    /// Values of parameters that replace the nominal ones; all checks use them. Names that are not parameters of the
    /// robot have no effect.
    pub values: Vec<(String, Rational)>,
}

impl Options {
    /// The value that replaces the nominal value of a parameter, if there is one.
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
