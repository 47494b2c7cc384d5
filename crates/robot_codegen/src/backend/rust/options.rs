//! How a module is printed as Rust.

use syn::{Type, parse_quote};

use crate::program::Limits;
use crate::trigonometry::Trigonometry;

/// How a module is printed as Rust.
#[derive(Clone, Debug, PartialEq)]
pub struct RustOptions {
    /// Lines of the comment at the top of the text.
    pub header: Vec<String>,
    /// The path of the runtime crate or module, such as `::robot_runtime` or `crate::runtime`.
    pub runtime: String,
    /// Where sines and cosines come from.
    pub trigonometry: Trigonometry,
    /// The number type of the functions.
    pub scalar: Scalar,
    /// Whether each function has a second form `…_generic` over any scalar of the runtime, lanes
    /// among them.
    pub generic: bool,
    /// Whether each function has a form `…_batch` over slices of states, computed in blocks of so
    /// many, which LLVM turns into vectors; 8 is a good number.
    pub batch: Option<usize>,
    /// Whether each batch has a form `…_batch_parallel` too, over the threads of the crate `rayon`.
    pub parallel: Parallel,
    /// What stands around the items.
    pub wrapping: Wrapping,
    /// Further constants of the module, before its types.
    pub constants: Vec<ConstantItem>,
    /// Methods that set several parameters together.
    pub setters: Vec<Setter>,
    /// Limits of expressions, blocks and functions.
    pub limits: Limits,
}

impl Default for RustOptions {
    /// `f64` by the runtime's sine and cosine, in a module, without generic forms.
    fn default() -> RustOptions {
        RustOptions {
            header: vec![],
            runtime: "::robot_runtime".to_owned(),
            trigonometry: Trigonometry::default(),
            scalar: Scalar::F64,
            generic: false,
            batch: None,
            parallel: Parallel::No,
            wrapping: Wrapping::Module,
            constants: vec![],
            setters: vec![],
            limits: Limits::default(),
        }
    }
}

/// A floating-point type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scalar {
    /// `f64`
    #[default]
    F64,
    /// `f32`. Parameters stay `f64` and so does what the constructor computes, until it is stored.
    F32,
}

impl Scalar {
    pub(super) fn ty(self) -> Type {
        match self {
            Scalar::F64 => parse_quote!(f64),
            Scalar::F32 => parse_quote!(f32),
        }
    }
}

/// Whether batches are computed by several threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parallel {
    /// By the caller's alone.
    #[default]
    No,
    /// By those of `rayon`, which the crate around the code depends on.
    Yes,
    /// The same where the crate around the code has its feature `rayon`.
    WithFeature,
}

/// What stands around the items of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// `pub mod name { … }` that allows the lints generated code cannot keep: for text that is
    /// included somewhere, where an inner attribute may not stand.
    #[default]
    Module,
    /// Nothing: the text is a module's or crate's own file, which should allow [`allowed_lints`].
    ///
    /// [`allowed_lints`]: super::allowed_lints
    Items,
}

/// A method of `Parameters` that gives a copy with several of them set, and an associated function
/// of `Model` of the same name for the nominal parameters, where all of them have nominal values.
#[derive(Clone, Debug, PartialEq)]
pub struct Setter {
    /// The name.
    pub name: String,
    /// Its meaning in Markdown, a paragraph or line each.
    pub doc: Vec<String>,
    /// What it takes.
    pub arguments: Vec<SetterArgument>,
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
    /// The name; printed in capitals.
    pub name: String,
    /// Its meaning, in Markdown.
    pub doc: String,
    /// Its value.
    pub value: ConstantValue,
}

/// The value of a [`ConstantItem`].
#[derive(Clone, Debug, PartialEq)]
pub enum ConstantValue {
    /// A `usize`.
    Size(usize),
    /// An `f64`.
    Number(f64),
    /// A `&str`.
    Text(String),
    /// An array of `&str`.
    Texts(Vec<String>),
    /// An array of `f64`.
    Numbers(Vec<f64>),
}
