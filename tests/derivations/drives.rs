//! A second derivation of gyroscopic rotors: the rotor is a separate link on the carrier that turns with the coordinate
//! of its joint, and Lagrange's equations are derived for this mechanism.

use robot_dynamics::economical::{
    Plan, Recursion,
    plan::{LinkPlan, Turn},
};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_model::robot::{Body, Inertia, Joint, JointKind, Link, Placement, Robot};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::polynomial::expands_to_zero;
use robot_symbolic::{Expr, Formula, Graph};

use robot_testing::energy::{Motion, energies};

const PLAIN: Effects = Effects { wrench: false, friction: false };

/// An arm with three joints about or along coordinate axes, whose rotors have the symbols `J2`, `N2`, `J3`, `N3`.
fn arm(axes: [&str; 3], kinds: [&str; 3]) -> Robot {
    let link = |number: usize| {
        let (axis, kind) = (axes[number - 1], kinds[number - 1]);
        let drive = match number {
            1 => String::new(),
            _ => format!(
                "drive = {{ rotor_inertia = \"J{number}\", gear_ratio = \"N{number}\", gyroscopic = true }}"
            ),
        };
        format!(
            "[[link]]\nname = \"{number}\"\njoint = {{ type = \"{kind}\", axis = \"{axis}\" }}\n\
             origin = {{ xyz = [0.2, 0, 0.1] }}\nmass = {number}\ncenter_of_mass = [0.1, 0.05, 0]\n\
             inertia = {{ xx = 0.2, yy = 0.3, zz = 0.4 }}\n{drive}\n"
        )
    };
    let unit = |number: usize| if kinds[number - 1] == "prismatic" { "1/m" } else { "1" };
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nJ2 = {{ value = 1e-4, unit = \"kg m^2\" }}\n\
         J3 = {{ value = 2e-4, unit = \"kg m^2\" }}\nN2 = {{ value = 100, unit = \"{}\" }}\n\
         N3 = {{ value = -50, unit = \"{}\" }}\n{}{}{}",
        unit(2),
        unit(3),
        link(1),
        link(2),
        link(3)
    );
    robot_testing::read("arm.toml", &text)
}

/// The robot with every gyroscopic rotor as a separate link, whose inertia is subtracted from that of its carrier.
fn with_rotors_as_links(robot: &Robot) -> Robot {
    let mut explicit = robot.clone();
    for index in 0..robot.links.len() {
        let link = robot.links[index].clone();
        let Some(carrier) = link.parent.filter(|_| link.drive.gyroscopic) else { continue };
        explicit.links[index].drive.rotor_inertia = formula("0");
        let (turns, inertia) = (&link.drive.gear_ratio, &link.drive.rotor_inertia);
        let ratio = format!("({})*({})", turns.text(), link.joint.ratio.text());
        explicit.links.push(Link {
            name: format!("rotor {}", link.name),
            joint: Joint {
                kind: JointKind::Revolute,
                ratio: formula(&ratio),
                offset: formula("0"),
                ..link.joint.clone()
            },
            bodies: vec![rotor(&link, inertia.text(), Placement::default())],
            drive: robot_model::robot::Drive::none(),
            ..link.clone()
        });
        let taken = format!("-({})", inertia.text());
        let locked = rotor(&link, &taken, link.placement.clone());
        explicit.links[carrier].bodies.push(locked);
    }
    explicit
}

/// A body without mass that only has an inertia about the joint axis, which is a coordinate axis.
fn rotor(link: &Link, inertia: &str, placement: Placement) -> Body {
    let moment = |axis: usize| {
        let along = link.joint.axis[axis].as_number().unwrap();
        formula(if along.is_zero() { "0" } else { inertia })
    };
    let zero = || formula("0");
    let [xx, yy, zz] = [0, 1, 2].map(moment);
    let inertia = Inertia { xx, yy, zz, xy: zero(), xz: zero(), yz: zero() };
    Body { name: "rotor".to_owned(), mass: zero(), placement, inertia }
}

fn formula(text: &str) -> Formula {
    Formula::parse(text).unwrap()
}

/// Compares both recursions for the robot with Lagrange's equations for the mechanism in which the rotors are links.
fn check(robot: &Robot, name: &str) {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::EXACT);
    assert!(mechanism.links.iter().any(|link| !link.rotor_coupling.is_zero()), "{name}");
    // The working frames are in the file's axes, so that no sines of additional angles occur.
    let link = LinkPlan { turn: Turn::File, ..LinkPlan::BASIC };
    let recursion = Recursion::new(&mechanism, &Plan::uniform(robot.links.len(), &link)).unwrap();
    let forces = [newton_euler(&mechanism, PLAIN).joint_torques, recursion.inverse_dynamics(false)];
    let explicit = with_rotors_as_links(robot);
    let explicit = Mechanism::new(&explicit, &graph, &MechanismOptions::EXACT);
    let motion = Motion::new(&explicit);
    let (kinetic, potential) = energies(&explicit, &motion);
    for (index, (q, qd)) in motion.q.iter().zip(&motion.qd).enumerate() {
        let rate = motion.rate(&[kinetic.derivative(*qd)])[0];
        let force = rate - (kinetic - potential).derivative(*q);
        for (recursion, forces) in ["iterations", "economical recursion"].iter().zip(&forces) {
            let same = expands_to_zero(force - forces[index]).unwrap();
            assert!(same, "{name}: Lagrange's Q{} is not that of the {recursion}", index + 1);
        }
    }
    let same = expands_to_zero(recursion.kinetic_energy() - kinetic);
    assert!(same.unwrap(), "{name}: the kinetic energy");
}

