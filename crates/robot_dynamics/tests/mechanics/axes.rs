//! Joint axes of any length.

use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::{self as symbolic, MechanismOptions};
use robot_dynamics::newton_euler::newton_euler;
use robot_model::description::{read_toml, read_urdf};
use robot_model::functions::{Effects, FunctionKind};
use robot_numeric::Mechanism;
use robot_symbolic::{Graph, Polynomial, PolynomialOptions, walk};

/// The torques of a robot whose first joint axis is `axis`, from the numeric solver and from the expressions of the
/// code, and the robot's printed equations.
fn of_axis(axis: &str) -> (Vec<f64>, Vec<f64>, String) {
    let body = "mass = 1.0\ncenter_of_mass = [0.1, 0.2, 0.3]\n\
                inertia = { xx = 0.01, yy = 0.012, zz = 0.013 }\n";
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\na = 0.25\n\
         [[link]]\nname = \"1\"\njoint = {{ type = \"revolute\", axis = {axis} }}\n{body}\
         [[link]]\nname = \"2\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n\
         origin = {{ xyz = [\"a\", 0, 0.1] }}\n{body}"
    );
    let robot = read_toml("arm.toml", &text).unwrap_or_else(|found| panic!("{found}")).robot;
    let (q, qd, qdd) = ([0.3, 0.4], [1.0, 2.0], [0.5, -0.3]);
    let solver = Mechanism::nominal(&robot).unwrap();
    let solved = solver.inverse_dynamics(&q, &qd, &qdd).unwrap().iter().copied().collect();
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let function = derivation.functions(FunctionKind::InverseDynamics(Effects::NONE)).remove(0);
    let coded = walk::evaluate(&function.outputs[0].values, |symbol| {
        match graph.symbol_name(symbol).as_str() {
            "q1" => q[0],
            "q2" => q[1],
            "qd1" => qd[0],
            "qd2" => qd[1],
            "qdd1" => qdd[0],
            "qdd2" => qdd[1],
            _ => 0.25,
        }
    });
    let mechanism = symbolic::Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    let printed = newton_euler(&mechanism, Effects { wrench: false, friction: false });
    let printed = printed.joint_torques.iter().map(|torque| {
        Polynomial::of(*torque, &PolynomialOptions::default()).unwrap().to_text().unwrap()
    });
    (solved, coded, printed.collect::<Vec<_>>().join("\n"))
}

#[test]
fn the_length_of_an_axis_does_not_matter() {
    for (direction, others) in [
        (
            "[1, 0, 1]",
            &[
                "[1e155, 0, 1e155]",
                "[1e-160, 0, 1e-160]",
                "[1e-300, 0, 1e-300]",
                "[5e-324, 0, 5e-324]",
                "[1.7e308, 0, 1.7e308]",
                "[\"1e155\", 0, \"1e155\"]",
                "[0.1, 0, \"1/10\"]",
            ][..],
        ),
        ("[1, 0, 0]", &["[5e-324, 0, 0]", "[1e308, 0, 0]"]),
        ("[1, 1, 1]", &["[1e308, 1e308, 1e308]", "[5e-324, 5e-324, 5e-324]"]),
        ("[3, -4, 12]", &["[0.3e-200, -0.4e-200, 1.2e-200]", "[0.25, \"-1/3\", 1.0]"]),
    ] {
        let (solved, coded, printed) = of_axis(direction);
        assert!(printed.len() < 2000, "{printed}");
        for (a, b) in solved.iter().zip(&coded) {
            assert!((a - b).abs() < 1e-14, "{direction}: {solved:?} {coded:?}");
        }
        for other in others {
            let (other_solved, other_coded, other_printed) = of_axis(other);
            assert_eq!(other_coded, coded, "{other}");
            assert_eq!(other_printed, printed, "{other}");
            for (a, b) in other_solved.iter().zip(&solved) {
                assert!((a - b).abs() < 1e-14, "{other}: {other_solved:?} {solved:?}");
            }
        }
    }
}

#[test]
fn the_length_of_an_axis_in_urdf_does_not_matter() {
    let torque = |axis: &str| {
        let text = format!(
            "<robot name=\"arm\"><link name=\"base\"/><link name=\"1\"><inertial>\
             <origin xyz=\"0.1 0.2 0.3\"/><mass value=\"2\"/>\
             <inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.02\"/>\
             </inertial></link><joint name=\"1\" type=\"continuous\"><parent link=\"base\"/>\
             <child link=\"1\"/><axis xyz=\"{axis}\"/></joint></robot>"
        );
        let robot = read_urdf("arm.urdf", &text).unwrap_or_else(|found| panic!("{found}")).robot;
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let function = derivation.functions(FunctionKind::InverseDynamics(Effects::NONE)).remove(0);
        walk::evaluate(&function.outputs[0].values, |_| 0.3)
    };
    for length in ["1e200", "1e-200", "5e-324", "1.7e308"] {
        assert_eq!(torque(&format!("0 {length} {length}")), torque("0 1 1"), "{length}");
    }
}

/// An axis that is opposite to the one before only to rounding errors is not taken for a parallel one.
#[test]
fn nearly_opposite_axes_are_not_parallel() {
    let body = "mass = 1.0\ncenter_of_mass = [0.1, 0.2, 0.3]\n\
                inertia = { xx = 0.01, yy = 0.012, zz = 0.013 }\n";
    for angle in [0.3_f64, 0.7, 1.1, 1.9, 2.3, 2.7] {
        // About x by the angle; in the axes of link 2, minus z of link 1 is this axis.
        let (sine, cosine) = angle.sin_cos();
        let text = format!(
            "format = 1\n[robot]\nname = \"arm\"\n\
             [[link]]\nname = \"1\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n{body}\
             [[link]]\nname = \"2\"\njoint = {{ type = \"revolute\", axis = [0, {}, {}] }}\n\
             origin = {{ xyz = [0.25, 0, 0.1], rpy = [{angle:?}, 0, 0] }}\n{body}",
            -sine, -cosine
        );
        let robot = read_toml("arm.toml", &text).unwrap_or_else(|found| panic!("{found}")).robot;
        let (q, qd, qdd) = ([0.3, 0.4], [1.0, 2.0], [0.5, -0.3]);
        let solver = Mechanism::nominal(&robot).unwrap();
        let solved = solver.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let function = derivation.functions(FunctionKind::InverseDynamics(Effects::NONE)).remove(0);
        let coded = walk::evaluate(&function.outputs[0].values, |symbol| {
            let name = graph.symbol_name(symbol);
            let place = usize::from(name.ends_with('2'));
            [("qdd", qdd), ("qd", qd), ("q", q)]
                .iter()
                .find(|(prefix, _)| name.starts_with(prefix))
                .map_or(f64::NAN, |(_, values)| values[place])
        });
        for (a, b) in solved.iter().zip(&coded) {
            assert!((a - b).abs() < 1e-12, "{angle}: {solved:?} {coded:?}");
        }
    }
}
