use super::*;
use crate::random_expressions::{self as random, Kind, Random};
use crate::{Graph, Rational};

fn of<'g>(graph: &'g Graph, text: &str) -> Polynomial<'g> {
    Polynomial::of(graph.parse(text).unwrap(), &PolynomialOptions::default()).unwrap()
}

fn keeping<'g>(graph: &'g Graph, text: &str) -> Polynomial<'g> {
    let options = PolynomialOptions::keeping_angle_sums();
    Polynomial::of(graph.parse(text).unwrap(), &options).unwrap()
}

#[test]
fn equal_polynomials_have_equal_terms() {
    let g = Graph::new();
    for (a, b) in [
        ("(x + y)^3", "x^3 + 3*x^2*y + 3*x*y^2 + y^3"),
        ("(x - y)*(x + y)", "x*x - y*y"),
        ("sin(a)^2", "1 - cos(a)^2"),
        ("sin(a)^5", "sin(a)*(1 - cos(a)^2)^2"),
        ("sin(a + b)", "sin(a)*cos(b) + cos(a)*sin(b)"),
        ("cos(a - b)", "cos(b - a)"),
        ("sin(a - b)", "-sin(b - a)"),
        ("sin(2*a)", "2*sin(a)*cos(a)"),
        ("cos(3*a)", "4*cos(a)^3 - 3*cos(a)"),
        ("sin(-5*a + 2*b)", "-sin(5*a - 2*b)"),
        ("sin(a + pi/2 - b)", "cos(b - a)"),
        ("cos(a + 3*pi/2)", "sin(a)"),
        ("sin(2*(a + pi/2))", "-2*sin(a)*cos(a)"),
        ("cos(3*(pi/2 - a))", "4*sin(a)^3 - 3*sin(a)"),
        ("cos(x*(y + pi/x))", "-cos(x*y)"),
        ("sin(a + pi/6)", "sqrt(3)/2*sin(a) + cos(a)/2"),
        ("sin(a + pi/4)^2", "1/2 + sin(a)*cos(a)"),
        ("sin(a + b)^2 + cos(b + a)^2", "1"),
        ("sin(x*(y + z))", "sin(x*z + y*x)"),
        ("(x/y)^2*y", "x^2/y"),
        ("(a + b)/x - a/x", "b/x"),
        ("1/(2*x + 2*y)", "1/(y + x)/2"),
        ("x/(x*y + x*z)", "1/(z + y)"),
        ("1/(x - y) + 1/(y - x)", "0"),
        ("1/(1/(x + y))", "x + y"),
        ("1/(x/(x + y))", "1 + y/x"),
        ("1/(x + y)^2", "1/(y + x)*1/(2*x + 2*y)*2"),
        ("1/(x + 1/(y + z))", "(y + z)/(1 + x*z + x*y)"),
        ("1/(x/(y + z) + z/(y + z)^2)", "(y + z)^2/(x*y + x*z + z)"),
        ("sqrt(x)*sqrt(x)", "x"),
        ("sqrt(x + y)^3", "x*sqrt(y + x) + y*sqrt(x + y)"),
        ("1/sqrt(2)", "sqrt(2)/2"),
        ("1/sqrt(x)", "sqrt(x)/x"),
        ("1/sqrt(1 + x^2)^2", "1/(1 + x^2)"),
        ("x^2/sqrt(1 + x^2)^2 + 1/sqrt(1 + x^2)^2", "1"),
        ("y/sqrt(x + y)^3", "y/((x + y)*sqrt(x + y))"),
        ("(y/sqrt(x + y))^4", "y^4/(x + y)^2"),
        ("x/sqrt(x + y)/sqrt(x + z)/sqrt(x + y)/sqrt(x + z)", "x/((x + y)*(x + z))"),
        ("sqrt(sqrt(x))^4", "x"),
        ("sqrt(x^2/sqrt(1 + x^2)^2 + 1/sqrt(1 + x^2)^2)", "1"),
        ("abs(x)^2", "x^2"),
        ("abs(y - x)", "abs(x - y)"),
        ("abs(2*x - 2*y)", "2*abs(x - y)"),
        ("sign(y - x)", "-sign(3*x - 3*y)"),
        ("tanh((x - y)*2)", "-tanh(2*y - 2*x)"),
        ("tan(a)*cos(a)", "sin(a)"),
        ("sin(0.3 + x - x)", "sin(0.3)"),
        ("0.1*x + 0.2*x", "0.3*x"),
    ] {
        assert_eq!(of(&g, a), of(&g, b), "{a} and {b}");
    }
}

