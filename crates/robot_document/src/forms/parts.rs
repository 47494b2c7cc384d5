//! The parts of a joint torque that are collected apart: of inertia and gravity, of friction, of external wrenches.

use robot_symbolic::{Expr, Graph, Monomial, View};

use crate::layout::Order;

/// The physical origin of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// Of inertia and gravity.
    Motion,
    /// With one velocity, or with functions other than sines and cosines.
    Friction,
    /// With a component of a tip's wrench.
    External,
}

/// The part that a term belongs to.
pub(super) fn of(monomial: &Monomial, order: &Order<'_>, graph: &Graph) -> Part {
    let mut rates = 0;
    let mut part = None;
    for factor in monomial.factors() {
        let atom: Expr<'_> = graph.expr(factor.atom());
        match atom.view() {
            View::Symbol(_) if order.is_wrench(atom) => return Part::External,
            View::Symbol(_) => rates += order.rate(atom) * factor.exponent().unsigned_abs(),
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
