//! The atoms of a polynomial: symbols, π, functions of canonical arguments, and sums in denominators.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::accumulator::{Term, Terms};
use super::monomial::{Factor, Monomial};
use super::terms;
use crate::expr::{Expr, View};
use crate::graph::{Function, Graph, Id, Node};
use crate::number::Number;

/// The terms that replace the square of an atom.
#[derive(Clone)]
pub(super) struct Square(pub(super) Rc<[Term]>);

/// What is known about the nodes of a graph that are atoms: the squares of some, and the terms of sums.
#[derive(Default)]
pub(crate) struct AtomTable {
    squares: FxHashMap<Id, Square>,
    sums: FxHashMap<Id, Rc<[Term]>>,
}

impl Graph {
    /// The terms that replace the square of a reducible atom.
    pub(super) fn square(&self, atom: Id) -> Square {
        let known = self.atoms().borrow().squares.get(&atom).cloned();
        known.unwrap_or_else(|| Square(Rc::from([])))
    }

    /// The cosine of the same angle as a sine; `None` for other nodes.
    pub(super) fn cosine_of(&self, sine: Id) -> Option<Id> {
        match self.node(sine) {
            Node::Call(Function::Sin, angle) => Some(self.intern(Node::Call(Function::Cos, angle))),
            _ => None,
        }
    }

    /// The terms of a sum that is an atom in denominators; `None` for other atoms.
    pub(super) fn sum_terms(&self, atom: Id) -> Option<Rc<[Term]>> {
        self.atoms().borrow().sums.get(&atom).cloned()
    }

    /// The first power of an atom.
    pub(super) fn factor(&self, atom: Id) -> Factor {
        let reducible = self.atoms().borrow().squares.contains_key(&atom);
        Factor::new(atom, reducible, 1)
    }

    /// The terms of a function of a canonical argument: a number, or a multiple of an atom.
    ///
    /// `argument` holds the terms of `canonical`.
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

    /// Returns `(c, x)` with the sum equal to `c x`, where `x` is an atom for denominators; no `x` if the sum is the
    /// number `c`.
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

    /// Stores the square of an atom if it is a sine, a root, or the absolute value of one term.
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
            // The argument can be a number, because the exact sines of multiples of π/6 and π/4 contain roots of
            // numbers.
            Node::Call(Function::Sqrt, x) => match self.as_number(x) {
                Some(number) => terms::constant(number),
                None if function == Function::Sqrt => argument.to_vec(),
                None => return,
            },
            Node::Call(Function::Abs, _) if function == Function::Abs => match argument {
                [(monomial, coefficient)] => match monomial.product(monomial) {
                    // A square that would itself have to be reduced is not used.
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

/// Splits an expression into `(c, x)` such that it equals `c x`, with the sign and the constant in `c`. There is no `x`
/// if the expression is the number `c`.
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
