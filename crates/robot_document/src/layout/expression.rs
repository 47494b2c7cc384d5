//! The layout of expressions in the structure in which they were built, with the fewest parentheses that keep their
//! value.

use robot_model::signs::FunctionName;
use robot_model::variable::JointVariable;
use robot_symbolic::print::{MAX_OPERATIONS, Magnitude, as_power, check_length};
use robot_symbolic::{Expr, Function, Number, View};
use rustc_hash::FxHashSet;

use super::Trigonometry;
use super::math::{Fence, Math, Script};
use super::symbols::SymbolTable;
use crate::error::Error;

/// The deepest nesting of fences, fractions, roots and indices. It is limited because the printers walk the layout
/// recursively.
const MAX_DEPTH: usize = 200;

/// The precedence of a part of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Power,
    Atom,
}

/// A step in laying out an expression.
enum Step<'g> {
    /// A piece to the right of the preceding ones.
    Piece(Math),
    /// An operand, in parentheses if it binds less tightly than the level.
    Operand(Expr<'g>, Level),
    /// The start of an inner row.
    Open,
    /// The end of an inner row, which becomes one piece.
    Close(Whole),
    /// A power of the preceding piece.
    Raise(u32),
}

/// What an inner row becomes.
#[derive(Clone, Copy)]
enum Whole {
    Fenced(Fence),
    Root,
    /// The numerator of a fraction, whose denominator is the next row.
    Numerator,
    /// The denominator of a fraction, whose numerator is the preceding piece.
    Denominator,
    /// The lower index of a letter, with an exponent as the upper index.
    IndexOf(char, u32),
}

/// Lays out expressions with the symbols of a table.
#[derive(Clone, Copy)]
pub(super) struct Expressions<'t>(pub(super) &'t SymbolTable);

