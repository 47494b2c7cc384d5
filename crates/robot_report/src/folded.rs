//! Parts of the page whose elements are created when they are opened.
//!
//! A browser that runs the page's script does not parse the content of `noscript`: it stays text until the script
//! creates elements from it. Without scripts, it is an ordinary part of the page.

use robot_document::markup::{Element, Node, element, holding};

/// Content that the script creates when the surrounding `details` element is opened. Deferred content must not be
/// nested.
pub(crate) fn deferred<C: Into<Node>>(content: impl IntoIterator<Item = C>) -> Element {
    element("noscript").with_all(content)
}

/// A folded part with a title.
pub(crate) fn folded<C: Into<Node>>(
    title: impl Into<Node>,
    content: impl IntoIterator<Item = C>,
) -> Element {
    element("details").with(holding("summary", title)).with(deferred(content))
}
