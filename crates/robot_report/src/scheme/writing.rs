//! The dimension lines and labels of the scheme.

use nalgebra::{Vector2, Vector3};
use robot_document::document::Inline;
use robot_document::math::Math;
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::{Formula, Graph};

use super::draw::{Drawing, hue};
use super::labels::{CROSSED, Candidate, Rectangle, Room};
use super::layout::{BASE, Segment};
use super::shape::{Group, Shape, Words, arrow, group, line};
use super::symbols;
use crate::parts;
use crate::text;

type Point = Vector2<f64>;

/// The font size of labels.
const LETTERS: f64 = 14.0;
/// The font size of the letters at the axes of frames.
const SMALL: f64 = 11.0;
/// The possible distances of a dimension line from its link.
const BESIDE: [f64; 8] = [20.0, -20.0, 32.0, -32.0, 48.0, -48.0, 66.0, -66.0];
/// The places of a label along its dimension line, as fractions of the length.
const ALONG: [f64; 7] = [0.5, 0.35, 0.65, 0.2, 0.8, 0.0, 1.0];
/// The distance from the end of an axis, beyond the nearest place, within which its letter is placed.
const AT_AXIS: f64 = 14.0;
/// The distance from other points within which labels are placed.
const ANYWHERE: f64 = 200.0;

/// A label without a place.
struct Label {
    /// The shapes that belong to it.
    group: Group,
    /// The text for pages, and the text or formula for documents.
    words: String,
    inline: Inline,
    /// The font size.
    size: f64,
    /// The possible places.
    places: Vec<Candidate>,
}

impl Drawing<'_> {
    /// The dimension lines and labels, and the rectangle around everything that is drawn.
    pub(super) fn written(&mut self) -> (Vec<Shape>, Option<Rectangle>) {
        let (labels, placed) = self.placed();
        let bounds = self.room.bounds(&placed);
        let shapes = labels.into_iter().zip(placed).map(|(label, place)| {
            let leader = place.leader.map(|ends| line(&ends, false).class("leader"));
            let center = (place.label.low + place.label.high) / 2.0;
            let Label { group, words: text, inline, size, .. } = label;
            group.with_all(leader).with(Words { center, text, inline, size }).into()
        });
        (shapes.collect(), bounds)
    }

    /// All labels with their places.
    fn placed(&mut self) -> (Vec<Label>, Vec<Candidate>) {
        let mut segments: Vec<&Segment> = vec![];
        for segment in self.places().flat_map(|place| &place.path) {
            // One dimension is enough for two frames at the same place, and for the way there and back.
            if !segments.iter().any(|known| is_same(known, segment)) {
                segments.push(segment);
            }
        }
        let mut labels: Vec<Label> = vec![];
        for segment in segments {
            labels.extend(self.dimension(segment, &labels));
        }
        for index in 0..self.layout.links.len() {
            labels.extend(self.names(index));
        }
        for (index, place) in &self.layout.frames {
            if let Some(frame) = self.robot.frames.get(*index) {
                let point = self.view.point(&place.position);
                labels.push(name(&frame.name, point, 12.0, None));
            }
        }
        let bases = self.layout.bases.iter().filter_map(|index| self.robot.frames.get(*index));
        let bases: Vec<&str> = bases.map(|frame| frame.name.as_str()).collect();
        let base = if bases.is_empty() { "base".to_owned() } else { bases.join(", ") };
        let point = self.view.point(&BASE) + Point::new(0.0, 8.0);
        labels.push(name(&base, point, 10.0, None));
        for place in self.places() {
            for (axis, name) in place.rotation.column_iter().zip(["x", "y", "z"]) {
                let ends = [0.0, symbols::TRIAD]
                    .map(|reach| self.view.point(&(place.position + axis * reach)));
                labels.push(letter(name, ends));
            }
        }
        let places: Vec<Vec<Candidate>> = labels.iter().map(|label| label.places.clone()).collect();
        let placed = self.room.settled(&places);
        (labels, placed)
    }

    /// The name of the coordinate at the joint axis, and the name of the link beside the joint.
    fn names(&self, index: usize) -> Vec<Label> {
        let (Some(link), Some(place)) = (self.robot.links.get(index), self.layout.links.get(index))
        else {
            return vec![];
        };
        let [_, end] = self.arrow(place);
        let symbol = JointVariable::Position.symbol(link.joint.coordinate);
        let inline = Inline::Math(self.table.look(&symbol));
        let coordinate = label(text::symbol(&symbol), inline, end, 4.0, "coordinate", Some(index));
        let point = self.view.point(&place.position);
        let gap = symbols::HALF + 2.0;
        vec![coordinate, name(&link.name, point, gap, Some(index))]
    }

    /// A dimension line beside a piece of a link, with the length. It reserves the space of its lines, and leaves room for
    /// the lengths at the dimension lines before it.
    fn dimension(&mut self, segment: &Segment, before: &[Label]) -> Option<Label> {
        let length = segment.length.as_ref()?;
        let [from, to] = segment.ends.each_ref().map(|end| self.view.point(end));
        let along = (to - from).try_normalize(8.0)?;
        let across = Point::new(-along.y, along.x);
        let (words, of) = length_words(self.robot, length);
        let size = size_of(&words, LETTERS);
        let lines = |offset: f64| {
            let ends = [from, to].map(|end| end + across * offset);
            let over = across * 4f64.copysign(offset);
            [ends, [from, ends[0] + over], [to, ends[1] + over]]
        };
        let places = |offset: f64| beside(&lines(offset)[0], size);
        let best_of = |label: &Label| self.room.cheapest(&label.places).map(|place| place.label);
        let lengths: Vec<Rectangle> = before.iter().filter_map(best_of).collect();
        let covered = |line: &[Point; 2]| {
            CROSSED * lengths.iter().map(|length| length.length_within(line)).sum::<f64>()
        };
        let cost = |offset: &f64| {
            let [dimension, first, second] = lines(*offset);
            let covered: f64 = lines(*offset).iter().map(covered).sum();
            let witnesses = self.room.cost_of_line(first) + self.room.cost_of_line(second);
            let label = places(*offset).into_iter();
            let label = label.map(|place| place.cost + self.room.cost(&place.label));
            let label = label.fold(f64::INFINITY, f64::min);
            3.0 * self.room.cost_of_line(dimension) + witnesses + label + covered + offset.abs()
        };
        let best = BESIDE.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
        let [ends, witnesses @ ..] = lines(best);
        let mut group = group().class("dimension");
        if !of.is_empty() {
            group = group.attribute("data-is", of);
        }
        group = group.with_all(witnesses.map(|ends| line(&ends, false).class("witness")));
        let middle = (ends[0] + ends[1]) / 2.0;
        group = group.with_all(arrow(middle, ends[0], 6.0)).with_all(arrow(middle, ends[1], 6.0));
        for [from, to] in lines(best) {
            self.room.reserve_line(from, to);
        }
        let mut places = places(best);
        places.extend(Room::around(middle, size, 4.0, ANYWHERE));
        let inline = self.length(length, &words);
        Some(Label { group, words, inline, size: LETTERS, places })
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

    /// The leaders of labels.
    #[cfg(test)]
    pub(crate) fn leaders(mut self) -> Vec<(String, [Point; 2])> {
        self.reserve_room();
        let (labels, placed) = self.placed();
        let shown = labels.into_iter().zip(placed);
        shown.filter_map(|(label, place)| Some((label.words, place.leader?))).collect()
    }

    /// The places of all labels, and how far each is crossed by lines, in px.
    #[cfg(test)]
    pub(crate) fn labels(mut self) -> Vec<(String, Rectangle, f64)> {
        self.reserve_room();
        let (labels, placed) = self.placed();
        let crossed = |label: &Rectangle| self.room.length_within(label);
        let shown = labels.into_iter().zip(placed);
        shown.map(|(label, place)| (label.words, place.label, crossed(&place.label))).collect()
    }
}

