use robot_model::diagnostic::code;
use robot_numeric::random::Random;

use super::*;

fn codes(text: &str) -> Vec<&'static str> {
    check("arm.toml", text, &Options::default()).found.iter().map(|one| one.code).collect()
}

/// A link of 0.4 m with the given keys, and a hand on it.
fn arm(keys: &str) -> String {
    format!(
        "format = 1\n[robot]\nname = \"arm\"\n\
         [[link]]\nname = \"rod\"\njoint = {{ type = \"revolute\", axis = \"y\" }}\n{keys}\n\
         [[link]]\nname = \"hand\"\njoint = {{ type = \"revolute\", axis = \"y\" }}\n\
         origin = {{ xyz = [0.4, 0, 0] }}\nmass = 1\ncenter_of_mass = [0.05, 0, 0]\n\
         inertia = {{ xx = 0.001, yy = 0.002, zz = 0.002 }}\n"
    )
}

/// A cylinder with the given mass from the origin to (0.4, 0, 0), with a radius of 3 cm. All moments are multiplied by
/// `scale`; the tensor is about the center of mass or, wrongly, about the origin.
fn rod(mass: f64, scale: f64, about_origin: bool) -> String {
    let (length, radius): (f64, f64) = (0.4, 0.03);
    let axial = mass * radius * radius / 2.0;
    let steiner = if about_origin { mass * length * length / 4.0 } else { 0.0 };
    let across = axial / 2.0 + mass * length * length / 12.0 + steiner;
    let [axial, across] = [axial * scale, across * scale];
    arm(&format!(
        "mass = {mass}\ncenter_of_mass = [0.2, 0, 0]\n\
         inertia = {{ xx = {axial:?}, yy = {across:?}, zz = {across:?} }}"
    ))
}

#[test]
fn a_sound_arm_is_passed() {
    assert_eq!(codes(&rod(2.0, 1.0, false)), [""; 0]);
}

#[test]
fn units_are_recognized_by_the_ratio_of_inertia_to_mass() {
    for (scale, unit) in [(1e9, "g mm^2"), (1e6, "kg mm^2"), (1e4, "kg cm^2")] {
        let found = check("arm.toml", &rod(2.0, scale, false), &Options::default()).found;
        assert_eq!(found.iter().map(|one| one.code).collect::<Vec<_>>(), [code::UNITS], "{found}");
        assert!(found.to_string().contains(&format!("in {unit}?")), "{found}");
    }
    // A mass in grams with an inertia for kilograms: the body would be denser than any material.
    let text = rod(2.0, 1.0, false).replace("mass = 2\n", "mass = 2000\n");
    assert_eq!(codes(&text), [code::UNITS]);
}

#[test]
fn a_tensor_about_the_origin_is_reported() {
    assert_eq!(codes(&rod(2.0, 1.0, true)), [code::ABOUT_ORIGIN]);
    let right = rod(2.0, 1.0, true).replacen("xx =", "about = \"origin\", xx =", 1);
    assert_eq!(codes(&right), [""; 0]);
}

/// A body may overhang both ends of its link by its radius: between points that far apart and with its center in the
/// middle, the mass may be spread as if half of it were at each.
#[test]
fn a_wide_body_overhangs_the_ends_of_its_link() {
    for radius in [0.01, 0.1, 0.3_f64] {
        let most = (0.2 + radius) * (0.2 + radius);
        for (part, expected) in [(0.98, &[][..]), (1.02, &[code::ABOUT_ORIGIN])] {
            let axial = radius * radius;
            let across = 2.0 * most * part + axial / 2.0;
            let text = arm(&format!(
                "mass = 2\ncenter_of_mass = [0.2, 0, 0]\n\
                 inertia = {{ xx = {axial:?}, yy = {across:?}, zz = {across:?} }}"
            ));
            assert_eq!(codes(&text), expected, "radius {radius}, {part} of the most");
        }
    }
}

