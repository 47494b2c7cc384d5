//! Operation counts of programs and functions.

use robot_symbolic::Function as Call;

use crate::module::Function;
use crate::program::{Limits, Operation, Program, Source, Stage, Statements, Value};

/// The operations of a program.
///
/// Subtractions count as additions, and a doubling `2 x` counts as one addition. Changes of sign are free and counted
/// separately. A fused multiply-add counts as one multiplication and one addition; `fused` is the number of these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions, reciprocals included.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Absolute values, signs and hyperbolic tangents.
    pub other: usize,
    /// Changes of sign.
    pub neg: usize,
    /// Sines.
    pub sin: usize,
    /// Cosines.
    pub cos: usize,
    /// The pairs of a multiplication and an addition that form one fused instruction.
    pub fused: usize,
    /// Named values in the printed code, if its layout is known ([`FunctionCounts::laid_out`]); otherwise 0.
    pub temporaries: usize,
}

impl Counts {
    /// The counts of a program.
    #[must_use]
    pub fn of(program: &Program) -> Counts {
        Counts::of_operations(program, |_| true)
    }

    /// The operations of a call, without those that a constructor can do beforehand.
    #[must_use]
    pub fn of_calls(program: &Program) -> Counts {
        let stages = program.stages();
        Counts::of_operations(program, |value| stages[value.index()] == Stage::Call)
    }

    /// The sum of multiplications, additions and divisions, which is the measure used in the literature (inverse
    /// dynamics there has no divisions).
    #[must_use]
    pub fn operations(&self) -> usize {
        self.mul + self.add + self.div
    }

    fn of_operations(program: &Program, include: impl Fn(Value) -> bool) -> Counts {
        let mut counts = Counts::default();
        for (value, operation) in program.values() {
            if include(value) {
                counts.count(program, operation);
            }
        }
        counts
    }

    fn count(&mut self, program: &Program, operation: Operation) {
        let is_two = |value: Value| match program.operation(value) {
            Operation::Constant(constant) => constant.get() == 2.0,
            _ => false,
        };
        match operation {
            Operation::Constant(_) | Operation::Load(_) => {}
            Operation::Add(..) | Operation::Sub(..) => self.add += 1,
            Operation::Mul(a, b) if is_two(a) || is_two(b) => self.add += 1,
            Operation::Mul(..) => self.mul += 1,
            Operation::Div(..) | Operation::Call(Call::RecipPositive, _) => self.div += 1,
            Operation::Neg(_) => self.neg += 1,
            Operation::MulAdd(..) => {
                self.mul += 1;
                self.add += 1;
                self.fused += 1;
            }
            Operation::Call(Call::Sin, _) => self.sin += 1,
            Operation::Call(Call::Cos, _) => self.cos += 1,
            Operation::Call(Call::Sqrt, _) => self.sqrt += 1,
            Operation::Call(Call::Abs | Call::Sign | Call::Tanh, _) => self.other += 1,
        }
    }
}

/// The operation counts of a function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FunctionCounts {
    /// The operations of each call: the angles, their sines and cosines, and the arithmetic.
    pub call: Counts,
    /// The operations of the part of the constructor that this function needs, done once for each set of parameters.
    pub constructor: Counts,
}

impl FunctionCounts {
    pub(crate) fn new(constructor: &Program, function: &Function) -> FunctionCounts {
        let mut call = Counts::of(&function.core);
        let angles = Counts::of(&function.angles);
        call.mul += angles.mul;
        call.add += angles.add;
        call.div += angles.div;
        call.sqrt += angles.sqrt;
        call.other += angles.other;
        call.neg += angles.neg;
        let sources = function.core.sources();
        call.sin += sources.iter().filter(|source| matches!(source, Source::Sin(_))).count();
        call.cos += sources.iter().filter(|source| matches!(source, Source::Cos(_))).count();
        let needed = needed_fields(constructor, function);
        let mut constructor_counts = Counts::of_operations(constructor, |v| needed[v.index()]);
        constructor_counts.temporaries = constructor
            .values()
            .filter(|(value, operation)| needed[value.index()] && !operation.is_leaf())
            .count();
        FunctionCounts { call, constructor: constructor_counts }
    }

    /// Sets `temporaries` to the number of named values that the function's arithmetic has if it is printed within
    /// these limits.
    #[must_use]
    pub fn laid_out(mut self, function: &Function, limits: &Limits) -> FunctionCounts {
        self.call.temporaries = Statements::new(&function.core, limits).count();
        self
    }
}

/// For each value of the constructor, whether the function needs it.
fn needed_fields(constructor: &Program, function: &Function) -> Vec<bool> {
    let mut needed = vec![false; constructor.operations().len()];
    for source in function.core.sources().into_iter().chain(function.angles.sources()) {
        if let Source::Field(field) = source {
            needed[constructor.results()[field as usize].index()] = true;
        }
    }
    for (value, operation) in constructor.values().rev() {
        if needed[value.index()] {
            for operand in operation.operands() {
                needed[operand.index()] = true;
            }
        }
    }
    needed
}

/// The operation counts after a pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassCounts {
    /// The name of the pass; `as built` for the program before any pass, `constructor` for the program after its
    /// operations on parameters were moved into the constructor.
    pub pass: &'static str,
    /// The operations of a call after the pass.
    pub counts: Counts,
}
