//! Random expressions for the property tests.

use crate::expr::Expr;
use crate::graph::{Function, Graph};
pub(crate) use crate::random::Random;
use crate::rational::Rational;

/// The ingredients of random expressions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Sums, products, sines and cosines of integer combinations of angles.
    Trigonometric,
    /// The same, and quotients, roots, absolute values, signs and hyperbolic tangents.
    Any,
}

pub(crate) const SYMBOLS: [&str; 6] = ["x", "y", "l_1", "q1", "q2", "q3"];

/// A random expression from `size` random operations, some of which share operands.
pub(crate) fn expression<'g>(
    graph: &'g Graph,
    random: &mut Random,
    kind: Kind,
    size: usize,
) -> Expr<'g> {
    let mut parts: Vec<Expr<'g>> = SYMBOLS.iter().map(|name| graph.symbol(name)).collect();
    for _ in 0..size {
        let a = parts[parts.len() - 1 - random.index(parts.len().min(4))];
        let b = parts[random.index(parts.len())];
        let part = match random.index(12) {
            0 | 1 => a + b,
            2 => a - b,
            3 | 4 => a * b,
            5 => -a,
            6 => a * graph.number(constant(random)) + b,
            7 | 8 => {
                let angle = angle(graph, random);
                if random.index(2) == 0 { angle.sin() } else { angle.cos() }
            }
            9 => a + graph.number(constant(random)),
            _ if kind == Kind::Trigonometric => a * b - a,
            10 => a / (b * b + 1),
            _ => a.apply(Function::ALL[2 + random.index(4)]) * b,
        };
        parts.push(part);
    }
    parts[parts.len() - 1]
}

/// An integer combination of the angles and quarter turns.
pub(crate) fn angle<'g>(graph: &'g Graph, random: &mut Random) -> Expr<'g> {
    let mut sum = graph.pi() * random.index(4) as i64 / 2;
    for name in ["q1", "q2", "q3"] {
        sum += graph.symbol(name) * (random.index(5) as i64 - 2);
    }
    sum
}

fn constant(random: &mut Random) -> Rational {
    let numerator = random.index(41) as i64 - 20;
    let denominator = [1, 1, 2, 3, 10, 100, 7][random.index(7)];
    Rational::new(numerator, denominator).unwrap()
}

/// Random values for `count` symbols, in the order of their ids.
pub(crate) fn point(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.uniform(-1.5, 1.5)).collect()
}
