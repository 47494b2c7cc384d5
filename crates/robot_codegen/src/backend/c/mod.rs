//! The printer of C (C99, in the subset that C++ compilers accept).
//!
//! It prints one header with a structure of parameters, a structure of the model, whose values depend only on them, and
//! functions for each function of the module: one that takes the state, one that takes sines and cosines, and one over
//! columns of states. The code allocates nothing and calls only functions of `<math.h>`, and `memcpy`. Sines and cosines are the
//! runtime's polynomials, unless the options choose the standard library.

mod arduino;
mod batch;
mod casadi;
mod comment;
mod cpp;
mod cuda;
mod function;
mod helpers;
mod items;
mod keywords;
mod library;
mod macros;
mod names;
mod spelling;
mod standard;
mod vectors;

pub use self::arduino::{Arduino, arduino_tree};
pub use self::batch::has_batch;
pub use self::casadi::{Casadi, casadi};
pub use self::cpp::Cpp;
pub use self::cuda::{Cuda, cuda_tree};
pub use self::names::Names;
use self::spelling::Expressions;
use super::common::{Scalar, check_range};
use super::flat::{FlatOptions, Taken, Tree};
use super::{Language, SourceFile, Target};
use crate::error::Errors;
use crate::module::Module;
use crate::program::Limits;

/// C, as a language of printed code.
///
/// Compilers accept blocks of any size. The time that they take grows faster than the size of a function, which the
/// limits bound.
pub const LANGUAGE: Language = Language {
    name: "C",
    extension: "h",
    reserved: &[keywords::RESERVED, standard::MACROS],
    modules: library::NAMES,
    limits: Limits { expression: 6, block: usize::MAX, function: 4000, part: 1000 },
};

/// The printer of C.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct C {
    /// The options.
    pub options: FlatOptions,
}

impl Target for C {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one header.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        check_range(module, self.options.scalar)?;
        Ok(vec![header_file(&tree(module, &self.options), &self.options)])
    }
}

/// Prints the header of C.
fn header_file(tree: &Tree<'_>, options: &FlatOptions) -> SourceFile {
    let text = Header::new(tree, options, Dialect::C).text();
    SourceFile::text(format!("{}.{}", tree.name, LANGUAGE.extension), text)
}

/// The index of the form that takes sines and cosines among a function's additional forms.
pub(crate) const SC: usize = 0;
/// The index of the form over columns of states among a function's additional forms.
pub const BATCH: usize = 1;

/// The tree of a module as C prints it.
#[must_use]
pub fn tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    tree_of(module, &LANGUAGE, options, names::TAKEN, &["sc", "batch"])
}

/// The tree of a module in a language, with these additional forms of functions.
fn tree_of<'m>(
    module: &'m Module,
    language: &Language,
    options: &FlatOptions,
    scope: &[&str],
    forms: &[&str],
) -> Tree<'m> {
    let names = Names::new(&language.module_name(&module.name));
    let constants = options.constants.iter().map(|item| names.upper(&item.printed_name()));
    let guards = [Dialect::C.guard(), Dialect::Cuda.guard(), cpp::GUARD];
    let macros: Vec<String> = constants.chain(guards.map(|guard| names.upper(guard))).collect();
    let macros: Vec<&str> = macros.iter().map(String::as_str).collect();
    Tree::new(module, language, Taken { scope, macros: &macros }, forms, &options.setters)
}

/// A language whose functions are those of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dialect {
    /// C, and C++ over it.
    C,
    /// CUDA C++.
    Cuda,
}

impl Dialect {
    /// The end of the name of the macro that keeps a header from being read twice.
    fn guard(self) -> &'static str {
        match self {
            Dialect::C => "H",
            Dialect::Cuda => "CUH",
        }
    }
}

/// The data from which the parts of the header are printed.
struct Header<'a> {
    tree: &'a Tree<'a>,
    names: Names,
    options: &'a FlatOptions,
    dialect: Dialect,
}

impl<'a> Header<'a> {
    fn new(tree: &'a Tree<'a>, options: &'a FlatOptions, dialect: Dialect) -> Header<'a> {
        Header { tree, names: Names::new(&tree.name), options, dialect }
    }
}

impl Header<'_> {
    fn text(&self) -> String {
        let mut lines: Vec<String> =
            self.options.header.iter().map(|line| comment::of_line(line)).collect();
        lines.extend(self.guard());
        lines.extend(helpers::helpers(self));
        lines.extend(items::constants(self));
        if self.tree.has_parameters() {
            lines.extend(items::parameters(self));
            lines.extend(items::setters(self));
            lines.extend(items::model(self));
        }
        for function in &self.tree.functions {
            lines.extend(function::function(self, function));
        }
        lines.extend(self.end());
        lines.push(String::new());
        lines.join("\n")
    }

    /// The type of numbers.
    fn real(&self) -> &'static str {
        function::real(self.options.scalar)
    }

    /// Prints the documentation of the module and the beginning of the header.
    fn guard(&self) -> Vec<String> {
        let mut lines = vec![String::new()];
        let mut doc = super::common::paragraphs(&self.tree.module.doc, &self.tree.module.name);
        doc.push(format!("- {}", self.options.trigonometry.range_of_angles()));
        let flags = match self.dialect {
            Dialect::C => "(-ffp-contract=off) and without -ffast-math",
            Dialect::Cuda => "(-fmad=false) and without -use_fast_math",
        };
        doc.push(format!(
            "- Compiled without contraction of products and sums {flags}, results have the same bits on every machine."
        ));
        lines.extend(comment::of_paragraphs(&doc));
        let guard = self.names.upper(self.dialect.guard());
        lines.extend([format!("#ifndef {guard}"), format!("#define {guard}"), String::new()]);
        lines.extend(match self.dialect {
            Dialect::C => lines_of(&format!(
                "#include <math.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <string.h>\n{}\n\
                 #ifdef __cplusplus\nextern \"C\" {{\n#endif\n",
                vectors::includes(self)
            )),
            Dialect::Cuda => lines_of(cuda::INCLUDES),
        });
        lines.push(String::new());
        lines
    }

    fn end(&self) -> Vec<String> {
        match self.dialect {
            Dialect::C => lines_of("#ifdef __cplusplus\n}\n#endif\n\n#endif"),
            Dialect::Cuda => lines_of("#endif"),
        }
    }

    /// The macro for functions that are inlined.
    fn inline(&self) -> String {
        self.names.private_upper("inline")
    }

    /// The spelling of expressions in a number type.
    fn expressions(&self, scalar: Scalar) -> Expressions<'_> {
        Expressions {
            names: &self.names,
            fields: &self.tree.fields,
            scalar,
            trigonometry: self.options.trigonometry,
        }
    }
}

/// The lines of a text.
fn lines_of(text: &str) -> Vec<String> {
    text.lines().map(str::to_owned).collect()
}
