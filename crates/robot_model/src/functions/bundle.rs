//! Which functions are wanted: each by itself, and several in one call that shares their work.

use super::FunctionKind;

/// Which functions are generated, each by itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Functions {
    /// The usual ones, where nothing else is said.
    #[default]
    Usual,
    /// All that the robot has.
    All,
    /// These; one that the robot lacks is an error.
    Chosen(Vec<FunctionKind>),
}

/// The word for all functions where functions are named.
pub const ALL_FUNCTIONS: &str = "all";

/// Functions in one call, whose common work is done once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// Its name: that of the function that is generated.
    pub name: String,
    /// Its functions, in the order of the outputs.
    pub functions: Vec<FunctionKind>,
}

impl Bundle {
    /// Whose name it is; `None` where a bundle can bear it.
    ///
    /// Beside the functions themselves there are their forms over sines, scalars and slices, a
    /// function for each frame, and what a module has anyhow. Names that differ in case or underscores
    /// alone are the same here, for the type that holds the outputs is named after the bundle.
    #[must_use]
    pub fn owner_of(name: &str) -> Option<&'static str> {
        const OF_MODULES: [&str; 4] = ["model", "new", "nominal", "withpayload"];
        const FORMS: [&str; 6] = ["_sc", "_angles", "_generic", "_batch", "_block", "_parallel"];
        let lower = name.to_lowercase();
        let folded = fold(name);
        if FunctionKind::ALL.iter().any(|kind| fold(kind.name()) == folded) {
            return Some("the name of a function");
        }
        if lower.starts_with("jacobian_") {
            return Some("a name of the functions of a frame");
        }
        if FORMS.iter().any(|form| lower.ends_with(form)) {
            return Some("a name of the forms of a function");
        }
        let taken = OF_MODULES.contains(&folded.as_str()) || folded == ALL_FUNCTIONS;
        taken.then_some("a name that code has for itself")
    }

    /// Whether two bundles would be confused: their names differ in case or underscores alone.
    #[must_use]
    pub fn is_alike(&self, other: &Bundle) -> bool {
        fold(&self.name) == fold(&other.name)
    }
}

fn fold(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}
