//! Benchmarks of canonical polynomials: `cargo bench -p robot_symbolic`.

use std::time::Instant;

use robot_symbolic::{Expr, Graph, Polynomial, PolynomialOptions};

/// A sum of `terms` products of symbols, sines and cosines, like those in equations of motion.
fn equation<'g>(graph: &'g Graph, terms: usize, stride: usize) -> Expr<'g> {
    let mass = |k: usize| graph.symbol(&format!("M{}", k % 7));
    let length = |k: usize| graph.symbol(&format!("l{}", k % 11));
    let rate = |k: usize| graph.symbol(&format!("qd{}", k % 6));
    let angle = |k: usize| graph.symbol(&format!("q{}", k % 6));
    (0..terms).fold(graph.zero(), |sum, k| {
        let k = k * stride;
        let trigonometry = angle(k).sin() * angle(k / 6).cos() * angle(k / 36).cos();
        let product = mass(k) * length(k / 7) * length(k / 49) * rate(k / 5) * trigonometry;
        sum + product * (1 + k as i64 % 5)
    })
}

/// `(1 + x + y + z + t)^power`: products of its terms give few different monomials.
fn dense(graph: &Graph, power: i32) -> Expr<'_> {
    let symbols = ["x", "y", "z", "t"].map(|name| graph.symbol(name));
    let sum = symbols.into_iter().fold(graph.one(), |sum, x| sum + x);
    sum.powi(power)
}

/// Prints the best rate of five multiplications.
fn report(name: &str, a: &Polynomial<'_>, b: &Polynomial<'_>) {
    let products = a.len() * b.len();
    let (mut rate, mut length) = (0.0_f64, 0);
    for _ in 0..5 + 2_000_000 / products.max(100_000) {
        let start = Instant::now();
        length = a.mul(b).map_or(0, |product| product.len());
        rate = rate.max(products as f64 / start.elapsed().as_secs_f64());
    }
    println!(
        "{name:<10} {:>6} x {:>6} = {length:>9} terms, {rate:>10.3e} products/s",
        a.len(),
        b.len()
    );
}

fn main() {
    let graph = Graph::new();
    let options = PolynomialOptions::default();
    let of = |expr| Polynomial::of(expr, &options);
    for (m, n) in [(30, 30), (300, 300), (1000, 1000)] {
        if let (Ok(a), Ok(b)) = (of(equation(&graph, m, 1)), of(equation(&graph, n, 17))) {
            report("equations", &a, &b);
        }
    }
    for power in [6, 12] {
        if let Ok(a) = of(dense(&graph, power)) {
            report("dense", &a, &a);
        }
    }
}
