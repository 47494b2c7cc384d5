//! Both modes compared with each other, with single derivatives and with finite differences.

use super::{forward, reverse};
use crate::{Expr, Graph, walk};

/// The value of an expression for values of the symbols x, y and z, in the order of their first use.
fn at(expr: Expr<'_>, values: [f64; 3]) -> f64 {
    expr.evaluate(|symbol| values[symbol.index()])
}

fn functions(g: &Graph) -> ([Expr<'_>; 3], Vec<Expr<'_>>) {
    let (x, y, z) = (g.symbol("x"), g.symbol("y"), g.symbol("z"));
    let shared = (x * y).sin() - z / (x + 2);
    let roots = vec![
        shared * shared + x,
        (y * y + 1).sqrt() * shared.cos() - (x - z).tanh(),
        (x - 3).abs() * (z - 5).sign() + y / (shared + 4),
        g.integer(7),
        -x,
    ];
    ([x, y, z], roots)
}

#[test]
fn both_ways_agree_with_differences() {
    let g = Graph::new();
    let (symbols, roots) = functions(&g);
    let point = [0.7, 1.9, -0.4];
    let step = 1e-5;
    for matrix in [forward(&roots, &symbols), reverse(&roots, &symbols)] {
        assert_eq!(matrix.len(), roots.len());
        for (row, root) in matrix.iter().zip(&roots) {
            for (column, slope) in row.iter().enumerate() {
                let moved = |by: f64| {
                    let mut point = point;
                    point[column] += by;
                    at(*root, point)
                };
                let difference = (moved(step) - moved(-step)) / (2.0 * step);
                let found = at(*slope, point);
                assert!((found - difference).abs() < 1e-9, "{found} {difference}");
            }
        }
    }
}

#[test]
fn forward_is_the_single_derivative_column_by_column() {
    let g = Graph::new();
    let (symbols, roots) = functions(&g);
    let matrix = forward(&roots, &symbols);
    for (column, symbol) in symbols.into_iter().enumerate() {
        let single = walk::derivatives(&roots, symbol);
        for (row, expected) in matrix.iter().zip(single) {
            let point = [1.3, 0.2, 0.8];
            assert!((at(row[column], point) - at(expected, point)).abs() < 1e-14);
        }
    }
}

#[test]
fn symbols_that_are_not_there_have_no_slope() {
    let g = Graph::new();
    let (x, w) = (g.symbol("x"), g.symbol("w"));
    for matrix in [forward(&[x * x], &[w, x]), reverse(&[x * x], &[w, x])] {
        assert_eq!(matrix, [[g.zero(), x * 2]]);
    }
    assert!(reverse(&[], &[x]).is_empty() && forward(&[], &[x]).is_empty());
}

#[test]
fn a_deep_expression_causes_no_deep_recursion() {
    let g = Graph::new();
    let x = g.symbol("x");
    let deep = (0..50_000).fold(x, |sum, _| (sum * x) + x);
    let by_forward = forward(&[deep], &[x])[0][0].evaluate(|_| 0.5);
    let by_reverse = reverse(&[deep], &[x])[0][0].evaluate(|_| 0.5);
    assert!((by_forward - by_reverse).abs() < 1e-12);
}
