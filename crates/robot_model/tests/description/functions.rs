//! The functions of frames, and what is said about functions that a robot cannot have.

use robot_model::functions::{self, FrameRef, FunctionKind};
use robot_model::robot::{BaseFrames, Robot};

use crate::{arm, errors, read};

const LINK: &str = "\n[[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = AXIS }\nmass = 1\n\
     center_of_mass = [0.1, 0.2, 0.3]\ninertia = { xx = 0.2, yy = 0.3, zz = 0.4 }\n";

/// A robot of one link, with the given text after it.
fn robot(axis: &str, more: &str) -> Robot {
    read(&arm(&format!("{}{more}", LINK.replace("AXIS", axis)))).robot
}

#[test]
fn frames_have_functions_of_their_own_names() {
    let two = robot("\"z\"", "[[tip]]\nname = \"hand\"\n[[tip]]\nname = \"tool\"\n");
    assert_eq!(FrameRef::usual(&two), [FrameRef::Named(0), FrameRef::Named(1)]);
    let parts = FunctionKind::Jacobian.parts(&two);
    let names: Vec<String> = parts.iter().map(|part| part.full_name(&two)).collect();
    assert_eq!(names, ["jacobian_hand", "jacobian_tool"]);
    assert_eq!(functions::named(&two, "jacobian_tool"), Ok(parts[1]));
    let suffixes: Vec<String> = two.frames.iter().map(|tip| two.wrench_suffix(tip)).collect();
    assert_eq!(suffixes, ["_hand", "_tool"]);

    let one = robot("\"z\"", "[tip]\n");
    assert_eq!(FrameRef::usual(&one), [FrameRef::Named(0)]);
    assert_eq!(FunctionKind::Jacobian.parts(&one), []);
    assert_eq!(one.wrench_suffix(&one.frames[0]), "");

    let none = robot("\"z\"", "");
    assert_eq!(FrameRef::usual(&none), [FrameRef::Link(0)]);
}

#[test]
fn base_parameters_need_known_axes_in_their_own_frames_alone() {
    let parameters = "[parameters]\np = 0.5\n";
    let text =
        |more: &str| arm(&format!("{more}{parameters}{}", LINK.replace("AXIS", "[\"p\", 0, 1]")));
    let mut free = read(&text("")).robot;
    assert_eq!(functions::out_of_reach(&free), None);
    free.base_frames = BaseFrames::DenavitHartenberg;
    assert!(functions::out_of_reach(&free).unwrap().contains("a joint axis depends on parameters"));
}

#[test]
fn a_plan_is_recognized_by_its_two_keys() {
    let file =
        |keys: &str| errors(&format!("format = 2\n{keys}\n[robot]\nname = \"a\"\n")).to_string();
    assert!(file("fingerprint = \"a\"\ndigest = \"b\"").contains("this is a pinned plan"));
    for key in ["fingerprint", "digest"] {
        let one = file(&format!("{key} = \"a\""));
        assert!(!one.contains("pinned plan"), "{one}");
    }
}

#[test]
fn a_decimal_point_is_named_where_a_number_may_stand() {
    let found = errors("format = 1\n[robot]\nname = 1.5\n").to_string();
    assert!(found.contains("found a number\n"), "{found}");
    let found = errors("format = 1.0\n[robot]\nname = \"a\"\n").to_string();
    assert!(found.contains("found a number with a decimal point"), "{found}");
}
