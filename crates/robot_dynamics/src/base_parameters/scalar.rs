//! Scalars for which it is decided whether they are zero.

use std::ops::{Add, Div, Mul, Neg, Sub};

use robot_model::robot::Robot;
use robot_symbolic::polynomial::reduced;
use robot_symbolic::{Expr, Polynomial, PolynomialOptions, Random, View, walk};

use crate::mechanism::Mechanism;

/// The number of points at which symbols have seeded values.
const POINTS: usize = 3;
/// The seed of the symbols' values at the first point.
const SEED: u64 = 1990;
/// The smallest part of the distance from nominal to seeded values that is tried.
const NEAREST: f64 = 1e-6;
/// A difference below this fraction of its operands may be 0.
const NOTICED: f64 = 1e-9;
/// Limits on the expansion of a difference. Beyond them, the values at the points decide whether it is 0.
const EXPANSION: PolynomialOptions = PolynomialOptions {
    angle_sums: robot_symbolic::AngleSums::Expand,
    max_terms: 2_000,
    max_products: 100_000,
};

/// Limits on the expansion of a scalar for output. Beyond them, its expanded form is not simpler.
const TIDY: PolynomialOptions =
    PolynomialOptions { max_terms: 100, max_products: 10_000, ..EXPANSION };

/// Expressions with more nodes than this are not simplified. Examples are those of chains with skew axes, in which
/// sines and cosines occur in every coefficient.
const SHORT: usize = 100;

/// An expression in constants and parameters, with its values at seeded values of the parameters.
///
/// A scalar that vanishes is represented by the constant 0. For rational numbers this is decided exactly. For others, a
/// sum that is small at all points counts as 0 if its canonical polynomial is 0, and does not if the polynomial has
/// only rational coefficients and parameters. If irrational constants occur or the polynomial would be too large, the
/// values at the points decide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scalar<'g> {
    pub(super) expr: Expr<'g>,
    at: [f64; POINTS],
    /// The value at the nominal parameters, of which those without a value have that of the first point.
    nominal: f64,
}

/// The value of a symbol at a point.
fn seeded(name: &str, point: u64) -> f64 {
    Random::of_name(name, SEED + point).uniform(0.4, 1.6)
}

/// The values of an expression at the points, from those of its symbols.
fn values(expr: Expr<'_>, value: impl Fn(&str, u64) -> f64) -> [f64; POINTS] {
    let name = |symbol| expr.graph().symbol_name(symbol);
    [0, 1, 2].map(|point| expr.evaluate(|symbol| value(&name(symbol), point)))
}

/// The points at which the geometry of a robot is evaluated: seeded values of its parameters, as near to the nominal ones
/// as the geometry requires. An axis with the component √(1 − c²) has no value at c = 1.2.
pub(super) struct Points<'r> {
    robot: &'r Robot,
    /// The part of the distance from the nominal value to the seeded one.
    distance: f64,
}

impl<'r> Points<'r> {
    pub(super) fn new(mechanism: &Mechanism<'_>, robot: &'r Robot) -> Points<'r> {
        let of_links = mechanism.links.iter().flat_map(|link| {
            let axes = link.rotation.0.into_iter().chain([link.translation.0, link.axis.0]);
            axes.flatten()
        });
        let geometry: Vec<Expr<'_>> = of_links.chain(mechanism.gravity.0).collect();
        let mut points = Points { robot, distance: 1.0 };
        while points.distance > NEAREST && !points.all_finite(&geometry) {
            points.distance /= 2.0;
        }
        points
    }

    fn all_finite(&self, expressions: &[Expr<'_>]) -> bool {
        let is_finite = |expr: &Expr<'_>| self.values(*expr).iter().all(|value| value.is_finite());
        expressions.iter().all(is_finite)
    }

    fn values(&self, expr: Expr<'_>) -> [f64; POINTS] {
        values(expr, |name, point| self.value(name, point))
    }

    fn value(&self, name: &str, point: u64) -> f64 {
        let far = seeded(name, point);
        if self.distance == 1.0 {
            return far;
        }
        let nominal = self.nominal(name);
        nominal + self.distance * (far - nominal)
    }

    /// The nominal value of a parameter; of one without a value, that of the first point.
    fn nominal(&self, name: &str) -> f64 {
        let value = self.robot.nominal_value(name);
        if value.is_nan() { seeded(name, 0) } else { value }
    }
}

