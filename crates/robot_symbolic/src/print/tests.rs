use super::*;
use crate::random_expressions::{self as random, Kind, Random};
use crate::{Graph, Number, Polynomial, PolynomialOptions};

fn text(graph: &Graph, source: &str) -> String {
    to_text(graph.parse(source).unwrap()).unwrap()
}

#[test]
fn parentheses_are_few() {
    let g = Graph::new();
    for source in [
        "a + b - c",
        "a - (b + c)",
        "a + b*c",
        "(a + b)*c",
        "a*b*c",
        "a*b/c",
        "a/(b*c)",
        "a/b/c",
        "a/(b/c)",
        "a^2",
        "(a + b)^3",
        "(a*b)^2",
        "a^64",
        "a*a^7",
        "a^3*a^3",
        "1/a^2",
        "sin(a + b)^2",
        "-a*b",
        "-(a + b)",
        "b/3",
        "2/3*a",
        "0.35*a",
        "sqrt(-a)",
        "a + 1",
        "a*pi",
    ] {
        assert_eq!(text(&g, source), source);
    }
    assert_eq!(text(&g, "(a + b) + c"), "a + b + c");
    assert_eq!(text(&g, "c + (a + b)"), "a + b + c");
    assert_eq!(text(&g, "b - a"), "b - a");
}

/// Parsing the text in the same graph gives the same node.
#[test]
fn the_text_of_an_expression_reads_back() {
    for seed in 0..1000 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 20);
        let text = to_text(expr).unwrap();
        if let Ok(again) = graph.parse(&text) {
            assert_eq!(to_text(again).unwrap(), text, "seed {seed}");
            assert_eq!(again, expr, "seed {seed}: {text}");
        } else {
            assert!(text.len() > 100_000, "seed {seed}: {text}");
        }
    }
}

#[test]
fn the_text_of_a_polynomial_reads_back() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 12);
        for options in [PolynomialOptions::default(), PolynomialOptions::keeping_angle_sums()] {
            let polynomial = Polynomial::of(expr, &options).unwrap();
            let text = polynomial.to_text().unwrap();
            let backwards = |atom: Expr<'_>| std::cmp::Reverse(atom.id());
            let reversed = polynomial.to_text_by(backwards).unwrap();
            for text in [text, reversed] {
                match graph.parse(&text) {
                    Ok(again) => {
                        let again = Polynomial::of(again, &options).unwrap();
                        assert!(again == polynomial, "seed {seed}: {text}");
                    }
                    Err(error) => assert!(text.len() > 100_000, "seed {seed}: {error}"),
                }
            }
        }
    }
}

#[test]
fn polynomials_are_arranged_as_asked() {
    let g = Graph::new();
    let expr = g.parse("q4*(M5*sin(q2)*qdd1 - 2*M4*qd2^2) + 1/x - 2/(x*y^2) - 3").unwrap();
    let polynomial = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
    assert_eq!(
        polynomial.to_text().unwrap(),
        "q4*M5*qdd1*sin(q2) - 2*q4*M4*qd2^2 - 3 + 1/x - 2/(x*y^2)"
    );
    let sines_first = |atom: Expr<'_>| u8::from(atom.as_symbol().is_some());
    assert_eq!(
        polynomial.to_text_by(sines_first).unwrap(),
        "sin(q2)*q4*M5*qdd1 - 2*q4*M4*qd2^2 - 3 + 1/x - 2/(x*y^2)"
    );
    let zero = Polynomial::zero(&g, &PolynomialOptions::default());
    assert_eq!(zero.to_text().unwrap(), "0");
}

#[test]
fn large_powers_read_back() {
    let g = Graph::new();
    let power = g.symbol("x").powi(150);
    let options = PolynomialOptions::default();
    let polynomial = Polynomial::of(power, &options).unwrap();
    let text = polynomial.to_text().unwrap();
    assert_eq!(text, "x^64*x^64*x^22");
    assert!(Polynomial::of(g.parse(&text).unwrap(), &options).unwrap() == polynomial);
}

#[test]
fn floating_point_constants_print_shortest() {
    let g = Graph::new();
    let real = |value: f64| to_text(g.number(Number::real(value)) * g.symbol("x")).unwrap();
    assert_eq!(real(0.1), "0.1*x");
    assert_eq!(real(-1e-300), "-1e-300*x");
    assert_eq!(real(1.0 / 3.0), "0.3333333333333333*x");
    let nothing = g.parse(&real(f64::NAN)).unwrap();
    assert!(nothing.evaluate(|_| 1.0).is_nan());
}

#[test]
fn shared_parts_do_not_fill_the_memory() {
    let g = Graph::new();
    let (x, y) = (g.symbol("x"), g.symbol("y"));
    let doubled = (0..200).fold(x, |sum, _| (sum + y) * sum);
    let error = to_text(doubled).unwrap_err();
    assert_eq!(error, TooLarge { operations: u64::MAX, limit: MAX_OPERATIONS });
    let deep = (0..100_000).fold(x, |sum, _| (sum + y).sin());
    assert_eq!(to_text(deep).unwrap().matches("sin(").count(), 100_000);
    assert!(to_text_limited(x + y, 2).is_err());
}
