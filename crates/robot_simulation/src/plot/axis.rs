//! Ranges and labels of axes.

/// The range of an axis and the power of ten that its labels leave out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    /// The lower end, in units of 10^exponent.
    pub(super) low: f64,
    /// The upper end, in units of 10^exponent.
    pub(super) high: f64,
    /// The power of ten.
    pub(super) exponent: i32,
}

impl Axis {
    /// An axis for some values, with a margin; finite ones count.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Axis {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| value.is_finite()) {
            (low, high) = (low.min(value), high.max(value));
        }
        if low > high {
            (low, high) = (0.0, 0.0);
        }
        let size = low.abs().max(high.abs());
        // A constant curve gets some room.
        let room = if high - low > 1e-9 * size { 0.06 * (high - low) } else { 0.1 * size };
        let room = if room > 0.0 { room } else { 1.0 };
        let exponent = match size.log10().floor() {
            exponent if size > 0.0 && !(-2.0..5.0).contains(&exponent) => exponent as i32,
            _ => 0,
        };
        let unit = 10_f64.powi(exponent);
        Axis { low: (low - room) / unit, high: (high + room) / unit, exponent }
    }

    /// A value in the units of the axis.
    pub(super) fn scaled(&self, value: f64) -> f64 {
        value / 10_f64.powi(self.exponent)
    }

    /// `J`, or `10⁻⁹ J`.
    pub(super) fn unit(&self, unit: &str) -> String {
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

/// A label: four decimals at most, a true minus sign.
pub(super) fn label(value: f64) -> String {
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
        for flat in [[0.0, 0.0], [5.0, 5.0], [-1e9, -1e9 - 1e-3]] {
            let axis = Axis::of(flat.into_iter());
            assert!(axis.high - axis.low > 0.1, "{axis:?}");
        }
        assert_eq!(Axis::of(std::iter::empty()), Axis { low: -1.0, high: 1.0, exponent: 0 });
    }

    #[test]
    fn labels_are_short() {
        for (value, text) in [(-0.00001, "0"), (2.0, "2"), (-0.25, "−0.25"), (100.0, "100")] {
            assert_eq!(label(value), text);
        }
    }
}
