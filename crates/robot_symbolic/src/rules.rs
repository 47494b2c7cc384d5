//! The local rules that the graph applies when it builds sums, products and quotients.
//!
//! Every rule looks at one operation and at most two levels of its operands. No rule makes an expression larger,
//! distributes a product over a sum or flattens a sum, because a recursion's order of additions is what makes its code
//! cheap. The rules do the following:
//!
//! - Constants fold: `x + 0 = x`, `1 x = x`, `0 x = 0`, `c₁ (c₂ x) = (c₁ c₂) x`, `(c₁ x) (c₂ y) = (c₁ c₂) (x y)` and
//!   `c₁ x + c₂ x = (c₁ + c₂) x`.
//! - Signs move outward: `(−x) y = −(x y)` and `(−x) + y = y − x`; numbers are never negative.
//! - Operands of sums and products are ordered. Of `a − b` and `b − a` only one is stored, and the other is its
//!   negative, so both use the same node.
//! - A term that was just added is removed again: `(x + y) − y = x` and `(x − y) + y = x`.
//! - Quotients and roots cancel: `x / c = (1/c) x`, `(x y) / y = x` and `√x √x = x`.

use crate::graph::{Folding, Function, Graph, Id, Node};
use crate::number::Number;

impl Graph {
    pub(crate) fn add(&self, a: Id, b: Id) -> Id {
        if let (Node::Neg(x), Node::Neg(y)) = (self.node(a), self.node(b)) {
            return self.neg(self.add(x, y));
        }
        if let Node::Neg(y) = self.node(b) {
            return self.sub(a, y);
        }
        if let Node::Neg(x) = self.node(a) {
            return self.sub(b, x);
        }
        if let Some(sum) = self.merge_terms(a, b, false) {
            return sum;
        }
        // (x − y) + y, y + (x − y)
        for (sum, term) in [(a, b), (b, a)] {
            if let Node::Sub(x, y) = self.node(sum)
                && y == term
            {
                return x;
            }
        }
        self.intern(Node::Add(a.min(b), a.max(b)))
    }

    pub(crate) fn sub(&self, a: Id, b: Id) -> Id {
        if a == b {
            return self.intern_number(&Number::integer(0));
        }
        if let Node::Neg(y) = self.node(b) {
            return self.add(a, y);
        }
        if let Node::Neg(x) = self.node(a) {
            return self.neg(self.add(x, b));
        }
        if let Some(difference) = self.merge_terms(a, b, true) {
            return difference;
        }
        match (self.node(a), self.node(b)) {
            (Node::Add(x, y), _) if y == b => return x,
            (Node::Add(x, y), _) if x == b => return y,
            (Node::Sub(x, y), _) if x == b => return self.neg(y),
            (_, Node::Add(x, y)) if x == a => return self.neg(y),
            (_, Node::Add(x, y)) if y == a => return self.neg(x),
            (_, Node::Sub(x, y)) if x == a => return y,
            _ => {}
        }
        if a < b { self.intern(Node::Sub(a, b)) } else { self.neg(self.intern(Node::Sub(b, a))) }
    }

    /// Returns `a ± b` if one is zero, both are constants or both are multiples of the same expression; otherwise
    /// `None`.
    fn merge_terms(&self, a: Id, b: Id, subtract: bool) -> Option<Id> {
        let operation = if subtract { Folding::Sub } else { Folding::Add };
        if let Some(constant) = self.fold(operation, a, b) {
            return Some(constant);
        }
        if self.is_zero(a) {
            return Some(if subtract { self.neg(b) } else { b });
        }
        if self.is_zero(b) {
            return Some(a);
        }
        let ((p, x), (q, y)) = (self.split_coefficient(a), self.split_coefficient(b));
        if x != y {
            return None;
        }
        let one = self.intern_number(&Number::integer(1));
        let coefficient = self.fold(operation, p.unwrap_or(one), q.unwrap_or(one))?;
        Some(self.mul(coefficient, x))
    }

    fn is_zero(&self, id: Id) -> bool {
        matches!(self.node(id), Node::Number(_))
            && self.as_number(id).is_some_and(|number| number.is_zero())
    }

    /// Splits `c x` with a constant `c` into `(c, x)`; the first entry is `None` for other expressions.
    fn split_coefficient(&self, id: Id) -> (Option<Id>, Id) {
        match self.node(id) {
            Node::Mul(a, b) if self.is_number(a) => (Some(a), b),
            _ => (None, id),
        }
    }

    pub(crate) fn neg(&self, a: Id) -> Id {
        match self.node(a) {
            Node::Neg(x) => x,
            _ if self.is_zero(a) => a,
            _ => self.intern(Node::Neg(a)),
        }
    }

