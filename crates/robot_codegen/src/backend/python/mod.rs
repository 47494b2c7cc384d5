//! The printer of Python: the same functions work on numbers and on NumPy arrays.
//!
//! An entry of an input is a number, or an array with one element for each state. Sines and cosines
//! are the runtime's polynomials, with the same bits, unless the options choose the standard library.

mod helpers;
mod keywords;

use robot_symbolic::Function as Call;

use super::common::{
    self, ConstantItem, ConstantValue, Scalar, SetterArgument, comment_line, comment_lines,
};
use super::flat::{Array, Body, FlatOptions, Function, Spelling, Statement, Taken, Tree, infix};
use super::{Language, SourceFile, Target};
use crate::counts::Counts;
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Limits;

/// Python, as a language of printed code.
pub const LANGUAGE: Language = Language {
    name: "Python",
    extension: "py",
    reserved: &[keywords::RESERVED],
    modules: keywords::MODULES,
    limits: Limits { expression: 6, block: usize::MAX, function: usize::MAX, part: usize::MAX },
};

/// Names that printed functions use in addition to those of the module.
const TAKEN: &[&str] = &["model", "parameters", "nominal", "Parameters", "Model"];

/// The printer of Python.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Python {
    /// The options; the number type must be double precision, the only one of Python.
    pub options: FlatOptions,
}

impl Target for Python {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one module.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        if self.options.scalar != Scalar::F64 {
            return Err(Errors::from(Error::Scalar { language: LANGUAGE.name }));
        }
        let tree = tree(module, &self.options);
        let text = Printer { tree: &tree, options: &self.options }.text();
        Ok(vec![SourceFile::text(format!("{}.{}", tree.name, LANGUAGE.extension), text)])
    }
}

/// The tree of a module as Python prints it.
#[must_use]
pub fn tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    let taken = options.taken(TAKEN);
    let taken: Vec<&str> = taken.iter().map(String::as_str).collect();
    Tree::new(module, &LANGUAGE, Taken::of(&taken), &[], &options.setters)
}

struct Printer<'a> {
    tree: &'a Tree<'a>,
    options: &'a FlatOptions,
}

impl Spelling for Printer<'_> {
    fn constant(&self, size: f64) -> String {
        Scalar::F64.digits(size)
    }

    fn field(&self, index: usize) -> String {
        format!("model.{}", self.tree.fields[index])
    }

    fn division(&self) -> Option<&'static str> {
        Some("_divide")
    }

    fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
        format!("_mul_add({a}, {b}, {c})")
    }

    fn call(&self, function: Call, argument: String) -> String {
        let name = match function {
            Call::Sqrt => "_sqrt",
            Call::Abs => "abs",
            Call::Sign => "_sign",
            Call::Tanh => "_tanh",
            Call::RecipPositive => "_recip_positive",
            Call::Sin => return format!("_sin_cos({argument})[0]"),
            Call::Cos => return format!("_sin_cos({argument})[1]"),
        };
        format!("{name}({argument})")
    }
}

/// Escapes text within a docstring, so that it cannot end the docstring.
fn inside(text: &str) -> String {
    comment_line(text).replace('\\', "\\\\").replace("\"\"\"", "\\\"\\\"\\\"")
}

/// The line that refuses an array with another number of entries.
fn check_length(name: &str, length: usize) -> String {
    format!("    _check_length({name}, \"{name}\", {length})")
}

/// Prints a docstring.
fn docstring(paragraphs: &[String], indent: &str) -> Vec<String> {
    let lines: Vec<String> = comment_lines(paragraphs).iter().map(|line| inside(line)).collect();
    // A quote at the end of the text would merge with the quotes that end the docstring.
    let text = lines.join(&format!("\n{indent}"));
    let closing = if lines.len() > 1 { format!("\n{indent}\"\"\"") } else { " \"\"\"".to_owned() };
    let closing =
        if text.ends_with('"') || lines.len() > 1 { closing } else { "\"\"\"".to_owned() };
    format!("{indent}\"\"\"{text}{closing}")
        .lines()
        .map(|line| line.trim_end().to_owned())
        .collect()
}

