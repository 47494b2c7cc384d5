//! The parser, which converts tokens to postfix steps by the shunting-yard algorithm. Its stacks are vectors, so deeply
//! nested formulas cannot overflow the call stack.

use std::ops::Range;

use super::error::ParseError;
use super::lexer::{Lexer, Names, Token};
use super::{Formula, MAX_DEPTH, MAX_EXPONENT, MAX_TOKENS, Op};
use crate::graph::Function;
use crate::spelling::nearest_word;

/// An entry on the stack of pending operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pending {
    Open,
    Call(Function),
    Tan,
    Binary(u8),
    Neg,
}

impl Pending {
    /// The precedence. Parentheses have the lowest, so no operator removes them from the stack.
    const fn strength(self) -> u8 {
        match self {
            Pending::Open | Pending::Call(_) | Pending::Tan => 0,
            Pending::Binary(b'+' | b'-') => 1,
            Pending::Binary(b'^') => 4,
            Pending::Binary(_) => 2,
            Pending::Neg => 3,
        }
    }

    const fn is_parenthesis(self) -> bool {
        self.strength() == 0
    }
}

/// A finished operand: the index of its first postfix step, its bytes, and its value if that is an integer, because
/// exponents must be integers.
struct Operand {
    start: usize,
    span: Range<usize>,
    integer: Option<i64>,
}

struct Parser<'t> {
    text: &'t str,
    lexer: Lexer<'t>,
    ops: Vec<Op>,
    operands: Vec<Operand>,
    pending: Vec<(Pending, Range<usize>)>,
    /// The number of open parentheses, signs and powers.
    depth: usize,
    /// The bytes of the previous token.
    last: Range<usize>,
}

/// Parses a formula; see [`Formula::parse`].
pub(super) fn parse(text: &str, names: Names) -> Result<Formula, ParseError> {
    if text.trim().is_empty() {
        return Err(ParseError::new(0..text.len(), "expected an expression, found nothing")
            .help("write a number such as `0.35` or an expression such as `l1 + l2/2`"));
    }
    let mut parser = Parser {
        text,
        lexer: Lexer::new(text, names),
        ops: vec![],
        operands: vec![],
        pending: vec![],
        depth: 0,
        last: 0..0,
    };
    parser.run()?;
    Ok(Formula { text: text.to_owned(), ops: parser.ops })
}

