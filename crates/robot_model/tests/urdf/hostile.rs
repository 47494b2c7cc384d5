//! Malicious and randomly corrupted files: each must cause a message within a short time.

use robot_model::description::{MAX_BYTES, Options, import, read_urdf};
use robot_model::diagnostic::code;

use crate::errors;
use crate::hostility::{self, Spoiler};
use crate::text::{BODY, one_link};

/// The codes of the errors of a file, which must be found within a short time.
fn soon(text: &str) -> Vec<&'static str> {
    hostility::soon(|| errors(text))
}

#[test]
fn elements_nested_deep_end_in_a_message() {
    let deep = "<link>".repeat(100_000);
    let closed = "</link>".repeat(100_000 - 60_000);
    for text in [
        format!("<robot>{deep}"),
        format!("<robot>{}{closed}</robot>", "<link>".repeat(40_000)),
        "<a x='>'>".repeat(100_000),
        "<!--".repeat(100_000) + &"<a>".repeat(10_000),
    ] {
        let found = soon(&text);
        assert!(found == [code::LIMIT] || found == [code::SYNTAX], "{found:?}");
    }
}

#[test]
fn a_great_many_attributes_and_namespaces_end_in_a_message() {
    let attributes: String = (0..70_000).map(|i| format!(" a{i}=\">\"")).collect();
    assert_eq!(soon(&format!("<robot{attributes}/>")), [code::LIMIT]);
    let namespaces: String = (0..30_000).map(|i| format!("<a xmlns:n{i}='u'>")).collect();
    assert_eq!(soon(&namespaces), [code::LIMIT]);
}

#[test]
fn huge_counts_end_in_a_message() {
    let links: String = (0..600).map(|i| format!("<link name=\"{i}\"/>")).collect();
    assert_eq!(soon(&format!("<robot name=\"a\">{links}</robot>")), [code::LIMIT]);
    let junk = "<jnk a=\"1\"/>".repeat(80_000);
    let text =
        one_link(BODY, "<axis xyz=\"0 0 0\"/>").replace("</robot>", &format!("{junk}</robot>"));
    assert!(soon(&text).contains(&code::ZERO_AXIS));
    let numbers = "1 ".repeat(400_000);
    assert_eq!(soon(&one_link(BODY, &format!("<axis xyz=\"{numbers}\"/>"))), [code::WRONG_COUNT]);
    let digits = "9".repeat(900_000);
    assert_eq!(soon(&one_link(BODY, &format!("<axis xyz=\"0 0 {digits}\"/>"))), [code::NUMBER]);
    let name = "x".repeat(400_000);
    assert!(soon(&one_link(BODY, "").replace("ground", &name)).contains(&code::NAME));
    let text = one_link(BODY, "") + &" ".repeat(MAX_BYTES);
    assert_eq!(soon(&text), [code::TOO_LARGE]);
}

#[test]
fn a_robot_of_many_joints_is_read_or_refused() {
    let chain = |joints: usize| {
        let mut text = "<robot name=\"a\"><link name=\"0\"/>".to_owned();
        for child in 1..=joints {
            let parent = child - 1;
            text += &format!(
                "<link name=\"{child}\">{BODY}</link><joint name=\"j{child}\" type=\"continuous\">\
                 <parent link=\"{parent}\"/><child link=\"{child}\"/><axis xyz=\"0 0 1\"/></joint>"
            );
        }
        text + "</robot>"
    };
    assert_eq!(crate::read(&chain(64)).robot.degrees_of_freedom(), 64);
    assert_eq!(soon(&chain(65)), [code::LIMIT]);
}

#[test]
fn documents_of_other_kinds_are_told() {
    let doctype = "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name=\"&a;\"/>";
    assert_eq!(soon(doctype), [code::SYNTAX]);
    assert_eq!(soon("<sdf version='1.6'/>"), [code::FORMAT]);
    assert_eq!(soon("<robt name='a'/>"), [code::UNKNOWN_KEY]);
    assert_eq!(soon(""), [code::SYNTAX]);
    let template = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"a\"><xacro:include filename=\"/etc/passwd\"/></robot>";
    assert!(soon(template).contains(&code::XACRO));
    assert_eq!(soon("<robot name=\"a\"><xacro:macro/></robot>"), [code::XACRO]);
    assert_eq!(soon(&one_link(BODY, "<axis xyz=\"0 0 ${x}\"/>")), [code::XACRO]);
    let used =
        one_link(BODY, "").replace("<robot", "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\"");
    crate::read(&used);
}

#[test]
fn hostile_names_stay_text() {
    for name in [
        "b}fn x(){}",
        "\\input{/etc/passwd}",
        "*/ panic!() /*",
        "&lt;script&gt;",
        "../../x",
        "a&#10;b",
    ] {
        let described = crate::read(&one_link(BODY, "").replace("ground", name));
        let frame = &described.robot.frames[0].name;
        assert!(
            frame.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte)),
            "{frame}"
        );
    }
}

/// Fragments that have a meaning in some context.
const PIECES: &[&str] = &[
    "<",
    ">",
    "/>",
    "</",
    "\"",
    "'",
    "=",
    "&",
    ";",
    "&amp;",
    "&#0;",
    "&#x202e;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?xml?>",
    " ",
    "\n",
    "nan",
    "-inf",
    "1e309",
    "1e-400",
    "0,5",
    "-1",
    "0",
    "1e400",
    "${x}",
    "é",
    "\u{202e}",
    "\u{0}",
    "\u{feff}",
    "<link name=\"a\"/>",
    "<origin/>",
    "<inertial>",
    "</inertial>",
    "<mimic joint=\"joint\"/>",
    "type=\"fixed\"",
    "xmlns=\"u\"",
    "<xacro:a/>",
    "link=\"arm\"",
];

#[test]
fn spoiled_files_end_in_a_robot_or_a_message() {
    let joint = "<axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"1\"/><dynamics damping=\"1\"/>";
    let sound = one_link(BODY, joint).into_bytes();
    let groups = vec![vec![sound], hostility::files("tests/broken", "urdf")];
    let spoiler = Spoiler { groups, pieces: PIECES };
    let rounds = hostility::rounds(20_000);
    let read = |text: &str| read_urdf("arm.urdf", text);
    let [right, wrong] = spoiler.run(20, rounds, read, |text, described| {
        let import = import("arm.urdf", text, &Options::default()).unwrap();
        let again = robot_model::description::read_toml("arm.toml", &import.toml)
            .unwrap_or_else(|found| panic!("{}\n{found}", import.toml));
        assert_eq!(again.robot.degrees_of_freedom(), described.robot.degrees_of_freedom());
    });
    assert!(right > rounds / 100 && wrong > rounds / 2, "{right} read, {wrong} refused");
}
