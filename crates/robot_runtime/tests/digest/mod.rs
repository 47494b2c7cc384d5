//! A digest of many bits in one number, and the numbers in a source text.

/// The digest of nothing.
pub(crate) const EMPTY: u64 = 0xcbf2_9ce4_8422_2325;

/// The digest after one more number, by the method of Fowler, Noll and Vo, eight bytes at a time.
pub(crate) fn with(digest: u64, bits: u64) -> u64 {
    (digest ^ bits).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23)
}

/// The floating-point literals of the item that starts with `beginning`.
pub(crate) fn numbers<'s>(source: &'s str, beginning: &str) -> impl Iterator<Item = &'s str> {
    let (_, item) = source.split_once(beginning).unwrap_or_default();
    let (item, _) = item.split_once(";\n").unwrap_or_default();
    item.split([',', '[', ']', ' ', '\n']).filter(|word| word.contains('.'))
}
