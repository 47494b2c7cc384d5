//! Long numbers with roots or sines, such as `0.007735484874 - 0.00365 √2` or `0.0005 √715731`, which are printed as one
//! decimal.

use std::collections::BTreeMap;

use robot_dynamics::mechanism::Mechanism;
use robot_symbolic::{
    Expr, Function, Graph, Id, Number, Polynomial, PolynomialOptions, Rational, Real, View, walk,
};
use rustc_hash::FxHashMap;

use super::{Writer, residues};

/// The largest number of digits of a number that stays in a sum with roots, as in `1 + √2`. People do not write longer
/// ones.
const MOST_DIGITS: usize = 6;

/// The least number below a root that makes the root a decimal. Axes that were rounded or measured have such lengths;
/// those that people write, such as (1, -2, 3), have short ones.
const LONG_ROOT: i64 = 10_000;

/// The largest relative difference of an expanded constant from one that is computed as it stands.
const LOST: f64 = 1e-13;

/// A part of an expression that contains no symbol.
#[derive(Clone, Copy)]
struct Constant {
    value: Real,
    /// Whether it contains a function of a number, such as √2 or sin(0.3).
    has_function: bool,
    /// The number of sines, cosines and other functions except roots in it.
    angles: usize,
    /// The number of sums in it.
    sums: usize,
    /// The largest number of digits of a number in it.
    digits: usize,
    /// Whether it contains a root of a long number.
    has_long_root: bool,
}

impl Constant {
    /// Whether the constant is printed as a decimal.
    fn is_decimal(&self) -> bool {
        let is_long = self.digits > MOST_DIGITS || self.sums > 1 || self.angles > 0;
        let is_product = self.sums == 0 && self.angles < 2;
        let is_decimal = self.has_long_root || self.has_function && is_long && !is_product;
        is_decimal && self.value.value().is_finite()
    }
}

/// The expressions as they are printed: roots of long numbers and long expressions with functions of numbers are the
/// nearest doubles if [`rounds_roots`](super::EquationOptions::rounds_roots) is set.
pub(super) fn rounded<'h>(writer: &Writer<'_, '_>, roots: &[Expr<'h>]) -> Vec<Expr<'h>> {
    match roots.first().filter(|_| writer.options.rounds_roots) {
        Some(root) => with_decimals(roots, root.graph()),
        None => roots.to_vec(),
    }
}

fn with_decimals<'g>(roots: &[Expr<'g>], graph: &'g Graph) -> Vec<Expr<'g>> {
    with_values(roots, graph, |constant, value| decimal(expanded(constant, value)))
}

/// The value of a constant, given that of its expression as it stands. The same constant in two forms has the same value,
/// unless terms of the expansion cancel each other and leave fewer digits.
fn expanded(constant: Expr<'_>, value: f64) -> f64 {
    let expanded = Polynomial::of(constant, &PolynomialOptions::default()).ok();
    let found = expanded.map(|expanded| expanded.evaluate(|_| f64::NAN));
    found.filter(|found| (found - value).abs() <= LOST * value.abs()).unwrap_or(value)
}

/// The expressions with numbers for all parts that are long sums with functions of numbers; `value` returns that of a
/// part, given that of its expression as it stands.
pub(crate) fn with_values<'g>(
    roots: &[Expr<'g>],
    graph: &'g Graph,
    value: impl Fn(Expr<'g>, f64) -> Option<Number>,
) -> Vec<Expr<'g>> {
    let mut constants: FxHashMap<Id, Constant> = FxHashMap::default();
    for expr in walk::reachable(roots) {
        if let Some(constant) = constant(expr, &constants) {
            constants.insert(expr.id(), constant);
        }
    }
    if !constants.values().any(Constant::is_decimal) {
        return roots.to_vec();
    }
    walk::rebuild_above(roots, graph, |part| {
        let constant = constants.get(&part.id()).filter(|constant| constant.is_decimal())?;
        Some(graph.number(value(part, constant.value.value())?))
    })
}

