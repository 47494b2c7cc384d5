//! Checks that equations are printed in the form that people write: like those of the textbooks, as short as possible,
//! and equal to the derived ones.

use std::collections::BTreeMap;

use rayon::prelude::*;
use robot_document::{EquationOptions, Form, equations};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::{Move, Robot};
use robot_numeric::robots::{self, Random, Recipe};
use robot_symbolic::polynomial::equal;
use robot_symbolic::{AngleSums, Expr, Graph};

fn usual() -> EquationOptions {
    EquationOptions { form: Form::Grouped, references: false, ..EquationOptions::default() }
}

/// The definitions and quantities of a robot by name.
fn printed(robot: &Robot, options: &EquationOptions) -> BTreeMap<String, String> {
    let kinds = EquationOptions::default().kinds;
    let printed = equations(robot, &EquationOptions { kinds, ..options.clone() }).unwrap();
    let all = printed.definitions().chain(printed.quantities());
    all.map(|equation| (equation.name.clone(), equation.text.clone())).collect()
}

fn fixture(name: &str) -> Robot {
    let path = format!("{}/tests/fixtures/textbook/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    robot_testing::read(name, &std::fs::read_to_string(path).unwrap())
}

fn assert_prints(robot: &Robot, expected: &[(&str, &str)]) {
    let found = printed(robot, &usual());
    for (name, expected) in expected {
        assert_eq!(found.get(*name).map(String::as_str), Some(*expected), "{}: {name}", robot.name);
    }
    let known =
        |name: &String| name.starts_with(['Q', 'w']) || expected.iter().any(|one| one.0 == name);
    let others: Vec<&String> = found.keys().filter(|name| !known(name)).collect();
    assert!(others.is_empty(), "{}: {others:?}", robot.name);
}

/// M. W. Spong, S. Hutchinson, M. Vidyasagar, "Robot Modeling and Control", Wiley 2006, section 7.4, with the symbol r
/// for the distances of the centers of mass and with the terms ordered link by link.
#[test]
fn the_planar_elbow_arm_prints_as_in_the_textbook() {
    assert_prints(
        &robot_testing::robot("planar_2r"),
        &[
            ("M_1_1", "m1*r1^2 + I1 + m2*(l1^2 + r2^2 + 2*l1*r2*cos(q2)) + I2"),
            ("M_1_2", "m2*r2*(r2 + l1*cos(q2)) + I2"),
            ("M_2_2", "m2*r2^2 + I2"),
            ("b_1_1_2", "-2*m2*l1*r2*sin(q2)"),
            ("b_1_2_2", "-m2*l1*r2*sin(q2)"),
            ("b_2_1_1", "m2*l1*r2*sin(q2)"),
            ("g_1", "g*(m1*r1 + m2*l1)*cos(q1) + m2*g*r2*cos(q1 + q2)"),
            ("g_2", "m2*g*r2*cos(q1 + q2)"),
        ],
    );
}

#[test]
fn a_revolute_and_a_prismatic_joint_print_as_in_textbooks() {
    assert_prints(
        &fixture("rp"),
        &[
            ("M_1_1", "m1*r1^2 + m2*q2^2 + I1 + I2"),
            ("M_2_2", "m2"),
            ("b_1_1_2", "2*m2*q2"),
            ("b_2_1_1", "-m2*q2"),
            ("g_1", "g*(m1*r1 + m2*q2)*cos(q1)"),
            ("g_2", "m2*g*sin(q1)"),
        ],
    );
}

#[test]
fn a_scara_prints_as_in_textbooks() {
    assert_prints(
        &fixture("scara"),
        &[
            (
                "M_1_1",
                "m1*r1^2 + m2*(l1^2 + r2^2 + 2*l1*r2*cos(q2)) \
                 + (m3 + m4)*(l1^2 + l2^2 + 2*l1*l2*cos(q2)) + I1 + I2 + I3 + I4",
            ),
            ("M_1_2", "m2*r2*(r2 + l1*cos(q2)) + l2*(m3 + m4)*(l2 + l1*cos(q2)) + I2 + I3 + I4"),
            ("M_1_4", "-I4"),
            ("M_2_2", "m2*r2^2 + l2^2*(m3 + m4) + I2 + I3 + I4"),
            ("M_2_4", "-I4"),
            ("M_3_3", "m3 + m4"),
            ("M_4_4", "I4"),
            ("b_1_1_2", "-2*l1*(m2*r2 + l2*(m3 + m4))*sin(q2)"),
            ("b_1_2_2", "-l1*(m2*r2 + l2*(m3 + m4))*sin(q2)"),
            ("b_2_1_1", "l1*(m2*r2 + l2*(m3 + m4))*sin(q2)"),
            ("g_3", "-g*(m3 + m4)"),
        ],
    );
}

/// The equations of the planar arm with three revolute joints, derived by hand link by link, with the symbol r for the
/// distances of the centers of mass. All entries except one equal these symbol for symbol; that one is a symbol
/// shorter, because l2 and r3 are factored out.
#[test]
fn the_planar_arm_of_three_joints_prints_as_in_textbooks() {
    let robot = robot_testing::robot("planar_3r");
    let found = printed(&robot, &usual());
    let printed_so = [
        (
            "M_1_1",
            "m1*r1^2 + I1 + m2*(l1^2 + r2^2 + 2*l1*r2*cos(q2)) + I2 + m3*(l1^2 + l2^2 + r3^2 \
             + 2*(l1*l2*cos(q2) + l1*r3*cos(q2 + q3) + l2*r3*cos(q3))) + I3",
        ),
        ("M_1_3", "m3*r3*(r3 + l1*cos(q2 + q3) + l2*cos(q3)) + I3"),
        ("M_2_2", "m2*r2^2 + I2 + m3*(l2^2 + r3^2 + 2*l2*r3*cos(q3)) + I3"),
        ("M_2_3", "m3*r3*(r3 + l2*cos(q3)) + I3"),
        ("M_3_3", "m3*r3^2 + I3"),
        ("b_1_1_2", "-2*l1*((m2*r2 + m3*l2)*sin(q2) + m3*r3*sin(q2 + q3))"),
        ("b_1_1_3", "-2*m3*r3*(l1*sin(q2 + q3) + l2*sin(q3))"),
        ("b_1_2_2", "-l1*(m2*r2 + m3*l2)*sin(q2) - m3*l1*r3*sin(q2 + q3)"),
        ("b_1_2_3", "-2*m3*r3*(l1*sin(q2 + q3) + l2*sin(q3))"),
        ("b_1_3_3", "-m3*r3*(l1*sin(q2 + q3) + l2*sin(q3))"),
        ("b_2_1_1", "l1*(m2*r2 + m3*l2)*sin(q2) + m3*l1*r3*sin(q2 + q3)"),
        ("b_2_1_3", "-2*m3*l2*r3*sin(q3)"),
        ("b_2_2_3", "-2*m3*l2*r3*sin(q3)"),
        ("b_2_3_3", "-m3*l2*r3*sin(q3)"),
        ("b_3_1_1", "m3*r3*(l1*sin(q2 + q3) + l2*sin(q3))"),
        ("b_3_1_2", "2*m3*l2*r3*sin(q3)"),
        ("b_3_2_2", "m3*l2*r3*sin(q3)"),
        (
            "g_1",
            "g*((m1*r1 + l1*(m2 + m3))*cos(q1) + (m2*r2 + m3*l2)*cos(q1 + q2) + m3*r3*cos(q1 + q2 + q3))",
        ),
        ("g_2", "g*(m2*r2 + m3*l2)*cos(q1 + q2) + m3*g*r3*cos(q1 + q2 + q3)"),
        ("g_3", "m3*g*r3*cos(q1 + q2 + q3)"),
    ];
    for (name, expected) in printed_so {
        assert_eq!(found[name], expected, "{name}");
    }
    let by_hand = "m2*r2*(r2 + l1*cos(q2)) + m3*(l2^2 + r3^2 + l1*l2*cos(q2) + l1*r3*cos(q2 + q3) \
                   + 2*l2*r3*cos(q3)) + I2 + I3";
    let graph = Graph::new();
    let both = [found["M_1_2"].as_str(), by_hand].map(|text| graph.parse(text).unwrap());
    assert!(equal(both[0], both[1]).unwrap(), "{}", found["M_1_2"]);
    assert!(length(&found["M_1_2"]) < length(by_hand), "{}", found["M_1_2"]);
    let known = |name: &String| {
        name.starts_with(['Q', 'w'])
            || name == "M_1_2"
            || printed_so.iter().any(|(known, _)| known == name)
    };
    let others: Vec<&String> = found.keys().filter(|name| !known(name)).collect();
    assert!(others.is_empty(), "{others:?}");
}

/// The mass matrix and the gravity terms. The textbooks do not give the coefficients of velocities for this arm; they
/// were derived by hand.
#[test]
fn the_first_three_joints_of_a_puma_print_as_in_textbooks() {
    let found = printed(&fixture("elbow"), &usual());
    for (name, expected) in [
        ("M_1_1", "m2*r2^2*cos(q2)^2 + m3*(a2*cos(q2) + r3*cos(q2 + q3))^2 + I1"),
        ("M_2_2", "m2*r2^2 + m3*(a2^2 + r3^2 + 2*a2*r3*cos(q3))"),
        ("M_2_3", "m3*r3*(r3 + a2*cos(q3))"),
        ("M_3_3", "m3*r3^2"),
        ("g_2", "g*(m2*r2 + m3*a2)*cos(q2) + m3*r3*g*cos(q2 + q3)"),
        ("g_3", "m3*r3*g*cos(q2 + q3)"),
        ("b_2_2_3", "-2*m3*a2*r3*sin(q3)"),
        ("b_2_3_3", "-m3*a2*r3*sin(q3)"),
        ("b_3_2_2", "m3*a2*r3*sin(q3)"),
        ("b_1_1_3", "-2*m3*r3*(a2*cos(q2) + r3*cos(q2 + q3))*sin(q2 + q3)"),
        ("b_3_1_1", "m3*r3*(a2*cos(q2) + r3*cos(q2 + q3))*sin(q2 + q3)"),
    ] {
        assert_eq!(found[name], expected, "{name}");
    }
    let by_hand = "-2*m2*r2^2*sin(q2)*cos(q2) \
                   - 2*m3*(a2*sin(q2) + r3*sin(q2 + q3))*(a2*cos(q2) + r3*cos(q2 + q3))";
    let graph = Graph::new();
    let both = [found["b_1_1_2"].as_str(), by_hand].map(|text| graph.parse(text).unwrap());
    assert!(equal(both[0], both[1]).unwrap());
    assert!(length(&found["b_1_1_2"]) <= length(by_hand), "{}", found["b_1_1_2"]);
}

/// The number of printed symbols in a text: each name, number, sign, exponent and pair of brackets counts as one, as
/// does the sine or cosine of a sum of joint positions.
fn length(text: &str) -> usize {
    let mut count = 0;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.'));
        let word = word.unwrap_or(rest.len());
        let is_call = matches!(&rest[..word], "sin" | "cos");
        let taken = match first {
            _ if is_call => rest.find(')').unwrap() + 1,
            _ if word > 0 => word,
            _ => 1,
        };
        count += usize::from(word > 0 || matches!(first, '+' | '-' | '('));
        rest = &rest[taken..];
    }
    count
}

