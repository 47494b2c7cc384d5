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
    "model_init",
    "nominal",
    // Classes in C++.
    "Model",
    "Parameters",
];

/// The names of a module's items, which begin with the name of the module. Names of items for internal use end with an
/// underscore, with which no name in a robot file ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    prefix: String,
}

impl Names {
    /// Makes the names of a module.
    #[must_use]
    pub fn new(module: &str) -> Names {
        Names { prefix: module.to_owned() }
    }

    /// The name of an item: `ur5_gravity`.
    #[must_use]
    pub fn item(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix)
    }

    /// The name of an item for internal use: `ur5_sin_cos_`.
    #[must_use]
    pub fn private(&self, name: &str) -> String {
        format!("{}_{name}_", self.prefix)
    }

    /// The name of a macro: `UR5_DOF`.
    #[must_use]
    pub fn upper(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix).to_ascii_uppercase()
    }

    /// The name of a macro for internal use: `UR5_INLINE_`.
    pub(super) fn private_upper(&self, name: &str) -> String {
        self.private(name).to_ascii_uppercase()
    }
}
