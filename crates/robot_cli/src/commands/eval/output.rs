//! Outputs as JSON and CSV.

use robot_codegen::OutputValues;
use serde_json::{Map, Value, json};

/// An array with an object for each state.
pub(super) fn json(results: &[Vec<OutputValues>]) -> String {
    let objects: Vec<String> = results
        .iter()
        .map(|outputs| {
            let fields = outputs.iter().map(|output| (output.name.clone(), shaped(output)));
            Value::Object(fields.collect::<Map<_, _>>()).to_string()
        })
        .collect();
    format!("[\n{}\n]\n", objects.join(",\n"))
}

/// A number, an array, or an array of rows.
fn shaped(output: &OutputValues) -> Value {
    match output.shape.as_slice() {
        [] => json!(output.values.first()),
        [_, columns] if *columns > 0 => {
            let rows: Vec<&[f64]> = output.values.chunks(*columns).collect();
            json!(rows)
        }
        _ => json!(output.values),
    }
}

/// A header and a line for each state.
pub(super) fn csv(results: &[Vec<OutputValues>]) -> String {
    let Some(first) = results.first() else {
        return String::new();
    };
    let header: Vec<String> = first.iter().flat_map(columns).collect();
    let mut text = header.join(",");
    for outputs in results {
        let values = outputs.iter().flat_map(|output| &output.values);
        let values: Vec<String> = values.map(|value| format!("{value:?}")).collect();
        text.push('\n');
        text.push_str(&values.join(","));
    }
    text.push('\n');
    text
}

/// `energy`, `tau1`, `force2_3`
fn columns(output: &OutputValues) -> Vec<String> {
    let name = &output.name;
    match output.shape.as_slice() {
        [] => vec![name.clone()],
        [rows, columns] => {
            let cells = (1..=*rows).flat_map(|row| (1..=*columns).map(move |column| (row, column)));
            cells.map(|(row, column)| format!("{name}{row}_{column}")).collect()
        }
        _ => (1..=output.values.len()).map(|number| format!("{name}{number}")).collect(),
    }
}