#[test]
fn a_length_counts_symbols() {
    for (text, expected) in [
        ("m2*r2*(r2 + l1*cos(q2)) + I2", 9),
        ("-2*m2*l1*r2*sin(q2 + q3)^2", 7),
        ("H_1_2 + 0.5*(a + b)", 7),
    ] {
        assert_eq!(length(text), expected, "{text}");
    }
}

/// The bounds are the results of searches by hand and by program over all entries of the mass matrix, the coefficients
/// of velocities, gravity and the wrenches, and over whole joint torques, plus a few percent.
#[test]
fn equations_are_short() {
    for (name, bound, by_others, whole) in [
        ("planar_2r", 86, 82, 100),
        ("planar_3r", 320, 252, 300),
        ("scara", 125, 101, 186),
        ("trttr1", 180, 166, 199),
        ("puma560", 2070, 1255, 2300),
    ] {
        let robot = robot_testing::robot(name);
        let total = |options: &EquationOptions, is_torque: bool| -> usize {
            let all = printed(&robot, options).into_iter();
            all.filter(|(name, _)| name.starts_with('Q') == is_torque)
                .map(|(_, text)| length(&text))
                .sum()
        };
        let found = [
            total(&usual(), false),
            total(&EquationOptions { references: true, ..usual() }, false),
            total(&EquationOptions { form: Form::Collected, ..usual() }, true),
        ];
        let bounds = [bound, by_others, whole];
        assert!(found.iter().zip(&bounds).all(|(a, b)| a <= b), "{name}: {found:?} {bounds:?}");
    }
}

