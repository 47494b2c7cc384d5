//! Words that names of printed Rust keep clear of.

/// The words that cannot be identifiers, or mean something else where names occur; then crates and
/// types that a module of the name would hide from the code around it.
pub(super) const RESERVED: &[&str] = &[
    "Self",
    "abstract",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "const",
    "continue",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
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
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "ref",
    "return",
    "self",
    "static",
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
    "macro_rules",
    "raw",
    "safe",
    "alloc",
    "bool",
    "char",
    "core",
    "f32",
    "f64",
    "std",
];

#[cfg(test)]
mod tests {
    use super::*;

    /// But for the words that are reserved in places, and the names that can be hidden.
    #[test]
    fn reserved_words_are_no_identifiers_and_adapted_ones_are() {
        let identifiers = RESERVED.iter().filter(|word| syn::parse_str::<syn::Ident>(word).is_ok());
        let identifiers: Vec<&str> = identifiers.copied().collect();
        let expected = "gen union macro_rules raw safe alloc bool char core f32 f64 std";
        assert_eq!(identifiers.join(" "), expected);
        for word in RESERVED {
            let adapted = super::super::identifier(word);
            assert!(syn::parse_str::<syn::Ident>(&adapted).is_ok(), "{adapted}");
        }
    }
}
