//! Malicious and randomly corrupted files: each must cause a message within a short time.

use robot_model::description::{MAX_BYTES, decode, read_toml};
use robot_model::diagnostic::code;

use crate::hostility::{Spoiler, files, rounds, soon};
use crate::{arm, errors, read};

const LINK: &str = "
[[link]]
name = \"1\"
joint = { type = \"revolute\", axis = \"z\" }
massless = true
";

/// The codes of the errors of a file, which must be found within a short time.
fn codes(text: &str) -> Vec<&'static str> {
    soon(|| errors(text))
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
fn a_great_many_misspelled_names_end_in_a_message() {
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

/// Fragments that have a meaning in some context.
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

#[test]
fn spoiled_files_never_panic() {
    let groups = vec![files("../../robots", "toml"), files("tests/broken", "toml")];
    let spoiler = Spoiler { groups, pieces: PIECES };
    let rounds = rounds(2000);
    let read = |text: &str| read_toml("arm.toml", text);
    let [right, wrong] = spoiler.run(20_261_121, rounds, read, |text, described| {
        assert!(described.warnings.to_string().is_ascii() || !text.is_ascii());
    });
    // Both outcomes must occur often enough for the test to be meaningful.
    assert!(right > rounds / 50 && wrong > rounds / 2, "{right} read, {wrong} refused");
}
