//! A module as flat functions, from which most languages are printed.
//!
//! A [`Tree`] is built from a module for the names and limits of a language. Each of its functions has two bodies:
//! one computes the angles whose sines and cosines are needed, the other the outputs. A body is a list of statements,
//! each of which assigns variables their only value, followed by the expressions of its results.
//! [`Function::whole`] joins the two. A printer defines the syntax of all this; [`infix`] prints expressions for
//! languages that write them with operators.

mod build;
mod infix;
mod names;
mod options;
pub mod polynomials;

use robot_symbolic::Function as Call;

pub use self::infix::{Spelling, infix};
pub use self::names::Taken;
pub use self::options::FlatOptions;
use crate::module;

/// A module as flat functions.
#[derive(Clone, Debug)]
pub struct Tree<'m> {
    /// The module from which the tree was made.
    pub module: &'m module::Module,
    /// The name of the module.
    pub name: String,
    /// The names of the parameters.
    pub parameters: Vec<String>,
    /// The names of the model's fields, which the constructor computes from the parameters.
    pub fields: Vec<String>,
    /// The constructor: its results are the fields.
    pub constructor: Body,
    /// The functions, in the order of the module.
    pub functions: Vec<Function<'m>>,
    /// The names of the setters.
    pub setters: Vec<String>,
}

/// A function of a [`Tree`].
#[derive(Clone, Debug)]
pub struct Function<'m> {
    /// The function from which it was made.
    pub source: &'m module::Function,
    /// The name.
    pub name: String,
    /// The names of its additional forms, in the order in which the printer listed them.
    pub forms: Vec<String>,
    /// The arrays that it takes as inputs.
    pub inputs: Vec<Array>,
    /// The arrays or numbers that it returns; the results of `core` are their entries, one after the other.
    pub outputs: Vec<Array>,
    /// Computes the angles.
    pub angles: Body,
    /// For each angle, the variable of `core` that is its sine.
    pub sines: Vec<String>,
    /// For each angle, the variable of `core` that is its cosine.
    pub cosines: Vec<String>,
    /// Computes the outputs.
    pub core: Body,
}

impl Function<'_> {
    /// The name of the form with this index, or the name of the function if there is no such form.
    #[must_use]
    pub fn form(&self, index: usize) -> &str {
        self.forms.get(index).unwrap_or(&self.name)
    }

    /// Joins the two bodies into one that also has statements for the sines and cosines.
    #[must_use]
    pub fn whole(&self) -> Body {
        let mut statements = self.angles.statements.clone();
        let angles = self.angles.results.iter();
        for ((angle, sine), cosine) in angles.zip(&self.sines).zip(&self.cosines) {
            statements.push(Statement::Circular {
                sine: sine.clone(),
                cosine: cosine.clone(),
                angle: angle.clone(),
            });
        }
        let parts = self.angles.parts.len();
        for statement in &self.core.statements {
            match statement {
                Statement::Entry { .. } if statements.contains(statement) => {}
                Statement::Part(index) => statements.push(Statement::Part(parts + index)),
                _ => statements.push(statement.clone()),
            }
        }
        // The sort is stable: entries come first, and the other statements keep their order.
        statements.sort_by_key(|statement| !matches!(statement, Statement::Entry { .. }));
        let parts = self.angles.parts.iter().chain(&self.core.parts).cloned().collect();
        Body { statements, results: self.core.results.clone(), parts }
    }
}

/// An input or an output of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Array {
    /// The name.
    pub name: String,
    /// The number of entries.
    pub length: usize,
    /// Whether the function reads an entry of it; always true for outputs.
    pub is_used: bool,
}

/// Statements and results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// The statements in order.
    pub statements: Vec<Statement>,
    /// The results.
    pub results: Vec<Expression>,
    /// The parts that [`Statement::Part`] calls, if the body is very long.
    pub parts: Vec<Part>,
}

/// A statement of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Assigns a parameter of the module to a variable.
    Parameter {
        /// The variable.
        name: String,
        /// The index of the parameter.
        parameter: usize,
    },
    /// Assigns an entry of an input to a variable.
    Entry {
        /// The variable.
        name: String,
        /// The index of the input.
        input: usize,
        /// The index of the entry, from 0.
        entry: usize,
    },
    /// Assigns the sine and the cosine of an angle to two variables.
    Circular {
        /// The variable that is the sine.
        sine: String,
        /// The variable that is the cosine.
        cosine: String,
        /// The angle, rad.
        angle: Expression,
    },
    /// Assigns the value of an expression to a variable.
    Let {
        /// The variable.
        name: String,
        /// The value.
        value: Expression,
    },
    /// Assigns the values that a part of the body returns to its variables; the part is given by its index.
    Part(usize),
}

/// A part of a very long body: a function of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name of the function.
    pub name: String,
    /// The variables that it takes as arguments.
    pub entering: Vec<String>,
    /// The variables that it returns.
    pub leaving: Vec<String>,
    /// Its statements.
    pub statements: Vec<Statement>,
    /// Whether the body or part reads fields of the model.
    pub reads_fields: bool,
}

