//! The drawing of figures with plotters.

use std::ops::Range;
use std::sync::OnceLock;

use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Text};
use plotters::prelude::{BLACK, DrawingBackend, IntoFont, LineSeries, RGBColor, WHITE};
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, ShapeStyle, TextStyle, register_font};

use super::axis::{Axis, label};
use super::simplify::simplified;
use super::{Curve, Figure, Panel, SCALE};

/// The width of a figure and the sizes of its parts, in px.
const WIDTH: u32 = 900;
const TITLE: u32 = 44;
const PANEL: u32 = 190;
const TIME_LABELS: u32 = 42;
const VALUE_LABELS: u32 = 76;
const LEGEND: u32 = 110;
const MARGIN: u32 = 12;

/// The largest numbers of ticks of the axes.
const TIME_TICKS: usize = 11;
const VALUE_TICKS: usize = 6;

/// The font sizes, in px.
const TITLE_SIZE: u32 = 18;
const TEXT_SIZE: u32 = 14;

/// The palette of Okabe and Ito (Color Universal Design, 2008), which color-blind readers can distinguish, without its
/// black, which is used for sums, and its yellow, which is hard to see on white.
const COLORS: [RGBColor; 6] = [
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
    let panels = u32::try_from(figure.panels.len()).unwrap_or(u32::MAX).clamp(1, 100);
    (WIDTH, TITLE + panels * PANEL + TIME_LABELS)
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
    for (index, panel) in figure.panels.iter().enumerate() {
        let last = index + 1 == figure.panels.len();
        let height = if last { PANEL + TIME_LABELS } else { PANEL };
        let (here, below) = rest.split_vertically(height * SCALE);
        draw_panel(&figure.t, panel, last, &here)?;
        rest = below;
    }
    area.present()
}

fn draw_panel<D: DrawingBackend>(
    t: &[f64],
    panel: &Panel,
    last: bool,
    area: &DrawingArea<D, Shift>,
) -> Drawn<D> {
    let (left, right) = area.split_horizontally((WIDTH - LEGEND) * SCALE);
    let axis = Axis::of(panel.curves.iter().flat_map(|curve| curve.values.iter().copied()));
    let time = Axis::of_times(t);
    let mut chart = ChartBuilder::on(&left)
        .margin_top(MARGIN / 2 * SCALE)
        .margin_bottom(MARGIN / 2 * SCALE)
        .margin_left(MARGIN / 2 * SCALE)
        .margin_right(MARGIN * SCALE)
        .y_label_area_size(VALUE_LABELS * SCALE)
        .x_label_area_size(if last { TIME_LABELS * SCALE } else { 0 })
        .build_cartesian_2d(Ticked::of(&time, TIME_TICKS), Ticked::of(&axis, VALUE_TICKS))?;
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
    for (number, curve) in panel.curves.iter().enumerate() {
        let (across, up) =
            (width / (time.high - time.low), f64::from(PANEL) / (axis.high - axis.low));
        let points = points(t, curve, &axis, across, up);
        match line(number, curve) {
            (line, None) => chart.draw_series(LineSeries::new(points, line))?,
            (line, Some(dash)) => {
                chart.draw_series(DashedLineSeries::new(points, dash, dash / 2, line))?
            }
        };
    }
    draw_legend(&panel.curves, &right)
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

/// The style of a curve, and the length of its dashes in px.
fn line(number: usize, curve: &Curve) -> (ShapeStyle, Option<u32>) {
    if curve.is_sum {
        return (BLACK.stroke_width(2 * SCALE), None);
    }
    let color = COLORS[number % COLORS.len()];
    let dash = [None, Some(8), Some(3)][(number / COLORS.len()).min(2)];
    (color.stroke_width(3 * SCALE / 2), dash.map(|dash| dash * SCALE))
}

/// The points that are needed to draw a curve; `across` and `up` are the numbers of pixels per unit of the axes.
fn points(t: &[f64], curve: &Curve, axis: &Axis, across: f64, up: f64) -> Vec<(f64, f64)> {
    let values = curve.values.iter().map(|value| axis.scaled(*value));
    let finite = t.iter().zip(values).filter(|(_, value)| value.is_finite());
    let pixels: Vec<(f64, f64)> = finite.map(|(t, value)| (t * across, value * up)).collect();
    let few = simplified(&pixels, TOLERANCE).into_iter();
    few.map(|(x, y)| (x / across, y / up)).collect()
}

fn draw_legend<D: DrawingBackend>(curves: &[Curve], area: &DrawingArea<D, Shift>) -> Drawn<D> {
    let most = (PANEL - MARGIN) / (TEXT_SIZE * 3 / 2);
    let at = |x: u32, y: u32| ((x * SCALE) as i32, (y * SCALE) as i32);
    let left = style(TEXT_SIZE).pos(Pos::new(HPos::Left, VPos::Center));
    for (row, curve) in (0..most).zip(curves) {
        let y = MARGIN + row * TEXT_SIZE * 3 / 2;
        let (line, dash) = line(row as usize, curve);
        let sample = [0, 1, 2].map(|part| (at(part * 8, y), at(part * 8 + 8, y)));
        for (from, to) in sample.into_iter().step_by(if dash.is_some() { 2 } else { 1 }) {
            area.draw(&PathElement::new([from, to], line))?;
        }
        area.draw(&Text::new(curve.name.as_str(), at(30, y), left.clone()))?;
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
