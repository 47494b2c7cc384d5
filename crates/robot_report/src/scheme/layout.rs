//! The positions of the joints in the scheme. They follow from the offsets of the robot file at q = 0, in the base
//! frame. Short offsets are lengthened, negligible ones are omitted, and joints at the same point are drawn apart.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use robot_document::robot::words;
use robot_model::robot::{Axis, Frame, Joint, JointKind, Move, Placement, Robot};
use robot_symbolic::{Formula, Rational};

use super::view::View;
use crate::text;

/// The drawn length of the longest offset.
const LONGEST: f64 = 190.0;
/// The smallest drawn length of an offset.
const SHORTEST: f64 = 58.0;
/// The distance at which joints at the same point are drawn apart.
const SPREAD: f64 = 86.0;
/// The distance on the page below which joints are drawn apart.
const CLOSE: f64 = 46.0;
/// The fraction of the longest offset below which an offset is omitted.
const NEGLIGIBLE: f64 = 0.01;
/// The value of a length whose parameters have no values, in m.
const UNKNOWN: f64 = 0.3;

/// The robot on the page, in units of the page.
pub(crate) struct Layout {
    /// The links in the order of the robot file, each at its joint.
    pub(crate) links: Vec<Place>,
    /// The named frames that are drawn, with their indices.
    pub(crate) frames: Vec<(usize, Place)>,
    /// The indices of named frames that coincide with the base.
    pub(crate) bases: Vec<usize>,
}

/// A frame on the page.
pub(crate) struct Place {
    /// The origin of the frame.
    pub(crate) position: Vector3<f64>,
    /// The rotation matrix, whose columns are the frame's axes in the base frame.
    pub(crate) rotation: Matrix3<f64>,
    /// The unit vector of the joint axis in the base frame; for a named frame, that of the last offset.
    pub(crate) axis: Vector3<f64>,
    /// The pieces of its carrier's body that lead to it.
    pub(crate) path: Vec<Segment>,
}

/// A straight piece of a link, along an axis of a frame.
pub(crate) struct Segment {
    /// The two ends.
    pub(crate) ends: [Vector3<f64>; 2],
    /// The length in the robot file; `None` for a piece between two frames at the same point that are drawn apart.
    pub(crate) length: Option<Formula>,
}

/// The drawn lengths of offsets.
#[derive(Clone, Copy)]
struct Scale {
    /// The drawn length of 1 m.
    factor: f64,
    /// The smallest drawn length.
    shortest: f64,
    /// The drawn length below which an offset is omitted.
    negligible: f64,
}

/// The origin of the base.
pub(crate) const BASE: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

/// The largest number of frames that are all drawn; of more frames, only tips are.
const MAX_FRAMES: usize = 4;

/// Lays out the robot for a view, with offsets that are enlarged by a factor.
pub(crate) fn layout(robot: &Robot, view: &View, enlarged: f64) -> Layout {
    let scale = Scale {
        factor: enlarged * LONGEST / longest(robot).max(f64::MIN_POSITIVE),
        shortest: enlarged * SHORTEST,
        negligible: enlarged * NEGLIGIBLE * LONGEST,
    };
    let mut layout = Layout { links: vec![], frames: vec![], bases: vec![] };
    for link in &robot.links {
        let axis = link.joint.axis.each_ref().map(|part| value(robot, part));
        let axis = direction(&axis.into());
        let start = at_zero(robot, &link.joint, &link.placement, &axis);
        let mut place = layout.place(robot, view, scale, link.parent, &start, axis);
        if link.joint.kind == JointKind::Revolute {
            let angle = value(robot, &link.joint.offset);
            place.rotation *=
                Rotation3::from_axis_angle(&Unit::new_unchecked(axis), angle).into_inner();
        }
        // The arrow shows the direction in which the coordinate grows.
        place.axis *= 1_f64.copysign(value(robot, &link.joint.ratio));
        layout.links.push(place);
    }
    for (index, frame) in drawn_frames(robot) {
        let own = Vector3::zeros();
        // A frame at the origin of the base is part of the base.
        if frame.link.is_none() && words::moves(&frame.placement).next().is_none() {
            layout.bases.push(index);
            continue;
        }
        let place = layout.place(robot, view, scale, frame.link, &frame.placement, own);
        layout.frames.push((index, place));
    }
    layout
}

