//! Checks before the text is parsed: the parser's time or memory grows with the square of these quantities.

use super::super::input_limits::{MAX_ATTRIBUTES, MAX_DEPTH, MAX_NAMESPACES};
use crate::diagnostic::{Diagnostic, Span, code};

/// Checks that the nesting, attributes and namespaces of the tags in a text do not exceed the limits. Syntax errors are
/// left to the parser.
pub(super) fn check(text: &str) -> Option<Diagnostic> {
    let mut position = 0;
    let mut depth = 0_usize;
    let mut namespaces = 0;
    while let Some(found) = text.get(position..).and_then(|rest| rest.find('<')) {
        let start = position + found;
        let rest = text.get(start..).unwrap_or_default();
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .iter()
            .find(|(opening, _)| rest.starts_with(opening));
        if let Some((opening, closing)) = skipped {
            let inside = rest.get(opening.len()..).unwrap_or_default();
            position = start + opening.len() + inside.find(closing)? + closing.len();
            continue;
        }
        let tag = Tag::read(rest);
        position = start + tag.length;
        let place = start..start + 1;
        if tag.attributes > MAX_ATTRIBUTES {
            return Some(refused(&place, "attributes of one element", MAX_ATTRIBUTES));
        }
        namespaces += tag.namespaces;
        if namespaces > MAX_NAMESPACES {
            return Some(refused(&place, "namespaces", MAX_NAMESPACES));
        }
        match (rest.starts_with("</"), tag.is_empty) {
            (true, _) => depth = depth.saturating_sub(1),
            (false, true) => {}
            (false, false) => depth += 1,
        }
        if depth > MAX_DEPTH {
            return Some(refused(&place, "levels of nested elements", MAX_DEPTH));
        }
    }
    None
}

struct Tag {
    length: usize,
    attributes: usize,
    namespaces: usize,
    /// Whether the tag is that of an empty element, `<…/>`.
    is_empty: bool,
}

impl Tag {
    /// Reads the tag at the start of the text.
    fn read(text: &str) -> Tag {
        let mut tag = Tag { length: text.len(), attributes: 0, namespaces: 0, is_empty: false };
        let mut quote = None;
        let mut before = b'<';
        let mut name = 0;
        for (index, byte) in text.bytes().enumerate() {
            match (quote, byte) {
                (Some(open), _) if open == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => {
                    tag.attributes += 1;
                    let key = text.get(name..index).unwrap_or_default();
                    tag.namespaces += usize::from(key.starts_with("xmlns"));
                }
                (None, b' ' | b'\t' | b'\r' | b'\n') => {
                    // In `key = value`, the key ends before the space.
                    let key_follows = text
                        .get(index + 1..)
                        .is_some_and(|rest| !rest.starts_with([' ', '\t', '\r', '\n', '=']));
                    if key_follows {
                        name = index + 1;
                    }
                }
                (None, b'>') => {
                    tag.length = index + 1;
                    tag.is_empty = before == b'/';
                    break;
                }
                (None, _) => {}
            }
            before = byte;
        }
        tag
    }
}

fn refused(place: &Span, what: &str, limit: usize) -> Diagnostic {
    Diagnostic::error(code::LIMIT, format!("more than {limit} {what}"))
        .at(place, "here")
        .because("a robot never needs that many, and they make reading slow")
        .help("remove everything that does not describe the robot")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_measured() {
        let tag = Tag::read("<a x=\"1>\" xmlns:b = 'c=/' y='\"'/> z=1>");
        assert_eq!((tag.length, tag.attributes, tag.namespaces, tag.is_empty), (33, 3, 1, true));
        let tag = Tag::read("<a");
        assert_eq!((tag.length, tag.is_empty), (2, false));
        let tag = Tag::read("<é x=\"é\">");
        assert_eq!((tag.length, tag.attributes), (11, 1));
    }

    #[test]
    fn limits_hold_whatever_hides_them() {
        let nested = |depth: usize| "<a b=\">\">".repeat(depth) + &"</a>".repeat(depth);
        assert!(check(&nested(MAX_DEPTH)).is_none());
        assert!(check(&nested(MAX_DEPTH + 1)).is_some());
        assert!(check(&"<!-- <a> --><a></a><?p <a> ?><a/>".repeat(MAX_DEPTH + 1)).is_none());
        let attributes = |count: usize| format!("<a{}/>", " b='>'".repeat(count));
        assert!(check(&attributes(MAX_ATTRIBUTES)).is_none());
        assert!(check(&attributes(MAX_ATTRIBUTES + 1)).is_some());
        let namespaces = |count: usize| "<a xmlns:x='u'/>".repeat(count);
        assert!(check(&namespaces(MAX_NAMESPACES)).is_none());
        assert!(check(&namespaces(MAX_NAMESPACES + 1)).is_some());
    }

    /// Reading continues directly after skipped text.
    #[test]
    fn elements_behind_what_is_skipped_are_counted() {
        let open = |depth: usize| "<a>".repeat(depth);
        for skipped in ["<!-- -->", "<![CDATA[ ]]>", "<? ?>"] {
            let behind = |depth: usize| check(&format!("{}{skipped}{}", open(20), open(depth)));
            assert!(behind(MAX_DEPTH - 20).is_none(), "{skipped}");
            assert!(behind(MAX_DEPTH - 19).is_some(), "{skipped}");
        }
    }
}
