//! Files that mean harm, and files that chance has spoilt: each ends in a message, soon.

use std::fs;
use std::time::{Duration, Instant};

use robot_dynamics::description::{MAX_BYTES, decode, read_toml};
use robot_dynamics::diagnostic::code;
use robot_dynamics::numeric::random::Random;

use crate::{arm, errors, read};

const LINK: &str = "
[[link]]
name = \"1\"
joint = { type = \"revolute\", axis = \"z\" }
massless = true
";

/// The codes of the errors of a file, which must be found within a few seconds.
fn codes(text: &str) -> Vec<&'static str> {
    let start = Instant::now();
    let found = errors(text);
    let rendered = found.to_string();
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    assert!(rendered.len() < 200_000, "{}", rendered.len());
    found.iter().map(|diagnostic| diagnostic.code).collect()
}

#[test]
fn ten_megabytes_are_refused_before_they_are_parsed() {
    let text = arm(&"# a comment\n".repeat(10 * MAX_BYTES / 12));
    assert_eq!(codes(&text), [code::TOO_LARGE]);
    let found = decode("arm.toml", text.into_bytes()).unwrap_err();
    assert!(found.to_string().contains("arm.toml"), "{found}");
    assert!(found.to_string().contains("10485"), "{found}");
}

#[test]
fn a_file_at_the_limit_is_read() {
    let mut text = arm(LINK);
    text += &"#".repeat(MAX_BYTES - text.len());
    read(&text);
    assert_eq!(codes(&(text + "#")), [code::TOO_LARGE]);
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_place() {
    let mut bytes = arm(LINK).into_bytes();
    bytes.extend_from_slice(b"# \xff\xfe");
    let found = decode("arm.toml", bytes).unwrap_err();
    assert_eq!(found.iter().next().unwrap().code, code::NOT_TEXT);
    assert!(found.to_string().contains("arm.toml:10:3\n"), "{found}");
}

#[test]
fn a_byte_order_mark_is_accepted() {
    read(&format!("\u{feff}{}", arm(LINK)));
}

#[test]
fn expressions_nested_deep_end_in_a_message() {
    for unit in ["(", "-", "sin(", "1+("] {
        let deep = unit.repeat(100_000);
        let text = arm(&format!("gravity = [0, 0, \"{deep}\"]\n{LINK}"));
        assert_eq!(codes(&text), [code::EXPRESSION], "{unit}");
    }
    let closed = format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000));
    let text = arm(&format!("gravity = [0, 0, \"{closed}\"]\n{LINK}"));
    assert_eq!(codes(&text), [code::EXPRESSION]);
    let long = vec!["1"; 200_000].join("+");
    let text = arm(&format!("gravity = [0, 0, \"{long}\"]\n{LINK}"));
    assert_eq!(codes(&text), [code::EXPRESSION]);
}

#[test]
fn values_nested_deep_end_in_a_message() {
    let dots = "a.".repeat(100_000);
    let headers = "[a]\n[[a.b]]\n".repeat(20_000);
    for text in [
        format!("x = {}", "[".repeat(100_000)),
        format!("x = {}{}", "[".repeat(100_000), "]".repeat(100_000)),
        format!("x = {}", "{a=".repeat(100_000)),
        format!("{dots}a = 1"),
        format!("[{dots}a]"),
        format!("x = {{ {dots}a = 1 }}"),
        headers,
    ] {
        let found = codes(&arm(&format!("{text}\n{LINK}")));
        assert!(found.contains(&code::SYNTAX), "{found:?}");
    }
}

#[test]
fn huge_counts_end_in_a_message() {
    let parameters: String = (0..5000).map(|i| format!("p{i} = 1\n")).collect();
    let text = arm(&format!("[parameters]\n{parameters}\n{LINK}"));
    assert_eq!(codes(&text), [code::LIMIT]);
    let text = arm(&"[[link]]\n".repeat(50_000));
    assert_eq!(codes(&text)[0], code::LIMIT);
    let text = arm(&format!("[parameters]\n{} = 1\n{LINK}", "x".repeat(1_000_000)));
    assert_eq!(codes(&text), [code::NAME]);
    let text = arm(&format!("{LINK}mass = \"{}\"\n", "x".repeat(1_000_000)));
    assert!(codes(&text).contains(&code::UNKNOWN_SYMBOL));
    let text = arm(&format!("{LINK}{}\n", "x = 1\n".repeat(100_000)));
    assert!(codes(&text).contains(&code::SYNTAX));
    let keys: String = (0..50_000).map(|i| format!("x{i} = 1\n")).collect();
    assert!(codes(&arm(&format!("{LINK}{keys}\n"))).contains(&code::UNKNOWN_KEY));
    let digits = "9".repeat(900_000);
    assert!(codes(&arm(&format!("gravity = [0, 0, {digits}]\n{LINK}"))).contains(&code::NUMBER));
}

#[test]
fn a_great_many_misspelt_names_end_in_a_message() {
    let parameters: String = (0..4096).map(|i| format!("parameter_{i} = 1\n")).collect();
    let unknown: Vec<_> = (0..40_000).map(|i| format!("paramter_{i}")).collect();
    let text = format!("[parameters]\n{parameters}{LINK}mass = \"{}\"\n", unknown.join("+"));
    let found = codes(&arm(&text));
    assert!(found.iter().filter(|code| **code == code::UNKNOWN_SYMBOL).count() >= 40);
    let link = |i: usize| {
        let parent = format!("a_name_of_many_many_letters_that_is_not_quite_right_number_{i}");
        let joint = "joint = { type = \"revolute\", axis = \"z\" }\nmassless = true";
        format!(
            "[[link]]\nname = \"{}\"\nparent = \"{parent}\"\n{joint}\n",
            parent.replace("quite", "quiet")
        )
    };
    let text: String = (0..500).map(link).collect();
    assert_eq!(codes(&arm(&text)), [code::UNKNOWN_LINK; 500]);
}