/// The named frames that are drawn, with their indices.
pub(crate) fn drawn_frames(robot: &Robot) -> impl Iterator<Item = (usize, &Frame)> {
    let crowded = robot.frames.len() > MAX_FRAMES;
    let frames = robot.frames.iter().enumerate();
    frames.filter(move |(_, frame)| !crowded || frame.wrench.is_some())
}

/// The largest component of all offsets, in m.
fn longest(robot: &Robot) -> f64 {
    let of_links = robot.links.iter().map(|link| &link.placement);
    let placements = of_links.chain(robot.frames.iter().map(|frame| &frame.placement));
    let moves = placements.flat_map(|placement| &placement.0);
    let lengths = moves.filter_map(|step| match step {
        Move::Translate(by) => {
            Some(by.iter().map(|part| value(robot, part).abs()).fold(0.0, f64::max))
        }
        Move::Rotate(..) => None,
    });
    lengths.fold(0.0, f64::max)
}

/// The placement of a link at coordinate 0. The offset of a prismatic joint that mimics another is a displacement along
/// the axis, whose direction is a unit vector in the link's axes.
fn at_zero(robot: &Robot, joint: &Joint, placement: &Placement, axis: &Vector3<f64>) -> Placement {
    let mut placement = placement.clone();
    let offset = value(robot, &joint.offset);
    if joint.kind == JointKind::Prismatic && offset != 0.0 {
        // Along an axis of the frame, the length keeps its symbol.
        let along = [axis.x, axis.y, axis.z].map(|part| match part {
            1.0 => joint.offset.clone(),
            part => Formula::number(&Rational::from_f64(offset * part).unwrap_or(Rational::ZERO)),
        });
        placement.0.push(Move::Translate(along));
    }
    placement
}

fn value(robot: &Robot, formula: &Formula) -> f64 {
    let nominal = text::value(robot, formula);
    if nominal.is_finite() { nominal } else { formula.evaluate(|_| UNKNOWN) }
}

impl Layout {
    /// Places a frame by its moves in the frame of its carrier; `axis` is given in the frame's own axes.
    fn place(
        &self,
        robot: &Robot,
        view: &View,
        scale: Scale,
        carrier: Option<usize>,
        placement: &Placement,
        axis: Vector3<f64>,
    ) -> Place {
        let carrier = carrier.and_then(|index| self.links.get(index));
        let start = carrier.map_or(BASE, |carrier| carrier.position);
        let outward = carrier.map_or(view.vertical, |carrier| carrier.axis);
        let mut rotation = carrier.map_or_else(Matrix3::identity, |carrier| carrier.rotation);
        let mut walk = Walk { position: start, path: vec![] };
        for step in &placement.0 {
            match step {
                Move::Translate(by) => walk.translate(robot, scale, &rotation, &outward, by),
                Move::Rotate(axis, angle) => rotation *= turn(*axis, value(robot, angle)),
            }
        }
        let axis = (rotation * axis).try_normalize(1e-9);
        if walk.path.is_empty() || self.room(view, &walk.position) < CLOSE {
            let own = axis.unwrap_or(outward);
            let before = carrier.and_then(|carrier| carrier.path.last());
            let before = walk.path.last().or(before);
            let before = before.map_or(view.vertical, |last| last.ends[1] - last.ends[0]);
            // After an offset, the frame can only move along its own axis, so that it stays off the carrier's axis.
            let outward = if walk.path.is_empty() { outward } else { own };
            let to = self.separated(view, walk.position, [own, outward], before);
            walk.step(to, None);
        }
        let along = walk.path.last().map(|last| last.ends[1] - last.ends[0]);
        let along = along.and_then(|last| last.try_normalize(1e-9)).unwrap_or(outward);
        Place { position: walk.position, rotation, axis: axis.unwrap_or(along), path: walk.path }
    }

    /// The smallest distance on the page of a place from the base and from all joints.
    fn room(&self, view: &View, place: &Vector3<f64>) -> f64 {
        let end = view.point(place);
        let taken = self.links.iter().map(|link| (view.point(&link.position) - end).norm());
        taken.fold((view.point(&BASE) - end).norm(), f64::min)
    }

