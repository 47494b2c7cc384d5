//! The positions of the joints of the scheme: the offsets of the robot file at rest, in the base
//! frame, with those too short to be seen drawn longer and joints at one point drawn apart.

use nalgebra::{Matrix3, Rotation3, Vector3};
use robot_document::robot::words;
use robot_model::robot::{Axis, Frame, Move, Placement, Robot};
use robot_symbolic::Formula;

use super::view::View;
use crate::text;

/// The longest offset on the page.
const LONGEST: f64 = 190.0;
/// No offset is drawn shorter.
const SHORTEST: f64 = 58.0;
/// The distance of joints at one point that are drawn apart.
const SPREAD: f64 = 86.0;
/// Joints nearer to each other than this on the page are drawn apart.
const CLOSE: f64 = 46.0;
/// Offsets shorter than this part of the longest are left out.
const NEGLIGIBLE: f64 = 0.01;
/// The placeholder of a length whose parameters have no values, m.
const UNKNOWN: f64 = 0.3;

/// The robot on the page, in units of the page.
pub(crate) struct Layout {
    /// The links, in the robot's order, each at its joint.
    pub(crate) links: Vec<Place>,
    /// Named frames with what the drawing shows of them, by index.
    pub(crate) frames: Vec<(usize, Place)>,
    /// Named frames that are the base, by index.
    pub(crate) bases: Vec<usize>,
}

/// A frame on the page.
pub(crate) struct Place {
    /// Its origin.
    pub(crate) position: Vector3<f64>,
    /// Its axes, columns in the base frame.
    pub(crate) rotation: Matrix3<f64>,
    /// Unit vector of the joint axis in the base frame; the last offset's for a named frame.
    pub(crate) axis: Vector3<f64>,
    /// The pieces of the carrier's body that lead to it.
    pub(crate) path: Vec<Segment>,
}

/// A straight piece of a link, along an axis of some frame.
pub(crate) struct Segment {
    /// Its ends.
    pub(crate) ends: [Vector3<f64>; 2],
    /// Its length in the robot file; `None` if two frames at one point are drawn apart.
    pub(crate) length: Option<Formula>,
}

/// The base.
pub(crate) const BASE: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

/// More frames than this crowd the page: then tips alone are drawn.
const MAX_FRAMES: usize = 4;

/// Lays the robot out as it is best seen from a view.
pub(crate) fn layout(robot: &Robot, view: &View) -> Layout {
    let scale = LONGEST / longest(robot).max(f64::MIN_POSITIVE);
    let mut layout = Layout { links: vec![], frames: vec![], bases: vec![] };
    for link in &robot.links {
        let axis = link.joint.axis.each_ref().map(|part| value(robot, part));
        let axis = direction(&axis.into());
        let place = layout.place(robot, view, scale, link.parent, &link.placement, axis);
        layout.links.push(place);
    }
    for (index, frame) in drawn_frames(robot) {
        let own = Vector3::zeros();
        // What is at the base's origin is the base.
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

/// The longest component of all offsets, m.
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

fn value(robot: &Robot, formula: &Formula) -> f64 {
    let nominal = text::value(robot, formula);
    if nominal.is_finite() { nominal } else { formula.evaluate(|_| UNKNOWN) }
}

impl Layout {
    /// A frame by its moves in its carrier's; `axis` is in its own axes.
    fn place(
        &self,
        robot: &Robot,
        view: &View,
        scale: f64,
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
            // If there is an offset, what lies beside the carrier's axis stays there.
            let outward = if walk.path.is_empty() { outward } else { own };
            let to = self.separated(view, walk.position, [own, outward], before);
            walk.step(to, None);
        }
        let along = walk.path.last().map(|last| last.ends[1] - last.ends[0]);
        let along = along.and_then(|last| last.try_normalize(1e-9)).unwrap_or(outward);
        Place { position: walk.position, rotation, axis: axis.unwrap_or(along), path: walk.path }
    }

    /// The distance of a place from the base and all joints, on the page.
    fn room(&self, view: &View, place: &Vector3<f64>) -> f64 {
        let end = view.point(place);
        let taken = self.links.iter().map(|link| (view.point(&link.position) - end).norm());
        taken.fold((view.point(&BASE) - end).norm(), f64::min)
    }

    /// How a frame at the very place of its carrier is drawn beside it: along one of the joint axes,
    /// on which a joint may be drawn anywhere, or upright; if there is most room, and rather on
    /// in the direction that leads there.
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
    /// One piece for each component; that along the carrier's joint axis comes first.
    fn translate(
        &mut self,
        robot: &Robot,
        scale: f64,
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
            let drawn = value(robot, part) * scale;
            if drawn.abs() >= NEGLIGIBLE * LONGEST {
                let length = drawn.abs().max(SHORTEST).copysign(drawn);
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

/// The unit vector along a vector of any length.
fn direction(axis: &Vector3<f64>) -> Vector3<f64> {
    (axis / axis.amax()).normalize()
}

/// The rotation about a coordinate axis.
fn turn(axis: Axis, angle: f64) -> Matrix3<f64> {
    let axis = match axis {
        Axis::X => Vector3::x_axis(),
        Axis::Y => Vector3::y_axis(),
        Axis::Z => Vector3::z_axis(),
    };
    Rotation3::from_axis_angle(&axis, angle).into_inner()
}

/// The faults of a layout seen from its view: joints on top of each other or of links, and pieces seen
/// from their end.
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
    // Joints are drawn apart if they must be, not more.
    let separated =
        places().flat_map(|place| &place.path).filter(|segment| segment.length.is_none());
    blame(0.0, 40.0 * (separated.count() as f64).sqrt());
    for place in &layout.links {
        // An axis that points at the eye is not a line.
        blame(view.point(&place.axis).norm() * 60.0, 25.0);
    }
    sum
}
