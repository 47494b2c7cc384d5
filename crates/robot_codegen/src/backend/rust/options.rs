//! Options for printing a module as Rust.

use super::LANGUAGE;
use crate::backend::common::{ConstantItem, Scalar, Setter};
use crate::program::Limits;
use crate::trigonometry::Trigonometry;

/// Options for printing a module as Rust.
#[derive(Clone, Debug, PartialEq)]
pub struct RustOptions {
    /// Lines of the comment at the top of the text.
    pub header: Vec<String>,
    /// The path of the runtime crate or module, such as `::robot_runtime` or `crate::runtime`.
    pub runtime: String,
    /// The source of sines and cosines.
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
    /// The wrapping of the items.
    pub wrapping: Wrapping,
    /// Further constants of the module, before its types.
    pub constants: Vec<ConstantItem>,
    /// Methods of `Parameters` that set several parameters together, and associated functions of `Model` of the
    /// same names for the nominal parameters, if all of them have nominal values.
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
            limits: LANGUAGE.limits,
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
    /// Adds parallel forms if the crate around the code has its feature `rayon`.
    WithFeature,
}

/// The wrapping of the items of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// `pub mod name { … }` that allows the lints generated code cannot keep: for text that is
    /// included somewhere, where an inner attribute is not allowed.
    #[default]
    Module,
    /// Nothing: the text is a module's or crate's own file, which should allow [`allowed_lints`].
    ///
    /// [`allowed_lints`]: super::allowed_lints
    Items,
}