/// The bounds are the lengths of the equations when all coefficients were written in terms of named parts, with a tip and
/// without. Now the short coefficients are written out, as are the last rows of the mass matrix and, in arms with a tip,
/// the gravity terms.
#[test]
fn short_coefficients_of_seven_joints_cost_no_symbols() {
    for (name, has_tip, bound) in
        [("iiwa", true, 9_243), ("panda", true, 17_976), ("iiwa", false, 8_313)]
    {
        let options =
            EquationOptions { references: true, snap: Some(1e-5), digits: Some(10), ..usual() };
        let mut robot = robot_testing::robot(name);
        if !has_tip {
            robot.frames.iter_mut().for_each(|frame| frame.wrench = None);
        }
        let found = printed(&robot, &options);
        let total: usize = found.values().map(|text| length(text)).sum();
        assert!(total <= bound, "{name}: {total}");
        let last = if has_tip { vec!["M_6_6", "M_7_7", "g_6"] } else { vec!["M_6_6", "M_7_7"] };
        for name in last {
            let text = &found[name];
            assert!(!text.contains("x_") && length(text) < 80, "{name}: {text}");
        }
    }
}

/// The joint torques according to the printed equations, with definitions substituted.
fn torques<'g>(graph: &'g Graph, robot: &Robot, options: &EquationOptions) -> Vec<Expr<'g>> {
    let kinds = EquationOptions::default().kinds;
    let printed = equations(robot, &EquationOptions { kinds, ..options.clone() }).unwrap();
    let mut values: BTreeMap<String, Expr<'g>> = BTreeMap::new();
    for equation in printed.definitions().chain(printed.quantities()) {
        let value = graph.parse(&equation.text).unwrap();
        let value = value.substitute(|name| values.get(name).copied());
        values.insert(equation.name.clone(), value);
    }
    (1..=robot.degrees_of_freedom()).map(|number| values[&format!("Q{number}")]).collect()
}

