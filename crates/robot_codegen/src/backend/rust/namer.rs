//! Identifiers of Rust, given once in a scope.

use proc_macro2::{Ident, Span};

use super::keywords::RESERVED;
use crate::backend::common;
use crate::module::Module;

/// The common namer for Rust.
#[derive(Clone, Debug)]
pub(super) struct Namer(common::Namer);

impl Default for Namer {
    fn default() -> Namer {
        Namer::with(&[])
    }
}

impl Namer {
    /// A namer whose scope already has some names.
    pub(super) fn with(names: &[&str]) -> Namer {
        Namer(common::Namer::new(RESERVED, names))
    }

    /// An identifier as near to `text` as can be.
    pub(super) fn name(&mut self, text: &str) -> Ident {
        ident(&self.0.name(text))
    }

    /// An identifier for each of several texts; valid identifiers stay as they are.
    pub(super) fn names<'t>(&mut self, texts: impl IntoIterator<Item = &'t str>) -> Vec<Ident> {
        self.0.names(texts).iter().map(|name| ident(name)).collect()
    }

    /// Names for the fields of a module's model.
    pub(super) fn fields(&mut self, module: &Module) -> Vec<String> {
        common::field_names(module, &mut self.0)
    }
}

/// The identifier of a name that a namer gave.
pub(super) fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// An identifier of Rust as near to `text` as can be: ASCII letters, digits and underscores; a reserved word gets an
/// underscore.
#[must_use]
pub fn identifier(text: &str) -> String {
    common::identifier(text, RESERVED)
}

/// The name of a type: `link_wrenches` becomes `LinkWrenches`.
pub(super) fn type_name(text: &str) -> String {
    common::type_name(text, RESERVED)
}

/// A name that a namer in use already gave, with something added.
pub(super) fn derived(namer: &mut Namer, base: &Ident, suffix: &str) -> Ident {
    namer.name(&format!("{base}_{suffix}"))
}
