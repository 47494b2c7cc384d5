//! The meaning of valid files.

use robot_model::description::{Budget, Code, Limit, MAX_BUNDLES, check_bundle_name};
use robot_model::diagnostic::code;
use robot_model::functions::{self, FrameRef, FunctionKind, Functions};
use robot_model::robot::{BaseFrames, JointKind, Move, Robot, Wrench};
use robot_model::variable::{JointVariable, Variable};
use robot_numeric::Mechanism;
use robot_numeric::random::Random;
use robot_symbolic::{Formula, Rational};

use crate::{arm, errors, read};

fn link(name: &str, more: &str) -> String {
    format!(
        "\n[[link]]\nname = \"{name}\"\nmass = 1\ncenter_of_mass = [0.1, 0.2, 0.3]\n\
         inertia = {{ xx = 0.2, yy = 0.3, zz = 0.4, xy = 0.01 }}\n{more}\n"
    )
}

fn revolute(name: &str, more: &str) -> String {
    link(name, &format!("joint = {{ type = \"revolute\", axis = \"z\" }}\n{more}"))
}

fn names(robot: &Robot) -> Vec<&str> {
    robot.links.iter().map(|link| link.name.as_str()).collect()
}

#[test]
fn numbers_are_exact_and_expressions_are_kept() {
    let text = "[parameters]\na = 0.1\nb = { value = 1_000.5e-3, unit = \"N m s\" }\nc = {}\n";
    let more = "origin = { xyz = [0.3, \"a/3 + c\", 0x10] }\nfriction = { viscous = \"b\" }";
    let robot = read(&arm(&format!("{text}{}", revolute("1", more)))).robot;
    let value = |name: &str| robot.parameter(name).unwrap().value.clone();
    assert_eq!(value("a"), Rational::new(1, 10));
    assert_eq!(value("b"), Rational::new(2001, 2000));
    assert_eq!(value("c"), None);
    let [Move::Translate([x, y, z])] = robot.links[0].placement.0.as_slice() else {
        panic!("{:?}", robot.links[0].placement);
    };
    assert_eq!(*x, Formula::parse("0.3").unwrap());
    assert_eq!(y.text(), "a/3 + c");
    assert_eq!(*z, Formula::number(&Rational::integer(16)));
    assert_eq!(robot.links[0].friction.viscous, Formula::symbol("b"));
    assert_eq!(robot.gravity[2], Formula::parse("-9.81").unwrap());
}

#[test]
fn terms_of_one_dimension_can_be_added() {
    let parameters =
        "[parameters]\na = { value = 2, unit = \"m\" }\nb = { value = 0.5, unit = \"m\" }\n";
    let link = revolute("1", "origin = { xyz = [\"a + b\", \"2*a - b/3\", 0] }");
    assert!(read(&arm(&format!("{parameters}{link}"))).warnings.is_empty());
}

#[test]
fn a_tensor_is_about_the_center_of_mass_if_nothing_is_said() {
    let plain = revolute("1", "");
    let stated = plain.replace("xy = 0.01", "xy = 0.01, about = \"center_of_mass\"");
    let link = |text: &str| read(&arm(text)).robot.links[0].clone();
    assert_ne!(plain, stated);
    assert_eq!(link(&plain), link(&stated));
}

#[test]
fn a_root_has_half_the_dimension() {
    let text = |mass: &str, gravity: &str| {
        let parameters = "[parameters]\na = { value = 2, unit = \"kg\" }\n\
             b = { value = 0.5, unit = \"m\" }\ng = { value = 9.81, unit = \"m/s^2\" }\n";
        let link = revolute("1", "origin = { xyz = [\"b\", \"sqrt(b^2)\", 0] }");
        let link = link.replace("mass = 1", &format!("mass = \"{mass}\""));
        let robot = arm(&format!("{parameters}{link}"));
        robot.replacen("[robot]", &format!("[robot]\ngravity = [0, 0, \"-{gravity}\"]"), 1)
    };
    let right = text("sqrt(a^2)", "sqrt(g^2)");
    assert!(read(&right).warnings.is_empty(), "{right}");
    for (mass, gravity) in
        [("sqrt(b^2)", "g"), ("sqrt(a^4)", "g"), ("a", "sqrt(b^2)"), ("a", "g*sqrt(b^4)")]
    {
        let found = errors(&text(mass, gravity)).to_string();
        assert!(found.contains("R0306"), "{mass}, {gravity}: {found}");
    }
}

