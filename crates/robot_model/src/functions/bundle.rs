//! Selections of functions: each by itself, and several in one call that compute common expressions once.

use super::FunctionKind;

/// Which functions are generated, each by itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Functions {
    /// The usual ones, if nothing else is said.
    #[default]
    Usual,
    /// All that the robot has.
    All,
    /// These; one that the robot lacks is an error.
    Chosen(Vec<FunctionKind>),
}

/// The word for all functions if functions are named.
pub const ALL_FUNCTIONS: &str = "all";

/// Functions that one call computes, with their common work done once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// Its name: that of the function that is generated.
    pub name: String,
    /// Its functions, in the order of the outputs.
    pub functions: Vec<FunctionKind>,
}

impl Bundle {
    /// The owner of the name; `None` if a bundle can have it.
    ///
    /// Functions have names, those of frames begin with `jacobian_`, and `all` means all functions. Names that differ
    /// only in case or underscores count as equal: a printer of code may name types after bundles. What other owners
    /// of names yield to bundles.
    #[must_use]
    pub fn owner_of(name: &str) -> Option<&'static str> {
        let folded = fold(name);
        if FunctionKind::ALL.iter().any(|kind| fold(kind.name()) == folded) {
            return Some("the name of a function");
        }
        if name.to_lowercase().starts_with("jacobian_") {
            return Some("a name of the functions of a frame");
        }
        (folded == ALL_FUNCTIONS).then_some("the word for all functions")
    }

    /// Whether two bundles would be confused: their names differ only in case or underscores.
    #[must_use]
    pub fn is_alike(&self, other: &Bundle) -> bool {
        fold(&self.name) == fold(&other.name)
    }
}

fn fold(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}
