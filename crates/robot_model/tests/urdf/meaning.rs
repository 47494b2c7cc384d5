//! The meaning of URDF files.

use robot_model::description::{Format, Options, read};
use robot_model::diagnostic::{Diagnostic, Diagnostics, code};
use robot_model::robot::{JointKind, Robot};
use robot_numeric::Mechanism;

use crate::text::{BODY, one_link};
use crate::{codes, difference, errors, read_taking};

fn torques(robot: &Robot, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
    let mechanism = Mechanism::nominal(robot).unwrap();
    mechanism.inverse_dynamics(q, qd, qdd).unwrap().iter().copied().collect()
}

fn has(found: &Diagnostics, code: &str, words: &str) -> bool {
    found.iter().any(|one| one.code == code && format!("{one:?}").contains(words))
}

/// A chain of three links, each with a mass of 1 kg at its origin and moments of inertia of 1 kg m².
fn chain(joints: [&str; 3]) -> String {
    let body = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
                iyz=\"0\" izz=\"1\"/></inertial>";
    let mut text = "<robot name=\"arm\"><link name=\"0\"/>".to_owned();
    for (index, joint) in joints.iter().enumerate() {
        let child = index + 1;
        text += &format!(
            "<link name=\"{child}\">{body}</link><joint name=\"j{child}\" {joint}\
             <parent link=\"{index}\"/><child link=\"{child}\"/></joint>"
        );
    }
    text + "</robot>"
}

#[test]
fn the_format_is_told_by_the_name_or_the_text() {
    let urdf = one_link(BODY, "<axis xyz=\"0 0 1\"/>");
    for name in ["a.urdf", "a.URDF", "a.xml", "folder.toml/a", "-"] {
        assert_eq!(read(name, &urdf).unwrap().format, Format::Urdf, "{name}");
    }
    let toml = "format = 1\n[robot]\nname = \"a\"\n[[link]]\nname = \"1\"\nmassless = true\n\
                joint = { type = \"revolute\", axis = \"z\" }\n";
    for name in ["a.toml", "a", "-"] {
        assert_eq!(read(name, toml).unwrap().format, Format::Toml, "{name}");
    }
    assert_eq!(codes(&read("a.urdf", toml).unwrap_err()), [code::SYNTAX]);
    assert_eq!(codes(&read("a.toml", &urdf).unwrap_err())[0], code::SYNTAX);
}

#[test]
fn joints_have_their_kinds() {
    let text = chain([
        "type=\"continuous\"><axis xyz=\"0 0 1\"/><limit lower=\"1\" upper=\"2\"/>",
        "type=\"revolute\"><axis xyz=\"0 0 1\"/><limit upper=\"2\" effort=\"nan\"/>",
        "type=\"prismatic\"><limit lower=\"-inf\" upper=\"inf\"/>",
    ]);
    let described = crate::read(&text);
    let robot = &described.robot;
    let kinds: Vec<_> = robot.coordinates.iter().map(|one| one.kind).collect();
    assert_eq!(kinds, [JointKind::Revolute, JointKind::Revolute, JointKind::Prismatic]);
    let limits: Vec<bool> = robot.coordinates.iter().map(|one| one.limits.is_some()).collect();
    assert_eq!(limits, [false, true, false]);
    // A prismatic joint without an axis moves along x.
    assert_eq!(
        robot.links[2].joint.axis.each_ref().map(|one| one.text().to_owned()),
        ["1", "0", "0"]
    );
    assert!(has(&described.choices, code::TAKEN_DEFAULT, "default is x"));
    assert!(has(&described.choices, code::TAKEN_COORDINATE, "without limits"));
    assert!(described.warnings.is_empty(), "{}", described.warnings);
}

