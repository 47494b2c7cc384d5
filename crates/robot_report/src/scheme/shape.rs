//! The shapes of the scheme: SVG for a page; lines, curves and labels for a document.

use nalgebra::{Rotation2, Vector2};
use robot_document::document::Inline;
use robot_document::figure::{Label, Path, Segment};
use robot_document::markup::{Element, Node, element, holding};

use super::style::Style;
use crate::drawing;
use crate::drawing::coordinate;

type Point = Vector2<f64>;

/// A shape of the scheme.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// Shapes that belong together.
    Group(Group),
    /// A polyline, or a polygon if it is closed.
    Line(Line),
    /// A cylinder seen from the side.
    Cylinder(Cylinder),
    /// A text or a formula.
    Words(Words),
    /// The title that a page shows for the surrounding group.
    Title(String),
}

/// Shapes that belong together, with the attributes of their element on a page.
#[derive(Clone, Debug, Default)]
pub(crate) struct Group {
    attributes: Vec<(&'static str, String)>,
    parts: Vec<Shape>,
}

/// A polyline, or a polygon if it is closed.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    points: Vec<Point>,
    is_closed: bool,
    class: &'static str,
}

/// A cylinder, drawn as a strip between two ellipses.
#[derive(Clone, Debug)]
pub(crate) struct Cylinder {
    /// The center.
    pub(crate) center: Point,
    /// The direction of the axis on the page, in rad.
    pub(crate) turn: f64,
    /// Half the length on the page.
    pub(crate) half: f64,
    /// The radius: the semi-axis of the end ellipses across the axis.
    pub(crate) radius: f64,
    /// The semi-axis of the end ellipses along the axis.
    pub(crate) bulge: f64,
    /// Whether the visible end is the one in the direction of the axis.
    pub(crate) is_near: bool,
}

/// A text or a formula, centered on a point.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    pub(crate) center: Point,
    /// The text for a page.
    pub(crate) text: String,
    /// The text or formula for a document.
    pub(crate) inline: Inline,
    /// The font size.
    pub(crate) size: f64,
}

/// Creates a group without shapes.
pub(crate) fn group() -> Group {
    Group::default()
}

/// A polyline, or a polygon if it is closed.
pub(crate) fn line(points: &[Point], is_closed: bool) -> Line {
    Line { points: points.to_vec(), is_closed, class: "" }
}

/// A line with an arrowhead at its end.
pub(crate) fn arrow(from: Point, to: Point, head: f64) -> [Line; 2] {
    [line(&[from, to], false), line(&drawing::head(from, to, head), true).class("head")]
}

impl Line {
    pub(crate) fn class(mut self, class: &'static str) -> Line {
        self.class = class;
        self
    }
}

impl Group {
    pub(crate) fn class(self, value: impl Into<String>) -> Group {
        self.attribute("class", value)
    }

    pub(crate) fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Group {
        self.attributes.push((name, value.into()));
        self
    }

    pub(crate) fn with(mut self, part: impl Into<Shape>) -> Group {
        self.parts.push(part.into());
        self
    }

    pub(crate) fn with_all<S: Into<Shape>>(mut self, parts: impl IntoIterator<Item = S>) -> Group {
        self.parts.extend(parts.into_iter().map(Into::into));
        self
    }

    fn classes(&self) -> impl Iterator<Item = &str> {
        let classes = self.attributes.iter().filter(|(name, _)| *name == "class");
        classes.flat_map(|(_, value)| value.split(' '))
    }
}

impl From<Group> for Shape {
    fn from(group: Group) -> Shape {
        Shape::Group(group)
    }
}

impl From<Line> for Shape {
    fn from(line: Line) -> Shape {
        Shape::Line(line)
    }
}

impl From<Cylinder> for Shape {
    fn from(cylinder: Cylinder) -> Shape {
        Shape::Cylinder(cylinder)
    }
}

impl From<Words> for Shape {
    fn from(words: Words) -> Shape {
        Shape::Words(words)
    }
}

impl Shape {
    /// Returns the shape as SVG.
    pub(crate) fn svg(&self) -> Element {
        match self {
            Shape::Group(group) => {
                let attributes = group.attributes.iter();
                let whole = attributes.fold(element("g"), |whole, (name, value)| {
                    whole.attribute(name, value.as_str())
                });
                whole.with_all(group.parts.iter().map(|part| Node::from(part.svg())))
            }
            Shape::Line(Line { points, is_closed, class }) => {
                let path = drawing::path(points, *is_closed);
                if class.is_empty() { path } else { path.class(*class) }
            }
            Shape::Cylinder(cylinder) => cylinder.svg(),
            Shape::Words(Words { center, text, size, .. }) => holding("text", text.as_str())
                .attribute("x", coordinate(center.x))
                .attribute("y", coordinate(center.y + 0.35 * size))
                .attribute("font-size", coordinate(*size))
                .attribute("text-anchor", "middle"),
            Shape::Title(title) => holding("title", title.as_str()),
        }
    }