#[test]
fn links_stand_on_the_link_before_unless_they_say_otherwise() {
    let text = [
        revolute("a", ""),
        revolute("b", "parent = \"d\""),
        revolute("c", "parent = \"a\""),
        revolute("d", "parent = \"base\""),
        revolute("e", ""),
    ];
    let robot = read(&arm(&text.concat())).robot;
    assert_eq!(names(&robot), ["a", "c", "d", "b", "e"]);
    let parents: Vec<_> = robot.links.iter().map(|link| link.parent).collect();
    assert_eq!(parents, [None, Some(0), None, Some(2), Some(2)]);
    let joints: Vec<_> = robot.coordinates.iter().map(|one| one.joint.as_str()).collect();
    assert_eq!(joints, ["a", "c", "d", "b", "e"]);
}

#[test]
fn an_axis_is_a_letter_with_a_sign_or_a_vector() {
    let axis = |axis: &str| {
        let joint = format!("joint = {{ type = \"prismatic\", axis = {axis} }}");
        let robot = read(&arm(&link("1", &joint))).robot;
        assert_eq!(robot.links[0].joint.kind, JointKind::Prismatic);
        robot.links[0].joint.axis.each_ref().map(|one| one.text().to_owned())
    };
    assert_eq!(axis("\"y\""), ["0", "1", "0"]);
    assert_eq!(axis("\"-z\""), ["0", "0", "-1"]);
    assert_eq!(axis("[1, -2, \"1/2\"]"), ["1", "-2", "1/2"]);
}

/// Compares the arm with its fixed links to the arm in which each of them has a joint that does not move.
#[test]
fn fixed_links_become_bodies_and_frames() {
    let joint = |axis: &str| format!("joint = {{ type = \"revolute\", axis = \"{axis}\" }}");
    let turned = "origin = { xyz = [0.3, 0.1, 0.2], rpy = [0.4, -0.5, 0.6] }";
    let file = |fixed: &str| {
        let text = [
            link("1", &joint("z")),
            link("2", &format!("{}\n{turned}", joint("y"))),
            link("plate", &format!("{fixed}\n{turned}")),
            link("sensor", &format!("{fixed}\n{turned}")),
            link("3", &format!("{}\n{turned}", joint("x"))),
            format!("[tip]\nparent = \"sensor\"\n{turned}\n"),
        ];
        read(&arm(&text.concat()))
    };
    let merged = file("joint = { type = \"fixed\" }");
    let robot = &merged.robot;
    assert_eq!(names(robot), ["1", "2", "3"]);
    let bodies: Vec<_> = robot.links[1].bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(bodies, ["2", "plate", "sensor"]);
    let frames: Vec<_> =
        robot.frames.iter().map(|frame| (frame.name.as_str(), frame.link)).collect();
    assert_eq!(frames, [("plate", Some(1)), ("sensor", Some(1)), ("tip", Some(1))]);
    let places = &merged.locations.links[1].bodies;
    assert_eq!(places.len(), 3);
    let moving = file(&joint("z")).robot;
    let (fixed, free) = (Mechanism::nominal(robot).unwrap(), Mechanism::nominal(&moving).unwrap());
    let mut random = Random::new(3);
    for _ in 0..10 {
        let mut state = || -> Vec<f64> { (0..3).map(|_| random.uniform(-2.0, 2.0)).collect() };
        let states = [state(), state(), state()];
        let [q, qd, qdd] = &states;
        let held = |x: &[f64]| vec![x[0], x[1], 0.0, 0.0, x[2]];
        let found = fixed.inverse_dynamics(q, qd, qdd).unwrap();
        let all = free.inverse_dynamics(&held(q), &held(qd), &held(qdd)).unwrap();
        for (mine, theirs) in [(0, 0), (1, 1), (2, 4)] {
            assert!((found[mine] - all[theirs]).abs() < 1e-12, "{found} {all}");
        }
        let place = fixed.forward_kinematics(q).unwrap();
        let expected = free.forward_kinematics(&held(q)).unwrap();
        for (mine, theirs) in [(0, 2), (1, 3)] {
            let distance = place.frames[mine].translation - expected.links[theirs].translation;
            assert!(distance.amax() < 1e-13, "{distance}");
        }
        let distance = place.frames[2].translation - expected.frames[0].translation;
        assert!(distance.amax() < 1e-13, "{distance}");
    }
}

