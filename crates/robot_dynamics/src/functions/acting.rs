//! Functions without the parameters that have no effect on them.
//!
//! A recursion may contain terms that cancel: for a link that only turns about z, I_xx enters both second moments Σ_xx
//! and Σ_yy and cancels in their sum. Rounding errors do not cancel, so a parameter without effect on a function would
//! reduce its accuracy. Such parameters are found by differentiation at seeded states and replaced by a constant in the
//! function's expressions.

use std::collections::{BTreeMap, BTreeSet};

use robot_symbolic::walk::{self, Evaluator};
use robot_symbolic::{Expr, Function as Elementary, Random, SymbolId, View};

use super::{Derivation, Function};

/// The number of states at which slopes are evaluated.
const STATES: u64 = 3;
/// A slope below this fraction of the sum of its terms' magnitudes may be 0.
const NOTICED: f64 = 1e-8;
/// The factors by which a parameter is multiplied to test whether it has an effect. A parameter can act by its sign
/// alone, as s does in s/√(s²), the component of a joint axis.
const CHANGES: [f64; 3] = [1e3, -1.0, -1e3];
/// If no value changes by more than this fraction of itself, the parameter has no effect: its contribution to the value
/// is below the rounding error of the value.
const UNCHANGED: f64 = 1e-10;
/// Values below this fraction of the largest value count as rounding errors.
const ROUNDING: f64 = 1e-14;

