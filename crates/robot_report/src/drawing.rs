//! Lines of drawings.

use nalgebra::Vector2;
use robot_document::markup::{Element, element};

/// `12.3` without needless digits, so that the same drawing is the same bytes.
pub(crate) fn coordinate(value: f64) -> String {
    let rounded = (value * 10.0).round() / 10.0;
    // No negative zero.
    format!("{}", rounded + 0.0)
}

/// A path through points.
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

/// The corners of the head of an arrow.
pub(crate) fn head(from: Vector2<f64>, to: Vector2<f64>, size: f64) -> [Vector2<f64>; 3] {
    let back = (from - to).try_normalize(1e-9).unwrap_or_default();
    let across = Vector2::new(-back.y, back.x);
    let base = to + back * size;
    [base + across * (0.4 * size), to, base - across * (0.4 * size)]
}