#[test]
fn centers_of_mass_are_looked_for_at_the_link() {
    let at = |x: &str| rod(2.0, 1.0, false).replace("[0.2, 0, 0]", &format!("[{x}, 0, 0]"));
    assert_eq!(codes(&at("0.8")), [""; 0]);
    assert_eq!(codes(&at("20")), [code::CENTER_FAR]);
    assert_eq!(codes(&at("200")), [code::UNITS]);
}

#[test]
fn gravity_up_to_thirty_is_in_meters() {
    let with = |gravity: &str| {
        let robot = format!("name = \"arm\"\ngravity = [0, 0, -{gravity}]\n");
        codes(&rod(2.0, 1.0, false).replacen("name = \"arm\"\n", &robot, 1))
    };
    assert_eq!(with("30"), [""; 0]);
    assert_eq!(with("30.1"), [code::UNITS]);
}

/// The travel of a prismatic joint adds to the size of its link; the range of a revolute joint does not.
#[test]
fn limits_count_if_they_are_lengths() {
    let limited = |kind: &str| {
        rod(2.0, 1.0, false).replace("[0.2, 0, 0]", "[10, 0, 0]").replacen(
            "type = \"revolute\"",
            &format!("type = \"{kind}\", limits = [-3, 3]"),
            1,
        )
    };
    assert_eq!(codes(&limited("revolute")), [code::CENTER_FAR]);
    assert_eq!(codes(&limited("prismatic")), [""; 0]);
}

#[test]
fn rounded_right_angles_are_distinguished_from_other_angles() {
    let turned = |angle: &str| {
        rod(2.0, 1.0, false)
            .replace("xyz = [0.4, 0, 0]", &format!("xyz = [0.4, 0, 0], rpy = [{angle}, 0, 0]"))
    };
    for angle in
        ["1.57", "1.571", "-1.5708", "3.14", "3.1415", "4.712", "1.5707963705062866", "1e-7"]
    {
        assert_eq!(codes(&turned(angle)), [code::ANGLE_NEAR], "{angle}");
    }
    // Angles within the snapping tolerance cause a note; angles from calibrations and ordinary angles cause nothing.
    for angle in
        ["1.57079632679", "1.5707963267948966", "1.5712", "1.5", "3", "0.001", "0", "\"pi/2\""]
    {
        assert_eq!(codes(&turned(angle)), [""; 0], "{angle}");
    }
    let note = check("arm.toml", &turned("1.57079632679"), &Options::default()).choices;
    assert_eq!(note.iter().map(|one| one.code).collect::<Vec<_>>(), [code::TAKEN_ANGLE]);
    for angle in ["90", "-180", "45"] {
        assert_eq!(codes(&turned(angle)), [code::DEGREES], "{angle}");
    }
}

#[test]
fn copies_are_reported_and_parameters_are_not() {
    let link = |name: &str, mass: &str, moment: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"x\" }}\n\
             origin = {{ xyz = [0.2, 0, 0] }}\nmass = {mass}\ncenter_of_mass = [0.1, 0, 0]\n\
             inertia = {{ xx = {moment}, yy = {moment}, zz = {moment} }}\n"
        )
    };
    let robot = |links: &[String]| {
        format!(
            "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nJ = 0.01\nm = 1\n{}{}",
            link("first", "\"m\"", "\"J\""),
            links.concat()
        )
    };
    let same =
        |names: &[&str]| names.iter().map(|name| link(name, "2", "0.02")).collect::<Vec<_>>();
    assert_eq!(codes(&robot(&same(&["a", "b"]))), [""; 0]);
    assert_eq!(codes(&robot(&same(&["a", "b", "c"]))), [code::COPIED]);
    let masses = [link("a", "2", "0.02"), link("b", "1", "0.02")];
    assert_eq!(codes(&robot(&masses)), [code::COPIED]);
    // Up to a hundredth apart, masses are the same.
    for (mass, expected) in
        [("101", &[][..]), ("99", &[]), ("102", &[code::COPIED]), ("98", &[code::COPIED])]
    {
        let masses = [link("a", "100", "2"), link("b", mass, "2")];
        assert_eq!(codes(&robot(&masses)), expected, "{mass}");
    }
    let symbols = ["a", "b", "c"].map(|name| link(name, "2", "\"J\""));
    assert_eq!(codes(&robot(&symbols)), [""; 0]);
}

