//! The ranges, ticks and labels of the axes of all plots.

/// The range of an axis, and the power of ten that its labels omit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The lower end, in units of 10^`exponent`.
    pub low: f64,
    /// The upper end, in units of 10^`exponent`.
    pub high: f64,
    /// The exponent of the power of ten.
    pub exponent: i32,
}

impl Axis {
    /// An axis for some values, with a margin; values that are not finite are ignored.
    #[must_use]
    pub fn of(values: impl Iterator<Item = f64>) -> Axis {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| value.is_finite()) {
            (low, high) = (low.min(value), high.max(value));
        }
        if low > high {
            (low, high) = (0.0, 0.0);
        }
        let size = low.abs().max(high.abs());
        // A constant curve gets a margin too.
        let room = if high - low > 1e-9 * size { 0.06 * (high - low) } else { 0.1 * size };
        let room = if room > 0.0 { room } else { 1.0 };
        let exponent = match size.log10().floor() {
            // Smaller powers of ten are 0.
            exponent if size > 0.0 && !(-2.0..5.0).contains(&exponent) => {
                exponent.max(-300.0) as i32
            }
            _ => 0,
        };
        let unit = 10_f64.powi(exponent);
        Axis { low: (low - room) / unit, high: (high + room) / unit, exponent }
    }

    /// An axis for times in ascending order, from the first to the last.
    #[must_use]
    pub fn of_times(t: &[f64]) -> Axis {
        let (low, high) = match (t.first(), t.last()) {
            (Some(first), Some(last)) if first < last => (*first, *last),
            (Some(first), _) => (*first, first + 1.0),
            _ => (0.0, 1.0),
        };
        Axis { low, high, exponent: 0 }
    }

    /// The ticks: multiples of 1, 2 or 5 times a power of ten within the axis, with the shortest step that gives at
    /// most `most` of them.
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<f64> {
        let span = self.high - self.low;
        let mut found = vec![];
        if !(span > 0.0 && span.is_finite()) {
            return found;
        }
        let mut power = span.log10().floor() as i32;
        loop {
            for digit in [10.0, 5.0, 2.0] {
                match multiples(self, digit, power, most) {
                    Some(finer) => found = finer,
                    None => return found,
                }
            }
            power -= 1;
        }
    }

    /// Converts a value to the units of the axis.
    #[must_use]
    pub fn scaled(&self, value: f64) -> f64 {
        value / 10_f64.powi(self.exponent)
    }

    /// The unit with the power of ten: `J`, or `10⁻⁹ J`.
    #[must_use]
    pub fn unit(&self, unit: &str) -> String {
        if self.exponent == 0 {
            return unit.to_owned();
        }
        const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let raised = |digit: char| match digit.to_digit(10) {
            Some(digit) => DIGITS[digit as usize],
            None => '⁻',
        };
        let power: String = self.exponent.to_string().chars().map(raised).collect();
        format!("10{power} {unit}")
    }
}

/// The multiples of a digit times a power of ten within an axis; `None` if there are more than `most`.
fn multiples(axis: &Axis, digit: f64, power: i32, most: usize) -> Option<Vec<f64>> {
    // A negative power of ten is not a binary number, but its inverse is, so dividing by it makes ticks as exact as
    // possible.
    let value = |index: f64| match power < 0 {
        true => index * digit / 10_f64.powi(-power),
        false => index * digit * 10_f64.powi(power),
    };
    let step = value(1.0);
    // An end of the axis that differs from a tick only by rounding gets this tick.
    let (first, last) = ((axis.low / step - 1e-9).ceil(), (axis.high / step + 1e-9).floor());
    // The search also ends if the step is too small for the precision of the axis.
    let count = last - first + 1.0;
    let is_few = count <= most as f64 && first + 1.0 > first;
    // Adding zero turns a negative zero into a positive one.
    is_few.then(|| (0..count as usize).map(|index| value(first + index as f64) + 0.0).collect())
}

/// A label with at most four decimals and a true minus sign.
#[must_use]
pub fn label(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text.strip_prefix('-') {
        Some("0") => "0".to_owned(),
        Some(size) => format!("−{size}"),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values_and_leave_room() {
        let axis = Axis::of([0.0, 2.0, f64::NAN].into_iter());
        assert_eq!(axis, Axis { low: -0.12, high: 2.12, exponent: 0 });
        let tiny = Axis::of([1e-9, -3e-9].into_iter());
        assert_eq!((tiny.exponent, tiny.unit("J")), (-9, "10⁻⁹ J".to_owned()));
        assert!(tiny.low < tiny.scaled(-3e-9) && tiny.scaled(1e-9) < tiny.high);
        let large = Axis::of([0.0, 123_456.0].into_iter());
        assert_eq!(large.unit("N"), "10⁵ N");
        let least = Axis::of([0.0, 5e-324].into_iter());
        assert!(least.low < least.high && least.high.is_finite(), "{least:?}");
        for flat in [[0.0, 0.0], [5.0, 5.0], [-1e9, -1e9 - 1e-3]] {
            let axis = Axis::of(flat.into_iter());
            assert!(axis.high - axis.low > 0.1, "{axis:?}");
        }
        assert_eq!(Axis::of(std::iter::empty()), Axis { low: -1.0, high: 1.0, exponent: 0 });
    }

    #[test]
    fn ticks_are_round_within_and_not_too_many() {
        let of = |low, high, most| Axis { low, high, exponent: 0 }.ticks(most);
        assert_eq!(of(0.0, 4.0, 9), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        assert_eq!(of(-7.0, 12.0, 6), [-5.0, 0.0, 5.0, 10.0]);
        assert_eq!(of(0.0, 0.3, 4), [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(of(1e5, 1.2e5, 6), [1e5, 1.05e5, 1.1e5, 1.15e5, 1.2e5]);
        for (low, high) in [(-1.0, 1.0), (-3e-7, 4e-7), (0.031, 0.032), (-9.9, 0.1)] {
            for most in 2..12 {
                let found = of(low, high, most);
                assert!(found.len() <= most && 3 * found.len() >= most, "{most}: {found:?}");
                assert!(found.iter().all(|tick| (low..=high).contains(tick)), "{found:?}");
            }
        }
        // There are no numbers between these.
        assert!(of(1.0, 1.0 + f64::EPSILON, 5).len() <= 5);
        for [low, high] in [[0.0, 0.0], [0.0, f64::INFINITY], [f64::NAN, 1.0]] {
            assert!(of(low, high, 5).is_empty());
        }
    }

    #[test]
    fn times_have_no_margin() {
        let ends = |t: &[f64]| [Axis::of_times(t).low, Axis::of_times(t).high];
        assert_eq!(
            [ends(&[0.5, 2.0]), ends(&[3.0]), ends(&[])],
            [[0.5, 2.0], [3.0, 4.0], [0.0, 1.0]]
        );
    }

    #[test]
    fn labels_are_short() {
        for (value, text) in [(-0.00001, "0"), (2.0, "2"), (-0.25, "−0.25"), (100.0, "100")] {
            assert_eq!(label(value), text);
        }
    }
}
