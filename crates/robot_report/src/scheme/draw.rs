//! The drawing of a layout.

use nalgebra::Vector2;
use robot_document::figure::Figure;
use robot_document::markup::{element, holding};
use robot_document::robot::words;
use robot_document::{SymbolTable, Trigonometry};
use robot_model::robot::{JointKind, Robot};

use super::Picture;
use super::labels::{Rectangle, Room, distance};
use super::layout::{BASE, Layout, Place, Segment};
use super::shape::{Group, Shape, arrow, group, line};
use super::style::Style;
use super::symbols;
use super::view::View;
use crate::drawing::coordinate;
use crate::parts;

type Point = Vector2<f64>;

/// A drawing under construction. Labels are placed last, where there is space, see [`super::writing`].
pub(crate) struct Drawing<'r> {
    pub(super) robot: &'r Robot,
    pub(super) layout: &'r Layout,
    pub(super) view: View,
    pub(super) room: Room,
    /// The layouts of symbols in documents.
    pub(super) table: SymbolTable,
}

/// The distance from the origin of a named frame within which its symbol is drawn.
const HAND: f64 = 12.0;
/// The distance of a joint's arrow from the joint axis, if a link covers the axis.
const BESIDE_AXIS: f64 = 18.0;
/// The distance from the centerline of a link within which a point is covered.
const COVERING: f64 = 7.0;