#[test]
fn a_joint_that_follows_has_no_coordinate_of_its_own() {
    let text = "[parameters]\nk = 2\n".to_owned()
        + &link("1", "joint = { type = \"prismatic\", axis = \"z\", limits = [-1, 2.5] }")
        + &link(
            "2",
            "joint = { name = \"j\", type = \"revolute\", axis = \"x\", \
             mimic = { joint = \"1\", ratio = \"-k\", offset = 0.5 } }",
        )
        + &link("3", "joint = { type = \"revolute\", axis = \"x\" }");
    let robot = read(&arm(&text)).robot;
    assert_eq!(robot.degrees_of_freedom(), 2);
    let coordinates: Vec<_> = robot.links.iter().map(|link| link.joint.coordinate).collect();
    assert_eq!(coordinates, [0, 0, 1]);
    assert_eq!(robot.links[1].joint.name, "j");
    assert_eq!(robot.links[1].joint.ratio.text(), "-k");
    assert_eq!(robot.links[1].joint.offset.text(), "0.5");
    assert_eq!(
        robot.coordinates[0].limits,
        Rational::new(5, 2).map(|two| [Rational::integer(-1), two])
    );
}

#[test]
fn friction_and_drive_are_read() {
    let rotation = "friction = { viscous = 1, coulomb = 2, spindle_diameter = 3, coulomb_torque = 4, \
                    offset = -5, smoothing = 6 }\n\
                    drive = { armature = 7, rotor_inertia = 8, gear_ratio = -9, gyroscopic = true }";
    let translation = "joint = { type = \"prismatic\", axis = \"z\" }\n\
                       friction = { coulomb = 2, coulomb_positive = 3, coulomb_negative = 4 }";
    let text = revolute("1", rotation) + &link("2", translation);
    let robot = read(&arm(&text)).robot;
    let friction = &robot.links[0].friction;
    let formulas = [
        &friction.viscous,
        &friction.coulomb,
        &friction.spindle_diameter,
        &friction.coulomb_positive,
        &friction.coulomb_negative,
        &friction.offset,
        friction.smoothing.as_ref().unwrap(),
    ];
    assert_eq!(formulas.map(Formula::text), ["1", "2", "3", "4", "4", "-5", "6"]);
    let drive = &robot.links[0].drive;
    let formulas = [&drive.armature, &drive.rotor_inertia, &drive.gear_ratio];
    assert_eq!(formulas.map(Formula::text), ["7", "8", "-9"]);
    assert!(drive.gyroscopic);
    let friction = &robot.links[1].friction;
    assert_eq!(friction.coulomb_positive.text(), "3");
    assert_eq!(friction.coulomb_negative.text(), "4");
    assert!(friction.smoothing.is_none());
    assert!(!robot.links[1].drive.gyroscopic);
}

#[test]
fn tips_have_the_names_of_their_wrenches() {
    let one = read(&arm(&(revolute("1", "") + "[tip]\n"))).robot;
    let (frame, wrench) = one.tips().next().unwrap();
    assert_eq!((frame.name.as_str(), frame.link), ("tip", Some(0)));
    assert_eq!(wrench.force, ["Fx", "Fy", "Fz"]);
    let two = "[[tip]]\nname = \"left-hand\"\n[[tip]]\nname = \"b\"\nparent = \"base\"\n\
               wrench = { force = [\"X\", \"Y\", { name = \"Z\", latex = \"F_z\" }], \
               moment = [\"K\", \"M\", \"N\"] }\n[[frame]]\nname = \"eye\"\nparent = \"1\"\n";
    let two = read(&arm(&(revolute("1", "") + two))).robot;
    let tips: Vec<_> = two.tips().collect();
    assert_eq!(tips[0].1.moment, ["Mx_left_hand", "My_left_hand", "Mz_left_hand"]);
    assert_eq!((tips[1].0.link, &tips[1].1.moment[1]), (None, &"M".to_owned()));
    assert_eq!(tips[1].1.latex[2].as_deref(), Some("F_z"));
    assert_eq!(two.frames[2].name, "eye");
    assert!(two.frames[2].wrench.is_none());
}

