//! Functions of one argument: exact values, parity, and quarter turns in sums of angles.

use crate::graph::{Function, Graph, Id, Node};
use crate::number::Number;
use crate::rational::Rational;

/// The largest number of terms of an angle that are searched for multiples of π: an angle of a mechanism has one term
/// for each parallel joint.
const MAX_ANGLE_TERMS: usize = 64;

impl Graph {
    pub(crate) fn call(&self, function: Function, argument: Id) -> Id {
        match function {
            Function::Sin | Function::Cos => self.circular(function, argument),
            _ => self.other_call(function, argument),
        }
    }

    fn other_call(&self, function: Function, argument: Id) -> Id {
        if let Some(value) = self.as_number(argument)
            && let Some(exact) = exact_value(function, &value)
        {
            return self.intern_number(&exact);
        }
        if let (Function::Sqrt, Some(Number::Rational(square))) =
            (function, self.as_number(argument))
            && let Some((factor, rest)) = reduced_root(&square)
        {
            let [factor, rest] =
                [Number::Rational(factor), Number::integer(rest)].map(|it| self.intern_number(&it));
            return self.mul(factor, self.intern(Node::Call(function, rest)));
        }
        match (function, self.node(argument)) {
            (Function::Abs, Node::Neg(x)) => self.call(function, x),
            (Function::Sign | Function::Tanh, Node::Neg(x)) => self.neg(self.call(function, x)),
            (Function::Abs, Node::Call(Function::Abs | Function::Sqrt, _)) => argument,
            _ => self.intern(Node::Call(function, argument)),
        }
    }

    /// sin or cos, simplified by quarter turns, parity and the exact values at multiples of π/6 and π/4.
    fn circular(&self, function: Function, argument: Id) -> Id {
        let (rest, multiple) = self.split_pi(argument);
        // Angle = rest + multiple·π. Reduce to rest + fraction·π with 0 ≤ fraction < 1/2.
        let Some((quarters, fraction)) = quarter_turns(&multiple) else {
            return self.intern(Node::Call(function, argument));
        };
        // sin(x + k π/2) cycles through sin, cos, −sin, −cos; the cosine is a quarter turn ahead.
        let phase = (quarters + u8::from(function == Function::Cos)) % 4;
        let remainder = self.add(rest, self.times_pi(&fraction));
        let value = match (self.exact_circular(rest, &fraction), phase % 2) {
            (Some((sine, _)), 0) => sine,
            (Some((_, cosine)), _) => cosine,
            (None, 0) => self.odd_even(Function::Sin, remainder),
            (None, _) => self.odd_even(Function::Cos, remainder),
        };
        if phase >= 2 { self.neg(value) } else { value }
    }

    fn odd_even(&self, function: Function, argument: Id) -> Id {
        match self.node(argument) {
            Node::Neg(x) if function == Function::Sin => {
                self.neg(self.intern(Node::Call(function, x)))
            }
            Node::Neg(x) => self.intern(Node::Call(function, x)),
            _ => self.intern(Node::Call(function, argument)),
        }
    }

    /// Sine and cosine of `rest + fraction · π`, in the first quadrant, if `rest` is 0 and both have exact values.
    fn exact_circular(&self, rest: Id, fraction: &Rational) -> Option<(Id, Id)> {
        if !self.as_number(rest)?.is_zero() {
            return None;
        }
        let (numerator, denominator) = fraction.to_small()?;
        let half_root = |square: i64| {
            let root = self.call(Function::Sqrt, self.intern_number(&Number::integer(square)));
            self.div(root, self.intern_number(&Number::integer(2)))
        };
        match (numerator, denominator) {
            (0, 1) => Some((half_root(0), half_root(4))),
            (1, 6) => Some((half_root(1), half_root(3))),
            (1, 4) => Some((half_root(2), half_root(2))),
            (1, 3) => Some((half_root(3), half_root(1))),
            _ => None,
        }
    }

