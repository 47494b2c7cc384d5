//! Jumps and short pulses of driving forces that are given by expressions.
//!
//! The integrator chooses its steps by what it sees at some times within each; what lies between these it
//! would step over. So parts of the expressions that depend on the time alone are looked at beforehand.

use std::collections::BTreeMap;

use robot_symbolic::{Expr, Formula, Function, Graph, Id, View, walk};

use crate::dynamics::Features;

/// Looks at least at so many times over the whole motion,
const LEAST: usize = 1 << 16;
/// and at so many between two samples.
const PARTS: usize = 16;
/// What bends by less than this part of the largest value between two looks is no pulse; one as long as a
/// hundred looks, of a hundredth of the largest value, bends by twice as much.
const BEND: f64 = 1e-6;
/// In units of the time between two looks, the length of the pulses that bend by so much.
const REACH: f64 = 100.0;
/// By how much looks at longer pulses are farther apart.
const STRIDE: usize = 32;
/// How far from a jump steps end and begin, in units of the time's last place.
const MARGIN: f64 = 8.0;

/// The jumps and peaks of formulas of t, the state and constants, within the span of the samples.
/// `constant` gives the constants; other names than these and `t` are of the state.
pub(crate) fn features(
    formulas: &[Formula],
    constant: impl Fn(&str) -> Option<f64>,
    samples: &[f64],
) -> Features {
    let graph = Graph::new();
    let lower = |formula: &Formula| formula.lower(&graph, &mut |name| graph.symbol(name));
    let roots: Vec<Expr<'_>> = formulas.iter().map(lower).collect();
    let parts = Parts::of(&graph, &roots, &constant);
    let Some(end) = samples.last().copied().filter(|_| !parts.roots.is_empty()) else {
        return Features::default();
    };
    let looks = LEAST.max(PARTS * samples.len());
    let times = (0..=looks).map(|look| end * (look as f64 / looks as f64));
    let longest = samples.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let (mut found, mut stride) = (peaks(&parts, times.clone()), 1);
    // A pulse that bends too little between neighbouring looks is one between looks farther apart; no step
    // is longer than the span between two samples.
    while stride < looks / STRIDE && longest > REACH * stride as f64 * (end / looks as f64) {
        stride *= STRIDE;
        found.extend(peaks(&parts, times.clone().step_by(stride)));
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    Features { jumps: jumps(&parts, times), peaks: found }
}

/// An operation on earlier values.
#[derive(Clone, Copy)]
enum Operation {
    Constant(f64),
    Time,
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Neg(usize),
    Call(Function, usize),
}

/// What depends on the time alone.
struct Parts {
    operations: Vec<Operation>,
    /// The largest such parts of the formulas.
    roots: Vec<usize>,
    /// What stands in their `abs` and `sign`.
    switches: Vec<usize>,
}

impl Parts {
    fn of(graph: &Graph, roots: &[Expr<'_>], constant: &impl Fn(&str) -> Option<f64>) -> Parts {
        let mut parts = Parts { operations: vec![], roots: vec![], switches: vec![] };
        // For each expression that does not depend on the state its value's place, and whether it depends on t.
        let mut known: BTreeMap<Id, (usize, bool)> = BTreeMap::new();
        for expr in walk::reachable(roots) {
            let at = |operand: Expr<'_>| known.get(&operand.id()).copied();
            let pair = |a: Expr<'_>, b: Expr<'_>| {
                let ((a, a_moves), (b, b_moves)) = (at(a)?, at(b)?);
                Some(([a, b], a_moves || b_moves))
            };
            let found = match expr.view() {
                View::Number(number) => Some((Operation::Constant(number.to_f64()), false)),
                View::Pi => Some((Operation::Constant(std::f64::consts::PI), false)),
                View::Symbol(symbol) => match &*graph.symbol_name(symbol) {
                    "t" => Some((Operation::Time, true)),
                    name => constant(name).map(|value| (Operation::Constant(value), false)),
                },
                View::Add(a, b) => pair(a, b).map(|([a, b], moves)| (Operation::Add(a, b), moves)),
                View::Sub(a, b) => pair(a, b).map(|([a, b], moves)| (Operation::Sub(a, b), moves)),
                View::Mul(a, b) => pair(a, b).map(|([a, b], moves)| (Operation::Mul(a, b), moves)),
                View::Div(a, b) => pair(a, b).map(|([a, b], moves)| (Operation::Div(a, b), moves)),
                View::Neg(a) => at(a).map(|(a, moves)| (Operation::Neg(a), moves)),
                View::Call(function, a) => {
                    at(a).map(|(a, moves)| (Operation::Call(function, a), moves))
                }
            };
            match found {
                Some((operation, moves)) => {
                    if let Operation::Call(Function::Abs | Function::Sign, inner) = operation
                        && moves
                    {
                        parts.switches.push(inner);
                    }
                    known.insert(expr.id(), (parts.operations.len(), moves));
                    parts.operations.push(operation);
                }
                None => parts.roots.extend(moving(expr.operands(), &known)),
            }
        }
        parts.roots.extend(moving(roots.to_vec(), &known));
        for places in [&mut parts.roots, &mut parts.switches] {
            places.sort_unstable();
            places.dedup();
        }
        parts
    }

    /// The values at a time, one for each operation.
    fn evaluate(&self, t: f64, values: &mut Vec<f64>) {
        values.clear();
        for operation in &self.operations {
            values.push(match *operation {
                Operation::Constant(value) => value,
                Operation::Time => t,
                Operation::Add(a, b) => values[a] + values[b],
                Operation::Sub(a, b) => values[a] - values[b],
                Operation::Mul(a, b) => values[a] * values[b],
                Operation::Div(a, b) => values[a] / values[b],
                Operation::Neg(a) => -values[a],
                Operation::Call(function, a) => function.apply(values[a]),
            });
        }
    }
}

/// The places of those that depend on the time.
fn moving(exprs: Vec<Expr<'_>>, known: &BTreeMap<Id, (usize, bool)>) -> Vec<usize> {
    let found = exprs.into_iter().filter_map(|expr| known.get(&expr.id()));
    found.filter(|(_, moves)| *moves).map(|(place, _)| *place).collect()
}

/// Which of the three values of `sign` a number has.
fn class(value: f64) -> f64 {
    Function::Sign.apply(value)
}

/// Where what stands in an `abs` or a `sign` passes 0, comes to it or leaves it, in order.
fn jumps(parts: &Parts, times: impl Iterator<Item = f64>) -> Vec<[f64; 2]> {
    let (mut found, mut values, mut before) = (vec![], vec![], None);
    if parts.switches.is_empty() {
        return found;
    }
    for t in times {
        parts.evaluate(t, &mut values);
        let classes: Vec<f64> = parts.switches.iter().map(|place| class(values[*place])).collect();
        if let Some((start, old)) = before.replace((t, classes.clone())) {
            for ((place, old), new) in parts.switches.iter().zip(&old).zip(&classes) {
                let mut span = (start, *old);
                // By way of 0.
                for _ in 0..2 {
                    if span.1 != *new && !(span.1.is_nan() || new.is_nan()) {
                        let [low, high] = boundary(parts, *place, [span.0, t], span.1);
                        let margin = MARGIN * f64::EPSILON * high;
                        found.push([low - margin, high + margin]);
                        parts.evaluate(high, &mut values);
                        span = (high, class(values[*place]));
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Jumps at one time, to 0 and on among them, are one.
    let mut apart: Vec<[f64; 2]> = vec![];
    for [before, after] in found {
        match apart.last_mut() {
            Some(last) if before <= last[1] => last[1] = last[1].max(after),
            _ => apart.push([before, after]),
        }
    }
    apart
}

/// The neighbouring times between which a value's class is no longer what it was at the first.
fn boundary(parts: &Parts, place: usize, [mut low, mut high]: [f64; 2], old: f64) -> [f64; 2] {
    let mut values = vec![];
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return [low, high];
        }
        parts.evaluate(middle, &mut values);
        if class(values[place]) == old { low = middle } else { high = middle }
    }
}

/// Where a part bends most: the tops and feet of pulses, the ends of steep flanks.
fn peaks(parts: &Parts, times: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    let mut values = vec![];
    let mut largest = vec![0.0_f64; parts.roots.len()];
    for t in times.clone() {
        parts.evaluate(t, &mut values);
        for (largest, place) in largest.iter_mut().zip(&parts.roots) {
            *largest = largest.max(values[*place].abs());
        }
    }
    // The last values of each, and how much they bend at the two times before the last.
    let mut last = vec![[0.0_f64; 2]; parts.roots.len()];
    let mut bends = last.clone();
    let (mut found, mut earlier) = (vec![], [0.0; 2]);
    for (look, t) in times.enumerate() {
        parts.evaluate(t, &mut values);
        let mut is_peak = false;
        for (index, place) in parts.roots.iter().enumerate() {
            let (value, [before, between]) = (values[*place], last[index]);
            let bend = if look < 2 { 0.0 } else { (value - 2.0 * between + before).abs() };
            let [first, middle] = bends[index];
            // `middle` is the bend at the time before the last.
            is_peak |= middle > BEND * largest[index] && middle > first && middle >= bend;
            last[index] = [between, value];
            bends[index] = [middle, bend];
        }
        if is_peak {
            found.push(earlier[0]);
        }
        earlier = [earlier[1], t];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str, samples: &[f64]) -> Features {
        let constant = |name: &str| (name == "a").then_some(0.5);
        features(&[Formula::parse(text).unwrap()], constant, samples)
    }

    #[test]
    fn jumps_are_found_however_short_the_pulse() {
        let jumps = found("a*(sign(t - 2.3) - sign(t - 2.3 - 1e-9))*q1", &[0.0, 5.0]).jumps;
        assert_eq!(jumps.len(), 2, "{jumps:?}");
        for ([before, after], t) in jumps.into_iter().zip([2.3, 2.3 + 1e-9]) {
            assert!(before < t && t < after && after - before < 1e-13, "{before} {after}");
        }
        // To 0 and on.
        assert_eq!(found("sign(t - 1)", &[0.0, 1.0, 2.0]).jumps.len(), 1);
        assert_eq!(found("sign(abs(t - 1) - (t - 1))", &[0.0, 3.0]).jumps.len(), 1);
        assert_eq!(found("sign(q1 - t)*abs(a)", &[0.0, 3.0]), Features::default());
    }

    #[test]
    fn pulses_have_peaks_and_slow_motions_none() {
        let near = |text: &str, t: f64| {
            let peaks = found(text, &[0.0, 1.0, 10.0]).peaks;
            assert!(peaks.len() < 20, "{peaks:?}");
            peaks.iter().any(|peak| (peak - t).abs() < 2e-4)
        };
        assert!(near("7 + 1/(1 + ((t - 2.3)/0.001)^2)", 2.3));
        assert!(near("qd1*tanh((t - 4)/1e-6) - qd1*tanh((t - 4.001)/1e-6)", 4.001));
        let samples: Vec<f64> = (0..=1000).map(|sample| f64::from(sample) * 0.01).collect();
        assert!(found("sin(3*t) + t^2 - q1*t", &samples).peaks.is_empty());
        // Between long samples, of any length.
        for width in [0.001, 0.01, 0.1, 1.0] {
            let pulse = format!("1/(1 + ((t - 23)/{width})^2)");
            let peaks = found(&pulse, &[0.0, 100.0]).peaks;
            assert!(peaks.iter().any(|peak| (peak - 23.0).abs() < 2.0 * width), "{peaks:?}");
        }
    }
}