impl<'g> Derivation<'_, 'g> {
    /// The function with a constant in place of each parameter that has no effect on it.
    pub(super) fn of_acting_parameters(&self, mut function: Function<'g>) -> Function<'g> {
        let graph = self.mechanism.graph;
        let outputs = function.outputs.iter().flat_map(|output| &output.values);
        let roots: Vec<Expr<'g>> = outputs.copied().collect();
        let idle = self.idle_parameters(&roots);
        if idle.is_empty() || graph.is_full() {
            return function;
        }
        // The constant 1 is tried as well, because a value in a denominator must not be 0.
        for constant in [0, 1] {
            let settled = walk::rebuild(&roots, graph, |name| {
                let symbol = graph.symbol(name);
                let is_idle = symbol.as_symbol().is_some_and(|symbol| idle.contains(&symbol));
                if is_idle { graph.integer(constant) } else { symbol }
            });
            let (before, after) = (Evaluator::new(&roots), Evaluator::new(&settled));
            let same = (0..STATES).all(|state| {
                let value = |symbol| value(&graph.symbol_name(symbol), state);
                same(&evaluate(&before, value), &evaluate(&after, value))
            });
            if same && !graph.is_full() {
                let mut settled = settled.into_iter();
                for entry in function.outputs.iter_mut().flat_map(|output| &mut output.values) {
                    *entry = settled.next().unwrap_or(*entry);
                }
                return function;
            }
        }
        function
    }

    /// The parameters that occur in the expressions but have no effect on their values.
    fn idle_parameters(&self, roots: &[Expr<'g>]) -> BTreeSet<SymbolId> {
        let graph = self.mechanism.graph;
        let symbol = |name: &str| graph.find_symbol(name).and_then(Expr::as_symbol);
        let names = self.robot.parameters.iter().map(|parameter| parameter.name.as_str());
        let parameters: BTreeSet<SymbolId> = names.filter_map(symbol).collect();
        let occurring: BTreeSet<SymbolId> =
            walk::symbols(roots).into_iter().filter(|one| parameters.contains(one)).collect();
        if occurring.is_empty() || graph.is_full() {
            return BTreeSet::new();
        }
        let flat = (0..STATES).fold(occurring, |left, state| {
            let slopes = slopes(roots, state);
            let is_flat = |one: &SymbolId| {
                slopes.get(one).is_some_and(|slope| slope.sum.abs() <= NOTICED * slope.size)
            };
            left.into_iter().filter(is_flat).collect()
        });
        let evaluator = Evaluator::new(roots);
        let value = |symbol, state| value(&graph.symbol_name(symbol), state);
        flat.into_iter().filter(|one| is_idle(&evaluator, *one, value)).collect()
    }
}

/// Whether no value depends on a parameter; `value` returns the value of a symbol in a state.
fn is_idle(
    evaluator: &Evaluator,
    parameter: SymbolId,
    value: impl Fn(SymbolId, u64) -> f64,
) -> bool {
    (0..STATES).all(|state| {
        let at = |factor: f64| {
            evaluate(evaluator, |symbol| {
                let value = value(symbol, state);
                if symbol == parameter { value * factor } else { value }
            })
        };
        let before = at(1.0);
        CHANGES.into_iter().all(|factor| same(&before, &at(factor)))
    })
}

fn same(a: &[f64], b: &[f64]) -> bool {
    let largest = a.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    a.iter().zip(b).all(|(a, b)| {
        let size = a.abs().max(b.abs());
        (a - b).abs() <= UNCHANGED * size || size <= ROUNDING * largest
    })
}

/// Evaluates expressions at arbitrary parameters, including those that no body can have: a negative pivot must be
/// evaluated, too, to find the parameters on which it depends.
///
/// Signs, hyperbolic tangents and absolute values are replaced by functions that are neither constant nor linear anywhere.
/// Otherwise, a parameter that acts in one direction only, such as the dry friction for negative velocities, would have no
/// effect in states of the other direction; tanh(x) is exactly 1 from x = 20 on.
fn evaluate(evaluator: &Evaluator, value: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    evaluator.values_by(value, |function, argument| match function {
        Elementary::RecipPositive => argument.recip(),
        Elementary::Sign => (2.0 * argument).asinh(),
        Elementary::Tanh => argument.asinh(),
        Elementary::Abs => argument.hypot(1.0),
        other => other.apply(argument),
    })
}

/// The value of a symbol in a seeded state.
fn value(name: &str, state: u64) -> f64 {
    Random::of_name(name, state).uniform(0.4, 1.6)
}

/// A sum together with the sum of its terms' magnitudes.
#[derive(Clone, Copy, Default)]
struct Slope {
    sum: f64,
    size: f64,
}

/// The derivatives of a weighted sum of the roots with respect to each symbol.
fn slopes(roots: &[Expr<'_>], state: u64) -> BTreeMap<SymbolId, Slope> {
    let nodes = walk::reachable(roots);
    let Some(graph) = nodes.first().map(|node| node.graph()) else {
        return BTreeMap::new();
    };
    let values =
        evaluate(&Evaluator::new(&nodes), |symbol| value(&graph.symbol_name(symbol), state));
    // All operands are contained in `nodes`.
    let place_of = |expr: Expr<'_>| {
        nodes.binary_search_by_key(&expr.id(), |node| node.id()).unwrap_or_default()
    };
    let at = |expr: Expr<'_>| values[place_of(expr)];
    let mut slopes = vec![Slope::default(); nodes.len()];
    let mut random = Random::new(state);
    for root in roots {
        let slope = &mut slopes[place_of(*root)];
        let weight = random.uniform(0.4, 1.6);
        slope.sum += weight;
        slope.size += weight;
    }
    let mut found = BTreeMap::new();
    for (place, node) in nodes.iter().enumerate().rev() {
        let Slope { sum, size } = slopes[place];
        let mut add = |operand: Expr<'_>, factor: f64| {
            let slope = &mut slopes[place_of(operand)];
            slope.sum += sum * factor;
            slope.size += size * factor.abs();
        };
        match node.view() {
            View::Number(_) | View::Pi => {}
            View::Symbol(symbol) => {
                found.insert(symbol, Slope { sum, size });
            }
            View::Add(a, b) => {
                add(a, 1.0);
                add(b, 1.0);
            }
            View::Sub(a, b) => {
                add(a, 1.0);
                add(b, -1.0);
            }
            View::Mul(a, b) => {
                add(a, at(b));
                add(b, at(a));
            }
            View::Div(a, b) => {
                add(a, 1.0 / at(b));
                add(b, -values[place] / at(b));
            }
            View::Neg(a) => add(a, -1.0),
            View::Call(function, a) => add(a, slope_of(function, at(a), values[place])),
        }
    }
    found
}