#[test]
fn kept_angle_sums_are_atoms() {
    let g = Graph::new();
    assert_eq!(keeping(&g, "sin(a + b)").len(), 1);
    assert_eq!(keeping(&g, "sin(b + a) - sin(a + b)").len(), 0);
    assert_eq!(keeping(&g, "sin(a - b) + sin(b - a)").len(), 0);
    let squares = keeping(&g, "sin(a + b)^2 + cos(a + b)^2 + sin(2*a)^2 + cos(2*a)^2");
    assert_eq!(squares.as_number(), Some(Number::integer(2)));
    assert_eq!(keeping(&g, "cos(x + a + pi/2)"), keeping(&g, "-sin(a + x)"));
    assert_ne!(keeping(&g, "sin(2*a)"), keeping(&g, "2*sin(a)*cos(a)"));
}

#[test]
fn different_polynomials_differ() {
    let g = Graph::new();
    for (a, b) in [
        ("sin(a)", "cos(a)"),
        ("x^2", "x^3"),
        ("sin(a)^2", "1 + cos(a)^2"),
        ("1/x", "x"),
        ("sin(33*a)", "sin(31*a)"),
    ] {
        assert_ne!(of(&g, a), of(&g, b), "{a} and {b}");
    }
}

#[test]
fn division_by_zero_gives_nan() {
    let g = Graph::new();
    let value = of(&g, "1/(x*y - y*x + (x + y)^2 - x^2 - 2*x*y - y^2)");
    assert!(value.as_number().unwrap().to_f64().is_nan());
}

#[test]
fn limits_end_hostile_expansions() {
    let g = Graph::new();
    let expr = |text: &str| g.parse(text).unwrap();
    let options =
        PolynomialOptions { max_terms: 1000, max_products: 50_000, ..PolynomialOptions::default() };
    let error = |text: &str| Polynomial::of(expr(text), &options).unwrap_err();
    assert_eq!(error("(a + b + c + d + e)^12"), PolynomialError::TooManyTerms { limit: 1000 });
    assert_eq!(
        error("((1 + x)^64)^7 - ((1 + x)^64)^7*(1 + x)"),
        PolynomialError::TooManyProducts { limit: 50_000 }
    );
    assert_eq!(
        error("sin(a+b+c+d+e+f+g+h+i+j+k+l+m+n+o)"),
        PolynomialError::TooManyTerms { limit: 1000 }
    );
    // These are a third of a million products, but with coefficients of up to a thousand bits.
    let options = PolynomialOptions { max_products: 1_000_000, ..options };
    assert_eq!(
        Polynomial::of(expr("((1 + x)^64)^15"), &options),
        Err(PolynomialError::TooManyProducts { limit: 1_000_000 })
    );
    let power = (0..6).fold(g.symbol("x"), |power, _| power.powi(64));
    assert_eq!(Polynomial::of(power, &options), Err(PolynomialError::ExponentTooLarge));
}

#[test]
fn depth_causes_no_recursion() {
    let g = Graph::new();
    let (x, y) = (g.symbol("x"), g.symbol("y"));
    let deep = (0..50_000).fold(x, |sum, k| if k % 2 == 0 { sum + y } else { sum - x * y });
    let options = PolynomialOptions::default();
    assert_eq!(Polynomial::of(deep, &options).unwrap().len(), 3);
    let roots = (0..2_000).fold(x, |root, _| root.sqrt());
    let inverse = Polynomial::of(g.one() / roots, &options).unwrap();
    assert_eq!(inverse.len(), 1);
}

