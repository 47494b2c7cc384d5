//! The limits of input, each of which has a message of its own.

/// A robot file of more bytes than this is refused.
pub const MAX_BYTES: usize = 1 << 20;
/// A robot of more joints than this is refused.
pub const MAX_JOINTS: usize = 64;
/// A robot file of more links, fixed ones and all, is refused; so many frames and tips, too.
pub const MAX_LINKS: usize = 512;
/// A robot of more parameters than this is refused.
pub const MAX_PARAMETERS: usize = 4096;
/// More bundles than this are refused: each is a function as long as all of its own.
pub const MAX_BUNDLES: usize = 16;
/// Elements of XML nested deeper than this are refused.
pub(super) const MAX_DEPTH: usize = 64;
/// An element of XML with more attributes than this is refused.
pub(super) const MAX_ATTRIBUTES: usize = 64;
/// XML with more namespaces than this is refused.
pub(super) const MAX_NAMESPACES: usize = 64;