#[test]
fn what_is_not_known_is_passed_over() {
    let text = rod(2.0, 1e6, false).replace("mass = 2\n", "mass = \"m\"\n");
    let text =
        text.replace("[[link]]\nname = \"rod\"", "[parameters]\nm = {}\n[[link]]\nname = \"rod\"");
    assert_eq!(codes(&text), [""; 0]);
}

#[test]
fn joints_that_move_nothing_are_reported() {
    let text = "format = 1\n[robot]\nname = \"arm\"\n[[link]]\nname = \"a\"\n\
                joint = { type = \"prismatic\", axis = \"z\" }\nmass = 1\n\
                center_of_mass = [0, 0, 0]\ninertia = { xx = 0, yy = 0, zz = 0 }\n\
                [[link]]\nname = \"b\"\njoint = { type = \"revolute\", axis = \"z\" }\n";
    assert_eq!(codes(&format!("{text}massless = true\n")), [code::MOVES_NOTHING]);
    let moved = "massless = true\ndrive = { armature = 0.1 }\n";
    assert_eq!(codes(&format!("{text}{moved}")), [""; 0]);
    // A point mass on the axis.
    let point = "mass = 1\ncenter_of_mass = [0, 0, 1]\ninertia = { xx = 0, yy = 0, zz = 0 }\n";
    assert_eq!(codes(&format!("{text}{point}")), [code::MOVES_NOTHING, code::POINT_MASS]);
}

/// A link of the given length with a uniform body of rectangular section that extends over `[from, to]` along it. The
/// tensor is about the center of mass or, wrongly, about the origin.
fn beam(
    length: f64,
    [from, to]: [f64; 2],
    [width, height]: [f64; 2],
    density: f64,
    about_origin: bool,
) -> String {
    let own = to - from;
    let (mass, center) = (density * own * width * height, (from + to) / 2.0);
    let moment = |a: f64, b: f64| mass * (a * a + b * b) / 12.0;
    let steiner = if about_origin { mass * center * center } else { 0.0 };
    let (xx, yy, zz) =
        (moment(width, height), moment(own, height) + steiner, moment(own, width) + steiner);
    let keys = format!(
        "mass = {mass:?}\ncenter_of_mass = [{center:?}, 0, 0]\n\
         inertia = {{ xx = {xx:?}, yy = {yy:?}, zz = {zz:?} }}"
    );
    arm(&keys).replace("xyz = [0.4, 0, 0]", &format!("xyz = [{length:?}, 0, 0]"))
}

/// A uniform body of a real material between the ends of its link causes no warning, whatever its shape.
#[test]
fn bodies_on_their_links_cause_no_warning() {
    let mut random = Random::new(5);
    for round in 0..500 {
        let length = random.uniform(0.05, 1.5);
        let section = [random.uniform(0.01, 0.3), random.uniform(0.01, 0.3)];
        let (first, second) = (random.uniform(0.0, length), random.uniform(0.0, length));
        let ends = [first.min(second), first.max(second) + 0.001];
        let text = beam(length, ends, section, random.uniform(200.0, 9000.0), false);
        let found = check("arm.toml", &text, &Options::default()).found;
        assert!(found.is_empty(), "seed 5, round {round}:\n{text}\n{found}");
    }
}