#[test]
fn polynomials_keep_values() {
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 14);
        let point = random::point(&mut random, graph.symbol_count());
        let exact = expr.evaluate(|symbol| point[symbol.index()]);
        for options in [PolynomialOptions::default(), PolynomialOptions::keeping_angle_sums()] {
            let Ok(polynomial) = Polynomial::of(expr, &options) else {
                continue;
            };
            let scale: f64 = polynomial.magnitude(&point).max(1.0);
            for value in [
                polynomial.evaluate(|symbol| point[symbol.index()]),
                polynomial.to_expr().evaluate(|symbol| point[symbol.index()]),
            ] {
                let close = (value - exact).abs() <= 1e-11 * scale;
                assert!(close || exact.is_nan(), "seed {seed}: {value} {exact}");
            }
        }
    }
}

#[test]
fn rebuilding_changes_no_term() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 12);
        for options in [PolynomialOptions::default(), PolynomialOptions::keeping_angle_sums()] {
            let polynomial = Polynomial::of(expr, &options).unwrap();
            let again = Polynomial::of(polynomial.to_expr(), &options).unwrap();
            assert!(polynomial == again, "seed {seed}");
        }
    }
}

/// The canonical form decides equality: a difference expands to zero exactly if it vanishes at
/// random points.
#[test]
fn zero_is_found_exactly_if_values_vanish() {
    let mut zeros = 0;
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let a = random::expression(&graph, &mut random, Kind::Trigonometric, 8);
        let kept = Polynomial::of(a, &PolynomialOptions::keeping_angle_sums()).unwrap();
        let mut b = kept.to_expr();
        if random.index(2) == 0 {
            // sin(u + v) − sin u cos v is cos u sin v, but twice that is not.
            let (u, v) = (random::angle(&graph, &mut random), random::angle(&graph, &mut random));
            let factor = 1 + random.index(2) as i64;
            b += (u + v).sin() - u.sin() * v.cos() - u.cos() * v.sin() * factor;
        }
        let zero = expands_to_zero(a - b).unwrap();
        zeros += usize::from(zero);
        let vanishes = (0..3).all(|_| {
            let point = random::point(&mut random, graph.symbol_count());
            let value = (a - b).evaluate(|symbol| point[symbol.index()]);
            value.abs() <= 1e-9 * kept.magnitude(&point).max(1.0)
        });
        assert_eq!(zero, vanishes, "seed {seed}");
    }
    assert!((200..390).contains(&zeros), "{zeros}");
}

#[test]
fn arithmetic_is_that_of_expressions() {
    for seed in 0..150 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let a = random::expression(&graph, &mut random, Kind::Any, 7);
        let b = random::expression(&graph, &mut random, Kind::Any, 7);
        let options = PolynomialOptions::default();
        let of = |expr| Polynomial::of(expr, &options).unwrap();
        let (p, q) = (of(a), of(b));
        assert_eq!(p.add(&q).unwrap(), of(a + b), "seed {seed}");
        assert_eq!(p.sub(&q).unwrap(), of(a - b), "seed {seed}");
        assert_eq!(p.mul(&q).unwrap(), of(a * b), "seed {seed}");
        assert_eq!(p.neg(), of(-a), "seed {seed}");
        let third = Number::from(Rational::new(1, 3).unwrap());
        assert_eq!(p.scale(&third), of(a / 3), "seed {seed}");
        assert!(p.sub(&p).unwrap().is_zero(), "seed {seed}");
    }
}

#[test]
fn derivatives_agree_with_those_of_expressions() {
    for seed in 0..150 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Trigonometric, 10);
        let options = PolynomialOptions::default();
        for name in ["x", "q1"] {
            let symbol = graph.symbol(name);
            let slope = Polynomial::of(expr.derivative(symbol), &options).unwrap();
            let polynomial = Polynomial::of(expr, &options).unwrap();
            let of_terms = polynomial.derivative(symbol).unwrap();
            assert_eq!(slope, of_terms, "seed {seed}");
        }
    }
}

#[test]
fn collected_groups_add_up() {
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let expr = random::expression(&graph, &mut random, Kind::Any, 12);
        let polynomial = Polynomial::of(expr, &PolynomialOptions::default()).unwrap();
        let groups = polynomial.collect(&["x", "q1", "absent"]);
        let chosen = ["x", "q1"].map(|name| graph.symbol(name).id());
        let mut sum = Polynomial::zero(&graph, &PolynomialOptions::default());
        for (monomial, coefficient) in &groups {
            let factors = monomial.factors();
            assert!(factors.iter().all(|factor| chosen.contains(&factor.atom())));
            assert!(coefficient.terms().all(|(rest, _)| {
                rest.exponent(chosen[0]) == 0 && rest.exponent(chosen[1]) == 0
            }));
            let group = coefficient.mul(&polynomial.of_monomial(monomial)).unwrap();
            sum = sum.add(&group).unwrap();
        }
        assert_eq!(sum, polynomial, "seed {seed}");
        assert!(groups.is_sorted_by(|(a, _), (b, _)| a < b), "seed {seed}");
    }
}

