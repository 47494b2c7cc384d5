//! Lines and arrows of drawings.

use nalgebra::Vector2;
use robot_document::markup::{Element, element};

/// Formats a coordinate such as `12.3` with at most one decimal, so that equal drawings have equal bytes.
pub(crate) fn coordinate(value: f64) -> String {
    let rounded = (value * 10.0).round() / 10.0;
    // Adding zero turns a negative zero into a positive one.
    format!("{}", rounded + 0.0)
}

/// A path through the given points.
pub(crate) fn path(points: &[Vector2<f64>], is_closed: bool) -> Element {
    let mut text = String::new();
    for (index, point) in points.iter().enumerate() {
        text.push_str(if index == 0 { "M" } else { "L" });
        text.push_str(&format!("{} {}", coordinate(point.x), coordinate(point.y)));
    }
    if is_closed {
        text.push('Z');
    }
    element("path").attribute("d", text)
}

/// The corners of an arrowhead.
pub(crate) fn head(from: Vector2<f64>, to: Vector2<f64>, size: f64) -> [Vector2<f64>; 3] {
    let back = (from - to).try_normalize(1e-9).unwrap_or_default();
    let across = Vector2::new(-back.y, back.x);
    let base = to + back * size;
    [base + across * (0.4 * size), to, base - across * (0.4 * size)]
}
