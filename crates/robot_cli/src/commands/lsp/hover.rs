//! What an editor shows about the key or the parameter under the pointer.

use robot_model::description::meaning::{ParameterText, Subject, meaning_at};
use robot_model::description::shape::{Content, Key, Presence};
use serde_json::{Value, json};

use super::lines::Lines;

/// The answer about a position: a text and its range, or `null` if nothing is known.
pub(super) fn hover(text: &str, position: &Value) -> Value {
    let lines = Lines::new(text);
    let Some(found) = lines.byte(position).and_then(|byte| meaning_at(text, byte)) else {
        return Value::Null;
    };
    let shown = match &found.subject {
        Subject::Key(key) => of_key(key),
        Subject::Parameter(parameter) => of_parameter(parameter),
    };
    // Plain text, in which texts of the file cannot be links or pictures.
    let contents = json!({ "kind": "plaintext", "value": shown });
    json!({ "contents": contents, "range": lines.range(&found.span) })
}

fn of_key(key: &Key) -> String {
    let presence = match key.presence {
        Presence::Needed => "required",
        Presence::Depends => "required or not, depending on other keys",
        Presence::Optional => "optional",
    };
    format!("{}: {}, {presence}\n{}", key.name, words(key.content), key.doc)
}

/// Describes the value of a key.
fn words(content: Content) -> String {
    let words = match content {
        Content::Format => "the number of the format",
        Content::Formula => "a number or an expression",
        Content::Vector => "three numbers or expressions",
        Content::Axis => "\"x\", \"-z\" or another axis, or three numbers or expressions",
        Content::Number => "a number",
        Content::Limits => "two numbers",
        Content::Whole => "a whole number",
        Content::Function => "the name of a function or a bundle",
        Content::Functions(None) => "a list of functions",
        Content::Functions(Some(all)) => return format!("a list of functions, or \"{all}\" in it"),
        Content::Bundles => "a table of lists of functions",
        Content::Boolean => "true or false",
        Content::Word(words) => {
            let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
            return quoted.join(" or ");
        }
        Content::Text => "text",
        Content::Unit => "a unit",
        Content::Latex => "LaTeX",
        Content::Identifier => "an identifier",
        Content::Label => "a name",
        Content::Parent => "the name of a link, or \"base\"",
        Content::Components(_) => "three names or tables",
        Content::Table(_) => "a table",
        Content::List(_) => "a list of tables",
        Content::OneOrMany(_) => "a table or a list of tables",
        Content::Parameters(_) => "a table of parameters",
    };
    words.to_owned()
}

fn of_parameter(parameter: &ParameterText) -> String {
    let ParameterText { name, value, unit, doc } = parameter;
    let unit = unit.as_deref().map(|unit| format!(" {unit}")).unwrap_or_default();
    let head = match value {
        Some(value) => format!("{name} = {value}{unit}"),
        None => format!("{name}:{unit} without a nominal value"),
    };
    match doc {
        Some(doc) => format!("{head}\n{doc}"),
        None => head,
    }
}