impl<'g> Scalar<'g> {
    /// A constant, or a scalar whose nominal value does not matter and that has values everywhere.
    pub(super) fn new(expr: Expr<'g>) -> Scalar<'g> {
        Scalar::with_values(expr, values(expr, seeded))
    }

    fn with_values(expr: Expr<'g>, at: [f64; POINTS]) -> Scalar<'g> {
        Scalar { expr, at, nominal: at[0] }.settled([1e-3; POINTS])
    }

    /// A scalar with its values at the points and at the nominal parameters of a robot.
    pub(super) fn of(expr: Expr<'g>, points: &Points<'_>) -> Scalar<'g> {
        let scalar = Scalar::with_values(expr, points.values(expr));
        if scalar.is_constant() {
            return scalar;
        }
        let nominal = expr.evaluate(|symbol| points.nominal(&expr.graph().symbol_name(symbol)));
        Scalar { nominal, ..scalar }
    }

    pub(super) fn integer(like: Scalar<'g>, value: i64) -> Scalar<'g> {
        let expr = like.expr.graph().integer(value);
        Scalar { expr, at: [value as f64; POINTS], nominal: value as f64 }
    }

    /// Whether one can divide by the scalar at the nominal parameters.
    pub(super) fn divides(self) -> bool {
        self.nominal.abs() > NOTICED * self.size()
    }

    pub(super) fn is_zero(self) -> bool {
        self.expr.is_zero()
    }

    /// Whether the scalar has the same value for all values of the parameters.
    pub(super) fn is_constant(self) -> bool {
        self.expr.as_number().is_some()
    }

    /// A rough magnitude, used to choose among scalars.
    pub(super) fn size(self) -> f64 {
        self.at[0].abs()
    }

    /// The result of an operation, with its values.
    fn with(self, other: Scalar<'g>, expr: Expr<'g>, of: impl Fn(f64, f64) -> f64) -> Scalar<'g> {
        let nominal = of(self.nominal, other.nominal);
        Scalar { expr, at: pairwise(self.at, other.at, of), nominal }
    }

    /// This scalar, or 0 if it vanishes relative to `scale`.
    fn settled(self, scale: [f64; POINTS]) -> Scalar<'g> {
        let small = self.at.iter().zip(scale).all(|(value, scale)| value.abs() <= NOTICED * scale);
        let exact = |expr: Expr<'_>| expr.as_number().is_some_and(|n| n.as_rational().is_some());
        if !small || exact(self.expr) {
            return self;
        }
        match Polynomial::of(self.expr, &EXPANSION) {
            Ok(polynomial) if !polynomial.is_zero() && is_rational(&polynomial) => {
                Scalar { expr: polynomial.to_expr(), ..self }
            }
            _ => Scalar::integer(self, 0),
        }
    }
}

/// Whether the polynomial only contains symbols and rational coefficients.
fn is_rational(polynomial: &Polynomial<'_>) -> bool {
    polynomial.is_exact() && polynomial.atoms().iter().all(|atom| atom.as_symbol().is_some())
}

