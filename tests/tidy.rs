//! The rules of ARCHITECTURE.md that the compiler does not check: which crates and modules may depend on which, which
//! of them may access the system, the maximum size of files and crates, that packages are self-contained, and that
//! messages of libraries do not mention the command.

#![allow(clippy::unwrap_used, clippy::panic)]

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
            if other == "robot_numeric" && !JUDGES.contains(&name.as_str()) {
                wrong.push(format!("{name} depends on the numeric solver"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The modules of its own crate that a source names, as in `crate::unit::Unit` and `crate::{unit, robot}`.
fn named(text: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let mut found = vec![];
    for (start, _) in text.match_indices("crate::") {
        let before = text[..start].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$') {
            continue;
        }
        let rest = &text[start + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => {
                let list = list.split('}').next().unwrap_or_default();
                found.extend(list.split(',').map(|entry| word(entry.trim())));
            }
            None => found.push(word(rest)),
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
            for other in named(&fs::read_to_string(&path).unwrap()) {
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
    assert_eq!(named(text), ["unit", "robot", "a", "b"]);
}

#[test]
fn files_are_short_and_no_crate_dwarfs_the_others() {
    let mut long = vec![];
    let mut lines: BTreeMap<&str, usize> = BTreeMap::new();
    for name in CRATES {
        let folder = root().join("crates").join(name);
        for path in sources(&folder) {
            let count = fs::read_to_string(&path).unwrap().lines().count();
            // Golden files are generated code.
            let is_golden = path.components().any(|part| part.as_os_str() == "goldens");
            if count > LONGEST && !is_golden {
                long.push(format!("{}: {count} lines", path.display()));
            }
            if path.starts_with(folder.join("src")) {
                *lines.entry(name).or_default() += count;
            }
        }
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
            "robot_evidence/src/compile.rs",
            "robot_cli/",
            "robot_testing/",
            "robot_languages/",
        ],
    ),
    (
        &["process::{", "process::Command", "std::net"],
        &["robot_evidence/src/compile.rs", "robot_languages/"],
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

/// Words that the glossary replaces and that have no other meaning.
const REPLACED: [&str; 9] = [
    "driving force",
    "torsor",
    "motion law",
    "direct problem",
    "mass centre",
    "centre of mass",
    "hangs on",
    "plane arm",
    "optimis",
];

/// The text of a page without code blocks, in lower case.
fn prose(page: &str) -> String {
    let blocks = page.split("\n```");
    blocks.step_by(2).collect::<Vec<_>>().join("\n").to_lowercase()
}

#[test]
fn pages_use_the_terms_of_the_glossary() {
    let docs = root().join("docs");
    let mut paths =
        ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| root().join(name)).to_vec();
    for folder in [docs.clone(), docs.join("users")] {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        paths.extend(entries.filter(|path| path.extension().is_some_and(|end| end == "md")));
    }
    // The glossary contains these words, and the summary contains the titles of diagnostics.
    paths.retain(|path| !path.ends_with("glossary.md") && !path.ends_with("SUMMARY.md"));
    assert!(paths.len() >= 25, "{}", paths.len());
    let mut wrong = vec![];
    for path in paths {
        let text = prose(&fs::read_to_string(&path).unwrap()).replace('\n', " ");
        for word in REPLACED.iter().filter(|word| text.contains(**word)) {
            wrong.push(format!("{}: {word}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "docs/glossary.md has other words: {wrong:#?}");
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

/// The names of joint variables are defined in one place: no other source contains `"qdd"`, alone or followed by a
/// placeholder for a number.
#[test]
fn names_of_joint_variables_have_one_place() {
    const NAMES: [&str; 4] = ["q", "qd", "qdd", "tau"];
    let mut wrong = vec![];
    for path in sources(&root().join("crates")) {
        let shown = path.strip_prefix(root()).unwrap().display().to_string();
        // Exceptions: names of Greek letters, names in tests, and code that is copied into generated crates.
        let is_free = shown == "crates/robot_model/src/variable.rs"
            || shown == "crates/robot_model/src/signs/letter.rs"
            || shown.starts_with("crates/robot_runtime/")
            || !shown.contains("/src/")
            || shown.ends_with("tests.rs");
        if is_free {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines = code.lines().enumerate();
        for (number, line) in lines.filter(|(_, line)| !line.trim_start().starts_with("//")) {
            let names = |name: &&str| {
                line.contains(&format!("\"{name}\"")) || line.contains(&format!("\"{name}{{"))
            };
            if NAMES.iter().any(names) {
                wrong.push(format!("{shown}:{}: {}", number + 1, line.trim()));
            }
        }
    }
    assert!(wrong.is_empty(), "use robot_model::variable::JointVariable: {wrong:#?}");
}

/// Names of the command or of options that sources of libraries may contain: the file, and a literal or a part of one.
const NAMED_ON_PURPOSE: [(&str, &str); 17] = [
    // Options of CMake in the READMEs of packages.
    ("robot_build/src/driver/languages/package/c.rs", "cmake --build build"),
    ("robot_build/src/driver/languages/package/cpp.rs", "cmake --build build"),
    ("robot_build/src/driver/languages/package/cuda.rs", "cmake --build build"),
    // Marks in files that this program writes; files that were written earlier must be recognized.
    ("robot_build/src/entry/files/marker.rs", "@generated by robot-symbolic"),
    ("robot_build/src/entry/files/staging.rs", ".robot-symbolic-tmp-"),
    // The header of pinned plans, which only the command writes.
    ("robot_dynamics/src/economical/plan/pin.rs", "Written by\\n"),
    // The footer of a page names the program that wrote it.
    ("robot_report/src/page.rs", "Written by robot-symbolic"),
    // Options of rustc, which this crate runs.
    ("robot_evidence/src/compile.rs", "--crate-type=lib"),
    ("robot_evidence/src/compile.rs", "--edition=2024"),
    ("robot_evidence/src/compile.rs", "--cap-lints=allow"),
    ("robot_evidence/src/compile.rs", "--crate-name"),
    ("robot_evidence/src/compile.rs", "--cfg"),
    ("robot_evidence/src/compile.rs", "--target"),
    ("robot_evidence/src/compile.rs", "--emit=obj"),
    ("robot_evidence/src/compile.rs", "--out-dir"),
    ("robot_evidence/src/compile.rs", " --target {target}"),
    ("robot_evidence/src/compile.rs", "`rustc --print"),
];

/// The string literals of a source outside comments, each with its line.
fn literals(text: &str) -> Vec<(usize, &str)> {
    let (bytes, mut found, mut at) = (text.as_bytes(), vec![], 0);
    let line = |at: usize| 1 + text[..at].matches('\n').count();
    while at < bytes.len() {
        let rest = &text[at..];
        let character = rest.chars().next().unwrap();
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\") {
            rest[2..].find('\'').map_or(1, |end| end + 3)
        } else if let Some(raw) = rest.strip_prefix("r#\"") {
            let end = raw.find("\"#").unwrap();
            found.push((line(at), &raw[..end]));
            end + 5
        } else if let Some(inside) = rest.strip_prefix('"') {
            let mut end = 0;
            while !inside[end..].starts_with('"') {
                end += if inside[end..].starts_with('\\') { 2 } else { 1 };
                while !inside.is_char_boundary(end) {
                    end += 1;
                }
            }
            found.push((line(at), &inside[..end]));
            end + 2
        } else {
            character.len_utf8()
        };
        at += length;
    }
    found
}

/// Whether a literal contains the name of the command, or an option as it is spelled on the command line.
fn names_command(literal: &str) -> bool {
    let is_flag = |at: usize| {
        let before = literal[..at].chars().next_back();
        let after = literal[at + 2..].chars().next();
        before.is_none_or(|c| !c.is_alphanumeric() && c != '-')
            && after.is_some_and(|c| c.is_ascii_lowercase())
    };
    literal.contains("robot-symbolic") || literal.match_indices("--").any(|(at, _)| is_flag(at))
}

#[test]
fn literals_that_name_the_command_are_found() {
    let text =
        "a(\"x\", '\"', \"try `--snap`\") // \"no\"\n/// \"no\"\nb(r#\"a \"b\" c\"#, \"\\\"\")";
    let found = literals(text);
    assert_eq!(found, [(1, "x"), (1, "try `--snap`"), (3, "a \"b\" c"), (3, "\\\"")]);
    for literal in ["run `robot-symbolic show`", "use --form grouped", "--snap", "(`--snap`)"] {
        assert!(names_command(literal), "{literal}");
    }
    for literal in ["robot_symbolic", "a -- b", "<!-- x -->", "a--b", "-x", "---"] {
        assert!(!names_command(literal), "{literal}");
    }
}

/// Users of a library have no command line: messages describe remedies in words that apply everywhere, and the command
/// adds its own hints.
#[test]
fn libraries_name_no_command_and_no_option_of_it() {
    // Options must be whole literals; other exceptions may be a part of one.
    let is_of = |literal: &str, part: &str| match part.trim_start().starts_with("--") {
        true => literal == part,
        false => literal.contains(part),
    };
    let mut wrong = vec![];
    let mut used = vec![false; NAMED_ON_PURPOSE.len()];
    for name in CRATES.iter().filter(|name| **name != "robot_cli" && !UNPUBLISHED.contains(name)) {
        for path in sources(&root().join("crates").join(name).join("src")) {
            let shown =
                path.strip_prefix(root().join("crates")).unwrap().to_str().unwrap().to_owned();
            if shown.ends_with("tests.rs") || shown.contains("/tests/") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
            for (line, literal) in literals(text).into_iter().filter(|(_, one)| names_command(one))
            {
                let known = NAMED_ON_PURPOSE
                    .iter()
                    .position(|(file, part)| shown == *file && is_of(literal, part));
                match known {
                    Some(index) => used[index] = true,
                    None => wrong.push(format!("{shown}:{line}: {literal}")),
                }
            }
        }
    }
    assert!(wrong.is_empty(), "messages of libraries that name the command: {wrong:#?}");
    assert!(used.iter().all(|used| *used), "exceptions that nothing needs: {used:?}");
}
