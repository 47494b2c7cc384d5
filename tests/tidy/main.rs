//! The rules of ARCHITECTURE.md that the compiler does not check: which crates and modules may depend on which, which
//! of them may access the system, the maximum size of files and crates, that packages are self-contained, and that
//! messages of libraries do not mention the command.

#![allow(clippy::unwrap_used, clippy::panic)]

mod words;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The crates in the order of ARCHITECTURE.md: each may depend on the preceding ones.
const CRATES: [&str; 17] = [
    "robot_runtime",
    "robot_symbolic",
    "robot_model",
    "robot_dynamics",
    "robot_codegen",
    "robot_jit",
    "robot_build",
    "robot_macros",
    "robot_document",
    "robot_simulation",
    "robot_evidence",
    "robot_report",
    "robot_numeric",
    "robot_check",
    "robot_cli",
    "robot_testing",
    "robot_languages",
];

/// The crates that may depend on the numeric solver: those that check results, the command that uses it, and the common
/// code of tests. No crate that derives, prints or generates may depend on it.
const JUDGES: [&str; 3] = ["robot_check", "robot_cli", "robot_testing"];

/// Packages that are never published: their sources may include files of the whole project.
const UNPUBLISHED: [&str; 2] = ["robot_testing", "robot_languages"];

/// The layers of modules in some crates: each module may use those of its own layer and of the preceding ones.
const LAYERS: [(&str, &[&[&str]]); 3] = [
    (
        "robot_model",
        &[
            &["space", "unit", "diagnostic", "signs", "snap"],
            &["robot", "physics", "variable"],
            &["functions"],
            &["description"],
        ],
    ),
    (
        "robot_dynamics",
        &[
            &["vector", "matrix", "quantity", "limbs"],
            &["mechanism"],
            &["body", "newton_euler"],
            &["economical"],
            &["derivation", "plain"],
            &["base_parameters"],
            &["functions"],
        ],
    ),
    ("robot_build", &[&["error", "driver"], &["entry"]]),
];

/// The maximum number of lines of a file.
const LONGEST: usize = 500;

/// The maximum percentage of the code in a single crate.
const LARGEST: usize = 20;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The Rust files in a folder and its subfolders, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn place(name: &str) -> usize {
    CRATES.iter().position(|known| *known == name).unwrap_or_else(|| {
        panic!("{name} has no place in the order of crates: give it one, in ARCHITECTURE.md too")
    })
}

/// The crates of this project on which a crate depends when users build it.
fn dependencies(name: &str) -> Vec<String> {
    let manifest = root().join("crates").join(name).join("Cargo.toml");
    let manifest: toml::Table = fs::read_to_string(manifest).unwrap().parse().unwrap();
    let sections = ["dependencies", "build-dependencies"];
    let tables = sections.iter().filter_map(|section| manifest.get(*section)?.as_table());
    tables.flat_map(toml::Table::keys).filter(|key| key.starts_with("robot_")).cloned().collect()
}

