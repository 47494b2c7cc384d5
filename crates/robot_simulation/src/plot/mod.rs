//! Plots of values over time as SVG and PNG.
//!
//! The letters of a PNG are those of DejaVu Sans, which is part of the program, so no system fonts are needed. An
//! SVG uses the sans-serif font of the program that shows it. Equal figures give the same bytes everywhere.

mod axis;
mod draw;
mod figures;
mod letters;
mod panels;
mod simplify;
mod strokes;

use plotters::backend::{BitMapBackend, SVGBackend};
use plotters::drawing::IntoDrawingArea;
use robot_build::MARKER;

use crate::error::Error;
use letters::Lowered;

pub use axis::{Axis, label};
pub use figures::{contributions_figure, motion_figure};

/// A figure: panels one below the other with a common time axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The title above the panels.
    pub title: String,
    /// The times t in s, in ascending order.
    pub t: Vec<f64>,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
}

/// A panel: curves with the same unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// The displayed quantity, such as `q`.
    pub quantity: String,
    /// The unit, such as `rad`.
    pub unit: String,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// A curve, with one value for each time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// The name in the legend.
    pub name: String,
    /// The values; those that are not finite are omitted.
    pub values: Vec<f64>,
    /// Whether the curve is the sum of the others, which is drawn in black.
    pub is_sum: bool,
    /// The number of the color: curves of one coordinate or cause have the same in all panels.
    pub color: usize,
}

/// The factor by which figures are drawn larger than they are shown, because coordinates are integers.
const SCALE: u32 = 4;

/// The style for viewers that prefer a dark scheme: it replaces the colors of the background, the text, the grid, the sums
/// and the first curve, which could hardly be seen there. Programs that ignore
/// `prefers-color-scheme`, such as converters to PDF, show the light colors.
const DARK: &str = "<style>@media (prefers-color-scheme: dark) { \
    [fill='#FFFFFF'] { fill: #14171c } [fill='#282828'] { fill: #d8dce3 } [stroke='#282828'] { stroke: #d8dce3 } \
    [stroke='#E1E1E1'] { stroke: #353b45 } [stroke='#000000'] { stroke: #ffffff } [stroke='#0072B2'] { stroke: #3fa2e0 } \
    }</style>";

/// The number of pixels of a PNG per unit of the figure.
const DENSITY: u32 = 2;

impl Figure {
    /// Draws the figure as SVG.
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
        // The picture is shown smaller than it is drawn, but its view box stays the same.
        let large = format!("width=\"{}\" height=\"{}\" viewBox", width * SCALE, height * SCALE);
        let small = format!("width=\"{width}\" height=\"{height}\" viewBox");
        let text = text.replacen(&large, &small, 1);
        let (head, rest) = text.split_once('\n').unwrap_or((&text, ""));
        Ok(format!("<!-- {MARKER} -->\n{head}\n{DARK}\n{rest}"))
    }

    /// Draws the figure as PNG.
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

/// Replaces each square of `block` × `block` pixels by one with their mean, which smooths edges.
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
