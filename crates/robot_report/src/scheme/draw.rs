//! The drawing of a layout.

use nalgebra::Vector2;
use robot_document::document::Inline;
use robot_document::figure::Figure;
use robot_document::markup::{Element, element, holding};
use robot_document::math::Math;
use robot_document::robot::words;
use robot_document::{SymbolTable, Trigonometry};
use robot_model::robot::{JointKind, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::{Formula, Graph};

use super::labels::{Rectangle, Room};
use super::layout::{BASE, Layout, Place, Segment};
use super::shape::{Group, Shape, Words, arrow, group, line};
use super::style::Style;
use super::symbols;
use super::view::View;
use crate::drawing::coordinate;
use crate::parts;
use crate::text;

type Point = Vector2<f64>;

/// A drawing under construction. Labels are placed last, where there is space.
pub(crate) struct Drawing<'r> {
    robot: &'r Robot,
    layout: &'r Layout,
    view: View,
    room: Room,
    /// The dimension lines and labels, which are drawn on top of everything else.
    written: Vec<Shape>,
    /// The layouts of symbols in documents.
    table: SymbolTable,
}

/// The font size of labels.
const LETTERS: f64 = 14.0;
/// The font size of the letters at the axes of frames.
const SMALL: f64 = 11.0;
/// The possible distances of a dimension line from its link.
const BESIDE: [f64; 6] = [20.0, -20.0, 32.0, -32.0, 48.0, -48.0];

/// The distance of a joint's arrow from the joint axis, if a link covers the axis.
const BESIDE_AXIS: f64 = 18.0;
/// The distance from the centerline of a link within which a point is covered.
const COVERING: f64 = 7.0;