    /// The displacement of a frame at the same place as its carrier, so that it is drawn beside it. It is along one of
    /// the joint axes, on which a joint can be drawn anywhere, or vertical: the direction with the most space is taken,
    /// preferably one that continues the line that leads there.
    fn separated(
        &self,
        view: &View,
        start: Vector3<f64>,
        axes: [Vector3<f64>; 2],
        before: Vector3<f64>,
    ) -> Vector3<f64> {
        let before = view.point(&before).try_normalize(1e-9).unwrap_or_default();
        let room = |direction: &Vector3<f64>| {
            let nearest = self.room(view, &(start + direction * SPREAD));
            let onward = view.point(direction).dot(&before);
            nearest.min(SPREAD) + 25.0 * onward
        };
        let [own, outward] = axes;
        let candidates = [outward, own, view.vertical, -outward, -own, -view.vertical];
        let best = candidates.into_iter().max_by(|a, b| room(a).total_cmp(&room(b)));
        best.unwrap_or(view.vertical) * SPREAD
    }
}

struct Walk {
    position: Vector3<f64>,
    path: Vec<Segment>,
}

impl Walk {
    /// Adds one piece for each component; the component along the carrier's joint axis comes first.
    fn translate(
        &mut self,
        robot: &Robot,
        scale: Scale,
        rotation: &Matrix3<f64>,
        outward: &Vector3<f64>,
        by: &[Formula; 3],
    ) {
        let mut parts: Vec<(Vector3<f64>, &Formula)> = by
            .iter()
            .enumerate()
            .map(|(axis, part)| (rotation.column(axis).into(), part))
            .collect();
        parts.sort_by(|a, b| b.0.dot(outward).abs().total_cmp(&a.0.dot(outward).abs()));
        for (direction, part) in parts {
            let drawn = value(robot, part) * scale.factor;
            if drawn.abs() >= scale.negligible {
                let length = drawn.abs().max(scale.shortest).copysign(drawn);
                self.step(direction * length, Some(part.clone()));
            }
        }
    }

    fn step(&mut self, by: Vector3<f64>, length: Option<Formula>) {
        let end = self.position + by;
        self.path.push(Segment { ends: [self.position, end], length });
        self.position = end;
    }
}

/// The unit vector along a vector, whatever its length.
fn direction(axis: &Vector3<f64>) -> Vector3<f64> {
    (axis / axis.amax()).normalize()
}

/// The rotation about a coordinate axis, by an angle in rad.
fn turn(axis: Axis, angle: f64) -> Matrix3<f64> {
    let axis = match axis {
        Axis::X => Vector3::x_axis(),
        Axis::Y => Vector3::y_axis(),
        Axis::Z => Vector3::z_axis(),
    };
    Rotation3::from_axis_angle(&axis, angle).into_inner()
}

/// The height on the page between the lowest and the highest of the base, the joints and the frames.
pub(crate) fn tallness(layout: &Layout, view: &View) -> f64 {
    let places = layout.links.iter().chain(layout.frames.iter().map(|(_, place)| place));
    let heights = places.map(|place| view.point(&place.position).y);
    let [low, high] = heights
        .fold([view.point(&BASE).y; 2], |[low, high], height| [low.min(height), high.max(height)]);
    high - low
}

/// Rates the faults of a layout in its view: joints that cover each other or links, and pieces that are seen end-on.
pub(crate) fn confusion(layout: &Layout, view: &View) -> f64 {
    let places = || layout.links.iter().chain(layout.frames.iter().map(|(_, place)| place));
    let points: Vec<_> = places().map(|place| view.point(&place.position)).collect();
    let segments: Vec<[_; 2]> = places()
        .flat_map(|place| &place.path)
        .map(|segment| segment.ends.each_ref().map(|end| view.point(end)))
        .collect();
    let mut sum = 0.0;
    let mut blame = |distance: f64, wanted: f64| sum += (wanted - distance).max(0.0).powi(2);
    for (index, point) in points.iter().enumerate() {
        for other in points.iter().skip(index + 1) {
            blame((point - other).norm(), 65.0);
        }
        for [a, b] in &segments {
            let middle = (a + b) / 2.0;
            blame((point - middle).norm(), 30.0);
        }
    }
    for [a, b] in &segments {
        blame((a - b).norm(), 45.0);
    }
    // Drawing joints apart is a fault too, so that it is only done when necessary.
    let separated =
        places().flat_map(|place| &place.path).filter(|segment| segment.length.is_none());
    blame(0.0, 40.0 * (separated.count() as f64).sqrt());
    for place in &layout.links {
        // An axis that points at the viewer is not visible as a line.
        blame(view.point(&place.axis).norm() * 60.0, 25.0);
    }
    sum
}
