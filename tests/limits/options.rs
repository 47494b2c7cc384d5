//! Checks that the table of options in the book agrees with the program, and that robot files accept the keys that it
//! contains.

use std::fs;
use std::path::Path;

use robot_build::{Commands, Kind, OPTIONS, OptionSpec};
use robot_model::description::shape::{Content, ROBOT_FILE};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A row of `docs/generated-code.md`: the option, builder, macro, command and robot file.
fn row(option: &OptionSpec) -> String {
    let OptionSpec { name, example, .. } = option;
    let builder = match option.kind {
        Kind::Choice(_) => format!("`.{name}(…)`"),
        Kind::Bundles => "`.bundle(\"dynamics\", [\"mass_matrix\", \"bias\"])`".to_owned(),
        _ => format!("`.{name}({example})`"),
    };
    let flag = option.flag();
    let value = example.trim_matches(['"', '[', ']']);
    let command = match (option.commands, option.kind) {
        (Commands::None, _) => String::new(),
        (_, Kind::Flag) => format!("`{flag}`"),
        (_, Kind::Count { default: Some(_) }) => format!("`{flag}`, `{flag}={value}`"),
        (_, Kind::Bundles) => format!("`{flag} dynamics=mass_matrix,bias`"),
        _ => format!("`{flag} {value}`"),
    };
    let file = option.in_file.map(|key| format!("`{key}`")).unwrap_or_default();
    let cells = [option.title, &builder, &format!("`{name} = {example}`"), &command, &file];
    let cells =
        cells.map(|cell| if cell.is_empty() { " |".to_owned() } else { format!(" {cell} |") });
    format!("|{}", cells.concat())
}

#[test]
fn the_book_has_the_options_of_the_program() {
    let head = "| | builder | macro | command | robot file |\n|---|---|---|---|---|\n";
    let rows: Vec<String> = OPTIONS.iter().map(row).collect();
    let table = format!("{head}{}\n", rows.join("\n"));
    let book = fs::read_to_string(root().join("docs/generated-code.md")).unwrap();
    assert!(book.contains(&table), "docs/generated-code.md lacks this table:\n{table}");
}

#[test]
fn robot_files_know_the_keys_of_options() {
    for said in OPTIONS.iter().filter_map(|option| option.in_file) {
        let (table, key) = said.split_once(' ').unwrap();
        let table = ROBOT_FILE.key(table.trim_matches(['[', ']'])).unwrap();
        let (Content::Table(shape) | Content::OneOrMany(shape)) = table.content else {
            panic!("{said} is not in a table")
        };
        assert!(shape.key(key).is_some(), "{said}");
    }
}
