//! The frame of the page: its head, contents and sections.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use robot_build::MARKER;
use robot_document::markup::{Element, Node, element, holding};
use robot_document::math_font;
use robot_model::robot::Robot;

use crate::live::{self, Live};
use crate::reload::Stamp;

/// The style sheet of pages.
pub(crate) const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = concat!(include_str!("script.js"), include_str!("search.js"));
/// The script that reloads the page.
const RELOAD: &str = include_str!("reload.js");

/// The variables of the style sheet with their values in light colors.
pub(crate) fn declared() -> impl Iterator<Item = (&'static str, &'static str)> {
    let light = STYLE.split("@media").next().unwrap_or_default();
    let declared = light.split([';', '{', '/']).filter_map(|one| one.trim().strip_prefix("--"));
    declared.filter_map(|one| one.split_once(':')).map(|(name, value)| (name, value.trim()))
}

/// The pixels of a rem.
const REM: f64 = 16.0;

/// A length of the style sheet in pixels: a variable in rem.
fn length(name: &str) -> f64 {
    let value =
        declared().find(|(own, _)| *own == name).and_then(|(_, value)| value.strip_suffix("rem"));
    value.and_then(|number| number.parse().ok()).map_or(0.0, |number: f64| REM * number)
}

/// The width that a wide screen has for what stands side by side, in pixels, without the gap between two.
pub(crate) fn side_by_side() -> f64 {
    length("page") - 2.0 * length("edge") - length("gap")
}

/// A section of the page.
#[derive(Clone)]
pub(crate) struct Section {
    /// The anchor.
    pub(crate) id: &'static str,
    /// The heading.
    pub(crate) title: &'static str,
    /// The content.
    pub(crate) body: Vec<Node>,
}

/// Makes the page of a robot, with the moving robot if there is one. With a stamp, the page reloads itself when the
/// picture beside it has another stamp.
pub(crate) fn page(
    robot: &Robot,
    live: Option<&Live>,
    sections: Vec<Section>,
    stamp: Option<Stamp>,
) -> String {
    let contents = sections.iter().map(|section| {
        let anchor = format!("#{}", section.id);
        holding("li", holding("a", section.title).attribute("href", anchor))
    });
    let entry = holding("li", holding("a", "Live").attribute("href", "#live"));
    let entry = live.map(|_| entry.attribute("data-live", "").attribute("hidden", "hidden"));
    let contents = entry.into_iter().chain(contents);
    let contents = element("nav")
        .attribute("aria-label", "Contents")
        .with(element("ol").with_all(contents))
        .with(search());
    let main = sections.into_iter().map(|section| {
        let heading = format!("{}-heading", section.id);
        element("section")
            .attribute("id", section.id)
            .attribute("aria-labelledby", &heading)
            .with(holding("h2", section.title).attribute("id", &heading))
            .with_all(section.body)
    });
    let first = live.map(|live| live.section.clone());
    let script = |text| element("script").with(Node::Verbatim(text));
    let body = element("body")
        .with(holding("a", "Skip to content").class("skip").attribute("href", "#content"))
        .with(header(robot))
        .with(contents)
        .with(element("main").attribute("id", "content").with_all(first).with_all(main))
        .with(footer())
        .with(script(SCRIPT))
        .with_all(live.map(|_| script(live::SCRIPT)));
    let html =
        element("html").attribute("xmlns", "http://www.w3.org/1999/xhtml").attribute("lang", "en");
    let (html, body) = match stamp {
        None => (html, body),
        Some(stamp) => (html.attribute("data-page", stamp.words()), body.with(script(RELOAD))),
    };
    let html = html.with(head(robot, live.is_some(), stamp.is_some())).with(body);
    format!("<!DOCTYPE html>\n<!-- {MARKER} -->\n{html}\n")
}

