use robot_check::difference::StateBox;

use super::*;

fn owned(text: &str) -> String {
    text.to_owned()
}

fn term(powers: &str, coefficients: [Option<&str>; 2]) -> Term {
    Term { powers: owned(powers), coefficients: coefficients.map(|one| one.map(owned)) }
}

#[test]
fn properties_that_files_do_not_mention_are_left_out() {
    use ItemKind::{Frame, Joint, Link, Parameter, Robot};
    for (kind, name, value, expected) in [
        (Joint, "ratio", "1", true),
        (Joint, "ratio", "0", false),
        (Joint, "gear ratio", "1", true),
        (Joint, "gear ratio", "100", false),
        (Joint, "gyroscopic rotor", "false", true),
        (Joint, "gyroscopic rotor", "true", false),
        (Joint, "viscous friction", "0", true),
        (Joint, "viscous friction", "1", false),
        (Link, "Ixx", "0", true),
        (Link, "Ixx", "0.1", false),
        // A mass of 0 is printed.
        (Link, "mass", "0", false),
        (Link, "body of hand: mass", "0", false),
        (Link, "body of hand: Ixx", "0", true),
        (Robot, "gravity", "0", false),
        (Parameter, "value", "0", false),
        (Frame, "link", "0", false),
    ] {
        assert_eq!(is_usual(kind, name, value), expected, "{name} {value}");
    }
}

#[test]
fn long_numbers_are_rounded_as_far_as_they_still_differ() {
    let third = "1/3000000000000000000000000000000";
    let long = "0.38847736995884759176954739917696";
    let longer = "0.38847736995884759176954739917697";
    let near = "1.00000000000000000000000001";
    for (pair, expected) in [
        ([third, "1"], ["3.333333333e-31", "1"]),
        ([long, "-0.1234567890123456"], ["0.38847737", "-0.1234567890123456"]),
        ([long, "0.38847736995884859176954739917696"], ["0.388477369958848", "0.388477369958849"]),
        ([long, longer], [long, longer]),
        // A number that would be rounded to 1.
        ([&format!("m*{near}"), "m"], [&format!("m*{near}"), "m"]),
        // Two notations of nearly the same value.
        (["m*3/4", "m*0.75000000000000000000001"], ["m*3/4", "m*0.75000000000000000000001"]),
        (["m*3/4", "m*0.75100000000000000000001"], ["m*3/4", "m*0.751"]),
        (
            ["(l, 0.00000000000000000001)", "(l, 1.000000000000000000000000001e-20)"],
            ["(l, 0.00000000000000000001)", "(l, 1.000000000000000000000000001e-20)"],
        ),
        // Numbers of which only hundreds of digits show the change.
        (["0.1", &format!("1{}3/1{}0", "0".repeat(70), "0".repeat(71))], ["0.1", "0.1 + 3e-72"]),
        ([&format!("-1{}3/1{}", "0".repeat(700), "0".repeat(701)), "-1"], ["-1", "-1 + 3e-701"]),
        // A vector, and names as long as a number.
        ([&format!("to ({long}, -{long}, 1)"), "x"], ["to (0.38847737, -0.38847737, 1)", "x"]),
        (["a_123456789012345678901234567890", "y"], ["a_123456789012345678901234567890", "y"]),
    ] {
        let values = pair.map(|text| Some(owned(text)));
        assert_eq!(rounded::pair(&values), expected.map(|text| Some(owned(text))));
    }
    assert_eq!(rounded::pair(&[None, Some(owned(long))]), [None, Some(owned("0.38847737"))]);
    // What f64 cannot hold keeps its digits.
    let huge = "1".repeat(400);
    assert_eq!(rounded::one(&huge), huge);
    let whole = equation(
        &Equation { name: owned("Q1"), terms: Ok(vec![term("qdd1", [Some(long), None])]) },
        20,
    );
    assert_eq!(whole, "  Q1\n  - 0.38847737 qdd1\n");
}

#[test]
fn items_have_a_line_with_a_sign() {
    let property = |name: &str, value: &str| (owned(name), owned(value));
    let properties = vec![property("mass", "m3"), property("Ixx", "0"), property("Izz", "I3")];
    let item = Item { kind: ItemKind::Link, name: owned("3"), properties };
    assert_eq!(change(&Change::Added(item.clone())), "+ link 3: mass m3; Izz I3\n");
    assert_eq!(change(&Change::Removed(item)), "- link 3: mass m3; Izz I3\n");
    let changed = |name: &str, values: [Option<&str>; 2]| {
        let values = values.map(|one| one.map(owned));
        let properties = vec![Property { name: owned("gravity"), values }];
        change(&Change::Changed { kind: ItemKind::Robot, name: owned(name), properties })
    };
    assert_eq!(changed("", [Some("1"), Some("2")]), "~ robot: gravity 1 -> 2\n");
    assert_eq!(changed("a", [None, Some("2")]), "~ robot a: gravity none -> 2\n");
    assert_eq!(changed("a", [Some("1"), None]), "~ robot a: gravity 1 -> none\n");
}

