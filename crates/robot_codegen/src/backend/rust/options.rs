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
    /// Whether each function has a second form `…_generic` over any scalar of the runtime, including
    /// lanes.
    pub generic: bool,
    /// The number of states in a block, if each function has a form `…_batch` over slices of states, which computes
    /// them in blocks that LLVM turns into vectors. 8 is a good number.
    pub batch: Option<usize>,
    /// Whether each batch also has a form `…_batch_parallel`, on the threads of the crate `rayon`.
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
    /// Options for `f64` with the runtime's sine and cosine, in a module, without generic forms.
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
    /// No: only on the caller's thread.
    #[default]
    No,
    /// Yes: on the threads of `rayon`, on which the crate around the code must depend.
    Yes,
    /// Adds parallel forms if the crate around the code has its feature `rayon`.
    WithFeature,
}

/// The wrapping of the items of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// `pub mod name { … }` with attributes for the lints that generated code cannot satisfy; for text that is
    /// included in a file, where inner attributes are not allowed.
    #[default]
    Module,
    /// No wrapping: the text is the file of a module or crate, which should allow [`allowed_lints`].
    ///
    /// [`allowed_lints`]: super::allowed_lints
    Items,
}
