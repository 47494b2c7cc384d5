//! Elements of URDF, read attribute by attribute. Everything that URDF does not define is reported.

use roxmltree::Node;

use super::super::reader::Reader;
use super::super::table::list;
use super::xml::template;
use crate::diagnostic::{Diagnostic, Span, code, quote};

/// The allowed content of an element.
pub(super) struct Kind {
    pub(super) name: &'static str,
    attributes: &'static [&'static str],
    children: &'static [&'static Kind],
    /// Names of elements that do not affect the motion.
    ignored: &'static [&'static str],
    /// Whether all other content is an error. If not, content whose name does not resemble a known one is skipped with
    /// a warning, because it may be an extension of another program.
    strict: bool,
}

impl Kind {
    /// A sentence that lists the attributes.
    fn known_attributes(&self) -> String {
        let name = self.name;
        match self.attributes {
            [] => format!("`<{name}>` has no attributes, only other elements"),
            [known] => format!("the attribute of `<{name}>` is `{known}`"),
            known => format!("the attributes of `<{name}>` are {}", list(known)),
        }
    }
}

const LEAF: Kind = Kind { name: "", attributes: &[], children: &[], ignored: &[], strict: true };

/// The root element.
pub(super) static ROBOT: Kind = Kind {
    name: "robot",
    attributes: &["name", "version"],
    children: &[&LINK, &JOINT],
    ignored: &["material", "transmission", "gazebo", "sensor", "ros2_control", "plugin", "group"],
    strict: false,
};
/// A link element.
pub(super) static LINK: Kind = Kind {
    name: "link",
    attributes: &["name", "type"],
    children: &[&INERTIAL],
    ignored: &["visual", "collision", "material", "sensor", "gazebo", "contact"],
    strict: false,
};
static INERTIAL: Kind = Kind { name: "inertial", children: &[&ORIGIN, &MASS, &INERTIA], ..LEAF };
static ORIGIN: Kind = Kind { name: "origin", attributes: &["xyz", "rpy"], ..LEAF };
static MASS: Kind = Kind { name: "mass", attributes: &["value"], ..LEAF };
static INERTIA: Kind =
    Kind { name: "inertia", attributes: &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], ..LEAF };
/// A joint element.
pub(super) static JOINT: Kind = Kind {
    name: "joint",
    attributes: &["name", "type"],
    children: &[&ORIGIN, &PARENT, &CHILD, &AXIS, &LIMIT, &MIMIC, &DYNAMICS],
    ignored: &["calibration", "safety_controller", "hardwareInterface", "gazebo"],
    strict: false,
};
static PARENT: Kind = Kind { name: "parent", attributes: &["link"], ..LEAF };
static CHILD: Kind = Kind { name: "child", attributes: &["link"], ..LEAF };
static AXIS: Kind = Kind { name: "axis", attributes: &["xyz"], ..LEAF };
static LIMIT: Kind = Kind {
    name: "limit",
    attributes: &["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"],
    strict: false,
    ..LEAF
};
static MIMIC: Kind = Kind { name: "mimic", attributes: &["joint", "multiplier", "offset"], ..LEAF };
static DYNAMICS: Kind =
    Kind { name: "dynamics", attributes: &["damping", "friction"], strict: false, ..LEAF };

/// An element and its allowed content.
#[derive(Clone, Copy)]
pub(super) struct Element<'a, 'i> {
    node: Node<'a, 'i>,
    kind: &'static Kind,
}

/// An attribute.
pub(super) struct Attribute<'a> {
    pub(super) text: &'a str,
    /// The place of the value, without its quotes.
    pub(super) span: Span,
}

impl<'a, 'i> Element<'a, 'i> {
    /// Creates the element and checks the names of its attributes and children.
    pub(super) fn new(
        reader: &mut Reader<'_>,
        node: Node<'a, 'i>,
        kind: &'static Kind,
    ) -> Element<'a, 'i> {
        let element = Element { node, kind };
        element.check_attributes(reader);
        element.check_children(reader);
        element.check_text(reader);
        element
    }

    /// The place of `<name`, the beginning of the element.
    pub(super) fn tag(&self) -> Span {
        tag(self.node)
    }

    /// The place of the whole element, from its tag to its end.
    pub(super) fn span(&self) -> Span {
        self.node.range()
    }

