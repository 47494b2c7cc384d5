//! Any text as a name or a LaTeX symbol: accepted texts can be printed and compiled, and cannot do anything else.
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_codegen::backend::rust;
use robot_document::latex::formula;
use robot_document::math::Math;
use robot_model::description::{read_toml, read_urdf};
use robot_model::signs::check_latex;

fuzz_target!(|text: &str| {
    if check_latex(text).is_ok() {
        robot_fuzz::harmless_latex(text);
    }
    let (latex, name) = text.split_once('\n').unwrap_or((text, text));
    robot_fuzz::harmless_latex(&formula(&Math::spelled(name)));
    if robot_fuzz::chosen(text.as_bytes(), 4) {
        in_toml(name, latex);
    } else if robot_fuzz::chosen(format!("{text}\n").as_bytes(), 4) {
        in_urdf(name);
    }
});

/// Uses the text as the name of a parameter and a link, with the LaTeX of the parameter.
fn in_toml(name: &str, latex: &str) {
    let (quoted, latex) = (quoted(name), quoted(latex));
    let file = format!(
        "format = 1\n[robot]\nname = \"a\"\ndescription = {quoted}\n[parameters]\n\
         {quoted} = {{ value = 1, latex = {latex}, doc = {quoted} }}\n[[link]]\nname = {quoted}\n\
         joint = {{ type = \"revolute\", axis = \"z\" }}\nmass = {quoted}\ncenter_of_mass = [0.1, 0, 0]\n\
         inertia = {{ xx = 1, yy = 1, zz = 1 }}\n[[frame]]\nname = \"f\"\n"
    );
    match read_toml("name.toml", &file) {
        Ok(described) => {
            let parameter = &described.robot.parameters[0];
            identifier(&parameter.name);
            parameter.latex.iter().for_each(|latex| robot_fuzz::harmless_latex(latex));
            robot_fuzz::harmless_latex(&formula(&Math::spelled(&parameter.name)));
            robot_fuzz::follow(&file, &described);
        }
        Err(found) => robot_fuzz::show(&found),
    }
}

/// Uses the text as the name of a robot, a link and a joint of URDF.
fn in_urdf(name: &str) {
    let escaped: String = name.chars().map(|letter| format!("&#{};", letter as u32)).collect();
    let file = format!(
        "<robot name=\"{escaped}\"><link name=\"{escaped}0\"/><link name=\"{escaped}\"><inertial>\
         <mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\
         <joint name=\"{escaped}\" type=\"continuous\"><parent link=\"{escaped}0\"/>\
         <child link=\"{escaped}\"/></joint></robot>"
    );
    match read_urdf("name.urdf", &file) {
        Ok(described) => {
            identifier(&described.robot.name);
            let link = &described.robot.links[0].name;
            assert!(
                link.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte))
            );
            robot_fuzz::imports("name.urdf", &file, &described);
        }
        Err(found) => robot_fuzz::show(&found),
    }
}

fn identifier(name: &str) {
    assert!(name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_'), "{name:?}");
    assert!(!rust::identifier(name).is_empty());
}

/// The text as a basic string of TOML.
fn quoted(text: &str) -> String {
    let letters = text.chars().map(|letter| match letter {
        '"' | '\\' => format!("\\{letter}"),
        letter if letter.is_control() => format!("\\u{:04X}", letter as u32),
        letter => letter.to_string(),
    });
    format!("\"{}\"", letters.collect::<String>())
}
