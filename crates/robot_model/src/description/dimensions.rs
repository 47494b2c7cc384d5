//! Dimensions of expressions, from the units of their parameters.
//!
//! The parameters of an expression and the operations on them give it a dimension. A number may carry a unit that the
//! file does not state: in `m1*0.2^2/12` the 0.2 is a length. The rules are therefore:
//!
//! - a number by itself takes the dimension that its place requires, and a number in a sum that of the other terms;
//! - an expression whose only factors are parameters must have the dimension of its place;
//! - an expression of a wrong dimension causes a warning if it has small whole numbers or halves as factors, which are
//!   unlikely to carry units;
//! - an expression with other numbers as factors may have any dimension.
//!
//! Nothing is concluded from parameters without a unit.

use robot_symbolic::formula::Step;
use robot_symbolic::{Formula, Function, Rational};

use super::reader::Reader;
use super::value::Quantity;
use crate::diagnostic::{Diagnostic, Span, code, quote};
use crate::unit::Dimension;

/// Whole numbers and halves up to this limit count as dimensionless factors, as in `m*l^2/12`.
const COUNT: i64 = 12;

/// The kinds of factors that an expression may contain, in ascending order; an expression has the highest kind that
/// occurs in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factors {
    /// Only parameters, π and functions: the dimension is certain.
    Certain,
    /// Also small whole numbers and halves.
    Counts,
    /// Also other numbers, which may carry units.
    Numbers,
}

/// The known part of an expression's dimension.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dimensioned {
    /// `None` if a parameter has no unit.
    pub(super) dimension: Option<Dimension>,
    pub(super) factors: Factors,
    /// Whether it contains no parameter, so that it can take any dimension.
    is_number: bool,
}

impl Dimensioned {
    fn pure(factors: Factors, is_number: bool) -> Dimensioned {
        Dimensioned { dimension: Some(Dimension::NONE), factors, is_number }
    }

    fn number(value: &Rational) -> Dimensioned {
        let twice = (value * &Rational::integer(2)).to_integer();
        let is_count = twice.is_some_and(|twice| twice.abs() <= 2 * COUNT);
        Dimensioned::pure(if is_count { Factors::Counts } else { Factors::Numbers }, true)
    }

    fn product(self, other: Dimensioned, exponent: i8) -> Dimensioned {
        let dimensions = self.dimension.zip(other.dimension);
        Dimensioned {
            dimension: dimensions.map(|(a, b)| a.product(b.to_power(exponent))),
            factors: self.factors.max(other.factors),
            is_number: self.is_number && other.is_number,
        }
    }

    /// The dimension of the value; `None` for a number, which can take any dimension, and if a parameter has no unit.
    fn known(self) -> Option<Dimension> {
        self.dimension.filter(|_| !self.is_number)
    }

    /// The dimension of a sum, or an error if the dimensions of the two terms differ.
    fn sum(self, other: Dimensioned) -> Result<Dimensioned, Clash> {
        let factors = self.factors.max(other.factors);
        let surer = if other.factors < self.factors { other } else { self };
        match (self.is_number, other.is_number, self.known(), other.known()) {
            (true, true, ..) => Ok(Dimensioned { factors, ..self }),
            (true, false, ..) => Ok(other),
            (false, true, ..) => Ok(self),
            (_, _, Some(a), Some(b)) if a != b && factors != Factors::Numbers => {
                Err(Clash { factors, summed: true, here: a, there: b })
            }
            (_, _, Some(_), None) => Ok(self),
            (_, _, None, Some(_)) => Ok(other),
            _ => Ok(surer),
        }
    }

    /// The result of a function that takes a pure number, or an error if the operand has a dimension.
    fn of_number(self) -> Result<Dimensioned, Clash> {
        match self.known() {
            Some(here) if here != Dimension::NONE && self.factors != Factors::Numbers => {
                Err(Clash { factors: self.factors, summed: false, here, there: Dimension::NONE })
            }
            _ => Ok(Dimensioned::pure(Factors::Certain, self.is_number)),
        }
    }

    fn root(self) -> Dimensioned {
        let halved = |d: Dimension| {
            let even = [d.mass, d.length, d.time].iter().all(|exponent| exponent % 2 == 0);
            even.then(|| Dimension::new(d.mass / 2, d.length / 2, d.time / 2))
        };
        Dimensioned { dimension: self.dimension.and_then(halved), ..self }
    }
}

/// Two dimensions that should be equal but are not.
#[derive(Clone, Copy)]
pub(super) struct Clash {
    factors: Factors,
    /// Whether the two are terms of a sum; otherwise the operand of a function must be a pure number.
    summed: bool,
    here: Dimension,
    there: Dimension,
}

impl Clash {
    fn diagnostic(self, formula: &Formula) -> Diagnostic {
        let (here, there) = (value_in(self.here), value_in(self.there));
        let (text, pure) = (quote(formula.text()), where_pure(self.factors));
        let message = if self.summed {
            format!("`{text}` adds {here} to {there}{pure}")
        } else {
            let comma = if pure.is_empty() { "" } else { "," };
            format!("`{text}` applies a function to {here}, not to a pure number{comma}{pure}")
        };
        reported(self.factors, message)
    }
}

/// Returns an error if all factors are parameters, and a warning if a number may carry the unit.
fn reported(factors: Factors, message: String) -> Diagnostic {
    match factors {
        Factors::Certain => Diagnostic::error(code::DIMENSION, message)
            .help("correct the expression, or the units of its parameters"),
        Factors::Counts | Factors::Numbers => Diagnostic::warning(code::UNIT_OF_NUMBER, message)
            .help("correct the expression; if a number in it has a unit, make it a parameter"),
    }
}