#[test]
fn rotors_agree_with_lagrange_for_rotors_as_links() {
    let (revolute, prismatic) = ("revolute", "prismatic");
    check(&arm(["z", "x", "y"], [revolute; 3]), "zxy");
    check(&arm(["z", "y", "-y"], [revolute; 3]), "parallel axes");
    check(&arm(["y", "x", "z"], [revolute, prismatic, revolute]), "a screw drive");
    check(&arm(["x", "-z", "x"], [revolute, revolute, prismatic]), "a screw drive at the end");
}

#[test]
fn branched_robots_with_joints_that_follow_agree_with_lagrange() {
    let mut checked = 0;
    for seed in 0..60 {
        let recipe = Recipe { drives: true, mimic: true, ..Recipe::tree(3) };
        let mut robot = robots::robot(&mut Random::new(seed), &recipe);
        // Exact sines of arbitrary angles would expand to long sums, so only right angles are used, and no friction.
        for link in &mut robot.links {
            link.placement = Placement::default();
            link.bodies.iter_mut().for_each(|body| body.placement.0.truncate(1));
        }
        let along = |link: &Link| {
            link.joint.axis.iter().filter(|one| one.as_number().unwrap().is_zero()).count() == 2
        };
        let carried = |link: &Link| link.drive.gyroscopic && link.parent.is_some();
        if robot.links.iter().all(along) && robot.links.iter().any(carried) {
            check(&robot, &format!("seed {seed}"));
            checked += 1;
        }
    }
    assert!(checked >= 4, "{checked}");
}

/// The expression with the inertia of every rotor set to 0.
fn without_rotors(expr: Expr<'_>) -> Expr<'_> {
    expr.substitute(|name| name.starts_with('J').then(|| expr.graph().zero()))
}

/// Joint 2 is about the axis of joint 1: T = ½ I₁ q̇₁² + ½ I₂ (q̇₁ + q̇₂)² + ½ J (q̇₁ + N q̇₂)² − ½ J q̇₁². The last
/// term belongs to the locked rotor, which is part of I₁. Q₁ therefore contains J N q̈₂, and Q₂ contains J N q̈₁ + J N²
/// q̈₂.
#[test]
fn a_rotor_about_its_carriers_axis_in_closed_form() {
    let robot = arm(["z", "z", "z"], ["revolute"; 3]);
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    let forces = newton_euler(&mechanism, PLAIN).joint_torques;
    // Link 2, which turns with q1 + q2, carries the rotor of joint 3.
    let expected = [
        "J2*N2*qdd2 + J3*N3*qdd3",
        "J2*N2*qdd1 + J2*N2^2*qdd2 + J3*N3*qdd3",
        "J3*N3*(qdd1 + qdd2) + J3*N3^2*qdd3",
    ];
    for (force, expected) in forces.into_iter().zip(expected) {
        let expected = graph.parse(expected).unwrap();
        assert!(expands_to_zero(force - without_rotors(force) - expected).unwrap());
    }
}

/// The axis of the rotor is perpendicular to its carrier's: its moment J N q̇₂ q̇₁ z × x = J N q̇₁ q̇₂ y on the carrier
/// is supported by the bearing of the first joint and contributes no torque.
#[test]
fn a_rotor_across_its_carriers_axis_in_closed_form() {
    let robot = arm(["z", "x", "x"], ["revolute"; 3]);
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    let moment = newton_euler(&mechanism, PLAIN).wrenches[0].moment;
    let only_second = |name: &str| match name {
        "J2" | "N2" | "q1" | "q2" | "q3" | "qd1" | "qd2" | "qdd2" => None,
        _ => Some(graph.zero()),
    };
    let of_rotor = |expr: Expr<'_>| {
        (expr - without_rotors(expr)).evaluate(|symbol| match graph.symbol_name(symbol).as_str() {
            "J2" => 1e-4,
            "N2" => 100.0,
            "qd1" => 3.0,
            "qd2" => 5.0,
            "qdd2" => 7.0,
            _ => 0.0,
        })
    };
    let found = moment.0.map(|component| of_rotor(component.substitute(only_second)));
    // J N (q̈₂ x + q̇₁ q̇₂ y)
    let expected = [0.01 * 7.0, 0.01 * 15.0, 0.0];
    for (axis, (found, expected)) in ["x", "y", "z"].iter().zip(found.into_iter().zip(expected)) {
        let what = "the moment of the rotor of joint 2 on link 1";
        assert!((found - expected).abs() < 1e-12, "{what}, {axis}: {found} for {expected}");
    }
}

/// If the base carries the rotor, or if the file does not request gyroscopic moments, only the reflected inertia
/// remains.
#[test]
fn a_rotor_on_the_base_is_its_reflected_inertia() {
    let text = |gyroscopic: bool| {
        format!(
            "format = 1\n[robot]\nname = \"a\"\n[[link]]\nname = \"1\"\n\
             joint = {{ type = \"revolute\", axis = \"z\" }}\nmass = 1\ncenter_of_mass = [0.1, 0, 0]\n\
             inertia = {{ xx = 1, yy = 1, zz = 1 }}\n\
             drive = {{ rotor_inertia = 1e-4, gear_ratio = 100, gyroscopic = {gyroscopic} }}\n"
        )
    };
    let graph = Graph::new();
    let forces = |text: &str| {
        let robot = robot_testing::read("a.toml", text);
        let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
        newton_euler(&mechanism, PLAIN).joint_torques
    };
    let force = forces(&text(true));
    assert_eq!(force, forces(&text(false)));
    // The expected value is 1 + m r² + N² J = 2.01.
    assert!((force[0].derivative(graph.symbol("qdd1")).evaluate(|_| 0.0) - 2.01).abs() < 1e-15);
}