    /// Appends the shape as lines, curves and labels. Groups and lines change the style for what they contain.
    pub(crate) fn draw(&self, style: &Style, drawn: &mut Vec<robot_document::figure::Shape>) {
        use robot_document::figure::Shape as Drawn;
        match self {
            Shape::Group(group) => {
                let style = group.classes().fold(style.clone(), Style::with);
                group.parts.iter().for_each(|part| part.draw(&style, drawn));
            }
            Shape::Line(Line { points, is_closed, class }) => {
                let style = class.split(' ').fold(style.clone(), Style::with);
                let mut points = points.iter().map(|point| [point.x, point.y]);
                if let Some(start) = points.next() {
                    let segments = points.map(Segment::Line).collect();
                    drawn.push(Drawn::Path(style.path(start, segments, *is_closed)));
                }
            }
            Shape::Cylinder(cylinder) => {
                drawn.extend(cylinder.paths(style).map(Drawn::Path));
            }
            Shape::Words(Words { center, inline, size, .. }) => drawn.push(Drawn::Label(Label {
                center: [center.x, center.y],
                words: inline.clone(),
                size: *size,
                is_bold: style.is_bold,
                color: style.text,
            })),
            Shape::Title(_) => {}
        }
    }
}

/// The distance between the ends of a quarter of a unit circle and their control points.
const QUARTER: f64 = 0.552_284_75;

impl Cylinder {
    fn near(&self) -> f64 {
        if self.is_near { self.half } else { -self.half }
    }

    /// Draws the cylinder with x along its axis on the page.
    fn svg(&self) -> Element {
        let [half, bulge, radius] = [self.half, self.bulge, self.radius].map(coordinate);
        let arc = |x: &str, y: &str| format!("A{bulge} {radius} 0 0 1 {x} {y}");
        let outline = format!(
            "M-{half} -{radius}L{half} -{radius}{}L-{half} {radius}{}Z",
            arc(&half, &radius),
            arc(&format!("-{half}"), &format!("-{radius}")),
        );
        let [x, y, turn] = [self.center.x, self.center.y, self.turn.to_degrees()].map(coordinate);
        let cap = element("ellipse")
            .attribute("cx", coordinate(self.near()))
            .attribute("cy", "0")
            .attribute("rx", bulge.as_str())
            .attribute("ry", radius.as_str());
        element("g")
            .class("joint")
            .attribute("transform", format!("translate({x} {y}) rotate({turn})"))
            .with(element("path").attribute("d", outline))
            .with(cap)
    }

    /// The outline and the visible end.
    fn paths(&self, style: &Style) -> [Path; 2] {
        let style = style.clone().with("joint");
        let turn = Rotation2::new(self.turn);
        let point = |x: f64, y: f64| {
            let turned = self.center + turn * Point::new(x, y);
            [turned.x, turned.y]
        };
        let (radius, bulge) = (self.radius, self.bulge);
        // Half an ellipse around (x, 0): from its upper to its lower end if `side` is 1, otherwise back.
        let half_ellipse = |x: f64, side: f64| {
            let (out, near) = (bulge * side, QUARTER * side);
            [
                Segment::Curve([
                    point(x + near * bulge, -radius * side),
                    point(x + out, -QUARTER * radius * side),
                    point(x + out, 0.0),
                ]),
                Segment::Curve([
                    point(x + out, QUARTER * radius * side),
                    point(x + near * bulge, radius * side),
                    point(x, radius * side),
                ]),
            ]
        };
        let mut outline = vec![Segment::Line(point(self.half, -radius))];
        outline.extend(half_ellipse(self.half, 1.0));
        outline.push(Segment::Line(point(-self.half, radius)));
        outline.extend(half_ellipse(-self.half, -1.0));
        let near = self.near();
        let cap = [half_ellipse(near, 1.0), half_ellipse(near, -1.0)].concat();
        [
            style.path(point(-self.half, -radius), outline, true),
            style.path(point(near, -radius), cap, true),
        ]
    }
}