impl Parser<'_> {
    fn run(&mut self) -> Result<(), ParseError> {
        let mut operand_next = true;
        for _ in 0..MAX_TOKENS {
            let (token, span) = self.lexer.next()?;
            let end = token == Token::End;
            operand_next = if operand_next {
                self.operand(token, span.clone())?
            } else {
                self.operator(&token, span.clone())?
            };
            if end {
                return Ok(());
            }
            // The span of a function excludes its parenthesis, which has been consumed as well and is already in
            // `last`.
            if self.last.end < span.end {
                self.last = span;
            }
        }
        Err(ParseError::new(
            self.last.clone(),
            format!("the expression is longer than {MAX_TOKENS} numbers, names and signs"),
        )
        .help("introduce names for parts of it"))
    }

    /// Consumes a token at a position for an operand. Returns whether the next token must be an operand too.
    fn operand(&mut self, token: Token, span: Range<usize>) -> Result<bool, ParseError> {
        match token {
            Token::Number(value) => {
                let integer = value.to_integer();
                self.push(Op::Number(value), span, integer);
                Ok(false)
            }
            Token::Name => self.name(span),
            Token::Symbol(b'(') => self.open(Pending::Open, span),
            Token::Symbol(b'-') => self.open(Pending::Neg, span),
            Token::Symbol(b'+') => {
                Err(self.expected("a number, a name or `(`", span).help(if self.last.is_empty() {
                    "leave out the leading `+`"
                } else {
                    "leave out one of the two signs"
                }))
            }
            Token::Symbol(b')') if self.pending.last().is_some_and(|p| p.0.is_parenthesis()) => {
                Err(ParseError::new(
                    self.last.start..span.end,
                    "expected an expression between the parentheses",
                )
                .help("write an expression there, or remove the parentheses"))
            }
            Token::Symbol(_) => Err(self
                .expected("a number, a name or `(`", span)
                .help("every operator needs an operand on both sides")),
            Token::End => {
                let operator = self.quote(&self.last);
                Err(ParseError::new(
                    self.last.clone(),
                    format!("expected a number, a name or `(` after `{operator}`, found the end"),
                )
                .help("complete the expression, or remove the last operator"))
            }
        }
    }

    /// Consumes a token at a position for an operator. Returns whether the next token must be an operand.
    fn operator(&mut self, token: &Token, span: Range<usize>) -> Result<bool, ParseError> {
        match token {
            Token::Symbol(b')') => {
                self.close(span)?;
                Ok(false)
            }
            Token::Symbol(b'(') | Token::Number(_) | Token::Name => {
                let whole = self.last.start..span.end;
                let (before, after) = (self.quote(&self.last), self.quote(&span));
                let dots = if after == "(" { "…)" } else { "" };
                Err(ParseError::new(
                    whole,
                    format!("expected an operator between `{before}` and `{after}`"),
                )
                .help(if after == "deg" {
                    let angle = if before == ")" { "(…)" } else { before.as_str() };
                    format!("write an angle in degrees as `{angle}*pi/180`")
                } else if before == ")" {
                    format!("write a product as `(…)*{after}{dots}`")
                } else if before.starts_with(|first: char| first.is_ascii_digit())
                    && after.chars().all(char::is_alphabetic)
                {
                    format!("write a product as `{before}*{after}`; if `{after}` is a unit, leave it out")
                } else {
                    format!("write a product as `{before}*{after}{dots}`")
                }))
            }
            Token::Symbol(sign) => {
                let operator = Pending::Binary(*sign);
                let limit = operator.strength() + u8::from(*sign == b'^');
                self.reduce(limit)?;
                self.open(operator, span)
            }
            Token::End => {
                self.reduce(1)?;
                match self.pending.pop() {
                    None => Ok(false),
                    Some((_, span)) => Err(ParseError::new(
                        span,
                        "this parenthesis is not closed: expected `)` before the end",
                    )
                    .help("add `)`")),
                }
            }
        }
    }

    fn name(&mut self, span: Range<usize>) -> Result<bool, ParseError> {
        let name = self.text.get(span.clone()).unwrap_or_default();
        let rest = self.text.get(span.end..).unwrap_or_default();
        let called = rest.trim_ascii_start().starts_with('(');
        let function = match Function::ALL.iter().find(|f| f.name() == name) {
            Some(function) => Pending::Call(*function),
            None if name == "tan" => Pending::Tan,
            None if called => return Err(unknown_function(name, span)),
            None => {
                let op = if name == "pi" { Op::Pi } else { Op::Symbol(span.clone()) };
                self.push(op, span, None);
                return Ok(false);
            }
        };
        if !called {
            return Err(ParseError::new(span, format!("expected `(` after the function `{name}`"))
                .help(format!("write `{name}(…)`")));
        }
        let (_, parenthesis) = self.lexer.next()?;
        self.last = parenthesis.clone();
        self.open(function, span.start..parenthesis.end)
    }

    fn push(&mut self, op: Op, span: Range<usize>, integer: Option<i64>) {
        self.operands.push(Operand { start: self.ops.len(), span, integer });
        self.ops.push(op);
    }

    fn open(&mut self, pending: Pending, span: Range<usize>) -> Result<bool, ParseError> {
        if !matches!(pending, Pending::Binary(b'+' | b'-' | b'*' | b'/')) {
            self.depth += 1;
            if self.depth > MAX_DEPTH {
                return Err(ParseError::new(
                    span,
                    format!("the expression is nested deeper than {MAX_DEPTH} levels"),
                )
                .help("introduce names for the inner parts"));
            }
        }
        self.pending.push((pending, span));
        Ok(true)
    }

    fn close(&mut self, span: Range<usize>) -> Result<(), ParseError> {
        self.reduce(1)?;
        let Some((pending, open)) = self.pending.pop() else {
            return Err(ParseError::new(span, "this `)` closes nothing")
                .help("remove it, or add the matching `(`"));
        };
        self.depth -= 1;
        if let Some(operand) = self.operands.last_mut() {
            operand.span = open.start..span.end;
            if pending != Pending::Open {
                operand.integer = None;
            }
        }
        match pending {
            Pending::Call(function) => self.ops.push(Op::Call(function)),
            Pending::Tan => self.ops.push(Op::Tan),
            _ => {}
        }
        Ok(())
    }

    /// Applies the pending operators that bind at least as tightly as `limit`. The limit is at least 1, so parentheses
    /// stay on the stack.
    fn reduce(&mut self, limit: u8) -> Result<(), ParseError> {
        while let Some((pending, span)) = self.pending.last().cloned()
            && pending.strength() >= limit
        {
            self.pending.pop();
            match pending {
                Pending::Binary(b'^') => {
                    self.depth -= 1;
                    self.power()?;
                }
                Pending::Binary(sign) => self.binary(sign),
                _ => {
                    self.depth -= 1;
                    self.ops.push(Op::Neg);
                    if let Some(operand) = self.operands.last_mut() {
                        operand.span.start = span.start;
                        operand.integer = operand.integer.and_then(i64::checked_neg);
                    }
                }
            }
        }
        Ok(())
    }

    fn binary(&mut self, sign: u8) {
        let Some(right) = self.operands.pop() else {
            return;
        };
        let Some(left) = self.operands.last_mut() else {
            return;
        };
        left.span.end = right.span.end;
        let integers = left.integer.zip(right.integer);
        left.integer = integers.and_then(|(a, b)| match sign {
            b'+' => a.checked_add(b),
            b'-' => a.checked_sub(b),
            b'*' => a.checked_mul(b),
            _ => a.checked_div(b).filter(|quotient| quotient * b == a),
        });
        self.ops.push(match sign {
            b'+' => Op::Add,
            b'-' => Op::Sub,
            b'*' => Op::Mul,
            _ => Op::Div,
        });
    }

    fn power(&mut self) -> Result<(), ParseError> {
        let Some(exponent) = self.operands.pop() else { return Ok(()) };
        let in_range = |value: &i64| value.unsigned_abs() <= MAX_EXPONENT.unsigned_abs();
        let Some(value) = exponent.integer.filter(in_range) else {
            return Err(self.wrong_exponent(exponent.integer, exponent.span));
        };
        let Some(base) = self.operands.last_mut() else { return Ok(()) };
        base.span.end = exponent.span.end;
        base.integer = base
            .integer
            .filter(|_| value >= 0)
            .and_then(|base| base.checked_pow(value.unsigned_abs() as u32));
        // The steps of the exponent are replaced by its value.
        self.ops.truncate(exponent.start);
        self.ops.push(Op::Power(value as i32));
        Ok(())
    }

    /// The error for an exponent that is not an integer or is beyond the limit; integers of many digits have no `value`.
    fn wrong_exponent(&self, value: Option<i64>, span: Range<usize>) -> ParseError {
        let text = self.quote(&span);
        let is_digit = |c: char| c == '-' || c == '…' || c.is_ascii_digit();
        if value.is_none() && !text.chars().all(is_digit) {
            return ParseError::new(span, "expected an integer as the exponent")
                .help("write a root as `sqrt(x)`");
        }
        let shown = value.map_or(text, |value| value.to_string());
        let remedy = if shown.starts_with('-') {
            "write a quotient of powers, such as `1/(x^64*x^36)`"
        } else {
            "write the power as a product of powers, such as `x^64*x^36`"
        };
        ParseError::new(span, format!("the exponent {shown} is beyond ±{MAX_EXPONENT}"))
            .help(remedy)
    }

    /// The text of a span, without its middle if it is long.
    fn quote(&self, span: &Range<usize>) -> String {
        shorten(self.text.get(span.clone()).unwrap_or_default())
    }

    fn expected(&self, what: &str, span: Range<usize>) -> ParseError {
        let found = self.quote(&span);
        ParseError::new(span, format!("expected {what}, found `{found}`"))
    }
}

/// Shortens long texts. Tokens are ASCII except in errors of the lexer, which are not quoted here.
fn shorten(text: &str) -> String {
    match text.get(..30).zip(text.get(text.len().saturating_sub(10)..)) {
        Some((head, tail)) if text.len() > 40 => format!("{head}…{tail}"),
        _ => text.to_owned(),
    }
}

fn unknown_function(name: &str, span: Range<usize>) -> ParseError {
    let name = &shorten(name);
    let known = Function::ALL.iter().map(|function| function.name());
    let near = nearest_word(name, known.chain(["tan"]));
    let error = ParseError::new(span, format!("`{name}` is not a function"));
    match near {
        Some(near) => {
            error.help(format!("did you mean `{near}(…)`? For a product, write `{name}*(…)`"))
        }
        None => error.help(format!(
            "the functions are sin, cos, tan, sqrt, abs, sign and tanh; for a product write \
             `{name}*(…)`"
        )),
    }
}
