//! The printer of WebAssembly, which writes the binary directly: a module with its own memory, and an ES module that
//! loads it.
//!
//! Functions take addresses in the module's memory, which it exports. The model of the parameters is also there; the
//! module's constructor fills it. Sines and cosines are the runtime's polynomials; nothing is imported. Functions over
//! columns of states compute in lanes of 128 bits (`simd128`), and the remaining states by the functions of one state.
//!
//! Values that are used once stay on the stack; others have locals, which are reused after the last use of their
//! values. Bodies that are too long for one function are cut into parts, which pass on their variables through memory.

mod body;
mod code;
mod declarations;
mod function;
mod helpers;
mod loader;
mod module;

use super::common::{Scalar, check_range};
use super::flat::{FlatOptions, Function, Taken, Tree};
use super::javascript;
use super::{Contents, Language, SourceFile, Target};
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Limits;
use crate::trigonometry::Trigonometry;

/// WebAssembly, as a language of printed code. Engines accept functions of up to 50,000 locals and 7.6 MB, and optimize
/// shorter ones better.
pub const LANGUAGE: Language = Language {
    name: "WebAssembly",
    extension: "wasm",
    // Its names are used in the ES module.
    reserved: javascript::LANGUAGE.reserved,
    modules: javascript::LANGUAGE.modules,
    limits: Limits { expression: 32, block: usize::MAX, function: 3000, part: 800 },
};

/// The name of the memory.
pub const MEMORY: &str = "memory";
/// The name of the first free address.
pub const HEAP_BASE: &str = "heap_base";
/// The name of the constructor.
pub const CONSTRUCTOR: &str = "create_model";

/// Names that the module and the ES module that loads it use in addition to those of functions.
const TAKEN: &[&str] = &[
    MEMORY,
    HEAP_BASE,
    CONSTRUCTOR,
    "update_model",
    "allocate",
    "numbers",
    "exports",
    "load",
    "nominal",
    "model",
    "parameters",
    "n",
    "robot",
    "then",
];

/// The printer of WebAssembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wasm {
    /// The options; sines and cosines must be those of the runtime.
    pub options: FlatOptions,
    /// Whether there are functions over columns of states.
    pub batch: bool,
}

impl Target for Wasm {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints the module, the ES module that loads it, and its declarations.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        self.check(module)?;
        let tree = tree(module, &self.options);
        let printer = self.printer(&tree);
        let name = |ending: &str| format!("{}.{ending}", tree.name);
        Ok(vec![
            SourceFile { name: name("wasm"), contents: Contents::Bytes(module::bytes(&printer)) },
            SourceFile::text(name("mjs"), loader::text(&printer)),
            SourceFile::text(name("d.mts"), declarations::text(&printer)),
        ])
    }
}

impl Wasm {
    /// Prints only the module, as bytes.
    ///
    /// # Errors
    ///
    /// The errors of [`Target::files`].
    pub fn bytes(&self, module: &Module) -> Result<Vec<u8>, Errors> {
        self.check(module)?;
        Ok(module::bytes(&self.printer(&tree(module, &self.options))))
    }

    fn check(&self, module: &Module) -> Result<(), Errors> {
        if self.options.trigonometry == Trigonometry::Standard {
            return Err(Errors::from(Error::Trigonometry { language: LANGUAGE.name }));
        }
        check_range(module, self.options.scalar)
    }

    fn printer<'a>(&'a self, tree: &'a Tree<'a>) -> Printer<'a> {
        let batch_names = batch_names(tree);
        Printer { tree, options: &self.options, batch: self.batch, batch_names }
    }
}

/// The tree of a module as WebAssembly prints it.
#[must_use]
pub fn tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    Tree::new(module, &LANGUAGE, Taken::of(TAKEN), &[], &options.setters)
}

/// For each function, the name of its form over columns of states; a function without inputs has none.
#[must_use]
pub fn batch_names(tree: &Tree<'_>) -> Vec<Option<String>> {
    let is_taken = |name: &str| tree.functions.iter().any(|function| function.name == name);
    let name = |function: &Function<'_>| {
        let mut name = format!("{}_batch", function.name);
        while is_taken(&name) {
            name.push('_');
        }
        (!function.inputs.is_empty()).then_some(name)
    };
    tree.functions.iter().map(name).collect()
}

struct Printer<'a> {
    tree: &'a Tree<'a>,
    options: &'a FlatOptions,
    batch: bool,
    batch_names: Vec<Option<String>>,
}

impl Printer<'_> {
    /// The JavaScript type of arrays of numbers.
    fn array(&self) -> &'static str {
        if self.options.scalar == Scalar::F64 { "Float64Array" } else { "Float32Array" }
    }

    /// The functions, with the names of their forms over columns if there are such forms.
    fn functions(&self) -> impl Iterator<Item = (&Function<'_>, Option<&str>)> {
        let names = self.batch_names.iter();
        let names = names.map(|name| name.as_deref().filter(|_| self.batch));
        self.tree.functions.iter().zip(names)
    }
}
