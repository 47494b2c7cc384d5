//! Figures drawn with Typst's own curves.

use super::document::line;
use super::text;
use crate::figure::{Color, Figure, Label, Path, Point, Segment, Shape, coordinate, hundredths};

/// A figure with its caption; `scale` is the length of its unit in points.
pub(super) fn figure(figure: &Figure, scale: f64) -> String {
    let [width, height] = figure.size().map(|side| hundredths(side * scale));
    let pen = Pen { scale, corner: figure.bounds[0] };
    let mut typst = format!(
        "#block(breakable: false, below: 1.5em)[
#let label(x, y, body) = context {{ let size = measure(body); place(dx: x - size.width / 2, dy: y - size.height / 2, box(width: size.width, fill: white, outset: 0.5pt, body)) }}
#box(width: {width}pt, height: {height}pt)[
"
    );
    for shape in &figure.shapes {
        typst.push_str(&match shape {
            Shape::Path(path) => pen.path(path),
            Shape::Label(label) => pen.label(label),
        });
    }
    typst.push_str(&format!("]\n\n*Figure 1.* {}\n]\n", text(&figure.caption)));
    typst
}

struct Pen {
    scale: f64,
    corner: Point,
}

impl Pen {
    fn point(&self, point: Point) -> String {
        let [x, y] = [0, 1].map(|axis| coordinate((point[axis] - self.corner[axis]) * self.scale));
        format!("({x}pt, {y}pt)")
    }

    fn path(&self, path: &Path) -> String {
        let mut stroke = format!(
            "paint: {}, thickness: {}pt, cap: \"round\", join: \"round\"",
            rgb(path.color),
            hundredths(path.width * self.scale)
        );
        if !path.dashes.is_empty() {
            let dashes: String = path
                .dashes
                .iter()
                .map(|length| format!("{}pt, ", hundredths(length * self.scale)))
                .collect();
            stroke.push_str(&format!(", dash: ({})", dashes.trim_end()));
        }
        let fill = path.fill.map_or(String::new(), |fill| format!("fill: {}, ", rgb(fill)));
        let mut track = format!("curve.move({})", self.point(path.start));
        for segment in &path.segments {
            track.push_str(&match segment {
                Segment::Line(end) => format!(", curve.line({})", self.point(*end)),
                Segment::Curve([first, second, end]) => format!(
                    ", curve.cubic({}, {}, {})",
                    self.point(*first),
                    self.point(*second),
                    self.point(*end)
                ),
            });
        }
        let end = if path.is_closed { ", curve.close(mode: \"straight\")" } else { "" };
        format!("  #place(curve({fill}stroke: ({stroke}), {track}{end}))\n")
    }

    fn label(&self, label: &Label) -> String {
        let points = (label.size * self.scale).max(5.0);
        let weight = if label.is_bold { ", weight: \"bold\"" } else { "" };
        let [x, y] =
            [0, 1].map(|axis| coordinate((label.center[axis] - self.corner[axis]) * self.scale));
        format!(
            "  #label({x}pt, {y}pt, text(size: {points:.1}pt, fill: {}{weight})[{}])\n",
            rgb(label.color),
            line(std::slice::from_ref(&label.words))
        )
    }
}

fn rgb(Color(parts): Color) -> String {
    let digits: String = parts.iter().map(|part| format!("{part:02x}")).collect();
    format!("rgb(\"#{digits}\")")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Inline;

    /// In a box of width 0, Typst breaks a line at every space.
    #[test]
    fn labels_are_as_wide_as_their_words() {
        let words = Inline::Text("0.4 m".to_owned());
        let color = Color([0; 3]);
        let label = Label { center: [0.0; 2], words, size: 1.0, is_bold: false, color };
        let shapes = vec![Shape::Label(label)];
        let bounds = [[0.0; 2], [10.0; 2]];
        let typst = figure(&Figure { caption: String::new(), bounds, shapes }, 100.0);
        assert!(typst.contains("4 m])") && typst.contains("width: size.width"), "{typst}");
        assert!(!typst.contains("width: 0pt"), "{typst}");
    }
}
