//! The names of printed C.

/// The names that the printer uses for itself within functions.
pub(super) const TAKEN: &[&str] = &[
    "model",
    "parameters",
    "s",
    "c",
    "angles",
    "live",
    "i",
    "n",
    "stride",
    "with_payload",
    "model_init",
    "nominal",
];

/// The names of a module's items: each begins with the module's. Those that only printed code calls end with an
/// underscore, which no name of a robot file does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    prefix: String,
}

impl Names {
    /// The names of a module.
    #[must_use]
    pub fn new(module: &str) -> Names {
        Names { prefix: module.to_owned() }
    }

    /// `ur5_gravity`
    #[must_use]
    pub fn item(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix)
    }

    /// `ur5_sin_cos_`
    #[must_use]
    pub fn private(&self, name: &str) -> String {
        format!("{}_{name}_", self.prefix)
    }

    /// `UR5_DOF`
    #[must_use]
    pub fn upper(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix).to_ascii_uppercase()
    }

    /// `UR5_INLINE_`
    pub(super) fn private_upper(&self, name: &str) -> String {
        self.private(name).to_ascii_uppercase()
    }
}