impl Expressions<'_> {
    /// The pieces of an expression.
    pub(super) fn pieces(self, expr: Expr<'_>) -> Result<Vec<Math>, Error> {
        check_length(expr, MAX_OPERATIONS)?;
        self.set(vec![Step::Operand(expr, Level::Sum)])
    }

    /// The pieces of a power of a function that is printed by its name; the exponent follows the name.
    pub(super) fn named_power(
        self,
        function: Function,
        argument: Expr<'_>,
        exponent: u32,
    ) -> Result<Vec<Math>, Error> {
        check_length(argument, MAX_OPERATIONS)?;
        self.set(self.call(function, argument, exponent).1)
    }

    fn set(self, steps: Vec<Step<'_>>) -> Result<Vec<Math>, Error> {
        let mut row: Vec<Math> = vec![];
        let mut outer: Vec<Vec<Math>> = vec![];
        let mut pending = steps;
        pending.reverse();
        while let Some(step) = pending.pop() {
            match step {
                Step::Piece(piece) => row.push(piece),
                Step::Operand(expr, least) => {
                    let (level, steps) = self.steps(expr);
                    if level < least {
                        pending.push(Step::Close(Whole::Fenced(Fence::Parentheses)));
                    }
                    pending.extend(steps.into_iter().rev());
                    if level < least {
                        pending.push(Step::Open);
                    }
                }
                Step::Open if outer.len() >= MAX_DEPTH => {
                    return Err(Error::TooDeep { limit: MAX_DEPTH });
                }
                Step::Open => outer.push(std::mem::take(&mut row)),
                Step::Close(whole) => {
                    let inside = std::mem::replace(&mut row, outer.pop().unwrap_or_default());
                    close(&mut row, whole, Math::row(inside));
                }
                Step::Raise(exponent) => raise(&mut row, exponent),
            }
        }
        Ok(row)
    }

    fn steps<'g>(self, expr: Expr<'g>) -> (Level, Vec<Step<'g>>) {
        let operand = Step::Operand;
        match expr.view() {
            View::Number(number) => {
                let (level, pieces) = magnitude(&number);
                (level, pieces.into_iter().map(Step::Piece).collect())
            }
            View::Pi => (Level::Atom, vec![Step::Piece(Math::Letter('π'))]),
            View::Symbol(symbol) => {
                let look = self.0.look(&expr.graph().symbol_name(symbol));
                let is_fenced = self.0.is_fenced_in_powers(&look);
                let level = if is_fenced { Level::Power } else { Level::Atom };
                (level, vec![Step::Piece(look)])
            }
            View::Add(a, b) => (Level::Sum, infix(a, Level::Sum, '+', b, Level::Sum)),
            View::Sub(a, b) => (Level::Sum, infix(a, Level::Sum, '-', b, Level::Product)),
            View::Neg(x) => match x.view() {
                View::Sub(a, b) => (Level::Sum, infix(b, Level::Sum, '-', a, Level::Product)),
                _ => (Level::Sum, vec![sign('-'), operand(x, Level::Product)]),
            },
            View::Mul(a, b) => self.product(expr, a, b),
            View::Div(a, b) => {
                let steps = vec![
                    Step::Open,
                    operand(a, Level::Sum),
                    Step::Close(Whole::Numerator),
                    Step::Open,
                    operand(b, Level::Sum),
                    Step::Close(Whole::Denominator),
                ];
                (Level::Product, steps)
            }
            View::Call(function, argument) => self.call(function, argument, 1),
        }
    }

    fn product<'g>(self, expr: Expr<'g>, a: Expr<'g>, b: Expr<'g>) -> (Level, Vec<Step<'g>>) {
        let (base, exponent) = as_power(expr);
        if exponent > 1 {
            if let View::Call(function, argument) = base.view()
                && FunctionName::of(function).is_some()
            {
                return self.call(function, argument, exponent);
            }
            return (Level::Power, vec![Step::Operand(base, Level::Atom), Step::Raise(exponent)]);
        }
        let [a, b] = in_order_of_print(a, b);
        let mut steps = vec![Step::Operand(a, Level::Product)];
        if self.ends_open(a) || leads_with_number(b) {
            steps.push(sign('·'));
        }
        steps.push(Step::Operand(b, Level::Product));
        (Level::Product, steps)
    }

    /// Whether a factor ends with an angle without parentheses, so that the next factor would look like a part of the
    /// angle.
    fn ends_open(self, expr: Expr<'_>) -> bool {
        let mut last = expr;
        loop {
            let base = as_power(last).0;
            match base.view() {
                View::Mul(a, b) => last = in_order_of_print(a, b)[1],
                View::Call(Function::Sin | Function::Cos, angle) => {
                    return self.0.trigonometry() == Trigonometry::Named
                        && angle.as_symbol().is_some();
                }
                _ => return false,
            }
        }
    }

    /// Applies a function to an argument; the exponent, if there is one, follows the name of the function.
    fn call<'g>(
        self,
        function: Function,
        argument: Expr<'g>,
        exponent: u32,
    ) -> (Level, Vec<Step<'g>>) {
        let within = |whole: Whole| {
            vec![Step::Open, Step::Operand(argument, Level::Sum), Step::Close(whole)]
        };
        let steps = match function {
            Function::Sin | Function::Cos => return self.circular(function, argument, exponent),
            Function::Sqrt => within(Whole::Root),
            Function::Abs => within(Whole::Fenced(Fence::Bars)),
            Function::Sign => {
                return applied(Math::Function(FunctionName::Sign), argument, exponent);
            }
            Function::Tanh => {
                return applied(
                    Math::Function(FunctionName::HyperbolicTangent),
                    argument,
                    exponent,
                );
            }
            Function::RecipPositive => {
                let mut steps = vec![Step::Piece(Math::integer(1))];
                steps.extend(within(Whole::Denominator));
                steps
            }
        };
        (Level::Atom, steps)
    }

    fn circular<'g>(
        self,
        function: Function,
        angle: Expr<'g>,
        exponent: u32,
    ) -> (Level, Vec<Step<'g>>) {
        let is_sine = function == Function::Sin;
        let letter = if is_sine { 's' } else { 'c' };
        let name = match self.0.trigonometry() {
            // The index 2 would be that of the joint position q2.
            Trigonometry::Short if angle.as_number().is_none() => {
                let level = if exponent == 1 { Level::Atom } else { Level::Power };
                return (level, index_of(letter, angle, exponent));
            }
            Trigonometry::Paper => Math::Letter(letter),
            Trigonometry::Named | Trigonometry::Short => {
                Math::Function(if is_sine { FunctionName::Sine } else { FunctionName::Cosine })
            }
        };
        if angle.as_symbol().is_none() {
            return match joints(angle) {
                Some(joints) => applied_to(name, in_order(angle, &joints), exponent),
                None => applied(name, angle, exponent),
            };
        }
        // The whole counts as a power, because an upper index after the angle could be read as an exponent of the
        // function.
        let mut steps = raised_name(name, exponent);
        steps.push(Step::Operand(angle, Level::Sum));
        (Level::Power, steps)
    }
}