/// Replaces the long numbers with functions in the masses, centers of mass and inertia tensors of links in the same
/// way.
pub(super) fn round_links<'g>(writer: &Writer<'_, 'g>, mechanism: &mut Mechanism<'g>) {
    for link in &mut mechanism.links {
        let own = std::iter::once(&mut link.mass).chain(&mut link.center_of_mass.0);
        for value in own.chain(link.inertia.0.iter_mut().flatten()) {
            let decimal = rounded(writer, &[*value]);
            *value = decimal.first().copied().unwrap_or(*value);
        }
    }
}

/// The properties of an expression without symbols, from those of its operands.
fn constant(expr: Expr<'_>, known: &FxHashMap<Id, Constant>) -> Option<Constant> {
    if let View::Number(number) = expr.view() {
        let (value, digits) = (Real::from(number.to_f64()), digits(&number));
        return Some(Constant {
            value,
            has_function: false,
            angles: 0,
            sums: 0,
            digits,
            has_long_root: false,
        });
    }
    let operands: Option<Vec<Constant>> =
        expr.operands().iter().map(|operand| known.get(&operand.id()).copied()).collect();
    let operands = operands?;
    let value = match (expr.view(), operands.as_slice()) {
        (View::Neg(_), [a]) => -a.value,
        (View::Add(..), [a, b]) => a.value + b.value,
        (View::Sub(..), [a, b]) => a.value - b.value,
        (View::Mul(..), [a, b]) => a.value * b.value,
        (View::Div(..), [a, b]) => a.value / b.value,
        (View::Call(function, _), [a]) => Real::from(function.apply(a.value.value())),
        _ => return None,
    };
    // Common parts count each time, so numbers can exceed every limit.
    let total =
        |count: fn(&Constant) -> usize| operands.iter().map(count).fold(0, usize::saturating_add);
    let is_sum = matches!(expr.view(), View::Add(..) | View::Sub(..));
    let has_function = matches!(expr.view(), View::Call(..));
    let is_angle = has_function && !matches!(expr.view(), View::Call(Function::Sqrt, _));
    Some(Constant {
        value,
        has_function: has_function || operands.iter().any(|one| one.has_function),
        angles: total(|one| one.angles).saturating_add(usize::from(is_angle)),
        sums: total(|one| one.sums).saturating_add(usize::from(is_sum)),
        digits: operands.iter().map(|one| one.digits).max().unwrap_or_default(),
        has_long_root: is_long_root(expr) || operands.iter().any(|one| one.has_long_root),
    })
}

/// Whether an expression is the root of a number that nobody would write below a root.
fn is_long_root(expr: Expr<'_>) -> bool {
    let View::Call(Function::Sqrt, argument) = expr.view() else { return false };
    let is_long = |number: Number| {
        let small = number.as_rational().and_then(Rational::to_small);
        small.is_none_or(|(above, below)| above.abs().max(below) >= LONG_ROOT)
    };
    argument.as_number().is_some_and(is_long)
}

/// Whether a polynomial contains the root of a number that nobody would write below a root.
pub(super) fn has_long_root(value: &Polynomial<'_>) -> bool {
    value.atoms().into_iter().any(is_long_root)
}

/// Whether a number in a polynomial has more digits than people write.
pub(super) fn has_long(value: &Polynomial<'_>) -> bool {
    value.terms().any(|(_, number)| digits(number) > MOST_DIGITS)
}

/// The number of significant digits of a decimal.
pub(super) fn digits(number: &Number) -> usize {
    let text = format!("{:e}", number.to_f64().abs());
    text.chars().take_while(|c| *c != 'e').filter(char::is_ascii_digit).count()
}

/// The shortest decimal that is read as the double.
pub(crate) fn decimal(value: f64) -> Option<Number> {
    Rational::from_decimal(&format!("{value:e}")).map(Number::Rational)
}