    /// Splits an angle into `(rest, c)` with the angle equal to `rest + c π`.
    fn split_pi(&self, angle: Id) -> (Id, Rational) {
        let (mut terms, mut multiple) = (vec![], Rational::ZERO);
        let mut pending = vec![(angle, false)];
        while let Some((id, negative)) = pending.pop() {
            if pending.len() + terms.len() > MAX_ANGLE_TERMS {
                return (angle, Rational::ZERO);
            }
            match self.node(id) {
                Node::Add(a, b) => pending.extend([(b, negative), (a, negative)]),
                Node::Sub(a, b) => pending.extend([(b, !negative), (a, negative)]),
                Node::Neg(a) => pending.push((a, !negative)),
                _ => match self.multiple_of_pi(id) {
                    Some(c) if negative => multiple = &multiple - &c,
                    Some(c) => multiple = &multiple + &c,
                    None => terms.push((id, negative)),
                },
            }
        }
        if multiple.is_zero() {
            return (angle, multiple);
        }
        let zero = self.intern_number(&Number::integer(0));
        let rest = terms.into_iter().fold(zero, |sum, (term, negative)| {
            if negative { self.sub(sum, term) } else { self.add(sum, term) }
        });
        (rest, multiple)
    }

    fn multiple_of_pi(&self, id: Id) -> Option<Rational> {
        match self.node(id) {
            Node::Pi => Some(Rational::ONE),
            Node::Mul(a, b) if self.node(b) == Node::Pi => {
                self.as_number(a)?.as_rational().cloned()
            }
            _ => None,
        }
    }

    fn times_pi(&self, multiple: &Rational) -> Id {
        self.mul(self.intern_number(&multiple.clone().into()), self.intern(Node::Pi))
    }
}

/// Splits `c π`, with `c` the given multiple, into `quarters · π/2 + fraction · π`, with `quarters` modulo 4 and
/// `0 ≤ fraction < 1/2`. Returns `None` if the multiple does not fit machine words.
pub(crate) fn quarter_turns(multiple: &Rational) -> Option<(u8, Rational)> {
    let (numerator, denominator) = multiple.to_small()?;
    let twice = numerator.checked_mul(2)?;
    let quarters = twice.div_euclid(denominator);
    let fraction = multiple - &Rational::new(quarters, 2)?;
    Some((quarters.rem_euclid(4) as u8, fraction))
}

fn exact_value(function: Function, argument: &Number) -> Option<Number> {
    match function {
        Function::Abs if argument.is_negative() => Some(-argument),
        Function::Abs => Some(argument.clone()),
        Function::Sign if argument.is_negative() => Some(Number::integer(-1)),
        Function::Sign => Some(Number::integer(i64::from(!argument.is_zero()))),
        Function::Tanh if argument.is_zero() => Some(Number::integer(0)),
        Function::Sqrt => match argument {
            Number::Rational(rational) => exact_root(rational).map(Number::Rational),
            Number::Real(real) => Some(Number::real(real.value().sqrt())),
        },
        Function::RecipPositive if argument.is_negative() => Some(Number::real(f64::NAN)),
        Function::RecipPositive => Some(argument.recip()),
        Function::Tanh | Function::Sin | Function::Cos => None,
    }
}

/// The square root of a quotient of two perfect squares, or `None` for other numbers.
fn exact_root(square: &Rational) -> Option<Rational> {
    let (numerator, denominator) = square.to_small()?;
    let root = |n: i64| {
        let root = n.checked_isqrt()?;
        (root * root == n).then_some(root)
    };
    Rational::new(root(numerator)?, root(denominator)?)
}

