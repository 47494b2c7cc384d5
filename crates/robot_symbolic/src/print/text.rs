//! Infix text of expressions.

use super::{Level, MAX_OPERATIONS, Piece, TooLarge, as_power, number, write};
use crate::expr::{Expr, View};
use crate::number::Number;

/// Writes an expression as infix text with the structure in which it was built, and with the fewest parentheses that
/// preserve this structure.
///
/// ```
/// use robot_symbolic::{Graph, print};
/// let graph = Graph::new();
/// let expr = graph.parse("-(a + b)*sin(q1)^2/(2*c) + (a - (b - c))").unwrap();
/// let text = print::to_text(expr)?;
/// assert_eq!(text, "a - (b - c) - (a + b)*sin(q1)^2/(2*c)");
/// assert_eq!(graph.parse(&text).unwrap(), expr);
/// # Ok::<(), print::TooLarge>(())
/// ```
///
/// # Errors
///
/// If the text would have more than [`MAX_OPERATIONS`] operations and operands.
pub fn to_text(expr: Expr<'_>) -> Result<String, TooLarge> {
    to_text_limited(expr, MAX_OPERATIONS)
}

/// Like [`to_text`], with a given limit.
///
/// # Errors
///
/// If the text would have more than `limit` operations and operands.
pub fn to_text_limited(expr: Expr<'_>, limit: u64) -> Result<String, TooLarge> {
    write(expr, limit, notation)
}

fn notation(expr: Expr<'_>) -> (Level, Vec<Piece<'_>>) {
    let operand = Piece::Operand;
    match expr.view() {
        View::Number(number) => {
            let (text, level) = number::magnitude_text(&number);
            (level, vec![Piece::Text(text.into())])
        }
        View::Pi => (Level::Atom, vec![Piece::Text("pi".into())]),
        View::Symbol(symbol) => {
            let name = expr.graph().symbol_name(symbol);
            (Level::Atom, vec![Piece::Text(name.into())])
        }
        View::Add(a, b) => {
            let (a, b) = if is_sum(b) && !is_sum(a) { (b, a) } else { (a, b) };
            (Level::Sum, infix(a, Level::Sum, " + ", b, Level::Product))
        }
        View::Sub(a, b) => (Level::Sum, infix(a, Level::Sum, " - ", b, Level::Product)),
        View::Neg(x) => match x.view() {
            View::Sub(a, b) => (Level::Sum, infix(b, Level::Sum, " - ", a, Level::Product)),
            _ => (Level::Sum, vec![Piece::Text("-".into()), operand(x, Level::Product)]),
        },
        View::Mul(a, b) => product(expr, a, b),
        View::Div(a, b) => (Level::Product, infix(a, Level::Product, "/", b, Level::Power)),
        View::Call(function, x) => {
            let open = Piece::Text(format!("{}(", function.name()).into());
            (Level::Atom, vec![open, operand(x, Level::Sum), Piece::Text(")".into())])
        }
    }
}

fn product<'g>(expr: Expr<'g>, a: Expr<'g>, b: Expr<'g>) -> (Level, Vec<Piece<'g>>) {
    let (base, exponent) = as_power(expr);
    if exponent > 1 {
        let power = Piece::Text(format!("^{exponent}").into());
        return (Level::Power, vec![Piece::Operand(base, Level::Atom), power]);
    }
    if let Some(divisor) = a.as_number().as_ref().and_then(unit_fraction) {
        let divisor = Piece::Text(format!("/{divisor}").into());
        return (Level::Product, vec![Piece::Operand(b, Level::Product), divisor]);
    }
    let (a, b) =
        if is_product(b) && !is_product(a) && a.as_number().is_none() { (b, a) } else { (a, b) };
    (Level::Product, infix(a, Level::Product, "*", b, Level::Power))
}

/// Returns `n` for the number `1/n` if it is printed as a fraction.
fn unit_fraction(number: &Number) -> Option<String> {
    let (text, level) = number::magnitude_text(number);
    text.strip_prefix("1/").filter(|_| level == Level::Product).map(str::to_owned)
}

fn infix<'g>(
    a: Expr<'g>,
    left: Level,
    sign: &'static str,
    b: Expr<'g>,
    right: Level,
) -> Vec<Piece<'g>> {
    vec![Piece::Operand(a, left), Piece::Text(sign.into()), Piece::Operand(b, right)]
}

fn is_sum(expr: Expr<'_>) -> bool {
    matches!(expr.view(), View::Add(..) | View::Sub(..))
}

fn is_product(expr: Expr<'_>) -> bool {
    matches!(expr.view(), View::Mul(..) | View::Div(..)) && as_power(expr).1 == 1
}