fn head(robot: &Robot, moves: bool, reloads: bool) -> Element {
    let meta = |name: &'static str, value: &str| {
        element("meta").attribute("name", name).attribute("content", value)
    };
    let policy = element("meta")
        .attribute("http-equiv", "Content-Security-Policy")
        .attribute("content", policy(moves, reloads));
    element("head")
        .with(element("meta").attribute("charset", "utf-8"))
        .with(policy)
        .with(meta("viewport", "width=device-width, initial-scale=1"))
        .with(meta("color-scheme", "light dark"))
        .with(meta("referrer", "no-referrer"))
        .with(holding("title", format!("{}: equations of motion", robot.name)))
        .with(element("style").with(Node::Verbatim(STYLE)))
        .with(element("style").with(Node::Verbatim(&math_font::RULES)))
        .with_all(moves.then(|| element("style").with(Node::Verbatim(live::STYLE))))
}

/// The content security policy. It allows the page's own styles and scripts by their hashes and the embedded font of
/// equations. A page that reloads itself can also load the picture beside it, and one with a moving robot its own
/// WebAssembly module.
fn policy(moves: bool, reloads: bool) -> String {
    let hash = |text: &str| {
        let hash = BASE64_STANDARD.encode(hmac_sha256::Hash::hash(text.as_bytes()));
        format!("'sha256-{hash}'")
    };
    let (style, script) = match moves {
        false => (String::new(), String::new()),
        true => (
            format!(" {}", hash(live::STYLE)),
            format!(" {} 'wasm-unsafe-eval'", hash(live::SCRIPT)),
        ),
    };
    let more = match reloads {
        false => String::new(),
        true => format!(" {}; img-src 'self' file:", hash(RELOAD)),
    };
    format!(
        "default-src 'none'; style-src {} {}{style}; font-src data:; script-src {}{script}{more}; base-uri 'none'; \
         form-action 'none'",
        hash(STYLE),
        hash(&math_font::RULES),
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

/// The field that searches the page; the script shows it.
fn search() -> Element {
    let button = |sign: &'static str, step: &'static str, name: &'static str| {
        holding("button", sign)
            .attribute("type", "button")
            .attribute("value", step)
            .attribute("aria-label", name)
            .attribute("title", name)
    };
    let field = element("input")
        .attribute("type", "search")
        .attribute("aria-label", "Search the page: symbol, link, joint, parameter or word")
        .attribute("placeholder", "Search: l_4, gravity, …")
        .attribute(
            "title",
            "Press / to search, Enter and Shift+Enter to move between hits, Escape to clear",
        )
        .attribute("enterkeyhint", "search")
        .attribute("autocapitalize", "none")
        .attribute("autocomplete", "off")
        .attribute("spellcheck", "false");
    element("div")
        .class("search")
        .attribute("role", "search")
        .attribute("hidden", "hidden")
        .with(field)
        .with(element("span").attribute("role", "status"))
        .with(button("‹", "-1", "Previous hit"))
        .with(button("›", "1", "Next hit"))
}

fn footer() -> Element {
    let version = env!("CARGO_PKG_VERSION");
    let words =
        format!("Written by robot-symbolic {version}. Units are SI, with angles in radians.");
    holding("footer", holding("p", words))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Styles and scripts are written without escaping, so they must not contain markup.
    #[test]
    fn style_and_script_have_no_signs_of_markup() {
        for own in [STYLE, SCRIPT, RELOAD, live::STYLE, live::SCRIPT] {
            assert!(!own.contains(['<', '&']) && own.len() > 100);
        }
    }

    /// Whether tables stand beside the scheme depends on these lengths.
    #[test]
    fn lengths_are_those_of_the_style_sheet() {
        assert_eq!(["page", "edge", "gap"].map(length), [1216.0, 24.0, 32.0]);
        assert_eq!(side_by_side(), 1136.0);
        for used in ["max-width: var(--page)", "padding: 1rem var(--edge) 3rem", "gap: var(--gap)"]
        {
            assert!(STYLE.contains(used), "{used}");
        }
    }
}
