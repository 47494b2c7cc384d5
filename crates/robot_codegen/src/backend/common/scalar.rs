//! Floating-point types and the decimals of constants.

use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::{Operation, Program};

/// A floating-point type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    #[default]
    F64,
    /// Single precision. Parameters and the arithmetic of the constructor are in double precision; its results are
    /// rounded when they are stored.
    F32,
}

impl Scalar {
    /// The size of a number, in bytes.
    #[must_use]
    pub fn size(self) -> usize {
        match self {
            Scalar::F64 => 8,
            Scalar::F32 => 4,
        }
    }

    /// Returns the shortest decimal that reads back as the absolute value of `value`, rounded to this type. It has a
    /// decimal point or an exponent: `9.81`, `2.0`, `1e300`.
    #[must_use]
    pub fn digits(self, value: f64) -> String {
        match self {
            Scalar::F64 => format!("{:?}", value.abs()),
            Scalar::F32 => format!("{:?}", (value as f32).abs()),
        }
    }
}

/// Checks that a type can hold the constants of a module's functions.
///
/// # Errors
///
/// Each constant outside the range of the type, with its function: it would be infinite, or it is so small that it
/// would lose digits or become 0.
pub fn check_range(module: &Module, scalar: Scalar) -> Result<(), Errors> {
    let mut errors = vec![];
    let mut check = |program: &Program, place: &str| {
        for operation in program.operations() {
            let Operation::Constant(constant) = operation else { continue };
            let exact = constant.get();
            let value = format!("{exact:e}");
            let place = place.to_owned();
            let single = exact as f32;
            if single.is_infinite() {
                errors.push(Error::BeyondSinglePrecision { value, place });
            } else if exact != 0.0 && !single.is_normal() {
                errors.push(Error::BelowSinglePrecision { value, place });
            }
        }
    };
    if scalar == Scalar::F32 {
        for function in &module.functions {
            let place = format!("function `{}`", function.name);
            check(&function.angles, &place);
            check(&function.core, &place);
        }
    }
    Errors::check(errors, ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_read_back_as_the_same_number() {
        let values = [
            0.0,
            1.0,
            0.1,
            1.0 / 3.0,
            9.81,
            16_777_217.0,
            1e-30,
            3.0e38,
            1e300,
            5e-324,
            f64::MAX,
            1e15,
            1e16,
            1e-5,
            123_456_789.125,
            2.5e-7,
        ];
        for value in values {
            let text = Scalar::F64.digits(-value);
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
            assert!(text.len() < 26, "{text}");
            let single = Scalar::F32.digits(value);
            if value < 1e39 {
                assert_eq!(single.parse::<f32>().unwrap(), value as f32, "{single}");
                assert!(single.len() <= text.len(), "{single} {text}");
            }
        }
    }
}
