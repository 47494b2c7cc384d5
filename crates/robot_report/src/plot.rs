//! Plots of curves over time as SVG, in the colors of the page.

use nalgebra::Vector2;
use robot_document::markup::{Element, element, holding};
use robot_simulation::plot::{Axis, label};

use crate::drawing::{coordinate, path};
use crate::text;

/// A plot of curves with the same unit.
pub(crate) struct Plot<'a> {
    /// The number of the plot on the page, for anchors.
    pub(crate) number: usize,
    /// The heading.
    pub(crate) title: String,
    /// The unit of the curves.
    pub(crate) unit: &'static str,
    /// The times in s, in ascending order.
    pub(crate) t: &'a [f64],
    /// The curves with their names; the last one is the sum of the others.
    pub(crate) curves: Vec<(&'static str, Vec<f64>)>,
}

/// The width and height of a plot, px.
const SIZE: [f64; 2] = [760.0, 210.0];
/// The margins of the plot area: left, right, top, bottom, px.
const MARGINS: [f64; 4] = [74.0, 108.0, 26.0, 34.0];
/// The size of letters, px.
const LETTERS: f64 = 12.0;

/// The largest numbers of ticks on the axes.
const TIME_TICKS: usize = 9;
const VALUE_TICKS: usize = 8;

/// The scales that convert times and values to positions in the plot.
struct Scale {
    time: Axis,
    values: Axis,
}

impl Plot<'_> {
    /// Draws the plot.
    pub(crate) fn build(&self) -> Element {
        let [width, height] = SIZE;
        let anchors = ["title", "desc"].map(|part| format!("plot-{}-{part}", self.number));
        let values = self.curves.iter().flat_map(|(_, values)| values.iter().copied());
        let scale = Scale { time: Axis::of_times(self.t), values: Axis::of(values) };
        element("svg")
            .attribute("xmlns", "http://www.w3.org/2000/svg")
            .class("plot")
            .attribute("viewBox", format!("0 0 {width} {height}"))
            .attribute("width", coordinate(width))
            .attribute("height", coordinate(height))
            .attribute("role", "img")
            .attribute("aria-labelledby", anchors.join(" "))
            .with(holding("title", self.title.as_str()).attribute("id", &anchors[0]))
            .with(holding("desc", self.description()).attribute("id", &anchors[1]))
            .with(words(&self.title, [MARGINS[0], 16.0], "start").class("heading"))
            .with_all(self.grid(&scale))
            .with_all(self.lines(&scale))
            .with_all(self.legend())
    }

    fn description(&self) -> String {
        let peak = |(name, values): &(&str, Vec<f64>)| {
            format!("{name} up to {} {}", text::number(rounded(peak(values))), self.unit)
        };
        let peaks: Vec<String> = self.curves.iter().map(peak).collect();
        format!("{}.", peaks.join(", "))
    }

    /// The lines at round values, and their labels.
    fn grid(&self, scale: &Scale) -> Vec<Element> {
        let mut drawn = vec![];
        let Scale { time, values } = scale;
        for value in values.ticks(VALUE_TICKS) {
            let ends = [time.low, time.high].map(|time| scale.place(time, value));
            let class = if value == 0.0 { "zero" } else { "tick" };
            drawn.push(path(&ends, false).class(class));
            let place = [ends[0].x - 6.0, ends[0].y + 4.0];
            drawn.push(words(&label(value), place, "end"));
        }
        for time in time.ticks(TIME_TICKS) {
            let ends = [values.low, values.high].map(|value| scale.place(time, value));
            drawn.push(path(&ends, false).class("tick"));
            drawn.push(words(&label(time), [ends[0].x, ends[0].y + 15.0], "middle"));
        }
        let [width, height] = SIZE;
        drawn.push(words("t, s", [width - MARGINS[1], height - 4.0], "end"));
        drawn.push(words(&values.unit(self.unit), [8.0, 16.0], "start"));
        drawn
    }

    fn lines(&self, scale: &Scale) -> Vec<Element> {
        let line = |(index, (_, values)): (usize, &(&str, Vec<f64>))| {
            let pairs = self.t.iter().zip(values).filter(|(_, value)| value.is_finite());
            let points: Vec<Vector2<f64>> = pairs
                .map(|(time, value)| scale.place(*time, scale.values.scaled(*value)))
                .collect();
            path(&points, false).class(self.class(index))
        };
        self.curves.iter().enumerate().map(line).collect()
    }

    fn legend(&self) -> Vec<Element> {
        let left = SIZE[0] - MARGINS[1] + 12.0;
        let entry = |(index, (name, _)): (usize, &(&str, Vec<f64>))| {
            let height = MARGINS[2] + 8.0 + 20.0 * index as f64;
            let sample = [left, left + 24.0].map(|x| Vector2::new(x, height));
            let sample = path(&sample, false).class(self.class(index));
            [sample, words(name, [left + 30.0, height + 4.0], "start")]
        };
        self.curves.iter().enumerate().flat_map(entry).collect()
    }

    /// The class of a curve; the sum is drawn differently from its parts.
    fn class(&self, index: usize) -> String {
        match index + 1 == self.curves.len() {
            true => "curve sum".to_owned(),
            false => format!("curve cause-{index}"),
        }
    }
}

impl Scale {
    /// The position of a time and a value, in the units of their axes.
    fn place(&self, time: f64, value: f64) -> Vector2<f64> {
        let share = |axis: &Axis, at: f64| (at - axis.low) / (axis.high - axis.low);
        let [left, right, top, bottom] = MARGINS;
        let [width, height] = SIZE;
        let x = left + share(&self.time, time) * (width - left - right);
        let y = height - bottom - share(&self.values, value) * (height - top - bottom);
        Vector2::new(x, y)
    }
}

/// The largest absolute value.
pub(crate) fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

/// Rounds a value to four digits, which are enough for a plot.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

fn words(text: &str, [x, y]: [f64; 2], anchor: &str) -> Element {
    holding("text", text)
        .attribute("x", coordinate(x))
        .attribute("y", coordinate(y))
        .attribute("font-size", coordinate(LETTERS))
        .attribute("text-anchor", anchor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_stay_in_their_field() {
        let values = Axis::of([-3.0, 5.0, f64::NAN].into_iter());
        let scale = Scale { time: Axis::of_times(&[0.0, 2.0]), values };
        assert_eq!(scale.place(0.0, values.high), Vector2::new(MARGINS[0], MARGINS[2]));
        let corner = Vector2::new(SIZE[0] - MARGINS[1], SIZE[1] - MARGINS[3]);
        assert_eq!(scale.place(2.0, values.low), corner);
        let [top, bottom] = [5.0, -3.0].map(|value| scale.place(1.0, value).y);
        assert!(MARGINS[2] < top && top < bottom && bottom < corner.y);
    }
}
