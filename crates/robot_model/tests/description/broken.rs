//! Invalid robot files and the messages that they must cause (tests/broken).
//!
//! `UPDATE_SNAPSHOTS=1` rewrites the messages; review the difference before you keep it.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use robot_check::doctor::{Examination, check};
use robot_model::description::{Options, read_toml};
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

#[test]
fn duplicate_keys_below_a_wrong_header_are_reported() {
    let text = "format = 1\n[robot] x\nname = \"a\"\nname = \"b\"\n";
    let found = read_toml("arm.toml", text).unwrap_err();
    let duplicates = found.iter().filter(|one| one.message.contains("duplicate key"));
    let places: Vec<_> = duplicates.map(|one| one.primary.as_ref().unwrap().span.start).collect();
    assert_eq!(places, [text.rfind("name").unwrap()], "{found}");
}

#[test]
fn sums_of_lengths_and_pure_numbers_are_named() {
    let text = "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nphi = { value = 1, unit = \"rad\" }\n\
                l = { value = 1, unit = \"m\" }\n[[link]]\nname = \"1\"\nmass = 1.0\n\
                joint = { type = \"revolute\", axis = \"z\" }\ncenter_of_mass = [\"l + phi\", 0, 0]\n\
                inertia = { xx = 1.0, yy = 1.0, zz = 1.0 }\n";
    let found = read_toml("arm.toml", text).unwrap_err();
    let messages: Vec<&str> = found.iter().map(|one| one.message.as_str()).collect();
    assert_eq!(messages, ["`l + phi` adds a value in m to a pure number"]);
}

/// A key that resembles a missing one is misspelled, and the missing one is not reported too.
#[test]
fn a_misspelled_key_is_not_missing() {
    let codes = |key: &str| {
        let text = format!(
            "format = 1\n[robot]\nname = \"arm\"\n[[link]]\n{key} = \"1\"\nmass = 1.0\ncenter_of_mass = [0, 0, 0]\n\
             inertia = {{ xx = 1.0, yy = 1.0, zz = 1.0 }}\njoint = {{ type = \"revolute\", axis = \"z\" }}\n"
        );
        let found = read_toml("arm.toml", &text).unwrap_err();
        let mut codes: Vec<_> = found.iter().map(|one| one.code).collect();
        codes.sort_unstable();
        codes
    };
    assert_eq!(codes("nmae"), [code::UNKNOWN_KEY]);
    let mut both = [code::UNKNOWN_KEY, code::MISSING_KEY];
    both.sort_unstable();
    assert_eq!(codes("colour"), both);
}