/// Whether two pieces have the same ends and the same length, apart from its sign.
fn is_same(one: &Segment, other: &Segment) -> bool {
    let [Some(first), Some(second)] = [&one.length, &other.length] else { return false };
    let bare = |length: &Formula| length.text().trim_start_matches('-').to_owned();
    let [from, to] = &other.ends;
    let are_ends = |ends: [&Vector3<f64>; 2]| {
        one.ends.iter().zip(ends).all(|(end, other)| (end - other).norm() < 1e-6)
    };
    bare(first) == bare(second) && (are_ends([from, to]) || are_ends([to, from]))
}

/// The places of a label on both sides of a dimension line.
fn beside([from, to]: &[Point; 2], size: Point) -> Vec<Candidate> {
    let Some(along) = (to - from).try_normalize(1e-9) else { return vec![] };
    let across = Point::new(-along.y, along.x);
    // The distance at which the label touches the line.
    let off = across.abs().component_mul(&size).sum() / 2.0 + 3.0;
    let places = ALONG.into_iter().flat_map(|part| [off, -off].map(|off| (part, off)));
    places
        .map(|(part, off)| {
            let center = from + (to - from) * part + across * off;
            let away = (part - 0.5).abs() * (to - from).norm();
            Candidate::near(Rectangle::about(center, size), 0.4 * away)
        })
        .collect()
}

/// A name near a point. If it is too long, it is shortened and has the whole name as its title.
fn name(words: &str, point: Point, gap: f64, link: Option<usize>) -> Label {
    let shown = text::shortened(words, 22);
    let inline = Inline::text(&shown);
    let is_whole = shown == words;
    let label = label(shown, inline, point, gap, "name", link);
    match is_whole {
        true => label,
        false => Label { group: label.group.with(Shape::Title(words.to_owned())), ..label },
    }
}

/// A text near a point, with a line to it if it is far away.
fn label(
    words: String,
    inline: Inline,
    point: Point,
    gap: f64,
    class: &str,
    link: Option<usize>,
) -> Label {
    let hue = link.map(hue).unwrap_or_default();
    let mut group = group().class(format!("{class} {hue}").trim_end());
    if let Some(link) = link {
        group = group.attribute("data-is", parts::link(link));
    }
    let places = Room::around(point, size_of(&words, LETTERS), gap, ANYWHERE);
    Label { group, words, inline, size: LETTERS, places }
}

/// The letter of an axis near the end of the axis, preferably beyond it.
fn letter(name: &str, [origin, end]: [Point; 2]) -> Label {
    let class = match name {
        "x" => "axis-x",
        "y" => "axis-y",
        _ => "axis-z",
    };
    let inline = Inline::Math(Math::row(name.chars().map(Math::Letter).collect()));
    let onward = (end - origin).try_normalize(1e-9).unwrap_or_default();
    let places = Room::around(end, size_of(name, SMALL), 1.0, AT_AXIS).into_iter();
    let places = places.map(|place| {
        let center = (place.label.low + place.label.high) / 2.0;
        let way = (center - end).try_normalize(1e-9).unwrap_or_default();
        // A letter has no line to its axis, so that it stays near the end.
        Candidate::near(place.label, 3.0 * place.cost + 8.0 * (1.0 - way.dot(&onward)))
    });
    let group = group().class(class);
    Label { group, words: name.to_owned(), inline, size: SMALL, places: places.collect() }
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
