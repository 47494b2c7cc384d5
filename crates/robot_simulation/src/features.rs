//! Jumps and short pulses of joint torques that are given by expressions.
//!
//! The integrator chooses its steps from values at some times within each step, so it can miss what happens between
//! these times. Therefore the parts of the expressions that depend only on the time are examined beforehand.

use std::collections::BTreeMap;

use robot_symbolic::walk::{self, Evaluator};
use robot_symbolic::{Expr, Formula, Function, Graph, Id, SymbolId, View};

use crate::dynamics::Features;

/// The smallest number of times at which the whole motion is examined.
const LEAST: usize = 1 << 16;
/// The smallest average number of examined times between two samples.
const PARTS: usize = 16;
/// The smallest second difference of the values of a pulse at three successive times, as a fraction of the largest value.
/// That of a pulse of a hundredth of the largest value that lasts for a hundred of these times is twice as large.
const SECOND_DIFFERENCE: f64 = 1e-6;
/// The length of pulses with about the second difference [`SECOND_DIFFERENCE`], in units of the distance between the examined times.
const REACH: f64 = 100.0;
/// The factor by which examined times are farther apart in the search for longer pulses.
const STRIDE: usize = 32;
/// The distance from a jump at which steps end and begin, in units of the relative precision of the time.
const MARGIN: f64 = 8.0;

/// Finds the jumps and peaks of formulas of t, the state and constants within the span of the samples. `constant` gives
/// the values of constants; all other names except `t` belong to the state.
pub(crate) fn features(
    formulas: &[Formula],
    constant: impl Fn(&str) -> Option<f64>,
    samples: &[f64],
) -> Features {
    let graph = Graph::new();
    let lower = |formula: &Formula| formula.lower(&graph, &mut |name| graph.symbol(name));
    let roots: Vec<Expr<'_>> = formulas.iter().map(lower).collect();
    let parts = Parts::of(&graph, &roots, &constant);
    let Some(end) = samples.last().copied().filter(|_| parts.roots > 0) else {
        return Features::default();
    };
    let looks = LEAST.max(PARTS * samples.len());
    let times = (0..=looks).map(|look| end * (look as f64 / looks as f64));
    let longest = samples.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let (mut found, mut stride) = (peaks(&parts, times.clone()), 1);
    // A longer pulse, which bends too little between successive times, is found with times that are farther apart. A
    // pulse longer than the time between two samples cannot be missed, because no step is longer than that.
    while stride < looks / STRIDE && longest > REACH * stride as f64 * (end / looks as f64) {
        stride *= STRIDE;
        found.extend(peaks(&parts, times.clone().step_by(stride)));
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    Features { jumps: jumps(&parts, times), peaks: found }
}

/// The parts of formulas that depend only on the time.
struct Parts {
    /// The values of the largest such parts, followed by those of the arguments of their `abs` and `sign`.
    values: Evaluator,
    /// The number of these parts.
    roots: usize,
    /// The number of these arguments.
    switches: usize,
    /// The values of all symbols except the time.
    constants: BTreeMap<SymbolId, f64>,
}

impl Parts {
    fn of(graph: &Graph, roots: &[Expr<'_>], constant: &impl Fn(&str) -> Option<f64>) -> Parts {
        let mut constants = BTreeMap::new();
        let (mut found, mut switches) = (vec![], vec![]);
        // For each expression that does not depend on the state, whether it depends on the time.
        let mut known: BTreeMap<Id, bool> = BTreeMap::new();
        for expr in walk::reachable(roots) {
            let operands = expr.operands();
            let moves = match expr.as_symbol() {
                Some(symbol) => match &*graph.symbol_name(symbol) {
                    "t" => Some(true),
                    name => constant(name).map(|value| {
                        constants.insert(symbol, value);
                        false
                    }),
                },
                None => operands.iter().try_fold(false, |moves, operand| {
                    known.get(&operand.id()).map(|operand| moves | operand)
                }),
            };
            match moves {
                Some(moves) => {
                    if let View::Call(Function::Abs | Function::Sign, inner) = expr.view()
                        && moves
                    {
                        switches.push(inner);
                    }
                    known.insert(expr.id(), moves);
                }
                None => found.extend(moving(operands, &known)),
            }
        }
        found.extend(moving(roots.to_vec(), &known));
        for list in [&mut found, &mut switches] {
            list.sort_unstable_by_key(|expr| expr.id());
            list.dedup_by_key(|expr| expr.id());
        }
        let (roots, switches_count) = (found.len(), switches.len());
        found.extend(switches);
        Parts { values: Evaluator::new(&found), roots, switches: switches_count, constants }
    }

    /// The values at a time: first those of the parts, then those of the arguments.
    fn at(&self, t: f64) -> Vec<f64> {
        self.values.values(|symbol| self.constants.get(&symbol).copied().unwrap_or(t))
    }

    /// The signs of the arguments of `abs` and `sign` at a time.
    fn classes(&self, t: f64) -> Vec<f64> {
        self.at(t).into_iter().skip(self.roots).map(class).collect()
    }
}

/// The expressions among `exprs` that depend on the time and not on the state.
fn moving<'g>(exprs: Vec<Expr<'g>>, known: &BTreeMap<Id, bool>) -> Vec<Expr<'g>> {
    exprs.into_iter().filter(|expr| known.get(&expr.id()) == Some(&true)).collect()
}