#[test]
fn locations_point_at_the_text() {
    let text = arm("[parameters]\nm1 = { value = 2, unit = \"kg\" }\n")
        + "[[link]]\nname = \"1\"\njoint = { type = \"revolute\", axis = \"z\", limits = [0, 1] }\n\
           origin = { xyz = [0, 0, 1] }\nmass = \"m1\"\ncenter_of_mass = [0, 0, 2]\n\
           inertia = { xx = 1, yy = 1, zz = 1 }\nfriction = { viscous = 3 }\n\
           [tip]\nname = \"hand\"\norigin = { xyz = [0, 0, 3] }\n";
    let locations = read(&text).locations;
    let shown = |span: &std::ops::Range<usize>| &text[span.clone()];
    assert_eq!(shown(&locations.name), "\"arm\"");
    assert_eq!(shown(&locations.parameters[0].name), "m1");
    assert_eq!(shown(locations.parameters[0].value.as_ref().unwrap()), "2");
    assert_eq!(shown(locations.parameters[0].unit.as_ref().unwrap()), "\"kg\"");
    let link = &locations.links[0];
    assert_eq!(shown(&link.name), "\"1\"");
    assert_eq!(shown(link.axis.as_ref().unwrap()), "\"z\"");
    assert_eq!(shown(link.limits.as_ref().unwrap()), "[0, 1]");
    assert_eq!(shown(link.origin.as_ref().unwrap()), "{ xyz = [0, 0, 1] }");
    assert_eq!(shown(link.friction.as_ref().unwrap()), "{ viscous = 3 }");
    assert_eq!(shown(link.bodies[0].mass.as_ref().unwrap()), "\"m1\"");
    assert_eq!(shown(link.bodies[0].center_of_mass.as_ref().unwrap()), "[0, 0, 2]");
    assert_eq!(shown(link.bodies[0].inertia.as_ref().unwrap()), "{ xx = 1, yy = 1, zz = 1 }");
    assert_eq!(shown(&locations.frames[0].name), "\"hand\"");
    assert_eq!(shown(locations.frames[0].origin.as_ref().unwrap()), "{ xyz = [0, 0, 3] }");
}

#[test]
fn the_examples_of_the_reference_are_right() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/robot-file.md");
    let page = std::fs::read_to_string(path).unwrap();
    let examples: Vec<_> = page
        .split("```toml\n")
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap())
        // Other examples show only single lines of a file.
        .filter(|example| example.starts_with("format"))
        .collect();
    assert_eq!(examples.len(), 6);
    for example in examples {
        let described = read(example);
        assert!(described.warnings.is_empty(), "{}", described.warnings);
    }
}

#[test]
fn budgets_name_functions_and_limits() {
    let text = "[[budget]]\nfunction = \"mass_matrix\"\nmax_operations = 300\n[[budget]]\nmax_stack = 2_048\n";
    let text = arm(&format!("{}{text}", revolute("1", "")));
    let found = read(&text).budgets;
    let limits = |budget: &Budget| {
        let value = |limit: &Option<Limit>| limit.as_ref().map(|limit| limit.value);
        (budget.function.clone(), value(&budget.max_operations), value(&budget.max_stack))
    };
    let found: Vec<_> = found.iter().map(limits).collect();
    let expected = [(Some("mass_matrix".to_owned()), Some(300), None), (None, None, Some(2048))];
    assert_eq!(found, expected);

    let wrong =
        "[budget]\nfunction = \"mass_matrx\"\nmax_operations = 1.5\nmax_stack = -1\nmax = 2\n";
    let found = errors(&arm(&format!("{}{wrong}", revolute("1", "")))).to_string();
    for part in ["did you mean `mass_matrix`?", "`max` is not a key of a budget"] {
        assert!(found.contains(part), "{found}");
    }
    assert_eq!(
        found.matches("a limit must be a whole number from 0 to 9e15").count(),
        2,
        "{found}"
    );
}

#[test]
fn code_names_functions_and_bundles() {
    let of = |table: &str| read(&arm(&format!("{}{table}", revolute("1", ""))));
    assert_eq!(of("").code, Code::default());
    assert_eq!(of("[code]\n").code, Code::default());
    let all = of("[code]\nfunctions = [\"all\"]\n").code;
    assert_eq!(all.functions, Functions::All);
    let found = of("[code]\nfunctions = [\"bias\", \"gravity\"]\n\
         bundles = { both = [\"mass_matrix\", \"bias\"], one = [\"gravity\"] }\n\
         [budget]\nfunction = \"both\"\nmax_operations = 900\n");
    assert_eq!(found.budgets[0].function.as_deref(), Some("both"));
    let Code { functions, bundles } = found.code;
    assert_eq!(functions, Functions::Chosen(vec![FunctionKind::Bias, FunctionKind::Gravity]));
    let names: Vec<&str> = bundles.iter().map(|bundle| bundle.name.as_str()).collect();
    assert_eq!(names, ["both", "one"]);
    assert_eq!(bundles[0].functions, [FunctionKind::MassMatrix, FunctionKind::Bias]);
}

