//! Markup as a tree of elements for HTML, MathML and SVG. This is the only place where text becomes markup.
//!
//! Text and attribute values are escaped when the tree is written, so nothing in a robot file can act as markup. The
//! result is both HTML and well-formed XML.

use std::fmt::{self, Write as _};

use robot_model::diagnostic::is_invisible;

/// An element with its attributes and its children.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Node>,
}

/// A child of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// An element.
    Element(Element),
    /// Plain text, which is escaped.
    Text(String),
    /// A style or script that is part of this program; it is written without escaping.
    Verbatim(&'static str),
}

impl From<Element> for Node {
    fn from(element: Element) -> Node {
        Node::Element(element)
    }
}

impl From<&str> for Node {
    fn from(text: &str) -> Node {
        Node::Text(text.to_owned())
    }
}

impl From<String> for Node {
    fn from(text: String) -> Node {
        Node::Text(text)
    }
}

/// The elements that have no end tag in HTML.
const VOID: [&str; 6] = ["meta", "link", "br", "hr", "col", "input"];

/// Creates an element, for example `mrow`.
#[must_use]
pub fn element(name: &'static str) -> Element {
    Element { name, attributes: vec![], children: vec![] }
}

/// Creates an element with one child.
#[must_use]
pub fn holding(name: &'static str, child: impl Into<Node>) -> Element {
    element(name).with(child)
}

impl Element {
    /// The name of the element.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The first child if it is an element.
    pub fn first_mut(&mut self) -> Option<&mut Element> {
        match self.children.first_mut() {
            Some(Node::Element(first)) => Some(first),
            _ => None,
        }
    }

    /// Sets an attribute, which must not be set yet.
    pub fn set(&mut self, name: &'static str, value: impl Into<String>) {
        self.attributes.push((name, value.into()));
    }

    /// Adds an attribute.
    #[must_use]
    pub fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Element {
        self.set(name, value);
        self
    }

    /// Sets the class.
    #[must_use]
    pub fn class(self, value: impl Into<String>) -> Element {
        self.attribute("class", value)
    }

    /// Adds a child.
    #[must_use]
    pub fn with(mut self, child: impl Into<Node>) -> Element {
        self.children.push(child.into());
        self
    }

    /// Adds children.
    #[must_use]
    pub fn with_all<C: Into<Node>>(mut self, children: impl IntoIterator<Item = C>) -> Element {
        self.children.extend(children.into_iter().map(Into::into));
        self
    }
}

/// Recursion is safe here, because elements nest only as deeply as formulas and this program's code nest them.
impl fmt::Display for Element {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(formatter, " {name}=\"")?;
            escape(value, true, formatter)?;
            formatter.write_char('"')?;
        }
        if self.children.is_empty() && VOID.contains(&self.name) {
            return formatter.write_str("/>");
        }
        formatter.write_char('>')?;
        for child in &self.children {
            match child {
                Node::Element(element) => element.fmt(formatter)?,
                Node::Text(text) => escape(text, false, formatter)?,
                Node::Verbatim(own) => formatter.write_str(own)?,
            }
        }
        write!(formatter, "</{}>", self.name)
    }
}

/// Writes text with references in place of the characters that markup uses, and with `[U+…]` in place of hidden
/// characters (see [`is_hidden`]). Quotation marks are only escaped in attributes, where a double one would end the
/// value.
fn escape(text: &str, is_attribute: bool, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    for character in text.chars() {
        match character {
            '&' => formatter.write_str("&amp;")?,
            '<' => formatter.write_str("&lt;")?,
            '>' => formatter.write_str("&gt;")?,
            '"' if is_attribute => formatter.write_str("&quot;")?,
            '\n' | '\t' => formatter.write_char(character)?,
            hidden if is_hidden(hidden) => write!(formatter, "[U+{:04X}]", u32::from(hidden))?,
            plain => formatter.write_char(plain)?,
        }
    }
    Ok(())
}

/// Whether a character is a control character, is invisible, changes the direction of reading, or cannot occur in XML.
fn is_hidden(character: char) -> bool {
    character.is_control()
        || is_invisible(character)
        || matches!(character, '\u{fffe}' | '\u{ffff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_attributes_are_never_markup() {
        let hostile = "\"><img src=x onerror='alert(1)'>&amp;</p>]]>\u{202e}\u{0}\u{7}";
        let written = element("p").attribute("title", hostile).with(hostile).to_string();
        let parsed = roxmltree::Document::parse(&written).unwrap();
        let shown = "\"><img src=x onerror='alert(1)'>&amp;</p>]]>[U+202E][U+0000][U+0007]";
        let root = parsed.root_element();
        assert_eq!((root.text(), root.attribute("title")), (Some(shown), Some(shown)));
        assert_eq!(root.children().count(), 1);
    }

    #[test]
    fn quotation_marks_are_references_in_attributes_alone() {
        let quotes = "\"it's\"";
        let written = element("p").attribute("title", quotes).with(quotes).to_string();
        assert_eq!(written, "<p title=\"&quot;it's&quot;\">\"it's\"</p>");
    }

    #[test]
    fn only_void_elements_end_at_once() {
        let cell = element("td").with(element("br")).with(element("i"));
        assert_eq!(cell.to_string(), "<td><br/><i></i></td>");
    }
}