#[test]
fn terms_are_products_with_the_sign_of_the_line() {
    for (coefficient, powers, expected) in [
        ("1", "g*m1", "g*m1"),
        ("1", "1", "1"),
        ("2", "1", "2"),
        ("-2", "1", "(-2)"),
        ("2", "g*m1", "2 g*m1"),
        ("-1", "g*m1", "(-1) g*m1"),
    ] {
        assert_eq!(product(coefficient, powers), expected);
    }
    let terms = vec![
        term("m1", [Some("2"), None]),
        term("m2", [None, Some("-3")]),
        term("m3", [Some("1"), Some("4")]),
    ];
    let one = Equation { name: owned("Q1"), terms: Ok(terms) };
    let lines = ["  Q1\n", "  - 2 m1\n", "  + (-3) m2\n", "  ~ (1 -> 4) m3\n"];
    assert_eq!(equation(&one, 3), lines.concat());
    assert_eq!(equation(&one, 4), lines.concat());
    assert_eq!(equation(&one, 1), format!("{}{}    (2 more)\n", lines[0], lines[1]));
    assert_eq!(equation(&one, 0), format!("{}    (3 more)\n", lines[0]));
    let refused = Equation { name: owned("Q2"), terms: Err(owned("too long")) };
    assert_eq!(equation(&refused, 3), "  Q2: not compared: too long\n");
}

#[test]
fn torques_have_the_units_of_their_joints() {
    let state = State { q: vec![0.5, 1.0], qd: vec![0.25, 2.0], qdd: vec![-1.0, 3.0] };
    let joint = |joint: &str, kind, torques| Torque {
        joint: owned(joint),
        kind,
        torques,
        state: state.clone(),
        largest: 3.5,
    };
    let found = Torques {
        drawn: StateBox {
            seed: 7,
            states: 3,
            positions: vec![[-1.0, 1.0], [0.0, 0.5], [-1.0, 1.0], [-1.0, 1.0]],
            velocity: 2.0,
            acceleration: 5.0,
        },
        joints: vec![
            joint("swing", JointKind::Revolute, [1.0, 3.5]),
            joint("slide", JointKind::Prismatic, [2.0, 0.5]),
            joint("hand", JointKind::Revolute, [1e-3, 1e-3 + 1e-16]),
            joint("wrist", JointKind::Revolute, [3.0, 3.000_001]),
        ],
    };
    let at = "    at q = (0.500, 1.000), qd = (0.250, 2.000), qdd = (-1.000, 3.000)\n";
    assert_eq!(
        torques(&found),
        format!(
            "  3 states, seed 7; velocities within 2, accelerations within 5, positions\n\
             \x20 joint swing, -1.000 to 1.000 rad: 2.5000 N m, 1.0000 -> 3.5000\n{at}\
             \x20 joint slide, 0.000 to 0.500 m: -1.5000 N, 2.0000 -> 0.5000\n{at}\
             \x20 joint hand: none\n\
             \x20 joint wrist, -1.000 to 1.000 rad: 1e-6 N m, 3.00000000 -> 3.00000100\n{at}"
        )
    );
    let json = torques_json(&found);
    assert_eq!(json["joints"][1]["change"], -1.5);
    assert_eq!(json["joints"][1]["torques"], json!([2.0, 0.5]));
    assert_eq!(json["joints"][0]["state"]["qd"], json!([0.25, 2.0]));
    assert_eq!([&json["states"], &json["seed"]], [3, 7]);
}

/// Parts that cannot be compared have the reason in text and in JSON.
#[test]
fn what_is_not_compared_has_its_reason() {
    let none = Difference {
        names: ["a", "b"].map(owned),
        changes: vec![],
        equations: vec![],
        operations: Err(owned("too large")),
        torques: Err(owned("no value")),
    };
    assert_eq!(
        text(&none, 3),
        "a -> b\n\nrobot files\n  no differences\n\nterms of the joint torques\n  no differences\n\n\
         operations per call\n  not compared: too large\n\n\
         largest differences of the joint torques\n  not compared: no value\n"
    );
    let shown: Value = serde_json::from_str(&json(&none)).unwrap();
    assert_eq!(shown["operations"], json!({ "not_compared": "too large" }));
    assert_eq!(shown["torques"], json!({ "not_compared": "no value" }));
    assert_eq!(shown["robots"], json!(["a", "b"]));
}

#[test]
fn lines_are_colored_by_their_signs() {
    let text = "title\n+ a\n  + b\n- c\n  - d\n~ e\n  ~ f\n  plain\n\n+more\n";
    let styles: Vec<String> = colored(text)
        .lines()
        .map(|line| {
            line.split_once('m').filter(|_| line.contains('\x1b')).map_or("", |(style, _)| style)
        })
        .map(|style| style.replace("\x1b[", ""))
        .collect();
    assert_eq!(styles, ["1", "32", "32", "31", "31", "33", "33", "", "", ""]);
}