/// The value of `sign` for a number.
fn class(value: f64) -> f64 {
    Function::Sign.apply(value)
}

/// The times at which the argument of an `abs` or a `sign` passes 0, becomes 0 or ceases to be 0, in order.
fn jumps(parts: &Parts, times: impl Iterator<Item = f64>) -> Vec<[f64; 2]> {
    let (mut found, mut before) = (vec![], None);
    if parts.switches == 0 {
        return found;
    }
    for t in times {
        let classes = parts.classes(t);
        if let Some((start, old)) = before.replace((t, classes.clone())) {
            for (switch, (old, new)) in old.iter().zip(&classes).enumerate() {
                let mut span = (start, *old);
                // The sign can change twice: to 0, and from 0 to the other sign.
                for _ in 0..2 {
                    if span.1 != *new && !(span.1.is_nan() || new.is_nan()) {
                        let [low, high] = boundary(parts, switch, [span.0, t], span.1);
                        let margin = MARGIN * f64::EPSILON * high;
                        found.push([low - margin, high + margin]);
                        span = (high, parts.classes(high)[switch]);
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Jumps at practically the same time, such as those to and from 0, are merged.
    let mut apart: Vec<[f64; 2]> = vec![];
    for [before, after] in found {
        match apart.last_mut() {
            Some(last) if before <= last[1] => last[1] = last[1].max(after),
            _ => apart.push([before, after]),
        }
    }
    apart
}

/// The two neighboring times between which the sign of a value changes from `old`.
fn boundary(parts: &Parts, switch: usize, [mut low, mut high]: [f64; 2], old: f64) -> [f64; 2] {
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return [low, high];
        }
        if parts.classes(middle)[switch] == old { low = middle } else { high = middle }
    }
}

/// The times at which a part bends most: the tops and feet of pulses, and the ends of steep flanks.
fn peaks(parts: &Parts, times: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    let mut largest = vec![0.0_f64; parts.roots];
    for t in times.clone() {
        for (largest, value) in largest.iter_mut().zip(parts.at(t)) {
            *largest = largest.max(value.abs());
        }
    }
    // The last two values of each part, and its bends at the two times before the last.
    let mut last = vec![[0.0_f64; 2]; parts.roots];
    let mut bends = last.clone();
    let (mut found, mut earlier) = (vec![], [0.0; 2]);
    for (look, t) in times.enumerate() {
        let mut is_peak = false;
        for (index, value) in parts.at(t).into_iter().take(parts.roots).enumerate() {
            let [before, between] = last[index];
            let bend = if look < 2 { 0.0 } else { (value - 2.0 * between + before).abs() };
            let [first, middle] = bends[index];
            // `middle` is the bend two times before the current one.
            is_peak |=
                middle > SECOND_DIFFERENCE * largest[index] && middle > first && middle >= bend;
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
        // The sign becomes 0 and changes further.
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
        // Pulses of all lengths between two samples that are far apart.
        for width in [0.001, 0.01, 0.1, 1.0] {
            let pulse = format!("1/(1 + ((t - 23)/{width})^2)");
            let peaks = found(&pulse, &[0.0, 100.0]).peaks;
            assert!(peaks.iter().any(|peak| (peak - 23.0).abs() < 2.0 * width), "{peaks:?}");
        }
    }
}
