//! Sine, cosine and hyperbolic tangent to about 30 digits, as sums of two doubles, with angles reduced in
//! 128-bit integers. They are slow and simple, and the fast functions are compared with them.

/// An unevaluated sum `high + low` with |low| ≤ half a last place of high.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exact {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl Exact {
    pub(crate) fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// `a + b` for |a| ≥ |b|.
    fn normalized(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    fn negated(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }

    fn plus(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let error = (self.high - (sum - part)) + (other.high - part);
        Self::normalized(sum, error + (self.low + other.low))
    }

    fn times(self, other: Self) -> Self {
        let product = self.high * other.high;
        let error = f64::mul_add(self.high, other.high, -product);
        Self::normalized(product, error + (self.high * other.low + self.low * other.high))
    }

    fn over(self, divisor: Self) -> Self {
        let first = Self::new(self.high / divisor.high);
        let rest = self.plus(divisor.times(first).negated());
        let second = Self::new(rest.high / divisor.high);
        let rest = rest.plus(divisor.times(second).negated());
        first.plus(second).plus(Self::new(rest.high / divisor.high))
    }

    /// The difference of `value` and this number.
    pub(crate) fn error_of(self, value: f64) -> f64 {
        (value - self.high) - self.low
    }
}

/// π/2 in units of 2⁻¹¹⁰: the integer part; the next constant is the remainder.
pub(crate) const HALF_PI: i128 = 0x6487_ed51_10b4_611a_6263_3145_c06e;
const HALF_PI_TAIL: f64 = 0.05628326562056525;
const UNIT: f64 = 7.703719777548943e-34;

/// Sine and cosine of an angle of at most 2³⁰ radians.
pub(crate) fn sin_cos(angle: f64) -> (Exact, Exact) {
    assert!(angle.abs() <= 1073741824.0);
    if angle.abs() < 0.5 {
        return first_quadrant(Exact::new(angle));
    }
    let bits = angle.abs().to_bits();
    let mantissa = i128::from(bits & ((1 << 52) - 1) | 1 << 52);
    let exponent = (bits >> 52) as i64 - 1075;
    // For large angles, high bits overflow here and in the multiple alike, because the difference is small.
    let magnitude = mantissa << (exponent + 110);
    let fixed = if angle < 0.0 { magnitude.wrapping_neg() } else { magnitude };
    let k = (angle * std::f64::consts::FRAC_2_PI).round() as i128;
    let rest = fixed.wrapping_sub(k.wrapping_mul(HALF_PI));
    let high = rest as f64;
    let low = (rest - high as i128) as f64 - k as f64 * HALF_PI_TAIL;
    let reduced = Exact::normalized(high * UNIT, low * UNIT);
    let (sine, cosine) = first_quadrant(reduced);
    match k.rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, sine.negated()),
        2 => (sine.negated(), cosine.negated()),
        _ => (cosine.negated(), sine),
    }
}

/// The power series, for |r| < 0.8.
fn first_quadrant(r: Exact) -> (Exact, Exact) {
    let minus_square = r.times(r).negated();
    let series = |first: i32| {
        (0..14).rev().fold(Exact::new(1.0), |tail, term| {
            let n = f64::from(first + 2 * term);
            let factor = minus_square.over(Exact::new(n * (n + 1.0)));
            Exact::new(1.0).plus(factor.times(tail))
        })
    };
    (r.times(series(2)), series(1))
}

/// Hyperbolic tangent of |x| ≤ 50.
pub(crate) fn tanh(x: f64) -> Exact {
    assert!(x.abs() <= 50.0);
    // e^y − 1 for y = 2x/2¹⁰ by its series, then e^2y − 1 = (e^y − 1)(e^y − 1 + 2) ten times.
    let y = Exact::new(x * 2.0 / 1024.0);
    let series = (2..20).rev().fold(Exact::new(1.0), |tail, n| {
        Exact::new(1.0).plus(y.over(Exact::new(f64::from(n))).times(tail))
    });
    let two = Exact::new(2.0);
    let t = (0..10).fold(y.times(series), |t, _| t.times(t.plus(two)));
    t.over(t.plus(two))
}
