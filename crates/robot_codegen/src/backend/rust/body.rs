//! Statements and expressions of a program.

use proc_macro2::Ident;
use robot_symbolic::Function as Call;
use syn::{Expr, Pat, Stmt, parse_quote, token};

use super::namer::Namer;
use super::number::Number;
use super::syntax;
use crate::program::{Block, Limits, Operation, Part, Program, Source, Statements, Value};

/// Prints the statements of a program.
pub(super) struct Body<'a> {
    program: &'a Program,
    grouped: Statements,
    number: &'a Number,
    /// The printed form of the program's loads.
    load: &'a dyn Fn(Source) -> Expr,
    /// The names of the named values.
    names: Vec<Option<Ident>>,
}

/// A part of a long program: a function of its own.
pub(super) struct PartFunction {
    /// The names of the arguments.
    pub(super) entering: Vec<Ident>,
    /// The names of the values that the function returns.
    pub(super) leaving: Vec<Ident>,
    /// The statements of the function.
    pub(super) statements: Vec<Stmt>,
}

impl<'a> Body<'a> {
    pub(super) fn new(
        program: &'a Program,
        limits: &Limits,
        number: &'a Number,
        load: &'a dyn Fn(Source) -> Expr,
        namer: &mut Namer,
    ) -> Body<'a> {
        let grouped = Statements::new(program, limits);
        let mut count = 0;
        let names = program.values().map(|(value, _)| {
            grouped.is_named(value).then(|| {
                count += 1;
                namer.name(&format!("t{count}"))
            })
        });
        let names = names.collect();
        Body { program, grouped, number, load, names }
    }

    /// The results as expressions, to be placed after the statements.
    pub(super) fn results(&self) -> Vec<Expr> {
        self.program.results().iter().map(|value| self.operand(*value)).collect()
    }

    /// Whether the program is so long that it is cut into functions.
    pub(super) fn is_cut(&self) -> bool {
        self.grouped.parts.len() > 1
    }

    /// The statements of a program that is not cut.
    pub(super) fn statements(&self) -> Vec<Stmt> {
        self.grouped.parts.iter().flat_map(|part| self.part_statements(part)).collect()
    }

    /// The parts of a program that is cut. `source_name` returns the variable that a load reads, for
    /// loads that are variables.
    pub(super) fn parts(&self, source_name: &dyn Fn(Source) -> Option<Ident>) -> Vec<PartFunction> {
        let part = |part: &Part| PartFunction {
            entering: {
                let loads =
                    self.grouped.sources(self.program, part).into_iter().filter_map(source_name);
                loads.chain(self.names_of(&part.entering)).collect()
            },
            leaving: self.names_of(&part.leaving),
            statements: self.part_statements(part),
        };
        self.grouped.parts.iter().map(part).collect()
    }

    fn part_statements(&self, part: &Part) -> Vec<Stmt> {
        match part.blocks.as_slice() {
            [block] => self.block_statements(block),
            blocks => blocks.iter().map(|block| self.nested(block)).collect(),
        }
    }

    /// Prints a block as an expression; the values that are used later are returned as a tuple.
    fn nested(&self, block: &Block) -> Stmt {
        let names = self.names_of(&block.leaving);
        let values = names.iter().map(syntax::variable).collect();
        let inner = syntax::block(self.block_statements(block), syntax::tuple(values));
        syntax::binding_statement(syntax::tuple_pattern(&names), inner)
    }

    fn block_statements(&self, block: &Block) -> Vec<Stmt> {
        let statements = block.statements.iter().map(|value| {
            let pattern: Pat = syntax::optional_binding(self.names[value.index()].as_ref());
            syntax::binding_statement(pattern, self.expression(*value))
        });
        statements.collect()
    }

    fn names_of(&self, values: &[Value]) -> Vec<Ident> {
        values.iter().filter_map(|value| self.names[value.index()].clone()).collect()
    }

    /// Makes the operand for a value: its name if it has one, otherwise its expression.
    fn operand(&self, value: Value) -> Expr {
        match &self.names[value.index()] {
            Some(name) => syntax::variable(name),
            None => self.expression(value),
        }
    }

    /// Makes the expression of a value's operation. `Limits::expression` bounds the depth of the recursion.
    fn expression(&self, value: Value) -> Expr {
        let binary = |a, op, b| syntax::binary(self.operand(a), op, self.operand(b));
        match self.program.operation(value) {
            Operation::Constant(constant) => self.number.constant(constant.get()),
            Operation::Load(source) => (self.load)(source),
            Operation::Add(a, b) => binary(a, syn::BinOp::Add(token::Plus::default()), b),
            Operation::Sub(a, b) => binary(a, syn::BinOp::Sub(token::Minus::default()), b),
            Operation::Mul(a, b) => binary(a, syn::BinOp::Mul(token::Star::default()), b),
            Operation::Div(a, b) => binary(a, syn::BinOp::Div(token::Slash::default()), b),
            Operation::Neg(a) => syntax::negative(self.operand(a)),
            Operation::MulAdd(a, b, c) => {
                let operands = [a, b, c].map(|value| self.operand(value));
                syntax::call(self.number.mul_add(), operands)
            }
            Operation::Call(function, a) => self.call(function, self.operand(a)),
        }
    }

    fn call(&self, function: Call, argument: Expr) -> Expr {
        let method = |name: &str| self.number.method(name);
        match function {
            Call::Sqrt => syntax::call(method("sqrt"), [argument]),
            Call::Abs => syntax::call(method("abs"), [argument]),
            Call::Sign => syntax::call(method("signum0"), [argument]),
            Call::Tanh => syntax::call(method("tanh"), [argument]),
            Call::RecipPositive => syntax::call(self.number.recip_positive(), [argument]),
            Call::Sin => {
                let pair = syntax::call(self.number.circular("sin_cos"), [argument]);
                parse_quote!(#pair.0)
            }
            Call::Cos => {
                let pair = syntax::call(self.number.circular("sin_cos"), [argument]);
                parse_quote!(#pair.1)
            }
        }
    }
}
