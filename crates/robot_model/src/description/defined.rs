//! Checks whether an expression has a value: no division by 0, nor by a value that rounding errors make
//! indistinguishable from 0.

use robot_symbolic::formula::Step;
use robot_symbolic::{Formula, Function, Rational};

use super::reader::Reader;

/// A divisor must exceed its rounding error by this factor, so that at least three digits of it are significant.
const DIGITS: f64 = 1e3;
/// The largest rounding error of an angle whose sine can be computed, rad.
const ANGLE: f64 = 1e-6;

/// The reason why the sine of a rounded large angle cannot be computed.
pub(super) const LARGE_ANGLE: &str =
    "rounding errors of the angle are above 1e-6 rad, so its sine is not known";

/// A value and a bound on its rounding error.
#[derive(Clone, Copy)]
struct Rounded {
    value: f64,
    error: f64,
}

impl Rounded {
    fn new(value: f64, error: f64) -> Rounded {
        Rounded { value, error: error + value.abs() * f64::EPSILON }
    }

    fn of(number: &Rational) -> Rounded {
        let value = number.to_f64();
        let is_exact = Rational::from_f64(value).as_ref() == Some(number);
        if is_exact { Rounded { value, error: 0.0 } } else { Rounded::new(value, 0.0) }
    }

    fn sum(self, other: Rounded) -> Rounded {
        Rounded::new(self.value + other.value, self.error + other.error)
    }

    fn negated(self) -> Rounded {
        Rounded { value: -self.value, ..self }
    }

    fn product(self, other: Rounded) -> Rounded {
        let error = self.value.abs() * other.error + other.value.abs() * self.error;
        Rounded::new(self.value * other.value, error)
    }

    fn is_zero(self) -> bool {
        self.value.abs() <= DIGITS * self.error
    }

    fn quotient(self, divisor: Rounded) -> Result<Rounded, &'static str> {
        if divisor.is_zero() {
            return Err("division by 0, or by a value that rounding cannot distinguish from 0");
        }
        let value = self.value / divisor.value;
        Ok(Rounded::new(value, (self.error + value.abs() * divisor.error) / divisor.value.abs()))
    }

    fn power(self, exponent: i32) -> Result<Rounded, &'static str> {
        let one = Rounded { value: 1.0, error: 0.0 };
        let power = (0..exponent.unsigned_abs()).fold(one, |product, _| product.product(self));
        if exponent < 0 { one.quotient(power) } else { Ok(power) }
    }

    fn of_function(self, function: Function) -> Result<Rounded, &'static str> {
        let Rounded { value, error } = self;
        let result = function.apply(value);
        Ok(match function {
            Function::Sin | Function::Cos if error > ANGLE => {
                return Err(LARGE_ANGLE);
            }
            Function::Sqrt if value < -DIGITS * error => {
                return Err("the square root of a negative number");
            }
            // A square root's operand that is negative only because of rounding is taken as 0.
            Function::Sqrt if value <= 0.0 => Rounded { value: 0.0, error: error.sqrt() },
            Function::Sqrt => Rounded::new(result, error / result),
            Function::Sign => Rounded { value: result, error: 0.0 },
            Function::RecipPositive => Rounded { value: 1.0, error: 0.0 }.quotient(self)?,
            Function::Sin | Function::Cos | Function::Abs | Function::Tanh => {
                Rounded::new(result, error)
            }
        })
    }

    fn tangent(self) -> Result<Rounded, &'static str> {
        let [sine, cosine] = [Function::Sin, Function::Cos].map(|f| self.of_function(f));
        sine?.quotient(cosine?).map_err(|_| "the tangent of an odd multiple of pi/2")
    }
}

/// The reason why an expression of numbers does not have a value, such as a division by 0; `None` if it has one, or if it
/// contains symbols.
#[must_use]
pub fn undefined(formula: &Formula) -> Option<&'static str> {
    reason(formula, &|_| None)
}

fn reason(formula: &Formula, value_of: &dyn Fn(&str) -> Option<Rounded>) -> Option<&'static str> {
    let mut reason = None;
    // In the fold, an operand with an unknown value is `None`.
    formula.fold(|step| rounded(&step, value_of).map_err(|found| reason = Some(found)).ok());
    reason
}

