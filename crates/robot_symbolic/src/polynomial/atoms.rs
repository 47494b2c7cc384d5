//! The atoms of a polynomial: symbols, π, functions of canonical arguments, and the sums
//! in denominators.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::accumulator::{Term, Terms};
use super::monomial::{Factor, Monomial};
use super::terms;
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id, Node};
use crate::number::Number;

/// The terms that the square of an atom is replaced by.
#[derive(Clone)]
pub(super) struct Square(pub(super) Rc<[Term]>);

/// The nodes of a graph as atoms of polynomials.
#[derive(Default)]
pub(crate) struct AtomTable {
    squares: FxHashMap<Id, Square>,
    sums: FxHashMap<Id, Rc<[Term]>>,
}

impl Graph {
    /// The square of a reducible atom.
    pub(super) fn square(&self, atom: Id) -> Square {
        let known = self.atoms().borrow().squares.get(&atom).cloned();
        known.unwrap_or_else(|| Square(Rc::from([])))
    }

    /// The cosine of the angle of a sine.
    pub(super) fn cosine_of(&self, sine: Id) -> Option<Id> {
        match self.node(sine) {
            Node::Call(Function::Sin, angle) => Some(self.intern(Node::Call(Function::Cos, angle))),
            _ => None,
        }
    }

    /// The terms of a sum that is an atom of denominators.
    pub(super) fn sum_terms(&self, atom: Id) -> Option<Rc<[Term]>> {
        self.atoms().borrow().sums.get(&atom).cloned()
    }

    /// An atom to the first power.
    pub(super) fn factor(&self, atom: Id) -> Factor {
        let reducible = self.atoms().borrow().squares.contains_key(&atom);
        Factor::new(atom, reducible, 1)
    }

    /// The function of a canonical argument as terms: a number, or a multiple of an atom.
    ///
    /// `argument` holds the terms that `canonical` is made of.
    pub(super) fn call_terms(
        &self,
        function: Function,
        canonical: Expr<'_>,
        argument: &[Term],
    ) -> Terms {
        let (coefficient, atom) = split_multiple(canonical.apply(function));
        let Some(atom) = atom else {
            return terms::constant(coefficient);
        };
        self.register(atom, function, argument);
        vec![(Monomial::from_factor(self.factor(atom)), coefficient)]
    }

    /// The sum as an atom of denominators, and the number that the atom must be multiplied by to
    /// give the sum.
    pub(super) fn sum_atom(&self, sum: &[Term], canonical: Expr<'_>) -> (Number, Option<Id>) {
        let (coefficient, atom) = split_multiple(canonical);
        if let Some(atom) = atom {
            let scale = coefficient.recip();
            let terms: Rc<[Term]> =
                sum.iter().map(|(monomial, number)| (monomial.clone(), number * &scale)).collect();
            self.atoms().borrow_mut().sums.insert(atom, terms);
        }
        (coefficient, atom)
    }

    /// Notes the square of a sine, of a root, and of the absolute value of one term.
    fn register(&self, atom: Id, function: Function, argument: &[Term]) {
        if self.atoms().borrow().squares.contains_key(&atom) {
            return;
        }
        let square = match self.node(atom) {
            Node::Call(Function::Sin, _) => {
                let Some(cosine) = self.cosine_of(atom) else {
                    return;
                };
                let factor = Factor::new(cosine, false, 2);
                vec![
                    (Monomial::from_factor(factor), Number::integer(-1)),
                    (Monomial::one(), Number::integer(1)),
                ]
            }
            // The exact sines of multiples of π/6 and π/4 bring roots of numbers.
            Node::Call(Function::Sqrt, x) => match self.as_number(x) {
                Some(number) => terms::constant(number),
                None if function == Function::Sqrt => argument.to_vec(),
                None => return,
            },
            Node::Call(Function::Abs, _) if function == Function::Abs => match argument {
                [(monomial, coefficient)] => match monomial.product(monomial) {
                    // A square that would itself have to be reduced is left alone.
                    Some((square, false)) => vec![(square, coefficient * coefficient)],
                    _ => return,
                },
                _ => return,
            },
            _ => return,
        };
        let square = Square(square.into());
        self.atoms().borrow_mut().squares.insert(atom, square);
    }
}

/// `(c, x)` with the expression equal to `c x`, signs and constants taken out; no `x` if the
/// expression is the number `c`.
fn split_multiple(expr: Expr<'_>) -> (Number, Option<Id>) {
    if let Some(number) = expr.as_number() {
        return (number, None);
    }
    match expr.view() {
        View::Neg(x) => {
            let (coefficient, atom) = split_product(x);
            (-&coefficient, atom)
        }
        _ => split_product(expr),
    }
}

fn split_product(expr: Expr<'_>) -> (Number, Option<Id>) {
    match expr.view() {
        View::Mul(a, b) => match a.as_number() {
            Some(number) => (number, Some(b.id())),
            None => (Number::integer(1), Some(expr.id())),
        },
        _ => (Number::integer(1), Some(expr.id())),
    }
}
