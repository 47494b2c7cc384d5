//! The printer of JavaScript: an ES module with TypeScript declarations.

pub(in crate::backend) mod declarations;
pub(in crate::backend) mod helpers;
mod keywords;

use robot_symbolic::Function as Call;

use super::common::{
    self, ConstantItem, ConstantValue, Scalar, SetterArgument, comment_line, comment_lines,
};
use super::flat::{
    Array, Expression, FlatOptions, Function, Helpers, Spelling, Statement, Taken, Tree, infix,
};
use super::{Language, SourceFile, Target};
use crate::counts::Counts;
use crate::error::{Error, Errors};
use crate::module::Module;
use crate::program::Limits;

/// JavaScript, as a language of printed code. Engines optimize functions up to a few tens of kilobytes of bytecode.
pub const LANGUAGE: Language = Language {
    name: "JavaScript",
    extension: "mjs",
    reserved: &[keywords::RESERVED],
    // The test of a package.
    modules: &["test"],
    limits: Limits { expression: 6, block: usize::MAX, function: 3000, part: 800 },
};

/// Names that printed functions use in addition to those of the module.
const TAKEN: &[&str] = &["model", "parameters", "nominal", "create_model", "live"];

/// The printer of JavaScript.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JavaScript {
    /// The options; the number type must be double precision, the only one of JavaScript.
    pub options: FlatOptions,
}

impl Target for JavaScript {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints the module and its declarations.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        if self.options.scalar != Scalar::F64 {
            return Err(Errors::from(Error::Scalar { language: LANGUAGE.name }));
        }
        let tree = tree(module, &self.options);
        let printer = Printer { tree: &tree, options: &self.options };
        let file = |ending: &str, text| SourceFile::text(format!("{}.{ending}", tree.name), text);
        Ok(vec![file("mjs", printer.text()), file("d.mts", declarations::text(&printer))])
    }
}

/// The tree of a module as JavaScript prints it.
#[must_use]
pub fn tree<'m>(module: &'m Module, options: &FlatOptions) -> Tree<'m> {
    let taken = options.taken(TAKEN);
    let taken: Vec<&str> = taken.iter().map(String::as_str).collect();
    Tree::new(module, &LANGUAGE, Taken::of(&taken), &[], &options.setters)
}

pub(in crate::backend) struct Printer<'a> {
    pub(in crate::backend) tree: &'a Tree<'a>,
    pub(in crate::backend) options: &'a FlatOptions,
}

impl Spelling for Printer<'_> {
    fn constant(&self, size: f64) -> String {
        Scalar::F64.digits(size)
    }

    fn field(&self, index: usize) -> String {
        format!("model.{}", self.tree.fields[index])
    }

    fn mul_add(&self, [a, b, c]: [String; 3]) -> String {
        format!("_mul_add({a}, {b}, {c})")
    }

    fn call(&self, function: Call, argument: String) -> String {
        let name = match function {
            Call::Sqrt => "Math.sqrt",
            Call::Abs => "Math.abs",
            Call::Sign => "_sign",
            Call::Tanh => "_tanh",
            Call::RecipPositive => "_recip_positive",
            Call::Sin => "_sin",
            Call::Cos => "_cos",
        };
        format!("{name}({argument})")
    }
}

/// Prints a documentation comment.
pub(in crate::backend) fn documentation(paragraphs: &[String], indent: &str) -> Vec<String> {
    let lines = comment_lines(paragraphs).into_iter();
    // Text must not end the comment or start a tag.
    let lines: Vec<String> =
        lines.map(|line| line.replace("*/", "* /").replace('@', "(at)")).collect();
    let mut comment = vec![format!("{indent}/**")];
    comment.extend(lines.iter().map(|line| format!("{indent} * {line}").trim_end().to_owned()));
    comment.push(format!("{indent} */"));
    comment
}