#[test]
fn bundles_have_names_of_their_own() {
    let taken = ["mass_matrix", "MassMatrix", "massmatrix", "jacobian_tip", "all", "tau", "q1"];
    for name in taken {
        assert!(check_bundle_name(name).is_err(), "{name}");
        let table = format!("[code]\nbundles = {{ {name} = [\"bias\"] }}\n");
        let found = errors(&arm(&format!("{}{table}", revolute("1", ""))));
        assert_eq!(found.iter().next().unwrap().code, code::RESERVED, "{found}");
    }
    let of_code = ["bias_sc", "x_generic", "my_batch", "model", "with_payload", "new", "fn"];
    let plain = ["dynamics", "bias_and_gravity", "Control", "forward_dynamics_and_more"];
    for name in plain.into_iter().chain(of_code) {
        assert_eq!(check_bundle_name(name), Ok(()));
        let table = format!("[code]\nbundles = {{ {name} = [\"bias\"] }}\n");
        assert_eq!(read(&arm(&format!("{}{table}", revolute("1", "")))).code.bundles[0].name, name);
    }
    assert!(check_bundle_name("a-b").is_err());
    let alike = "[code]\nbundles = { one_two = [\"bias\"], OneTwo = [\"bias\"] }\n";
    let found = errors(&arm(&format!("{}{alike}", revolute("1", ""))));
    assert_eq!(found.iter().next().unwrap().code, code::ALIKE, "{found}");
    let many: Vec<String> = (0..=MAX_BUNDLES).map(|n| format!("b{n} = [\"bias\"]")).collect();
    let many = format!("[code.bundles]\n{}\n", many.join("\n"));
    let found = errors(&arm(&format!("{}{many}", revolute("1", ""))));
    assert_eq!(found.iter().next().unwrap().code, code::LIMIT, "{found}");
}

#[test]
fn frames_of_base_parameters_are_chosen_by_a_word() {
    let text = |line: &str| arm(&format!("{line}\n{}", revolute("1", "")));
    assert_eq!(read(&text("")).robot.base_frames, BaseFrames::File);
    for frames in BaseFrames::ALL {
        let line = format!("base_frames = \"{}\"", frames.name());
        assert_eq!(read(&text(&line)).robot.base_frames, frames);
    }
    let found = errors(&text("base_frames = \"dh\""));
    assert_eq!(found.iter().next().unwrap().code, code::UNKNOWN_WORD, "{found}");
}

/// The words of other descriptions for types of joints are told the word to use.
#[test]
fn types_of_joints_of_other_formats_are_known() {
    let advice = [
        ("write \"revolute\" and leave out `limits`", vec!["continuous"]),
        ("write \"revolute\"", vec!["rotation", "rotational", "hinge", "R"]),
        (
            "write \"prismatic\"",
            vec!["translation", "translational", "linear", "slide", "slider", "P"],
        ),
        ("use three prismatic and three revolute joints", vec!["floating", "free"]),
        ("use two prismatic joints and a revolute one", vec!["planar"]),
        ("use three revolute joints", vec!["spherical", "ball"]),
        ("use a revolute and a prismatic joint", vec!["cylindrical"]),
        ("use two revolute joints", vec!["universal"]),
        ("use a revolute joint with a massless link, and a prismatic joint", vec!["screw"]),
        ("use one of `revolute`, `prismatic` and `fixed`", vec!["Revolute", "r", "sliding"]),
    ];
    for (help, words) in advice {
        for word in words {
            let joint = format!("joint = {{ type = \"{word}\", axis = \"z\" }}");
            let found = errors(&arm(&link("1", &joint)));
            let error = found.iter().next().unwrap();
            assert_eq!((found.len(), error.code), (1, code::UNKNOWN_WORD), "{word}: {found}");
            let told = error.help.as_deref().unwrap_or_default();
            assert!(told.starts_with(help), "{word}: {told}");
        }
    }
}

