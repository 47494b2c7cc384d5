//! The text form of a program.
//!
//! Each value has a line, in order: `v4 = v0 * v3`. A load is printed as its source with an index from 0, a constant as
//! its digits. A parameter, and a value that is computed from parameters and constants alone, is followed by its stage.
//! The last line has the results.

use std::fmt::{Display, Formatter, Result};

use super::{Operation, Program, Source, Stage, Value};

impl Display for Value {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        write!(formatter, "v{}", self.0)
    }
}

impl Display for Source {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        let (name, index) = match self {
            Source::Parameter(index) => ("parameter", index),
            Source::Field(index) => ("field", index),
            Source::Input(index) => ("input", index),
            Source::Sin(index) => ("sin", index),
            Source::Cos(index) => ("cos", index),
        };
        write!(formatter, "{name}[{index}]")
    }
}

impl Display for Operation {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        match self {
            Operation::Constant(constant) => write!(formatter, "{:?}", constant.get()),
            Operation::Load(source) => write!(formatter, "{source}"),
            Operation::Add(a, b) => write!(formatter, "{a} + {b}"),
            Operation::Sub(a, b) => write!(formatter, "{a} - {b}"),
            Operation::Mul(a, b) => write!(formatter, "{a} * {b}"),
            Operation::Div(a, b) => write!(formatter, "{a} / {b}"),
            Operation::Neg(a) => write!(formatter, "-{a}"),
            Operation::MulAdd(a, b, c) => write!(formatter, "mul_add({a}, {b}, {c})"),
            Operation::Call(function, a) => write!(formatter, "{}({a})", function.name()),
        }
    }
}

impl Display for Program {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        for ((value, operation), stage) in self.values().zip(self.stages()) {
            write!(formatter, "{value} = {operation}")?;
            let is_constant = matches!(operation, Operation::Constant(_));
            match stage {
                Stage::Constant if !is_constant => writeln!(formatter, "  ; constant")?,
                Stage::Parameters => writeln!(formatter, "  ; of parameters")?,
                Stage::Constant | Stage::Call => writeln!(formatter)?,
            }
        }
        let results: Vec<String> = self.results().iter().map(ToString::to_string).collect();
        writeln!(formatter, "results: {}", results.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use robot_symbolic::Function;

    use super::*;
    use crate::program::Builder;

    #[test]
    fn every_value_has_a_line_with_its_stage() {
        let mut b = Builder::new();
        let [p, field, x, s, c] = [
            Source::Parameter(0),
            Source::Field(3),
            Source::Input(1),
            Source::Sin(0),
            Source::Cos(2),
        ]
        .map(|source| b.load(source));
        let third = b.constant(1.0 / 3.0);
        let root = b.push(Operation::Call(Function::Sqrt, third));
        let (square, product) = (b.mul(p, p), b.mul(x, s));
        let values = [
            Operation::Add(square, third),
            Operation::Sub(product, c),
            Operation::Div(field, square),
            Operation::Neg(x),
            Operation::MulAdd(x, s, root),
        ];
        let mut results = values.map(|operation| b.push(operation)).to_vec();
        results.push(results[0]);
        assert_eq!(
            b.finish(results).to_string(),
            "v0 = parameter[0]  ; of parameters\n\
             v1 = field[3]\n\
             v2 = input[1]\n\
             v3 = sin[0]\n\
             v4 = cos[2]\n\
             v5 = 0.3333333333333333\n\
             v6 = sqrt(v5)  ; constant\n\
             v7 = v0 * v0  ; of parameters\n\
             v8 = v2 * v3\n\
             v9 = v7 + v5  ; of parameters\n\
             v10 = v8 - v4\n\
             v11 = v1 / v7\n\
             v12 = -v2\n\
             v13 = mul_add(v2, v3, v6)\n\
             results: v9, v10, v11, v12, v13, v9\n"
        );
    }
}
