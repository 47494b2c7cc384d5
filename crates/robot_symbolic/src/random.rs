//! Seeded random expressions for the property tests.

use crate::expr::Expr;
use crate::graph::{Function, Graph};
use crate::rational::Rational;

/// `SplitMix64` (Steele, Lea, Flood 2014): small, seeded, the same everywhere.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// An integer from 0 to `bound` − 1.
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// A number in [low, high).
    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }
}

/// What random expressions are made of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Sums, products, sines and cosines of integer combinations of angles.
    Trigonometric,
    /// These, and quotients, roots, absolute values, signs, hyperbolic tangents.
    Any,
}

pub(crate) const SYMBOLS: [&str; 6] = ["x", "y", "l_1", "q1", "q2", "q3"];

/// A random expression of `size` operations; parts are shared now and then.
pub(crate) fn expression<'g>(
    graph: &'g Graph,
    random: &mut Random,
    kind: Kind,
    size: usize,
) -> Expr<'g> {
    let mut parts: Vec<Expr<'g>> = SYMBOLS.iter().map(|name| graph.symbol(name)).collect();
    for _ in 0..size {
        let a = parts[parts.len() - 1 - random.below(parts.len().min(4))];
        let b = parts[random.below(parts.len())];
        let part = match random.below(12) {
            0 | 1 => a + b,
            2 => a - b,
            3 | 4 => a * b,
            5 => -a,
            6 => a * graph.number(constant(random)) + b,
            7 | 8 => {
                let angle = angle(graph, random);
                if random.below(2) == 0 { angle.sin() } else { angle.cos() }
            }
            9 => a + graph.number(constant(random)),
            _ if kind == Kind::Trigonometric => a * b - a,
            10 => a / (b * b + 1),
            _ => a.apply(Function::ALL[2 + random.below(4)]) * b,
        };
        parts.push(part);
    }
    parts[parts.len() - 1]
}

/// An integer combination of the angles with quarter turns.
pub(crate) fn angle<'g>(graph: &'g Graph, random: &mut Random) -> Expr<'g> {
    let mut sum = graph.pi() * random.below(4) as i64 / 2;
    for name in ["q1", "q2", "q3"] {
        sum += graph.symbol(name) * (random.below(5) as i64 - 2);
    }
    sum
}

fn constant(random: &mut Random) -> Rational {
    let numerator = random.below(41) as i64 - 20;
    let denominator = [1, 1, 2, 3, 10, 100, 7][random.below(7)];
    Rational::new(numerator, denominator).unwrap()
}

/// Values of the symbols, by their order in the graph.
pub(crate) fn point(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.uniform(-1.5, 1.5)).collect()
}