impl Printer<'_> {
    fn text(&self) -> String {
        let header = self.options.header.iter();
        let mut lines: Vec<String> =
            header.map(|line| format!("# {}", comment_line(line))).collect();
        let mut doc = common::paragraphs(&self.tree.module.doc, &self.tree.module.name);
        doc.push(format!("- {}", self.options.trigonometry.range_of_angles()));
        doc.extend([
            String::new(),
            "Each entry of an input is a number, or a NumPy array with an element for each state; q, qd and so on may be \
             NumPy arrays of shape (n,) or (n, N). Outputs are NumPy arrays if an input has one, else numbers in lists."
                .to_owned(),
        ]);
        lines.extend(docstring(&doc, ""));
        lines.extend(helpers::helpers(
            &self.tree.helpers().and(self.constructor_helpers()),
            self.options,
        ));
        lines.extend(self.options.constants.iter().flat_map(constant));
        if self.tree.has_parameters() {
            lines.extend(self.parameters());
            lines.extend(self.setters());
            lines.extend(self.model());
        }
        for function in &self.tree.functions {
            lines.extend(self.function(function));
        }
        lines.join("\n") + "\n"
    }

    fn constructor_helpers(&self) -> super::flat::Helpers {
        super::flat::Helpers::of(&self.tree.constructor)
    }

    fn parameters(&self) -> Vec<String> {
        let title = common::markdown_line(&self.tree.module.name);
        let mut lines = vec![String::new(), String::new(), "@_dataclass".to_owned()];
        lines.push("class Parameters:".to_owned());
        let doc =
            format!("The parameters of {title}; those with a nominal value have it by default.");
        lines.extend(docstring(&[doc], "    "));
        lines.push(String::new());
        let specs = self.tree.module.parameters.iter();
        for (spec, field) in specs.zip(&self.tree.parameters) {
            let value =
                spec.nominal.map_or("float(\"nan\")".to_owned(), |value| format!("{value:?}"));
            lines.push(format!("    # {}", comment_line(&common::parameter(spec))));
            lines.push(format!("    {field}: float = {value}"));
        }
        lines
    }

    fn setters(&self) -> Vec<String> {
        let mut lines = vec![];
        for (setter, name) in self.options.setters.iter().zip(&self.tree.setters) {
            let arguments: Vec<&str> =
                setter.arguments.iter().map(|argument| argument.name.as_str()).collect();
            lines.extend([String::new(), String::new()]);
            lines.push(format!("def {name}(parameters, {}):", arguments.join(", ")));
            let mut doc = common::paragraphs(&setter.doc, &setter.name);
            doc.push(String::new());
            for SetterArgument { name, doc: meaning, unit, .. } in &setter.arguments {
                doc.push(format!("- `{name}`: {}", common::quantity(meaning, name, unit, &[])));
            }
            lines.extend(docstring(&doc, "    "));
            lines.extend(setter.arrays().map(|(name, length)| check_length(name, length)));
            let known = &self.tree.module.parameters;
            let mut set = vec![];
            for argument in &setter.arguments {
                for (index, parameter) in argument.parameters.iter().enumerate() {
                    let place = known.iter().position(|known| known.name == *parameter);
                    let Some(place) = place else { continue };
                    let value = match argument.parameters.len() {
                        1 => argument.name.clone(),
                        _ => format!("{}[{index}]", argument.name),
                    };
                    set.push(format!("{}={value}", self.tree.parameters[place]));
                }
            }
            lines.push(format!("    return _replace(parameters, {})", set.join(", ")));
        }
        lines
    }

    fn model(&self) -> Vec<String> {
        let title = common::markdown_line(&self.tree.module.name);
        let counts = Counts::of(&self.tree.module.constructor);
        let mut lines = vec![String::new(), String::new(), "class Model:".to_owned()];
        let doc = [
            format!(
                "The model {title}: everything that depends only on its parameters, computed once."
            ),
            String::new(),
            format!("{}.", common::operations(&counts)),
        ];
        lines.extend(docstring(&doc, "    "));
        lines.extend([String::new(), "    def __init__(self, parameters=None):".to_owned()]);
        lines.push(
            "        parameters = Parameters() if parameters is None else parameters".to_owned(),
        );
        for statement in &self.tree.constructor.statements {
            lines.extend(self.statement(&[], statement).map(|line| format!("        {line}")));
        }
        for (field, value) in self.tree.fields.iter().zip(&self.tree.constructor.results) {
            lines.push(format!("        self.{field} = {}", infix(value, self)));
        }
        lines.extend(helpers::MODEL.lines().map(str::to_owned));
        lines
    }

    fn statement(&self, inputs: &[Array], statement: &Statement) -> Option<String> {
        match statement {
            Statement::Parameter { name, parameter } => {
                Some(format!("{name} = _float(parameters.{})", self.tree.parameters[*parameter]))
            }
            Statement::Entry { name, input, entry } => {
                Some(format!("{name} = {}[{entry}]", inputs[*input].name))
            }
            Statement::Circular { sine, cosine, angle } => {
                Some(format!("{sine}, {cosine} = _sin_cos({})", infix(angle, self)))
            }
            Statement::Let { name, value } => Some(format!("{name} = {}", infix(value, self))),
            // The limits are such that no body is cut into parts.
            Statement::Part(_) => None,
        }
    }

    fn function(&self, function: &Function<'_>) -> Vec<String> {
        let body: Body = function.whole();
        let mut arguments: Vec<&str> = vec![];
        if self.tree.has_parameters() {
            arguments.push("model");
        }
        arguments.extend(function.inputs.iter().map(|array| array.name.as_str()));
        let mut lines = vec![String::new(), String::new()];
        lines.push(format!("def {}({}):", function.name, arguments.join(", ")));
        let counts = self.tree.module.counts(function.source);
        let names = function.inputs.iter().map(|array| array.name.as_str());
        let mut doc = common::function(function.source, names, &counts.call);
        let outputs = function.outputs.iter().map(|array| array.name.as_str());
        common::add_results(&mut doc, Some("Returns, in this order:"), function.source, outputs);
        lines.extend(docstring(&doc, "    "));
        if self.tree.has_parameters() {
            lines.push("    _check_model(model)".to_owned());
        }
        let inputs = function.inputs.iter();
        lines.extend(inputs.map(|Array { name, length, .. }| {
            format!("    {name} = _floats({name}, \"{name}\", {length})")
        }));
        for statement in &body.statements {
            lines.extend(
                self.statement(&function.inputs, statement).map(|line| format!("    {line}")),
            );
        }
        let arrays: Vec<&str> = function.inputs.iter().map(|array| array.name.as_str()).collect();
        let mut results = body.results.iter();
        let outputs = function.source.outputs.iter().zip(&function.outputs);
        let values: Vec<String> = outputs
            .map(|(output, array)| {
                let entries: Vec<String> =
                    results.by_ref().take(array.length).map(|value| infix(value, self)).collect();
                let shape: Vec<String> =
                    output.shape.iter().map(|size| format!("{size},")).collect();
                format!(
                    "_shaped(\n        [{}],\n        ({}),\n        ({}),\n    )",
                    entries.join(", "),
                    shape.join(" "),
                    arrays.iter().map(|name| format!("{name},")).collect::<Vec<_>>().join(" ")
                )
            })
            .collect();
        match values.as_slice() {
            [value] => lines.push(format!("    return {value}")),
            _ => {
                lines.push("    return {".to_owned());
                for (array, value) in function.outputs.iter().zip(&values) {
                    lines.push(format!("        \"{}\": {value},", array.name));
                }
                lines.push("    }".to_owned());
            }
        }
        lines.iter().flat_map(|line| line.split('\n').map(str::to_owned)).collect()
    }
}

