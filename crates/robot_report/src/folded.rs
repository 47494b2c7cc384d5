//! Parts of the page that are made when they are opened.
//!
//! A browser that runs the page's script does not parse what is in `noscript`: it is text until the script
//! makes elements of it. Without the script it is a part of the page like any other.

use robot_document::markup::{Element, Node, element, holding};

/// What the script makes when the `details` around it are opened. It must not be in another one of its kind.
pub(crate) fn deferred<C: Into<Node>>(content: impl IntoIterator<Item = C>) -> Element {
    element("noscript").with_all(content)
}

/// A folded part under a title.
pub(crate) fn folded<C: Into<Node>>(
    title: impl Into<Node>,
    content: impl IntoIterator<Item = C>,
) -> Element {
    element("details").with(holding("summary", title)).with(deferred(content))
}
