//! Builds the tree of a module.

use super::names::{Names, Taken, Variables};
use super::{Array, Body, Expression, Function, Operator, Part, Statement, Tree};
use crate::backend::Language;
use crate::backend::common::{Namer, Setter, input_entry, used_inputs};
use crate::module::{self, Module};
use crate::program::{self, Block, Operation, Program, Source, Statements, Value};

impl<'m> Tree<'m> {
    /// Builds the tree of a module in a language. No item or variable has a name that is taken. `forms` are the name
    /// endings of the additional forms of each function.
    #[must_use]
    pub fn new(
        module: &'m Module,
        language: &Language,
        taken: Taken<'_>,
        forms: &[&str],
        setters: &[Setter],
    ) -> Tree<'m> {
        let mut names = Names::new(module, language, taken, forms, setters);
        let variables = taken.namer(language);
        let mut builder = Builder { language, variables, items: &mut names.items };
        let constructor = builder.constructor(module);
        let functions = module.functions.iter().zip(&names.functions).zip(&names.forms);
        let functions = functions.map(|((source, name), forms)| Function {
            forms: forms.clone(),
            ..builder.function(source, name)
        });
        let functions = functions.collect();
        let Names { module: name, parameters, fields, setters, .. } = names;
        Tree { module, name, parameters, fields, constructor, functions, setters }
    }
}

struct Builder<'b> {
    language: &'b Language,
    /// The namer that is copied for the variables of each function.
    variables: Namer,
    items: &'b mut Namer,
}

impl Builder<'_> {
    fn constructor(&mut self, module: &Module) -> Body {
        let mut namer = self.variables.clone();
        let names = namer.names(module.parameters.iter().map(|one| one.name.as_str()));
        let program = &module.constructor;
        let name = |source: Source| match source {
            Source::Parameter(index) => names.get(index as usize).cloned(),
            _ => None,
        };
        let loads = program.sources().into_iter().filter_map(|source| match source {
            Source::Parameter(parameter) => {
                let parameter = parameter as usize;
                Some(Statement::Parameter { name: names.get(parameter)?.clone(), parameter })
            }
            _ => None,
        });
        let mut body = Body { statements: loads.collect(), ..Body::default() };
        self.program(program, &name, &mut namer, "model", &mut body);
        body
    }

    fn function<'m>(&mut self, source: &'m module::Function, name: &str) -> Function<'m> {
        let mut namer = self.variables.clone();
        let variables = Variables::new(source, &mut namer);
        let load = |source: Source| variables.name(source).map(str::to_owned);
        let mut body = |program: &Program, name: &str| {
            let mut body =
                Body { statements: entries(source, program, &variables), ..Body::default() };
            self.program(program, &load, &mut namer, name, &mut body);
            body
        };
        let angles = body(&source.angles, &format!("{name}_angles"));
        let core = body(&source.core, name);
        let used = [&source.angles, &source.core].map(|program| used_inputs(source, program));
        let inputs = source.inputs.iter().zip(&variables.inputs).enumerate();
        let inputs = inputs.map(|(index, (input, name))| Array {
            name: name.clone(),
            length: input.symbols.len(),
            is_used: used.iter().any(|used| used.get(index) == Some(&true)),
        });
        let outputs = source.outputs.iter().zip(&variables.outputs);
        let outputs = outputs.map(|(output, name)| Array {
            name: name.clone(),
            length: output.len(),
            is_used: true,
        });
        Function {
            source,
            name: name.to_owned(),
            forms: vec![],
            inputs: inputs.collect(),
            outputs: outputs.collect(),
            angles,
            sines: variables.sines,
            cosines: variables.cosines,
            core,
        }
    }

    /// Adds the statements of a program to a body, whose results become those of the program.
    fn program(
        &mut self,
        program: &Program,
        load: &dyn Fn(Source) -> Option<String>,
        namer: &mut Namer,
        name: &str,
        body: &mut Body,
    ) {
        let printer = Printer::new(program, load, &self.language.limits, namer);
        let parts = &printer.grouped.parts;
        for (index, part) in parts.iter().enumerate() {
            let statements = printer.statements(&part.blocks);
            if parts.len() == 1 {
                body.statements.extend(statements);
                continue;
            }
            let name = self.items.name(&format!("{name}_part{}", index + 1));
            body.statements.push(Statement::Part(body.parts.len()));
            body.parts.push(printer.part(part, name, statements));
        }
        body.results = program.results().iter().map(|value| printer.operand(*value)).collect();
    }
}

