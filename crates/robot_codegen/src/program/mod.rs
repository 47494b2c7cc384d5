//! Straight-line programs in static single assignment.
//!
//! A [`Program`] is a list of operations, each on the values of earlier ones, and a list of the values that
//! are its results. There are no loops and no conditionals. Constants and loads are operations too, but they
//! cost nothing and are printed as operands.

mod builder;
mod constant;
mod print;
mod statements;

pub use builder::Builder;
pub(crate) use constant::DoubleDouble;
use robot_symbolic::Function;
pub use statements::{Block, Limits, Part, Statements};

/// The value that an operation of a [`Program`] computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Value(pub(crate) u32);

impl Value {
    /// The position of the operation in its program.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A floating-point constant, compared by its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Constant(u64);

impl Constant {
    /// The constant with this value; −0 becomes +0.
    #[must_use]
    pub fn new(value: f64) -> Constant {
        Constant(if value == 0.0 { 0 } else { value.to_bits() })
    }

    /// The value.
    #[must_use]
    pub fn get(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// The place from which a load reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// A parameter of the module, by its index.
    Parameter(u32),
    /// A field of the model, which the constructor computed, by its index.
    Field(u32),
    /// An entry of an input of the function, by an index that runs over all its inputs.
    Input(u32),
    /// The sine of an angle of the function.
    Sin(u32),
    /// The cosine of an angle of the function.
    Cos(u32),
}

/// One operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Operation {
    /// A constant.
    Constant(Constant),
    /// A load.
    Load(Source),
    /// a + b
    Add(Value, Value),
    /// a − b
    Sub(Value, Value),
    /// a b
    Mul(Value, Value),
    /// a / b
    Div(Value, Value),
    /// −a
    Neg(Value),
    /// a b + c, with one rounding if the target has the instruction, otherwise with two.
    MulAdd(Value, Value, Value),
    /// A function of one argument.
    Call(Function, Value),
}

impl Operation {
    /// The operands, in order.
    pub fn operands(self) -> impl Iterator<Item = Value> {
        let operands = match self {
            Operation::Constant(_) | Operation::Load(_) => [None; 3],
            Operation::Neg(a) | Operation::Call(_, a) => [Some(a), None, None],
            Operation::Add(a, b)
            | Operation::Sub(a, b)
            | Operation::Mul(a, b)
            | Operation::Div(a, b) => [Some(a), Some(b), None],
            Operation::MulAdd(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }

    /// The same operation with other operands.
    #[must_use]
    pub fn map(self, mut operand: impl FnMut(Value) -> Value) -> Operation {
        match self {
            Operation::Constant(_) | Operation::Load(_) => self,
            Operation::Neg(a) => Operation::Neg(operand(a)),
            Operation::Call(function, a) => Operation::Call(function, operand(a)),
            Operation::Add(a, b) => Operation::Add(operand(a), operand(b)),
            Operation::Sub(a, b) => Operation::Sub(operand(a), operand(b)),
            Operation::Mul(a, b) => Operation::Mul(operand(a), operand(b)),
            Operation::Div(a, b) => Operation::Div(operand(a), operand(b)),
            Operation::MulAdd(a, b, c) => Operation::MulAdd(operand(a), operand(b), operand(c)),
        }
    }

    /// Whether the operation is a constant or a load, which are only operands.
    #[must_use]
    pub fn is_leaf(self) -> bool {
        matches!(self, Operation::Constant(_) | Operation::Load(_))
    }
}

/// The stage at which a value is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// At code generation.
    Constant,
    /// When the parameters are known.
    Parameters,
    /// At a call.
    Call,
}

/// A straight-line program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Program {
    operations: Vec<Operation>,
    results: Vec<Value>,
}

impl Program {
    /// Makes a program of these operations and results without changing them. Operands must be earlier operations.
    pub(crate) fn new(operations: Vec<Operation>, results: Vec<Value>) -> Program {
        debug_assert!(operations.iter().enumerate().all(|(index, operation)| {
            operation.operands().all(|operand| operand.index() < index)
        }));
        debug_assert!(results.iter().all(|value| value.index() < operations.len()));
        Program { operations, results }
    }

    /// The operations, each after its operands.
    #[must_use]
    pub fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// The operations with the values that they compute.
    pub fn values(&self) -> impl DoubleEndedIterator<Item = (Value, Operation)> + '_ {
        let numbered = self.operations.iter().enumerate();
        numbered.map(|(index, operation)| (Value(index as u32), *operation))
    }

    /// The operation that computes a value.
    #[must_use]
    pub fn operation(&self, value: Value) -> Operation {
        self.operations[value.index()]
    }

    /// The values that are the program's results; a value can occur several times.
    #[must_use]
    pub fn results(&self) -> &[Value] {
        &self.results
    }

    /// For each value, how often it is an operand or a result.
    #[must_use]
    pub fn uses(&self) -> Vec<u32> {
        let mut uses = vec![0; self.operations.len()];
        let operands = self.operations.iter().flat_map(|op| op.operands());
        for value in operands.chain(self.results.iter().copied()) {
            uses[value.index()] += 1;
        }
        uses
    }

    /// For each value, the stage at which it is known.
    #[must_use]
    pub fn stages(&self) -> Vec<Stage> {
        let mut stages: Vec<Stage> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            stages.push(match operation {
                Operation::Constant(_) => Stage::Constant,
                Operation::Load(Source::Parameter(_)) => Stage::Parameters,
                Operation::Load(_) => Stage::Call,
                _ => operation
                    .operands()
                    .map(|operand| stages[operand.index()])
                    .max()
                    .unwrap_or(Stage::Constant),
            });
        }
        stages
    }

    /// The sources that the program reads, sorted, each once.
    #[must_use]
    pub fn sources(&self) -> Vec<Source> {
        let loads = self.operations.iter().filter_map(|operation| match operation {
            Operation::Load(source) => Some(*source),
            _ => None,
        });
        let mut sources: Vec<_> = loads.collect();
        sources.sort_unstable();
        sources.dedup();
        sources
    }
}
