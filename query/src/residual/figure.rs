//! A plot of residuals over time.

use datafusion::arrow::array::{Array, AsArray, RecordBatch};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Float64Type};
use datafusion::functions_aggregate::expr_fn::{max, min};
use datafusion::prelude::{DataFrame, ident};
use futures::StreamExt;
use plotters::prelude::*;
use robot_model::robot::JointKind;

use crate::error::Error;
use crate::robots::Model;

/// The number of intervals into which the time is divided.
const PARTS: usize = 300;

/// The width of a picture, and the heights of its title and panels, px.
const WIDTH: u32 = 900;
const TITLE: u32 = 40;
const PANEL: u32 = 190;

/// The colors of curves: three colors of the palette of Okabe and Ito (Color Universal Design, 2008).
const COLORS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(150, 150, 150), RGBColor(150, 150, 150)];

/// The residuals of all joints over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The title above the panels.
    pub title: String,
    /// The midpoints of the intervals, s.
    pub t: Vec<f64>,
    /// A panel for each joint.
    pub panels: Vec<Panel>,
}

/// The residuals of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The name of the joint and the unit of its residuals.
    pub joint: String,
    /// The mean, the root mean square, the smallest and the largest residual in each interval; NaN in intervals
    /// without rows.
    pub curves: [Curve; 4],
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The label of the curve.
    pub name: &'static str,
    /// A value for each interval.
    pub values: Vec<f64>,
}

impl Figure {
    /// The plot as SVG.
    ///
    /// # Errors
    ///
    /// A plot that cannot be drawn.
    pub fn svg(&self) -> Result<String, Error> {
        let mut text = String::new();
        self.draw(&mut text)
            .map_err(|error| Error::Query(format!("the picture cannot be drawn: {error}")))?;
        Ok(text)
    }

    fn draw(&self, text: &mut String) -> Result<(), Box<dyn std::error::Error + '_>> {
        let count = u32::try_from(self.panels.len())?;
        let area =
            SVGBackend::with_string(text, (WIDTH, TITLE + count * PANEL)).into_drawing_area();
        area.fill(&WHITE)?;
        let area = area.titled(&self.title, ("sans-serif", 20))?;
        let (first, last) =
            (self.t.first().copied().unwrap_or(0.0), self.t.last().copied().unwrap_or(1.0));
        for (panel, area) in self.panels.iter().zip(area.split_evenly((self.panels.len(), 1))) {
            let values = || {
                panel
                    .curves
                    .iter()
                    .flat_map(|curve| &curve.values)
                    .filter(|value| value.is_finite())
            };
            let most = values().fold(0.0, |most: f64, value| most.max(value.abs()));
            let most = if most > 0.0 { 1.1 * most } else { 1.0 };
            let mut chart = ChartBuilder::on(&area)
                .margin(6)
                .x_label_area_size(34)
                .y_label_area_size(70)
                .build_cartesian_2d(first..last, -most..most)?;
            chart
                .configure_mesh()
                .x_desc("t (s)")
                .y_desc(&panel.joint)
                .light_line_style(TRANSPARENT)
                .draw()?;
            for (curve, color) in panel.curves.iter().zip(COLORS) {
                let points = self.t.iter().copied().zip(curve.values.iter().copied());
                let points = points.filter(|(_, value)| value.is_finite());
                chart.draw_series(LineSeries::new(points, color.stroke_width(1)))?;
            }
        }
        area.present()?;
        Ok(())
    }
}

/// The residuals of a joint in an interval.
#[derive(Clone, Copy, Debug)]
struct Part {
    count: f64,
    sum: f64,
    squares: f64,
    smallest: f64,
    largest: f64,
}

impl Part {
    const NONE: Part = Part {
        count: 0.0,
        sum: 0.0,
        squares: 0.0,
        smallest: f64::INFINITY,
        largest: f64::NEG_INFINITY,
    };