/// Tests rods that are thinner than a seventh of their length.
#[test]
fn slender_bodies_with_tensors_about_the_origin_are_reported() {
    let mut random = Random::new(6);
    for round in 0..200 {
        let length = random.uniform(0.1, 1.5);
        let section = [0, 1].map(|_| length * random.uniform(0.01, 1.0 / 7.0));
        let text = beam(length, [0.0, length], section, random.uniform(200.0, 9000.0), true);
        assert_eq!(codes(&text), [code::ABOUT_ORIGIN], "seed 6, round {round}:\n{text}");
    }
}

/// A warning is given if a part of the body must be denser than osmium. A body of 2 kg with this tensor has a density
/// of at least 137 kg/m³, and the density increases with the mass to the power of 2.5.
#[test]
fn bodies_denser_than_osmium_are_reported() {
    let heavy = |mass: &str| {
        codes(&rod(2.0, 1.0, false).replace("mass = 2\n", &format!("mass = {mass}\n")))
    };
    assert_eq!(heavy("14"), [""; 0]);
    assert_eq!(heavy("21"), [code::UNITS]);
}

/// The suggested unit is the one in which the size of the body is closest to that of its link, 0.4 m.
#[test]
fn the_size_of_the_link_decides_between_units() {
    let found = check("arm.toml", &rod(2.0, 146_900.0, false), &Options::default()).found;
    assert!(found.to_string().contains("in kg cm^2?"), "{found}");
}

/// The largest radius of gyration is three times the size of the link; that of this rod is 0.117 m times √scale.
#[test]
fn bodies_wider_than_their_links_are_reported() {
    assert_eq!(codes(&rod(2.0, 80.0, false)), [""; 0]);
    assert_eq!(codes(&rod(2.0, 130.0, false)), [code::TOO_WIDE]);
}

/// The center of mass may be outside the link by at most three times the sum of the link's size and the radius of
/// gyration.
#[test]
fn centers_outside_of_the_link_are_measured_from_its_ends() {
    let at = |x: &str| rod(2.0, 1.0, false).replace("[0.2, 0, 0]", &format!("[{x}, 0, 0]"));
    assert_eq!(codes(&at("1.9")), [""; 0]);
    assert_eq!(codes(&at("2")), [code::CENTER_FAR]);
    // The length of a link that extends to both sides is the sum of both.
    let other = "[[link]]\nname = \"other\"\nparent = \"rod\"\norigin = { xyz = [-0.4, 0, 0] }\n\
                 joint = { type = \"revolute\", axis = \"y\" }\nmass = 1\n\
                 center_of_mass = [0.05, 0, 0]\ninertia = { xx = 0.002, yy = 0.003, zz = 0.003 }\n";
    assert_eq!(codes(&format!("{}{other}", at("2.9"))), [""; 0]);
    // A link without a size is compared with the reach of the arm, 0.4 m.
    let point = |x: &str| {
        let hand = "inertia = { xx = 0.001, yy = 0.002, zz = 0.002 }";
        let text = rod(2.0, 1.0, false).replace(hand, "inertia = { xx = 0, yy = 0, zz = 0 }");
        codes(&text.replace("[0.05, 0, 0]", &format!("[{x}, 0, 0]")))
    };
    assert!(!point("1.1").contains(&code::CENTER_FAR));
    assert!(point("2").contains(&code::CENTER_FAR));
}

/// The reference point of a tensor is checked only if both ends of the body are known and the check is not waived.
#[test]
fn tensors_are_judged_if_the_ends_of_the_body_are_known() {
    let wrong = rod(2.0, 1.0, true);
    let last = wrong.split("[[link]]\nname = \"hand\"").next().unwrap();
    assert_eq!(codes(last), [code::ABOUT_ORIGIN]);
    assert_eq!(codes(&wrong.replacen("xx =", "unchecked = true, xx =", 1)), [""; 0]);
    // The center of mass is near the end of the link, so the body extends beyond it by an unknown distance.
    let beyond = arm("mass = 2\ncenter_of_mass = [0.38, 0, 0]\n\
         inertia = { xx = 0.0009, yy = 0.3493, zz = 0.3493 }");
    assert_eq!(codes(&beyond), [""; 0]);
}

