//! Invalid robot files and the messages that they must cause (tests/broken).
//!
//! `UPDATE_SNAPSHOTS=1` rewrites the messages; review the difference before you keep it.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use robot_check::doctor::{Examination, check};
use robot_model::description::Options;
use robot_model::diagnostic::code;

fn folder() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/broken"))
}

/// The stems of the files in the folder with the given extension.
fn stems(extension: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(folder()).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|found| found == extension))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect()
}

/// The files in both formats.
fn files() -> BTreeSet<String> {
    let of = |end: &str| stems(end).into_iter().map(|stem| format!("{stem}.{end}")).collect();
    let (toml, urdf): (BTreeSet<String>, BTreeSet<String>) = (of("toml"), of("urdf"));
    assert!(toml.len() >= 45 && urdf.len() >= 45, "{} {}", toml.len(), urdf.len());
    toml.union(&urdf).cloned().collect()
}

/// The messages about a file: its errors or, for a file that still describes a robot, its warnings and notes.
fn message(name: &str) -> String {
    let text = fs::read_to_string(folder().join(name)).unwrap();
    let Examination { found, choices } = check(name, &text, &Options::default());
    if found.is_empty() { choices.to_string() } else { found.to_string() }
}

fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

#[test]
fn broken_files_give_their_messages() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let files = files();
    let mut wrong = Vec::new();
    for name in &files {
        let found = message(name);
        assert!(found.contains(&format!("{name}: ")), "{name} is not broken: {found}");
        let path = folder().join(format!("{}.txt", stem(name)));
        let expected = fs::read_to_string(&path).unwrap_or_default();
        if found == expected {
            continue;
        }
        if update {
            fs::write(path, found).unwrap();
        } else {
            wrong.push(format!("{name}: expected\n{expected}\nfound\n{found}"));
        }
    }
    let names: BTreeSet<String> = files.iter().map(|name| stem(name).to_owned()).collect();
    let stale: Vec<_> = stems("txt").difference(&names).cloned().collect();
    assert!(stale.is_empty(), "messages without a file: {stale:?}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_code_has_a_broken_file() {
    // These two codes concern the bytes of a file; `hostile` tests them.
    let mut missing = BTreeSet::from_iter(code::TABLE.iter().map(|(code, _)| *code));
    missing.remove(code::TOO_LARGE);
    missing.remove(code::NOT_TEXT);
    // These codes are only reported when code is generated.
    for code in [code::BUDGET, code::PIN, code::INFINITE] {
        missing.remove(code);
    }
    for stem in stems("txt") {
        let text = fs::read_to_string(folder().join(format!("{stem}.txt"))).unwrap();
        missing.retain(|code| !text.contains(&format!("[{code}]")));
    }
    assert!(missing.is_empty(), "{missing:?}");
}