#[test]
fn collection_separates_accelerations() {
    let g = Graph::new();
    let torque = of(&g, "(m*l^2 + J)*qdd1 + m*l*sin(q1)*(g - l*qd2^2) + b*qd1*qd2");
    let groups = torque.collect(&["qdd1", "qd1", "qd2", "g"]);
    let texts: Vec<_> = groups.iter().map(|(_, group)| group.len()).collect();
    assert_eq!(texts, [2, 1, 1, 1]);
    assert_eq!(groups[0].1, of(&g, "m*l^2 + J"));
}

impl Polynomial<'_> {
    /// The sum of the absolute values of the terms, which bounds rounding errors.
    fn magnitude(&self, point: &[f64]) -> f64 {
        let single = |term: &Term| self.with_terms(vec![term.clone()]);
        let value = |term| single(term).evaluate(|symbol| point[symbol.index()]);
        self.terms.iter().map(|term| value(term).abs()).sum()
    }
}

#[test]
fn packed_and_unpacked_products_agree() {
    let (mut packed, mut squares) = (0, 0);
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let graph = Graph::new();
        let options = PolynomialOptions::default();
        let mut of = |kind| {
            let expr = random::expression(&graph, &mut random, kind, 10);
            Polynomial::of(expr, &options).unwrap()
        };
        let factors = [Kind::Trigonometric, Kind::Any, Kind::Trigonometric].map(&mut of);
        let [a, b, c] = &factors;
        let part = |a: &'_ Polynomial<'_>, b: Option<&Polynomial<'_>>| {
            (a.terms.clone(), b.map(|b| b.terms.clone()))
        };
        let owned = [part(a, Some(b)), part(a, Some(c)), part(c, Some(c)), part(b, None)];
        let factor = Number::from(Rational::new(-2, 3).unwrap());
        let parts: Vec<Part<'_>> =
            owned.iter().map(|(a, b)| Part { a, b: b.as_deref(), factor: &factor }).collect();
        let mut budget = Budget::new(&options);
        let unpacked = accumulator::sum_unpacked(&graph, &mut budget, &parts).unwrap();
        if let Some(layout) = packed::Layout::new(&graph, &parts) {
            packed += 1;
            squares += layout.sine_count();
            assert_eq!(layout.sum(&parts, &mut budget).unwrap(), unpacked, "seed {seed}");
        }
    }
    assert!(packed > 100 && squares > 100, "{packed} {squares}");
}

/// The inertia about the joint of two bodies that are given by the center of mass of both has no denominator.
#[test]
fn sums_of_symbols_cancel_with_denominators() {
    let graph = Graph::new();
    let of = |text: &str| {
        let options = PolynomialOptions::default();
        Polynomial::of(graph.parse(text).unwrap(), &options).unwrap()
    };
    let center = "(2*a + 3*b)/(a + b)";
    let about = |center: &str| {
        format!("x*(a*(2 - {center})^2 + b*(3 - {center})^2 + (a + b)*({center})^2)")
    };
    assert_eq!(of(&about(center)), of("x*(4*a + 9*b)"));
    // One body more, whose mass comes last.
    let both = format!("((a + b)*({center}) + 5*c)/(a + b + c)");
    let sum =
        format!("(a + b)*(({center}) - ({both}))^2 + c*(5 - ({both}))^2 + (a + b + c)*({both})^2");
    let whole = format!("{sum} + a*(2 - {center})^2 + b*(3 - {center})^2");
    assert_eq!(of(&whole), of("4*a + 9*b + 25*c"));
    // Without a shorter form, fractions stay.
    assert_eq!(of("a*b/(a + b)").len(), 1);
    assert_eq!(of("x*a/(a + b) + y*b/(a + b)").len(), 2);
}
