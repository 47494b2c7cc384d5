//! Curves over time as SVG, in the colors of the page.

use nalgebra::Vector2;
use robot_document::markup::{Element, element, holding};

use crate::drawing::{coordinate, path};
use crate::text;

/// A picture of curves of one unit.
pub(crate) struct Plot<'a> {
    /// Its number on the page, for anchors.
    pub(crate) number: usize,
    /// Its content.
    pub(crate) title: String,
    /// The unit of the curves.
    pub(crate) unit: &'static str,
    /// t, s, rising.
    pub(crate) t: &'a [f64],
    /// The curves by name, the last one the sum of the others.
    pub(crate) curves: Vec<(&'static str, Vec<f64>)>,
}

/// The size of a picture and the margins of its field: left, right, top, bottom.
const SIZE: [f64; 2] = [760.0, 210.0];
const MARGINS: [f64; 4] = [74.0, 108.0, 26.0, 34.0];
const LETTERS: f64 = 12.0;

/// From values to places on the page.
struct Scale {
    time: [f64; 2],
    values: [f64; 2],
}

impl Plot<'_> {
    /// The picture.
    pub(crate) fn build(&self) -> Element {
        let [width, height] = SIZE;
        let anchors = ["title", "desc"].map(|part| format!("plot-{}-{part}", self.number));
        let values = self.curves.iter().flat_map(|(_, values)| values.iter().copied());
        let scale = Scale { time: range(self.t.iter().copied()), values: range(values) };
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

    /// Lines at round values, with the values.
    fn grid(&self, scale: &Scale) -> Vec<Element> {
        let mut drawn = vec![];
        let [low, high] = scale.values;
        for value in ticks(low, high, 5) {
            let ends = scale.time.map(|time| scale.place(time, value));
            let class = if value == 0.0 { "zero" } else { "tick" };
            drawn.push(path(&ends, false).class(class));
            let place = [ends[0].x - 6.0, ends[0].y + 4.0];
            drawn.push(words(&text::number(rounded(value)), place, "end"));
        }
        let [from, to] = scale.time;
        for time in ticks(from, to, 8) {
            let ends = scale.values.map(|value| scale.place(time, value));
            drawn.push(path(&ends, false).class("tick"));
            drawn.push(words(
                &text::number(rounded(time)),
                [ends[0].x, ends[0].y + 15.0],
                "middle",
            ));
        }
        let [width, height] = SIZE;
        drawn.push(words("t, s", [width - MARGINS[1], height - 4.0], "end"));
        drawn.push(words(self.unit, [8.0, 16.0], "start"));
        drawn
    }

    fn lines(&self, scale: &Scale) -> Vec<Element> {
        let line = |(index, (_, values)): (usize, &(&str, Vec<f64>))| {
            let pairs = self.t.iter().zip(values).filter(|(_, value)| value.is_finite());
            let points: Vec<Vector2<f64>> =
                pairs.map(|(time, value)| scale.place(*time, *value)).collect();
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

    /// The look of a curve: the sum is not like its parts.
    fn class(&self, index: usize) -> String {
        match index + 1 == self.curves.len() {
            true => "curve sum".to_owned(),
            false => format!("curve cause-{index}"),
        }
    }
}

impl Scale {
    fn place(&self, time: f64, value: f64) -> Vector2<f64> {
        let share = |[low, high]: [f64; 2], at: f64| (at - low) / (high - low);
        let [left, right, top, bottom] = MARGINS;
        let [width, height] = SIZE;
        let x = left + share(self.time, time) * (width - left - right);
        let y = height - bottom - share(self.values, value) * (height - top - bottom);
        Vector2::new(x, y)
    }
}

/// The range of values, with some room if they are all the same.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], one| [low.min(one), high.max(one)]);
    let flat = 1e-9 * low.abs().max(high.abs());
    if high - low > flat {
        [low, high]
    } else if low <= high {
        [low - 1.0, high + 1.0]
    } else {
        [0.0, 1.0]
    }
}

/// Round values within a range, about so many.
fn ticks(low: f64, high: f64, count: u32) -> Vec<f64> {
    let raw = (high - low) / f64::from(count);
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|step| step * power).find(|step| *step >= raw);
    let step = step.unwrap_or(10.0 * power);
    let first = (low / step).ceil() as i64;
    let all = (first..).map(|index| index as f64 * step);
    all.take_while(|value| *value <= high + 1e-9 * step).take(50).collect()
}

/// The largest magnitude.
pub(crate) fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

/// Four digits are enough to read off a picture.
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
    fn ticks_are_round_and_within() {
        assert_eq!(ticks(0.0, 4.0, 8), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        assert_eq!(ticks(-7.0, 12.0, 5), [-5.0, 0.0, 5.0, 10.0]);
        for (low, high) in [(-1.0, 1.0), (-3e-7, 4e-7), (1e5, 1.2e5)] {
            let found = ticks(low, high, 5);
            assert!((2..=10).contains(&found.len()), "{found:?}");
        }
    }

    #[test]
    fn curves_stay_in_their_field() {
        let scale = Scale { time: [0.0, 2.0], values: range([-3.0, 5.0, f64::NAN].into_iter()) };
        assert_eq!(scale.place(0.0, 5.0), Vector2::new(MARGINS[0], MARGINS[2]));
        let corner = Vector2::new(SIZE[0] - MARGINS[1], SIZE[1] - MARGINS[3]);
        assert_eq!(scale.place(2.0, -3.0), corner);
        assert_eq!((range([2.0].into_iter()), range([].into_iter())), ([1.0, 3.0], [0.0, 1.0]));
    }
}
