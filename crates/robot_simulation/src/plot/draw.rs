//! The drawing of figures with plotters.

use std::ops::Range;
use std::sync::OnceLock;

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Text};
use plotters::prelude::{BLACK, DrawingBackend, IntoFont, RGBColor, WHITE};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, ShapeStyle, TextStyle, register_font};

use super::axis::{Axis, label};
use super::panels::{MARGIN, PANEL, ROW, Shown, panels};
use super::simplify::simplified;
use super::strokes::{COLORS, Stroke, dashed};
use super::{Curve, Figure, SCALE};

/// The width of a figure and the sizes of its parts, in px.
const WIDTH: u32 = 900;
const TITLE: u32 = 44;
const TIME_LABELS: u32 = 42;
const VALUE_LABELS: u32 = 76;
const LEGEND: u32 = 110;
/// The length of the line before a name in a legend.
const SAMPLE: f64 = 24.0;

/// The largest numbers of ticks of the axes.
const TIME_TICKS: usize = 11;
const VALUE_TICKS: usize = 6;

/// The font sizes, in px.
const TITLE_SIZE: u32 = 18;
const TEXT_SIZE: u32 = 14;

/// The palette of Okabe and Ito (Color Universal Design, 2008), which color-blind readers can distinguish, without its
/// black, which is used for sums, and its yellow, which is hard to see on white.
const PALETTE: [RGBColor; COLORS] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];
const GRID: RGBColor = RGBColor(225, 225, 225);
const INK: RGBColor = RGBColor(40, 40, 40);

/// The largest difference of a drawn curve from its samples, in px.
const TOLERANCE: f64 = 0.1;

/// The width and height of a figure, in px.
pub(super) fn size(figure: &Figure) -> (u32, u32) {
    let panels = panels(figure).iter().map(|shown| shown.height).sum::<u32>().max(PANEL);
    (WIDTH, TITLE + panels + TIME_LABELS)
}

/// Draws a figure at [`SCALE`] times its size.
pub(super) fn draw<D: DrawingBackend>(
    figure: &Figure,
    area: &DrawingArea<D, Shift>,
) -> Result<(), String> {
    register()?;
    fill(figure, area).map_err(|error| error.to_string())
}

type Drawn<D> =
    Result<(), plotters::drawing::DrawingAreaErrorKind<<D as DrawingBackend>::ErrorType>>;

fn fill<D: DrawingBackend>(figure: &Figure, area: &DrawingArea<D, Shift>) -> Drawn<D> {
    area.fill(&WHITE)?;
    let (head, rest) = area.split_vertically(TITLE * SCALE);
    let centered = style(TITLE_SIZE).pos(Pos::new(HPos::Center, VPos::Center));
    let middle = (WIDTH - LEGEND + VALUE_LABELS) / 2;
    let place = ((middle * SCALE) as i32, (TITLE * SCALE / 2) as i32);
    head.draw(&Text::new(figure.title.as_str(), place, centered))?;
    let mut rest = rest;
    let panels = panels(figure);
    for (index, shown) in panels.iter().enumerate() {
        let is_last = index + 1 == panels.len();
        let height = shown.height + if is_last { TIME_LABELS } else { 0 };
        let (here, below) = rest.split_vertically(height * SCALE);
        draw_panel(&figure.t, shown, is_last, &here)?;
        rest = below;
    }
    area.present()
}

fn draw_panel<D: DrawingBackend>(
    t: &[f64],
    shown: &Shown,
    is_last: bool,
    area: &DrawingArea<D, Shift>,
) -> Drawn<D> {
    let (left, right) = area.split_horizontally((WIDTH - LEGEND) * SCALE);
    let Shown { panel, axis, strokes, order, .. } = shown;
    let time = Axis::of_times(t);
    let mut chart = ChartBuilder::on(&left)
        .margin_top(MARGIN / 2 * SCALE)
        .margin_bottom(MARGIN / 2 * SCALE)
        .margin_left(MARGIN / 2 * SCALE)
        .margin_right(MARGIN * SCALE)
        .y_label_area_size(VALUE_LABELS * SCALE)
        .x_label_area_size(if is_last { TIME_LABELS * SCALE } else { 0 })
        .build_cartesian_2d(Ticked::of(&time, TIME_TICKS), Ticked::of(axis, VALUE_TICKS))?;
    let value_label = format!("{} ({})", panel.quantity, axis.unit(&panel.unit));
    chart
        .configure_mesh()
        .bold_line_style(GRID.stroke_width(SCALE))
        .axis_style(INK.stroke_width(SCALE))
        .x_label_formatter(&|value| label(*value))
        .y_label_formatter(&|value| label(*value))
        .label_style(style(TEXT_SIZE))
        .axis_desc_style(style(TEXT_SIZE))
        .x_desc("t (s)")
        .y_desc(value_label)
        .draw()?;
    let width = f64::from(WIDTH - LEGEND - VALUE_LABELS);
    let across = width / (time.high - time.low);
    for index in order {
        let stroke = &strokes[*index];
        let pixels = points(t, &panel.curves[*index], axis, across, shown.up);
        let pieces = pieces(&pixels, stroke).into_iter();
        let values = |(x, y): (f64, f64)| (x / across, y / shown.up);
        chart.draw_series(pieces.map(|piece| {
            let points: Vec<_> = piece.into_iter().map(values).collect();
            PathElement::new(points, line(stroke))
        }))?;
    }
    match &shown.legend {
        Some(strokes) => draw_legend(&panel.curves, strokes, &right),
        None => Ok(()),
    }
}

