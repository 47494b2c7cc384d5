//! Expressions as they are built.

use super::super::{Level, MAX_OPERATIONS, Piece, TooLarge, as_power, write};
use super::{LatexStyle, Trigonometry, raised};
use crate::expr::{Expr, View};
use crate::graph::Function;
use crate::number::Number;
use crate::print::number;

const PARENTHESES: [&str; 2] = [r"\left(", r"\right)"];

/// The LaTeX of an expression as it is built, with the fewest parentheses that keep its value.
///
/// # Errors
///
/// Where it would have more than [`MAX_OPERATIONS`] operations.
pub fn to_latex(expr: Expr<'_>, style: &LatexStyle<'_>) -> Result<String, TooLarge> {
    to_latex_limited(expr, style, MAX_OPERATIONS)
}

/// As [`to_latex`], with a limit of the caller's.
///
/// # Errors
///
/// Where it would have more than `limit` operations.
pub fn to_latex_limited(
    expr: Expr<'_>,
    style: &LatexStyle<'_>,
    limit: u64,
) -> Result<String, TooLarge> {
    write(expr, limit, PARENTHESES, |expr| notation(expr, style))
}

/// The LaTeX of a power of a sine or cosine; of anything else the LaTeX as it is.
pub(super) fn circular_power(
    call: Expr<'_>,
    exponent: u32,
    style: &LatexStyle<'_>,
) -> Result<String, TooLarge> {
    write(call, MAX_OPERATIONS, PARENTHESES, |expr| match expr.view() {
        View::Call(function, angle) if expr == call => circular(function, angle, exponent, style),
        _ => notation(expr, style),
    })
}

/// The absolute value of a number.
pub(super) fn magnitude(value: &Number) -> String {
    let (text, level) = number::magnitude_text(value);
    match (text.split_once('/'), text.split_once('e')) {
        (Some((numerator, denominator)), _) if level == Level::Product => {
            format!(r"\frac{{{numerator}}}{{{denominator}}}")
        }
        (_, Some((digits, exponent))) => format!(r"{digits} \cdot 10^{{{exponent}}}"),
        (Some(_), _) => r"\mathrm{NaN}".to_owned(),
        _ => text,
    }
}

fn text<'g>(latex: impl Into<std::borrow::Cow<'static, str>>) -> Piece<'g> {
    Piece::Text(latex.into())
}

fn notation<'g>(expr: Expr<'g>, style: &LatexStyle<'_>) -> (Level, Vec<Piece<'g>>) {
    let operand = Piece::Operand;
    match expr.view() {
        View::Number(number) => {
            let latex = magnitude(&number);
            let level = if latex.contains('\\') { Level::Product } else { Level::Atom };
            (level, vec![text(latex)])
        }
        View::Pi => (Level::Atom, vec![text(r"\pi")]),
        View::Symbol(symbol) => {
            let latex = style.symbol(&expr.graph().symbol_name(symbol));
            // A superscript of its own asks for parentheses under another.
            let level = if latex.contains(['^', '\'']) { Level::Power } else { Level::Atom };
            (level, vec![text(latex)])
        }
        View::Add(a, b) => {
            (Level::Sum, vec![operand(a, Level::Sum), text(" + "), operand(b, Level::Sum)])
        }
        View::Sub(a, b) => {
            (Level::Sum, vec![operand(a, Level::Sum), text(" - "), operand(b, Level::Product)])
        }
        View::Neg(x) => match x.view() {
            View::Sub(a, b) => {
                (Level::Sum, vec![operand(b, Level::Sum), text(" - "), operand(a, Level::Product)])
            }
            _ => (Level::Sum, vec![text("-"), operand(x, Level::Product)]),
        },
        View::Mul(a, b) => product(expr, a, b, style),
        View::Div(a, b) => {
            let pieces = vec![
                text(r"\frac{"),
                operand(a, Level::Sum),
                text("}{"),
                operand(b, Level::Sum),
                text("}"),
            ];
            (Level::Product, pieces)
        }
        View::Call(function, argument) => call(function, argument, 1, style),
    }
}

fn product<'g>(
    expr: Expr<'g>,
    a: Expr<'g>,
    b: Expr<'g>,
    style: &LatexStyle<'_>,
) -> (Level, Vec<Piece<'g>>) {
    let (base, exponent) = as_power(expr);
    if exponent > 1 {
        if let View::Call(function @ (Function::Sin | Function::Cos), angle) = base.view() {
            return call(function, angle, exponent, style);
        }
        let pieces = vec![Piece::Operand(base, Level::Atom), text(format!("^{{{exponent}}}"))];
        return (Level::Power, pieces);
    }
    let (a, b) = if leads_with_number(b) && !leads_with_number(a) { (b, a) } else { (a, b) };
    let apart = ends_open(a, style) || leads_with_number(b);
    let sign = if apart { r" \cdot " } else { " " };
    let pieces =
        vec![Piece::Operand(a, Level::Product), text(sign), Piece::Operand(b, Level::Product)];
    (Level::Product, pieces)
}