/// The same tensor with masses that differ by less than one percent is not reported as a copy.
#[test]
fn masses_that_hardly_differ_are_the_same() {
    let pair = |masses: [&str; 2]| {
        let link = |mass: &str| {
            format!(
                "[[link]]\nname = \"link_{mass}\"\njoint = {{ type = \"revolute\", axis = \"x\" }}\n\
                 origin = {{ xyz = [0.2, 0, 0] }}\nmass = {mass}\ncenter_of_mass = [0.1, 0, 0]\n\
                 inertia = {{ xx = 2, yy = 2, zz = 2 }}\n"
            )
        };
        codes(&format!("format = 1\n[robot]\nname = \"arm\"\n{}", masses.map(link).concat()))
    };
    assert_eq!(pair(["200", "201"]), [""; 0]);
    assert_eq!(pair(["200", "203"]), [code::COPIED]);
}

#[test]
fn gravity_that_points_up_is_reported() {
    let with = |gravity: &str| {
        let robot = format!("name = \"arm\"\ngravity = {gravity}\n");
        codes(&rod(2.0, 1.0, false).replacen("name = \"arm\"\n", &robot, 1))
    };
    assert_eq!(with("[0, 0, 9.81]"), [code::GRAVITY_UP]);
    assert_eq!(with("[1, 2, 9.81]"), [code::GRAVITY_UP]);
    for sideways in ["[0, 9, 5]", "[-9, 0, 5]", "[0, 0, -9.81]", "[0, 0, 0]"] {
        assert_eq!(with(sideways), [""; 0], "{sideways}");
    }
}

/// In a robot without mass, no joint moves any mass.
#[test]
fn a_robot_without_mass_moves_nothing() {
    let text = "format = 1\n[robot]\nname = \"arm\"\n[[link]]\nname = \"a\"\n\
                joint = { type = \"revolute\", axis = \"z\" }\nmassless = true\n";
    assert_eq!(codes(text), [code::MOVES_NOTHING]);
}

/// Tests the threshold of each check: a value on either side of it, and the code that is reported beyond it.
#[test]
fn rules_begin_at_their_sizes() {
    let rod = rod(2.0, 1.0, false);
    let turned =
        |angle: &str| rod.replace("[0.4, 0, 0]", &format!("[0.4, 0, 0], rpy = [0, {angle}, 0]"));
    let limited = |kind: &str, limits: &str| {
        rod.replacen("type = \"revolute\"", &format!("type = \"{kind}\", limits = [{limits}]"), 1)
    };
    let far = |x: &str| rod.replace("xyz = [0.4, 0, 0]", &format!("xyz = [0, {x}, 0]"));
    let tensor = |moment: &str| {
        arm(&format!(
            "mass = 2\ncenter_of_mass = [0.2, 0, 0]\n\
             inertia = {{ xx = {moment}, yy = {moment}, zz = {moment} }}"
        ))
    };
    let mass = |mass: &str| rod.replace("mass = 2\n", &format!("mass = {mass}\n"));
    let center = |x: &str| rod.replace("[0.2, 0, 0]", &format!("[{x}, 0, 0]"));
    let axis = |axis: &str| rod.replacen("axis = \"y\"", &format!("axis = [{axis}]"), 1);
    let gravity = |z: &str| {
        rod.replacen("name = \"arm\"\n", &format!("name = \"arm\"\ngravity = [0, 0, {z}]\n"), 1)
    };
    for (passed, doubted, code) in [
        (turned("6.2841"), turned("6.2842"), code::DEGREES),
        (turned("-6.2841"), turned("-6.2842"), code::DEGREES),
        (limited("revolute", "-25.133, 25.133"), limited("revolute", "-25.134, 1"), code::DEGREES),
        (limited("prismatic", "-26, 26"), limited("revolute", "-1, 25.134"), code::DEGREES),
        (far("20"), far("-20.01"), code::UNITS),
        // Thresholds: a radius of gyration of 1.2 m, which is three times the link; one of 3 m; a density of 22,590
        // kg/m³.
        (tensor("1.91"), tensor("1.93"), code::TOO_WIDE),
        (mass("15.3"), mass("15.6"), code::UNITS),
        (center("1.952"), center("1.953"), code::CENTER_FAR),
        (axis("1.1e-6, 1, 0"), axis("1e-6, 1, 0"), code::AXIS_NEAR),
        (axis("0, -2, 2.1e-6"), axis("0, -2, -2e-6"), code::AXIS_NEAR),
        (gravity("-30"), gravity("-30.01"), code::UNITS),
    ] {
        assert_eq!(codes(&passed), [""; 0], "{passed}");
        assert_eq!(codes(&doubted), [code], "{doubted}");
    }
    // If the radius of gyration exceeds 3 m, the units are suspected instead of the size of the link.
    assert_eq!(codes(&tensor("12")), [code::TOO_WIDE]);
    assert_eq!(codes(&tensor("12.01")), [code::UNITS]);
    // Bodies whose units are suspected are not checked further.
    assert_eq!(codes(&center("20.01")), [code::UNITS]);
    assert_eq!(codes(&center("-20")), [code::CENTER_FAR]);
}

