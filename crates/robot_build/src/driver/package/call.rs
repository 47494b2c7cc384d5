//! Calls of generated functions in Rust, for tests and examples.

use robot_codegen::Scalar;

use super::Parts;
use crate::driver::check::CheckValue;
use crate::driver::options::Options;

/// Prints the model at the stated parameters.
pub(super) fn model_expression(parts: &Parts<'_>) -> String {
    let parameters = &parts.programs.module.parameters;
    if parameters.is_empty() {
        return "Model::NOMINAL".to_owned();
    }
    if parameters.iter().all(|parameter| parameter.nominal.is_some()) {
        return "Model::new(&Parameters::NOMINAL)".to_owned();
    }
    let stated = parts.checks.first().map_or(&[][..], |check| check.parameters.as_slice());
    let fields = parameters.iter().zip(&parts.names.parameters).map(|(parameter, name)| {
        let stated = stated.iter().find(|(name, _)| *name == parameter.name);
        let value = parameter.nominal.or(stated.map(|(_, value)| *value)).unwrap_or(1.0);
        format!("{name}: {value:?}")
    });
    format!("Model::new(&Parameters {{ {} }})", fields.collect::<Vec<_>>().join(", "))
}

/// Prints the call of a function at its check state.
pub(super) fn call(parts: &Parts<'_>, model: &str, check: &CheckValue) -> String {
    let inputs: Vec<String> =
        check.inputs.iter().map(|(_, entries)| format!("&{entries:?}")).collect();
    format!("{model}.{}({})", parts.method(&check.function), inputs.join(", "))
}

/// Prints a test that compares a function with its check value.
pub(super) fn test(parts: &Parts<'_>, check: &CheckValue) -> String {
    // The underscore after a reserved word is not needed in the name of the test.
    let name = parts.method(&check.function).trim_end_matches('_');
    let model = model_expression(parts);
    let mut text = format!(
        "\n#[test]\nfn {name}_gives_its_check_value() {{\n    let model = {model};\n    let result = {};\n",
        call(parts, "model", check)
    );
    for (output, field) in check.outputs.iter().zip(parts.outputs(&check.function)) {
        let found = match output.shape.len() {
            0 => format!("&[result{field}]"),
            1 => format!("&result{field}"),
            _ => format!("result{field}.as_flattened()"),
        };
        text.push_str(&format!("    assert_close({found}, &{:?});\n", output.values));
    }
    text.push_str("}\n");
    text
}

/// The tolerance of the difference between a result and a check value, as a fraction of the largest entry.
pub(super) fn tolerance(options: &Options) -> f64 {
    match options.scalar {
        Scalar::F64 => 1e-12,
        Scalar::F32 => 1e-4,
    }
}
