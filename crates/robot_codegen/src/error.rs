//! Errors in a specification, in a call or in the generation of code.

use std::fmt;

/// An error. Its message states the place, the reason and, if there is one, the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An output uses a symbol that is neither a parameter nor an entry of an input.
    #[error(
        "output `{output}` of function `{function}` uses the symbol `{symbol}`, which is neither a \
         parameter of the module nor an entry of an input of the function"
    )]
    UnknownSymbol {
        /// The function.
        function: String,
        /// The first output that uses the symbol.
        output: String,
        /// The symbol.
        symbol: String,
    },
    /// Two items of the same kind have the same name.
    #[error("{place}: the {kind} `{name}` is declared twice; rename one of them")]
    Duplicate {
        /// The module or one of its functions.
        place: String,
        /// The kind of item: parameter, function, input, symbol or output.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// The number of values does not match the shape, or the shape has more than two axes.
    #[error(
        "output `{output}` of function `{function}` has the shape {shape:?} but {values} values; \
         a shape is [], [n] or [rows, columns]"
    )]
    Shape {
        /// The function.
        function: String,
        /// The output.
        output: String,
        /// The stated shape.
        shape: Vec<usize>,
        /// The number of values.
        values: usize,
    },
    /// A function has no outputs.
    #[error("function `{function}` has no outputs; a function must compute at least one")]
    NoOutputs {
        /// The function.
        function: String,
    },
    /// The module has expressions from two graphs.
    #[error(
        "output `{output}` of function `{function}` belongs to a different graph than the module's \
         first output; build all expressions of a module in one graph"
    )]
    ForeignGraph {
        /// The function.
        function: String,
        /// The output.
        output: String,
    },
    /// A constant is not a finite number, because of a division by zero or because it exceeds the range of `f64`.
    #[error(
        "output `{output}` of function `{function}` contains a constant that is not a finite \
         number (a division by zero, the square root of a negative number, or a value outside \
         the range of f64)"
    )]
    NotFinite {
        /// The function.
        function: String,
        /// The first output with such a constant.
        output: String,
    },
    /// A nominal value that is not a finite number.
    #[error("the nominal value of the parameter `{parameter}` is not a finite number")]
    NominalNotFinite {
        /// The parameter.
        parameter: String,
    },
    /// A call of a function that the module does not have.
    #[error("the module `{module}` has no function `{function}`; it has {known}")]
    UnknownFunction {
        /// The module.
        module: String,
        /// The requested name.
        function: String,
        /// The names that exist.
        known: String,
    },
    /// A parameter that was given, but that the module does not have.
    #[error("the module `{module}` has no parameter `{parameter}`; it has {known}")]
    UnknownParameter {
        /// The module.
        module: String,
        /// The given name.
        parameter: String,
        /// The names that exist.
        known: String,
    },
    /// A parameter that has no nominal value and was not given.
    #[error("the parameter `{parameter}` does not have a nominal value; give it a value")]
    MissingParameter {
        /// The parameter.
        parameter: String,
    },
    /// An input that the function needs, but that was not given.
    #[error("function `{function}` needs the input `{input}`, an array of {length}")]
    MissingInput {
        /// The function.
        function: String,
        /// The input.
        input: String,
        /// The number of its entries.
        length: usize,
    },
    /// An input that was given, but that the function does not have.
    #[error("function `{function}` has no input `{input}`; it has {known}")]
    UnknownInput {
        /// The function.
        function: String,
        /// The given name.
        input: String,
        /// The names that exist.
        known: String,
    },
    /// An input of the wrong length.
    #[error("input `{input}` of function `{function}` has {expected} entries, not {found}")]
    InputLength {
        /// The function.
        function: String,
        /// The input.
        input: String,
        /// The number of entries that the function takes.
        expected: usize,
        /// The given number.
        found: usize,
    },
    /// The number of columns differs from the number of entries of the function's inputs or outputs.
    #[error("function `{function}` has {expected} entries of {kind}, not {found}")]
    Columns {
        /// The function.
        function: String,
        /// Either `inputs` or `outputs`.
        kind: &'static str,
        /// The number of entries.
        expected: usize,
        /// The given number of columns.
        found: usize,
    },
    /// Inputs or outputs have different numbers of states.
    #[error(
        "function `{function}` got {expected} states in one input and {found} in another; pass \
         all inputs for the same states"
    )]
    States {
        /// The function.
        function: String,
        /// The number of states of the others.
        expected: usize,
        /// The number of states of another input or output.
        found: usize,
    },
    /// The runtime path of the Rust backend is not a Rust path.
    #[error("the runtime path `{path}` is not a Rust path such as `::robot_runtime`")]
    RuntimePath {
        /// The given text.
        path: String,
    },
    /// A constant that the scalar type cannot hold.
    #[error("the constant {value} of {place} is outside the range of f32; generate f64")]
    BeyondSinglePrecision {
        /// The constant.
        value: String,
        /// The function or the constructor.
        place: String,
    },
    /// A constant that is so small that the scalar type rounds it to 0 or keeps only a few of its digits.
    #[error(
        "the constant {value} of {place} is too small for f32, which keeps its digits down to \
         1.2e-38; generate f64, or choose units in which it is larger"
    )]
    BelowSinglePrecision {
        /// The constant.
        value: String,
        /// The function or the constructor.
        place: String,
    },
    /// A number type in which no code is printed in a language.
    #[error("code in {language} is printed only in f64; leave out the option `scalar`")]
    Scalar {
        /// The language.
        language: &'static str,
    },
    /// Double precision, which a language does not have.
    #[error("{language} computes only in f32; give the option `scalar` the value `f32`")]
    Single {
        /// The language.
        language: &'static str,
    },
    /// Sines of the standard library, which a language does not have.
    #[error("{language} has no sines from a standard library; leave out the option `trigonometry`")]
    Trigonometry {
        /// The language.
        language: &'static str,
    },
}

/// All errors that were found; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Errors(Vec<Error>);

impl Errors {
    /// Returns `Ok(value)` if there are no errors.
    pub(crate) fn check<T>(errors: Vec<Error>, value: T) -> Result<T, Errors> {
        if errors.is_empty() { Ok(value) } else { Err(Errors(errors)) }
    }

    /// The errors, in the order in which they were found.
    #[must_use]
    pub fn as_slice(&self) -> &[Error] {
        &self.0
    }
}

impl From<Error> for Errors {
    fn from(error: Error) -> Errors {
        Errors(vec![error])
    }
}

impl fmt::Display for Errors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.0.iter().enumerate() {
            if index > 0 {
                formatter.write_str("\n")?;
            }
            write!(formatter, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Errors {}
