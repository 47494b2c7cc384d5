//! Short forms of small polynomials, and random polynomials, whose short forms are proved equal to them.

use crate::collected::{Collector, ParallelAngles, Turn};
use crate::print::{arranged_text, default_rank};
use crate::{Graph, Polynomial, PolynomialOptions};

/// The short form of a text, with parallel joints `q1`, `q2`, … in a chain.
fn collected(source: &str, joints: usize) -> String {
    written(source, joints, false)
}

fn written(source: &str, joints: usize, double_angles: bool) -> String {
    let graph = Graph::new();
    let turns = (0..joints).map(|joint| Turn {
        coordinate: graph.symbol(&format!("q{}", joint + 1)),
        negative: false,
        parent: joint.checked_sub(1),
    });
    let angles = [ParallelAngles { turns: turns.collect() }];
    let value = graph.parse(source).unwrap();
    let polynomial = Polynomial::of(value, &PolynomialOptions::default()).unwrap();
    let collector = Collector { angles: &angles, factors: true, double_angles };
    let terms = collector.collect(&polynomial, default_rank, &1);
    arranged_text(&terms).unwrap()
}

#[test]
fn double_angles_are_written_if_they_are_asked_for() {
    for (source, expected) in [
        ("2*sin(q1)*cos(q1)", "sin(2*q1)"),
        ("a*sin(q1)*cos(q1) - b*sin(q1)*cos(q1)", "0.5*(a - b)*sin(2*q1)"),
        ("-3*x*sin(q1)*cos(q1)", "-1.5*x*sin(2*q1)"),
        ("a - 2*a*cos(q1)^2", "-a*cos(2*q1)"),
        ("a*b - 2*a*b*sin(q1)^2 + c", "a*b*cos(2*q1) + c"),
        ("(1 - 2*sin(q1)^2)*(a + x)", "(a + x)*cos(2*q1)"),
        ("a - 3*a*sin(q1)^2", "a*(3*cos(q1)^2 - 2)"),
        ("sin(q1)^2*cos(q1)", "sin(q1)^2*cos(q1)"),
        ("sin(q1 + q2)*cos(q1 + q2)", "0.5*sin(2*(q1 + q2))"),
        ("sin(q1)*cos(q2)", "sin(q1)*cos(q2)"),
        ("4*a*sin(q1)^2*cos(q1)^2", "a*sin(2*q1)^2"),
        ("a*(b - 2*sin(q1)*cos(q1)) + c", "a*(b - sin(2*q1)) + c"),
        // The polynomials do not expand the sines of multiples that are not integers.
        ("2*a*sin(1.3*x)*cos(1.3*x) + 2*b*sin(1.3*x)*cos(1.3*x)", "(a + b)*sin(2.6*x)"),
        ("4*a*sin(1.3*x)*cos(1.3*x)*(1 - 2*sin(1.3*x)^2)", "a*sin(5.2*x)"),
        ("a - 2*a*sin(1.3*x)^2 + sin(2.6*x)", "a*cos(2.6*x) + sin(2.6*x)"),
    ] {
        assert_eq!(written(source, 2, true), expected, "{source}");
    }
    assert_eq!(written("2*sin(q1)*cos(q1)", 2, false), "2*sin(q1)*cos(q1)");
}

#[test]
fn common_factors_leave_brackets() {
    for (source, expected) in [
        ("a*b + a*c", "a*(b + c)"),
        ("a*c + a*d + b*c + b*d", "(a + b)*(c + d)"),
        ("M*(l + q)^2 + N*(l + k + q)^2", "M*(l + q)^2 + N*(l + q + k)^2"),
        ("a - a*cos(q9)^2", "a*sin(q9)^2"),
        ("a - b", "a - b"),
        ("-a*x - b*x", "-x*(a + b)"),
        ("2*a*b + 2*a*c", "2*a*(b + c)"),
        ("k*c*d - k*a*b", "k*(c*d - a*b)"),
        ("-k*a*b + k*c*d - a*x", "k*c*d - a*(k*b + x)"),
        ("0", "0"),
    ] {
        assert_eq!(collected(source, 0), expected, "{source}");
    }
}

#[test]
fn sums_of_angles_act() {
    for (source, expected) in [
        ("m*sin(q1 + q2) + m*l*cos(q2)", "m*(l*cos(q2) + sin(q1 + q2))"),
        ("cos(q1)*cos(q2 + q1) + sin(q1)*sin(q1 + q2)", "cos(q2)"),
        ("sin(q2)*cos(q1 + q2) - cos(q2)*sin(q1 + q2)", "-sin(q1)"),
    ] {
        assert_eq!(collected(source, 2), expected, "{source}");
    }
    let product = "(a*sin(q1) + b*sin(q1 + q2))*(a*cos(q1) + b*cos(q1 + q2))";
    assert_eq!(collected(product, 2), product);
    assert_eq!(
        collected("a*cos(q1 + q2 + q3) - b*sin(q2 + q3)", 3),
        "a*cos(q1 + q2 + q3) - b*sin(q2 + q3)"
    );
}

