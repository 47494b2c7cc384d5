//! The style of the scheme in documents, which matches the style sheet for pages in light colors.

use robot_document::figure::{Color, Path, Point, Segment};

/// The style of lines and text.
#[derive(Clone, Debug)]
pub(crate) struct Style {
    color: Color,
    width: f64,
    dashes: &'static [f64],
    fill: Option<Color>,
    pub(crate) text: Color,
    pub(crate) is_bold: bool,
}

const fn color(code: u32) -> Color {
    let [_, red, green, blue] = code.to_be_bytes();
    Color([red, green, blue])
}

const INK: Color = color(0x1b_1f24);
const FAINT: Color = color(0x57_606a);
const PAPER: Color = color(0xff_ffff);
/// The colors of links.
const HUES: [Color; 8] = [
    color(0x0b_57a4),
    color(0xa8_4300),
    color(0x1a_7f37),
    color(0x8a_3ab9),
    color(0x00_707a),
    color(0xb0_215e),
    color(0x6b_5c00),
    color(0x4a_5568),
];
/// The colors of the axes of frames.
const AXES: [Color; 3] = [color(0xb3_261e), color(0x1a_7f37), color(0x0b_57a4)];

/// The default style: a line of ink with the usual width.
impl Default for Style {
    fn default() -> Style {
        Style { color: INK, width: 1.5, dashes: &[], fill: None, text: INK, is_bold: false }
    }
}

impl Style {
    /// Changes the style as a class does in the style sheet.
    pub(crate) fn with(self, class: &str) -> Style {
        let colored = |color: Color, style: Style| Style { color, text: color, ..style };
        match class {
            "body" => Style { width: 5.0, ..self },
            "apart" => Style { width: 3.0, dashes: &[1.0, 6.0], ..self },
            "joint" => Style { width: 2.0, fill: Some(PAPER), ..self },
            "rail" => Style { width: 3.0, fill: None, ..self },
            "axis" => Style { width: 1.0, dashes: &[9.0, 3.0, 2.0, 3.0], ..self },
            "head" => Style { width: 1.0, dashes: &[], fill: Some(self.color), ..self },
            "hand" => Style { width: 3.0, ..self },
            "way" => Style { width: 2.5, ..self },
            "dimension" => Style { color: FAINT, width: 1.0, text: INK, ..self },
            "leader" => Style { width: 1.0, ..self },
            "name" => Style { is_bold: true, ..self },
            "axis-x" => colored(AXES[0], self),
            "axis-y" => colored(AXES[1], self),
            "axis-z" => colored(AXES[2], self),
            other => match other.strip_prefix("hue-").and_then(|hue| hue.parse::<usize>().ok()) {
                Some(hue) => colored(HUES[hue % HUES.len()], self),
                None => self,
            },
        }
    }

    pub(crate) fn path(&self, start: Point, segments: Vec<Segment>, is_closed: bool) -> Path {
        let Style { color, width, dashes, fill, .. } = *self;
        Path { start, segments, is_closed, color, width, dashes, fill }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The colors in documents are those of pages.
    #[test]
    fn the_colors_are_those_of_the_style_sheet() {
        let sheet = include_str!("../style.css");
        let (light, _) = sheet.split_once("@media").unwrap();
        let code = |Color([red, green, blue]): Color| format!("#{red:02x}{green:02x}{blue:02x}");
        for (hue, place) in HUES.into_iter().zip(0..) {
            assert!(light.contains(&format!("--hue-{place}: {};", code(hue))), "{place}");
        }
        for (axis, name) in AXES.into_iter().zip(["x", "y", "z"]) {
            assert!(light.contains(&format!("--{name}: {};", code(axis))), "{name}");
        }
        for (color, name) in [(INK, "ink"), (FAINT, "faint"), (PAPER, "paper")] {
            assert!(light.contains(&format!("--{name}: {};", code(color))), "{name}");
        }
    }
}
