//! The limits on input; exceeding one of them is an error with its own message.

/// The maximum size of a robot file, bytes.
pub const MAX_BYTES: usize = 1 << 20;
/// The maximum number of moving joints.
pub const MAX_JOINTS: usize = 64;
/// The maximum number of links in a robot file, including fixed ones; also the maximum number of frames and tips.
pub const MAX_LINKS: usize = 512;
/// The maximum number of parameters.
pub const MAX_PARAMETERS: usize = 4096;
/// The maximum number of bundles: each bundle is a function as long as all of its functions together.
pub const MAX_BUNDLES: usize = 16;
/// The maximum depth of nested XML elements.
pub(super) const MAX_DEPTH: usize = 64;
/// The maximum number of attributes of an XML element.
pub(super) const MAX_ATTRIBUTES: usize = 64;
/// The maximum number of namespaces in an XML file.
pub(super) const MAX_NAMESPACES: usize = 64;
