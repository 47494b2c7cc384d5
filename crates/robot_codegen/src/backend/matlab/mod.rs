//! The printer of MATLAB and Octave: a package folder with a file for each function.
//!
//! Each file contains its helpers, so that it can be pasted into a Simulink block. States are columns, and all
//! operations are element-wise.

mod helpers;
mod keywords;
mod library;

use robot_symbolic::Function as Call;

use super::common::{self, Scalar, SetterArgument, comment_line, comment_lines};
use super::flat::{
    Array, Body, FlatOptions, Function, Helpers, Operator, Spelling, Statement, Taken, Tree, infix,
};
use super::{Language, SourceFile, Target};
use crate::counts::Counts;
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Limits;

/// MATLAB, as a language of printed code.
pub const LANGUAGE: Language = Language {
    name: "MATLAB",
    extension: "m",
    reserved: &[keywords::RESERVED],
    modules: library::NAMES,
    limits: Limits { expression: 6, block: usize::MAX, function: usize::MAX, part: usize::MAX },
};

/// Names that printed functions use in addition to those of the module.
const TAKEN: &[&str] = &[
    "model",
    "parameters",
    "nominal",
    "create_model",
    "n",
    "mass",
    "center_of_mass",
    "inertia",
    "sin_cos_",
    "sin_",
    "cos_",
    "sqrt_",
    "recip_positive_",
    "tanh_",
];

/// The printer of MATLAB.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matlab {
    /// The options; the number type must be double precision.
    pub options: FlatOptions,
}

impl Target for Matlab {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints a file for each function, for a folder named `+` followed by the name of the module.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        if self.options.scalar != Scalar::F64 {
            return Err(Errors::from(Error::Scalar { language: LANGUAGE.name }));
        }
        let tree = tree(module, &self.options);
        let printer = Printer { tree: &tree, options: &self.options };
        let mut files = vec![];
        if tree.has_parameters() {
            files.push(printer.file("nominal", &printer.nominal()));
            for (setter, name) in self.options.setters.iter().zip(&tree.setters) {
                files.push(printer.file(name, &printer.setter(setter, name)));
            }
            files.push(printer.file("create_model", &printer.model()));
        }
        for function in &tree.functions {
            files.push(printer.file(&function.name, &printer.function(function)));
        }
        Ok(files)
    }
}

/// The tree of a module as MATLAB prints it.
#[must_use]
pub fn tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    Tree::new(module, &LANGUAGE, Taken::of(TAKEN), &[], &options.setters)
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

    fn operator(&self, operator: Operator) -> &'static str {
        match operator {
            Operator::Add => "+",
            Operator::Sub => "-",
            Operator::Mul => ".*",
            Operator::Div => "./",
        }
    }

    fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
        format!("(({a}) .* ({b}) + ({c}))")
    }

    fn call(&self, function: Call, argument: String) -> String {
        let name = match function {
            Call::Sqrt => "sqrt_",
            Call::Abs => "abs",
            Call::Sign => "sign",
            Call::Tanh => "tanh_",
            Call::RecipPositive => "recip_positive_",
            Call::Sin => "sin_",
            Call::Cos => "cos_",
        };
        format!("{name}({argument})")
    }
}

/// Prints a documentation comment, whose first line starts with the name of the function.
fn documentation(name: &str, paragraphs: &[String]) -> Vec<String> {
    let lines = comment_lines(paragraphs);
    let mut comment = vec![];
    for (index, line) in lines.iter().enumerate() {
        comment.push(match index {
            0 => format!("%{} {line}", name.to_uppercase()),
            _ => format!("%   {line}").trim_end().to_owned(),
        });
    }
    comment
}

