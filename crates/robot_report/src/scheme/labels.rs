//! Labels of the scheme, which are placed where nothing else is.

use nalgebra::Vector2;

use super::settling;

type Point = Vector2<f64>;

/// A rectangle with horizontal and vertical sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    /// The corner with the smallest coordinates.
    pub(crate) low: Point,
    /// The opposite corner.
    pub(crate) high: Point,
}

impl Rectangle {
    /// The rectangle of this size around a center.
    pub(crate) fn about(center: Point, size: Point) -> Rectangle {
        Rectangle { low: center - size / 2.0, high: center + size / 2.0 }
    }

    /// The area of the intersection of two rectangles.
    pub(crate) fn overlap(&self, other: &Rectangle) -> f64 {
        let low = self.low.sup(&other.low);
        let extent = (self.high.inf(&other.high) - low).map(|side| side.max(0.0));
        extent.x * extent.y
    }

    /// The length of the part of a line within the rectangle.
    pub(crate) fn length_within(&self, [from, to]: &[Point; 2]) -> f64 {
        // Most lines are far away.
        let is_beside = |axis: usize| {
            let (least, most) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            most <= self.low[axis] || least >= self.high[axis]
        };
        if is_beside(0) || is_beside(1) {
            return 0.0;
        }
        let along = to - from;
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let [low, high] = [self.low, self.high].map(|corner| corner[axis] - from[axis]);
            if along[axis].abs() < 1e-9 {
                if low >= 0.0 || high <= 0.0 {
                    return 0.0;
                }
                continue;
            }
            let (one, other) = (low / along[axis], high / along[axis]);
            start = start.max(one.min(other));
            end = end.min(one.max(other));
        }
        (end - start).max(0.0) * along.norm()
    }

    /// The smallest rectangle that contains both.
    pub(crate) fn around(&self, other: &Rectangle) -> Rectangle {
        Rectangle { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The smallest rectangle that contains a line.
    fn around_line([from, to]: &[Point; 2]) -> Rectangle {
        Rectangle { low: from.inf(to), high: from.sup(to) }
    }

    /// Whether two rectangles have a point in common.
    pub(super) fn meets(&self, other: &Rectangle) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

/// A place that a label can take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Candidate {
    /// The area of the label.
    pub(crate) label: Rectangle,
    /// The line from the named point to the label, if the two are far apart.
    pub(crate) leader: Option<[Point; 2]>,
    /// The cost of the place itself, such as its distance from the named point.
    pub(crate) cost: f64,
}

impl Candidate {
    /// The area in which other shapes and labels can add to the cost of some places; `None` without places.
    pub(super) fn reach(places: &[Candidate]) -> Option<Rectangle> {
        let areas = places.iter().map(|place| match &place.leader {
            Some(leader) => place.label.around(&Rectangle::around_line(leader)),
            None => place.label,
        });
        let all = areas.reduce(|all, one| all.around(&one))?;
        Some(Rectangle { low: all.low.add_scalar(-CLOSE), high: all.high.add_scalar(CLOSE) })
    }

    /// A place without a leader.
    pub(crate) fn near(label: Rectangle, cost: f64) -> Candidate {
        Candidate { label, leader: None, cost }
    }
}

/// The shapes of a drawing, as far as they restrict the places of labels.
#[derive(Default)]
pub(crate) struct Room {
    symbols: Vec<Rectangle>,
    lines: Vec<[Point; 2]>,
    /// The axes of frames, which other lines may cross more easily.
    axes: Vec<[Point; 2]>,
}

/// The distances from the named point at which labels are tried.
const RINGS: [f64; 9] = [0.0, 6.0, 14.0, 26.0, 42.0, 64.0, 92.0, 130.0, 180.0];
/// The number of directions in which labels are tried.
const DIRECTIONS: usize = 16;
/// The distance beyond the gap from which a label has a line to its point.
const FAR: f64 = 12.0;
/// The distance that labels keep from lines.
const PAD: f64 = 2.0;
/// The cost of a line through a label, per px. A label on another costs so much that any other place is better.
pub(super) const CROSSED: f64 = 30.0;
const ON_LABEL: f64 = 1e4;
/// The cost of a leader along a line of the drawing, per px, and across one, and across another leader or along it, where nobody can tell to
/// which point it leads.
const ALONG: f64 = 2.0;
const ACROSS: f64 = 30.0;
const ON_LEADER: f64 = 400.0;
/// The distance within which two lines look like one, and that of the points at which this is tested.
const CLOSE: f64 = 4.0;
const PIECE: f64 = 6.0;
/// The cost of a line across an axis of a frame, as a fraction of that across another line.
const ON_AXIS: f64 = 0.3;

impl Room {
    /// Reserves the area of a symbol.
    pub(crate) fn reserve(&mut self, rectangle: Rectangle) {
        self.symbols.push(rectangle);
    }

    /// Reserves a line.
    pub(crate) fn reserve_line(&mut self, from: Point, to: Point) {
        self.lines.push([from, to]);
    }

    /// Reserves an axis of a frame.
    pub(crate) fn reserve_axis(&mut self, from: Point, to: Point) {
        self.axes.push([from, to]);
    }

    /// The cost of the symbols and lines that a label would cover.
    pub(crate) fn cost(&self, label: &Rectangle) -> f64 {
        let padded =
            Rectangle { low: label.low.add_scalar(-PAD), high: label.high.add_scalar(PAD) };
        let symbols: f64 = self.symbols.iter().map(|symbol| symbol.overlap(label)).sum();
        let lines: f64 = self.all_lines().map(|line| padded.length_within(line)).sum();
        symbols + CROSSED * lines
    }

    /// The first of the places where a label costs least.
    pub(crate) fn cheapest<'c>(&self, places: &'c [Candidate]) -> Option<&'c Candidate> {
        let mut best: Option<(&Candidate, f64)> = None;
        for place in places {
            // The shapes only add to the cost of a place.
            if best.is_some_and(|(_, least)| place.cost >= least) {
                continue;
            }
            let cost = place.cost + self.cost(&place.label);
            if best.is_none_or(|(_, least)| cost < least) {
                best = Some((place, cost));
            }
        }
        best.map(|(place, _)| place)
    }

    /// The length of lines through a label.
    #[cfg(test)]
    pub(crate) fn length_within(&self, label: &Rectangle) -> f64 {
        self.all_lines().map(|line| label.length_within(line)).sum()
    }

    /// The cost of an additional line: its length on symbols plus its length along other lines; length along axes of frames
    /// counts `ON_AXIS` times.
    pub(crate) fn cost_of_line(&self, [from, to]: [Point; 2]) -> f64 {
        let symbols: f64 =
            self.symbols.iter().map(|symbol| symbol.length_within(&[from, to])).sum();
        let pieces = ((to - from).norm() / PIECE).ceil().max(1.0);
        let points =
            (0..=pieces as usize).map(|piece| from + (to - from) * (piece as f64 / pieces));
        let is_on = |lines: &[[Point; 2]], point: Point| {
            lines.iter().any(|line| distance(point, line) < CLOSE)
        };
        let close = points.map(|point| match is_on(&self.lines, point) {
            true => PIECE,
            false if is_on(&self.axes, point) => ON_AXIS * PIECE,
            false => 0.0,
        });
        symbols + close.sum::<f64>()
    }

    /// The cost of a leader: its length on symbols and along lines, and the lines that it crosses.
    fn cost_of_leader(&self, leader: [Point; 2]) -> f64 {
        let symbols: f64 = self.symbols.iter().map(|symbol| symbol.length_within(&leader)).sum();
        let across = |lines: &[[Point; 2]]| {
            lines.iter().filter(|line| do_cross(&leader, line)).count() as f64
        };
        let crossed = across(&self.lines) + ON_AXIS * across(&self.axes);
        // The line's own cost has the symbols already.
        let symbols = (CROSSED - 1.0) * symbols;
        20.0 + ALONG * self.cost_of_line(leader) + symbols + ACROSS * crossed
    }

    fn all_lines(&self) -> impl Iterator<Item = &[Point; 2]> {
        self.lines.iter().chain(&self.axes)
    }

    /// Places of a label around a point, at least `gap` away from it; the nearest ones are at most `reach` farther.
    pub(crate) fn around(point: Point, size: Point, gap: f64, reach: f64) -> Vec<Candidate> {
        let mut places = vec![];
        for ring in RINGS.into_iter().filter(|ring| *ring <= reach) {
            for step in 0..DIRECTIONS {
                // Directions to the right and upward are preferred.
                let angle = std::f64::consts::TAU * (step as f64 / DIRECTIONS as f64) - 0.6;
                let (sin, cos) = angle.sin_cos();
                let away = Point::new(cos, sin) * (gap + ring);
                let center = point + away + Point::new(cos * size.x, sin * size.y) / 2.0;
                let label = Rectangle::about(center, size);
                let nearest = point.sup(&label.low).inf(&label.high);
                let distance = (nearest - point).norm();
                // A leader ends at the symbol around the point.
                let start = point + (nearest - point) * (gap / distance.max(gap));
                places.push(Candidate {
                    label,
                    leader: (distance > gap + FAR).then_some([start, nearest]),
                    cost: 1.2 * ring + 0.2 * step as f64,
                });
            }
        }
        places
    }

    /// Chooses one of the places of each label.
    pub(crate) fn settled(&self, labels: &[Vec<Candidate>]) -> Vec<Candidate> {
        let own = |places: &Vec<Candidate>| {
            let Some(reach) = Candidate::reach(places) else { return vec![] };
            let near = self.within(&reach);
            let own = |candidate: &Candidate| {
                let leader = candidate.leader.map_or(0.0, |leader| near.cost_of_leader(leader));
                let cost = candidate.cost + leader + near.cost(&candidate.label);
                Candidate { cost, ..*candidate }
            };
            places.iter().map(own).collect()
        };
        settling::settled(labels.iter().map(own).collect())
    }

    /// The shapes that reach into an area.
    fn within(&self, area: &Rectangle) -> Room {
        let lines = |lines: &[[Point; 2]]| {
            let lines = lines.iter().filter(|line| Rectangle::around_line(line).meets(area));
            lines.copied().collect()
        };
        let symbols = self.symbols.iter().filter(|symbol| symbol.meets(area)).copied().collect();
        Room { symbols, lines: lines(&self.lines), axes: lines(&self.axes) }
    }

    /// The smallest rectangle around the reserved areas and the labels.
    pub(crate) fn bounds(&self, labels: &[Candidate]) -> Option<Rectangle> {
        let ends = self.all_lines().flatten().map(|end| Rectangle { low: *end, high: *end });
        let symbols = self.symbols.iter().copied().chain(ends);
        symbols.chain(labels.iter().map(|one| one.label)).reduce(|all, one| all.around(&one))
    }
}