#[test]
fn every_unit_of_moments_is_known() {
    for (scale, unit, factor) in [
        (1e3, "g m^2", "1e-3"),
        (1e4, "kg cm^2", "1e-4"),
        (1e6, "kg mm^2", "1e-6"),
        (1e7, "g cm^2", "1e-7"),
        (1e9, "g mm^2", "1e-9"),
    ] {
        let found = check("arm.toml", &rod(2.0, scale, false), &Options::default()).found;
        let expected = format!("multiply values in {unit} by {factor}");
        assert!(found.to_string().contains(&expected), "{scale}: {found}");
    }
}

/// A frame marks the size of its link like a child link, and the travel of a prismatic joint is the distance between
/// its limits.
#[test]
fn what_marks_the_size_of_a_link() {
    let alone = rod(2.0, 1.0, false);
    let alone = alone.split("[[link]]\nname = \"hand\"").next().unwrap();
    let centered = |x: &str| alone.replace("[0.2, 0, 0]", &format!("[{x}, 0, 0]"));
    let frame = "[[frame]]\nname = \"tool\"\nparent = \"rod\"\norigin = { xyz = [0, 3, 0] }\n";
    assert_eq!(codes(&centered("5")), [code::CENTER_FAR]);
    assert_eq!(codes(&format!("{}{frame}", centered("5"))), [""; 0]);
    // The limits [1, 4] give a travel of 3 m: with a radius of gyration of 0.117 m, a distance of 9.35 m is accepted,
    // and 9.36 m is not.
    let sliding = |x: &str| {
        centered(x).replacen("type = \"revolute\"", "type = \"prismatic\", limits = [1, 4]", 1)
    };
    assert_eq!(codes(&sliding("9.35")), [""; 0]);
    assert_eq!(codes(&sliding("9.36")), [code::CENTER_FAR]);
}

/// Of nine copies, eight are shown, and the others are counted.
#[test]
fn copies_are_named_up_to_eight() {
    let robot = |count: usize| {
        let link = |number: usize| {
            format!(
                "[[link]]\nname = \"l{number}\"\njoint = {{ type = \"revolute\", axis = \"x\" }}\n\
                 origin = {{ xyz = [0.2, 0, 0] }}\nmass = 2\ncenter_of_mass = [0.1, 0, 0]\n\
                 inertia = {{ xx = 0.02, yy = 0.02, zz = 0.02 }}\n"
            )
        };
        let links: String = (1..=count).map(link).collect();
        let text = format!("format = 1\n[robot]\nname = \"arm\"\n{links}");
        check("arm.toml", &text, &Options::default()).found.to_string()
    };
    let eight = "`l1`, `l2`, `l3`, `l4`, `l5`, `l6`, `l7`, `l8`";
    assert!(robot(3).contains("the same inertia: `l1`, `l2`, `l3`\n"), "{}", robot(3));
    assert!(robot(8).contains(&format!("{eight}\n")), "{}", robot(8));
    assert!(robot(9).contains(&format!("{eight} and 1 more\n")), "{}", robot(9));
    assert!(robot(9).contains("and here on lines 17, 24, 31, 38, 45, 52, 59\n"), "{}", robot(9));
}