impl Printer<'_> {
    fn file(&self, name: &str, lines: &[String]) -> SourceFile {
        let mut text = lines.join("\n");
        for line in &self.options.header {
            text.push_str(&format!("\n% {}", comment_line(line)));
        }
        text.push('\n');
        SourceFile::text(format!("{name}.m"), text)
    }

    fn nominal(&self) -> Vec<String> {
        let title = common::markdown_line(&self.tree.module.name);
        let doc =
            format!("The nominal parameters of {title}; NaN for those that have no nominal value.");
        let mut lines = vec!["function parameters = nominal()".to_owned()];
        lines.extend(documentation("nominal", &[doc]));
        lines.push("%#codegen".to_owned());
        for (spec, field) in self.tree.module.parameters.iter().zip(&self.tree.parameters) {
            let value = spec.nominal.map_or("NaN".to_owned(), |value| format!("{value:?}"));
            lines.push(format!("% {}", comment_line(&common::parameter(spec))));
            lines.push(format!("parameters.{field} = {value};"));
        }
        lines.push("end".to_owned());
        lines
    }

    fn setter(&self, setter: &common::Setter, name: &str) -> Vec<String> {
        let arguments: Vec<&str> =
            setter.arguments.iter().map(|argument| argument.name.as_str()).collect();
        let mut doc = common::paragraphs(&setter.doc, &setter.name);
        doc.push(String::new());
        for SetterArgument { name, doc: meaning, unit, .. } in &setter.arguments {
            doc.push(format!("- `{name}`: {}", common::quantity(meaning, name, unit, &[])));
        }
        let mut lines =
            vec![format!("function parameters = {name}(parameters, {})", arguments.join(", "))];
        lines.extend(documentation(name, &doc));
        lines.push("%#codegen".to_owned());
        lines.extend(setter.arrays().map(|(name, length)| {
            let entries = format!("numel({name})");
            format!(
                "assert({entries} == {length}, '{name} has %d entries, not {length}', {entries});"
            )
        }));
        for argument in &setter.arguments {
            for (index, parameter) in argument.parameters.iter().enumerate() {
                let mut known = self.tree.module.parameters.iter();
                let Some(place) = known.position(|known| known.name == *parameter) else {
                    continue;
                };
                let value = match argument.parameters.len() {
                    1 => argument.name.clone(),
                    _ => format!("{}({})", argument.name, index + 1),
                };
                lines.push(format!("parameters.{} = {value};", self.tree.parameters[place]));
            }
        }
        lines.push("end".to_owned());
        lines
    }

    fn model(&self) -> Vec<String> {
        let constructor = &self.tree.constructor;
        let counts = Counts::of(&self.tree.module.constructor);
        let mut lines = vec!["function model = create_model(parameters)".to_owned()];
        lines.extend(documentation(
            "create_model",
            &[
                "Computes everything that depends only on the parameters, once.".to_owned(),
                String::new(),
                format!("{}.", common::operations(&counts)),
            ],
        ));
        lines.push("%#codegen".to_owned());
        lines.extend(self.statements(&[], constructor));
        for (field, value) in self.tree.fields.iter().zip(&constructor.results) {
            lines.push(format!("model.{field} = {};", infix(value, self)));
        }
        if self.tree.fields.is_empty() {
            lines.push("model = struct();".to_owned());
        }
        lines.extend(["end".to_owned(), String::new()]);
        lines.extend(helpers::helpers(&Helpers::of(constructor), self.options));
        lines
    }

    fn statements(&self, inputs: &[Array], body: &Body) -> Vec<String> {
        let statements = body.statements.iter().filter_map(|statement| match statement {
            Statement::Parameter { name, parameter } => {
                Some(format!("{name} = parameters.{};", self.tree.parameters[*parameter]))
            }
            Statement::Entry { name, input, entry } => {
                Some(format!("{name} = {}({}, :);", inputs[*input].name, entry + 1))
            }
            Statement::Circular { sine, cosine, angle } => {
                Some(format!("[{sine}, {cosine}] = sin_cos_({});", infix(angle, self)))
            }
            Statement::Let { name, value } => Some(format!("{name} = {};", infix(value, self))),
            // The limits are such that no body is cut into parts.
            Statement::Part(_) => None,
        });
        statements.collect()
    }

    fn function(&self, function: &Function<'_>) -> Vec<String> {
        let body = function.whole();
        let model = self.tree.has_parameters().then_some("model");
        let arguments =
            model.into_iter().chain(function.inputs.iter().map(|array| array.name.as_str()));
        let arguments: Vec<&str> = arguments.collect();
        let outputs: Vec<&str> = function.outputs.iter().map(|array| array.name.as_str()).collect();
        let given = match outputs.as_slice() {
            [output] => (*output).to_owned(),
            _ => format!("[{}]", outputs.join(", ")),
        };
        let name = &function.name;
        let mut lines = vec![format!("function {given} = {name}({})", arguments.join(", "))];
        let counts = self.tree.module.counts(function.source);
        let names = function.inputs.iter().map(|array| array.name.as_str());
        let mut doc = common::function(function.source, names, &counts.call);
        let results = function.outputs.iter().map(|array| array.name.as_str());
        common::add_results(&mut doc, Some("Returns:"), function.source, results);
        doc.extend([
            String::new(),
            "Inputs may have a column for each of several states: vectors are then given in columns, matrices in pages."
                .to_owned(),
        ]);
        lines.extend(documentation(name, &doc));
        lines.push("%#codegen".to_owned());
        lines.extend(function.inputs.iter().flat_map(|Array { name, length, .. }| {
            let rows = format!("size({name}, 1)");
            [
                format!("assert({rows} == {length}, '{name} has %d rows, not {length}', {rows});"),
                // Sines of other types, such as single, would be wrong.
                format!("{name} = double({name});"),
            ]
        }));
        lines.push(match function.inputs.first() {
            Some(array) => format!("n = size({}, 2);", array.name),
            None => "n = 1;".to_owned(),
        });
        lines.extend(self.statements(&function.inputs, &body));
        lines.extend(self.stores(function, &body));
        lines.extend(["end".to_owned(), String::new()]);
        lines.extend(helpers::helpers(&Helpers::of(&body), self.options));
        lines
    }

    /// Prints the statements that store the results as rows of the outputs. Matrices are stored column by column, as in
    /// MATLAB.
    fn stores(&self, function: &Function<'_>, body: &Body) -> Vec<String> {
        let mut lines = vec![];
        let mut results = body.results.iter();
        for (output, array) in function.source.outputs.iter().zip(&function.outputs) {
            let name = &array.name;
            lines.push(format!("{name} = zeros({}, n);", array.length));
            for (index, value) in results.by_ref().take(array.length).enumerate() {
                let row = match output.shape.as_slice() {
                    [rows, columns] => (index % columns) * rows + index / columns,
                    _ => index,
                };
                lines.push(format!("{name}({}, :) = {};", row + 1, infix(value, self)));
            }
            if let [rows, columns] = output.shape.as_slice() {
                lines.push(format!("{name} = reshape({name}, {rows}, {columns}, n);"));
            }
        }
        lines
    }
}
