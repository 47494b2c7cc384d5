//! Words that cannot be names in printed Rust.

/// Words that cannot be identifiers or have a special meaning where names occur; then values of the prelude, which a
/// pattern would match, and crates and types that a module with this name would hide from the code around it.
pub(super) const RESERVED: &[&str] = &[
    "Err",
    "None",
    "Ok",
    "Self",
    "Some",
    "abstract",
    "alloc",
    "as",
    "async",
    "await",
    "become",
    "bool",
    "box",
    "break",
    "char",
    "const",
    "continue",
    "core",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
    "f32",
    "f64",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "let",
    "loop",
    "macro",
    "macro_rules",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "raw",
    "ref",
    "return",
    "safe",
    "self",
    "static",
    "std",
    "struct",
    "super",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "union",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
];

/// Crates that come with the compiler, and the module of the runtime in a package.
pub(super) const MODULES: &[&str] = &["proc_macro", "runtime", "test"];

#[cfg(test)]
mod tests {
    use super::*;

    /// Excludes words that are reserved only in some contexts and names that can be hidden.
    #[test]
    fn reserved_words_are_not_identifiers_and_adapted_ones_are() {
        let identifiers = RESERVED.iter().filter(|word| syn::parse_str::<syn::Ident>(word).is_ok());
        let identifiers: Vec<&str> = identifiers.copied().collect();
        let expected =
            "Err None Ok Some alloc bool char core f32 f64 gen macro_rules raw safe std union";
        assert_eq!(identifiers.join(" "), expected);
        for word in RESERVED {
            let adapted = super::super::identifier(word);
            assert!(syn::parse_str::<syn::Ident>(&adapted).is_ok(), "{adapted}");
        }
    }
}