#[test]
fn coefficients_of_sines_are_in_brackets() {
    assert_eq!(
        collected("-2*l1*(m2*r2*sin(q2) + m3*l2*sin(q2) + m3*r3*sin(q2 + q3))", 3),
        "-2*l1*((m2*r2 + m3*l2)*sin(q2) + m3*r3*sin(q2 + q3))"
    );
}

#[test]
fn a_factor_of_a_whole_term_leaves_a_one_in_brackets() {
    for (source, expected) in [
        ("F*b + F", "F*(b + 1)"),
        ("M - F*b - F", "M - F*(b + 1)"),
        ("(n*r + m*l + m)*sin(q9)", "(n*r + m*(l + 1))*sin(q9)"),
        ("n*r + m*l^2 + 2*m*l + m", "n*r + m*(l + 1)^2"),
        // A sum with sines would be longer and no clearer.
        ("M - a*sin(q9) - a", "M - a*sin(q9) - a"),
    ] {
        assert_eq!(collected(source, 0), expected, "{source}");
    }
}

/// Among forms of the same length, common factors stand before parentheses, also after other parentheses and within
/// them.
#[test]
fn common_factors_of_the_rest_leave_brackets() {
    for (source, expected) in [
        (
            "F*l*sin(q1) + F*k*sin(q2) + G*(h + l*cos(q1) + k*cos(q2))",
            "F*(l*sin(q1) + k*sin(q2)) + G*(h + l*cos(q1) + k*cos(q2))",
        ),
        (
            "g*((n*r + m*l + k*l)*cos(q1) + k*b*cos(q2))",
            "g*(n*r + l*(m + k))*cos(q1) + g*k*b*cos(q2)",
        ),
    ] {
        assert_eq!(collected(source, 0), expected, "{source}");
    }
}

/// The sign before parentheses absorbs a minus sign at their beginning, so both sums are written in the same way.
#[test]
fn a_sum_of_minus_signs_in_brackets_is_as_short_as_one_of_plus_signs() {
    let sum = "0.5*b*sin(q5)*sin(q6) - 0.5*a*sin(q5)*cos(q6) + 0.5*c*cos(q5) + k*sin(q4)*sin(q5)";
    let [plus, minus] = ["", "-"].map(|sign| collected(&format!("{sign}({sum})*sin(q2)"), 0).len());
    assert!(minus <= plus + 1, "{minus} {plus}");
}

#[test]
fn sums_under_fraction_bars_cancel() {
    // Masses can add up: the center of mass of two bodies has the sum of their masses in its denominator.
    for (source, expected) in [
        ("m^3*r/(m + n)^2 + 2*m^2*n*r/(m + n)^2 + m*n^2*r/(m + n)^2", "m*r"),
        ("k*m/(m + n) + k*n/(m + n) + a*k", "k*(a + 1)"),
    ] {
        assert_eq!(collected(source, 0), expected, "{source}");
    }
}

/// A sine in a denominator is related to the cosine: cos² x/sin² x is 1/sin² x − 1.
#[test]
fn sines_under_fraction_bars_are_related_to_cosines() {
    for (source, expected) in [
        ("a*cos(0.3)^2/sin(0.3)^2 - a*cos(0.3)^4/sin(0.3)^2", "a*cos(0.3)^2"),
        ("a*sin(q9)^2*b/cos(q9) + a*b*cos(q9)", "a*b/cos(q9)"),
        (
            "a*cos(q9)^3/sin(q9)^2 + a*cos(q9) + b*sin(q9)^2/cos(q9)^2 - b/cos(q9)^2",
            "a*cos(q9)/sin(q9)^2 - b",
        ),
    ] {
        assert_eq!(collected(source, 0), expected, "{source}");
    }
}

/// A full graph builds wrong expressions. What is proved with them would differ from the polynomial.
#[test]
fn a_full_graph_proves_nothing() {
    let graph = Graph::limited(12);
    let [a, b, c, x] = ["a", "b", "c", "x"].map(|name| graph.symbol(name));
    let sum = a * x + b * x + c;
    let polynomial = Polynomial::of(sum, &PolynomialOptions::default()).unwrap();
    (1..20).fold(x, |power, _| power * x);
    assert!(graph.is_full());
    let terms = Collector { angles: &[], factors: true, double_angles: false }.collect(
        &polynomial,
        default_rank,
        &u8::MAX,
    );
    assert_eq!(arranged_text(&terms).unwrap(), "a*x + b*x + c");
}
