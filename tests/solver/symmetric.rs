//! Last links that are axisymmetric about their joint axes: no joint torque depends on the positions of these joints,
//! and the code does not compute their sines.

use robot_build::{Functions, Options, Source, programs};
use robot_codegen::Module;
use robot_dynamics::economical::{
    Plan, Recursion,
    plan::{LinkPlan, Turn},
};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::functions::Effects;
use robot_symbolic::Graph;
use robot_symbolic::polynomial::expands_to_zero;

/// A last link with its joint axis and inertia.
struct Last {
    axis: &'static str,
    center_of_mass: &'static str,
    inertia: &'static str,
}

fn last(axis: &'static str, center_of_mass: &'static str, inertia: &'static str) -> Last {
    Last { axis, center_of_mass, inertia }
}

/// An arm with joints about x and y and a last joint about the given axis, which has a gyroscopic rotor.
fn arm(last: &Last) -> String {
    let Last { axis, center_of_mass, inertia } = last;
    let link = |name: &str, axis: &str, rest: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\" }}\n\
             origin = {{ xyz = [0.2, 0.1, 0.3] }}\nmass = 2\n{rest}\n"
        )
    };
    let body = "center_of_mass = [0.1, 0.05, 0.2]\ninertia = { xx = 0.2, yy = 0.3, zz = 0.4 }";
    let tool = format!(
        "center_of_mass = {center_of_mass}\ninertia = {inertia}\n\
         drive = {{ rotor_inertia = 1e-4, gear_ratio = 50, gyroscopic = true }}"
    );
    let [one, two, three] =
        [link("one", "x", body), link("two", "y", body), link("three", axis, &tool)];
    format!("format = 1\n[robot]\nname = \"arm\"\n{one}{two}{three}")
}

/// Compares the economical recursion with the paper's iterations as polynomials; returns the number of angles whose
/// sines the code computes.
fn sines(last: &Last) -> usize {
    let text = arm(last);
    let robot = robot_testing::read("arm.toml", &text);
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    // The working frames are in the file's axes, so that no sines of additional angles occur.
    let link = LinkPlan { turn: Turn::File, ..LinkPlan::BASIC };
    let recursion = Recursion::new(&mechanism, &Plan::uniform(3, &link)).unwrap();
    let paper = newton_euler(&mechanism, Effects { wrench: false, friction: false });
    for (joint, (force, expected)) in
        recursion.inverse_dynamics(false).into_iter().zip(paper.joint_torques).enumerate()
    {
        assert!(expands_to_zero(force - expected).unwrap(), "joint {joint} of {text}");
    }
    let source = Source { name: "arm.toml".to_owned(), text };
    let module = programs(&source, &Options::default()).unwrap().module;
    angles(&module, "inverse_dynamics")
}

/// The number of angles whose sines a function computes.
fn angles(module: &Module, name: &str) -> usize {
    module.function(name).unwrap().angles.results().len()
}

#[test]
fn a_symmetric_last_link_is_not_turned() {
    let about_z = last("z", "[0, 0, 0.05]", "{ xx = 0.02, yy = 0.02, zz = 0.03 }");
    let about_y = last("y", "[0, 0.05, 0]", "{ xx = 0.02, yy = 0.03, zz = 0.02 }");
    for last in [about_z, about_y] {
        // Gravity is along z, and the first joint, about x, turns the links on which it acts.
        assert_eq!(sines(&last), 2, "about {}", last.axis);
    }
}

#[test]
fn what_is_not_symmetric_is_turned() {
    let off_axis = last("z", "[0.001, 0, 0.05]", "{ xx = 0.02, yy = 0.02, zz = 0.03 }");
    let uneven = last("z", "[0, 0, 0.05]", "{ xx = 0.02, yy = 0.021, zz = 0.03 }");
    let askew = last("z", "[0, 0, 0.05]", "{ xx = 0.02, yy = 0.02, zz = 0.03, xz = 0.001 }");
    let about_another_axis = last("y", "[0, 0, 0]", "{ xx = 0.02, yy = 0.02, zz = 0.03 }");
    for last in [off_axis, uneven, askew, about_another_axis] {
        assert_eq!(sines(&last), 3, "{} {}", last.center_of_mass, last.inertia);
    }
}

#[test]
fn a_wrench_at_the_tip_needs_the_turn() {
    let (name, text) =
        robot_testing::robot_files().into_iter().find(|(name, _)| name == "puma560").unwrap();
    let source = Source { name, text };
    let options = Options { functions: Functions::All, ..Options::default() };
    let module = programs(&source, &options).unwrap().module;
    for name in [
        "inverse_dynamics",
        "mass_matrix",
        "bias",
        "gravity",
        "forward_dynamics",
        "energies",
        "coriolis_matrix",
        "inverse_dynamics_derivatives",
        "forward_dynamics_derivatives",
    ] {
        assert_eq!(angles(&module, name), 4, "{name}");
    }
    for name in ["inverse_dynamics_wrench", "forward_dynamics_wrench", "link_wrenches"] {
        assert_eq!(angles(&module, name), 5, "{name}");
    }
}
