//! Rust identifiers that are unique in a scope.

use proc_macro2::{Ident, Span};

use super::keywords::RESERVED;
use crate::backend::common;
use crate::module::Module;

/// The common namer, for Rust.
#[derive(Clone, Debug)]
pub(super) struct Namer(common::Namer);

impl Default for Namer {
    fn default() -> Namer {
        Namer::with(&[])
    }
}

impl Namer {
    /// Makes a namer whose scope already has these names.
    pub(super) fn with(names: &[&str]) -> Namer {
        Namer(common::Namer::new(&[RESERVED], names))
    }

    /// Makes an identifier that is as close to `text` as possible.
    pub(super) fn name(&mut self, text: &str) -> Ident {
        ident(&self.0.name(text))
    }

    /// Makes an identifier for each of several texts; valid identifiers stay as they are.
    pub(super) fn names<'t>(&mut self, texts: impl IntoIterator<Item = &'t str>) -> Vec<Ident> {
        self.0.names(texts).iter().map(|name| ident(name)).collect()
    }

    /// Makes names for the fields of a module's model.
    pub(super) fn fields(&mut self, module: &Module) -> Vec<String> {
        common::field_names(module, &mut self.0)
    }
}

/// Makes the identifier for a name from a namer.
pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// Makes a Rust identifier that is as close to `text` as possible, with ASCII letters, digits and underscores; a
/// reserved word gets an underscore.
#[must_use]
pub fn identifier(text: &str) -> String {
    common::identifier(text, &[RESERVED])
}

/// Makes the name of a type: `link_wrenches` becomes `LinkWrenches`.
pub(super) fn type_name(text: &str) -> String {
    common::type_name(text, &[RESERVED])
}

/// Makes a name from an existing one and a suffix.
pub(super) fn derived(namer: &mut Namer, base: &Ident, suffix: &str) -> Ident {
    namer.name(&format!("{base}_{suffix}"))
}
