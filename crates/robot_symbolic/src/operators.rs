//! The operators `+ - * /` and the unary minus for expressions; the right operand can be an integer.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::expr::Expr;

macro_rules! binary {
    ($trait:ident, $method:ident, $rule:ident) => {
        impl<'g> $trait for Expr<'g> {
            type Output = Expr<'g>;
            fn $method(self, other: Expr<'g>) -> Expr<'g> {
                debug_assert!(std::ptr::eq(self.graph(), other.graph()), "operands of two graphs");
                self.wrap(self.graph().$rule(self.id(), other.id()))
            }
        }
        impl<'g> $trait<i64> for Expr<'g> {
            type Output = Expr<'g>;
            fn $method(self, other: i64) -> Expr<'g> {
                self.$method(self.graph().integer(other))
            }
        }
    };
}

binary!(Add, add, add);
binary!(Sub, sub, sub);
binary!(Mul, mul, mul);
binary!(Div, div, div);

impl<'g> Neg for Expr<'g> {
    type Output = Expr<'g>;
    fn neg(self) -> Expr<'g> {
        self.wrap(self.graph().neg(self.id()))
    }
}

impl AddAssign for Expr<'_> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Expr<'_> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
