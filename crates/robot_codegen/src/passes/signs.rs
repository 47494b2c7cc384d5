//! Signs: a change of sign is taken into a subtraction or a constant where that is possible.

use crate::program::{Builder, Operation, Program, Value};

/// How deep a sign may sink to find a place.
const DEPTH: usize = 12;

/// Lets the negatives of values that nothing else uses sink to a difference, which turns round, or
/// to a constant factor. No bits of a finite result change but the signs of zeros.
#[must_use]
pub fn run(program: &Program) -> Program {
    let mut signs =
        Signs { program, uses: program.uses(), flipped: vec![false; program.operations().len()] };
    for operation in program.operations() {
        if let Operation::Neg(value) = *operation
            && signs.can_sink(value, DEPTH)
        {
            signs.sink(value, DEPTH);
        }
    }
    signs.rebuild()
}

struct Signs<'p> {
    program: &'p Program,
    uses: Vec<u32>,
    /// The values that are computed as their negatives.
    flipped: Vec<bool>,
}

impl Signs<'_> {
    /// Whether the value can become its negative at no cost: nothing else uses it, nor what the
    /// sign sinks through.
    fn can_sink(&self, value: Value, depth: usize) -> bool {
        if self.uses[value.index()] != 1 || depth == 0 {
            return false;
        }
        match self.program.operation(value) {
            Operation::Sub(..) => true,
            Operation::Mul(a, b) | Operation::Div(a, b) | Operation::Add(a, b) => {
                [a, b].into_iter().any(|operand| self.takes(operand, depth))
            }
            _ => false,
        }
    }

    /// Whether an operand takes the sign: a constant does, whatever else uses it.
    fn takes(&self, operand: Value, depth: usize) -> bool {
        self.is_constant(operand) || self.can_sink(operand, depth - 1)
    }

    fn is_constant(&self, value: Value) -> bool {
        matches!(self.program.operation(value), Operation::Constant(_))
    }

    fn sink(&mut self, value: Value, depth: usize) {
        self.flipped[value.index()] = true;
        if let Operation::Mul(a, b) | Operation::Div(a, b) | Operation::Add(a, b) =
            self.program.operation(value)
            && !self.is_constant(a)
            && !self.is_constant(b)
        {
            let taker = if self.takes(a, depth) { a } else { b };
            self.sink(taker, depth - 1);
        }
    }

    fn rebuild(&self) -> Program {
        let mut builder = Builder::new();
        let mut values: Vec<Value> = Vec::with_capacity(self.flipped.len());
        for (value, operation) in self.program.values() {
            let new = if self.flipped[value.index()] {
                self.negative(operation, &values, &mut builder)
            } else {
                match operation {
                    Operation::Neg(a) if self.flipped[a.index()] => values[a.index()],
                    _ => builder.push(operation.map(|operand| values[operand.index()])),
                }
            };
            values.push(new);
        }
        let results = self.program.results().iter().map(|value| values[value.index()]);
        super::dead_code::run(&builder.finish(results.collect()))
    }

    /// The negative of an operation of which an operand is flipped already, or a constant.
    fn negative(&self, operation: Operation, values: &[Value], builder: &mut Builder) -> Value {
        let at = |value: Value| values[value.index()];
        let mut operand = |value: Value| match self.program.operation(value) {
            Operation::Constant(constant) => (builder.constant(-constant.get()), true),
            _ => (at(value), self.flipped[value.index()]),
        };
        let negative = match operation {
            Operation::Sub(a, b) => Operation::Sub(at(b), at(a)),
            Operation::Mul(a, b) | Operation::Div(a, b) | Operation::Add(a, b) => {
                // Of two operands that could take the sign, one does.
                let (first, is_negative) = operand(a);
                let (first, second, order) =
                    if is_negative { (first, at(b), false) } else { (operand(b).0, at(a), true) };
                match operation {
                    Operation::Add(..) => Operation::Sub(first, second),
                    _ if order => operation.map(|value| if value == b { first } else { second }),
                    _ => operation.map(|value| if value == a { first } else { second }),
                }
            }
            operation => operation,
        };
        builder.push(negative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Counts;
    use crate::passes::testing::assert_same_bits;
    use crate::program::Source;

    #[test]
    fn bits_stay() {
        assert_same_bits("signs", run);
    }

    #[test]
    fn a_sign_sinks_to_a_difference() {
        let mut b = Builder::new();
        let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
        let (difference, square) = (b.sub(x, y), b.mul(z, z));
        let product = b.mul(difference, z);
        let sum = b.add(product, square);
        let (half, minus) = (b.constant(0.5), b.neg(sum));
        let scaled = b.mul(half, y);
        let results = vec![minus, b.neg(scaled)];
        let program = b.finish(results);
        assert_eq!(Counts::of(&program).neg, 2);
        assert_eq!(Counts::of(&run(&program)).neg, 0);
    }
}
