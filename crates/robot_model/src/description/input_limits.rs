//! The limits of input, each of which has a message of its own.

/// A robot file with more bytes than this is refused.
pub const MAX_BYTES: usize = 1 << 20;
/// A robot with more moving joints than this is refused.
pub const MAX_JOINTS: usize = 64;
/// A robot file with more links than this, including fixed ones, is refused, as is one with more frames and tips.
pub const MAX_LINKS: usize = 512;
/// A robot with more parameters than this is refused.
pub const MAX_PARAMETERS: usize = 4096;
/// A robot file with more bundles than this is refused: each bundle is a function as long as all of its functions
/// together.
pub const MAX_BUNDLES: usize = 16;
/// Elements of XML nested deeper than this are refused.
pub(super) const MAX_DEPTH: usize = 64;
/// An element of XML with more attributes than this is refused.
pub(super) const MAX_ATTRIBUTES: usize = 64;
/// XML with more namespaces than this is refused.
pub(super) const MAX_NAMESPACES: usize = 64;
