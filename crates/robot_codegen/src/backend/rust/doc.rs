//! Documentation as attributes.

use syn::{Attribute, parse_quote};

/// Makes documentation attributes, one for each line.
pub(super) fn attributes(lines: &[String]) -> Vec<Attribute> {
    let lines = lines.iter().map(|line| {
        let line = if line.is_empty() { line.clone() } else { format!(" {line}") };
        parse_quote!(#[doc = #line])
    });
    lines.collect()
}