impl<'r> Drawing<'r> {
    /// Creates the drawing of a layout, seen from a view.
    pub(crate) fn of(robot: &'r Robot, layout: &'r Layout, view: View) -> Drawing<'r> {
        let table = SymbolTable::new(robot, Trigonometry::Named)
            .unwrap_or_else(|_| SymbolTable::spelled(Trigonometry::Named));
        Drawing { robot, layout, view, room: Room::default(), written: vec![], table }
    }

    /// Returns the drawing as SVG.
    pub(crate) fn build(self) -> Element {
        let (title, description) =
            (format!("Kinematic scheme of {}", self.robot.name), self.description());
        let (shapes, bounds) = self.shapes();
        let (low, size) = (bounds.low, bounds.high - bounds.low);
        let [x, y, width, height] = [low.x, low.y, size.x, size.y].map(coordinate);
        element("svg")
            .attribute("xmlns", "http://www.w3.org/2000/svg")
            .attribute("viewBox", format!("{x} {y} {width} {height}"))
            .attribute("width", width)
            .attribute("height", height)
            .attribute("role", "img")
            .attribute("aria-labelledby", "scheme-title scheme-description")
            .with(holding("title", title).attribute("id", "scheme-title"))
            .with(holding("desc", description).attribute("id", "scheme-description"))
            .with_all(shapes.iter().map(Shape::svg))
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
        self.take_room();
        let links = 0..self.layout.links.len();
        let mut shapes: Vec<Shape> =
            vec![symbols::ground(self.view.point(&BASE)).into(), self.body(None).into()];
        shapes.extend(links.clone().map(|index| self.link(index).into()));
        shapes.extend(links.map(|index| self.joint(index).into()));
        let frames = self.layout.frames.iter();
        shapes.extend(frames.map(|(index, place)| self.frame(*index, place).into()));
        self.write();
        let bounds = self.room.bounds();
        let bounds = bounds.unwrap_or(Rectangle::about(Point::zeros(), Point::new(1.0, 1.0)));
        shapes.append(&mut self.written);
        let low = bounds.low.map(|side| (side - 12.0).round());
        let size = (bounds.high - bounds.low).map(|side| (side + 24.0).round());
        (shapes, Rectangle { low, high: low + size })
    }

    fn places(&self) -> impl Iterator<Item = &'r Place> + use<'r> {
        let layout = self.layout;
        layout.links.iter().chain(layout.frames.iter().map(|(_, place)| place))
    }

    /// Reserves the space of symbols and lines, so that labels are placed elsewhere.
    fn take_room(&mut self) {
        let size = Point::new(2.0, 2.0) * (symbols::HALF + 2.0);
        for place in &self.layout.links {
            self.room.take(Rectangle::about(self.view.point(&place.position), size));
            let ends =
                symbols::AXIS.map(|reach| self.view.point(&(place.position + place.axis * reach)));
            self.room.take_line(ends[0], ends[1]);
            let [from, to] = self.arrow(place);
            self.room.take_line(from, to);
        }
        for place in self.places() {
            for Segment { ends: [from, to], .. } in &place.path {
                self.room.take_line(self.view.point(from), self.view.point(to));
            }
            for axis in place.rotation.column_iter() {
                let end = place.position + axis * symbols::TRIAD;
                self.room.take_line(self.view.point(&place.position), self.view.point(&end));
            }
        }
        let base = self.view.point(&BASE);
        self.room.take(Rectangle::about(base + Point::new(0.0, 5.0), Point::new(60.0, 14.0)));
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

    /// Places all labels, starting with those that have the fewest possible places.
    fn write(&mut self) {
        for place in self.places() {
            for segment in &place.path {
                self.dimension(segment);
            }
        }
        for index in 0..self.layout.links.len() {
            self.names(index);
        }
        for (index, place) in &self.layout.frames {
            if let Some(frame) = self.robot.frames.get(*index) {
                let point = self.view.point(&place.position);
                let name = Inline::text(text::shortened(&frame.name, 22));
                self.label(&frame.name, name, point, 12.0, "name", None);
            }
        }
        let bases = self.layout.bases.iter().filter_map(|index| self.robot.frames.get(*index));
        let bases: Vec<&str> = bases.map(|frame| frame.name.as_str()).collect();
        let base = if bases.is_empty() { "base".to_owned() } else { bases.join(", ") };
        let point = self.view.point(&BASE) + Point::new(0.0, 8.0);
        self.label(&base, Inline::text(&base), point, 10.0, "name", None);
        for place in self.places() {
            for (axis, name) in place.rotation.column_iter().zip(["x", "y", "z"]) {
                let end = self.view.point(&(place.position + axis * symbols::TRIAD));
                self.letter(name, end);
            }
        }
    }

    /// The arrow in the positive direction of a joint: on the joint axis, or beside it if a link covers the axis.
    fn arrow(&self, place: &Place) -> [Point; 2] {
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
        let distance = |segment: &Segment| {
            let [from, to] = segment.ends.each_ref().map(|end| self.view.point(end));
            let along = to - from;
            let part = (point - from).dot(&along) / along.norm_squared().max(1e-9);
            (point - from - along * part.clamp(0.0, 1.0)).norm()
        };
        segments.map(|segment| (COVERING - distance(segment)).max(0.0)).fold(0.0, f64::max)
    }

    /// Places the name of the coordinate at the joint axis, and the name of the link beside the joint.
    fn names(&mut self, index: usize) {
        let (Some(link), Some(place)) = (self.robot.links.get(index), self.layout.links.get(index))
        else {
            return;
        };
        let [_, end] = self.arrow(place);
        let name = JointVariable::Position.symbol(link.joint.coordinate);
        let inline = Inline::Math(self.table.look(&name));
        self.label(&text::symbol(&name), inline, end, 4.0, "coordinate", Some(index));
        let point = self.view.point(&place.position);
        let name = Inline::text(text::shortened(&link.name, 22));
        self.label(&link.name, name, point, symbols::HALF + 2.0, "name", Some(index));
    }

    /// Draws a dimension line with the length beside a piece of a link.
    fn dimension(&mut self, segment: &Segment) {
        let Some(length) = &segment.length else { return };
        let [from, to] = segment.ends.each_ref().map(|end| self.view.point(end));
        let Some(along) = (to - from).try_normalize(8.0) else { return };
        let across = Point::new(-along.y, along.x);
        let (words, of) = length_words(self.robot, length);
        let inline = self.length(length, &words);
        let size = size_of(&words, LETTERS);
        let label = |offset: f64| {
            let beside = across * offset;
            let off = beside.abs().component_mul(&size).sum() / (2.0 * offset.abs()) + 3.0;
            let center = (from + to) / 2.0 + across * (offset + off.copysign(offset));
            Rectangle::about(center, size)
        };
        let beside = |offset: f64| {
            let middle = (from + to) / 2.0 + across * offset;
            Rectangle::about(middle, along.abs() * (to - from).norm() + across.abs() * 4.0)
        };
        let cost = |offset: &f64| {
            self.room.cost(&label(*offset)) + self.room.cost(&beside(*offset)) + offset.abs()
        };
        let best = BESIDE.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or(20.0);
        let ends = [from, to].map(|end| end + across * best);
        let over = across * 4f64.copysign(best);
        let mut group = group().class("dimension");
        if !of.is_empty() {
            group = group.attribute("data-is", of);
        }
        for (end, drawn) in [from, to].into_iter().zip(ends) {
            group = group.with(line(&[end, drawn + over], false).class("witness"));
        }
        let middle = (ends[0] + ends[1]) / 2.0;
        group = group.with_all(arrow(middle, ends[0], 6.0)).with_all(arrow(middle, ends[1], 6.0));
        self.room.take_line(ends[0], ends[1]);
        let place = label(best);
        // If this place is taken, the label goes to the best free place near it.
        let place = if self.room.cost(&place) < 1e3 {
            self.room.set(place);
            place
        } else {
            self.room.find(middle, size, 4.0)
        };
        self.written.push(group.with(words_at(&words, inline, &place, LETTERS)).into());
    }

    /// Places a name near a point, with a line to it if it is far away.
    fn label(
        &mut self,
        words: &str,
        inline: Inline,
        point: Point,
        gap: f64,
        class: &str,
        link: Option<usize>,
    ) {
        let shown = text::shortened(words, 22);
        let place = self.room.find(point, size_of(&shown, LETTERS), gap);
        let hue = link.map(hue).unwrap_or_default();
        let mut group = group().class(format!("{class} {hue}").trim_end());
        if let Some(link) = link {
            group = group.attribute("data-is", parts::link(link));
        }
        let nearest = point.sup(&place.low).inf(&place.high);
        if (nearest - point).norm() > gap + 20.0 {
            group = group.with(line(&[point, nearest], false).class("leader"));
        }
        if shown != words {
            group = group.with(Shape::Title(words.to_owned()));
        }
        self.written.push(group.with(words_at(&shown, inline, &place, LETTERS)).into());
    }

    /// Places the letter of an axis beyond the end of the axis.
    fn letter(&mut self, name: &str, end: Point) {
        let place = self.room.find(end, size_of(name, SMALL), 0.0);
        let class = match name {
            "x" => "axis-x",
            "y" => "axis-y",
            _ => "axis-z",
        };
        let letter = Inline::Math(Math::row(name.chars().map(Math::Letter).collect()));
        let text = words_at(name, letter, &place, SMALL);
        self.written.push(group().class(class).with(text).into());
    }

    /// A length for documents: its formula, without a minus sign if it is a symbol.
    fn length(&self, length: &Formula, words: &str) -> Inline {
        let graph = Graph::new();
        let value = length.lower(&graph, &mut |name| graph.symbol(name));
        if length.is_constant() {
            return Inline::text(words);
        }
        let formula = self.table.expression(value).unwrap_or_default();
        match formula.pieces() {
            [Math::Sign('-'), bare @ Math::Symbol(_)] => Inline::Math(bare.clone()),
            _ => Inline::Math(formula),
        }
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

    /// Whether labels overlap.
    #[cfg(test)]
    pub(crate) fn crowds(mut self) -> bool {
        self.take_room();
        self.write();
        self.room.is_crowded()
    }
}

/// The class for the color of a link.
fn hue(index: usize) -> String {
    format!("hue-{}", index % 8)
}

/// The length of an offset without its sign, and the tokens of its parameters.
fn length_words(robot: &Robot, length: &Formula) -> (String, String) {
    let tokens: Vec<String> = length.symbols().map(|(name, _)| parts::parameter(name)).collect();
    if length.is_constant() {
        let value = text::value(robot, length).abs();
        return (format!("{} m", text::number(value)), tokens.join(" "));
    }
    let plain = text::plain(length);
    let bare = plain.strip_prefix('−').unwrap_or(&plain);
    let is_symbol = robot.parameter(bare).is_some();
    let words = if is_symbol { text::symbol(bare) } else { plain };
    (text::shortened(&words, 22), tokens.join(" "))
}

/// The approximate size of a text.
fn size_of(words: &str, letters: f64) -> Point {
    Point::new((words.chars().count() as f64 * 0.6 + 0.3) * letters, letters * 1.15)
}

fn words_at(words: &str, inline: Inline, place: &Rectangle, letters: f64) -> Words {
    let center = (place.low + place.high) / 2.0;
    Words { center, text: words.to_owned(), inline, size: letters }
}