/// Makes the statements `q1 = q[0]` for all entries that a program of the function loads.
fn entries(
    function: &module::Function,
    program: &Program,
    variables: &Variables,
) -> Vec<Statement> {
    let entry = |source: Source| match source {
        Source::Input(index) => {
            let (input, entry) = input_entry(function, index);
            Some(Statement::Entry { name: variables.name(source)?.to_owned(), input, entry })
        }
        _ => None,
    };
    program.sources().into_iter().filter_map(entry).collect()
}

/// Turns the values of a program into statements and expressions.
struct Printer<'p> {
    program: &'p Program,
    grouped: Statements,
    load: &'p dyn Fn(Source) -> Option<String>,
    /// The names of the named values.
    names: Vec<Option<String>>,
}

impl<'p> Printer<'p> {
    fn new(
        program: &'p Program,
        load: &'p dyn Fn(Source) -> Option<String>,
        limits: &program::Limits,
        namer: &mut Namer,
    ) -> Printer<'p> {
        let grouped = Statements::new(program, limits);
        let mut count = 0;
        let names = program.values().map(|(value, _)| {
            grouped.is_named(value).then(|| {
                count += 1;
                namer.name(&format!("t{count}"))
            })
        });
        let names = names.collect();
        Printer { program, grouped, load, names }
    }

    fn statements(&self, blocks: &[Block]) -> Vec<Statement> {
        let values = blocks.iter().flat_map(|block| &block.statements);
        let statements = values.filter_map(|value| {
            let name = self.names[value.index()].clone()?;
            Some(Statement::Let { name, value: self.expression(*value) })
        });
        statements.collect()
    }

    fn part(&self, part: &program::Part, name: String, statements: Vec<Statement>) -> Part {
        let named = |values: &[Value]| {
            values.iter().filter_map(|value| self.names[value.index()].clone()).collect::<Vec<_>>()
        };
        let sources = self.grouped.sources(self.program, part);
        let mut entering: Vec<String> =
            sources.iter().filter_map(|source| (self.load)(*source)).collect();
        entering.extend(named(&part.entering));
        let reads_fields = sources.iter().any(|source| matches!(source, Source::Field(_)));
        Part { name, entering, leaving: named(&part.leaving), statements, reads_fields }
    }

    /// Makes the operand for a value: its variable if it has one, otherwise its expression.
    fn operand(&self, value: Value) -> Expression {
        match &self.names[value.index()] {
            Some(name) => Expression::Variable(name.clone()),
            None => self.expression(value),
        }
    }

    /// Makes the expression of a value's operation. `Limits::expression` bounds the depth of the recursion.
    fn expression(&self, value: Value) -> Expression {
        let binary = |operator: Operator, a: Value, b: Value| {
            Expression::Binary(operator, Box::new([self.operand(a), self.operand(b)]))
        };
        match self.program.operation(value) {
            Operation::Constant(constant) => Expression::Constant(constant.get()),
            Operation::Load(Source::Field(index)) => Expression::Field(index as usize),
            Operation::Load(source) => {
                Expression::Variable((self.load)(source).unwrap_or_default())
            }
            Operation::Add(a, b) => binary(Operator::Add, a, b),
            Operation::Sub(a, b) => binary(Operator::Sub, a, b),
            Operation::Mul(a, b) => binary(Operator::Mul, a, b),
            Operation::Div(a, b) => binary(Operator::Div, a, b),
            Operation::Neg(a) => Expression::Negative(Box::new(self.operand(a))),
            Operation::MulAdd(a, b, c) => {
                Expression::MulAdd(Box::new([a, b, c].map(|value| self.operand(value))))
            }
            Operation::Call(function, a) => Expression::Call(function, Box::new(self.operand(a))),
        }
    }
}
