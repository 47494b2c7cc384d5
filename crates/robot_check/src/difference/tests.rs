#![allow(clippy::unwrap_used, clippy::panic)]

use robot_model::description;
use robot_model::robot::{JointKind, Robot};

use super::*;

/// The planar arm with another mass of its second link.
fn arm(mass: &str) -> Robot {
    let text = robot_testing::PLANAR_2R;
    let mut robot = description::read("robot.toml", text).unwrap().robot;
    let value = robot_symbolic::Rational::from_decimal(mass);
    robot.parameters.iter_mut().find(|one| one.name == "m2").unwrap().value = value;
    robot
}

fn compared(a: &Robot, b: &Robot) -> Difference {
    let code = [robot_build::Options::default(), robot_build::Options::default()];
    difference(a, b, &Options { code, seed: 7, states: 50 })
}

#[test]
fn a_robot_does_not_differ_from_itself() {
    let robot = arm("1");
    let found = compared(&robot, &Robot { name: "other".to_owned(), ..robot.clone() });
    assert!(found.is_none(), "{found:?}");
    assert!(found.torques.unwrap().joints.iter().all(|one| one.torques[0] == one.torques[1]));
}

#[test]
fn a_value_changes_torques_and_no_term() {
    let found = compared(&arm("1"), &arm("2"));
    let [Change::Changed { kind: ItemKind::Parameter, name, properties }] = &found.changes[..]
    else {
        panic!("{:?}", found.changes);
    };
    assert_eq!((name.as_str(), properties[0].name.as_str()), ("m2", "value"));
    assert_eq!(properties[0].values, [Some("1".to_owned()), Some("2".to_owned())]);
    assert_eq!((found.equations.len(), found.operations), (0, Ok(vec![])));
    let torques = found.torques.unwrap();
    assert!(torques.joints.iter().all(|one| (one.torques[1] - one.torques[0]).abs() > 1.0));
    assert!(torques.joints.iter().all(|one| one.state.q.len() == 2));
}

#[test]
fn gravity_that_goes_takes_its_terms_along() {
    let robot = arm("1");
    let zero = || robot_symbolic::Formula::number(&robot_symbolic::Rational::ZERO);
    let still = Robot { gravity: [zero(), zero(), zero()], ..robot.clone() };
    let found = compared(&robot, &still);
    let last = found.equations.last().unwrap();
    let terms = last.terms.as_ref().unwrap();
    assert!(!terms.is_empty());
    assert!(terms.iter().all(|term| term.powers.contains('g') && term.coefficients[1].is_none()));
    let back = compared(&still, &robot);
    let appear = back.equations.last().unwrap().terms.as_ref().unwrap();
    assert!(appear.iter().all(|term| term.coefficients[0].is_none()));
    assert!(found.operations.unwrap().iter().any(|one| one.counts[1] < one.counts[0]));
}

#[test]
fn robots_that_share_no_states_say_so() {
    let robot = arm("1");
    let mut slides = robot.clone();
    slides.coordinates[1].kind = JointKind::Prismatic;
    slides.links[1].joint.kind = JointKind::Prismatic;
    assert!(compared(&robot, &slides).torques.unwrap_err().contains("different coordinates"));
    let mut limited = [robot.clone(), robot];
    for (one, from) in limited.iter_mut().zip([0, 2]) {
        let limits = [from, from + 1].map(|edge| robot_symbolic::Rational::new(edge, 1).unwrap());
        one.coordinates[0].limits = Some(limits);
    }
    let [a, b] = &limited;
    assert!(compared(a, b).torques.unwrap_err().contains("do not overlap"));
    let joints = compared(a, a).torques.unwrap().joints;
    assert!(joints.iter().all(|one| (0.0..=1.0).contains(&one.state.q[0])));
}

