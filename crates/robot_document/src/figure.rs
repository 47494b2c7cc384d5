//! Drawings of lines and labels that do not depend on a notation.
//!
//! Coordinates are in units of the drawing, with y pointing down; each notation scales them to the page.

use crate::document::Inline;

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The caption.
    pub caption: String,
    /// The corner with the smallest coordinates, and the opposite corner.
    pub bounds: [Point; 2],
    /// The shapes; later ones are drawn on top of earlier ones.
    pub shapes: Vec<Shape>,
}

/// A point of a drawing.
pub type Point = [f64; 2];

/// A part of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Lines and curves.
    Path(Path),
    /// Text or a formula.
    Label(Label),
}

/// Connected lines and curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The first point.
    pub start: Point,
    /// The lines and curves that follow.
    pub segments: Vec<Segment>,
    /// Whether a line connects the end with the start.
    pub is_closed: bool,
    /// The color of the line.
    pub color: Color,
    /// The width of the line, in units of the drawing.
    pub width: f64,
    /// The lengths of dashes and gaps, alternating; empty for a solid line.
    pub dashes: &'static [f64],
    /// The color of the enclosed area; `None` if it is not filled.
    pub fill: Option<Color>,
}

/// A piece of a path, from the end of the preceding piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// A straight line to a point.
    Line(Point),
    /// A cubic Bézier curve, given by two control points and its end.
    Curve([Point; 3]),
}

/// Text or a formula centered on a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The center.
    pub center: Point,
    /// The text or formula.
    pub words: Inline,
    /// The font size, in units of the drawing.
    pub size: f64,
    /// Whether the text is bold.
    pub is_bold: bool,
    /// The color.
    pub color: Color,
}

/// A color: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub [u8; 3]);

/// The scale of a figure that has enough space, in points per unit.
const USUAL: f64 = 0.62;

/// The largest height in points, so that a figure fits on one page with its caption and a heading.
const TALLEST: f64 = 440.0;

impl Figure {
    /// The width and the height, in units of the drawing.
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        let [low, high] = self.bounds;
        [high[0] - low[0], high[1] - low[1]]
    }

    /// The scale in points per unit on a line of the given width in points.
    #[must_use]
    pub fn scale(&self, available: f64) -> f64 {
        let [width, height] = self.size().map(|side| side.max(1.0));
        (available / width).min(TALLEST / height).min(USUAL)
    }

    /// The colors of the shapes, each once, in order of their first use.
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

/// Formats a number with at most one decimal.
pub(crate) fn coordinate(value: f64) -> String {
    // Adding zero turns a negative zero into a positive one.
    format!("{}", (value * 10.0).round() / 10.0 + 0.0)
}

/// Formats a number with at most two decimals.
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