fn rounded(
    step: &Step<'_, Option<Rounded>>,
    value_of: &dyn Fn(&str) -> Option<Rounded>,
) -> Result<Option<Rounded>, &'static str> {
    let both = |a: Option<Rounded>, b: Option<Rounded>| a.zip(b);
    Ok(match *step {
        Step::Number(value) => Some(Rounded::of(value)),
        Step::Pi => Some(Rounded::new(std::f64::consts::PI, 0.0)),
        Step::Symbol(name, _) => value_of(name),
        Step::Add(a, b) => both(a, b).map(|(a, b)| a.sum(b)),
        Step::Sub(a, b) => both(a, b).map(|(a, b)| a.sum(b.negated())),
        Step::Mul(a, b) => both(a, b).map(|(a, b)| a.product(b)),
        Step::Div(_, Some(b)) if b.is_zero() => return b.quotient(b).map(Some),
        Step::Div(a, b) => both(a, b).map(|(a, b)| a.quotient(b)).transpose()?,
        Step::Neg(a) => a.map(Rounded::negated),
        Step::Power(a, exponent) => a.map(|a| a.power(exponent)).transpose()?,
        Step::Call(function, a) => a.map(|a| a.of_function(function)).transpose()?,
        Step::Tan(a) => a.map(Rounded::tangent).transpose()?,
    })
}

impl Reader<'_> {
    /// The reason why the expression has no value at the nominal values of the parameters. `None` if it has a value, or
    /// if this depends on parameters without nominal values.
    pub(super) fn undefined(&self, formula: &Formula) -> Option<&'static str> {
        reason(formula, &|name| self.nominal(name))
    }

    /// Whether the expression is 0 at the nominal values of the parameters, to within rounding errors.
    pub(super) fn vanishes(&self, formula: &Formula) -> bool {
        let value = formula.fold(|step| rounded(&step, &|name| self.nominal(name)).ok()).flatten();
        value.is_some_and(Rounded::is_zero)
    }

    fn nominal(&self, name: &str) -> Option<Rounded> {
        self.parameter(name).and_then(|known| known.value.as_ref()).map(Rounded::of)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Options;
    use super::super::reader::Known;
    use super::*;

    #[test]
    fn what_has_no_value_has_a_reason() {
        let of = |text: &str| undefined(&Formula::parse(text).unwrap());
        assert_eq!([of("2/3"), of("sqrt(x)"), of("1/(x - x)")], [None; 3]);
        assert_eq!(of("tan(pi/2)"), Some("the tangent of an odd multiple of pi/2"));
        assert!(of("x*(1/0)").is_some_and(|reason| !reason.is_empty()));
    }

    #[test]
    fn errors_of_functions_are_those_of_their_slopes() {
        let rounded = |value: f64, error: f64| Rounded { value, error };
        let root = rounded(16.0, 1e-3).of_function(Function::Sqrt).unwrap();
        assert_eq!(root.value, 4.0);
        assert!((root.error - 2.5e-4).abs() < 1e-12, "{}", root.error);
        let nothing = rounded(-1e-18, 1e-16).of_function(Function::Sqrt).unwrap();
        assert_eq!((nothing.value, nothing.error), (0.0, 1e-8));
        assert!(rounded(3.0, ANGLE).of_function(Function::Sin).is_ok());
        assert!(rounded(3.0, 2.0 * ANGLE).of_function(Function::Sin).is_err());
    }

    #[test]
    fn poles_are_distinguished_from_values() {
        let options = Options::default();
        let mut reader = Reader::new("", &options);
        for (name, value) in [("a", Some("0.3")), ("b", Some("0.1")), ("x", None)] {
            reader.define(Known {
                name: name.to_owned(),
                span: 0..0,
                value: value.and_then(Rational::from_decimal),
                unit: None,
                used: false,
            });
        }
        let reason = |text: &str| reader.undefined(&Formula::parse(text).unwrap()).unwrap_or("");
        for text in [
            "tan(1.5)",
            "1/(a - 2*b)",
            "sqrt(2)*x",
            "1/x",
            "tan(x)",
            "0/2",
            "sin(pi)/3",
            "a^-3",
            "sqrt(sin(1)^2 + cos(1)^2 - 1)",
            "1/sin(1e-9)",
            "cos(pi/2)",
            "sign(a - 3*b)",
            "0^0",
            // The difference is far above the rounding error of the root.
            "1/(sqrt(1e8 + pi/pi) - 1e4)",
            "1/(pi/1e16)",
        ] {
            assert_eq!(reason(text), "", "{text}");
        }
        for text in [
            "1/0",
            "x/0",
            "0/0",
            "0*(1/0)",
            "1/(a - 3*b)",
            "1/sin(pi)",
            "(a - 3*b)^-1",
            "1/((a - 3*b)/1e-9)",
            "2/(x - x*0)^0/0",
            "1/(sqrt(2)*sqrt(3) - sqrt(6))",
            "x + 1/cos(pi/2)",
        ] {
            assert!(reason(text).starts_with("division by 0"), "{text}: {}", reason(text));
        }
        for text in ["tan(pi/2)", "tan(-3*pi/2)*0", "x*tan(pi/2)", "tan(1.5707963267948966)"] {
            assert!(reason(text).starts_with("the tangent"), "{text}: {}", reason(text));
        }
        assert!(reason("x*sqrt(-pi)").starts_with("the square root"));
        assert!(reason("sin(1e300)").starts_with("rounding errors of the angle"));
    }
}