/// The parameters of the payload are where the payload is.
#[test]
fn parameters_of_the_payload_are_at_its_table() {
    let text = arm(&format!("{}\n[payload]\n", revolute("1", "")));
    let described = read(&text);
    let (parameters, places) = (&described.robot.parameters, &described.locations.parameters);
    assert_eq!((parameters.len(), places.len()), (10, 10));
    for (parameter, place) in parameters.iter().zip(places) {
        assert!(parameter.name.starts_with("payload_"), "{}", parameter.name);
        assert_eq!(&text[place.name.clone()], "payload", "{}", parameter.name);
        assert!(parameter.unit.is_some() && parameter.doc.is_some());
    }
    let bodies = &described.locations.links[0].bodies;
    let places: Vec<&str> = bodies.iter().map(|body| &text[body.name.clone()]).collect();
    assert_eq!(places, ["\"1\"", "payload"]);
}

/// A frame `Arm` takes the name of link `arm`, whose function must not get that of link `arm_link`.
#[test]
fn a_name_that_was_made_is_not_that_of_another_link() {
    let frame = "[[frame]]\nname = \"Arm\"\nparent = \"arm_link\"\n";
    let links = revolute("arm", "") + &revolute("arm_link", "");
    let robot = read(&format!("format = 1\n[robot]\nname = \"r\"\n{links}{frame}")).robot;
    let asked = |name: &str| functions::named(&robot, name).unwrap().frame();
    assert_eq!(asked("jacobian_arm_link"), Some(FrameRef::Link(1)));
    assert_eq!(asked("jacobian_arm_link_link"), Some(FrameRef::Link(0)));
    assert_eq!(asked("jacobian_Arm"), Some(FrameRef::Named(0)));
    for (name, kind) in functions::names(&robot) {
        assert_eq!(functions::named(&robot, &name), Ok(kind), "{name}");
    }
}

/// Names that become the same in code: each link is found by its own name.
#[test]
fn links_are_found_by_their_own_names() {
    let names = ["A", "a", "a.b", "a_b"];
    let links: String = names.map(|name| revolute(name, "")).concat();
    let robot = read(&format!("format = 1\n[robot]\nname = \"r\"\n{links}")).robot;
    let asked = |name: &str| functions::named(&robot, name).unwrap().frame();
    for (index, name) in names.into_iter().enumerate() {
        assert_eq!(asked(&format!("jacobian_{name}")), Some(FrameRef::Link(index)), "{name}");
    }
    for (name, kind) in functions::names(&robot) {
        assert_eq!(functions::named(&robot, &name), Ok(kind), "{name}");
    }
    assert_eq!(asked("jacobian_a_b_4"), Some(FrameRef::Link(3)));
}

/// The Jacobian of a frame that is fixed to the base is 0.
#[test]
fn the_usual_frames_move() {
    let frame =
        |name: &str, parent: &str| format!("[[frame]]\nname = \"{name}\"\nparent = \"{parent}\"\n");
    let of = |frames: String| {
        let links = revolute("1", "");
        read(&format!("format = 1\n[robot]\nname = \"r\"\n{links}{frames}")).robot
    };
    let (world, tool) = (frame("world", "base"), frame("tool", "1"));
    assert_eq!(FrameRef::usual(&of(world.clone())), [FrameRef::Link(0)]);
    assert_eq!(FrameRef::usual(&of(world + &tool)), [FrameRef::Named(1)]);
    assert_eq!(FrameRef::usual(&of(String::new())), [FrameRef::Link(0)]);
}

#[test]
fn symbols_of_a_robot_are_its_variables() {
    let more = "[parameters]\ng = 9.81\n".to_owned() + &revolute("1", "");
    let robot = read(&arm(&format!("{more}\n[tip]\nparent = \"1\"\n"))).robot;
    let components = robot.frames[0].wrench.iter().flat_map(Wrench::components);
    let found: Vec<Option<Variable>> = components.map(|name| robot.variable(name)).collect();
    let wrench: Vec<Option<Variable>> =
        (0..6).map(|entry| Some(Variable::Wrench(0, entry))).collect();
    assert_eq!(found, wrench);
    assert_eq!(robot.variable("g"), Some(Variable::Parameter(0)));
    assert_eq!(robot.variable("q1"), Some(Variable::Joint(JointVariable::Position, 0)));
    assert_eq!((robot.variable("q2"), robot.variable("h")), (None, None));
}