impl Printer<'_> {
    pub(in crate::backend) fn header(&self) -> Vec<String> {
        let header = self.options.header.iter();
        let mut lines: Vec<String> =
            header.map(|line| format!("// {}", comment_line(line))).collect();
        let mut doc = common::paragraphs(&self.tree.module.doc, &self.tree.module.name);
        doc.push(format!("- {}", self.options.trigonometry.range_of_angles()));
        lines.push(String::new());
        lines.extend(documentation(&doc, ""));
        lines.push(String::new());
        lines
    }

    fn text(&self) -> String {
        let mut lines = self.header();
        let helpers = self.tree.helpers().and(Helpers::of(&self.tree.constructor));
        if self.tree.has_parameters() {
            lines.extend(helpers::PARAMETERS.lines().map(str::to_owned));
        }
        if let Some(field) = self.own_field() {
            lines.extend(helpers::model(field));
        }
        lines.extend(helpers::helpers(&helpers, self.options));
        lines.extend(self.options.constants.iter().flat_map(constant));
        lines.push(String::new());
        if self.tree.has_parameters() {
            lines.extend(self.parameters());
            lines.extend(self.setters());
            lines.extend(self.model());
        }
        for function in &self.tree.functions {
            lines.extend(self.function(function));
        }
        lines.join("\n")
    }

    pub(in crate::backend) fn parameters(&self) -> Vec<String> {
        let title = common::markdown_line(&self.tree.module.name);
        let doc =
            format!("The nominal parameters of {title}; NaN for those that have no nominal value.");
        let mut lines = documentation(&[doc], "");
        lines.extend(["export function nominal() {", "    return {"].map(str::to_owned));
        for (spec, field) in self.tree.module.parameters.iter().zip(&self.tree.parameters) {
            let value = spec.nominal.map_or("NaN".to_owned(), |value| format!("{value:?}"));
            lines.push(format!("        // {}", comment_line(&common::parameter(spec))));
            lines.push(format!("        {field}: {value},"));
        }
        lines.extend(["    };", "}", ""].map(str::to_owned));
        lines
    }

    pub(in crate::backend) fn setters(&self) -> Vec<String> {
        let mut lines = vec![];
        for (setter, name) in self.options.setters.iter().zip(&self.tree.setters) {
            let mut doc = common::paragraphs(&setter.doc, &setter.name);
            doc.push(String::new());
            for SetterArgument { name, doc: meaning, unit, .. } in &setter.arguments {
                doc.push(format!("- `{name}`: {}", common::quantity(meaning, name, unit, &[])));
            }
            lines.extend(documentation(&doc, ""));
            let arguments: Vec<&str> =
                setter.arguments.iter().map(|argument| argument.name.as_str()).collect();
            lines.push(format!("export function {name}(parameters, {}) {{", arguments.join(", ")));
            lines.extend(setter.arrays().map(|(name, length)| check_length(name, length)));
            lines.extend(["    return {", "        ...parameters,"].map(str::to_owned));
            for argument in &setter.arguments {
                for (index, parameter) in argument.parameters.iter().enumerate() {
                    let mut known = self.tree.module.parameters.iter();
                    let place = known.position(|known| known.name == *parameter);
                    let Some(place) = place else { continue };
                    let value = match argument.parameters.len() {
                        1 => argument.name.clone(),
                        _ => format!("{}[{index}]", argument.name),
                    };
                    lines.push(format!("        {}: {value},", self.tree.parameters[place]));
                }
            }
            lines.extend(["    };", "}", ""].map(str::to_owned));
        }
        lines
    }

    /// The names of the parameters as a list of strings.
    pub(in crate::backend) fn parameter_names(&self) -> String {
        let names = self.tree.parameters.iter().map(|name| format!("\"{name}\""));
        names.collect::<Vec<_>>().join(", ")
    }

    fn model(&self) -> Vec<String> {
        let (tree, constructor) = (self.tree, &self.tree.constructor);
        let counts = Counts::of(&tree.module.constructor);
        let mut lines = self.parts(constructor);
        lines.extend(documentation(
            &[
                "Computes everything that depends only on the parameters, once.".to_owned(),
                String::new(),
                format!("{}.", common::operations(&counts)),
            ],
            "",
        ));
        lines.push("export function create_model(parameters) {".to_owned());
        lines.push(format!("    _check_parameters(parameters, [{}]);", self.parameter_names()));
        lines.extend(self.statements(&[], constructor, &constructor.statements));
        lines.push("    return {".to_owned());
        for (field, value) in tree.fields.iter().zip(&constructor.results) {
            lines.push(format!("        {field}: {},", infix(value, self)));
        }
        lines.extend(["    };", "}", ""].map(str::to_owned));
        lines
    }

    fn statements(
        &self,
        inputs: &[Array],
        body: &super::flat::Body,
        statements: &[Statement],
    ) -> Vec<String> {
        let text = |value: &Expression| infix(value, self);
        let statements = statements.iter().flat_map(|statement| match statement {
            Statement::Parameter { name, parameter } => {
                vec![format!("const {name} = parameters.{};", self.tree.parameters[*parameter])]
            }
            Statement::Entry { name, input, entry } => {
                vec![format!("const {name} = {}[{entry}];", inputs[*input].name)]
            }
            Statement::Circular { sine, cosine, angle } => vec![
                format!("_sin_cos({});", text(angle)),
                format!("const {sine} = _sc[0], {cosine} = _sc[1];"),
            ],
            Statement::Let { name, value } => vec![format!("const {name} = {};", text(value))],
            Statement::Part(index) => {
                let part = &body.parts[*index];
                let model = if part.reads_fields { "model, " } else { "" };
                let call = format!("{}_({model}[{}])", part.name, part.entering.join(", "));
                vec![format!("const [{}] = {call};", part.leaving.join(", "))]
            }
        });
        statements.map(|line| format!("    {line}")).collect()
    }

    /// Prints the functions of the parts of a very long body.
    fn parts(&self, body: &super::flat::Body) -> Vec<String> {
        let mut lines = vec![];
        for part in &body.parts {
            let model = if part.reads_fields { "model, " } else { "" };
            let (name, entering) = (&part.name, part.entering.join(", "));
            lines.push(format!("function {name}_({model}[{entering}]) {{"));
            lines.extend(self.statements(&[], body, &part.statements));
            lines.push(format!("    return [{}];", part.leaving.join(", ")));
            lines.extend(["}", ""].map(str::to_owned));
        }
        lines
    }

    /// The first field of the model that is not a parameter.
    fn own_field(&self) -> Option<&String> {
        let mut fields = self.tree.fields.iter().enumerate();
        fields
            .find(|(field, _)| self.tree.module.field_parameter(*field).is_none())
            .map(|(_, name)| name)
    }

    fn arguments(&self, function: &Function<'_>) -> Vec<String> {
        let model = self.tree.has_parameters().then(|| "model".to_owned());
        model.into_iter().chain(function.inputs.iter().map(|array| array.name.clone())).collect()
    }

    pub(in crate::backend) fn function_doc(&self, function: &Function<'_>) -> Vec<String> {
        let counts = self.tree.module.counts(function.source);
        let names = function.inputs.iter().map(|array| array.name.as_str());
        let mut doc = common::function(function.source, names, &counts.call);
        let outputs = function.outputs.iter().map(|array| array.name.as_str());
        common::add_results(&mut doc, Some("Returns:"), function.source, outputs);
        doc
    }

    fn function(&self, function: &Function<'_>) -> Vec<String> {
        let body = function.whole();
        let mut lines = self.parts(&body);
        lines.extend(documentation(&self.function_doc(function), ""));
        let mut arguments = self.arguments(function);
        let outputs = function.source.outputs.iter().zip(&function.outputs);
        let stored: Vec<&Array> = outputs
            .clone()
            .filter(|(output, _)| !output.shape.is_empty())
            .map(|(_, array)| array)
            .collect();
        arguments.extend(
            stored
                .iter()
                .map(|array| format!("{} = new Float64Array({})", array.name, array.length)),
        );
        lines.push(format!("export function {}({}) {{", function.name, arguments.join(", ")));
        if self.own_field().is_some() {
            lines.push("    _check_model(model);".to_owned());
        }
        let arrays = function.inputs.iter().chain(stored);
        lines.extend(arrays.map(|Array { name, length, .. }| check_length(name, *length)));
        lines.extend(self.statements(&function.inputs, &body, &body.statements));
        let mut results = body.results.iter();
        for (output, array) in outputs {
            for (index, value) in results.by_ref().take(array.length).enumerate() {
                let value = infix(value, self);
                lines.push(match output.shape.len() {
                    0 => format!("    const {} = {value};", array.name),
                    _ => format!("    {}[{index}] = {value};", array.name),
                });
            }
        }
        let names: Vec<&str> = function.outputs.iter().map(|array| array.name.as_str()).collect();
        lines.push(match names.as_slice() {
            [name] => format!("    return {name};"),
            _ => format!("    return {{ {} }};", names.join(", ")),
        });
        lines.extend(["}", ""].map(str::to_owned));
        lines
    }
}