/// A root without square factors and without a denominator: √8 is 2 √2, and √(1/2) is √2/2. Returns the factor and the
/// number whose root is left; `None` if the root remains as it is. A root of a quotient is only written in this way if
/// the number is small: √1.3 is not √130/10.
fn reduced_root(square: &Rational) -> Option<(Rational, i64)> {
    /// The largest divisor that is tried.
    const MOST: i64 = 1000;
    /// The largest number in place of a quotient.
    const SMALL: i64 = 12;
    let (numerator, denominator) = square.to_small().filter(|(numerator, _)| *numerator > 0)?;
    let mut rest = numerator.checked_mul(denominator)?;
    let mut factor = 1;
    for divisor in 2..=MOST {
        if divisor > rest / divisor {
            break;
        }
        while rest % (divisor * divisor) == 0 {
            rest /= divisor * divisor;
            factor *= divisor;
        }
    }
    let is_shorter = if denominator == 1 { factor > 1 } else { rest <= SMALL };
    let factor = Rational::new(factor, denominator).filter(|_| is_shorter)?;
    Some((factor, rest))
}

#[cfg(test)]
mod tests {
    use crate::{Graph, Number, Rational};

    #[test]
    fn roots_of_numbers_have_no_square_factors() {
        let g = Graph::new();
        for (source, expected) in [
            ("sqrt(8) - 2*sqrt(2)", "0"),
            ("sqrt(0.5) - sqrt(2)/2", "0"),
            ("sqrt(12)/sqrt(3)", "2"),
            ("sqrt(3/4)", "sqrt(3)/2"),
            ("sqrt(1.3)", "sqrt(1.3)"),
            ("sqrt(9/16)", "3/4"),
            ("sqrt(999983)", "sqrt(999983)"),
            ("sqrt(9223372036854775807)", "sqrt(9223372036854775807)"),
            ("sqrt(720)", "12*sqrt(5)"),
        ] {
            assert_eq!(g.parse(source).unwrap(), g.parse(expected).unwrap(), "{source}");
        }
        assert_eq!(g.parse("sqrt(1.3)").unwrap().evaluate(|_| 0.0), 1.3_f64.sqrt());
    }

    #[test]
    fn multiples_of_a_quarter_turn_are_exact() {
        let g = Graph::new();
        for k in -9_i64..=9 {
            let angle = g.pi() * k / 2;
            let exact = |value: f64| g.integer(value.round() as i64);
            let radians = k as f64 * std::f64::consts::FRAC_PI_2;
            assert_eq!(angle.sin(), exact(radians.sin()), "sin {k}π/2");
            assert_eq!(angle.cos(), exact(radians.cos()), "cos {k}π/2");
        }
    }

    #[test]
    fn quarter_turns_leave_sums() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        let right = g.pi() / 2;
        assert_eq!((x + right).sin(), x.cos());
        assert_eq!((x - right).sin(), -x.cos());
        assert_eq!((right - x).cos(), x.sin());
        assert_eq!((x + g.pi()).cos(), -x.cos());
        assert_eq!(((x + right) + y).sin(), (x + y).cos());
        assert_eq!((-x).sin(), -x.sin());
        assert_eq!((-x).cos(), x.cos());
        assert_eq!((x - y).sin(), -(y - x).sin());
    }

    #[test]
    fn roots_of_two_and_three_are_exact() {
        let g = Graph::new();
        assert_eq!((g.pi() / 6).sin(), g.one() / 2);
        assert_eq!((g.pi() / 4).sin() * (g.pi() / 4).cos(), g.one() / 2);
        assert_eq!((g.pi() / 3).sin(), g.integer(3).sqrt() / 2);
        assert_eq!((g.pi() * 5 / 4).cos(), -(g.integer(2).sqrt() / 2));
        assert_eq!(g.number(Rational::new(9, 4).unwrap()).sqrt(), g.integer(3) / 2);
    }

    #[test]
    fn other_angles_stay_symbolic() {
        let g = Graph::new();
        let angle = g.number(Rational::new(3, 10).unwrap());
        assert!(angle.sin().as_number().is_none());
        assert_eq!((-angle).sin(), -angle.sin());
        assert_eq!(g.number(Number::real(0.3)).abs(), g.number(Number::real(0.3)));
    }
}
