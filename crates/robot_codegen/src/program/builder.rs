//! A builder of programs in which each value occurs once.

use robot_symbolic::Function;
use rustc_hash::FxHashMap;

use super::{Constant, Operation, Program, Source, Value};

/// Builds a [`Program`] in which equal operations are one value.
///
/// Its rules change no bits of a finite result except the signs of zeros: operations on constants are evaluated,
/// 0 and ±1 vanish, signs move outward, and of a − b and b − a only the first to occur is computed.
#[derive(Debug, Default)]
pub struct Builder {
    operations: Vec<Operation>,
    index: FxHashMap<Operation, Value>,
}

impl Builder {
    /// Makes a builder with an empty program.
    #[must_use]
    pub fn new() -> Builder {
        Builder::default()
    }

    /// The operation that computes a value.
    #[must_use]
    pub fn operation(&self, value: Value) -> Operation {
        self.operations[value.index()]
    }

    /// Returns the program with these results.
    #[must_use]
    pub fn finish(self, results: Vec<Value>) -> Program {
        Program::new(self.operations, results)
    }

    /// Adds an operation without simplification; returns the earlier value if the operation already exists.
    pub fn push(&mut self, operation: Operation) -> Value {
        let next = Value(self.operations.len() as u32);
        let value = *self.index.entry(operation).or_insert(next);
        if value == next {
            self.operations.push(operation);
        }
        value
    }

    /// Adds an operation and applies the rules.
    pub fn apply(&mut self, operation: Operation) -> Value {
        match operation {
            Operation::Constant(value) => self.constant(value.get()),
            Operation::Load(source) => self.load(source),
            Operation::Add(a, b) => self.add(a, b),
            Operation::Sub(a, b) => self.sub(a, b),
            Operation::Mul(a, b) => self.mul(a, b),
            Operation::Div(a, b) => self.div(a, b),
            Operation::Neg(a) => self.neg(a),
            Operation::MulAdd(..) => self.push(operation),
            Operation::Call(function, a) => self.call(function, a),
        }
    }

    /// Adds a constant.
    pub fn constant(&mut self, value: f64) -> Value {
        self.push(Operation::Constant(Constant::new(value)))
    }

    /// Adds a load.
    pub fn load(&mut self, source: Source) -> Value {
        self.push(Operation::Load(source))
    }

    /// Adds a + b.
    pub fn add(&mut self, a: Value, b: Value) -> Value {
        match (self.positive(a), self.positive(b)) {
            (Signed(x, true), Signed(y, true)) => {
                let sum = self.add(x, y);
                return self.neg(sum);
            }
            (_, Signed(y, true)) => return self.sub(a, y),
            (Signed(x, true), _) => return self.sub(b, x),
            _ => {}
        }
        match (self.number(a), self.number(b)) {
            (Some(x), Some(y)) => self.constant(x + y),
            (Some(0.0), None) => b,
            (None, Some(0.0)) => a,
            _ => self.push(Operation::Add(a.min(b), a.max(b))),
        }
    }

    /// Adds a − b.
    pub fn sub(&mut self, a: Value, b: Value) -> Value {
        match (self.positive(a), self.positive(b)) {
            (_, Signed(y, true)) => return self.add(a, y),
            (Signed(x, true), _) => {
                let sum = self.add(x, b);
                return self.neg(sum);
            }
            _ => {}
        }
        match (self.number(a), self.number(b)) {
            (Some(x), Some(y)) => self.constant(x - y),
            (Some(0.0), None) => self.neg(b),
            (None, Some(0.0)) => a,
            _ if a == b => self.constant(0.0),
            _ => match self.index.get(&Operation::Sub(b, a)).copied() {
                Some(reverse) => self.neg(reverse),
                None => self.push(Operation::Sub(a, b)),
            },
        }
    }

    /// Adds a b.
    pub fn mul(&mut self, a: Value, b: Value) -> Value {
        let (Signed(x, minus_a), Signed(y, minus_b)) = (self.positive(a), self.positive(b));
        if minus_a || minus_b {
            let product = self.mul(x, y);
            return self.negate_if(minus_a != minus_b, product);
        }
        match (self.number(a), self.number(b)) {
            (Some(x), Some(y)) => self.constant(x * y),
            (Some(0.0), None) => a,
            (None, Some(0.0)) => b,
            (Some(1.0), None) => b,
            (None, Some(1.0)) => a,
            _ => self.push(Operation::Mul(a.min(b), a.max(b))),
        }
    }