/// The cost of two labels and their leaders on or across each other.
pub(super) fn conflict(one: &Candidate, other: &Candidate) -> f64 {
    let crossed = |leader: &Option<[Point; 2]>, label: &Rectangle| {
        leader.map_or(0.0, |leader| CROSSED * label.length_within(&leader))
    };
    let leaders = one.leader.zip(other.leader);
    let leaders = leaders.is_some_and(|(one, other)| are_confused(&one, &other));
    let leaders = if leaders { ON_LEADER } else { 0.0 };
    let labels = ON_LABEL * one.label.overlap(&other.label);
    labels + leaders + crossed(&one.leader, &other.label) + crossed(&other.leader, &one.label)
}

/// Whether two leaders cross or come so close that one looks like the continuation of the other.
fn are_confused(one: &[Point; 2], other: &[Point; 2]) -> bool {
    let is_close = |ends: &[Point; 2], line| ends.iter().any(|end| distance(*end, line) < CLOSE);
    do_cross(one, other) || is_close(one, other) || is_close(other, one)
}

/// Whether two lines between points cross; lines that only touch do not.
pub(super) fn do_cross(one: &[Point; 2], other: &[Point; 2]) -> bool {
    let side = |[from, to]: &[Point; 2], point: Point| (to - from).perp(&(point - from));
    let parts = |line, ends: &[Point; 2]| side(line, ends[0]) * side(line, ends[1]) < 0.0;
    parts(one, other) && parts(other, one)
}

