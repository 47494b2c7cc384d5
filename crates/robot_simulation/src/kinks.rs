//! Kinks, jumps and poles of motions that are given by expressions.
//!
//! When the argument of an `abs` or a `sign` passes 0, the velocity or the position can jump; the acceleration is then
//! an impulse, which derivatives do not show. When a divisor passes 0, the position can be unbounded, and the samples
//! before and after do not show it.

use robot_symbolic::{Expr, Function, View, walk};

/// A jump of a coordinate's position or velocity.
pub(crate) struct Kink {
    /// The index of the coordinate.
    pub(crate) coordinate: usize,
    /// The time, in s.
    pub(crate) t: f64,
    /// The quantity that jumps: `position` or `velocity`.
    pub(crate) what: &'static str,
    /// The values before and after the jump.
    pub(crate) sides: [f64; 2],
}

/// The number of parts into which the time between two samples is divided for the search. An expression that passes 0
/// twice within one part, or touches 0 without passing it, is not noticed.
const PARTS: usize = 4;
/// The distance from a kink at which the values before and after it are compared, as a fraction of the whole time.
pub(crate) const NEAR: f64 = 1e-9;

/// Finds the first kink of each coordinate. `times` are those of the samples, in ascending order; `value` evaluates
/// expressions at a time and returns NaN if it cannot.
pub(crate) fn kinks<'g>(
    q: &[Expr<'g>],
    qd: &[Expr<'g>],
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> Vec<Kink> {
    let coordinates = q.iter().zip(qd).enumerate();
    let of = |(coordinate, (q, qd)): (usize, (&Expr<'g>, &Expr<'g>))| {
        let switches = switches(*q);
        let crossings = crossings(&switches, times, value);
        crossings.into_iter().find_map(|t| jump(coordinate, [*q, *qd], t, times, value))
    };
    coordinates.filter_map(of).collect()
}

/// The arguments of `abs` and `sign` in an expression.
pub(crate) fn switches<'g>(root: Expr<'g>) -> Vec<Expr<'g>> {
    let inner = |expr: Expr<'g>| match expr.view() {
        View::Call(Function::Abs | Function::Sign, inner) => Some(inner),
        _ => None,
    };
    walk::reachable(&[root]).into_iter().filter_map(inner).collect()
}

/// Finds the coordinates whose positions are unbounded, given by their indices, and the first time in s at which each
/// is. For `times` and `value` see [`kinks`].
pub(crate) fn poles<'g>(
    q: &[Expr<'g>],
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> Vec<(usize, f64)> {
    let of = |(coordinate, q): (usize, &Expr<'g>)| {
        let crossings = crossings(&divisors(*q), times, value);
        let pole = crossings.into_iter().find(|t| grows(*q, *t, times, value));
        pole.map(|t| (coordinate, t))
    };
    q.iter().enumerate().filter_map(of).collect()
}

/// The factors of divisors, including those under roots: a factor of a square passes 0 where the square only touches
/// it.
fn divisors<'g>(root: Expr<'g>) -> Vec<Expr<'g>> {
    let mut left: Vec<Expr<'g>> = walk::reachable(&[root])
        .into_iter()
        .filter_map(|expr| match expr.view() {
            View::Div(_, divisor) => Some(divisor),
            _ => None,
        })
        .collect();
    let mut factors = vec![];
    while let Some(expr) = left.pop() {
        match expr.view() {
            View::Mul(one, other) => left.extend([one, other]),
            View::Neg(inner) | View::Call(Function::Sqrt | Function::Abs, inner) => {
                left.push(inner);
            }
            View::Number(_) | View::Pi => {}
            _ if factors.contains(&expr) => {}
            _ => factors.push(expr),
        }
    }
    factors
}

/// Whether the magnitude of an expression grows toward a time by more than a bounded function would so close to it.
fn grows<'g>(
    q: Expr<'g>,
    t: f64,
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> bool {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return false };
    let near = ((last - first).abs() * NEAR).max(t.abs() * NEAR);
    let size = |t: f64| value(&[q], t).first().map_or(f64::NAN, |value| value.abs());
    // The slowest growth here, that of one over the square root of the distance, doubles between these two distances.
    [-near, near].into_iter().any(|side| size(t + side) > 1.5 * size(t + 4.0 * side))
}

/// The times at which one of the expressions passes 0 or is 0, in order.
fn crossings<'g>(
    switches: &[Expr<'g>],
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> Vec<f64> {
    if switches.is_empty() {
        return vec![];
    }
    let mut found = vec![];
    let (Some(mut before), Some(_)) = (times.first().copied(), times.last()) else {
        return found;
    };
    let mut signs = value(switches, before);
    found.extend(signs.contains(&0.0).then_some(before));
    for pair in times.windows(2) {
        for part in 1..=PARTS {
            let t = match part {
                PARTS => pair[1],
                part => pair[0] + (pair[1] - pair[0]) * part as f64 / PARTS as f64,
            };
            let here = value(switches, t);
            for (index, (old, new)) in signs.iter().zip(&here).enumerate() {
                if *new == 0.0 {
                    found.push(t);
                } else if old * new < 0.0 {
                    found.push(bisected(switches[index], [before, t], *old, value));
                }
            }
            (before, signs) = (t, here);
        }
    }
    found.sort_by(f64::total_cmp);
    found
}

/// The time between two others at which an expression passes 0.
fn bisected<'g>(
    switch: Expr<'g>,
    [mut low, mut high]: [f64; 2],
    sign: f64,
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> f64 {
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return high;
        }
        match value(&[switch], middle).first() {
            Some(here) if here * sign > 0.0 => low = middle,
            _ => high = middle,
        }
    }
}

/// The jump of a position or velocity at a time; `None` if there is none.
fn jump<'g>(
    coordinate: usize,
    motion: [Expr<'g>; 2],
    t: f64,
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> Option<Kink> {
    let (first, last) = (times.first().copied()?, times.last().copied()?);
    let near = (last - first).abs() * NEAR;
    // There are two points on each side; the difference of their values shows how much a smooth motion changes.
    let inside = |t: &f64| (first..=last).contains(t);
    let at = |t: f64| inside(&t).then(|| value(&motion, t));
    let [far_before, before, here, after, far_after] =
        [t - 3.0 * near, t - near, t, t + near, t + 3.0 * near].map(at);
    // At an end of the time interval, the derivative at the end itself jumps.
    let (left, right) = (before.or_else(|| here.clone())?, after.or(here)?);
    for (index, what) in ["position", "velocity"].into_iter().enumerate() {
        let (left, right) = (*left.get(index)?, *right.get(index)?);
        let drift = |one: &Option<Vec<f64>>, side: f64| {
            one.as_ref().and_then(|far| far.get(index)).map_or(0.0, |far| (far - side).abs())
        };
        let smooth = drift(&far_before, left).max(drift(&far_after, right));
        let rounding = 1e-12 * left.abs().max(right.abs());
        if (right - left).abs() > 10.0 * smooth + 1e3 * rounding {
            return Some(Kink { coordinate, t, what, sides: [left, right] });
        }
    }
    None
}