fn slope_of(function: Elementary, argument: f64, value: f64) -> f64 {
    match function {
        Elementary::Sin => argument.cos(),
        Elementary::Cos => -argument.sin(),
        Elementary::Sqrt => 0.5 / value,
        Elementary::Abs => argument / value,
        Elementary::Sign => argument.hypot(0.5).recip(),
        Elementary::Tanh => argument.hypot(1.0).recip(),
        Elementary::RecipPositive => -value * value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_symbolic::Graph;

    /// The slopes are those of differences, of every operation and function.
    #[test]
    fn slopes_are_those_of_differences() {
        let graph = Graph::new();
        let texts = [
            "a + b",
            "a - b",
            "b - a",
            "-a*b",
            "a*b*b",
            "a/b",
            "b/(a*a)",
            "(a + b)/(a + 3*b)",
            "sin(a*b)",
            "cos(a + 2*b)",
            "sqrt(a*b)",
            "abs(a - 5*b)",
            "abs(b*a)",
            "sign(a)*b",
            "tanh(a - b)",
        ];
        let mut roots: Vec<Expr<'_>> =
            texts.iter().map(|text| graph.parse(text).unwrap()).collect();
        let inverse = roots[0].apply(Elementary::RecipPositive);
        roots.push(inverse);
        let [a, b] = ["a", "b"].map(|name| graph.symbol(name).as_symbol().unwrap());
        for (place, root) in roots.iter().enumerate() {
            for state in 0..STATES {
                let found = slopes(&[*root], state);
                let weight = Random::new(state).uniform(0.4, 1.6);
                for symbol in [a, b] {
                    let moved = |by: f64| {
                        let at = |one: SymbolId| {
                            let value = value(&graph.symbol_name(one), state);
                            if one == symbol { value + by } else { value }
                        };
                        evaluate(&Evaluator::new(&[*root]), at)[0]
                    };
                    let expected = weight * (moved(1e-5) - moved(-1e-5)) / 2e-5;
                    let slope = found.get(&symbol).map_or(0.0, |slope| slope.sum);
                    let off = (slope - expected).abs();
                    assert!(off <= 1e-7 * expected.abs().max(1.0), "{place}: {slope} {expected}");
                }
            }
        }
    }

    /// What acts for one sign of a value only acts, whatever the sign in the seeded states.
    #[test]
    fn what_acts_on_one_side_is_not_idle() {
        let graph = Graph::new();
        for text in [
            "x + 0.5*k*(sign(x) - sign(x)^2)",
            "x + k*(sign(x) + sign(x)^2)",
            "x + k*(abs(x) - x)",
            "x + k*(abs(x) + x)",
            "x + k*(1 - sign(x))",
            "x + k*(tanh(100*x) - tanh(100*x)^2)",
            "x + k*(1 - tanh(100*x))",
        ] {
            let root = graph.parse(text).unwrap();
            let slope = slopes(&[root], 0)[&graph.symbol("k").as_symbol().unwrap()];
            assert!(slope.sum.abs() > NOTICED * slope.size, "{text}: {} {}", slope.sum, slope.size);
        }
    }

    /// A parameter that acts by its sign alone is not idle, though its slope is 0; one that does not act at all is.
    #[test]
    fn a_sign_is_not_idle() {
        let graph = Graph::new();
        let is_idle = |text: &str| {
            let evaluator = Evaluator::new(&[graph.parse(text).unwrap()]);
            let name = |symbol| graph.symbol_name(symbol);
            let parameter = graph.symbol("s").as_symbol().unwrap();
            is_idle(&evaluator, parameter, |symbol, state| value(&name(symbol), state))
        };
        for text in
            ["s/sqrt(s^2)", "x*sqrt(s^2)/s", "x + sqrt(s^2) - s", "sqrt(s^2 + 2*s + 1)/(s + 1)"]
        {
            assert!(!is_idle(text), "{text}");
        }
        for text in ["x + s - s", "(s*x)^2/sqrt(s^2)^2", "x*s/s"] {
            assert!(is_idle(text), "{text}");
        }
    }

    /// Terms that cancel have a slope that is small compared with them; a slope adds the terms of all roots.
    #[test]
    fn terms_that_cancel_have_a_size() {
        let graph = Graph::new();
        let slope = |texts: &[&str], name: &str| {
            let roots: Vec<Expr<'_>> =
                texts.iter().map(|text| graph.parse(text).unwrap()).collect();
            slopes(&roots, 1)[&graph.symbol(name).as_symbol().unwrap()]
        };
        let Slope { sum, size } = slope(&["a*(b + 1) - b*a"], "b");
        assert!(sum.abs() < 1e-15 && size > 0.3, "{sum} {size}");
        let Slope { sum, size } = slope(&["(a*b + c)/a - b"], "a");
        assert!(sum.abs() > 0.1 && size > sum.abs(), "{sum} {size}");
        let [first, both] = [&["3*a"][..], &["3*a", "3*a*1"][..]].map(|texts| slope(texts, "a"));
        assert!(both.sum > first.sum && (both.sum - both.size).abs() < 1e-15);
    }
}
