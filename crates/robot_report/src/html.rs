//! Markup as a tree: the one place where text becomes HTML.
//!
//! Text and values of attributes are escaped when the tree is written, so that nothing that comes
//! from a robot file can be markup. What is written is HTML and well-formed XML at once.

use std::fmt::Write as _;

use robot_build::MARKER;
use robot_model::diagnostic::is_invisible;

/// An element with its attributes and what is in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Node>,
}

/// The content of an element.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Node {
    /// An element.
    Element(Element),
    /// Text, as it is to be read.
    Text(String),
    /// Style or script of this program's own: it is written unescaped.
    Own(&'static str),
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
const VOID: [&str; 5] = ["meta", "link", "br", "hr", "col"];

/// An element of that name.
pub(crate) fn element(name: &'static str) -> Element {
    Element { name, attributes: vec![], children: vec![] }
}

/// An element with one piece of text or one element in it.
pub(crate) fn holding(name: &'static str, child: impl Into<Node>) -> Element {
    element(name).with(child)
}

impl Element {
    /// Adds an attribute.
    pub(crate) fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Element {
        self.attributes.push((name, value.into()));
        self
    }

    /// With a class.
    pub(crate) fn class(self, value: impl Into<String>) -> Element {
        self.attribute("class", value)
    }

    /// With one more child.
    pub(crate) fn with(mut self, child: impl Into<Node>) -> Element {
        self.children.push(child.into());
        self
    }

    /// With more children.
    pub(crate) fn with_all<C: Into<Node>>(
        mut self,
        children: impl IntoIterator<Item = C>,
    ) -> Element {
        self.children.extend(children.into_iter().map(Into::into));
        self
    }

    /// The page with this element as its root.
    pub(crate) fn to_document(&self) -> String {
        let mut text = format!("<!DOCTYPE html>\n<!-- {MARKER} -->\n");
        self.write(&mut text);
        text.push('\n');
        text
    }

    /// Elements nest as deep as this program's own code nests them, so that this may recurse.
    fn write(&self, text: &mut String) {
        text.push('<');
        text.push_str(self.name);
        for (name, value) in &self.attributes {
            // Writing to a string does not fail.
            let _ = write!(text, " {name}=\"{}\"", Escaped(value));
        }
        if self.children.is_empty() && VOID.contains(&self.name) {
            text.push_str("/>");
            return;
        }
        text.push('>');
        for child in &self.children {
            match child {
                Node::Element(element) => element.write(text),
                Node::Text(words) => _ = write!(text, "{}", Escaped(words)),
                Node::Own(own) => text.push_str(own),
            }
        }
        let _ = write!(text, "</{}>", self.name);
    }
}

/// Text with the signs of markup as references, and characters that show nothing or turn the
/// direction of reading by their numbers.
struct Escaped<'t>(&'t str);

impl std::fmt::Display for Escaped<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for character in self.0.chars() {
            match character {
                '&' => formatter.write_str("&amp;")?,
                '<' => formatter.write_str("&lt;")?,
                '>' => formatter.write_str("&gt;")?,
                '"' => formatter.write_str("&quot;")?,
                '\'' => formatter.write_str("&#39;")?,
                '\n' | '\t' => formatter.write_char(character)?,
                hidden if is_hidden(hidden) => write!(formatter, "[U+{:04X}]", u32::from(hidden))?,
                plain => formatter.write_char(plain)?,
            }
        }
        Ok(())
    }
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
        let hostile = "\"><img src=x onerror='alert(1)'>&amp;</p>\u{202e}\u{0}\u{7}";
        let page = element("p").attribute("title", hostile).with(hostile).to_document();
        let parsed = roxmltree::Document::parse_with_options(
            &page,
            roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() },
        );
        let parsed = parsed.unwrap();
        let shown = "\"><img src=x onerror='alert(1)'>&amp;</p>[U+202E][U+0000][U+0007]";
        let root = parsed.root_element();
        assert_eq!((root.text(), root.attribute("title")), (Some(shown), Some(shown)));
        assert_eq!(root.children().count(), 1);
    }

    #[test]
    fn only_void_elements_end_at_once() {
        let page = element("td").with(element("br")).with(element("i")).to_document();
        assert_eq!(
            page,
            "<!DOCTYPE html>\n<!-- @generated by robot-symbolic -->\n<td><br/><i></i></td>\n"
        );
    }
}
