//! The frame of the page: head, contents, sections.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use robot_dynamics::model::Robot;
use sha2::{Digest, Sha256};

use crate::html::{Element, Node, element, holding};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// A section of the page.
pub(crate) struct Section {
    /// Its anchor.
    pub(crate) id: &'static str,
    /// Its heading.
    pub(crate) title: &'static str,
    /// What is in it.
    pub(crate) body: Vec<Node>,
}

/// The page of a robot.
pub(crate) fn page(robot: &Robot, sections: Vec<Section>) -> String {
    let contents = sections.iter().map(|section| {
        let anchor = format!("#{}", section.id);
        holding("li", holding("a", section.title).attribute("href", anchor))
    });
    let contents =
        element("nav").attribute("aria-label", "Contents").with(element("ol").with_all(contents));
    let main = sections.into_iter().map(|section| {
        let heading = format!("{}-heading", section.id);
        element("section")
            .attribute("id", section.id)
            .attribute("aria-labelledby", &heading)
            .with(holding("h2", section.title).attribute("id", &heading))
            .with_all(section.body)
    });
    let body = element("body")
        .with(holding("a", "Skip to the content").class("skip").attribute("href", "#content"))
        .with(header(robot))
        .with(contents)
        .with(element("main").attribute("id", "content").with_all(main))
        .with(footer())
        .with(element("script").with(Node::Own(SCRIPT)));
    element("html")
        .attribute("xmlns", "http://www.w3.org/1999/xhtml")
        .attribute("lang", "en")
        .with(head(robot))
        .with(body)
        .to_document()
}

fn head(robot: &Robot) -> Element {
    let meta = |name: &'static str, value: &str| {
        element("meta").attribute("name", name).attribute("content", value)
    };
    let policy = element("meta")
        .attribute("http-equiv", "Content-Security-Policy")
        .attribute("content", policy());
    element("head")
        .with(element("meta").attribute("charset", "utf-8"))
        .with(policy)
        .with(meta("viewport", "width=device-width, initial-scale=1"))
        .with(meta("color-scheme", "light dark"))
        .with(meta("referrer", "no-referrer"))
        .with(holding("title", format!("{}: equations of motion", robot.name)))
        .with(element("style").with(Node::Own(STYLE)))
}

/// The page's own style and script, by their hashes, and nothing else.
fn policy() -> String {
    let hash = |text: &str| BASE64_STANDARD.encode(Sha256::digest(text.as_bytes()));
    format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; \
         form-action 'none'",
        hash(STYLE),
        hash(SCRIPT)
    )
}

fn header(robot: &Robot) -> Element {
    let header = element("header").with(holding("h1", robot.name.as_str()));
    match &robot.description {
        Some(words) => header.with(holding("p", words.as_str())),
        None => header,
    }
}

fn footer() -> Element {
    let version = env!("CARGO_PKG_VERSION");
    let words = format!("Written by robot-symbolic {version}. Units are SI and radians.");
    holding("footer", holding("p", words))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Style and script stand in the page as they are: nothing in them may be markup.
    #[test]
    fn style_and_script_have_no_signs_of_markup() {
        for own in [STYLE, SCRIPT] {
            assert!(!own.contains(['<', '&']) && own.len() > 100);
        }
    }
}
