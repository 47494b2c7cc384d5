//! `schema`: the JSON schema of robot files, for editors.

use clap::Args;
use robot_build::{FunctionKind, MARKER, Ownership};
use robot_model::description::shape::{
    AXES, Content, IDENTIFIER, Key, LABEL, Presence, ROBOT_FILE, Shape,
};
use serde_json::{Map, Value, json};

use crate::Terminal;
use crate::delivery::{Kind, OutputArguments};
use crate::failure::Failure;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic schema -o robot-file.schema.json

With the schema, an editor with a TOML language server completes keys, explains them and underlines misspelled
ones in files that begin with the line
  #:schema ./robot-file.schema.json
The schema covers only keys and types of values; `check` also checks their meaning.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let kind = Kind { doc: "a schema is JSON", ending: "json" };
        let output = self.output.open_kind(kind, Ownership::Marked, [])?;
        output.deliver(&format!("{:#}\n", document()), terminal)
    }
}

/// Makes the schema in draft 7, which TOML language servers of editors support.
fn document() -> Value {
    let mut schema = Map::new();
    schema.insert("$schema".to_owned(), json!("http://json-schema.org/draft-07/schema#"));
    schema.insert("$comment".to_owned(), json!(MARKER));
    schema.insert("title".to_owned(), json!("Robot file, format 1"));
    schema.insert("description".to_owned(), json!(ROBOT_FILE.doc));
    schema.extend(table(&ROBOT_FILE));
    Value::Object(schema)
}

fn table(shape: &Shape) -> Map<String, Value> {
    let properties: Map<String, Value> =
        shape.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let needed = shape.keys.iter().filter(|key| key.presence == Presence::Needed);
    let needed: Vec<&str> = needed.map(|key| key.name).collect();
    let mut schema = Map::new();
    schema.insert("type".to_owned(), json!("object"));
    schema.insert("properties".to_owned(), Value::Object(properties));
    if !needed.is_empty() {
        schema.insert("required".to_owned(), json!(needed));
    }
    schema.insert("additionalProperties".to_owned(), json!(false));
    schema
}

fn property(key: &Key) -> Value {
    let mut schema = Map::new();
    schema.insert("description".to_owned(), json!(key.doc));
    if let Value::Object(content) = content(key.content) {
        schema.extend(content);
    }
    Value::Object(schema)
}

/// The pattern of a function of one frame or moving link, whose name ends with that of the frame or link.
const OF_FRAME: &str = "^jacobian_[A-Za-z0-9_.-]+$";

/// The names of functions, and optionally a word for all of them.
fn functions(all: Option<&'static str>) -> Vec<&'static str> {
    FunctionKind::ALL.iter().map(|kind| kind.name()).chain(all).collect()
}

/// The schema of a list of functions, each at most once, including functions of frames.
fn list(words: &[&str]) -> Value {
    let items = json!({ "anyOf": [{ "enum": words }, { "type": "string", "pattern": OF_FRAME }] });
    json!({ "type": "array", "items": items, "minItems": 1, "uniqueItems": true })
}

fn content(content: Content) -> Value {
    let formula = || json!({ "type": ["number", "string"] });
    let three =
        |item: Value| json!({ "type": "array", "items": item, "minItems": 3, "maxItems": 3 });
    match content {
        Content::Format => json!({ "const": 1 }),
        Content::Formula => formula(),
        Content::Vector => three(formula()),
        Content::Axis => json!({ "anyOf": [{ "enum": AXES }, three(formula())] }),
        Content::Number => json!({ "type": "number" }),
        Content::Limits => {
            json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 })
        }
        Content::Whole => json!({ "type": "integer", "minimum": 0 }),
        Content::Function => {
            let bundle = json!({ "type": "string", "pattern": IDENTIFIER });
            let of_frame = json!({ "type": "string", "pattern": OF_FRAME });
            json!({ "anyOf": [{ "enum": functions(None) }, bundle, of_frame] })
        }
        Content::Functions(all) => list(&functions(all)),
        Content::Bundles => json!({
            "type": "object",
            "propertyNames": { "pattern": IDENTIFIER },
            "additionalProperties": list(&functions(None)),
        }),
        Content::Boolean => json!({ "type": "boolean" }),
        Content::Word(words) => json!({ "enum": words }),
        Content::Text | Content::Parent => json!({ "type": "string" }),
        Content::Unit | Content::Latex => json!({ "type": "string", "minLength": 1 }),
        Content::Identifier => json!({ "type": "string", "pattern": IDENTIFIER }),
        Content::Label => json!({ "type": "string", "pattern": LABEL }),
        Content::Components(shape) => three(json!({
            "anyOf": [{ "type": "string", "pattern": IDENTIFIER }, table(shape)],
        })),
        Content::Table(shape) => Value::Object(table(shape)),
        Content::List(shape) => json!({ "type": "array", "items": table(shape) }),
        Content::OneOrMany(shape) => {
            json!({ "anyOf": [table(shape), { "type": "array", "items": table(shape) }] })
        }
        Content::Parameters(shape) => json!({
            "type": "object",
            "propertyNames": { "pattern": IDENTIFIER },
            "additionalProperties": { "anyOf": [{ "type": "number" }, table(shape)] },
        }),
    }
}