#[test]
fn snapping_and_a_payload_are_what_the_file_says() {
    let text = robot_testing::PLANAR_2R;
    let read = |text: &str| description::read("robot.toml", text).unwrap().robot;
    let snapping = text.replacen("[robot]\n", "[robot]\nsnap = 1e-4\n", 1);
    let frames = "[robot]\nbase_frames = \"denavit_hartenberg\"\n";
    let regrouping = text.replacen("[robot]\n", frames, 1);
    let carrying = format!("{text}\n[payload]\nparent = \"2\"\n");
    let said = |text: &str, name: &str| {
        let found = compared(&read(robot_testing::PLANAR_2R), &read(text));
        let [Change::Changed { kind: ItemKind::Robot, properties, .. }, ..] = &found.changes[..]
        else {
            panic!("{:?}", found.changes);
        };
        let one = properties.iter().find(|one| one.name == name).unwrap();
        one.values.clone().map(Option::unwrap_or_default)
    };
    assert_eq!(said(&snapping, "snapping tolerance"), ["", "1e-4 rad"]);
    let frames = ["file", "denavit_hartenberg"];
    assert_eq!(said(&regrouping, "frames of base parameters"), frames);
    let [none, payload] = said(&carrying, "payload");
    assert!(none.is_empty() && payload.starts_with("payload_mass, "), "{payload}");
}

/// A robot whose axes and lengths are symbols: with four links, it has more terms than the limit for expansions.
#[test]
fn an_equation_that_is_too_long_says_so() {
    let links = |length: &str| {
        let link = |number: usize| {
            format!(
                "[[link]]\nname = \"{number}\"\njoint = {{ type = \"revolute\", axis = [\"x\", \"y\", \"z\"] }}\n\
                 origin = {{ xyz = [\"{length}\", \"x\", \"y\"] }}\nmass = 1\n\
                 center_of_mass = [\"x\", \"y\", \"z\"]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
            )
        };
        let text = format!(
            "format = 1\n[robot]\nname = \"chain\"\n[parameters]\nx = {{ value = 1.0 }}\n\
             y = {{ value = 1.0 }}\nz = {{ value = 1.0 }}\n{}",
            (1..=4).map(link).collect::<String>()
        );
        description::read("chain.toml", &text).unwrap().robot
    };
    let found = compared(&links("x"), &links("z"));
    let refused = found.equations.iter().filter_map(|one| one.terms.as_ref().err());
    let reasons: Vec<&String> = refused.collect();
    assert!(!reasons.is_empty() && reasons.iter().all(|reason| reason.starts_with("expand")));
    assert!(!found.is_none());
}

/// The comparison of chains with sixty-four joints ends soon, because no joint torques are expanded after several that
/// are too long.
#[test]
fn long_chains_are_compared_soon() {
    let chain = |mass: &str| {
        let link = |number: usize| {
            let axis = ["x", "y", "z"][number % 3];
            format!(
                "[[link]]\nname = \"{number}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\" }}\n\
                 origin = {{ xyz = [0.1, 0.2, 0] }}\nmass = {mass}\ncenter_of_mass = [0.1, 0.2, 0.3]\n\
                 inertia = {{ xx = 0.2, yy = 0.2, zz = 0.3 }}\n"
            )
        };
        let links: String = (1..=64).map(link).collect();
        description::read("chain.toml", &format!("format = 1\n[robot]\nname = \"chain\"\n{links}"))
            .unwrap()
            .robot
    };
    let start = std::time::Instant::now();
    let found = compared(&chain("1"), &chain("2"));
    println!("difference of 64 joints: {:.2} s", start.elapsed().as_secs_f64());
    let reasons: Vec<&String> =
        found.equations.iter().filter_map(|one| one.terms.as_ref().err()).collect();
    let count = |text: &str| reasons.iter().filter(|reason| reason.starts_with(text)).count();
    assert_eq!(count("expand"), 3);
    assert!(count("not expanded") > 40);
    assert!(found.operations.is_err() && found.torques.is_ok());
}
