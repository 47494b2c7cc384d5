//! The printer of WGSL, the shading language of WebGPU: for each function of the module, a function in single precision
//! and a compute kernel over columns of states.

mod function;
mod helpers;
mod keywords;
#[cfg(test)]
mod tests;

use robot_symbolic::Function as Call;

use super::common::{self, ConstantItem, ConstantValue, Scalar, check_range, comment_line};
use super::flat::{FlatOptions, Function, Spelling, Taken, Tree};
use super::{Language, SourceFile, Target};
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Limits;
use crate::trigonometry::Trigonometry;

/// WGSL, as a language of printed code. The time that drivers take to compile a function grows faster than its size.
pub const LANGUAGE: Language = Language {
    name: "WGSL",
    extension: "wgsl",
    reserved: &[keywords::RESERVED],
    modules: &[],
    limits: Limits { expression: 6, block: usize::MAX, function: 4000, part: 1000 },
};

/// Names that the printer uses for itself within functions.
const TAKEN: &[&str] = &["i", "step", "id", "groups", "n", "stride"];

/// The number of states of a workgroup.
pub const WORKGROUP: usize = 64;

/// The printer of WGSL.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wgsl {
    /// The options; the number type must be single precision, the only one of WGSL.
    pub options: FlatOptions,
}

impl Target for Wgsl {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one module.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        if self.options.scalar != Scalar::F32 {
            return Err(Errors::from(Error::Single { language: LANGUAGE.name }));
        }
        check_range(module, Scalar::F32)?;
        let tree = tree(module);
        let text = Printer { tree: &tree, options: &self.options }.text();
        Ok(vec![SourceFile::text(format!("{}.{}", tree.name, LANGUAGE.extension), text)])
    }
}

/// The tree of a module as WGSL prints it.
#[must_use]
pub fn tree(module: &Module) -> Tree<'_> {
    Tree::new(module, &LANGUAGE, Taken::of(TAKEN), &["kernel"], &[])
}

/// The name of a function in WGSL: `ur5_gravity`.
#[must_use]
pub fn function_name(tree: &Tree<'_>, function: &Function<'_>) -> String {
    format!("{}_{}", tree.name, function.name)
}

/// The name of the kernel of a function, `ur5_gravity_kernel`, if the function has inputs.
#[must_use]
pub fn kernel_name(tree: &Tree<'_>, function: &Function<'_>) -> Option<String> {
    (!function.inputs.is_empty()).then(|| format!("{}_{}", tree.name, function.form(0)))
}

/// Whether functions read the model.
#[must_use]
pub fn has_model(tree: &Tree<'_>) -> bool {
    tree.has_parameters() && !tree.fields.is_empty()
}

struct Printer<'a> {
    tree: &'a Tree<'a>,
    options: &'a FlatOptions,
}

/// Prints a comment, with a line for each paragraph.
fn comment(lines: &[String]) -> impl Iterator<Item = String> {
    lines.iter().map(|line| format!("// {}", comment_line(line)).trim_end().to_owned())
}

/// Prints a number of either sign.
fn number(value: f64) -> String {
    let sign = if value.is_sign_negative() { "-" } else { "" };
    format!("{sign}{}f", Scalar::F32.digits(value))
}

impl Printer<'_> {
    /// Makes a name for internal use. It begins with the name of the module, because WGSL has no namespaces, and ends
    /// with an underscore, so that no function has it.
    fn private(&self, name: &str) -> String {
        format!("{}_{name}_", self.tree.name)
    }

    fn text(&self) -> String {
        let mut lines: Vec<String> = comment(&self.options.header).collect();
        let mut doc = common::paragraphs(&self.tree.module.doc, &self.tree.module.name);
        doc.push(format!("- {}", self.options.trigonometry.range_of_angles()));
        doc.push(
            "- WGSL leaves the rounding of sums of products open, and what is not a number: last bits differ from machine to \
             machine."
                .to_owned(),
        );
        lines.push(String::new());
        lines.extend(comment(&doc));
        lines.push(String::new());
        lines.extend(self.bindings());
        lines.extend(self.options.constants.iter().filter_map(|item| self.constant(item)));
        lines.push(String::new());
        lines.extend(helpers::helpers(self));
        for function in &self.tree.functions {
            lines.extend(function::function(self, function));
        }
        lines.join("\n")
    }

    /// Prints the declarations of the buffers.
    fn bindings(&self) -> Vec<String> {
        let [inputs, outputs, size, model] =
            ["inputs", "outputs", "size", "model"].map(|name| self.private(name));
        let (size_type, model_type) = (self.private("size_of"), self.private("model_of"));
        let text = format!(
            "// The buffers of all kernels. Entry j of state i is at `[j * stride + i]`: a column for each entry, `stride` \
             apart. Entries of
// all inputs are counted together, and so are those of all outputs. `stride` is at least `n`.
@group(0) @binding(0) var<storage, read> {inputs}: array<f32>;
@group(0) @binding(1) var<storage, read_write> {outputs}: array<f32>;
struct {size_type} {{
    n: u32,
    stride: u32,
}}
@group(0) @binding(2) var<uniform> {size}: {size_type};"
        );
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        if has_model(self.tree) {
            lines.push("// Everything that depends only on the parameters.".to_owned());
            lines.push(format!("struct {model_type} {{"));
            lines.extend(self.tree.fields.iter().map(|field| format!("    {field}: f32,")));
            lines.push("}".to_owned());
            lines.push(format!("@group(0) @binding(3) var<uniform> {model}: {model_type};"));
        }
        lines.push(String::new());
        lines
    }

    /// Prints a constant of the module, if it is a number; WGSL has no strings.
    fn constant(&self, item: &ConstantItem) -> Option<String> {
        let value = match &item.value {
            ConstantValue::Size(size) => format!("u32 = {size}u"),
            ConstantValue::Number(value) => format!("f32 = {}", number(*value)),
            _ => return None,
        };
        Some(format!("const {}: {value};", self.private(&item.printed_name()).to_ascii_uppercase()))
    }
}

impl Spelling for Printer<'_> {
    fn constant(&self, size: f64) -> String {
        number(size)
    }

    fn field(&self, index: usize) -> String {
        format!("{}.{}", self.private("model"), self.tree.fields[index])
    }

    fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
        format!("fma({a}, {b}, {c})")
    }

    fn call(&self, function: Call, argument: String) -> String {
        let name = match function {
            Call::Sqrt => "sqrt".to_owned(),
            Call::Abs => "abs".to_owned(),
            Call::Sign => "sign".to_owned(),
            Call::Tanh => self.private("tanh"),
            Call::RecipPositive => self.private("recip_positive"),
            Call::Sin | Call::Cos => match self.options.trigonometry {
                Trigonometry::Polynomial => self.private(function.name()),
                Trigonometry::Standard => function.name().to_owned(),
            },
        };
        format!("{name}({argument})")
    }
}