    /// The attribute with the given name.
    pub(super) fn attribute(&self, name: &str) -> Option<Attribute<'a>> {
        debug_assert!(self.kind.attributes.contains(&name), "{name} is not declared");
        let found = self.own_attributes().find(|attribute| attribute.name() == name)?;
        Some(Attribute { text: found.value(), span: found.range_value() })
    }

    /// The required attribute with the given name; `example` is a value for it.
    pub(super) fn require(
        &self,
        reader: &mut Reader<'_>,
        name: &str,
        example: &str,
    ) -> Option<Attribute<'a>> {
        let attribute = self.attribute(name);
        if attribute.is_none() {
            let message = format!("`<{}>` has no `{name}`", self.kind.name);
            reader.report(
                Diagnostic::error(code::MISSING_KEY, message)
                    .at(&self.tag(), format!("`{name}` is missing"))
                    .help(format!("add `{name}=\"{example}\"`")),
            );
        }
        attribute
    }

    /// The first child with the given name.
    pub(super) fn child(&self, reader: &mut Reader<'_>, name: &str) -> Option<Element<'a, 'i>> {
        let kind = self.child_kind(name)?;
        let node = self.node.children().find(|node| named(*node, name))?;
        Some(Element::new(reader, node, kind))
    }

    /// The required child with the given name; `example` is the text to add if it is missing.
    pub(super) fn require_child(
        &self,
        reader: &mut Reader<'_>,
        name: &str,
        example: &str,
    ) -> Option<Element<'a, 'i>> {
        let child = self.child(reader, name);
        if child.is_none() {
            let message = format!("`<{}>` has no `<{name}>`", self.kind.name);
            reader.report(
                Diagnostic::error(code::MISSING_KEY, message)
                    .at(&self.tag(), format!("`<{name}>` is missing"))
                    .help(format!("add `{example}`")),
            );
        }
        child
    }

    /// The nodes of all children with the given name, in order.
    pub(super) fn nodes(&self, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
        self.node.children().filter(move |node| named(*node, name))
    }

    /// The number of elements with the given name among the children and their children.
    pub(super) fn count(&self, name: &str) -> usize {
        let below = self.node.children().flat_map(|child| child.children());
        self.node.children().chain(below).filter(|node| named(*node, name)).count()
    }

    fn child_kind(&self, name: &str) -> Option<&'static Kind> {
        self.kind.children.iter().copied().find(|kind| kind.name == name)
    }

    /// The attributes without a prefix; those with one belong to other programs.
    fn own_attributes(&self) -> impl Iterator<Item = roxmltree::Attribute<'a, 'i>> {
        self.node.attributes().filter(|attribute| attribute.namespace().is_none())
    }

    fn check_attributes(&self, reader: &mut Reader<'_>) {
        for attribute in self.node.attributes() {
            let name = attribute.name();
            if attribute.namespace().is_some() {
                let place = attribute.range_qname();
                let written = self.node.document().input_text().get(place.clone());
                let message =
                    format!("`{}` belongs to another program", quote(written.unwrap_or(name)));
                reader.report(unknown(&place, message, None, false));
                continue;
            }
            if self.kind.attributes.contains(&name) {
                continue;
            }
            let known = self.kind.attributes.iter().copied();
            let known = known.filter(|known| self.own_attributes().all(|own| own.name() != *known));
            let near = reader.nearest(name, known);
            let help = self.kind.known_attributes();
            let message =
                format!("`{}` is not an attribute of `<{}>`", quote(name), self.kind.name);
            let found = unknown(&attribute.range_qname(), message, near, self.kind.strict);
            reader.report(found.help(help));
        }
    }

    fn check_children(&self, reader: &mut Reader<'_>) {
        let mut seen: Vec<(&str, Span)> = Vec::new();
        for node in self.node.children().filter(Node::is_element) {
            let name = node.tag_name().name();
            let place = tag(node);
            if let Some(prefix) = prefix(node) {
                let message = format!("`{prefix}:{}` belongs to another program", quote(name));
                match prefix {
                    "xacro" if reader.found.iter().any(|one| one.code == code::XACRO) => {}
                    "xacro" => reader.report(template(&place)),
                    _ => reader.report(unknown(&place, message, None, false)),
                }
                continue;
            }
            if is_foreign(node) {
                let message = format!(
                    "`<{}>` is in another namespace and belongs to another program",
                    quote(name)
                );
                reader.report(unknown(&place, message, None, false));
                continue;
            }
            if let Some(kind) = self.child_kind(name) {
                let first = seen.iter().find(|(known, _)| *known == name);
                match first {
                    // Links and joints may occur repeatedly; other children may not.
                    Some((_, first)) if !kind.is_repeated() => {
                        let message = format!("`<{name}>` appears twice in `<{}>`", self.kind.name);
                        reader.report(
                            Diagnostic::error(code::CONFLICT, message)
                                .at(&place, "again here")
                                .and_at(first, "first here")
                                .help("keep one of them"),
                        );
                    }
                    Some(_) => {}
                    None => seen.push((name, place)),
                }
                continue;
            }
            if self.kind.ignored.contains(&name) {
                continue;
            }
            let names = self.kind.children.iter().map(|kind| kind.name);
            let names: Vec<&str> = names.collect();
            let all = names.iter().copied().chain(self.kind.ignored.iter().copied());
            let near = reader.nearest(name, all);
            let message =
                format!("`<{}>` is not an element of `<{}>`", quote(name), self.kind.name);
            let known = match names.as_slice() {
                [] => format!("`<{}>` has no child elements", self.kind.name),
                [only] => format!("the only element that is read is `{only}`"),
                names => format!("the elements that are read are {}", list(names)),
            };
            let help = if near.is_none() { format!("remove it: {known}") } else { known };
            reader.report(unknown(&place, message, near, self.kind.strict).help(help));
        }
    }

    /// Values are attributes in URDF, so text between the tags is of no effect.
    fn check_text(&self, reader: &mut Reader<'_>) {
        let written = self.node.document().input_text();
        let texts = self.node.children().filter(Node::is_text).map(|text| text.range());
        for range in texts {
            let text = written.get(range.clone()).unwrap_or_default();
            let line = text.trim().lines().next().unwrap_or_default();
            if line.is_empty() {
                continue;
            }
            let start = range.start + text.find(line).unwrap_or_default();
            let message = format!("text in `<{}>` is not read", self.kind.name);
            let help = self.kind.known_attributes();
            let place = start..start + line.len();
            reader.report(
                Diagnostic::warning(code::NOT_READ, message).at(&place, "ignored").help(help),
            );
        }
    }
}