/// A joint counts as moving nothing if its inertia is less than 10⁻¹² of that of another joint.
#[test]
fn next_to_nothing_is_nothing() {
    let text = |armature: &str| {
        format!(
            "format = 1\n[robot]\nname = \"arm\"\n[[link]]\nname = \"a\"\n\
             joint = {{ type = \"prismatic\", axis = \"z\" }}\nmass = 1\ncenter_of_mass = [0, 0, 0]\n\
             inertia = {{ xx = 0, yy = 0, zz = 0 }}\n[[link]]\nname = \"b\"\n\
             joint = {{ type = \"revolute\", axis = \"z\" }}\nmassless = true\n\
             drive = {{ armature = {armature} }}\n"
        )
    };
    assert_eq!(codes(&text("2e-12")), [""; 0]);
    assert_eq!(codes(&text("5e-13")), [code::MOVES_NOTHING]);
    let found = check("arm.toml", &text("5e-13"), &Options::default()).found.to_string();
    assert!(found.contains("the joint `b` moves almost no mass"), "{found}");
    assert!(found.contains("arm.toml:12:"), "{found}");
    let found = check("arm.toml", &text("0"), &Options::default()).found.to_string();
    assert!(found.contains("the joint `b` moves no mass"), "{found}");
}

/// Messages about angles name the multiple of π/2, the difference, and the text to write instead.
#[test]
fn angles_are_named_with_their_multiples() {
    let turned = |angle: &str| {
        let text = rod(2.0, 1.0, false)
            .replace("xyz = [0.4, 0, 0]", &format!("xyz = [0.4, 0, 0], rpy = [{angle}, 0, 0]"));
        check("arm.toml", &text, &Options::default()).found.to_string()
    };
    for (angle, parts) in [
        ("1.5708", ["nearly π/2\n", "leaves a cosine of 3.67", "\"pi/2\"", "snap = 1e-5`"]),
        ("-1.5708", ["nearly -π/2\n", "leaves a cosine of 3.67", "\"-pi/2\"", "snap = 1e-5`"]),
        ("3.1416", ["nearly π\n", "leaves a sine of 7.34", "\"pi\"", "snap = 1e-5`"]),
        ("-3.1416", ["nearly -π\n", "leaves a sine of 7.34", "\"-pi\"", "snap = 1e-5`"]),
        (
            "4.712",
            ["nearly 3*π/2\n", "leaves a cosine of 0.00038898 ", "\"3*pi/2\"", "snap = 1e-3`"],
        ),
        ("-4.712", ["nearly -3*π/2\n", "leaves a cosine of ", "\"-3*pi/2\"", "1e-3`"]),
        ("6.283", ["nearly 2*π\n", "leaves a sine of 0.0001853", "\"2*pi\"", "snap = 1e-3`"]),
        (
            "1e-7",
            ["nearly 0\n", "leaves a sine of 1e-7 ", "write all its digits, 0, or", "snap = 1e-"],
        ),
    ] {
        let found = turned(angle);
        for part in parts {
            assert!(found.contains(part), "{angle}: {part} is not in\n{found}");
        }
    }
    let found = turned("90");
    assert!(found.contains("90 degrees are 1.5707963267948966 rad"), "{found}");
    assert!(found.contains("these are 14.3239 turns"), "{found}");
}