    fn push(&mut self, value: f64) {
        self.count += 1.0;
        self.sum += value;
        self.squares += value * value;
        self.smallest = self.smallest.min(value);
        self.largest = self.largest.max(value);
    }
}

/// Computes the residuals of each joint over time: mean, root mean square, smallest and largest value in each
/// interval, over all episodes together. The table has the residuals as lists, then the times in a column `t`.
///
/// # Errors
///
/// Times that are not numbers; a log without rows; errors while residuals are computed.
pub async fn figure(table: DataFrame, model: &Model) -> Result<Figure, Error> {
    let [first, last] = range(table.clone()).await?;
    let width = if last > first { (last - first) / PARTS as f64 } else { 1.0 };
    let mut parts = vec![vec![Part::NONE; PARTS]; model.joints()];
    let mut stream = table.execute_stream().await?;
    while let Some(batch) = stream.next().await {
        let batch = batch?;
        let other = || Error::Query("this is not a result of residual".to_owned());
        let lists = batch.column(0).as_fixed_size_list_opt().ok_or_else(other)?;
        let values = lists.values().as_primitive_opt::<Float64Type>().ok_or_else(other)?.values();
        let times = cast(batch.column(1), &DataType::Float64)
            .map_err(|error| Error::Columns(error.to_string()))?;
        let times = times.as_primitive::<Float64Type>();
        for (row, values) in values.chunks_exact(model.joints().max(1)).enumerate() {
            let is_there = lists.is_valid(row) && times.is_valid(row);
            let time = times.value(row);
            if !is_there || !time.is_finite() || values.iter().any(|value| !value.is_finite()) {
                continue;
            }
            // All times are between the first and the last.
            let part = (((time - first) / width) as usize).min(PARTS - 1);
            parts.iter_mut().zip(values).for_each(|(joint, value)| joint[part].push(*value));
        }
    }
    let middle = |part: usize| first + width * (part as f64 + 0.5);
    let panels = parts.iter().zip(&model.robot.coordinates);
    let panels = panels.map(|(parts, coordinate)| {
        let unit = if coordinate.kind == JointKind::Prismatic { "N" } else { "N m" };
        Panel {
            joint: format!("{} ({unit})", coordinate.joint),
            curves: [
                curve("mean", parts, |part| part.sum / part.count),
                curve("rms", parts, |part| (part.squares / part.count).sqrt()),
                curve("smallest", parts, |part| part.smallest),
                curve("largest", parts, |part| part.largest),
            ],
        }
    });
    Ok(Figure {
        // The title names the colors of the curves.
        title: format!(
            "Residuals of {}: mean (blue), rms (orange), smallest and largest (gray)",
            model.robot.name
        ),
        panels: panels.collect(),
        t: (0..PARTS).map(middle).collect(),
    })
}

fn curve(name: &'static str, parts: &[Part], value: impl Fn(&Part) -> f64) -> Curve {
    let value = |part: &Part| if part.count > 0.0 { value(part) } else { f64::NAN };
    Curve { name, values: parts.iter().map(value).collect() }
}

/// The first and the last time.
async fn range(table: DataFrame) -> Result<[f64; 2], Error> {
    let kind = table.schema().field(1).data_type().clone();
    if !kind.is_numeric() {
        return Err(Error::Columns(format!(
            "the times are {kind}; a plot needs seconds as numbers"
        )));
    }
    let ends = table.aggregate(vec![], vec![min(ident("t")), max(ident("t"))])?;
    let batches = ends.collect().await?;
    let number = |batch: &RecordBatch, column: usize| {
        let value = cast(batch.column(column), &DataType::Float64).ok()?;
        let value = value.as_primitive::<Float64Type>();
        value.is_valid(0).then(|| value.value(0)).filter(|value| value.is_finite())
    };
    let found = batches.iter().find(|batch| batch.num_rows() > 0);
    let found = found.and_then(|batch| Some([number(batch, 0)?, number(batch, 1)?]));
    found.ok_or_else(|| Error::Columns("the log has no finite times".to_owned()))
}
