//! Expressions in C.

use robot_symbolic::Function as Call;

use super::names::Names;
use crate::backend::common::Scalar;
use crate::backend::flat::{Expression, Spelling, infix};
use crate::trigonometry::Trigonometry;

/// The spelling of expressions of one number type in C.
pub(super) struct Expressions<'a> {
    pub(super) names: &'a Names,
    pub(super) fields: &'a [String],
    pub(super) scalar: Scalar,
    pub(super) trigonometry: Trigonometry,
}

impl Expressions<'_> {
    /// Prints an expression.
    pub(super) fn text(&self, expression: &Expression) -> String {
        infix(expression, self)
    }

    /// The name of a helper for this number type.
    fn helper(&self, name: &str) -> String {
        self.names.private(&helper(name, self.scalar))
    }

    /// The name of a function of `<math.h>` for this number type.
    fn library(&self, name: &str) -> String {
        library(name, self.scalar)
    }
}

/// The name of a helper for a number type, without that of the module.
pub(super) fn helper(name: &str, scalar: Scalar) -> String {
    match scalar {
        Scalar::F64 => format!("{name}_f64"),
        Scalar::F32 => format!("{name}_f32"),
    }
}

/// The name of a function of `<math.h>` for a number type.
pub(super) fn library(name: &str, scalar: Scalar) -> String {
    match scalar {
        Scalar::F64 => name.to_owned(),
        Scalar::F32 => format!("{name}f"),
    }
}

/// Prints a number that is not negative.
pub(super) fn literal(size: f64, scalar: Scalar) -> String {
    let suffix = if scalar == Scalar::F32 { "F" } else { "" };
    format!("{}{suffix}", scalar.digits(size))
}

/// Prints a number.
pub(super) fn number(value: f64, scalar: Scalar) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    format!("{sign}{}", literal(value.abs(), scalar))
}

impl Spelling for Expressions<'_> {
    fn constant(&self, size: f64) -> String {
        literal(size, self.scalar)
    }

    fn field(&self, index: usize) -> String {
        format!("model->{}", self.fields[index])
    }

    fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
        format!("{}({a}, {b}, {c})", self.helper("mul_add"))
    }

    fn call(&self, function: Call, argument: String) -> String {
        let name = match function {
            Call::Sqrt => self.library("sqrt"),
            Call::Abs => self.library("fabs"),
            Call::Sign => self.helper("sign"),
            Call::Tanh => self.helper("tanh"),
            Call::RecipPositive => self.helper("recip_positive"),
            Call::Sin | Call::Cos => match self.trigonometry {
                Trigonometry::Polynomial => self.helper(function.name()),
                Trigonometry::Standard => self.library(function.name()),
            },
        };
        format!("{name}({argument})")
    }
}
