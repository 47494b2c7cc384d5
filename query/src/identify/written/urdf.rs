//! Writes identified values into a URDF file: the `<inertial>` of every moving link. The rest of the file does not
//! change.

use robot_model::robot::Link;
use roxmltree::{Document, Node};

use super::Body;

/// A part of the text and its replacement.
struct Edit {
    range: std::ops::Range<usize>,
    text: String,
}

/// The text with a body for each moving link, and comments above it. Bodies that are fixed to a link are merged
/// into it.
pub(super) fn with_bodies(
    text: &str,
    links: &[Link],
    bodies: &[Body],
    comments: &[Vec<String>],
) -> Result<String, String> {
    let document = Document::parse(text).map_err(|error| error.to_string())?;
    let find = |name: &str| {
        let mut elements = document.root_element().children();
        elements.find(|node| {
            node.has_tag_name("link") && node.attribute("name").map(str::trim) == Some(name)
        })
    };
    let mut edits = vec![];
    for ((link, body), comments) in links.iter().zip(bodies).zip(comments) {
        let node = find(&link.name).ok_or_else(|| format!("link `{}` is missing", link.name))?;
        for merged in link.bodies.iter().filter(|body| body.name != link.name) {
            let inertial = find(&merged.name).and_then(inertial);
            edits.extend(
                inertial.map(|inertial| Edit { range: line(text, inertial), text: String::new() }),
            );
        }
        edits.push(own(text, node, &element(body, comments)));
    }
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.range.start));
    let mut text = text.to_owned();
    for Edit { range, text: new } in edits {
        text.replace_range(range, &new);
    }
    Ok(text)
}

fn inertial<'a, 'i>(link: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    link.children().find(|node| node.has_tag_name("inertial"))
}

/// Puts the inertial of a link in place of the existing one, or as the first element of the link.
fn own(text: &str, link: Node<'_, '_>, element: &str) -> Edit {
    if let Some(old) = inertial(link) {
        return Edit { range: old.range(), text: element.trim_start().to_owned() };
    }
    let range = link.range();
    match link.first_child() {
        Some(first) => {
            let start = first.range().start;
            Edit { range: start..start, text: format!("\n    {}", element.trim_start()) }
        }
        None => {
            // The link is `<link name="tip"/>`, or has nothing between its tags.
            let tag = &text[range.clone()];
            let end = tag.find("/>").unwrap_or_else(|| tag.find('>').unwrap_or(tag.len()));
            let start = tag[..end].trim_end();
            Edit { range, text: format!("{start}>\n    {}\n  </link>", element.trim_start()) }
        }
    }
}

/// The range of an element, including the white space before it.
fn line(text: &str, node: Node<'_, '_>) -> std::ops::Range<usize> {
    let range = node.range();
    text[..range.start].trim_end().len()..range.end
}

/// An `<inertial>` with its comments.
fn element(body: &Body, comments: &[String]) -> String {
    let mut text = String::new();
    for comment in comments {
        text.push_str(&format!("    <!-- {comment} -->\n"));
    }
    let [x, y, z] = [body.center.x, body.center.y, body.center.z];
    let entry = |row: usize, column: usize| body.inertia[(row, column)];
    text.push_str(&format!(
        "    <inertial>\n      <origin xyz=\"{x} {y} {z}\" rpy=\"0 0 0\"/>\n      <mass value=\"{}\"/>\n      <inertia \
         ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n    </inertial>",
        body.mass,
        entry(0, 0),
        entry(0, 1),
        entry(0, 2),
        entry(1, 1),
        entry(1, 2),
        entry(2, 2)
    ));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inertial_is_added_if_there_is_none() {
        let new = "<inertial/>";
        for (text, wanted) in [
            (
                "<robot><link name=\"a\"/></robot>",
                "<robot><link name=\"a\">\n    <inertial/>\n  </link></robot>",
            ),
            (
                "<robot><link name=\"a\" ></link></robot>",
                "<robot><link name=\"a\">\n    <inertial/>\n  </link></robot>",
            ),
            (
                "<robot><link name=\"a\"><visual/></link></robot>",
                "<robot><link name=\"a\">\n    <inertial/><visual/></link></robot>",
            ),
            (
                "<robot><link name=\"a\"><inertial><mass/></inertial></link></robot>",
                "<robot><link name=\"a\"><inertial/></link></robot>",
            ),
        ] {
            let document = Document::parse(text).unwrap();
            let link = document.root_element().first_child().unwrap();
            let Edit { range, text: new } = own(text, link, new);
            let mut found = text.to_owned();
            found.replace_range(range, &new);
            assert_eq!(found, wanted);
        }
    }
}
