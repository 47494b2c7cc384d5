//! Labels of the scheme, which are placed where nothing else is.

use nalgebra::Vector2;

/// A rectangle with horizontal and vertical sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    /// The corner with the smallest coordinates.
    pub(crate) low: Vector2<f64>,
    /// The opposite corner.
    pub(crate) high: Vector2<f64>,
}

impl Rectangle {
    /// The rectangle of this size around a center.
    pub(crate) fn about(center: Vector2<f64>, size: Vector2<f64>) -> Rectangle {
        Rectangle { low: center - size / 2.0, high: center + size / 2.0 }
    }

    /// The area of the intersection of two rectangles.
    pub(crate) fn overlap(&self, other: &Rectangle) -> f64 {
        let low = self.low.sup(&other.low);
        let extent = (self.high.inf(&other.high) - low).map(|side| side.max(0.0));
        extent.x * extent.y
    }

    /// The smallest rectangle that contains both.
    pub(crate) fn around(&self, other: &Rectangle) -> Rectangle {
        Rectangle { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }
}

/// The areas that are taken, as far as the placement of labels is concerned.
#[derive(Default)]
pub(crate) struct Room {
    /// The labels, which nothing can cover.
    labels: Vec<Rectangle>,
    /// The symbols and the small pieces of lines, with the cost of covering a unit of their area.
    drawn: Vec<(Rectangle, f64)>,
}

/// The distances from the named point at which labels are tried.
const RINGS: [f64; 9] = [0.0, 6.0, 14.0, 26.0, 42.0, 64.0, 92.0, 130.0, 180.0];
/// The number of directions in which labels are tried.
const DIRECTIONS: usize = 16;

impl Room {
    /// Reserves the area of a symbol.
    pub(crate) fn take(&mut self, rectangle: Rectangle) {
        self.drawn.push((rectangle, 1.0));
    }

    /// Reserves the area of a line.
    pub(crate) fn take_line(&mut self, from: Vector2<f64>, to: Vector2<f64>) {
        let pieces = ((to - from).norm() / 5.0).ceil().max(1.0);
        for piece in 0..=pieces as usize {
            let point = from + (to - from) * (piece as f64 / pieces);
            self.drawn.push((Rectangle::about(point, Vector2::new(5.0, 5.0)), 1.5));
        }
    }

    /// The cost of placing a label there: the area that it covers. Other labels cost so much that any other place is
    /// better.
    pub(crate) fn cost(&self, label: &Rectangle) -> f64 {
        let labels: f64 = self.labels.iter().map(|taken| taken.overlap(label)).sum();
        let drawn: f64 = self.drawn.iter().map(|(taken, cost)| taken.overlap(label) * cost).sum();
        1e4 * labels + drawn
    }

    /// Reserves the area of a label with a fixed place.
    pub(crate) fn set(&mut self, label: Rectangle) {
        self.labels.push(label);
    }

    /// Finds the best place for a label near a point, at least `gap` away from it, and reserves its area.
    pub(crate) fn find(&mut self, point: Vector2<f64>, size: Vector2<f64>, gap: f64) -> Rectangle {
        let mut best = (f64::INFINITY, Rectangle::about(point, size));
        for ring in RINGS {
            for step in 0..DIRECTIONS {
                // Directions to the right and upward are tried first.
                let angle = std::f64::consts::TAU * (step as f64 / DIRECTIONS as f64) - 0.6;
                let (sin, cos) = angle.sin_cos();
                let reach = Vector2::new(cos, sin) * (gap + ring);
                let center = point + reach + Vector2::new(cos * size.x, sin * size.y) / 2.0;
                let label = Rectangle::about(center, size);
                let cost = self.cost(&label) + 1.2 * ring + 0.2 * step as f64;
                if cost < best.0 {
                    best = (cost, label);
                }
            }
        }
        self.set(best.1);
        best.1
    }

    /// The smallest rectangle around all reserved areas.
    pub(crate) fn bounds(&self) -> Option<Rectangle> {
        let drawn = self.drawn.iter().map(|(rectangle, _)| *rectangle);
        drawn.chain(self.labels.iter().copied()).reduce(|all, one| all.around(&one))
    }

    /// Whether two labels overlap.
    #[cfg(test)]
    pub(crate) fn is_crowded(&self) -> bool {
        let pairs = self.labels.iter().enumerate();
        pairs.into_iter().any(|(index, label)| {
            self.labels.iter().skip(index + 1).any(|other| label.overlap(other) > 0.5)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_one_point_lie_apart() {
        let mut room = Room::default();
        room.take(Rectangle::about(Vector2::zeros(), Vector2::new(30.0, 30.0)));
        for _ in 0..12 {
            room.find(Vector2::zeros(), Vector2::new(50.0, 14.0), 10.0);
        }
        assert!(!room.is_crowded());
        let bounds = room.bounds().unwrap();
        assert!(bounds.high.x - bounds.low.x < 500.0);
        room.set(Rectangle::about(Vector2::zeros(), Vector2::new(500.0, 500.0)));
        assert!(room.is_crowded());
    }
}
