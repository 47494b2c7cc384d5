//! Items that a caller adds to a module: constants, and setters of several parameters.

/// A function that returns a copy of the parameters with several of them set.
#[derive(Clone, Debug, PartialEq)]
pub struct Setter {
    /// The name.
    pub name: String,
    /// The documentation in Markdown; each entry is a paragraph or a line.
    pub doc: Vec<String>,
    /// The arguments, in order.
    pub arguments: Vec<SetterArgument>,
}

impl Setter {
    /// The names and lengths of the arguments that are arrays.
    pub fn arrays(&self) -> impl Iterator<Item = (&str, usize)> {
        let arguments = self.arguments.iter();
        let lengths = arguments.map(|one| (one.name.as_str(), one.parameters.len()));
        lengths.filter(|(_, length)| *length != 1)
    }
}

/// An argument of a [`Setter`]: a number, or an array of them.
#[derive(Clone, Debug, PartialEq)]
pub struct SetterArgument {
    /// The name.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its unit.
    pub unit: String,
    /// The parameters that its entries set.
    pub parameters: Vec<String>,
}

/// A constant of the printed module.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantItem {
    /// The name, which printers write in capitals.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its value.
    pub value: ConstantValue,
}

impl ConstantItem {
    /// The name in printed code, which is in capitals. C and WGSL print the name of the module before it.
    pub(in crate::backend) fn printed_name(&self) -> String {
        self.name.to_uppercase()
    }
}

/// The value of a [`ConstantItem`].
#[derive(Clone, Debug, PartialEq)]
pub enum ConstantValue {
    /// A whole number, such as a count.
    Size(usize),
    /// A number in double precision.
    Number(f64),
    /// A string.
    Text(String),
    /// An array of strings.
    Texts(Vec<String>),
    /// An array of pairs of a row and a column.
    Places(Vec<[usize; 2]>),
    /// An array of numbers in double precision.
    Numbers(Vec<f64>),
}
