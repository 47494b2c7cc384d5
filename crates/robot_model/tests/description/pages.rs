//! The pages of the diagnostic codes: each code has a page, and its example causes only this code.

use std::collections::BTreeSet;
use std::fs;

use robot_check::doctor::{Examination, check};
use robot_model::description::Options;
use robot_model::diagnostic::{Severity, code};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/diagnostics");
/// The page of the book that lists the codes.
const LIST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/diagnostics/README.md");
/// The path of the pages in that list.
const LINKED: &str = "../../crates/robot_model/diagnostics";

/// Codes whose pages have no example: two concern the bytes of a file, which no page can show; budgets, pinned plans
/// and constants are only checked when code is generated.
const WITHOUT_EXAMPLE: [&str; 5] =
    [code::TOO_LARGE, code::NOT_TEXT, code::BUDGET, code::PIN, code::INFINITE];

/// The examples of a page, as names and texts of files.
fn examples(page: &str) -> Vec<(&'static str, &str)> {
    let of = |fence: &str, name: &'static str| {
        let blocks = page.split(fence).skip(1).map(|rest| rest.split("```").next().unwrap());
        blocks.map(|text| (name, text)).collect::<Vec<_>>()
    };
    let mut found = of("```toml\n", "arm.toml");
    found.extend(of("```xml\n", "arm.urdf"));
    found
}

#[test]
fn every_page_belongs_to_a_code_and_stands_in_the_list() {
    let names = fs::read_dir(FOLDER).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let pages: BTreeSet<String> = names.collect();
    let expected: BTreeSet<String> =
        code::TABLE.iter().map(|(code, _)| format!("{code}.md")).collect();
    assert_eq!(pages, expected);
    let list = fs::read_to_string(LIST).unwrap();
    for (code, title) in code::TABLE {
        let page = code::page(code).unwrap();
        assert!(page.starts_with(&format!("# {code}: {title}\n\n")), "{page}");
        assert!(page.contains("\nWhat to do: "), "{page}");
        let severity = page.lines().nth(2).unwrap().split('.').next().unwrap().to_lowercase();
        assert!(
            list.contains(&format!("| [{code}]({LINKED}/{code}.md) | {severity} | {title} |\n")),
            "{code}"
        );
    }
    assert_eq!(code::page("R9999"), None);
}

#[test]
fn the_example_of_a_page_gives_its_code_alone() {
    let mut wrong = String::new();
    for (code, _) in code::TABLE {
        let page = code::page(code).unwrap();
        let examples = examples(page);
        assert_eq!(examples.is_empty(), WITHOUT_EXAMPLE.contains(code), "{code}");
        for (name, text) in examples {
            let Examination { found, choices } = check(name, text, &Options::default());
            // A URDF file always causes several notes about choices.
            let noted = found.is_empty() && choices.iter().any(|one| one.code == *code);
            let alone = !found.is_empty() && found.iter().all(|one| one.code == *code);
            let severity = found.iter().map(|one| one.severity).next().unwrap_or(Severity::Note);
            if !(noted || alone) || !page.contains(&format!("\n\n{severity:?}. ")) {
                wrong += &format!("{code}, {severity:?}:\n{found}{choices}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
