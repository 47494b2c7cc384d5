//! Folds over the steps of formulas.

use std::ops::Range;

use super::{Formula, Op};
use crate::graph::Function;
use crate::rational::Rational;

/// One step of a formula: a leaf, or an operation on the results for its operands.
#[derive(Clone, Debug)]
pub enum Step<'f, T> {
    /// A number that is not negative: a minus sign is a step of its own.
    Number(&'f Rational),
    /// π.
    Pi,
    /// A name, and its range of bytes in the formula's text.
    Symbol(&'f str, Range<usize>),
    /// a + b.
    Add(T, T),
    /// a − b.
    Sub(T, T),
    /// a · b.
    Mul(T, T),
    /// a / b.
    Div(T, T),
    /// −a.
    Neg(T),
    /// a to an integer power.
    Power(T, i32),
    /// A function applied to a.
    Call(Function, T),
    /// tan a.
    Tan(T),
}

impl Formula {
    /// Applies `step` to every step of the formula, operands before operations, and returns the result of the last one.
    /// Returns `None` if `step` returns `None` for one of the steps.
    pub fn fold<T>(&self, mut step: impl FnMut(Step<'_, T>) -> Option<T>) -> Option<T> {
        let mut stack: Vec<T> = vec![];
        for op in &self.ops {
            let next = match op {
                Op::Number(value) => Step::Number(value),
                Op::Pi => Step::Pi,
                Op::Symbol(span) => Step::Symbol(self.name(span), span.clone()),
                Op::Neg => Step::Neg(stack.pop()?),
                Op::Power(exponent) => Step::Power(stack.pop()?, *exponent),
                Op::Call(function) => Step::Call(*function, stack.pop()?),
                Op::Tan => Step::Tan(stack.pop()?),
                Op::Add | Op::Sub | Op::Mul | Op::Div => {
                    let (b, a) = (stack.pop()?, stack.pop()?);
                    match op {
                        Op::Add => Step::Add(a, b),
                        Op::Sub => Step::Sub(a, b),
                        Op::Mul => Step::Mul(a, b),
                        _ => Step::Div(a, b),
                    }
                }
            };
            stack.push(step(next)?);
        }
        stack.pop()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_come_operands_first() {
        let formula = Formula::parse("-2*l1^3/sin(pi - x) + tan(y)").unwrap();
        let text = formula.fold(|step| {
            Some(match step {
                Step::Number(value) => value.to_string(),
                Step::Pi => "pi".to_owned(),
                Step::Symbol(name, span) => {
                    assert_eq!(formula.text().get(span), Some(name));
                    name.to_owned()
                }
                Step::Add(a, b) => format!("[{a} + {b}]"),
                Step::Sub(a, b) => format!("[{a} - {b}]"),
                Step::Mul(a, b) => format!("[{a} * {b}]"),
                Step::Div(a, b) => format!("[{a} / {b}]"),
                Step::Neg(a) => format!("[- {a}]"),
                Step::Power(a, exponent) => format!("[{a} ^ {exponent}]"),
                Step::Call(function, a) => format!("{}[{a}]", function.name()),
                Step::Tan(a) => format!("tan[{a}]"),
            })
        });
        let expected = "[[[[- 2] * [l1 ^ 3]] / sin[[pi - x]]] + tan[y]]";
        assert_eq!(text.as_deref(), Some(expected));
        assert_eq!(formula.fold(|_| None::<()>), None);
    }
}
