//! Numbers that are close to a multiple of π/2.

use crate::exact::HALF_PI;

/// The numbers from 1 to 2³⁰ that are closest to a multiple of π/2. If such a number is m·u, where m has 53 bits
/// and u is its last place, then m/k is a best approximation of (π/2)/u: a convergent or semiconvergent of the
/// continued fraction, or a multiple of one.
pub(crate) fn nearest_angles() -> Vec<f64> {
    let mut angles = vec![];
    for exponent in 0..30 {
        let unit = 2f64.powi(exponent - 52);
        // Dividend and divisor of (π/2)/u in units of 2⁻¹¹⁰; convergents p/q, the last two.
        let (mut dividend, mut divisor) = (HALF_PI, 1i128 << (110 + exponent - 52));
        let (mut before, mut last) = ((0i128, 1i128), (1i128, 0i128));
        while divisor != 0 && last.1 < 1 << 30 {
            let quotient = dividend / divisor;
            for part in 1..=quotient.min(200) {
                let (p, q) = (before.0 + part * last.0, before.1 + part * last.1);
                if q < 1 << 30 {
                    let multiples = (1..64).map(|factor| factor * p);
                    let mantissas = multiples.filter(|m| (1 << 52..1 << 53).contains(m));
                    angles.extend(mantissas.map(|m| m as f64 * unit));
                }
            }
            let next = (before.0 + quotient * last.0, before.1 + quotient * last.1);
            (before, last) = (last, next);
            (dividend, divisor) = (divisor, dividend - quotient * divisor);
        }
    }
    angles
}
