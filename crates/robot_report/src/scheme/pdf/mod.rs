//! The scheme as a PDF file with one page of the scheme's size, for LaTeX and other programs that include figures. The
//! file contains only ASCII characters.

mod writing;

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Settings, TextStr};
use robot_build::MARKER;
use robot_document::figure::{Color, Figure, Label, Path, Point, Segment, Shape};
use robot_model::robot::Robot;

use super::figure;
use writing::{FONTS, Run, runs};

/// The width of a line of text on A4 in pt; wider schemes are scaled down to it.
const WIDTH: f64 = 455.0;
/// The smallest font size, in pt.
const SMALLEST: f64 = 5.0;
/// The margin around labels, in pt.
const MARGIN: f32 = 0.5;

/// Draws the scheme of a robot as a PDF file.
#[must_use]
pub fn scheme_pdf(robot: &Robot) -> String {
    let figure = figure(robot);
    let page = Page { low: figure.bounds[0], high: figure.bounds[1], scale: figure.scale(WIDTH) };
    let [title, catalog, pages, only, content] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut pdf = Pdf::with_settings(Settings { pretty: false });
    // The marker is ASCII too, so that the file is text.
    pdf.set_binary_marker(b"text");
    pdf.document_info(title).creator(TextStr(MARKER)).title(TextStr(&robot.name));
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([only]).count(1);
    let mut sheet = pdf.page(only);
    let [width, height] = figure.size().map(|length| number(length * page.scale));
    sheet.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(content);
    let mut resources = sheet.resources();
    let mut fonts = resources.fonts();
    let first = content.get() + 1;
    for (place, font) in (0..).zip(FONTS) {
        fonts.pair(Name(font.key), Ref::new(first + place));
    }
    fonts.finish();
    resources.finish();
    sheet.finish();
    for (place, font) in (0..).zip(FONTS) {
        let mut written = pdf.type1_font(Ref::new(first + place));
        written.base_font(Name(font.name));
        if font.is_latin {
            written.encoding_predefined(Name(b"WinAnsiEncoding"));
        }
    }
    pdf.stream(content, &drawn(&figure, &page));
    // Escape sequences and the marker are ASCII, so the conversion loses nothing.
    String::from_utf8_lossy(&pdf.finish()).into_owned()
}

/// The position of a drawing on its page.
struct Page {
    low: Point,
    high: Point,
    /// The scale, in points per unit.
    scale: f64,
}

impl Page {
    /// Converts a point of the drawing to the page, where y points up.
    fn point(&self, [x, y]: Point) -> [f32; 2] {
        [number((x - self.low[0]) * self.scale), number((self.high[1] - y) * self.scale)]
    }

    fn length(&self, length: f64) -> f32 {
        number(length * self.scale)
    }
}

/// Rounds a number to two decimals.
fn number(value: f64) -> f32 {
    ((value * 100.0).round() / 100.0 + 0.0) as f32
}

fn drawn(figure: &Figure, page: &Page) -> Vec<u8> {
    let mut content = Content::new();
    content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    for shape in &figure.shapes {
        match shape {
            Shape::Path(path) => draw(&mut content, path, page),
            Shape::Label(label) => write(&mut content, label, page),
        }
    }
    content.finish().into_vec()
}

fn parts(Color(parts): Color) -> [f32; 3] {
    parts.map(|part| number(f64::from(part) / 255.0))
}

fn draw(content: &mut Content, path: &Path, page: &Page) {
    let [red, green, blue] = parts(path.color);
    content.set_stroke_rgb(red, green, blue).set_line_width(page.length(path.width));
    content.set_dash_pattern(path.dashes.iter().map(|dash| page.length(*dash)), 0.0);
    if let Some(fill) = path.fill {
        let [red, green, blue] = parts(fill);
        content.set_fill_rgb(red, green, blue);
    }
    let [x, y] = page.point(path.start);
    content.move_to(x, y);
    for segment in &path.segments {
        match segment {
            Segment::Line(end) => {
                let [x, y] = page.point(*end);
                content.line_to(x, y);
            }
            Segment::Curve(points) => {
                let [[a, b], [c, d], [x, y]] = points.map(|point| page.point(point));
                content.cubic_to(a, b, c, d, x, y);
            }
        }
    }
    if path.is_closed {
        content.close_path();
    }
    match path.fill {
        Some(_) => content.fill_nonzero_and_stroke(),
        None => content.stroke(),
    };
}

/// Writes a label on a white background, centered on its point.
fn write(content: &mut Content, label: &Label, page: &Page) {
    let size = (label.size * page.scale).max(SMALLEST);
    let runs = runs(&label.words, label.is_bold);
    let width = number(runs.iter().map(Run::width).sum::<f64>() * size);
    let [x, y] = page.point(label.center);
    let (left, size) = (x - width / 2.0, number(size));
    content.set_fill_rgb(1.0, 1.0, 1.0);
    content.rect(left - MARGIN, y - size / 2.0, width + 2.0 * MARGIN, size).fill_nonzero();
    let [red, green, blue] = parts(label.color);
    content.set_fill_rgb(red, green, blue).begin_text();
    let mut place = left;
    for Run { font, text, rise, scale, .. } in &runs {
        content.set_font(Name(FONTS[*font].key), size * number(*scale));
        let up = y + size * number(*rise - 0.33);
        content.set_text_matrix([
            1.0,
            0.0,
            0.0,
            1.0,
            number(f64::from(place)),
            number(f64::from(up)),
        ]);
        content.show(pdf_writer::Str(text));
        place += size * number(Run::width_of(*font, text) * scale);
    }
    content.end_text();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(name: &str) -> Robot {
        let path = format!("{}/../../robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        robot_model::description::read_toml(&path, &text).unwrap().robot
    }

    #[test]
    fn a_scheme_is_a_page_of_its_size_in_ascii() {
        let pdf = scheme_pdf(&robot("trttr1"));
        assert!(pdf.is_ascii() && pdf.starts_with("%PDF-1.7"));
        assert!(pdf.lines().take(5).any(|line| line.contains(MARKER)), "{}", &pdf[..200]);
        assert!(pdf.trim_end().ends_with("%%EOF") && pdf.contains("/Helvetica-Bold"));
        // The lengths of the robot are italic letters with an index.
        assert!(pdf.contains("(l) Tj") && pdf.contains("(6) Tj"), "{pdf}");
        assert_eq!(pdf, scheme_pdf(&robot("trttr1")));
    }
}