/// The distance of a point from a line between two others.
pub(super) fn distance(point: Point, [from, to]: &[Point; 2]) -> f64 {
    let along = to - from;
    let part = (point - from).dot(&along) / along.norm_squared().max(1e-9);
    (point - from - along * part.clamp(0.0, 1.0)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn the_part_of_a_line_within_a_rectangle() {
        let area = Rectangle::about(point(0.0, 0.0), point(10.0, 4.0));
        let within = |from, to| area.length_within(&[from, to]);
        assert_eq!(within(point(-20.0, 0.0), point(20.0, 0.0)), 10.0);
        assert_eq!(within(point(0.0, 1.0), point(0.0, 20.0)), 1.0);
        assert_eq!(within(point(-20.0, 3.0), point(20.0, 3.0)), 0.0);
        assert_eq!(within(point(6.0, -9.0), point(6.0, 9.0)), 0.0);
        assert_eq!(within(point(1.0, 1.0), point(1.0, 1.0)), 0.0);
    }

    #[test]
    fn labels_of_one_point_lie_apart() {
        let mut room = Room::default();
        room.reserve(Rectangle::about(Point::zeros(), point(30.0, 30.0)));
        let labels = vec![Room::around(Point::zeros(), point(50.0, 14.0), 10.0, 200.0); 12];
        let placed = room.settled(&labels);
        assert_eq!(placed.len(), 12);
        for (index, one) in placed.iter().enumerate() {
            for other in &placed[index + 1..] {
                assert_eq!(one.label.overlap(&other.label), 0.0);
            }
        }
        let bounds = room.bounds(&placed).unwrap();
        assert!(bounds.high.x - bounds.low.x < 500.0);
    }

    #[test]
    fn labels_leave_lines_and_make_way() {
        let mut room = Room::default();
        room.reserve_line(point(-100.0, 0.0), point(100.0, 0.0));
        let size = point(40.0, 14.0);
        let on = Candidate::near(Rectangle::about(Point::zeros(), size), 0.0);
        let above = Candidate::near(Rectangle::about(point(0.0, -20.0), size), 5.0);
        let below = Candidate::near(Rectangle::about(point(0.0, 20.0), size), 9.0);
        assert_eq!(room.settled(&[vec![on, above]])[0].label, above.label);
        let placed = room.settled(&[vec![on, above, below], vec![on, above, below]]);
        assert_eq!([placed[0].label, placed[1].label], [above.label, below.label]);
        // The line of the second label would run through the first, which is therefore moved.
        let far = Rectangle::about(point(0.0, -90.0), size);
        let led = Candidate {
            label: far,
            leader: Some([point(0.0, -9.0), point(0.0, -83.0)]),
            cost: 0.0,
        };
        let placed = room.settled(&[vec![above, below], vec![led]]);
        assert_eq!([placed[0].label, placed[1].label], [below.label, far]);
    }
}