/// The layout of the absolute value of a number.
pub(super) fn magnitude_pieces(number: &Number) -> Vec<Math> {
    magnitude(number).1
}

fn magnitude(number: &Number) -> (Level, Vec<Math>) {
    match Magnitude::new(number) {
        Magnitude::Decimal(digits) => (Level::Atom, vec![Math::Number(digits)]),
        Magnitude::Quotient(parts) => {
            (Level::Product, vec![Math::Fraction(Box::new(parts.map(Math::Number)))])
        }
        // `tidied` makes it a product with a power of ten, once it is rounded.
        Magnitude::Scientific([digits, exponent]) => {
            (Level::Product, vec![Math::Number(format!("{digits}e{exponent}"))])
        }
        Magnitude::NotANumber => (Level::Product, vec![Math::Word("NaN".to_owned())]),
    }
}

/// The factors of a product as they are printed: the one with a number first.
fn in_order_of_print<'g>(a: Expr<'g>, b: Expr<'g>) -> [Expr<'g>; 2] {
    if leads_with_number(b) && !leads_with_number(a) { [b, a] } else { [a, b] }
}

/// Whether a product begins with a number, which needs a sign between it and a preceding factor.
fn leads_with_number(expr: Expr<'_>) -> bool {
    let (mut pending, mut known) = (vec![expr], FxHashSet::default());
    while let Some(factor) = pending.pop() {
        match factor.view() {
            View::Number(_) => return true,
            // A number among the factors is printed first.
            View::Mul(a, b) if known.insert(factor.id()) && as_power(factor).1 == 1 => {
                pending.extend([a, b]);
            }
            _ => {}
        }
    }
    false
}

fn sign<'g>(sign: char) -> Step<'g> {
    Step::Piece(Math::Sign(sign))
}

fn infix<'g>(a: Expr<'g>, left: Level, between: char, b: Expr<'g>, right: Level) -> Vec<Step<'g>> {
    vec![Step::Operand(a, left), sign(between), Step::Operand(b, right)]
}

/// Applies a function with an exponent to an argument in parentheses.
fn applied(applying: Math, argument: Expr<'_>, exponent: u32) -> (Level, Vec<Step<'_>>) {
    applied_to(applying, vec![Step::Operand(argument, Level::Sum)], exponent)
}

fn applied_to<'g>(
    applying: Math,
    argument: Vec<Step<'g>>,
    exponent: u32,
) -> (Level, Vec<Step<'g>>) {
    let mut steps = raised_name(applying, exponent);
    steps.push(Step::Open);
    steps.extend(argument);
    steps.push(Step::Close(Whole::Fenced(Fence::Parentheses)));
    (if exponent == 1 { Level::Atom } else { Level::Power }, steps)
}