/// Prints a constant of the module.
pub(in crate::backend) fn constant(item: &ConstantItem) -> Vec<String> {
    let value = match &item.value {
        ConstantValue::Size(size) => size.to_string(),
        ConstantValue::Number(number) => format!("{number:?}"),
        ConstantValue::Text(text) => string(text),
        ConstantValue::Texts(texts) => array(texts.iter().map(|text| string(text))),
        ConstantValue::Places(places) => {
            array(places.iter().map(|[row, column]| format!("[{row}, {column}]")))
        }
        ConstantValue::Numbers(numbers) => {
            array(numbers.iter().map(|number| format!("{number:?}")))
        }
    };
    vec![
        format!("// {}", comment_line(&item.doc)),
        format!("export const {} = {value};", item.printed_name()),
    ]
}

/// The line that refuses an array with another number of entries.
fn check_length(name: &str, length: usize) -> String {
    format!("    _check_length({name}, \"{name}\", {length});")
}

fn array(values: impl Iterator<Item = String>) -> String {
    format!("[{}]", values.collect::<Vec<_>>().join(", "))
}

/// Prints a string literal for any text, escaped so that it is also safe in HTML.
fn string(text: &str) -> String {
    let units = text.encode_utf16().map(|unit| match u8::try_from(unit) {
        Ok(byte) if byte.is_ascii_alphanumeric() || b" _-.,".contains(&byte) => {
            char::from(byte).to_string()
        }
        _ => format!("\\u{unit:04x}"),
    });
    format!("\"{}\"", units.collect::<String>())
}
