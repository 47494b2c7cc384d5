//! Signs: changes of sign are moved into subtractions or constants if possible.

use crate::program::{Builder, Operation, Program, Value};

/// The most operations through which a change of sign may be moved.
const DEPTH: usize = 12;

/// Moves the negation of a value that nothing else uses to a difference, whose operands are swapped, or
/// to a constant. The bits of finite results do not change, except for the signs of zeros.
#[must_use]
pub(super) fn run(program: &Program) -> Program {
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
    /// Whether the value can be replaced with its negative at no cost: nothing else uses it or any value through which
    /// the sign is moved.
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

    /// Whether an operand can take the sign. A constant always can, even if it has other users.
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

    /// Builds the negative of an operation: of a difference, or of an operation with a flipped operand or a constant.
    fn negative(&self, operation: Operation, values: &[Value], builder: &mut Builder) -> Value {
        let at = |value: Value| values[value.index()];
        let mut operand = |value: Value| match self.program.operation(value) {
            Operation::Constant(constant) => (builder.constant(-constant.get()), true),
            _ => (at(value), self.flipped[value.index()]),
        };
        let negative = match operation {
            Operation::Sub(a, b) => Operation::Sub(at(b), at(a)),
            Operation::Mul(a, b) | Operation::Div(a, b) | Operation::Add(a, b) => {
                // If both operands could take the sign, only one does.
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
    use crate::interpreter::evaluate;
    use crate::passes::dead_code;
    use crate::passes::testing::{assert_same_bits, random_program};
    use crate::program::Source;
    use crate::trigonometry::Trigonometry;

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

    /// The number of changes of sign that remain; checks that the results at two inputs stay the same.
    fn left(build: impl Fn(&mut Builder, [Value; 4]) -> Vec<Value>) -> usize {
        let mut b = Builder::new();
        let loads = [0, 1, 2, 3].map(|index| b.load(Source::Input(index)));
        let results = build(&mut b, loads);
        let program = b.finish(results);
        let found = run(&program);
        let load = |source| match source {
            Source::Input(index) => [3.0, 5.0, 7.0, 0.25][index as usize],
            other => panic!("{other:?}"),
        };
        let values = |program| evaluate(program, Trigonometry::Standard, load);
        assert_eq!(values(&found), values(&program), "{program:?}");
        assert_eq!(Counts::of(&found).operations(), Counts::of(&program).operations());
        Counts::of(&found).neg
    }

    /// −(x − y), by itself and as the left or right operand of each operation.
    #[test]
    fn every_operation_passes_a_sign_on() {
        type Make = fn(Value, Value) -> Operation;
        let operations: [Make; 4] =
            [Operation::Add, Operation::Mul, Operation::Div, Operation::Sub];
        for make in operations {
            for swapped in [false, true] {
                for constant in [false, true] {
                    let negatives = left(|b, [x, y, z, _]| {
                        let part = if constant { b.constant(2.5) } else { b.sub(x, y) };
                        let (first, second) = if swapped { (z, part) } else { (part, z) };
                        let value = b.push(make(first, second));
                        let scaled = b.push(Operation::Mul(value, z));
                        vec![b.neg(value), b.neg(scaled)]
                    });
                    // A value with two uses is not flipped, and the other operand of the second use cannot take the
                    // sign.
                    assert_eq!(negatives, 2);
                    let negatives = left(|b, [x, y, z, _]| {
                        let part = if constant { b.constant(2.5) } else { b.sub(x, y) };
                        let (first, second) = if swapped { (z, part) } else { (part, z) };
                        let value = b.push(make(first, second));
                        vec![b.neg(value)]
                    });
                    assert_eq!(negatives, 0);
                }
            }
        }
    }

    #[test]
    fn what_is_used_elsewhere_keeps_its_sign() {
        let shared = left(|b, [x, y, z, _]| {
            let difference = b.sub(x, y);
            let product = b.mul(difference, z);
            vec![b.neg(product), difference]
        });
        let call = left(|b, [x, y, z, _]| {
            let difference = b.sub(x, y);
            let root = b.call(robot_symbolic::Function::Abs, difference);
            let product = b.mul(root, z);
            vec![b.neg(product)]
        });
        // A constant is flipped even if it has other users, but only one of two operands is.
        let constant = left(|b, [x, y, z, w]| {
            let third = b.constant(1.5);
            let (first, second) = (b.mul(third, x), b.mul(third, y));
            let (both, other) = (b.sub(z, w), b.sub(w, x));
            let product = b.mul(both, other);
            let results = vec![b.neg(first), second, b.neg(product)];
            results
        });
        assert_eq!((shared, call, constant), (1, 1, 0));
    }

    /// A sign is moved through as many operations as the depth allows, and no further.
    #[test]
    fn a_sign_sinks_so_deep() {
        let through = |operations: usize| {
            left(|b, [x, y, z, _]| {
                let difference = b.sub(x, y);
                let value = (0..operations).fold(difference, |value, _| b.mul(value, z));
                vec![b.neg(value)]
            })
        };
        assert_eq!([1, DEPTH - 1, DEPTH, DEPTH + 1].map(through), [0, 0, 1, 1]);
    }

    #[test]
    fn no_program_costs_more_or_has_more_signs() {
        let (mut before, mut after) = (0, 0);
        for seed in 0..200 {
            let program = random_program(seed);
            let [old, new] = [&dead_code::run(&program), &run(&program)].map(Counts::of);
            assert!(new.neg <= old.neg && new.operations() <= old.operations(), "seed {seed}");
            (before, after) = (before + old.neg, after + new.neg);
        }
        assert!(after * 10 < before * 9, "{before} became {after}");
    }
}