/// The sum of the angles of joints in the order of the joints, `q_2 + q_3 + q_4`, however it was built.
fn in_order<'g>(angle: Expr<'g>, joints: &[(bool, u32)]) -> Vec<Step<'g>> {
    let mut steps = vec![];
    for (place, (negative, joint)) in joints.iter().enumerate() {
        match (negative, place) {
            (true, _) => steps.push(sign('-')),
            (false, 0) => {}
            (false, _) => steps.push(sign('+')),
        }
        let index = (*joint as usize).saturating_sub(1);
        let symbol = angle.graph().symbol(&JointVariable::Position.symbol(index));
        steps.push(Step::Operand(symbol, Level::Sum));
    }
    steps
}

fn raised_name<'g>(applying: Math, exponent: u32) -> Vec<Step<'g>> {
    let mut steps = vec![Step::Piece(applying)];
    if exponent > 1 {
        steps.push(Step::Raise(exponent));
    }
    steps
}

/// A letter such as `s` in `s₂₃`, with the joints of the angle, or the angle itself, as the lower index.
fn index_of<'g>(letter: char, angle: Expr<'g>, exponent: u32) -> Vec<Step<'g>> {
    let mut steps = vec![Step::Open];
    match joint_numbers(angle) {
        Some(joints) => steps.extend(joints.into_iter().map(Step::Piece)),
        None => steps.push(Step::Operand(angle, Level::Sum)),
    }
    steps.push(Step::Close(Whole::IndexOf(letter, exponent)));
    steps
}

/// The joints whose angles add up to an angle, and whether each is subtracted; those that are added come first. `None`
/// for other angles.
fn joints(angle: Expr<'_>) -> Option<Vec<(bool, u32)>> {
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
    Some(joints)
}

/// The index for a sum of angles: `23` for q2 + q3, `2-3` for q2 − q3, `2,10` if a joint has two digits.
fn joint_numbers(angle: Expr<'_>) -> Option<Vec<Math>> {
    let joints = joints(angle)?;
    // A single joint number above 9 would be ambiguous: the index 12 means the sum of q1 and q2.
    if let [(_, 10..)] | [(false, 10..), (true, _), ..] = joints.as_slice() {
        return None;
    }
    let apart = joints.iter().any(|(_, joint)| *joint > 9);
    let mut pieces: Vec<Math> = vec![];
    for (negative, joint) in joints {
        match (negative, pieces.last_mut()) {
            (true, _) => pieces.push(Math::Sign('-')),
            (false, Some(Math::Number(digits))) if !apart => {
                digits.push_str(&joint.to_string());
                continue;
            }
            (false, Some(_)) => pieces.push(Math::Sign(',')),
            (false, None) => {}
        }
        pieces.push(Math::Number(joint.to_string()));
    }
    Some(pieces)
}

/// Adds the piece that an inner row becomes to the outer row.
fn close(row: &mut Vec<Math>, whole: Whole, inside: Math) {
    let piece = match whole {
        Whole::Fenced(fence) => Math::Fenced(fence, Box::new(inside)),
        Whole::Root => Math::Root(Box::new(inside)),
        Whole::Numerator => inside,
        Whole::Denominator => Math::Fraction(Box::new([row.pop().unwrap_or_default(), inside])),
        Whole::IndexOf(letter, exponent) => {
            let upper = (exponent > 1).then(|| Math::Number(exponent.to_string()));
            let base = Math::Letter(letter);
            Math::Script(Box::new(Script { base, lower: Some(inside), upper }))
        }
    };
    row.push(piece);
}

/// Raises the last piece to a power.
pub(super) fn raise(pieces: &mut Vec<Math>, exponent: u32) {
    if let Some(last) = pieces.pop() {
        pieces.push(last.with_upper(Math::Number(exponent.to_string())));
    }
}
