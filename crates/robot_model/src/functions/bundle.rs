//! Selections of functions: those generated separately, and bundles of several that share common expressions in one
//! call.

use super::FunctionKind;

/// A selection of functions, each of which is generated separately.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Functions {
    /// The usual functions, if the caller makes no other choice.
    #[default]
    Usual,
    /// All functions that the robot has.
    All,
    /// The given functions. A function that the robot does not have is an error.
    Chosen(Vec<FunctionKind>),
}

impl Functions {
    /// The functions of a list: all of them if the list has the word [`ALL_FUNCTIONS`], else those of its names.
    ///
    /// Returns `None` if the list has both the word and names.
    #[must_use]
    pub fn listed(all: bool, named: Vec<FunctionKind>) -> Option<Functions> {
        match (all, named.is_empty()) {
            (false, _) => Some(Functions::Chosen(named)),
            (true, true) => Some(Functions::All),
            (true, false) => None,
        }
    }
}

/// The word for all functions in a list of functions.
pub const ALL_FUNCTIONS: &str = "all";

/// Several functions that one call computes; common expressions are computed once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bundle {
    /// The name of the bundle, which is also that of the generated function.
    pub name: String,
    /// The functions, in the order of the outputs.
    pub functions: Vec<FunctionKind>,
}

impl Bundle {
    /// The reason why a bundle cannot have the name; `None` if it can.
    ///
    /// The names of functions, names that begin with `jacobian_`, and the word `all` are taken. Names that differ only
    /// in case or underscores count as equal, because a printer of code may name types after bundles. All other names
    /// that occur in generated code give way to the names of bundles.
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

    /// Whether the names of two bundles are too similar: they differ only in case or underscores.
    #[must_use]
    pub fn is_alike(&self, other: &Bundle) -> bool {
        fold(&self.name) == fold(&other.name)
    }
}

fn fold(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}
