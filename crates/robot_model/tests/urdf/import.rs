//! The robot files that import writes.

use robot_model::description::{Options, import, read_toml};
use robot_model::robot::Robot;

use crate::text::BODY;

fn toml(text: &str, options: &Options) -> String {
    import("folder/my arm.urdf", text, options).unwrap_or_else(|found| panic!("{found}")).toml
}

fn two_links() -> String {
    format!(
        "<robot name=\"2-arms\">\n<link name=\"base\"/>\n<link name=\"upper arm\">{BODY}</link>\n\
         <link name=\"tool\"/>\n<link name=\"slide\">{BODY}</link>\n\
         <joint name=\"shoulder\" type=\"revolute\"><parent link=\"base\"/><child link=\"upper arm\"/>\
         <origin rpy=\"1.5707963267948966 0 0\"/><axis xyz=\"0 -2 0\"/>\
         <limit lower=\"-1\" upper=\"2.50\"/><dynamics damping=\"0.5\" friction=\"0.25\"/></joint>\n\
         <joint name=\"tool\" type=\"fixed\"><parent link=\"upper arm\"/><child link=\"tool\"/>\
         <origin xyz=\"0 0 1e-7\"/></joint>\n\
         <joint name=\"slide\" type=\"prismatic\"><parent link=\"upper arm\"/><child link=\"slide\"/>\
         <axis xyz=\"0.6 0 0.8\"/><mimic joint=\"shoulder\" multiplier=\"-0.1\" offset=\"0.2\"/></joint>\n\
         </robot>\n"
    )
}

const EXPECTED: &str = r#"# Imported from my arm.urdf.
format = 1

[robot]
name = "robot_2_arms"
gravity = [0, 0, -9.81]

[[link]]
name = "upper_arm"
joint = { name = "shoulder", type = "revolute", axis = "-y", limits = [-1, 2.5] }
origin = { rpy = ["pi/2", 0, 0] }
mass = 2
center_of_mass = [0, 0, 0.1]
inertia = { xx = 0.02, yy = 0.03, zz = 0.04 }
# friction = { viscous = 0.5, coulomb_torque = 0.25 }   # in the source, but not included in the torques

[[link]]
name = "tool"
joint = { type = "fixed" }
origin = { xyz = [0, 0, 1e-7] }

[[link]]
name = "slide"
parent = "upper_arm"
joint = { type = "prismatic", axis = [0.6, 0, 0.8], mimic = { joint = "shoulder", ratio = -0.1, offset = 0.2 } }
mass = 2
center_of_mass = [0, 0, 0.1]
inertia = { xx = 0.02, yy = 0.03, zz = 0.04 }
"#;

#[test]
fn a_robot_file_with_the_names_and_figures_of_the_source() {
    let text = toml(&two_links(), &Options::default());
    assert_eq!(text, EXPECTED);
    let described = read_toml("arm.toml", &text).unwrap_or_else(|found| panic!("{found}"));
    assert!(described.warnings.is_empty(), "{}", described.warnings);
    let with = Options { friction: true, ..Options::default() };
    let live = "\nfriction = { viscous = 0.5, coulomb_torque = 0.25 }\n";
    assert!(toml(&two_links(), &with).contains(live));
}

#[test]
fn waivers_are_written_where_they_are_needed() {
    let text = two_links()
        .replacen("<mass value=\"2\"/>", "<mass value=\"0\"/>", 1)
        .replace("izz=\"0.04\"", "izz=\"0.09\"");
    let options = Options { allow_massless: true, allow_unphysical: true, ..Options::default() };
    let text = toml(&text, &options);
    assert!(text.contains("massless = true\ncenter_of_mass = [0, 0, 0.1]\n"), "{text}");
    assert_eq!(text.matches("unchecked = true").count(), 2, "{text}");
    read_toml("arm.toml", &text).unwrap_or_else(|found| panic!("{found}"));
}

#[test]
fn masses_on_the_base_are_left_out() {
    let text = two_links()
        .replace("<link name=\"base\"/>", &format!("<link name=\"ground\">{BODY}</link>"))
        .replace("link=\"base\"", "link=\"ground\"");
    let text = toml(&text, &Options::default());
    assert!(
        text.contains("[[link]]\nname = \"ground\"\njoint = { type = \"fixed\" }\n\n"),
        "{text}"
    );
    let described = read_toml("arm.toml", &text).unwrap_or_else(|found| panic!("{found}"));
    assert!(described.warnings.is_empty(), "{}", described.warnings);
}

/// Of several limbs each begins at the base, and each link stands on the one that it stands on in the source.
#[test]
fn limbs_begin_where_they_begin_in_the_source() {
    let joints = [("base", "a"), ("a", "b"), ("base", "c"), ("c", "d"), ("a", "e")];
    let links = joints.map(|(_, child)| format!("<link name=\"{child}\">{BODY}</link>")).concat();
    let joints = joints.map(|(parent, child)| {
        format!(
            "<joint name=\"to_{child}\" type=\"continuous\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <axis xyz=\"0 1 0\"/></joint>"
        )
    });
    let source =
        format!("<robot name=\"limbs\"><link name=\"base\"/>{links}{}</robot>", joints.concat());
    let robot = crate::read(&source).robot;
    let text = toml(&source, &Options::default());
    let imported = read_toml("limbs.toml", &text).unwrap_or_else(|found| panic!("{found}")).robot;
    let parents = |robot: &Robot| -> Vec<(String, Option<String>)> {
        let name = |index: usize| robot.links[index].name.clone();
        let links = robot.links.iter().map(|link| (link.name.clone(), link.parent.map(name)));
        links.collect()
    };
    assert_eq!(parents(&imported), parents(&robot));
    assert_eq!(parents(&robot).iter().filter(|(_, parent)| parent.is_none()).count(), 2);
}
