//! `schema`: the committed schema is current, accepts all files that the reader accepts, and rejects those that it
//! rejects because of keys and kinds of values.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use robot_model::description::read_toml;
use robot_model::description::shape::{Content, ROBOT_FILE, Shape};
use robot_model::diagnostic::code;
use serde_json::Value;

use crate::json_schema::validate;
use crate::{output, run};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The schema that the command prints.
fn schema() -> Value {
    serde_json::from_str(&output(&["schema"], "")).unwrap()
}

/// The texts of the TOML files of a folder, with their names.
fn files(folder: &str) -> Vec<(String, String)> {
    let paths = std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    paths.sort();
    let named = paths.iter().map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read_to_string(path).unwrap())
    });
    named.collect()
}

/// The robot files in a page.
fn examples(page: &str) -> Vec<String> {
    let text = std::fs::read_to_string(root().join(page)).unwrap();
    let blocks = text.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.filter(|block| block.starts_with("format")).map(str::to_owned).collect()
}

/// A file with every key of the format.
const EVERYTHING: &str = include_str!("everything.toml");

#[test]
fn the_committed_schema_is_current() {
    let path = root().join("docs/robot-file.schema.json");
    let path = path.to_str().unwrap();
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        run(&["schema", "-o", path]);
    }
    output(&["schema", "-o", path, "--check"], "");
}

#[test]
fn what_the_reader_takes_is_valid() {
    let schema = schema();
    let mut texts = files("robots");
    assert!(texts.len() >= 9);
    let pages = examples("docs/robot-file.md").into_iter().chain(examples("README.md"));
    texts.extend(pages.map(|text| ("an example".to_owned(), text)));
    texts.push(("everything.toml".to_owned(), EVERYTHING.to_owned()));
    let broken = files("crates/robot_model/tests/broken");
    // Files with likely mistakes, and files that are invalid only with other values of parameters.
    texts.extend(broken.into_iter().filter(|(name, text)| read_toml(name, text).is_ok()));
    assert!(texts.len() >= 25, "{}", texts.len());
    for (name, text) in &texts {
        read_toml(name, text).unwrap_or_else(|found| panic!("{found}"));
        let value: Value = toml::from_str(text).unwrap();
        if let Err(error) = validate(&schema, &value, "") {
            panic!("{name}: {error}");
        }
    }
}

#[test]
fn wrong_keys_and_kinds_of_values_are_not() {
    let schema = schema();
    let told =
        [code::UNKNOWN_KEY, code::WRONG_TYPE, code::UNKNOWN_WORD, code::WRONG_COUNT, code::FORMAT];
    let mut refused = 0;
    for (name, text) in files("crates/robot_model/tests/broken") {
        let Err(found) = read_toml(&name, &text) else { continue };
        let codes: BTreeSet<_> = found.iter().map(|one| one.code).collect();
        if codes.contains(code::SYNTAX) {
            continue;
        }
        // Not every parser reads numbers outside the range.
        let Ok(value) = toml::from_str::<Value>(&text) else { continue };
        if codes.iter().any(|code| told.contains(code)) {
            refused += 1;
            assert!(
                validate(&schema, &value, "").is_err(),
                "{name} is taken by the schema:\n{found}"
            );
        }
    }
    assert!(refused >= 15, "{refused}");
}

/// Collects the keys of a shape, and of the shapes below it, that an instance has.
fn seen(shape: &'static Shape, value: &Value, keys: &mut BTreeSet<(*const Shape, &'static str)>) {
    let Value::Object(table) = value else { return };
    for key in shape.keys {
        let Some(value) = table.get(key.name) else { continue };
        keys.insert((std::ptr::from_ref(shape), key.name));
        let below = match key.content {
            Content::Table(below)
            | Content::List(below)
            | Content::OneOrMany(below)
            | Content::Components(below)
            | Content::Parameters(below) => below,
            _ => continue,
        };
        match (key.content, value) {
            (Content::Parameters(_), Value::Object(values)) => {
                values.values().for_each(|value| seen(below, value, keys));
            }
            (_, Value::Array(values)) => values.iter().for_each(|value| seen(below, value, keys)),
            _ => seen(below, value, keys),
        }
    }
}

/// Collects all shapes of the file, each once.
fn shapes(shape: &'static Shape, found: &mut Vec<&'static Shape>) {
    if found.iter().any(|one| std::ptr::eq(*one, shape)) {
        return;
    }
    found.push(shape);
    for key in shape.keys {
        if let Content::Table(below)
        | Content::List(below)
        | Content::OneOrMany(below)
        | Content::Components(below)
        | Content::Parameters(below) = key.content
        {
            shapes(below, found);
        }
    }
}

/// The reader uses every key of the schema, and the reference documents all of them.
#[test]
fn every_key_is_read_and_documented() {
    let mut keys = BTreeSet::new();
    seen(&ROBOT_FILE, &toml::from_str(EVERYTHING).unwrap(), &mut keys);
    let dh = include_str!("everything_dh.toml");
    read_toml("everything_dh.toml", dh).unwrap_or_else(|found| panic!("{found}"));
    seen(&ROBOT_FILE, &toml::from_str(dh).unwrap(), &mut keys);
    let mut all = vec![];
    shapes(&ROBOT_FILE, &mut all);
    assert!(all.len() >= 17, "{}", all.len());
    let page = std::fs::read_to_string(root().join("docs/robot-file.md")).unwrap();
    for shape in all {
        for key in shape.keys {
            let place = std::ptr::from_ref(shape);
            assert!(keys.contains(&(place, key.name)), "{}: `{}`", shape.what, key.name);
            let words = page.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            assert!(words.into_iter().any(|word| word == key.name), "`{}`", key.name);
        }
    }
}
