//! A C++17 header over the C header: a namespace with functions that take arrays and return their results.

use super::comment;
use super::function::real;
use super::{C, Dialect, Header, tree};
use crate::backend::common::{self, Scalar, check_range};
use crate::backend::flat::{Array, FlatOptions, Function};
use crate::backend::{Language, SourceFile, Target};
use crate::error::Errors;
use crate::module::{Module, Output};

/// C++, as a language of printed code.
pub(super) const LANGUAGE: Language = Language { name: "C++", extension: "hpp", ..super::LANGUAGE };

/// The end of the name of the macro that keeps a header from being read twice.
pub(super) const GUARD: &str = "HPP";

/// The printer of C++.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cpp {
    /// The options.
    pub options: FlatOptions,
}

impl Target for Cpp {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints the C header and a C++ header that includes it.
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        check_range(module, self.options.scalar)?;
        let mut files = C { options: self.options.clone() }.files(module)?;
        let tree = tree(module, &self.options);
        let header = Header::new(&tree, &self.options, Dialect::C);
        let name = format!("{}.{}", tree.name, LANGUAGE.extension);
        files.push(SourceFile::text(name, text(&header)));
        Ok(files)
    }
}

fn text(header: &Header<'_>) -> String {
    let (name, guard) = (&header.tree.name, header.names.upper(GUARD));
    let mut lines: Vec<String> =
        header.options.header.iter().map(|line| comment::of_line(line)).collect();
    let doc =
        [format!("`{name}.h` in a namespace: arrays are `std::array`s, and results are returned.")];
    lines.push(String::new());
    lines.extend(comment::of_paragraphs(&doc));
    lines.extend([
        format!("#ifndef {guard}"),
        format!("#define {guard}"),
        String::new(),
        "#include <array>".to_owned(),
        String::new(),
        format!("#include \"{name}.h\""),
        String::new(),
        format!("namespace {name} {{"),
        String::new(),
    ]);
    if header.tree.has_parameters() {
        lines.extend(model(header));
    }
    for function in &header.tree.functions {
        lines.extend(wrapper(header, function));
    }
    lines.extend([
        format!("}} // namespace {name}"),
        String::new(),
        "#endif".to_owned(),
        String::new(),
    ]);
    lines.join("\n")
}

fn model(header: &Header<'_>) -> Vec<String> {
    let names = &header.names;
    let (model, parameters) = (names.item("model"), names.item("parameters"));
    let mut lines = vec![format!("using Parameters = ::{parameters};")];
    if header.tree.module.parameters.iter().all(|parameter| parameter.nominal.is_some()) {
        lines.extend([
            String::new(),
            "/** The nominal parameters. */".to_owned(),
            format!("inline Parameters nominal() {{ return ::{}(); }}", names.item("nominal")),
        ]);
    }
    lines.extend([
        String::new(),
        "/** Everything that depends only on the parameters, computed once. */".to_owned(),
        format!("struct Model : ::{model} {{"),
        format!(
            "    explicit Model(const Parameters &parameters) {{ ::{}(this, &parameters); }}",
            names.item("model_init")
        ),
        "};".to_owned(),
        String::new(),
    ]);
    lines
}

/// The type of an output: `double` (or `float`), or an array.
fn type_of(scalar: Scalar, output: &Output, array: &Array) -> String {
    match output.shape.as_slice() {
        [] => real(scalar).to_owned(),
        _ => format!("std::array<{}, {}>", real(scalar), array.length),
    }
}

/// The expression for the address of an output's first entry.
fn address(output: &Output, name: &str) -> String {
    if output.shape.is_empty() { format!("&{name}") } else { format!("{name}.data()") }
}

fn wrapper(header: &Header<'_>, function: &Function<'_>) -> Vec<String> {
    let scalar = header.options.scalar;
    let (name, plain) = (&function.name, header.names.item(&function.name));
    let outputs: Vec<(&Output, &Array)> =
        function.source.outputs.iter().zip(&function.outputs).collect();
    let mut lines = vec![];
    let ty = match outputs.as_slice() {
        [(output, array)] => type_of(scalar, output, array),
        _ => {
            // The trailing underscore ensures that no function has the name of this type.
            let result = format!("{name}_result_");
            lines.push(format!("struct {result} {{"));
            for (output, array) in &outputs {
                let meaning =
                    common::quantity(&output.doc, &output.name, &output.unit, &output.shape);
                lines.push(format!("    {}", comment::of_line(&meaning)));
                lines.push(format!("    {} {};", type_of(scalar, output, array), array.name));
            }
            lines.extend(["};".to_owned(), String::new()]);
            result
        }
    };
    let mut parameters: Vec<String> = vec![];
    let mut arguments: Vec<String> = vec![];
    if header.tree.has_parameters() {
        parameters.push("const Model &model".to_owned());
        arguments.push("&model".to_owned());
    }
    for array in &function.inputs {
        parameters.push(format!(
            "const std::array<{}, {}> &{}",
            real(scalar),
            array.length,
            array.name
        ));
        arguments.push(format!("{}.data()", array.name));
    }
    arguments.extend(outputs.iter().map(|(output, array)| match outputs.len() {
        1 => address(output, "result_"),
        _ => address(output, &format!("result_.{}", array.name)),
    }));
    lines.push(format!("/** `{plain}` */"));
    lines.push(format!("inline {ty} {name}({})", parameters.join(", ")));
    lines.extend([
        "{".to_owned(),
        format!("    {ty} result_;"),
        format!("    ::{plain}({});", arguments.join(", ")),
        "    return result_;".to_owned(),
        "}".to_owned(),
        String::new(),
    ]);
    lines
}