/// Prints a constant of the module.
fn constant(item: &ConstantItem) -> Vec<String> {
    let value = match &item.value {
        ConstantValue::Size(size) => size.to_string(),
        ConstantValue::Number(number) => format!("{number:?}"),
        ConstantValue::Text(text) => string(text),
        ConstantValue::Texts(texts) => tuple(texts.iter().map(|text| string(text))),
        ConstantValue::Places(places) => {
            tuple(places.iter().map(|[row, column]| format!("({row}, {column})")))
        }
        ConstantValue::Numbers(numbers) => {
            tuple(numbers.iter().map(|number| format!("{number:?}")))
        }
    };
    vec![
        String::new(),
        format!("# {}", comment_line(&item.doc)),
        format!("{} = {value}", item.printed_name()),
    ]
}

fn tuple(values: impl Iterator<Item = String>) -> String {
    format!("({})", values.map(|value| format!("{value},")).collect::<Vec<_>>().join(" "))
}

/// Prints a string literal for any text.
fn string(text: &str) -> String {
    let characters = text.chars().map(|character| match character {
        ' '..='~' if character != '"' && character != '\\' => character.to_string(),
        _ => format!("\\U{:08x}", u32::from(character)),
    });
    format!("\"{}\"", characters.collect::<String>())
}
