//! Moves operations that depend only on parameters into a constructor.

use rustc_hash::FxHashMap;

use crate::program::{Builder, Operation, Program, Source, Stage, Value};

/// Rewrites `programs` so that they load fields instead of parameters, and returns the constructor
/// whose results are these fields, each once for all programs.
///
/// A field is a largest value that depends only on parameters: the programs contain no operation
/// that could be done before the call, except changes of sign, which are free.
pub(crate) fn hoist_parameters<'a>(programs: impl Iterator<Item = &'a mut Program>) -> Program {
    let mut constructor = Constructor::default();
    for program in programs {
        *program = constructor.hoist(program);
    }
    constructor.builder.finish(constructor.fields)
}

#[derive(Default)]
struct Constructor {
    builder: Builder,
    fields: Vec<Value>,
    index: FxHashMap<Value, u32>,
}

impl Constructor {
    fn hoist(&mut self, program: &Program) -> Program {
        let stages = program.stages();
        let mut builder = Builder::new();
        let mut early: FxHashMap<Value, Value> = FxHashMap::default();
        let mut late: FxHashMap<Value, Value> = FxHashMap::default();
        for (value, operation) in program.values() {
            match stages[value.index()] {
                Stage::Constant => {
                    early.insert(value, self.builder.apply(operation.map(|a| early[&a])));
                    late.insert(value, builder.apply(operation.map(|a| late[&a])));
                }
                Stage::Parameters => {
                    early.insert(value, self.builder.apply(operation.map(|a| early[&a])));
                }
                Stage::Call => {
                    let operation = operation.map(|a| {
                        *late.entry(a).or_insert_with(|| self.load(&mut builder, early[&a]))
                    });
                    late.insert(value, builder.apply(operation));
                }
            }
        }
        let results = program.results().iter().map(|value| {
            *late.entry(*value).or_insert_with(|| self.load(&mut builder, early[value]))
        });
        let results = results.collect();
        builder.finish(results)
    }

    /// Loads the field with a value of the constructor, and adds the field if there is none.
    fn load(&mut self, builder: &mut Builder, value: Value) -> Value {
        match self.builder.operation(value) {
            Operation::Constant(constant) => builder.constant(constant.get()),
            Operation::Neg(positive) => {
                let field = self.load(builder, positive);
                builder.neg(field)
            }
            _ => {
                let next = self.fields.len() as u32;
                let field = *self.index.entry(value).or_insert(next);
                if field == next {
                    self.fields.push(value);
                }
                builder.load(Source::Field(field))
            }
        }
    }
}