fn where_pure(factors: Factors) -> &'static str {
    match factors {
        Factors::Certain => "",
        Factors::Counts | Factors::Numbers => " if its numbers are pure",
    }
}

fn needed(quantity: Quantity, expected: Dimension) -> String {
    match expected {
        Dimension::NONE => format!("but a pure number is needed for {}", quantity.what),
        _ => format!("but {} must be in {expected}", quantity.what),
    }
}

fn value_in(dimension: Dimension) -> String {
    match dimension {
        Dimension::NONE => "a pure number".to_owned(),
        _ => format!("a value in {dimension}"),
    }
}

fn in_units(dimension: Dimension) -> String {
    match dimension {
        Dimension::NONE => "a pure number".to_owned(),
        _ => format!("in {dimension}"),
    }
}

impl Reader<'_> {
    /// Reports an expression whose dimension does not suit its place. Returns whether the expression can be kept.
    pub(super) fn fits(&mut self, formula: &Formula, quantity: Quantity, span: &Span) -> bool {
        let found = match self.dimension(formula) {
            Ok(found) => found,
            Err(clash) => {
                let diagnostic = clash.diagnostic(formula);
                self.report(diagnostic.at(span, "inconsistent units in this expression"));
                return clash.factors != Factors::Certain;
            }
        };
        let Some((known, expected)) = found.known().zip(quantity.dimension) else {
            return true;
        };
        if known == expected || found.factors == Factors::Numbers {
            return true;
        }
        let diagnostic = match self.alone(formula, quantity, expected) {
            Some(diagnostic) => diagnostic,
            None => {
                let text = quote(formula.text());
                let what = format!("`{text}` is {}{}", in_units(known), where_pure(found.factors));
                reported(found.factors, format!("{what}, {}", needed(quantity, expected)))
            }
        };
        let label = match expected {
            Dimension::NONE => "must be a pure number".to_owned(),
            _ => format!("must be in {expected}"),
        };
        self.report(diagnostic.at(span, label));
        found.factors != Factors::Certain
    }

    /// The message about an expression that is a single parameter.
    fn alone(
        &self,
        formula: &Formula,
        quantity: Quantity,
        expected: Dimension,
    ) -> Option<Diagnostic> {
        let name = formula.text().trim_start_matches(['-', ' ']).trim_end();
        let known = self.parameter(name)?;
        let unit = &known.unit.as_ref()?.text;
        let message = format!("`{name}` is in {unit}, {}", needed(quantity, expected));
        let diagnostic = Diagnostic::error(code::DIMENSION, message);
        let diagnostic = diagnostic.and_at(&known.span, format!("in {unit}"));
        Some(diagnostic.help("use another parameter, or correct the unit"))
    }

    /// The dimension of an expression, or the first clash of dimensions that was found in it.
    pub(super) fn dimension(&self, formula: &Formula) -> Result<Dimensioned, Clash> {
        let mut wrong = None;
        let found = formula
            .fold(|step| self.dimension_of_step(&step).map_err(|clash| wrong = Some(clash)).ok());
        let unknown = Dimensioned { dimension: None, factors: Factors::Numbers, is_number: false };
        wrong.map_or(Ok(found.unwrap_or(unknown)), Err)
    }

    fn dimension_of_step(&self, step: &Step<'_, Dimensioned>) -> Result<Dimensioned, Clash> {
        Ok(match *step {
            Step::Number(value) => Dimensioned::number(value),
            Step::Pi => Dimensioned::pure(Factors::Certain, true),
            Step::Symbol(name, _) => {
                let unit = self.parameter(name).and_then(|known| known.unit.as_ref());
                let dimension = unit.map(|unit| unit.dimension);
                Dimensioned { dimension, factors: Factors::Certain, is_number: false }
            }
            Step::Add(a, b) | Step::Sub(a, b) => a.sum(b)?,
            Step::Mul(a, b) => a.product(b, 1),
            Step::Div(a, b) => a.product(b, -1),
            Step::Neg(a) | Step::Call(Function::Abs, a) => a,
            Step::Power(a, exponent) => {
                let exponent = i8::try_from(exponent).unwrap_or(i8::MAX);
                let dimension = a.dimension.map(|dimension| dimension.to_power(exponent));
                Dimensioned { dimension, ..a }
            }
            Step::Call(Function::Sqrt, a) => a.root(),
            Step::Call(Function::RecipPositive, a) => {
                Dimensioned { dimension: a.dimension.map(|dimension| dimension.to_power(-1)), ..a }
            }
            Step::Call(Function::Sign, a) => Dimensioned::pure(Factors::Certain, a.is_number),
            Step::Call(Function::Sin | Function::Cos | Function::Tanh, a) | Step::Tan(a) => {
                a.of_number()?
            }
        })
    }

    /// Reports a vector whose components have different dimensions: its length would have no meaning.
    pub(super) fn same_dimension(&mut self, vector: &[Formula; 3], what: &str, span: &Span) {
        let certain = |formula: &Formula| {
            let found = self.dimension(formula).ok()?;
            found.known().filter(|_| found.factors == Factors::Certain)
        };
        let known: Vec<Dimension> = vector.iter().filter_map(certain).collect();
        if let [first, rest @ ..] = known.as_slice()
            && let Some(other) = rest.iter().find(|other| *other != first)
        {
            let message =
                format!("{what} has components {} and {}", in_units(*first), in_units(*other));
            self.report(
                Diagnostic::error(code::DIMENSION, message)
                    .at(span, "")
                    .help("give all components in the same unit, or all as pure numbers"),
            );
        }
    }
}