impl<'r> Drawing<'r> {
    /// Creates the drawing of a layout, seen from a view.
    pub(crate) fn of(robot: &'r Robot, layout: &'r Layout, view: View) -> Drawing<'r> {
        let table = SymbolTable::new(robot, Trigonometry::Named)
            .unwrap_or_else(|_| SymbolTable::spelled(Trigonometry::Named));
        Drawing { robot, layout, view, room: Room::default(), table }
    }

    /// Returns the drawing as SVG.
    pub(crate) fn build(self) -> Picture {
        let (title, description) =
            (format!("Kinematic scheme of {}", self.robot.name), self.description());
        let (shapes, bounds) = self.shapes();
        let (low, size) = (bounds.low, bounds.high - bounds.low);
        let [x, y, width, height] = [low.x, low.y, size.x, size.y].map(coordinate);
        let element = element("svg")
            .attribute("xmlns", "http://www.w3.org/2000/svg")
            .attribute("viewBox", format!("{x} {y} {width} {height}"))
            .attribute("width", width)
            .attribute("height", height)
            .attribute("role", "img")
            .attribute("aria-labelledby", "scheme-title scheme-description")
            .with(holding("title", title).attribute("id", "scheme-title"))
            .with(holding("desc", description).attribute("id", "scheme-description"))
            .with_all(shapes.iter().map(Shape::svg));
        Picture { element, width: size.x, height: size.y }
    }

    /// Returns the drawing as a figure for documents.
    pub(crate) fn figure(self, caption: &str) -> Figure {
        let (shapes, Rectangle { low, high }) = self.shapes();
        let mut drawn = vec![];
        shapes.iter().for_each(|shape| shape.draw(&Style::default(), &mut drawn));
        let bounds = [low, high].map(|corner| [corner.x, corner.y]);
        Figure { caption: caption.to_owned(), bounds, shapes: drawn }
    }

    /// All shapes, and the rectangle around them.
    fn shapes(mut self) -> (Vec<Shape>, Rectangle) {
        self.reserve_room();
        let links = 0..self.layout.links.len();
        let mut shapes: Vec<Shape> =
            vec![symbols::ground(self.view.point(&BASE)).into(), self.body(None).into()];
        shapes.extend(links.clone().map(|index| self.link(index).into()));
        shapes.extend(links.map(|index| self.joint(index).into()));
        let frames = self.layout.frames.iter();
        shapes.extend(frames.map(|(index, place)| self.frame(*index, place).into()));
        let (written, bounds) = self.written();
        let bounds = bounds.unwrap_or(Rectangle::about(Point::zeros(), Point::new(1.0, 1.0)));
        shapes.extend(written);
        let low = bounds.low.map(|side| (side - 12.0).round());
        let size = (bounds.high - bounds.low).map(|side| (side + 24.0).round());
        (shapes, Rectangle { low, high: low + size })
    }

    pub(super) fn places(&self) -> impl Iterator<Item = &'r Place> + use<'r> {
        let layout = self.layout;
        layout.links.iter().chain(layout.frames.iter().map(|(_, place)| place))
    }

    /// Reserves the space of symbols and lines, so that labels are placed elsewhere.
    pub(super) fn reserve_room(&mut self) {
        for (link, place) in self.robot.links.iter().zip(&self.layout.links) {
            // The rails of a guide are longer than its box.
            let half = match link.joint.kind {
                JointKind::Revolute => symbols::HALF + 2.0,
                JointKind::Prismatic => symbols::HALF + 8.0,
            };
            let size = Point::new(2.0, 2.0) * half;
            self.room.reserve(Rectangle::about(self.view.point(&place.position), size));
            let ends =
                symbols::AXIS.map(|reach| self.view.point(&(place.position + place.axis * reach)));
            self.room.reserve_line(ends[0], ends[1]);
            let [from, to] = self.arrow(place);
            self.room.reserve_line(from, to);
        }
        for place in self.places() {
            for Segment { ends: [from, to], .. } in &place.path {
                self.room.reserve_line(self.view.point(from), self.view.point(to));
            }
            for axis in place.rotation.column_iter() {
                let end = place.position + axis * symbols::TRIAD;
                self.room.reserve_axis(self.view.point(&place.position), self.view.point(&end));
            }
        }
        for (_, place) in &self.layout.frames {
            let hand = Point::new(2.0, 2.0) * HAND;
            self.room.reserve(Rectangle::about(self.view.point(&place.position), hand));
        }
        let base = self.view.point(&BASE);
        self.room.reserve(Rectangle::about(base + Point::new(0.0, 5.0), Point::new(60.0, 14.0)));
    }

    /// The body of a link: the lines from its joint to the joints and frames that it carries.
    fn body(&self, carrier: Option<usize>) -> Group {
        let of_links = self.robot.links.iter().zip(&self.layout.links);
        let of_links = of_links.filter(|(link, _)| link.parent == carrier).map(|(_, place)| place);
        let of_frames = self.layout.frames.iter().filter_map(|(index, place)| {
            let frame = self.robot.frames.get(*index)?;
            (frame.link == carrier).then_some(place)
        });
        let segments = of_links.chain(of_frames).flat_map(|place| &place.path);
        let lines = segments.map(|segment| {
            let ends = segment.ends.each_ref().map(|end| self.view.point(end));
            let class = if segment.length.is_some() { "body" } else { "body apart" };
            line(&ends, false).class(class)
        });
        group().with_all(lines)
    }

    fn link(&self, index: usize) -> Group {
        let name = self.robot.links.get(index).map_or("", |link| link.name.as_str());
        self.body(Some(index))
            .attribute("id", format!("scheme-{}", parts::link(index)))
            .class(hue(index))
            .attribute("data-is", parts::link(index))
            .with(Shape::Title(format!("link {name}")))
    }

    fn joint(&self, index: usize) -> Group {
        let group = group().class(hue(index)).attribute("data-is", parts::link(index));
        let (Some(link), Some(place)) = (self.robot.links.get(index), self.layout.links.get(index))
        else {
            return group;
        };
        let (view, origin, axis) = (&self.view, &place.position, &place.axis);
        let sign = match link.joint.kind {
            JointKind::Revolute => Shape::from(symbols::cylinder(view, origin, axis)),
            JointKind::Prismatic => symbols::slider(view, origin, axis, &place.rotation).into(),
        };
        let motion = words::motion(link.joint.kind);
        let [from, to] = self.arrow(place);
        let way = super::shape::group().class("way").with_all(arrow(from, to, 9.0));
        group
            .with(Shape::Title(format!("joint {}, {motion}", link.joint.name)))
            .with(symbols::axis(view, origin, axis))
            .with(sign)
            .with(way)
            .with(symbols::triad(view, origin, &place.rotation))
    }

    fn frame(&self, index: usize, place: &Place) -> Group {
        let frame = self.robot.frames.get(index);
        let link = frame.and_then(|frame| frame.link);
        // Only a frame at the end of an arm has a hand.
        let carries =
            link.is_none() || self.robot.links.iter().any(|carried| carried.parent == link);
        let is_hand = frame.is_some_and(|frame| frame.wrench.is_some()) || !carries;
        let hand = is_hand.then(|| symbols::hand(&self.view, &place.position, &place.axis));
        let group = group().with_all(hand).with(symbols::triad(
            &self.view,
            &place.position,
            &place.rotation,
        ));
        match link {
            Some(link) => group.class(hue(link)).attribute("data-is", parts::link(link)),
            None => group,
        }
    }

    /// The arrow in the positive direction of a joint: on the joint axis, or beside it if a link covers the axis.
    pub(super) fn arrow(&self, place: &Place) -> [Point; 2] {
        let [_, reach] = symbols::AXIS;
        let on = [symbols::HALF + 4.0, reach]
            .map(|reach| self.view.point(&(place.position + place.axis * reach)));
        let Some(along) = (on[1] - on[0]).try_normalize(1.0) else { return on };
        let across = Point::new(-along.y, along.x) * BESIDE_AXIS;
        let beside = |side: f64| on.map(|end| end + across * side);
        let sides = [on, beside(1.0), beside(-1.0)];
        let hidden = |ends: &&[Point; 2]| self.covered((ends[0] + ends[1]) / 2.0);
        sides.iter().min_by(|a, b| hidden(a).total_cmp(&hidden(b))).copied().unwrap_or(on)
    }

    /// How deeply a point is covered by a link.
    fn covered(&self, point: Point) -> f64 {
        let segments = self.places().flat_map(|place| &place.path);
        let ends = |segment: &Segment| segment.ends.each_ref().map(|end| self.view.point(end));
        let depth = |segment| (COVERING - distance(point, &ends(segment))).max(0.0);
        segments.map(depth).fold(0.0, f64::max)
    }

    fn description(&self) -> String {
        let mut words = format!("{} joints. ", self.robot.links.len());
        for link in &self.robot.links {
            let carrier = link.parent.and_then(|parent| self.robot.links.get(parent));
            let carrier = carrier.map_or("the base", |carrier| carrier.name.as_str());
            words.push_str(&format!(
                "The parent of link {} is {carrier}, connected by a {} joint. ",
                link.name,
                words::motion(link.joint.kind)
            ));
        }
        words.trim_end().to_owned()
    }
}

/// The class for the color of a link.
pub(super) fn hue(index: usize) -> String {
    format!("hue-{}", index % 8)
}