    /// Adds a / b.
    pub fn div(&mut self, a: Value, b: Value) -> Value {
        let (Signed(x, minus_a), Signed(y, minus_b)) = (self.positive(a), self.positive(b));
        if minus_a || minus_b {
            let quotient = self.div(x, y);
            return self.negate_if(minus_a != minus_b, quotient);
        }
        match (self.number(a), self.number(b)) {
            (Some(x), Some(y)) => self.constant(x / y),
            (Some(0.0), None) => a,
            (None, Some(1.0)) => a,
            _ => self.push(Operation::Div(a, b)),
        }
    }

    /// Adds −a.
    pub fn neg(&mut self, a: Value) -> Value {
        match self.operation(a) {
            Operation::Neg(x) => x,
            Operation::Constant(value) => self.constant(-value.get()),
            _ => self.push(Operation::Neg(a)),
        }
    }

    /// Adds a function of a value.
    pub fn call(&mut self, function: Function, a: Value) -> Value {
        let Signed(x, minus) = self.positive(a);
        match function {
            Function::Abs | Function::Cos if minus => self.call(function, x),
            Function::Sin | Function::Sign | Function::Tanh if minus => {
                let value = self.call(function, x);
                self.neg(value)
            }
            _ => match self.number(a) {
                // These functions are exactly defined on every machine; the others are not.
                Some(x)
                    if matches!(
                        function,
                        Function::Sqrt | Function::Abs | Function::Sign | Function::RecipPositive
                    ) =>
                {
                    self.constant(function.apply(x))
                }
                _ => self.push(Operation::Call(function, a)),
            },
        }
    }

    /// Returns the number of a value that is a constant.
    fn number(&self, value: Value) -> Option<f64> {
        match self.operation(value) {
            Operation::Constant(constant) => Some(constant.get()),
            _ => None,
        }
    }

    /// Splits off the sign of −x or of a negative constant.
    fn positive(&mut self, value: Value) -> Signed {
        match self.operation(value) {
            Operation::Neg(x) => Signed(x, true),
            Operation::Constant(constant) if constant.get() < 0.0 => {
                Signed(self.constant(-constant.get()), true)
            }
            _ => Signed(value, false),
        }
    }

    fn negate_if(&mut self, negative: bool, value: Value) -> Value {
        if negative { self.neg(value) } else { value }
    }
}

/// A value and its sign: `true` stands for the negative of the value.
#[derive(Clone, Copy)]
struct Signed(Value, bool);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpreter::evaluate;
    use crate::trigonometry::Trigonometry;

    #[test]
    fn equal_operations_are_one_value() {
        let mut b = Builder::new();
        let (x, y) = (b.load(Source::Input(0)), b.load(Source::Input(1)));
        assert_eq!(b.add(x, y), b.add(y, x));
        assert_eq!(b.mul(x, y), b.mul(y, x));
        let (forth, back) = (b.sub(x, y), b.sub(y, x));
        assert_eq!(b.neg(forth), back);
        assert_ne!(b.div(x, y), b.div(y, x));
    }

    /// The rules keep the bits: the built programs have the values of the functions, for arguments of either sign.
    #[test]
    fn functions_of_negatives_keep_their_values() {
        for function in
            [Function::Abs, Function::Sin, Function::Cos, Function::Sign, Function::Tanh]
        {
            for x in [0.75, -0.75, 2.5, -2.5] {
                let mut b = Builder::new();
                let load = b.load(Source::Input(0));
                let minus = b.neg(load);
                let value = b.call(function, minus);
                let program = b.finish(vec![value]);
                let found = evaluate(&program, Trigonometry::Standard, |_| x);
                assert_eq!(found, [function.apply(-x)], "{function:?} of {}", -x);
            }
        }
    }

    #[test]
    fn signs_and_neutral_constants_vanish() {
        let mut b = Builder::new();
        let (x, y) = (b.load(Source::Input(0)), b.load(Source::Input(1)));
        let (minus_x, minus_y) = (b.neg(x), b.neg(y));
        let (zero, one, minus_two) = (b.constant(0.0), b.constant(-0.0), b.constant(-2.0));
        assert_eq!(zero, one);
        let one = b.constant(1.0);
        assert_eq!(b.add(x, zero), x);
        assert_eq!(b.mul(one, x), x);
        assert_eq!(b.mul(minus_x, minus_y), b.mul(x, y));
        assert_eq!(b.add(minus_x, y), b.sub(y, x));
        assert_eq!(b.sub(x, minus_y), b.add(x, y));
        let two = b.constant(2.0);
        assert_eq!(b.sub(x, minus_two), b.add(x, two));
        let product = b.mul(two, x);
        assert_eq!(b.mul(minus_x, two), b.neg(product));
        assert_eq!(b.call(Function::Abs, minus_x), b.call(Function::Abs, x));
        assert_eq!(b.call(Function::Sqrt, two), b.constant(2f64.sqrt()));
    }
}
