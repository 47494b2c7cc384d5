//! Kinks, jumps and poles of a motion that is given by expressions.
//!
//! When the argument of an `abs` or a `sign` passes 0, the velocity or the position may jump: the
//! acceleration is then an impulse, which derivatives do not see. When a divisor passes 0, the position may have no
//! bound, and the samples on either side do not show it.

use robot_symbolic::{Expr, Function, View, walk};

/// A jump of a coordinate.
pub(crate) struct Kink {
    /// The coordinate, from 0.
    pub(crate) coordinate: usize,
    /// The time, s.
    pub(crate) t: f64,
    /// The position or the velocity.
    pub(crate) what: &'static str,
    /// From where to where.
    pub(crate) sides: [f64; 2],
}

/// Parts of the span between two samples that are looked into: what passes 0 twice within one of them, or touches 0 without passing
/// it, is not seen.
const PARTS: usize = 4;
/// The distance from a kink, as a part of the whole time, at which its sides are compared.
const NEAR: f64 = 1e-9;

/// The first kink of each coordinate. `times` are the samples' and rise; `value` evaluates at a time, and
/// gives NaN if it cannot.
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

/// The arguments of `abs` and `sign`.
fn switches<'g>(root: Expr<'g>) -> Vec<Expr<'g>> {
    let inner = |expr: Expr<'g>| match expr.view() {
        View::Call(Function::Abs | Function::Sign, inner) => Some(inner),
        _ => None,
    };
    walk::reachable(&[root]).into_iter().filter_map(inner).collect()
}

/// The first time, s, at which each coordinate has no bound, with the coordinate, from 0; `times` and `value` as for
/// [`kinks`].
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

/// The factors of divisors, under roots too: where a square touches 0, its factor passes it.
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

/// Whether the size of an expression grows on the way to a time, by more than a bounded function would so near to it.
fn grows<'g>(
    q: Expr<'g>,
    t: f64,
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> bool {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return false };
    let near = ((last - first).abs() * NEAR).max(t.abs() * NEAR);
    let size = |t: f64| value(&[q], t).first().map_or(f64::NAN, |value| value.abs());
    // The root of a distance, the slowest of what grows here, doubles over this.
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

/// The time at which the expression passes 0 between two times.
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

/// The jump of a position or a velocity at a time, if there is one.
fn jump<'g>(
    coordinate: usize,
    motion: [Expr<'g>; 2],
    t: f64,
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> Option<Kink> {
    let (first, last) = (times.first().copied()?, times.last().copied()?);
    let near = (last - first).abs() * NEAR;
    // Two points on either side: what they differ by is how much a smooth motion changes.
    let inside = |t: &f64| (first..=last).contains(t);
    let at = |t: f64| inside(&t).then(|| value(&motion, t));
    let [far_before, before, here, after, far_after] =
        [t - 3.0 * near, t - near, t, t + near, t + 3.0 * near].map(at);
    // At an end of the time the derivative at the end itself is what jumps.
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
