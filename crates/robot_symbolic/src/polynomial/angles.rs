//! Sines and cosines of canonical angles.

use std::rc::Rc;

use super::accumulator::{Part, Term, Terms};
use super::expand::Expander;
use super::{AngleSums, MAX_MULTIPLE, PolynomialError, terms};
use crate::expr::View;
use crate::graph::{Function, Graph, Id};
use crate::number::Number;
use crate::rational::Rational;
use crate::trigonometry::quarter_turns;

/// The sine and cosine of one angle.
type Circle = [Rc<Terms>; 2];

impl Expander<'_> {
    /// The sine or cosine of the angle with these terms; `id` is the angle's node.
    pub(super) fn circular(
        &mut self,
        function: Function,
        id: Id,
        angle: &Terms,
    ) -> Result<Terms, PolynomialError> {
        let (quarters, rest) = split_quarters(self.graph, angle);
        // sin(x + k π/2) cycles through sin, cos, −sin, −cos; the cosine is a quarter turn ahead.
        let phase = (quarters + u8::from(function == Function::Cos)) % 4;
        let value = match self.options.angle_sums {
            AngleSums::Keep if phase % 2 == 0 => single(self.graph, Function::Sin, &rest),
            AngleSums::Keep => single(self.graph, Function::Cos, &rest),
            AngleSums::Expand => {
                let circle = match self.circles.get(&id) {
                    Some(known) => known.clone(),
                    None => {
                        let circle = self.sum_circle(&rest)?;
                        self.budget.live += circle[0].len() + circle[1].len();
                        self.circles.insert(id, circle.clone());
                        circle
                    }
                };
                circle[usize::from(phase % 2)].to_vec()
            }
        };
        Ok(if phase >= 2 { terms::scaled(&value, &Number::integer(-1)) } else { value })
    }

    /// The sine and cosine of a sum of angles, from those of its terms.
    fn sum_circle(&mut self, angle: &[Term]) -> Result<Circle, PolynomialError> {
        let mut sum: Option<Circle> = None;
        for term in angle {
            let circle = self.multiple_circle(term)?;
            sum = Some(match sum {
                Some(before) => self.turn(&before, &circle)?,
                None => circle,
            });
        }
        Ok(sum.unwrap_or_else(zero_circle))
    }

    /// The sine and cosine of `n x` for an integer `n`, by repeated doubling of `x`. Terms with other coefficients are
    /// single angles.
    fn multiple_circle(&mut self, (monomial, number): &Term) -> Result<Circle, PolynomialError> {
        let multiple = number
            .as_rational()
            .and_then(Rational::to_integer)
            .filter(|n| n.abs() <= MAX_MULTIPLE && !monomial.is_one());
        let unit = match multiple {
            Some(_) => Number::integer(1),
            None => number.clone(),
        };
        let unit = [(monomial.clone(), unit)];
        let mut power = [Function::Sin, Function::Cos]
            .map(|function| Rc::new(single(self.graph, function, &unit)));
        let multiple = multiple.unwrap_or(1);
        let mut circle: Option<Circle> = None;
        let mut rest = multiple.unsigned_abs();
        while rest > 0 {
            if rest & 1 == 1 {
                circle = Some(match circle {
                    Some(before) => self.turn(&before, &power)?,
                    None => power.clone(),
                });
            }
            rest >>= 1;
            if rest > 0 {
                power = self.turn(&power, &power)?;
            }
        }
        let [sine, cosine] = circle.unwrap_or_else(zero_circle);
        Ok(if multiple < 0 {
            [Rc::new(terms::scaled(&sine, &Number::integer(-1))), cosine]
        } else {
            [sine, cosine]
        })
    }

    /// The sine and cosine of a sum of two angles.
    fn turn(&mut self, a: &Circle, b: &Circle) -> Result<Circle, PolynomialError> {
        let ([s, c], [t, d]) = (a, b);
        let (plus, minus) = (Number::integer(1), Number::integer(-1));
        let part = |a, b, factor| Part { a, b: Some(b), factor };
        let sine = self.sum_parts(&[part(s, d, &plus), part(c, t, &plus)])?;
        let cosine = self.sum_parts(&[part(c, d, &plus), part(s, t, &minus)])?;
        Ok([Rc::new(sine), Rc::new(cosine)])
    }
}

fn zero_circle() -> Circle {
    [0, 1].map(|value| Rc::new(terms::constant(Number::integer(value))))
}

/// The sine or cosine of an angle that is not expanded: a multiple of an atom, or a number.
fn single(graph: &Graph, function: Function, angle: &[Term]) -> Terms {
    let negative = terms::leads_negative(angle);
    let sign = Number::integer(if negative { -1 } else { 1 });
    let angle = terms::scaled(angle, &sign);
    let canonical = terms::to_expr(&angle, graph);
    let value = graph.call_terms(function, canonical, &angle);
    if negative && function == Function::Sin { terms::scaled(&value, &sign) } else { value }
}

/// Splits an angle into its quarter turns, modulo 4, and the rest.
fn split_quarters(graph: &Graph, angle: &Terms) -> (u8, Terms) {
    let place = angle.iter().position(|(monomial, number)| {
        let [factor] = monomial.factors() else {
            return false;
        };
        factor.exponent() == 1
            && number.as_rational().is_some()
            && graph.expr(factor.atom()).view() == View::Pi
    });
    let split = place.and_then(|place| {
        let (quarters, fraction) = quarter_turns(angle[place].1.as_rational()?)?;
        let mut rest = angle.clone();
        if fraction.is_zero() {
            rest.remove(place);
        } else {
            rest[place].1 = fraction.into();
        }
        Some((quarters, rest))
    });
    split.unwrap_or_else(|| (0, angle.clone()))
}