/// The robot with the axis of each joint from index `first` on parallel to that of its parent.
fn with_parallel_axes(mut robot: Robot, first: usize) -> Robot {
    for index in first..robot.links.len() {
        let Some(parent) = robot.links[index].parent else { continue };
        let axis = robot.links[parent].joint.axis.clone();
        let link = &mut robot.links[index];
        link.placement.0.retain(|step| matches!(step, Move::Translate(_)));
        link.joint.axis = axis;
    }
    robot
}

/// Compares two expressions in three states, relative to the sum of their values.
fn assert_equal_at_states(
    what: &str,
    graph: &Graph,
    found: Expr<'_>,
    derived: Expr<'_>,
    random: &mut Random,
) {
    for _ in 0..3 {
        let count = graph.symbol_count();
        let values: Vec<f64> = (0..count).map(|_| random.uniform(0.2, 1.2)).collect();
        let at = |symbol: robot_symbolic::SymbolId| values[symbol.index()];
        let (found, derived) = (found.evaluate(at), derived.evaluate(at));
        let error = (found - derived).abs();
        assert!(error <= 1e-9 * derived.abs().max(1.0), "{what}: {found} {derived}");
    }
}

/// The number of joint torques of a random robot, in several forms, that are proved to be those derived; the others are
/// compared at random states.
fn proved(number: usize) -> usize {
    let mut random = Random::new(20_261_123 + number as u64);
    let (mut proved, mut is_short) = (0, true);
    let joints = 1 + number % 4;
    let recipe = Recipe { mimic: number % 5 == 4, ..Recipe::tree(joints) };
    let first = 1 + number % 3;
    let robot = with_parallel_axes(robots::robot(&mut random, &recipe), first);
    let robot = if number.is_multiple_of(7) { robots::parameterized(&robot) } else { robot };
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::EXACT, None);
    let kind = FunctionKind::InverseDynamics(Effects::WRENCH);
    let derived = derivation.functions(kind).remove(0).outputs.remove(0).values;
    for (form, angle_sums) in [
        (Form::Grouped, None),
        (Form::Grouped, Some(AngleSums::Expand)),
        (Form::Collected, None),
        (Form::Expanded, Some(AngleSums::Keep)),
    ] {
        // Whole joint torques of arms with tilted axes would fill pages.
        if form != Form::Grouped && first > 1 && joints > 1 {
            continue;
        }
        let options = EquationOptions { form, angle_sums, references: true, ..usual() };
        let found = torques(&graph, &robot, &options);
        for (found, derived) in found.iter().zip(&derived) {
            // Equal terms prove equality, but roots in the directions of tilted axes may hide it, or make too many
            // terms; then those of the other joints are too many, too.
            let proof = if is_short { equal(*found, *derived) } else { Ok(false) };
            is_short &= proof.is_ok();
            if proof == Ok(true) {
                proved += 1;
            } else {
                let what = format!("robot {number}, {options:?}");
                assert_equal_at_states(&what, &graph, *found, *derived, &mut random);
            }
        }
    }
    proved
}

#[test]
fn equations_of_a_hundred_random_robots_are_those_derived() {
    let proved: usize = (0..100).into_par_iter().map(proved).sum();
    assert!(proved > 500, "{proved}");
}
