//! Tables of documents give all that the equations depend on.
#![allow(clippy::unwrap_used, reason = "a test that fails panics")]

use robot_document::latex::Layout;
use robot_document::{EquationOptions, Form, Trigonometry, markdown, robot};
use robot_model::description::read_toml;

fn shown(text: &str) -> String {
    let model = read_toml("arm", text).unwrap().robot;
    let options = EquationOptions::default();
    let document = robot::document(&model, &options, &[Form::Grouped], Default::default()).unwrap();
    markdown::document(&document, Layout::of_centimeters(15.0)).unwrap()
}

fn link(name: &str, joint: &str, drive: &str) -> String {
    format!(
        "[[link]]\nname = \"{name}\"\njoint = {{ {joint} }}\norigin = {{ xyz = [0.4, 0, 0] }}\nmass = 1\n\
         center_of_mass = [0.1, 0, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n{drive}\n"
    )
}

fn arm(links: &[String]) -> String {
    format!("format = 1\n[robot]\nname = \"arm\"\n{}", links.concat())
}

#[test]
fn joints_that_mimic_others_have_their_positions() {
    let first = link("a", "type = \"revolute\", axis = \"z\"", "");
    let mimic = |mimic: &str| {
        link(
            "b",
            &format!("type = \"revolute\", axis = \"z\", mimic = {{ joint = \"a\"{mimic} }}"),
            "",
        )
    };
    let of = |more: &str| shown(&arm(&[first.clone(), mimic(more)]));
    assert!(of(", ratio = -2, offset = 0.3").contains("-2 q_1 + 0.3"));
    assert!(of(", ratio = -1").contains("$-q_1$"));
    assert!(of(", offset = -0.5").contains("q_1 - 0.5"));
    assert!(of("").contains("$q_1$"));
    let note = "the position in the table of links takes the place of the coordinate";
    assert!(of(", ratio = -1").contains(note));
    assert!(!shown(&arm(&[first])).contains(note));
}

#[test]
fn the_wrench_of_a_tip_is_explained_if_there_is_one() {
    let arm = arm(&[link("a", "type = \"revolute\", axis = \"z\"", "")]);
    let tip = "[tip]\nname = \"hand\"\nparent = \"a\"\n\
               wrench = { force = [\"Fx\", \"Fy\", \"Fz\"], moment = [\"Mx\", \"My\", \"Mz\"] }\n";
    let sentence = "The wrench of a tip is the wrench that the tip";
    assert!(!shown(&arm).contains(sentence));
    assert!(shown(&format!("{arm}{tip}")).contains(sentence));
}

#[test]
fn short_sines_are_explained() {
    let of = |trigonometry, kind: &str| {
        let text = arm(&[link("a", &format!("type = \"{kind}\", axis = \"z\""), "")]);
        let model = read_toml("arm", &text).unwrap().robot;
        let options = EquationOptions { trigonometry, ..EquationOptions::default() };
        let forms = [Form::Grouped];
        let document = robot::document(&model, &options, &forms, Default::default()).unwrap();
        markdown::document(&document, Layout::of_centimeters(15.0)).unwrap()
    };
    let sentence = "are the sine and the cosine of $q_i$";
    let short = of(Trigonometry::Short, "revolute");
    assert!(short.contains(&format!("$s_i$ and $c_i$ {sentence}; $s_{{ij}}$ is the")), "{short}");
    let paper = of(Trigonometry::Paper, "revolute");
    assert!(paper.contains(&format!("$sq_i$ and $cq_i$ {sentence}.")), "{paper}");
    assert!(!of(Trigonometry::Named, "revolute").contains(sentence));
    assert!(!of(Trigonometry::Short, "prismatic").contains(sentence));
}

#[test]
fn drives_have_a_table() {
    let with = |drives: [&str; 2]| {
        let [a, b] = drives;
        shown(&arm(&[
            link("a", "type = \"revolute\", axis = \"z\"", a),
            link("b", "type = \"prismatic\", axis = \"x\"", b),
        ]))
    };
    assert!(!with(["", ""]).contains("Drives"));
    let armature = with(["drive = { armature = 0.7 }", ""]);
    assert!(armature.contains("the armature is the inertia at the joint"), "{armature}");
    assert!(armature.contains("0.7") && !armature.contains("Gear ratio"), "{armature}");
    let both =
        with(["drive = { rotor_inertia = 0.003, gear_ratio = -80 }", "drive = { armature = 0.7 }"]);
    for part in ["Armature", "Rotor inertia", "Gear ratio", "-80", "0.003", "0.7"] {
        assert!(both.contains(part), "{part}: {both}");
    }
    let gyroscopic =
        with(["", "drive = { rotor_inertia = 0.003, gear_ratio = 80, gyroscopic = true }"]);
    assert!(gyroscopic.contains("The rotor of b also reacts"), "{gyroscopic}");
}
