//! Pictures of series over time: SVG and PNG.
//!
//! The letters of a PNG are those of the DejaVu fonts, which are part of the program: no fonts of the system are needed.
//! An SVG names the sans-serif font of whoever shows it. The same figure gives the same bytes everywhere.

mod axis;
mod draw;
mod figures;
mod letters;
mod simplify;

use plotters::backend::{BitMapBackend, SVGBackend};
use plotters::drawing::IntoDrawingArea;
use robot_build::MARKER;

use crate::error::Error;
use letters::Lowered;

pub use axis::{Axis, label};
pub use figures::{contributions_figure, motion_figure};

/// Panels one below the other over a common time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The title above the panels.
    pub title: String,
    /// t, s, rising.
    pub t: Vec<f64>,
    /// The panels, from the top.
    pub panels: Vec<Panel>,
}

/// A panel: curves of one unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// The quantity shown, such as `q`.
    pub quantity: String,
    /// Its unit, such as `rad`.
    pub unit: String,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// A curve: a value for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// The name in the legend.
    pub name: String,
    /// The values; those that are not finite are left out.
    pub values: Vec<f64>,
    /// Whether it is the sum of the others, which is drawn in black.
    pub is_sum: bool,
}

/// Figures are drawn this many times larger than they are shown, because coordinates are whole numbers.
const SCALE: u32 = 4;

/// The colors of an SVG where the reader's program asks for dark ones: each in place of one that is drawn. Programs that do
/// not know the question, such as those that convert to PDF, show the light ones.
const DARK: &str = "<style>@media (prefers-color-scheme: dark) { \
    [fill='#FFFFFF'] { fill: #14171c } [fill='#282828'] { fill: #d8dce3 } [stroke='#282828'] { stroke: #d8dce3 } \
    [stroke='#E1E1E1'] { stroke: #353b45 } [stroke='#000000'] { stroke: #ffffff } [stroke='#0072B2'] { stroke: #3fa2e0 } \
    }</style>";

/// Pixels of a PNG per unit of the figure.
const DENSITY: u32 = 2;

impl Figure {
    /// The figure as SVG.
    ///
    /// # Errors
    ///
    /// If it cannot be drawn.
    pub fn svg(&self) -> Result<String, Error> {
        let (width, height) = draw::size(self);
        let mut text = String::new();
        {
            let backend = SVGBackend::with_string(&mut text, (width * SCALE, height * SCALE));
            draw::draw(self, &backend.into_drawing_area()).map_err(Error::Plot)?;
        }
        // The picture is shown smaller than it is drawn; the view box keeps what it shows.
        let large = format!("width=\"{}\" height=\"{}\" viewBox", width * SCALE, height * SCALE);
        let small = format!("width=\"{width}\" height=\"{height}\" viewBox");
        let text = text.replacen(&large, &small, 1);
        let (head, rest) = text.split_once('\n').unwrap_or((&text, ""));
        Ok(format!("<!-- {MARKER} -->\n{head}\n{DARK}\n{rest}"))
    }

    /// The figure as PNG.
    ///
    /// # Errors
    ///
    /// If it cannot be drawn.
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let (width, height) = draw::size(self);
        let (wide, high) = (width * SCALE, height * SCALE);
        let mut pixels = vec![255; wide as usize * high as usize * 3];
        {
            let backend = BitMapBackend::with_buffer(&mut pixels, (wide, high));
            draw::draw(self, &Lowered(backend).into_drawing_area()).map_err(Error::Plot)?;
        }
        let smaller = reduced(&pixels, wide as usize, (SCALE / DENSITY) as usize);
        encode(&smaller, width * DENSITY, height * DENSITY)
            .map_err(|error| Error::Plot(error.to_string()))
    }
}

/// Each block of so many pixels to a side as one, their mean: edges become smooth.
fn reduced(pixels: &[u8], width: usize, block: usize) -> Vec<u8> {
    let row = width * 3;
    let mut smaller = Vec::with_capacity(pixels.len() / (block * block));
    for rows in pixels.chunks_exact(row * block) {
        for column in 0..width / block {
            for channel in 0..3 {
                let mut sum = 0_usize;
                for line in rows.chunks_exact(row) {
                    let places = line.iter().skip(column * block * 3 + channel).step_by(3);
                    sum += places.take(block).map(|value| usize::from(*value)).sum::<usize>();
                }
                smaller.push(u8::try_from(sum / (block * block)).unwrap_or(u8::MAX));
            }
        }
    }
    smaller
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.add_text_chunk("Software".to_owned(), MARKER.to_owned())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