/// An expression of a few operations.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A number.
    Constant(f64),
    /// A variable.
    Variable(String),
    /// A field of the model, by its index.
    Field(usize),
    /// An operation on two operands.
    Binary(Operator, Box<[Expression; 2]>),
    /// −a
    Negative(Box<Expression>),
    /// a b + c, rounded once if the target has the instruction.
    MulAdd(Box<[Expression; 3]>),
    /// A function of one argument.
    Call(Call, Box<Expression>),
}

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Sum.
    Add,
    /// Difference.
    Sub,
    /// Product.
    Mul,
    /// Quotient.
    Div,
}

impl Expression {
    /// Visits the expression and all its subexpressions.
    pub fn each(&self, visit: &mut impl FnMut(&Expression)) {
        visit(self);
        match self {
            Expression::Constant(_) | Expression::Variable(_) | Expression::Field(_) => {}
            Expression::Binary(_, operands) => operands.iter().for_each(|a| a.each(visit)),
            Expression::MulAdd(operands) => operands.iter().for_each(|a| a.each(visit)),
            Expression::Negative(operand) | Expression::Call(_, operand) => operand.each(visit),
        }
    }

    /// Whether the expression is a quotient whose divisor is not a literal number.
    #[must_use]
    pub fn divides_by_a_variable(&self) -> bool {
        match self {
            Expression::Binary(Operator::Div, operands) => {
                !matches!(operands[1], Expression::Constant(_))
            }
            _ => false,
        }
    }
}

impl Statement {
    /// Returns the expression of the statement, if it has one.
    #[must_use]
    pub fn expression(&self) -> Option<&Expression> {
        match self {
            Statement::Circular { angle: value, .. } | Statement::Let { value, .. } => Some(value),
            Statement::Parameter { .. } | Statement::Entry { .. } | Statement::Part(_) => None,
        }
    }
}

impl Body {
    /// Visits all expressions of the statements, including those of parts, and of the results.
    pub fn each_expression(&self, visit: &mut impl FnMut(&Expression)) {
        let parts = self.parts.iter().flat_map(|part| &part.statements);
        let statements = self.statements.iter().chain(parts);
        let values = statements.filter_map(Statement::expression);
        values.chain(&self.results).for_each(|value| value.each(visit));
    }

    /// Whether the body or part reads fields of the model.
    #[must_use]
    pub fn reads_fields(&self) -> bool {
        let mut found = false;
        self.each_expression(&mut |value| found |= matches!(value, Expression::Field(_)));
        found
    }
}

/// The helper functions that printed code calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Helpers {
    /// Sine and cosine together.
    pub circular: bool,
    /// Multiply-add.
    pub mul_add: bool,
    /// The sign function, with sgn 0 = 0.
    pub sign: bool,
    /// Hyperbolic tangent.
    pub tanh: bool,
    /// The reciprocal of a positive number.
    pub recip_positive: bool,
    /// Square root.
    pub sqrt: bool,
    /// Absolute value.
    pub abs: bool,
    /// Division by what can be 0.
    pub division: bool,
}

impl Helpers {
    /// Finds the helpers that a body calls.
    #[must_use]
    pub fn of(body: &Body) -> Helpers {
        let mut found = Helpers::default();
        let parts = body.parts.iter().flat_map(|part| &part.statements);
        let mut statements = body.statements.iter().chain(parts);
        found.circular = statements.any(|one| matches!(one, Statement::Circular { .. }));
        body.each_expression(&mut |value| match value {
            Expression::MulAdd(_) => found.mul_add = true,
            quotient if quotient.divides_by_a_variable() => found.division = true,
            Expression::Call(function, _) => match function {
                Call::Sin | Call::Cos => found.circular = true,
                Call::Sign => found.sign = true,
                Call::Tanh => found.tanh = true,
                Call::RecipPositive => found.recip_positive = true,
                Call::Sqrt => found.sqrt = true,
                Call::Abs => found.abs = true,
            },
            _ => {}
        });
        found
    }

    /// The union of two sets of helpers.
    #[must_use]
    pub fn and(self, other: Helpers) -> Helpers {
        Helpers {
            circular: self.circular | other.circular,
            mul_add: self.mul_add | other.mul_add,
            sign: self.sign | other.sign,
            tanh: self.tanh | other.tanh,
            recip_positive: self.recip_positive | other.recip_positive,
            sqrt: self.sqrt | other.sqrt,
            abs: self.abs | other.abs,
            division: self.division | other.division,
        }
    }
}

impl Tree<'_> {
    /// The helpers that the functions call.
    #[must_use]
    pub fn helpers(&self) -> Helpers {
        let bodies = self.functions.iter().map(|function| Helpers::of(&function.whole()));
        bodies.fold(Helpers::default(), Helpers::and)
    }

    /// Whether the model has fields that depend on parameters.
    #[must_use]
    pub fn has_parameters(&self) -> bool {
        !self.parameters.is_empty()
    }
}
