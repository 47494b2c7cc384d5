//! Printing of expressions with infix operators and parentheses.

use robot_symbolic::Function as Call;

use super::{Expression, Operator};

/// The spelling of the parts of expressions in a language.
pub trait Spelling {
    /// A constant, given by its absolute value.
    fn constant(&self, size: f64) -> String;

    /// A field of the model.
    fn field(&self, index: usize) -> String;

    /// The symbol of an operator, without spaces.
    fn operator(&self, operator: Operator) -> &'static str {
        match operator {
            Operator::Add => "+",
            Operator::Sub => "-",
            Operator::Mul => "*",
            Operator::Div => "/",
        }
    }

    /// The function that divides, in a language whose operator fails if the divisor is 0.
    fn division(&self) -> Option<&'static str> {
        None
    }

    /// a b + c
    fn mul_add(&self, operands: [String; 3]) -> String;

    /// A function of one argument.
    fn call(&self, function: Call, argument: String) -> String;
}

/// The precedence of the outermost operation of a text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Sign,
    Operand,
}

/// Prints an expression with exactly the parentheses that left-associative operators need.
#[must_use]
pub fn infix(expression: &Expression, spelling: &impl Spelling) -> String {
    text(expression, spelling).0
}

fn text(expression: &Expression, spelling: &impl Spelling) -> (String, Strength) {
    match expression {
        Expression::Constant(value) if value.is_sign_negative() => {
            (format!("-{}", spelling.constant(value.abs())), Strength::Sign)
        }
        Expression::Constant(value) => (spelling.constant(*value), Strength::Operand),
        Expression::Variable(name) => (name.clone(), Strength::Operand),
        Expression::Field(index) => (spelling.field(*index), Strength::Operand),
        Expression::Binary(operator, operands) => {
            let strength = match operator {
                Operator::Add | Operator::Sub => Strength::Sum,
                Operator::Mul | Operator::Div => Strength::Product,
            };
            let [left, right] = operands.each_ref();
            if expression.divides_by_a_variable()
                && let Some(function) = spelling.division()
            {
                let [left, right] = [left, right].map(|operand| text(operand, spelling).0);
                return (format!("{function}({left}, {right})"), Strength::Operand);
            }
            // The right operand must have a higher precedence: a - (b - c) is not (a - b) - c, and
            // a + (b + c) rounds differently from (a + b) + c.
            let left = bracketed(left, spelling, |found| found >= strength);
            let right = bracketed(right, spelling, |found| found > strength);
            (format!("{left} {} {right}", spelling.operator(*operator)), strength)
        }
        Expression::Negative(operand) => {
            let operand = bracketed(operand, spelling, |found| found == Strength::Operand);
            (format!("-{operand}"), Strength::Sign)
        }
        Expression::MulAdd(operands) => {
            let operands = operands.each_ref().map(|operand| text(operand, spelling).0);
            (spelling.mul_add(operands), Strength::Operand)
        }
        Expression::Call(function, argument) => {
            (spelling.call(*function, text(argument, spelling).0), Strength::Operand)
        }
    }
}

fn bracketed(
    expression: &Expression,
    spelling: &impl Spelling,
    stands: impl Fn(Strength) -> bool,
) -> String {
    let (text, strength) = text(expression, spelling);
    if stands(strength) { text } else { format!("({text})") }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Plain;

    impl Spelling for Plain {
        fn constant(&self, size: f64) -> String {
            format!("{size:?}")
        }

        fn field(&self, index: usize) -> String {
            format!("k{index}")
        }

        fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
            format!("fma({a}, {b}, {c})")
        }

        fn call(&self, function: Call, argument: String) -> String {
            format!("{}({argument})", function.name())
        }
    }

    fn variable(name: &str) -> Expression {
        Expression::Variable(name.to_owned())
    }

    fn binary(operator: Operator, left: Expression, right: Expression) -> Expression {
        Expression::Binary(operator, Box::new([left, right]))
    }

    #[test]
    fn brackets_keep_the_order_of_operations() {
        let [a, b, c] = ["a", "b", "c"].map(variable);
        for (expression, expected) in [
            (
                binary(Operator::Sub, a.clone(), binary(Operator::Sub, b.clone(), c.clone())),
                "a - (b - c)",
            ),
            (
                binary(Operator::Add, a.clone(), binary(Operator::Add, b.clone(), c.clone())),
                "a + (b + c)",
            ),
            (
                binary(Operator::Add, binary(Operator::Add, a.clone(), b.clone()), c.clone()),
                "a + b + c",
            ),
            (
                binary(Operator::Mul, binary(Operator::Add, a.clone(), b.clone()), c.clone()),
                "(a + b) * c",
            ),
            (
                binary(Operator::Div, a.clone(), binary(Operator::Mul, b.clone(), c.clone())),
                "a / (b * c)",
            ),
            (binary(Operator::Sub, a.clone(), Expression::Negative(Box::new(b.clone()))), "a - -b"),
            (
                Expression::Negative(Box::new(binary(Operator::Mul, a.clone(), b.clone()))),
                "-(a * b)",
            ),
            (Expression::Negative(Box::new(Expression::Negative(Box::new(a.clone())))), "-(-a)"),
            (binary(Operator::Mul, Expression::Constant(-2.0), a.clone()), "-2.0 * a"),
            (
                Expression::MulAdd(Box::new([
                    a,
                    binary(Operator::Add, b, c),
                    Expression::Field(3),
                ])),
                "fma(a, b + c, k3)",
            ),
        ] {
            assert_eq!(infix(&expression, &Plain), expected);
        }
    }
}