/// An attribute with a prefix belongs to another program, and does not replace one without.
#[test]
fn attributes_with_a_prefix_are_not_read() {
    let plain = chain([r#"type="continuous"><axis xyz="0 0 1"/>"#; 3]);
    let mixed = plain
        .replacen("<robot ", r#"<robot xmlns:u="http://example.com/u" "#, 1)
        .replace("<mass ", r#"<mass u:value="7" "#)
        .replace("<axis ", r#"<axis u:xyz="0 1 0" "#)
        .replace(r#" type=""#, r#" u:type="prismatic" type=""#);
    assert!(mixed.contains("u:value") && mixed.contains("u:xyz") && mixed.contains("u:type"));
    let found = crate::read(&mixed);
    assert_eq!(difference(&found.robot, &crate::read(&plain).robot), 0.0);
    assert!(has(&found.warnings, "R0603", "`u:value` belongs to another program"));
    let without = mixed.replacen(r#"u:value="7" value"#, "u:value", 1);
    assert!(has(&errors(&without), "R0102", "`<mass>` has no `value`"), "{:?}", errors(&without));
}

/// A default namespace on an element has the meaning of a prefix; one on the root is that of the file.
#[test]
fn elements_of_another_namespace_are_not_read() {
    let plain = chain([r#"type="continuous"><axis xyz="0 0 1"/>"#; 3]);
    let foreign = r#"<mass xmlns="http://example.com/u" value="7"/>"#;
    let mixed = plain.replace("<mass ", &format!("{foreign}<mass "));
    let found = crate::read(&mixed);
    assert_eq!(difference(&found.robot, &crate::read(&plain).robot), 0.0);
    assert!(has(&found.warnings, "R0603", "`<mass>` is in another namespace"));
    let without = plain.replacen("<mass ", r#"<mass xmlns="http://example.com/u" "#, 1);
    assert!(has(&errors(&without), "R0102", "`<inertial>` has no `<mass>`"));
    let whole = plain.replacen("<robot ", r#"<robot xmlns="http://example.com/u" "#, 1);
    let found = crate::read(&whole);
    assert_eq!(difference(&found.robot, &crate::read(&plain).robot), 0.0);
    assert!(found.warnings.is_empty(), "{}", found.warnings);
}

/// URDF requires limits of revolute and prismatic joints; what is left out is noted.
#[test]
fn limits_that_are_left_out_are_noted() {
    for (limit, limits, note) in [
        ("", false, "has no `<limit>`, which URDF requires; it has no limits"),
        (r#"<limit effort="1"/>"#, false, "has neither a lower nor an upper limit"),
        (r#"<limit upper="1"/>"#, true, "has no lower limit; URDF's default is 0"),
        (r#"<limit lower="-1"/>"#, true, "has no upper limit; URDF's default is 0"),
        (r#"<limit lower="-1" upper="1"/>"#, true, ""),
        (r#"<limit lower="-inf" upper="inf"/>"#, false, ""),
    ] {
        let joint = |kind: &str| format!(r#"type="{kind}"><axis xyz="0 0 1"/>{limit}"#);
        for kind in ["revolute", "prismatic", "continuous"] {
            let found = crate::read(&chain([&*joint(kind); 3]));
            let is_noted = !note.is_empty() && kind != "continuous";
            assert_eq!(has(&found.choices, "R0704", note) && !note.is_empty(), is_noted, "{limit}");
            let has_limits = found.robot.coordinates[0].limits.is_some();
            assert_eq!(has_limits, limits && kind != "continuous", "{limit} {kind}");
        }
    }
}

#[test]
fn limits_that_are_no_range_name_the_remedy() {
    let of = |limit: &str| {
        chain([&*format!(r#"type="revolute"><axis xyz="0 0 1"/><limit {limit}/>"#); 3])
    };
    let half = crate::read(&of(r#"lower="-1" upper="inf""#));
    assert!(half.robot.coordinates[0].limits.is_none());
    assert!(
        has(&half.choices, "R0706", "one limit of the joint `j1` is infinite"),
        "{:?}",
        half.choices
    );
    for (limit, help) in [
        (r#"upper="-1""#, "add `lower`; URDF's default is 0"),
        (r#"lower="1""#, "add `upper`; URDF's default is 0"),
        (r#"lower="1" upper="-1""#, "swap them"),
    ] {
        assert!(has(&errors(&of(limit)), "R0404", help), "{limit}");
    }
    let equal = crate::read(&of(r#"lower="1" upper="1""#));
    assert!(equal.robot.coordinates[0].limits.is_none());
    let note = "the limits of joint `j1` leave no room to move and are ignored";
    assert!(has(&equal.choices, "R0706", note), "{:?}", equal.choices);
    let far = errors(&of(r#"lower="-1" upper="1e308""#));
    assert!(has(&far, "R0301", "a limit of `j1` contains a value of 1e308"), "{far}");
}

#[test]
fn floating_and_planar_joints_are_refused() {
    for (kind, words) in [
        ("floating", "the base frame is fixed"),
        ("planar", "prismatic"),
        ("ball", "three revolute"),
        ("revolve", "revolute"),
    ] {
        let text = one_link(BODY, "").replace("\"revolute\"", &format!("\"{kind}\""));
        let found = errors(&text);
        assert_eq!(codes(&found), [code::UNKNOWN_WORD], "{found}");
        assert!(found.to_string().contains(words), "{found}");
    }
}

#[test]
fn chains_of_joints_that_follow_are_folded() {
    // j2 = −3 j1 + 0.5, j3 = 2 j2 + 0.25 = −6 j1 + 1.25
    let text = chain([
        "type=\"revolute\"><axis xyz=\"0 0 1\"/>",
        "type=\"revolute\"><axis xyz=\"0 0 1\"/><mimic joint=\"j1\" multiplier=\"-3\" offset=\"0.5\"/>",
        "type=\"revolute\"><axis xyz=\"0 0 1\"/><mimic joint=\"j2\" multiplier=\"2\" offset=\"0.25\"/>",
    ]);
    let described = crate::read(&text);
    let robot = &described.robot;
    assert_eq!(robot.degrees_of_freedom(), 1);
    let last = &robot.links[2].joint;
    assert_eq!((last.ratio.text(), last.offset.text()), ("-6", "1.25"));
    // All axes are the same: the velocities are 1, 1 − 3 and 1 − 3 − 6, so the torque is 1 + 2² + 8².
    let found = torques(robot, &[0.3], &[0.2], &[1.0]);
    assert!((found[0] - 69.0).abs() < 1e-12, "{found:?}");
    assert!(has(&described.choices, code::TAKEN_COORDINATE, "not have a coordinate of its own"));
}

#[test]
fn friction_is_apart_unless_it_is_asked_for() {
    let joint = "<axis xyz=\"0 0 1\"/><dynamics damping=\"5\" friction=\"3\"/>";
    let text = one_link(BODY, joint);
    let described = crate::read(&text);
    assert!(!described.robot.has_friction());
    assert!(has(&described.choices, code::LEFT_OUT, "damping 5, friction 3"));
    let options = Options { friction: true, ..Options::default() };
    let friction = read_taking(&text, &options).robot.links[0].friction.clone();
    let attributes = [&friction.viscous, &friction.coulomb_positive, &friction.coulomb_negative];
    assert_eq!(attributes.map(|formula| formula.text().to_owned()), ["5", "3", "3"]);
    // Either attribute alone is also friction.
    for (attributes, expected) in [("damping=\"5\"", ["5", "0"]), ("friction=\"3\"", ["0", "3"])] {
        let joint = format!("<axis xyz=\"0 0 1\"/><dynamics {attributes}/>");
        let described = read_taking(&one_link(BODY, &joint), &options);
        let friction = &described.robot.links[0].friction;
        let found = [&friction.viscous, &friction.coulomb_positive];
        assert_eq!(found.map(|formula| formula.text().to_owned()), expected);
    }
}

#[test]
fn names_become_names_of_robot_files() {
    let text = one_link(BODY, "<axis xyz=\"0 0 1\"/>")
        .replace("link=\"ground\"", "link=\"the base/1\"")
        .replace("<link name=\"ground\"", "<link name=\"the base/1\"")
        .replace("<robot name=\"arm\"", "<robot name=\"7-arm\"")
        .replace("joint name=\"joint\"", "joint name=\"-é\"");
    let described = crate::read(&text);
    assert_eq!(described.robot.name, "robot_7_arm");
    assert_eq!(described.robot.frames[0].name, "the_base_1");
    assert_eq!(described.robot.coordinates[0].joint, "_-_");
    let renamed = described.choices.iter().filter(|one| one.code == code::TAKEN_NAME).count();
    assert_eq!(renamed, 3, "{}", described.choices);
    for (written, name) in [("tau", "tau_robot"), ("fn", "fn")] {
        let robot = format!("robot name=\"{written}\"");
        let text = one_link(BODY, "").replace("robot name=\"arm\"", &robot);
        assert_eq!(crate::read(&text).robot.name, name);
    }
    // Two names that become equal are refused, and so is a name with an invisible character.
    let text = one_link(BODY, "").replace("ground", "a b").replace("\"arm\"", "\"a/b\"");
    assert_eq!(codes(&errors(&text)), [code::DUPLICATE]);
    let text = one_link(BODY, "").replace("ground", "a\u{202e}b");
    assert_eq!(codes(&errors(&text)), [code::NAME]);
}

#[test]
fn a_base_may_have_the_name_base() {
    let text = one_link(BODY, "").replace("ground", "base");
    let described = crate::read(&text);
    assert!(described.robot.frames.is_empty());
    assert!(!has(&described.choices, code::TAKEN_NAME, ""));
    // A fixed link named `base` on another base link is an ordinary link.
    let text = text
        .replace("<robot name=\"arm\">", "<robot name=\"arm\"><link name=\"world\"/>")
        .replace(
            "</robot>",
            "<joint name=\"j\" type=\"fixed\"><parent link=\"world\"/><child link=\"base\"/></joint></robot>",
        );
    let described = crate::read(&text);
    let names: Vec<_> = described.robot.frames.iter().map(|frame| frame.name.as_str()).collect();
    assert_eq!(names, ["world", "base_frame"]);
}

#[test]
fn massless_links_need_a_waiver() {
    let zero = BODY
        .replace("\"2\"", "\"0\"")
        .replace("0.02", "0")
        .replace("0.03", "0")
        .replace("0.04", "0");
    let waiver = Options { allow_massless: true, ..Options::default() };
    for (body, axis) in [("", "1 0 0"), (&zero, "1 0 0"), ("", "0 0 1"), (&zero, "0 0 1")] {
        let text = one_link(body, &format!("<axis xyz=\"{axis}\"/>"));
        assert_eq!(codes(&errors(&text)), [code::MASS], "{body}, {axis}");
        let described = read_taking(&text, &waiver);
        assert_eq!(codes(&described.warnings), [code::MASS]);
        assert!(described.robot.links[0].bodies.is_empty());
    }
    // A mass that is fixed to the link moves with it.
    let text = one_link("", "<axis xyz=\"0 0 1\"/>").replace(
        "</robot>",
        &format!(
            "<link name=\"tool\">{BODY}</link><joint name=\"j\" type=\"fixed\"><parent link=\"arm\"/>\
             <child link=\"tool\"/></joint></robot>"
        ),
    );
    assert_eq!(torques(&crate::read(&text).robot, &[0.0], &[0.0], &[1.0]), [0.04]);
}

#[test]
fn a_moment_alone_is_enough_about_a_vertical_axis_on_the_base() {
    let body = |attributes: &str| {
        format!(
            "<inertial><mass value=\"0\"/><inertia {attributes} ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
        )
    };
    let about_z = body("ixx=\"0\" iyy=\"0\" izz=\"0.35\"");
    let described = crate::read(&one_link(&about_z, "<axis xyz=\"0 0 1\"/>"));
    assert_eq!(codes(&described.warnings), [code::MASS]);
    assert_eq!(torques(&described.robot, &[0.0], &[0.0], &[2.0]), [0.7]);
    // If the joint axis is not vertical, or other moments are given, the same values are impossible.
    for (attributes, axis) in [
        ("ixx=\"0.35\" iyy=\"0\" izz=\"0\"", "1 0 0"),
        ("ixx=\"0.1\" iyy=\"0\" izz=\"0.35\"", "0 0 1"),
        ("ixx=\"0.000001\" iyy=\"0\" izz=\"0.35\"", "0 0 1"),
    ] {
        let text = one_link(&body(attributes), &format!("<axis xyz=\"{axis}\"/>"));
        assert_eq!(codes(&errors(&text))[0], code::MASS, "{attributes}");
    }
}

#[test]
fn triangle_inequalities_are_graded() {
    let text = |izz: &str| one_link(&BODY.replace("0.04", izz), "<axis xyz=\"1 0 0\"/>");
    assert!(crate::read(&text("0.05")).warnings.is_empty());
    let described = crate::read(&text("0.0555"));
    assert_eq!(codes(&described.warnings), [code::INERTIA_TRIANGLE]);
    assert_eq!(codes(&errors(&text("0.056"))), [code::INERTIA_TRIANGLE]);
    let waiver = Options { allow_unphysical: true, ..Options::default() };
    assert_eq!(codes(&read_taking(&text("0.5"), &waiver).warnings), [code::INERTIA_TRIANGLE]);
    assert_eq!(codes(&errors(&text("-0.04"))), [code::INERTIA_SIGN]);
}

#[test]
fn places_point_at_the_text() {
    let text = one_link(BODY, "<axis xyz=\"0  0 1\"/><limit lower=\"0\" upper=\"1\"/>");
    let locations = crate::read(&text).locations;
    let shown = |span: &std::ops::Range<usize>| &text[span.clone()];
    assert_eq!(shown(&locations.name), "arm");
    let link = &locations.links[0];
    assert_eq!(shown(&link.name), "arm");
    assert_eq!(shown(&link.joint), "<joint");
    assert_eq!(shown(link.parent.as_ref().unwrap()), "ground");
    assert_eq!(shown(link.axis.as_ref().unwrap()), "0  0 1");
    assert_eq!(shown(link.limits.as_ref().unwrap()), "<limit lower=\"0\" upper=\"1\"/>");
    assert_eq!(shown(link.bodies[0].mass.as_ref().unwrap()), "2");
    assert_eq!(shown(link.bodies[0].center_of_mass.as_ref().unwrap()), "0 0 0.1");
    assert!(shown(link.bodies[0].inertia.as_ref().unwrap()).starts_with("<inertia ixx"));
}

/// Content that acts on the dynamics and is not read is counted, wherever it stands; other content is not.
#[test]
fn what_a_simulator_adds_is_counted() {
    let transmission = |what: &str| {
        format!("<transmission name=\"t\"><actuator name=\"m\">{what}</actuator></transmission>")
    };
    let (gear, plain) = (
        transmission("<mechanicalReduction> 50 </mechanicalReduction>"),
        transmission("<mechanicalReduction>1</mechanicalReduction>"),
    );
    let (off, on) = (
        "<gazebo><turnGravityOff>true</turnGravityOff></gazebo>",
        "<gazebo><turnGravityOff>false</turnGravityOff></gazebo>",
    );
    let spring = "<gazebo><springStiffness>3</springStiffness></gazebo>";
    let cases = [
        (String::new(), vec![]),
        (format!("{plain}{on}"), vec![]),
        (gear.clone(), vec!["the drives of 1 transmission"]),
        (format!("{gear}{plain}{gear}"), vec!["the drives of 2 transmissions"]),
        (off.to_owned(), vec!["gravity, springs or damping of 1 Gazebo element"]),
        (format!("{off}{on}{spring}"), vec!["gravity, springs or damping of 2 Gazebo elements"]),
        (
            format!("{gear}{off}"),
            vec!["the drives of 1 transmission", "gravity, springs or damping of 1 Gazebo element"],
        ),
    ];
    let urdf = one_link(BODY, "<axis xyz=\"0 0 1\"/>");
    for (added, told) in cases {
        let described = crate::read(&urdf.replace("</robot>", &format!("{added}</robot>")));
        assert_eq!(described.left_out, told, "{added}");
        let is_told = |one: &&Diagnostic| one.message.contains("not part of the robot");
        let notes = described.choices.iter().filter(is_told).count();
        assert_eq!(notes, told.len(), "{added}: {}", described.choices);
    }
    // Within links and joints, too.
    let within = urdf
        .replace("</link>", &format!("{off}</link>"))
        .replace("</joint>", &format!("{spring}</joint>"));
    assert_eq!(crate::read(&within).left_out, ["gravity, springs or damping of 2 Gazebo elements"]);
    // Limits of forces and velocities are counted by kind.
    let limits = |limit: &str| format!("type=\"continuous\"><axis xyz=\"0 0 1\"/>{limit}");
    let both = "<limit effort=\"5\" velocity=\"2\"/>";
    let joints = [limits(both), limits(""), limits("<limit effort=\"5\"/>")];
    let described = crate::read(&chain(joints.each_ref().map(String::as_str)));
    for message in [
        "2 joints: `effort` of `<limit>` is ignored",
        "1 joint: `velocity` of `<limit>` is ignored",
    ] {
        assert!(has(&described.choices, code::LEFT_OUT, message), "{}", described.choices);
    }
    let range = "type=\"revolute\"><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\"/>";
    let follower = format!("{range}<mimic joint=\"j1\"/>");
    let described = crate::read(&chain([range, &follower, range]));
    for message in ["1 joint: `lower` of", "1 joint: `upper` of"] {
        let is_noted = |one: &&Diagnostic| one.message.starts_with(message);
        assert_eq!(described.choices.iter().filter(is_noted).count(), 1, "{}", described.choices);
    }
}
