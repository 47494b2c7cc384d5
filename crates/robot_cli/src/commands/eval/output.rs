//! Printing of outputs as JSON and CSV, state by state.

use robot_codegen::module::Output;
use robot_simulation::csv::push_number;
use serde_json::Value;

use super::Format;

/// Prints the outputs at states.
pub(super) enum Printer {
    /// An array with an object for each state.
    Json(Vec<Field>),
    /// A header and a line for each state.
    Csv {
        /// The line above the first state; it is printed even if there are no states.
        header: String,
    },
}

/// An output in JSON.
pub(super) struct Field {
    /// The text before its value: `"tau":`.
    key: String,
    shape: Shape,
    /// The number of entries.
    length: usize,
}

/// The shape of an output: a number, an array, or an array of rows with a number of entries.
#[derive(Clone, Copy)]
enum Shape {
    Scalar,
    Vector,
    Rows(usize),
}

impl Printer {
    pub(super) fn new(format: Format, outputs: &[Output]) -> Printer {
        match format {
            Format::Json => Printer::json(outputs),
            Format::Csv => Printer::csv(outputs),
        }
    }

    fn json(outputs: &[Output]) -> Printer {
        let field = |output: &Output| Field {
            key: format!("{}:", Value::from(output.name.as_str())),
            length: output.len(),
            shape: match output.shape.as_slice() {
                [] => Shape::Scalar,
                [_, columns] if *columns > 0 => Shape::Rows(*columns),
                _ => Shape::Vector,
            },
        };
        Printer::Json(outputs.iter().map(field).collect())
    }

    fn csv(outputs: &[Output]) -> Printer {
        let header: Vec<String> = outputs.iter().flat_map(columns).collect();
        Printer::Csv { header: header.join(",") }
    }

    /// Appends the entries of all outputs at a state.
    pub(super) fn state(
        &self,
        is_first: bool,
        values: impl Iterator<Item = f64>,
        text: &mut String,
    ) {
        match self {
            Printer::Json(fields) => {
                text.push_str(if is_first { "[\n" } else { ",\n" });
                object(fields, values, text);
            }
            Printer::Csv { header } => {
                if is_first {
                    text.push_str(header);
                    text.push('\n');
                }
                listed(values, text, push_number);
                text.push('\n');
            }
        }
    }

    /// Appends the text after the last state.
    pub(super) fn end(&self, is_empty: bool, text: &mut String) {
        match self {
            Printer::Json(_) => text.push_str(if is_empty { "[]\n" } else { "\n]\n" }),
            Printer::Csv { header } if is_empty => {
                text.push_str(header);
                text.push('\n');
            }
            Printer::Csv { .. } => {}
        }
    }
}

/// Appends an object such as `{"tau":[1.0,2.0]}`.
fn object(fields: &[Field], mut values: impl Iterator<Item = f64>, text: &mut String) {
    text.push('{');
    for (index, Field { key, shape, length }) in fields.iter().enumerate() {
        if index > 0 {
            text.push(',');
        }
        text.push_str(key);
        match *shape {
            Shape::Scalar => listed(values.by_ref().take(1), text, push_json),
            Shape::Vector => array(values.by_ref().take(*length), text),
            Shape::Rows(columns) => {
                text.push('[');
                for row in 0..length / columns {
                    if row > 0 {
                        text.push(',');
                    }
                    array(values.by_ref().take(columns), text);
                }
                text.push(']');
            }
        }
    }
    text.push('}');
}

fn array(values: impl Iterator<Item = f64>, text: &mut String) {
    text.push('[');
    listed(values, text, push_json);
    text.push(']');
}

fn listed(values: impl Iterator<Item = f64>, text: &mut String, push: fn(&mut String, f64)) {
    for (index, value) in values.enumerate() {
        if index > 0 {
            text.push(',');
        }
        push(text, value);
    }
}

/// Appends a finite number in the format of `serde_json`, with the same library.
fn push_json(text: &mut String, number: f64) {
    text.push_str(zmij::Buffer::new().format_finite(number));
}

/// The names of an output's columns, such as `energy`, `tau1` or `force2_3`.
fn columns(output: &Output) -> Vec<String> {
    let name = &output.name;
    match output.shape.as_slice() {
        [] => vec![name.clone()],
        [rows, columns] => {
            let cells = (1..=*rows).flat_map(|row| (1..=*columns).map(move |column| (row, column)));
            cells.map(|(row, column)| format!("{name}{row}_{column}")).collect()
        }
        _ => (1..=output.len()).map(|number| format!("{name}{number}")).collect(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_matrix_without_columns_has_no_entries() {
        let output = |name: &str, shape: &[usize]| Output {
            name: name.to_owned(),
            shape: shape.to_vec(),
            doc: String::new(),
            unit: String::new(),
            values: (),
        };
        let printer = Printer::json(&[output("Y", &[3, 0]), output("tau", &[2])]);
        let mut text = String::new();
        printer.state(true, [1.0, 2.0].into_iter(), &mut text);
        assert_eq!(text, "[\n{\"Y\":[],\"tau\":[1.0,2.0]}");
    }

    #[test]
    fn numbers_are_those_of_serde_json() {
        let numbers = [0.0, -0.0, 1.0, 1e-4, 1e-5, 1e-7, 0.1 + 0.2, 1e16, 1.5e300, 5e-324, -2e22];
        for number in
            numbers.into_iter().chain((0..10_000).map(|k| f64::from(k) / 2_f64.powi(k % 70)))
        {
            let mut text = String::new();
            push_json(&mut text, number);
            assert_eq!(text, json!(number).to_string());
        }
    }
}