#[test]
fn crates_depend_on_those_before_them() {
    let mut crates: Vec<String> = fs::read_dir(root().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    crates.sort();
    assert_eq!(crates.len(), CRATES.len(), "{crates:?}");
    let mut wrong = vec![];
    for name in &crates {
        for other in dependencies(name) {
            if place(&other) >= place(name) {
                wrong.push(format!("{name} depends on {other}, which stands after it"));
            }
            if name == "robot_codegen"
                && !["robot_symbolic", "robot_runtime"].contains(&other.as_str())
            {
                wrong.push(format!("{name} depends on {other}: programs know nothing of robots"));
            }
            if other == "robot_numeric" && !JUDGES.contains(&name.as_str()) {
                wrong.push(format!("{name} depends on the numeric solver"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The modules of its own crate that a source names, as in `crate::unit::Unit`, `crate::{unit, robot}` and, at `depth`
/// modules below the crate's root, so many times `super::`.
fn named(text: &str, depth: usize) -> Vec<String> {
    let root = "super::".repeat(depth);
    // In a module of tests, `super` is the file itself.
    let code = text.split("\nmod tests {").next().unwrap_or_default();
    let mut found = after(text, "crate::");
    found.extend(after(code, &root));
    found
}

/// The first names of the paths that begin with `prefix`.
fn after(text: &str, prefix: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let mut found = vec![];
    for (start, _) in text.match_indices(prefix) {
        let before = text[..start].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || "_$:".contains(c)) {
            continue;
        }
        let rest = &text[start + prefix.len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(entries(list).iter().map(|entry| word(entry.trim()))),
            None => found.push(word(rest)),
        }
    }
    found
}

/// The entries of a list up to the brace that closes it; each can have lists of its own.
fn entries(list: &str) -> Vec<&str> {
    let (mut found, mut start, mut depth) = (vec![], 0, 0);
    for (place, character) in list.char_indices() {
        match character {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' if depth == 0 => {
                found.push(&list[start..place]);
                start = place + 1;
            }
            '}' => {
                found.push(&list[start..place]);
                break;
            }
            _ => {}
        }
    }
    found
}

#[test]
fn modules_use_those_of_layers_before_them() {
    let mut wrong = vec![];
    for (name, layers) in LAYERS {
        let source = root().join("crates").join(name).join("src");
        let layer = |module: &str| layers.iter().position(|modules| modules.contains(&module));
        for path in sources(&source) {
            let inside = path.strip_prefix(&source).unwrap();
            let first = inside.iter().next().unwrap().to_str().unwrap();
            let own = first.strip_suffix(".rs").unwrap_or(first);
            if own == "lib" {
                continue;
            }
            let Some(here) = layer(own) else {
                wrong.push(format!("{name}: the module {own} has no layer"));
                continue;
            };
            let is_folder = path.ends_with("mod.rs");
            let depth = inside.components().count() - usize::from(is_folder);
            for other in named(&fs::read_to_string(&path).unwrap(), depth) {
                if layer(&other).is_some_and(|other| other > here) {
                    wrong.push(format!(
                        "{name}: {} uses {other}, which stands above it",
                        inside.display()
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn names_of_modules_are_found_in_paths_and_lists() {
    let text = "use crate::unit::Unit; let x = crate::robot::Y; use crate::{a, b::c}; $crate::no mycrate::no";
    assert_eq!(named(text, 1), ["unit", "robot", "a", "b"]);
    assert_eq!(named("use crate::{a::{self, b::{c}}, d::e, f};", 1), ["a", "d", "f"]);
    let text = "use super::unit;\nuse super::super::{a::{b}, c};\nmod tests {\n use super::x;";
    assert_eq!(named(text, 1), ["unit", "super"]);
    assert_eq!(named(text, 2), ["a", "c"]);
}

#[test]
fn files_are_short_and_no_crate_dwarfs_the_others() {
    let mut long = vec![];
    let mut lines: BTreeMap<&str, usize> = BTreeMap::new();
    let length = |path: &Path| fs::read_to_string(path).unwrap().lines().count();
    for folder in ["crates", "src", "tests", "benches", "examples", "fuzz", "python", "query"] {
        for path in sources(&root().join(folder)) {
            // Golden files are generated code, and so is what builds leave.
            let is_generated = path
                .components()
                .any(|part| ["goldens", "target"].iter().any(|name| part.as_os_str() == *name));
            let count = length(&path);
            if count > LONGEST && !is_generated {
                long.push(format!("{}: {count} lines", path.display()));
            }
        }
    }
    for name in CRATES {
        let own = sources(&root().join("crates").join(name).join("src"));
        lines.insert(name, own.iter().map(|path| length(path)).sum());
    }
    assert!(long.is_empty(), "files of more than {LONGEST} lines: {long:#?}");
    let all: usize = lines.values().sum();
    let large: Vec<_> = lines.iter().filter(|(_, count)| **count * 100 > all * LARGEST).collect();
    assert!(large.is_empty(), "of {all} lines: {large:?}");
}

/// The crate in which a module file may be beside the folder of the module: its sources are copied into generated
/// crates and keep their names there.
const COPIED: &str = "robot_runtime";

#[test]
fn modules_with_a_folder_lie_in_it() {
    let mut wrong = vec![];
    for name in CRATES.iter().filter(|name| **name != COPIED) {
        for path in sources(&root().join("crates").join(name).join("src")) {
            if path.with_extension("").is_dir() {
                wrong.push(format!("{} belongs in its folder, as `mod.rs`", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The paths of files that a source includes, as they are written: `include_str!("a")`, `include!("a")`,
/// `#[path = "a"]`.
fn included(text: &str) -> Vec<&str> {
    let openings = ["include_str!(\"", "include_bytes!(\"", "include!(\"", "#[path = \""];
    let found = openings.iter().flat_map(|opening| text.split(opening).skip(1));
    found.filter_map(|rest| rest.split('"').next()).collect()
}

/// A path without `.` and `..`, computed from its text alone.
fn plain(path: &Path) -> PathBuf {
    let mut found = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(found.pop()),
            Component::CurDir => {}
            part => found.push(part),
        }
    }
    found
}

#[test]
fn included_files_are_found_in_sources() {
    let text = "include_str!(\"a\") include_bytes!(\"b\") #[path = \"../c.rs\"] include!(\"d\")";
    let mut found = included(text);
    found.sort_unstable();
    assert_eq!(found, ["../c.rs", "a", "b", "d"]);
    assert_eq!(plain(Path::new("/x/src/../../y/./z")), Path::new("/y/z"));
}

#[test]
fn packages_include_nothing_from_outside() {
    let mut wrong = vec![];
    for name in CRATES {
        let package = root().join("crates").join(name);
        for path in sources(&package) {
            let text = fs::read_to_string(&path).unwrap();
            let folder = path.parent().unwrap();
            let is_test = path.starts_with(package.join("tests"));
            for file in included(&text) {
                let outside = !plain(&folder.join(file)).starts_with(&package);
                // Tests are not packaged, so they may read files of the project, but not code of another package.
                let may = is_test && !file.ends_with(".rs") || UNPUBLISHED.contains(&name);
                if outside && !may {
                    wrong.push(format!("{} includes {file}", path.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The text of a source before its unit tests.
fn without_tests(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let end = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
    text[..end].to_owned()
}

/// The parts of the system, given by their paths, and the crates, folders and files that may access them.
const SYSTEM: [(&[&str], &[&str]); 3] = [
    (
        &["std::fs", "std::env", "std::io::std", "io::stdin", "io::stdout", "io::stderr"],
        &[
            "robot_build/src/entry/",
            "robot_macros/",
            "robot_evidence/src/compile/",
            "robot_cli/",
            "robot_testing/",
            "robot_languages/",
        ],
    ),
    (
        &["process::{", "process::Command", "std::net"],
        &["robot_evidence/src/compile/", "robot_languages/"],
    ),
    (&["std::time"], &["robot_cli/", "robot_languages/"]),
];

#[test]
fn only_entry_points_touch_the_system() {
    let mut wrong = vec![];
    let folder = root().join("crates");
    for path in CRATES.iter().flat_map(|name| sources(&folder.join(name).join("src"))) {
        if path.ends_with("tests.rs") {
            continue;
        }
        let text = without_tests(&path);
        let name = path.strip_prefix(&folder).unwrap().to_str().unwrap();
        for (words, places) in SYSTEM {
            for word in words.iter().filter(|word| text.contains(**word)) {
                if !places.iter().any(|place| name.starts_with(place)) {
                    wrong.push(format!("{name} uses {word}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_solver_knows_no_derivation() {
    assert_eq!(dependencies("robot_numeric"), ["robot_symbolic", "robot_model"]);
}

/// The tests that an invariant names in code spans: paths, each with the names that follow it.
fn held_by(invariant: &str) -> Vec<(&str, Vec<&str>)> {
    let spans = invariant.split('`').skip(1).step_by(2);
    let mut found: Vec<(&str, Vec<&str>)> = vec![];
    for span in spans {
        match found.last_mut() {
            Some((_, names)) if !span.contains(['/', '.']) => names.push(span),
            _ => found.push((span, vec![])),
        }
    }
    found
}

#[test]
fn invariants_name_what_holds_them() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let (_, section) = page.split_once("\n## Invariants\n").unwrap();
    let section = section.split("\n## ").next().unwrap();
    let invariants: Vec<&str> = section.split("\n- **").skip(1).collect();
    assert!(invariants.len() >= 18, "{}", invariants.len());
    for invariant in invariants {
        let title = invariant.lines().next().unwrap();
        let (_, holders) = invariant.split_once("*Held by* ").unwrap_or_else(|| panic!("{title}"));
        let found = held_by(holders);
        assert!(!found.is_empty() || holders.starts_with("review"), "{title}: nothing holds it");
        for (path, names) in found {
            let text = fs::read_to_string(root().join(path))
                .unwrap_or_else(|error| panic!("{title}: {path}: {error}"));
            for name in names {
                let (test, lint) = (format!("fn {name}("), format!("\n{name} = "));
                assert!(text.contains(&test) || text.contains(&lint), "{title}: {path}: {name}");
            }
        }
    }
}

/// Checks the metadata in the manifests of packages.
#[test]
fn packages_say_what_they_are() {
    let workspace: toml::Table =
        fs::read_to_string(root().join("Cargo.toml")).unwrap().parse().unwrap();
    let pin = format!("={}", workspace["workspace"]["package"]["version"].as_str().unwrap());
    for name in CRATES.iter().filter(|name| !UNPUBLISHED.contains(name)) {
        let folder = root().join("crates").join(name);
        let manifest: toml::Table =
            fs::read_to_string(folder.join("Cargo.toml")).unwrap().parse().unwrap();
        let package = manifest["package"].as_table().unwrap();
        for key in ["description", "readme", "keywords", "categories", "license", "include"] {
            assert!(package.contains_key(key), "{name} has no `{key}`");
        }
        for file in ["README.md", "LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(folder.join(file).is_file(), "{name} has no {file}");
        }
        let version = &workspace["workspace"]["dependencies"][name]["version"];
        assert_eq!(version.as_str(), Some(&*pin), "{name}");
    }
}
