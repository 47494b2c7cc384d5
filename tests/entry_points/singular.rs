//! Forward dynamics as compiled code if the mass matrix is singular: all forms must give NaN instead of finite numbers
//! with the wrong sign.

use std::fmt::Write as _;

use robot_build::{Effects, FunctionKind, Functions, Options, Scalar, Source, generate};

use crate::package::{Package, dependency};

const WRIST: &str = include_str!("../fixtures/gimbals/wrist.toml");
/// A pendulum whose inertia is a parameter, so that it can be set to an impossible value.
const PENDULUM: &str = "format = 1
[robot]
name = \"pendulum\"
[parameters]
I = 0.1
[[link]]
name = \"1\"
joint = { type = \"revolute\", axis = \"y\" }
mass = 2
center_of_mass = [0.5, 0, 0]
inertia = { yy = \"I\", unchecked = true }
";

const MAIN: &str = r#"
fn main() {
    use robot_runtime::F64x4;
    let (qd, tau) = ([0.0; 3], [1.0, 0.0, 0.0]);
    let near = wrist_double::wrist::forward_dynamics(&[0.3, 1e-7, 0.4], &qd, &tau);
    assert!(near[0] > 0.0 && near[2] < 0.0, "{near:?}");
    let there = wrist_double::wrist::forward_dynamics(&[0.3, 0.0, 0.4], &qd, &tau);
    assert!(there.iter().all(|entry| entry.is_nan()), "{there:?}");

    let single = |q2: f32| {
        wrist_single::wrist::forward_dynamics(&[0.3, q2, 0.4], &[0.0; 3], &[1.0, 0.0, 0.0])
    };
    let near = single(1e-4);
    assert!(near[0] > 0.0 && near[2] < 0.0, "{near:?}");
    assert!(single(0.0).iter().all(|entry| entry.is_nan()));

    let q2 = F64x4::from_array([0.5, 0.0, 1e-7, -1e-7]);
    let q = [F64x4::splat(0.3), q2, F64x4::splat(0.4)];
    let lanes = |entries: [f64; 3]| entries.map(F64x4::splat);
    let model = wrist_double::wrist::Model::NOMINAL;
    let found = model.forward_dynamics_generic(&q, &lanes(qd), &lanes(tau)).map(F64x4::to_array);
    for entry in found {
        assert!(entry[0].is_finite() && entry[1].is_nan() && entry[2].is_finite(), "{found:?}");
    }
    let (states, speeds, forces) = ([[0.3, 0.5, 0.4], [0.3, 0.0, 0.4]], [qd; 2], [tau; 2]);
    let mut found = [[0.0; 3]; 2];
    model.forward_dynamics_batch(&states, &speeds, &forces, &mut found);
    assert!(found[0].iter().all(|entry| entry.is_finite()) && found[1].iter().all(|entry| entry.is_nan()));

    use pendulum_double::pendulum::{Model, Parameters};
    // A model is a constant still, with a reciprocal in it.
    const RIGHT: Model = Model::new(&Parameters { I: 0.1 });
    const WRONG: Model = Model::new(&Parameters { I: -9.0 });
    assert!(RIGHT.forward_dynamics(&[0.0], &[0.0], &[1.0])[0].is_finite());
    assert!(WRONG.forward_dynamics(&[0.0], &[0.0], &[1.0])[0].is_nan());
    println!("done");
}
"#;

#[test]
fn what_is_singular_has_no_number() {
    let runtime = dependency("robot_runtime", ", features = [\"std\"]");
    let package = Package::new("singular", &format!("[dependencies]\n{runtime}"));
    let mut modules = String::new();
    for (name, text, scalar) in [
        ("wrist_double", WRIST, Scalar::F64),
        ("wrist_single", WRIST, Scalar::F32),
        ("pendulum_double", PENDULUM, Scalar::F64),
    ] {
        let source = Source { name: format!("{name}.toml"), text: text.to_owned() };
        let functions = Functions::Chosen(vec![FunctionKind::ForwardDynamics(Effects::NONE)]);
        let batch = Some(8);
        let options = Options { functions, scalar, generic: true, batch, ..Options::default() };
        let code = generate(&source, &options).unwrap().code;
        writeln!(modules, "mod {name} {{\n{code}\n}}").unwrap();
    }
    package.write("src/main.rs", &format!("#![allow(dead_code)]\n{modules}\n{MAIN}"));
    assert_eq!(package.run(&["run"]).trim(), "done");
    assert_eq!(package.run(&["run", "--release"]).trim(), "done");
}
