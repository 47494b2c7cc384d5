//! The parts of a joint torque that are collected separately: inertia and gravity, friction, and the wrenches of the
//! tips.

use robot_symbolic::{Expr, Graph, Monomial, View};

use crate::layout::Order;

/// The physical origin of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// From inertia or gravity.
    Motion,
    /// From friction: with exactly one velocity, or with a function other than a sine or cosine.
    Friction,
    /// From the wrench of a tip: with one of its components.
    External,
}

/// The part to which a term belongs.
pub(super) fn of(monomial: &Monomial, order: &Order<'_>, graph: &Graph) -> Part {
    let mut rates = 0;
    let mut part = None;
    for factor in monomial.factors() {
        let atom: Expr<'_> = graph.expr(factor.atom());
        match atom.view() {
            View::Symbol(_) if order.is_wrench(atom) => return Part::External,
            View::Symbol(_) => {
                rates += order.derivative_order(atom) * factor.exponent().unsigned_abs();
            }
            View::Pi
            | View::Call(robot_symbolic::Function::Sin | robot_symbolic::Function::Cos, _) => {}
            _ => part = Some(Part::Friction),
        }
    }
    part.unwrap_or(match rates {
        1 => Part::Friction,
        _ => Part::Motion,
    })
}