/// Whether a product begins with a number, which must not follow another factor.
fn leads_with_number(expr: Expr<'_>) -> bool {
    let mut first = expr;
    while let View::Mul(a, _) = first.view() {
        first = a;
    }
    first.as_number().is_some()
}

/// Whether the LaTeX of a factor ends with an angle without parentheses, so that the next factor
/// would seem to belong to the angle.
fn ends_open(expr: Expr<'_>, style: &LatexStyle<'_>) -> bool {
    let mut last = expr;
    loop {
        let base = as_power(last).0;
        match base.view() {
            View::Mul(_, b) => last = b,
            View::Call(Function::Sin | Function::Cos, angle) => {
                return style.trigonometry == Trigonometry::Named && angle.as_symbol().is_some();
            }
            _ => return false,
        }
    }
}

/// A function of an argument to a power.
fn call<'g>(
    function: Function,
    argument: Expr<'g>,
    exponent: u32,
    style: &LatexStyle<'_>,
) -> (Level, Vec<Piece<'g>>) {
    let inside = Piece::Operand(argument, Level::Sum);
    match function {
        Function::Sin | Function::Cos => circular(function, argument, exponent, style),
        Function::Sqrt => (Level::Atom, vec![text(r"\sqrt{"), inside, text("}")]),
        Function::Abs => (Level::Atom, vec![text(r"\left|"), inside, text(r"\right|")]),
        Function::Sign => {
            (Level::Atom, vec![text(r"\operatorname{sgn}\left("), inside, text(r"\right)")])
        }
        Function::Tanh => (Level::Atom, vec![text(r"\tanh\left("), inside, text(r"\right)")]),
        Function::RecipPositive => (Level::Atom, vec![text(r"\frac{1}{"), inside, text("}")]),
    }
}

fn circular<'g>(
    function: Function,
    angle: Expr<'g>,
    exponent: u32,
    style: &LatexStyle<'_>,
) -> (Level, Vec<Piece<'g>>) {
    let level = if exponent == 1 { Level::Atom } else { Level::Power };
    let letter = if function == Function::Sin { "s" } else { "c" };
    let single = angle.as_symbol().is_some();
    let inside = Piece::Operand(angle, Level::Sum);
    let pieces = match style.trigonometry {
        Trigonometry::Named => {
            let name = raised(&format!(r"\{}", function.name()), exponent);
            if single {
                // A superscript on the angle's symbol would read as the function's.
                return (Level::Power, vec![text(format!("{name} ")), inside]);
            }
            vec![text(format!(r"{name}\left(")), inside, text(r"\right)")]
        }
        Trigonometry::Paper => {
            let name = raised(letter, exponent);
            if single {
                return (Level::Power, vec![text(name), inside]);
            }
            vec![text(format!(r"{name}\left(")), inside, text(r"\right)")]
        }
        Trigonometry::Short => {
            let power = if exponent == 1 { String::new() } else { format!("^{{{exponent}}}") };
            match joint_numbers(angle) {
                Some(joints) if joints.len() == 1 => {
                    vec![text(format!("{letter}_{joints}{power}"))]
                }
                Some(joints) => vec![text(format!("{letter}_{{{joints}}}{power}"))],
                None => {
                    vec![text(format!("{letter}_{{")), inside, text(format!("}}{power}"))]
                }
            }
        }
    };
    (level, pieces)
}

/// `23` for q2 + q3, `2-3` for q2 − q3, `2,10` where a joint has two digits.
fn joint_numbers(angle: Expr<'_>) -> Option<String> {
    let mut joints: Vec<(bool, u32)> = vec![];
    let mut pending = vec![(angle, false)];
    while let Some((expr, negative)) = pending.pop() {
        match expr.view() {
            View::Add(a, b) => pending.extend([(b, negative), (a, negative)]),
            View::Sub(a, b) => pending.extend([(b, !negative), (a, negative)]),
            View::Neg(a) => pending.push((a, !negative)),
            View::Symbol(symbol) => {
                let name = expr.graph().symbol_name(symbol);
                let digits = name.strip_prefix('q')?;
                let joint = digits.parse().ok().filter(|joint: &u32| joint.to_string() == digits);
                joints.push((negative, joint?));
            }
            _ => return None,
        }
        if pending.len() + joints.len() > 64 {
            return None;
        }
    }
    joints.sort_unstable();
    // `s_{12}` is the sine of q1 + q2.
    if let [(_, 10..)] | [(false, 10..), (true, _), ..] = joints.as_slice() {
        return None;
    }
    let apart = joints.iter().any(|(_, joint)| *joint > 9);
    let mut text = String::new();
    for (negative, joint) in joints {
        match (negative, text.is_empty()) {
            (true, _) => text.push('-'),
            (false, false) if apart => text.push(','),
            _ => {}
        }
        text.push_str(&joint.to_string());
    }
    Some(text)
}