    pub(crate) fn mul(&self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (Node::Neg(x), Node::Neg(y)) => return self.mul(x, y),
            (Node::Neg(x), _) => return self.neg(self.mul(x, b)),
            (_, Node::Neg(y)) => return self.neg(self.mul(a, y)),
            _ => {}
        }
        if let Some(constant) = self.fold(Folding::Mul, a, b) {
            return constant;
        }
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), _) => self.scale(&x, a, b),
            (None, Some(y)) => self.scale(&y, b, a),
            (None, None) => self.mul_expressions(a, b),
        }
    }

    /// Returns `c x` for a nonnegative constant `c` with the value `number`.
    fn scale(&self, number: &Number, c: Id, x: Id) -> Id {
        if number.is_zero() {
            return c;
        }
        if number.is_one() {
            return x;
        }
        match self.split_coefficient(x) {
            (Some(inner), y) => self.mul(self.mul(c, inner), y),
            (None, _) => self.intern(Node::Mul(c, x)),
        }
    }

    fn mul_expressions(&self, a: Id, b: Id) -> Id {
        if let Node::Call(Function::Sqrt, x) = self.node(a)
            && a == b
        {
            return x;
        }
        // (c₁ x) (c₂ y) = (c₁ c₂) (x y)
        let ((p, x), (q, y)) = (self.split_coefficient(a), self.split_coefficient(b));
        if let (Some(p), Some(q)) = (p, q) {
            return self.mul(self.mul(p, q), self.mul(x, y));
        }
        // (x / y) y = x. The product x (1 / y) is kept, because one reciprocal can serve many products.
        for (x, quotient) in [(a, b), (b, a)] {
            match self.node(quotient) {
                Node::Div(numerator, denominator) if denominator == x => return numerator,
                Node::Call(Function::RecipPositive, denominator) if denominator == x => {
                    return self.intern_number(&Number::integer(1));
                }
                _ => {}
            }
        }
        self.intern(Node::Mul(a.min(b), a.max(b)))
    }

    pub(crate) fn div(&self, a: Id, b: Id) -> Id {
        if let Some(divisor) = self.as_number(b) {
            return self.mul(self.intern_number(&divisor.recip()), a);
        }
        if a == b {
            return self.intern_number(&Number::integer(1));
        }
        match (self.node(a), self.node(b)) {
            (Node::Neg(x), Node::Neg(y)) => return self.div(x, y),
            (Node::Neg(x), _) => return self.neg(self.div(x, b)),
            (_, Node::Neg(y)) => return self.neg(self.div(a, y)),
            (Node::Mul(x, y), _) if y == b => return x,
            (Node::Mul(x, y), _) if x == b => return y,
            _ => {}
        }
        if self.is_zero(a) {
            return a;
        }
        self.intern(Node::Div(a, b))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Graph, Rational};

    #[test]
    fn constants_fold_exactly() {
        let g = Graph::new();
        let tenth = g.number(Rational::new(1, 10).unwrap());
        let fifth = g.number(Rational::new(1, 5).unwrap());
        assert_eq!(tenth + fifth, g.number(Rational::new(3, 10).unwrap()));
        assert_eq!(tenth * 10, g.one());
        assert_eq!((g.one() / 3) * 3, g.one());
        assert!((g.one() / 0).as_number().unwrap().to_f64().is_nan());
    }

    #[test]
    fn sums_order_and_share_their_negatives() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        assert_eq!(x + y, y + x);
        assert_eq!(x - y, -(y - x));
        assert_eq!(x - x, g.zero());
        assert_eq!(x + x, x * 2);
        assert_eq!(x * 3 - x * 2, x);
        assert_eq!(-x - y, -(x + y));
        assert_eq!(x + g.zero(), x);
        assert_eq!(g.zero() - x, -x);
    }

    #[test]
    fn what_was_added_is_taken_off() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        assert_eq!((x + y) - y, x);
        assert_eq!((x + y) - x, y);
        assert_eq!((x - y) + y, x);
        assert_eq!((x - y) - x, -y);
        assert_eq!(x - (x + y), -y);
        assert_eq!(x - (x - y), y);
        assert_eq!(y + (x - y), x);
    }

    #[test]
    fn products_hoist_signs_and_constants() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        assert_eq!((-x) * y, -(x * y));
        assert_eq!((-x) * (-y), x * y);
        assert_eq!((x * 2) * 3, x * 6);
        assert_eq!(x * -3, -(x * 3));
        assert_eq!(x * g.zero(), g.zero());
        assert_eq!(x.sqrt() * x.sqrt(), x);
    }

    #[test]
    fn quotients_cancel_single_factors() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x"), g.symbol("y"));
        assert_eq!((x * y) / y, x);
        assert_eq!((x / y) * y, x);
        assert_eq!(x / x, g.one());
        assert_eq!((g.one() / y) * y, g.one());
        assert_eq!(x / 4, x * g.number(Rational::new(1, 4).unwrap()));
        assert_eq!((-x) / y, -(x / y));
        assert_eq!(x.powi(-2), g.one() / (x * x));
        assert_eq!(x.powi(5), (x * x) * (x * x) * x);
        assert_eq!(x.powi(0), g.one());
    }
}
