//! Fusing: a product and the sums that alone use it become multiply-adds.

use crate::program::{Builder, Operation, Program, Value};

/// Forms a multiply-add of each sum with a product, where every use of the product is a sum: then
/// the product by itself is needed no more. Changes of sign are part of the instruction.
///
/// Without a fused instruction on the target, not a bit changes.
#[must_use]
pub fn run(program: &Program) -> Program {
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

/// For each value, whether it is a product that sums alone use, not both operands of one sum.
fn fusible(program: &Program) -> Vec<bool> {
    let is_product = |value: &Value| matches!(program.operation(*value), Operation::Mul(..));
    let mut fusible: Vec<bool> = program.values().map(|(value, _)| is_product(&value)).collect();
    for value in program.results() {
        fusible[value.index()] = false;
    }
    for operation in program.operations() {
        match *operation {
            Operation::Add(a, b) | Operation::Sub(a, b) if a != b => {}
            _ => operation.operands().for_each(|operand| fusible[operand.index()] = false),
        }
    }
    // One product alone can be part of the instruction: of two, the second.
    for operation in program.operations() {
        if let Operation::Add(a, b) | Operation::Sub(a, b) = *operation
            && fusible[b.index()]
        {
            fusible[a.index()] = false;
        }
    }
    fusible
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::testing::assert_same_bits;

    #[test]
    fn bits_stay() {
        assert_same_bits("fusing", run);
    }
}