#[test]
fn figures_at_the_end_of_the_range_are_judged() {
    let inertia =
        "inertia = { xx = 1e308, yy = 1e308, zz = 1e308, xy = 1e308, about = \"origin\" }";
    let text = arm(&LINK.replace(
        "massless = true",
        &format!("mass = 1e308\ncenter_of_mass = [1e308, 1e308, \"1e308*10\"]\n{inertia}"),
    ));
    assert_eq!(codes(&text), [code::NUMBER; 2]);
    let text = arm(&LINK.replace(
        "massless = true",
        &format!("mass = 1e308\ncenter_of_mass = [1e308, 1e308, 0]\n{inertia}"),
    ));
    assert_eq!(codes(&text), [code::NUMBER]);
}

/// Every file of the project as seed: robots, and broken ones.
fn seeds() -> [Vec<Vec<u8>>; 2] {
    ["../../robots", "tests/broken"].map(|folder| {
        let folder = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
        let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let toml = |path: &std::path::PathBuf| path.extension().is_some_and(|end| end == "toml");
        let mut paths: Vec<_> = paths.filter(toml).collect();
        paths.sort();
        paths.iter().map(|path| fs::read(path).unwrap()).collect()
    })
}

/// Pieces that have a meaning somewhere.
const PIECES: &[&str] = &[
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "\"",
    "'",
    "\"\"\"",
    "=",
    ",",
    ".",
    "-",
    "+",
    "^",
    "/",
    "*",
    "_",
    "\\",
    "\\u0041",
    "\\x",
    "#",
    "\n",
    "\r\n",
    "\t",
    "nan",
    "inf",
    "1e309",
    "1e-400",
    "0",
    "-1",
    "9999999999999999999",
    "0x1F",
    "true",
    "pi",
    "sqrt(-1)",
    "1/0",
    "é",
    "\u{202e}",
    "\u{0}",
    "\u{feff}",
    "😀",
    "[[link]]\n",
    "[dh]\n",
    "[tip]\n",
    "[[frame]]\n",
    "[parameters]\n",
    "name = \"1\"\n",
    "parent = \"base\"\n",
    "massless = true\n",
    "dh = { convention = \"standard\", a = 1, alpha = \"pi/2\" }\n",
    "mimic = { joint = \"1\" }",
    "about = \"origin\"",
    "unchecked = true",
    "rows = [{ a = 1 }, { type = \"fixed\" }]\n",
];

/// A few random edits of a text.
fn spoil(random: &mut Random, seeds: &[Vec<Vec<u8>>; 2]) -> Vec<u8> {
    let seeds = &seeds[random.index(2)];
    let mut text = seeds[random.index(seeds.len())].clone();
    for _ in 0..1 + random.index(4) {
        let at = random.index(text.len() + 1);
        let most = 1 + random.index(60);
        let end = (at + random.index(most)).min(text.len());
        match random.index(6) {
            0 => drop(text.drain(at..end)),
            1 => drop(text.splice(at..end, PIECES[random.index(PIECES.len())].bytes())),
            2 => {
                let piece = text[at..end].to_vec();
                let to = random.index(text.len() + 1);
                drop(text.splice(to..to, piece));
            }
            3 if !text.is_empty() => {
                let at = at.min(text.len() - 1);
                text[at] ^= 1 << random.index(8);
            }
            4 => {
                let other = &seeds[random.index(seeds.len())];
                let from = random.index(other.len());
                let to = (from + random.index(200)).min(other.len());
                drop(text.splice(at..end, other[from..to].iter().copied()));
            }
            _ => text.truncate(text.len() - random.index(20).min(text.len())),
        }
    }
    text
}

/// Reads spoilt files; whatever is reported must be renderable, in order, and in place.
fn fuzz(seed: u64, rounds: usize) -> [usize; 2] {
    let seeds = seeds();
    let mut random = Random::new(seed);
    let mut counts = [0; 2];
    for round in 0..rounds {
        let bytes = spoil(&mut random, &seeds);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let result = std::panic::catch_unwind(|| match read_toml("arm.toml", &text) {
            Ok(described) => {
                assert!(!described.warnings.has_errors());
                assert!(described.warnings.to_string().is_ascii() || !text.is_ascii());
                0
            }
            Err(found) => {
                assert!(found.has_errors());
                for diagnostic in found.iter() {
                    let labels = diagnostic.primary.iter().chain(&diagnostic.secondary);
                    for label in labels {
                        assert!(text.get(label.span.clone()).is_some(), "{diagnostic:?}");
                    }
                }
                assert!(found.to_string().ends_with('\n'));
                1
            }
        });
        match result {
            Ok(kind) => counts[kind] += 1,
            Err(_) => panic!("seed {seed}, round {round}:\n{text}"),
        }
    }
    counts
}

#[test]
fn spoilt_files_never_panic() {
    let rounds = match std::env::var("FUZZ_ROUNDS") {
        Ok(rounds) => rounds.parse().unwrap(),
        Err(_) => 2000,
    };
    let [right, wrong] = fuzz(20_261_121, rounds);
    // Both ways must be walked, or the test is none.
    assert!(right > rounds / 50 && wrong > rounds / 2, "{right} read, {wrong} refused");
}