/// Writes functions of numbers as decimals in all terms if some coefficient of a product of symbols is a sum of such
/// functions and long numbers, or contains the root of a long number; `None` if there is none.
pub(crate) fn without_functions<'g>(value: &Polynomial<'g>) -> Option<Polynomial<'g>> {
    let graph = value.graph();
    let is_of_number = |atom: Id| {
        matches!(graph.expr(atom).view(), View::Call(Function::Sqrt | Function::Sin | Function::Cos, argument)
            if matches!(argument.view(), View::Number(_)))
    };
    let mut coefficients: BTreeMap<Vec<(Id, i32)>, Constant> = BTreeMap::new();
    for (monomial, number) in value.terms() {
        let (mut has_function, mut angles, mut has_long_root, mut key) = (false, 0, false, vec![]);
        for factor in monomial.factors() {
            match is_of_number(factor.atom()) {
                true => {
                    has_function = true;
                    let atom = graph.expr(factor.atom());
                    has_long_root |= is_long_root(atom);
                    if !matches!(atom.view(), View::Call(Function::Sqrt, _)) {
                        angles += factor.exponent().unsigned_abs() as usize;
                    }
                }
                false => key.push((factor.atom(), factor.exponent())),
            }
        }
        let digits = digits(number);
        let value = Real::from(0.0);
        let new = Constant { value, has_function, angles, sums: 0, digits, has_long_root };
        coefficients
            .entry(key)
            .and_modify(|known| {
                known.has_function |= has_function;
                known.has_long_root |= has_long_root;
                known.angles += angles;
                known.sums += 1;
                known.digits = known.digits.max(digits);
            })
            .or_insert(new);
    }
    if !coefficients.values().any(Constant::is_decimal) {
        return None;
    }
    let sum = value.terms().fold(graph.zero(), |sum, (monomial, number)| {
        let factors = monomial.factors().iter().map(|factor| {
            let atom = graph.expr(factor.atom());
            let number = is_of_number(factor.atom()).then(|| decimal(atom.evaluate(|_| f64::NAN)));
            number.flatten().map_or(atom, |number| graph.number(number)).powi(factor.exponent())
        });
        sum + factors.fold(graph.number(number.clone()), |product, factor| product * factor)
    });
    residues::polynomial(sum, &PolynomialOptions::default()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimals(text: &str) -> String {
        let graph = Graph::new();
        let parsed = graph.parse(text).unwrap();
        let [written] = with_decimals(&[parsed], &graph)[..] else { panic!("one expression") };
        robot_symbolic::print::to_text(written).unwrap()
    }

    #[test]
    fn long_numbers_with_roots_are_one_decimal() {
        let value = 0.007_735_484_874 - 0.003_65 * 2.0_f64.sqrt();
        let expected = format!("{value}*sin(q1)");
        assert_eq!(decimals("(0.007735484874 - 0.00365*sqrt(2))*sin(q1)"), expected);
        let negative = format!("-{expected}");
        assert_eq!(decimals("(0.00365*sqrt(2) - 0.007735484874)*sin(q1)"), negative);
        let value = 0.022 + 0.0045 * 0.3_f64.cos();
        assert_eq!(decimals("(0.022 + 0.0045*cos(0.3))*l1"), format!("{value}*l1"));
        let value = 0.1_f64.sin() * 0.3_f64.sin();
        assert_eq!(decimals("sin(0.1)*sin(0.3)*l1"), format!("{value}*l1"));
        // Several short numbers are long together.
        let value = (1.0 + 2.0_f64.sqrt()) * (0.5 - 3.0_f64.sqrt());
        let shown: f64 = decimals("(1 + sqrt(2))*(0.5 - sqrt(3)) + q1")
            .split_whitespace()
            .find_map(|word| word.parse().ok())
            .unwrap();
        assert!((shown.abs() - value.abs()).abs() < 1e-15, "{shown}, {value}");
    }

    /// (√2 − 1)¹⁸ is 10⁻⁷, and the terms of its expansion are 10⁶.
    #[test]
    fn an_expansion_whose_terms_cancel_is_not_evaluated() {
        let value: f64 = decimals(&["(sqrt(2) - 1)"; 18].join("*")).parse().unwrap();
        let small = (2.0_f64.sqrt() - 1.0).powi(18);
        assert!((value - small).abs() < 1e-14 * small, "{value}, {small}");
    }

    #[test]
    fn rounding_errors_are_zero() {
        // (a - 0.7) (a + 0.7) + 0.49 - a² for a = 0.1234567 √3.
        let noise = "(0.1234567*sqrt(3) - 0.7)*(0.1234567*sqrt(3) + 0.7) + 0.49 - 0.04572467032467";
        assert_eq!(decimals(noise), "0");
    }

    /// Each round doubles the number of sums, of which there are 2⁷⁰ as printed.
    #[test]
    fn expressions_with_many_common_parts_are_numbers() {
        let graph = Graph::new();
        let mut value = graph.parse("sin(0.3) + 1").unwrap();
        for _ in 0..70 {
            value = (value + graph.one()) / value;
        }
        let found = with_values(&[value], &graph, |_, value| decimal(value));
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        assert!((found[0].as_number().unwrap().to_f64() - golden).abs() < 1e-15);
    }

    #[test]
    fn short_numbers_products_and_parameters_stay() {
        for text in [
            "(1 + sqrt(2))*sin(q1)",
            "0.007735484874*sqrt(2)*sin(q1)",
            "0.007735484874*sin(q1) + sqrt(2)*l1",
            "(0.007735484874 + l1*sqrt(2))*sin(q1)",
            "1.962*cos(0.3)*cos(q2)",
            "0.5*sqrt(9998)*sin(q1)",
        ] {
            let graph = Graph::new();
            let parsed = graph.parse(text).unwrap();
            assert_eq!(with_decimals(&[parsed], &graph), [parsed], "{text}");
        }
    }

    #[test]
    fn roots_of_long_numbers_are_decimals() {
        // The first component of the unit vector along (0.211, 0.817, -0.061).
        let unit = "211/sqrt(715731)";
        let value = 211.0 / 715_731.0_f64.sqrt();
        let shown = decimals(&format!("0.5*({unit})*m1*sin(q1)"));
        let number: f64 = shown.strip_suffix("*m1*sin(q1)").unwrap().parse().unwrap();
        assert!((number - 0.5 * value).abs() < 1e-16, "{shown}");
        let graph = Graph::new();
        let long = graph.parse(&format!("({unit})*m1*sin(q1) + 2*l1")).unwrap();
        let polynomial = Polynomial::of(long, &PolynomialOptions::default()).unwrap();
        assert!(has_long_root(&polynomial));
        let written = without_functions(&polynomial).unwrap();
        assert!(!has_long_root(&written));
        assert!((written.evaluate(|_| 1.0) - value * 1.0_f64.sin() - 2.0).abs() < 1e-15);
    }

    #[test]
    fn terms_have_decimals_if_a_coefficient_is_a_long_sum_with_roots() {
        let graph = Graph::new();
        let polynomial = |text: &str| {
            Polynomial::of(graph.parse(text).unwrap(), &PolynomialOptions::default()).unwrap()
        };
        let mixed = polynomial("0.0005*sqrt(2)*(sin(q1) - cos(q1)) - 0.001672482662*sin(q1)");
        let written = without_functions(&mixed).unwrap();
        assert_eq!(written.len(), 2);
        for q1 in [0.3, -1.7] {
            let [exact, decimal] = [&mixed, &written].map(|it| it.evaluate(|_| q1));
            assert!((exact - decimal).abs() < 1e-17, "{exact}, {decimal}");
        }
        for text in [
            "0.0005*sqrt(2)*(sin(q1) - cos(q1)) - 0.001672482662*sin(q1)*cos(q1)",
            "(1 + sqrt(2))*sin(q1) + 0.001672482662*cos(q1)",
            "0.001672482662*l1 + 0.5*l1*l2",
        ] {
            assert!(without_functions(&polynomial(text)).is_none(), "{text}");
        }
    }
}
