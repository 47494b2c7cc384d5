//! Translation of the statements of a tree to instructions.

use std::collections::HashMap;

use robot_symbolic::Function as Call;
use wasm_encoder::ValType;

use super::code::{Code, Kind, Local};
use super::helpers::Functions;
use super::module::Assembly;
use crate::backend::flat::{Body, Expression, Operator, Part, Statement};

/// The locals with the addresses that a body reads.
pub(super) struct Places<'p> {
    /// The local with the address of the model, or of the parameters in the constructor.
    pub(super) model: Option<Local>,
    /// The locals with the addresses of the inputs.
    pub(super) inputs: &'p [Local],
    /// The local with the number of bytes from one column of an array to the next, if entries are in columns.
    pub(super) stride: Option<Local>,
}

/// The last use of a variable that the results use; other last uses are indices of statements.
const END: usize = usize::MAX;

/// Writes the statements of a body; its variables are then in locals for the results.
pub(super) struct Writer<'w> {
    pub(super) code: Code,
    functions: &'w Functions,
    places: &'w Places<'w>,
    locals: HashMap<&'w str, Local>,
    last_uses: HashMap<&'w str, usize>,
    /// The locals whose variables are no longer used.
    free: Vec<Local>,
    /// The addresses of variables that parts of the body pass on.
    slots: &'w HashMap<&'w str, u32>,
}

/// Reserves addresses for the variables that the parts of a body pass on.
pub(super) fn slots<'b>(
    body: &'b Body,
    kind: Kind,
    assembly: &mut Assembly,
) -> HashMap<&'b str, u32> {
    let mut slots = HashMap::new();
    let mut next = assembly.shared();
    for name in body.parts.iter().flat_map(|part| part.entering.iter().chain(&part.leaving)) {
        slots.entry(name.as_str()).or_insert_with(|| {
            next += kind.bytes();
            next - kind.bytes()
        });
    }
    assembly.reserve(next);
    slots
}

/// Adds the functions of the parts of a body; returns their indices.
pub(super) fn parts(
    body: &Body,
    kind: Kind,
    functions: &Functions,
    slots: &HashMap<&str, u32>,
    assembly: &mut Assembly,
) -> Vec<u32> {
    let part = |part: &Part| {
        let places = Places { model: Some(Local(0)), inputs: &[], stride: None };
        let code = Code::new(kind, vec![ValType::I32], vec![]);
        let mut writer = Writer::new(code, functions, &places, slots);
        writer.statements(&part.statements, &[], &[]);
        assembly.add(writer.code)
    };
    body.parts.iter().map(part).collect()
}