/// The canonical form of an expression, if the expression is short and the form contains no sums as atoms; otherwise the
/// expression without common divisors, if that is shorter.
pub(super) fn tidied(expr: Expr<'_>) -> Expr<'_> {
    let is_simple = !walk::is_longer_than(expr, 3);
    let is_done = is_simple || expr.as_number().is_some() || expr.graph().is_full();
    if is_done || walk::is_longer_than(expr, SHORT) {
        return expr;
    }
    let Ok(polynomial) = Polynomial::of(expr, &TIDY) else { return expr };
    let whole = |atom: &Expr<'_>| !matches!(atom.view(), View::Add(..) | View::Sub(..));
    match polynomial.atoms().iter().all(whole) {
        true => polynomial.to_expr(),
        // Squares of roots are sums in the polynomial.
        false => shortest(expr, reduced(polynomial.to_expr(), &TIDY)),
    }
}

/// An expression, or another form of it with fewer nodes.
fn shortest<'g>(expr: Expr<'g>, other: Option<Expr<'g>>) -> Expr<'g> {
    let nodes = |expr: Expr<'g>| walk::reachable(&[expr]).len();
    other.filter(|other| nodes(*other) < nodes(expr)).unwrap_or(expr)
}

fn pairwise(a: [f64; POINTS], b: [f64; POINTS], of: impl Fn(f64, f64) -> f64) -> [f64; POINTS] {
    [0, 1, 2].map(|point| of(a[point], b[point]))
}

impl<'g> Add for Scalar<'g> {
    type Output = Scalar<'g>;
    fn add(self, other: Scalar<'g>) -> Scalar<'g> {
        let sum = self.with(other, self.expr + other.expr, f64::add);
        sum.settled(pairwise(self.at, other.at, |a, b| a.abs().max(b.abs())))
    }
}

impl<'g> Sub for Scalar<'g> {
    type Output = Scalar<'g>;
    fn sub(self, other: Scalar<'g>) -> Scalar<'g> {
        self + -other
    }
}

impl<'g> Neg for Scalar<'g> {
    type Output = Scalar<'g>;
    fn neg(self) -> Scalar<'g> {
        Scalar { expr: -self.expr, at: self.at.map(f64::neg), nominal: -self.nominal }
    }
}

impl<'g> Mul for Scalar<'g> {
    type Output = Scalar<'g>;
    fn mul(self, other: Scalar<'g>) -> Scalar<'g> {
        self.with(other, self.expr * other.expr, f64::mul)
    }
}

impl<'g> Div for Scalar<'g> {
    type Output = Scalar<'g>;
    fn div(self, other: Scalar<'g>) -> Scalar<'g> {
        self.with(other, self.expr / other.expr, f64::div)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_symbolic::Graph;

    fn scalar<'g>(graph: &'g Graph, text: &str) -> Scalar<'g> {
        Scalar::new(graph.parse(text).unwrap())
    }

    /// An expression that vanishes identically becomes the constant 0, with rational numbers, parameters and irrational
    /// constants.
    #[test]
    fn what_vanishes_is_the_constant_zero() {
        let graph = Graph::new();
        let at = |text: &str| scalar(&graph, text);
        let zeros = [
            at("1/3") + at("1/6") - at("1/2"),
            at("a + b") - at("b") - at("a"),
            (at("a") + at("b")) * (at("a") - at("b")) - at("a^2") + at("b^2"),
            at("sin(a)^2") + at("cos(a)^2") - at("1"),
            at("sin(1)^2") + at("cos(1)^2") - at("1"),
            at("sqrt(2)") * at("sqrt(3)") - at("sqrt(6)"),
            at("a") / at("b") * at("b") - at("a"),
            at("a*b - b*a"),
        ];
        for (place, zero) in zeros.into_iter().enumerate() {
            assert!(zero.is_zero() && zero.is_constant(), "{place}: {zero:?}");
        }
    }

    /// A scalar does not count as 0 only because its values are small.
    #[test]
    fn what_is_small_is_not_zero() {
        let graph = Graph::new();
        let at = |text: &str| scalar(&graph, text);
        let tiny = ["1e-30", "1e-30*a", "a*1e-20 - b*1e-20"].map(at);
        let rest =
            [at("a") - at("b"), at("1 + 1e-12*a") - at("1"), at("sqrt(2)") - at("1.4142135")];
        for value in tiny.into_iter().chain(rest) {
            assert!(!value.is_zero(), "{value:?}");
        }
    }

    /// A scalar carries the values of its expression, by which it is distinguished from 0 and from other scalars.
    #[test]
    fn values_follow_the_expression() {
        let graph = Graph::new();
        let [a, b] = ["2*a + 1", "b - 3"].map(|text| scalar(&graph, text));
        for of in [a + b, a - b, a * b, a / b, -a, a + a * b, Scalar::integer(a, -7)] {
            let known = Scalar::new(of.expr);
            for (value, expected) in of.at.iter().zip(known.at) {
                assert!((value - expected).abs() <= 1e-14 * expected.abs(), "{of:?} {known:?}");
            }
            assert_eq!(of.size(), of.at[0].abs());
        }
        assert!(a.at[0] != a.at[1] && a.at[1] != a.at[2] && a.at[0] != a.at[2]);
        assert_ne!(scalar(&graph, "a").at, scalar(&graph, "b").at);
        assert!(!a.is_constant() && scalar(&graph, "2/3").is_constant());
    }

    /// Parentheses are multiplied out if nothing is divided by a sum, and if the result is short.
    #[test]
    fn short_expressions_are_tidied() {
        let graph = Graph::new();
        let tidy = |text: &str| {
            robot_symbolic::print::to_text(tidied(graph.parse(text).unwrap())).unwrap()
        };
        assert_eq!(tidy("a*(b + c) - b*a"), "a*c");
        assert_eq!(tidy("(a + b)*(a - b) + b*b"), "a^2");
        let root = "sqrt(a^2 + b^2)";
        assert_eq!(tidy(&format!("(a^3 + a*b^2)/({root}*{root}*(a + b)) + b/(a + b)")), "1");
        for kept in ["a*(b + a)/(b + c)", "(a + b + c + d + e)^8"] {
            let own = robot_symbolic::print::to_text(graph.parse(kept).unwrap()).unwrap();
            assert_eq!(tidy(kept), own);
        }
    }
}
