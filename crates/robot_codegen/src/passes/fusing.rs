//! Fusing: a product that is used only by one sum becomes a multiply-add together with that sum.

use crate::program::{Builder, Operation, Program, Value};

/// Forms a multiply-add from each sum and a product that only this sum uses. Changes of sign are part of
/// the instruction.
///
/// If the target has no fused instruction, no bits change.
#[must_use]
pub(crate) fn run(program: &Program) -> Program {
    let fusible = fusible(program);
    let mut builder = Builder::new();
    let mut values: Vec<Value> = Vec::with_capacity(fusible.len());
    for operation in program.operations() {
        let at = |value: Value| values[value.index()];
        let product = |value: Value| match program.operation(value) {
            Operation::Mul(x, y) if fusible[value.index()] => Some((at(x), at(y))),
            _ => None,
        };
        let value = match *operation {
            Operation::Add(a, b) => match (product(a), product(b)) {
                (_, Some((x, y))) => builder.push(Operation::MulAdd(x, y, at(a))),
                (Some((x, y)), None) => builder.push(Operation::MulAdd(x, y, at(b))),
                (None, None) => builder.add(at(a), at(b)),
            },
            Operation::Sub(a, b) => match (product(a), product(b)) {
                (_, Some((x, y))) => {
                    let x = builder.neg(x);
                    builder.push(Operation::MulAdd(x, y, at(a)))
                }
                (Some((x, y)), None) => {
                    let c = builder.neg(at(b));
                    builder.push(Operation::MulAdd(x, y, c))
                }
                (None, None) => builder.sub(at(a), at(b)),
            },
            operation => builder.apply(operation.map(at)),
        };
        values.push(value);
    }
    let results = program.results().iter().map(|value| values[value.index()]);
    super::dead_code::run(&builder.finish(results.collect()))
}

/// For each value, whether it becomes part of a multiply-add: a product that is used only once, as an operand of a sum
/// or difference; of two such operands, only the one that is known later.
///
/// A product that several sums use would have to be multiplied in each of them.
fn fusible(program: &Program) -> Vec<bool> {
    let mut fusible = vec![false; program.operations().len()];
    let uses = program.uses();
    for operation in program.operations() {
        if let Operation::Add(a, b) | Operation::Sub(a, b) = *operation {
            for operand in [a, b] {
                let is_product = matches!(program.operation(operand), Operation::Mul(..));
                fusible[operand.index()] = is_product && uses[operand.index()] == 1;
            }
        }
    }
    // Only one product can be part of the instruction. Of two, it is the one that is known later, because the
    // sum then does not wait for a separate product.
    let depths = depths(program);
    for operation in program.operations() {
        if let Operation::Add(a, b) | Operation::Sub(a, b) = *operation
            && fusible[a.index()]
            && fusible[b.index()]
        {
            let earlier = if depths[a.index()] > depths[b.index()] { b } else { a };
            fusible[earlier.index()] = false;
        }
    }
    fusible
}

/// For each value, the length of the longest chain of operations that ends with it.
fn depths(program: &Program) -> Vec<u32> {
    let mut depths: Vec<u32> = Vec::with_capacity(program.operations().len());
    for operation in program.operations() {
        let deepest = operation.operands().map(|operand| depths[operand.index()]).max();
        depths.push(deepest.map_or(0, |depth| depth + 1));
    }
    depths
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counts::Counts;
    use crate::interpreter::evaluate;
    use crate::passes::testing::assert_same_bits;
    use crate::program::Source;
    use crate::trigonometry::Trigonometry;

    #[test]
    fn bits_stay() {
        assert_same_bits("fusing", run);
    }

    /// x y z + u v: the sum waits for x y z anyway, and u v is known earlier.
    #[test]
    fn of_two_products_the_later_is_part_of_the_instruction() {
        for swapped in [false, true] {
            let mut b = Builder::new();
            let [x, y, z, u, v] = [0, 1, 2, 3, 4].map(|index| b.load(Source::Input(index)));
            let xy = b.mul(x, y);
            let (deep, shallow) = (b.mul(xy, z), b.mul(u, v));
            let sum = if swapped { b.add(shallow, deep) } else { b.add(deep, shallow) };
            let fused = run(&b.finish(vec![sum]));
            let Operation::MulAdd(a, b, addend) = fused.operation(fused.results()[0]) else {
                panic!("{fused:?}");
            };
            let operations = [a, b, addend].map(|value| fused.operation(value));
            assert!(operations.contains(&Operation::Load(Source::Input(2))), "{fused:?}");
            assert!(matches!(operations[2], Operation::Mul(..)), "{fused:?}");
        }
    }

    /// The numbers of multiply-adds and of operations of the program that `build` makes; checks that its values stay.
    fn fused(build: impl Fn(&mut Builder, [Value; 4]) -> Vec<Value>) -> (usize, usize) {
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
        let counts = Counts::of(&found);
        assert_eq!(counts.operations(), Counts::of(&program).operations());
        (counts.fused, found.operations().len())
    }

    #[test]
    fn sums_and_differences_take_a_product_on_either_side() {
        type Make = fn(Value, Value) -> Operation;
        let operations: [Make; 2] = [Operation::Add, Operation::Sub];
        for make in operations {
            for swapped in [false, true] {
                let (one, _) = fused(|b, [x, y, z, _]| {
                    let product = b.mul(x, y);
                    let (first, second) = if swapped { (z, product) } else { (product, z) };
                    vec![b.push(make(first, second))]
                });
                let (two, _) = fused(|b, [x, y, z, w]| {
                    let (first, second) = (b.mul(x, y), b.mul(z, w));
                    let (first, second) = if swapped { (second, first) } else { (first, second) };
                    vec![b.push(make(first, second))]
                });
                let (none, _) = fused(|b, [x, y, z, w]| {
                    let (first, second) = (b.div(x, y), b.add(z, w));
                    vec![b.push(make(first, second))]
                });
                assert_eq!((one, two, none), (1, 1, 0));
            }
        }
    }

    #[test]
    fn a_product_of_several_is_multiplied_once() {
        let sums = fused(|b, [x, y, z, w]| {
            let product = b.mul(x, y);
            vec![b.add(product, z), b.add(product, w)]
        });
        let result = fused(|b, [x, y, z, _]| {
            let product = b.mul(x, y);
            vec![b.add(product, z), product]
        });
        let square = fused(|b, [x, y, ..]| {
            let product = b.mul(x, y);
            vec![b.push(Operation::Add(product, product))]
        });
        assert_eq!((sums.0, result.0, square.0), (0, 0, 0));
    }

    /// Loads have the depth 0, and each operation is one deeper than the deepest of its operands.
    #[test]
    fn depths_are_those_of_the_deepest_operand() {
        let mut b = Builder::new();
        let [x, y, z] = [0, 1, 2].map(|index| b.load(Source::Input(index)));
        let square = b.mul(x, x);
        let sum = b.add(square, y);
        let product = b.mul(sum, z);
        let last = b.sub(product, square);
        assert_eq!(depths(&b.finish(vec![last])), [0, 0, 0, 1, 2, 3, 4]);
    }
}