impl<'w> Writer<'w> {
    pub(super) fn new(
        code: Code,
        functions: &'w Functions,
        places: &'w Places<'w>,
        slots: &'w HashMap<&'w str, u32>,
    ) -> Writer<'w> {
        let (locals, last_uses) = (HashMap::new(), HashMap::new());
        Writer { code, functions, places, locals, last_uses, free: vec![], slots }
    }

    /// Writes statements. `results` are expressions that the caller computes later from their variables; `parts` are
    /// the indices of the functions of parts.
    pub(super) fn statements(
        &mut self,
        statements: &'w [Statement],
        results: &'w [Expression],
        parts: &[u32],
    ) {
        for (index, statement) in statements.iter().enumerate() {
            if let Some(value) = statement.expression() {
                self.use_at(value, index);
            }
        }
        for value in results {
            self.use_at(value, END);
        }
        for (index, statement) in statements.iter().enumerate() {
            self.statement(statement, index, parts);
        }
    }

    fn use_at(&mut self, value: &'w Expression, place: usize) {
        variables(value, &mut |name| {
            self.last_uses.insert(name, place);
        });
    }

    fn statement(&mut self, statement: &'w Statement, index: usize, parts: &[u32]) {
        match statement {
            Statement::Parameter { name, parameter } => {
                self.address(self.places.model);
                self.code.load(8 * *parameter as u32);
                self.set(name, index);
            }
            Statement::Entry { name, input, entry } => {
                self.entry(self.places.inputs[*input], *entry as u32);
                self.set(name, index);
            }
            Statement::Circular { sine, cosine, angle } => {
                self.value(angle);
                self.code.call(self.functions.sin_cos);
                self.release(angle, index);
                self.set(cosine, index);
                self.set(sine, index);
            }
            Statement::Let { name, value } => {
                self.value(value);
                self.release(value, index);
                self.set(name, index);
            }
            Statement::Part(part) => {
                self.address(self.places.model);
                self.code.call(parts[*part]);
            }
        }
    }

    fn address(&mut self, local: Option<Local>) {
        match local {
            Some(local) => self.code.get(local),
            None => self.code.whole(0),
        };
    }

    /// Loads an entry of an input.
    fn entry(&mut self, array: Local, entry: u32) {
        let offset = self.entry_address(array, entry);
        self.code.load(offset);
    }

    /// Writes the base address of an entry and returns the offset to add to it.
    pub(super) fn entry_address(&mut self, array: Local, entry: u32) -> u32 {
        self.code.get(array);
        match self.places.stride {
            None => entry * self.code.kind.size(),
            Some(stride) => {
                column(&mut self.code, stride, entry);
                0
            }
        }
    }

    /// Assigns the value on the stack to a variable.
    fn set(&mut self, name: &'w str, index: usize) {
        if !self.last_uses.contains_key(name) && !self.slots.contains_key(name) {
            self.code.drop();
            return;
        }
        let ty = self.code.kind.value();
        let local = self.free.pop().unwrap_or_else(|| self.code.local(ty));
        self.code.set(local);
        if let Some(slot) = self.slots.get(name) {
            self.code.whole(0).get(local).store(*slot);
        }
        // A variable that only parts use does not need the local any longer.
        if self.last_uses.get(name).is_none_or(|last| *last <= index) {
            self.free.push(local);
        } else {
            self.locals.insert(name, local);
        }
    }

    /// Frees the locals of variables that an expression used for the last time.
    fn release(&mut self, value: &'w Expression, index: usize) {
        variables(value, &mut |name| {
            if self.last_uses.get(name) == Some(&index) {
                self.free.extend(self.locals.remove(name));
            }
        });
    }

    /// Writes the computation of an expression, whose value is then on the stack.
    pub(super) fn value(&mut self, expression: &Expression) {
        match expression {
            Expression::Constant(value) => {
                self.code.number(*value);
            }
            Expression::Variable(name) => match self.locals.get(name.as_str()) {
                Some(local) => {
                    self.code.get(*local);
                }
                None => {
                    let slot = self.slots.get(name.as_str()).copied().unwrap_or_default();
                    self.code.whole(0).load(slot);
                }
            },
            Expression::Field(index) => {
                self.address(self.places.model);
                let size = self.code.kind.size();
                self.code.load_number(size * *index as u32);
            }
            Expression::Binary(operator, operands) => {
                operands.iter().for_each(|operand| self.value(operand));
                match operator {
                    Operator::Add => self.code.add(),
                    Operator::Sub => self.code.sub(),
                    Operator::Mul => self.code.mul(),
                    Operator::Div => self.code.div(),
                };
            }
            Expression::Negative(operand) => {
                self.value(operand);
                self.code.neg();
            }
            Expression::MulAdd(operands) => {
                let [a, b, c] = &**operands;
                self.value(a);
                self.value(b);
                self.code.mul();
                self.value(c);
                self.code.add();
            }
            Expression::Call(function, operand) => {
                self.value(operand);
                self.call(*function);
            }
        }
    }

    fn call(&mut self, function: Call) {
        let Functions { sin_cos, cos, sign, tanh, recip_positive } = *self.functions;
        match function {
            Call::Sin => self.code.call(sin_cos).drop(),
            Call::Cos => self.code.call(cos),
            Call::Sqrt => self.code.sqrt(),
            Call::Abs => self.code.abs(),
            Call::Sign => self.code.call(sign),
            Call::Tanh => self.code.call(tanh),
            Call::RecipPositive => self.code.call(recip_positive),
        };
    }
}

/// Visits the variables of an expression.
fn variables<'e>(value: &'e Expression, visit: &mut impl FnMut(&'e str)) {
    match value {
        Expression::Constant(_) | Expression::Field(_) => {}
        Expression::Variable(name) => visit(name),
        Expression::Binary(_, operands) => operands.iter().for_each(|one| variables(one, visit)),
        Expression::MulAdd(operands) => operands.iter().for_each(|one| variables(one, visit)),
        Expression::Negative(operand) | Expression::Call(_, operand) => variables(operand, visit),
    }
}

/// Adds to the address on the stack the distance to a column; columns are `stride` bytes apart.
pub(super) fn column(code: &mut Code, stride: Local, entry: u32) {
    match entry {
        0 => {}
        1 => {
            code.get(stride).sink().i32_add();
        }
        _ => {
            code.get(stride).whole(entry).sink().i32_mul().i32_add();
        }
    }
}
