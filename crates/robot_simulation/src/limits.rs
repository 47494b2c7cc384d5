//! Derivatives at times at which the argument of an `abs` or a `sign` is 0, where sgn 0 = 0 is neither side's value.

use robot_symbolic::{Expr, Function, View, walk};

use crate::kinks::{NEAR, switches};

/// Replaces velocities and accelerations at times at which the argument of an `abs` or a `sign` in a position is 0 by
/// the means of their limits from both sides, or by the only limit at an end of the motion. `[qd, qdd]` has a row for
/// each of the `times`; `value` evaluates expressions at a time.
pub(crate) fn replace_by_limits<'g>(
    q: &[Expr<'g>],
    time: Expr<'g>,
    times: &[f64],
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
    [qd, qdd]: [&mut [Vec<f64>]; 2],
) {
    let switches: Vec<Expr<'g>> = q.iter().flat_map(|q| switches(*q)).collect();
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return };
    if switches.is_empty() {
        return;
    }
    for ((t, qd), qdd) in times.iter().zip(qd).zip(qdd) {
        if !value(&switches, *t).contains(&0.0) {
            continue;
        }
        let near = (last - first).max(t.abs()) * NEAR;
        let sides = [t - near, t + near].into_iter().filter(|side| (*first..=*last).contains(side));
        let limits: Vec<_> = sides.map(|side| limit(q, time, *t, side, value)).collect();
        let mean = |of: usize, coordinate: usize| {
            let all = limits.iter().filter_map(|limit| limit[of].get(coordinate));
            all.sum::<f64>() / limits.len() as f64
        };
        if !limits.is_empty() {
            *qd = (0..q.len()).map(|coordinate| mean(0, coordinate)).collect();
            *qdd = (0..q.len()).map(|coordinate| mean(1, coordinate)).collect();
        }
    }
}

/// The velocities and accelerations at the time t of the smooth motion that equals `q` at the time `side` close to it.
fn limit<'g>(
    q: &[Expr<'g>],
    time: Expr<'g>,
    t: f64,
    side: f64,
    value: &dyn Fn(&[Expr<'g>], f64) -> Vec<f64>,
) -> [Vec<f64>; 2] {
    let graph = time.graph();
    let smooth = walk::rebuild_upward(q, graph, |expr| {
        let View::Call(function @ (Function::Abs | Function::Sign), inner) = expr.view() else {
            return expr;
        };
        let here = value(&[inner], side).first().copied().unwrap_or(f64::NAN);
        match (function, here) {
            (Function::Abs, here) if here > 0.0 => inner,
            (Function::Abs, here) if here < 0.0 => -inner,
            (Function::Sign, here) if here > 0.0 => graph.one(),
            (Function::Sign, here) if here < 0.0 => -graph.one(),
            _ => expr,
        }
    });
    let qd = walk::derivatives(&smooth, time);
    let qdd = walk::derivatives(&qd, time);
    [qd, qdd].map(|derivatives| value(&derivatives, t))
}
