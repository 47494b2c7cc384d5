//! Markup as a tree of elements, HTML, MathML and SVG alike: the one place where text becomes markup.
//!
//! Text and values of attributes are escaped when the tree is written, so that nothing that comes
//! from a robot file can be markup. What is written is HTML and well-formed XML at once.

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
    /// Text, as it is to be read.
    Text(String),
    /// A style or script of this program's own, which is written as it is.
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

/// Elements that have no end in HTML.
const VOID: [&str; 6] = ["meta", "link", "br", "hr", "col", "input"];

/// An element of that name, such as `mrow`.
#[must_use]
pub fn element(name: &'static str) -> Element {
    Element { name, attributes: vec![], children: vec![] }
}

/// An element of that name with one child.
#[must_use]
pub fn holding(name: &'static str, child: impl Into<Node>) -> Element {
    element(name).with(child)
}

impl Element {
    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The first child, if that is an element.
    pub fn first_mut(&mut self) -> Option<&mut Element> {
        match self.children.first_mut() {
            Some(Node::Element(first)) => Some(first),
            _ => None,
        }
    }

    /// Sets an attribute that it does not have yet.
    pub fn set(&mut self, name: &'static str, value: impl Into<String>) {
        self.attributes.push((name, value.into()));
    }

    /// With one more attribute.
    #[must_use]
    pub fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Element {
        self.set(name, value);
        self
    }

    /// With a class.
    #[must_use]
    pub fn class(self, value: impl Into<String>) -> Element {
        self.attribute("class", value)
    }

    /// With one more child.
    #[must_use]
    pub fn with(mut self, child: impl Into<Node>) -> Element {
        self.children.push(child.into());
        self
    }

    /// With more children.
    #[must_use]
    pub fn with_all<C: Into<Node>>(mut self, children: impl IntoIterator<Item = C>) -> Element {
        self.children.extend(children.into_iter().map(Into::into));
        self
    }
}

/// Elements nest as deep as formulas and this program's own code nest them, so that this may recurse.
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

/// Writes text with the signs of markup as references, and characters that show nothing or turn the
/// direction of reading by their numbers. A quotation mark ends an attribute, which is always between double
/// ones; in text it is a sign like any other.
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

/// Control characters, those that show nothing or turn the direction of reading, and those that XML
/// does not have.
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