impl Kind {
    fn is_repeated(&self) -> bool {
        matches!(self.name, "link" | "joint")
    }
}

/// Returns an error if the word resembles a known one or no other content is allowed, otherwise a warning.
fn unknown(place: &Span, message: String, near: Option<&str>, strict: bool) -> Diagnostic {
    match near {
        Some(near) => Diagnostic::error(code::UNKNOWN_KEY, message)
            .at(place, format!("did you mean `{near}`?"))
            .because("a misspelled element or attribute would silently be left out of the robot"),
        None if strict => {
            Diagnostic::error(code::UNKNOWN_KEY, message).at(place, "has no meaning here")
        }
        None => Diagnostic::warning(code::NOT_READ, message).at(place, "ignored"),
    }
}

/// Whether the element has the given name, no prefix and the namespace of the root.
fn named(node: Node<'_, '_>, name: &str) -> bool {
    let own = node.is_element() && node.tag_name().name() == name;
    own && prefix(node).is_none() && !is_foreign(node)
}

/// Whether a default namespace is declared for the element that is not the root's.
fn is_foreign(node: Node<'_, '_>) -> bool {
    node.tag_name().namespace() != node.document().root_element().tag_name().namespace()
}

/// The place of `<name` of an element.
pub(super) fn tag(node: Node<'_, '_>) -> Span {
    let range = node.range();
    let text = node.document().input_text().get(range.clone()).unwrap_or_default();
    let end = text.find([' ', '\t', '\r', '\n', '/', '>']).unwrap_or(text.len());
    range.start..range.start + end
}

/// The namespace prefix of an element's name, as it is written.
pub(super) fn prefix<'i>(node: Node<'_, 'i>) -> Option<&'i str> {
    let written = node.document().input_text().get(tag(node))?.get(1..)?;
    written.split_once(':').map(|(prefix, _)| prefix)
}