/// The coordinates of an axis and its ticks.
struct Ticked {
    coordinates: RangedCoordf64,
    ticks: Vec<f64>,
}

impl Ticked {
    fn of(axis: &Axis, most: usize) -> Ticked {
        Ticked { coordinates: (axis.low..axis.high).into(), ticks: axis.ticks(most) }
    }
}

impl Ranged for Ticked {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        self.coordinates.map(value, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // There are no light lines between the ticks.
        if hint.weight().allow_light_points() { vec![] } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.coordinates.range()
    }
}

/// The style of a line.
fn line(stroke: &Stroke) -> ShapeStyle {
    match stroke.is_sum {
        true => BLACK.stroke_width(2 * SCALE),
        false => PALETTE[stroke.color].stroke_width(3 * SCALE / 2),
    }
}

/// The pieces of a line through points in px: its dashes, or the whole line.
fn pieces(points: &[(f64, f64)], stroke: &Stroke) -> Vec<Vec<(f64, f64)>> {
    match &stroke.dashes {
        Some(dashes) => dashed(points, dashes),
        None => vec![points.to_vec()],
    }
}

/// The points that are needed to draw a curve, in px; `across` and `up` are the numbers of pixels per unit of the axes.
fn points(t: &[f64], curve: &Curve, axis: &Axis, across: f64, up: f64) -> Vec<(f64, f64)> {
    let values = curve.values.iter().map(|value| axis.scaled(*value));
    let finite = t.iter().zip(values).filter(|(_, value)| value.is_finite());
    let pixels: Vec<(f64, f64)> = finite.map(|(t, value)| (t * across, value * up)).collect();
    simplified(&pixels, TOLERANCE)
}

/// Draws the name of each curve after a piece of its line.
fn draw_legend<D: DrawingBackend>(
    curves: &[Curve],
    strokes: &[Stroke],
    area: &DrawingArea<D, Shift>,
) -> Drawn<D> {
    let scale = f64::from(SCALE);
    let left = style(TEXT_SIZE).pos(Pos::new(HPos::Left, VPos::Center));
    for (row, (curve, stroke)) in (0..).zip(curves.iter().zip(strokes)) {
        let y = MARGIN + row * ROW;
        let sample = [(0.0, f64::from(y)), (SAMPLE, f64::from(y))];
        for piece in pieces(&sample, stroke) {
            let place = |(x, y): (f64, f64)| ((x * scale) as i32, (y * scale) as i32);
            let points: Vec<_> = piece.into_iter().map(place).collect();
            area.draw(&PathElement::new(points, line(stroke)))?;
        }
        let place = ((30 * SCALE) as i32, (y * SCALE) as i32);
        area.draw(&Text::new(curve.name.as_str(), place, left.clone()))?;
    }
    Ok(())
}

fn style(size: u32) -> TextStyle<'static> {
    ("sans-serif", size * SCALE).into_font().color(&INK)
}

/// Registers the font, once.
fn register() -> Result<(), String> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let regular = dejavu::sans::regular();
    let known =
        REGISTERED.get_or_init(|| register_font("sans-serif", FontStyle::Normal, regular).is_ok());
    if *known { Ok(()) } else { Err("the font cannot be read".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Panel;

    #[test]
    fn the_legend_names_every_curve() {
        let curve = |color: usize| Curve {
            name: format!("curve {color}."),
            values: vec![color as f64; 2],
            is_sum: false,
            color,
        };
        let panel = Panel { curves: (0..20).map(curve).collect(), ..Panel::default() };
        let figure = Figure { t: vec![0.0, 1.0], panels: vec![panel], ..Figure::default() };
        let svg = figure.svg().unwrap();
        for color in 0..20 {
            assert!(svg.contains(&format!("curve {color}.")), "{color}: {svg}");
        }
        assert_eq!(size(&figure), (WIDTH, TITLE + 2 * MARGIN + 20 * ROW + TIME_LABELS));
    }
}
