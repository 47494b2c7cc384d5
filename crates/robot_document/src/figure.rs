//! Drawings of lines and labels, in no notation.
//!
//! Coordinates are in units of the drawing, y points down; each notation scales them to the page.

use crate::document::Inline;

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its content.
    pub caption: String,
    /// The corner with the smallest coordinates, and the opposite one.
    pub bounds: [Point; 2],
    /// Its parts, later ones on top.
    pub shapes: Vec<Shape>,
}

/// A point of a drawing.
pub type Point = [f64; 2];

/// A part of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Lines and curves.
    Path(Path),
    /// Something written.
    Label(Label),
}

/// Connected lines and curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Where they start.
    pub start: Point,
    /// How they go on.
    pub segments: Vec<Segment>,
    /// Whether a line leads back to the start.
    pub is_closed: bool,
    /// The color of the line.
    pub color: Color,
    /// The width of the line, in units of the drawing.
    pub width: f64,
    /// The lengths of dashes and gaps, in turn; none for a solid line.
    pub dashes: &'static [f64],
    /// The color of what the line encloses.
    pub fill: Option<Color>,
}

/// The next piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// A straight line to a point.
    Line(Point),
    /// A cubic Bézier curve: two control points, and the end.
    Curve([Point; 3]),
}

/// Words or a formula about a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The middle.
    pub center: Point,
    /// What is written.
    pub words: Inline,
    /// The height of the type, in units of the drawing.
    pub size: f64,
    /// Whether the type is bold.
    pub is_bold: bool,
    /// Its color.
    pub color: Color,
}

/// Red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub [u8; 3]);

/// Points per unit where there is room.
const USUAL: f64 = 0.62;

/// The most points from top to bottom: with its caption and a heading a figure is on one page.
const TALLEST: f64 = 440.0;

impl Figure {
    /// Its width and height in units of the drawing.
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        let [low, high] = self.bounds;
        [high[0] - low[0], high[1] - low[1]]
    }

    /// Points per unit on a line of a width in points.
    #[must_use]
    pub fn scale(&self, available: f64) -> f64 {
        let [width, height] = self.size().map(|side| side.max(1.0));
        (available / width).min(TALLEST / height).min(USUAL)
    }

    /// The colors of its parts, each once, in order.
    pub(crate) fn colors(&self) -> Vec<Color> {
        let mut colors = vec![];
        for shape in &self.shapes {
            let used = match shape {
                Shape::Path(path) => [Some(path.color), path.fill],
                Shape::Label(label) => [Some(label.color), None],
            };
            for color in used.into_iter().flatten() {
                if !colors.contains(&color) {
                    colors.push(color);
                }
            }
        }
        colors
    }
}

/// A number with one decimal at most.
pub(crate) fn coordinate(value: f64) -> String {
    // No negative zero.
    format!("{}", (value * 10.0).round() / 10.0 + 0.0)
}

/// A number with two decimals at most.
pub(crate) fn hundredths(value: f64) -> String {
    format!("{}", (value * 100.0).round() / 100.0 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_fit_a_line_and_a_page() {
        let scale = |width, height| {
            let bounds = [[0.0, 0.0], [width, height]];
            Figure { caption: String::new(), bounds, shapes: vec![] }.scale(300.0)
        };
        assert_eq!(scale(100.0, 100.0), USUAL);
        assert_eq!(scale(1000.0, 100.0) * 1000.0, 300.0);
        assert!((scale(100.0, 2000.0) * 2000.0 - TALLEST).abs() < 1e-9);
    }
}
