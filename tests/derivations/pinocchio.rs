//! Compares the generated programs with values of Pinocchio (see `tests/fixtures/oracle`) for six arms, including every
//! function that Pinocchio has.

use std::collections::BTreeMap;

use robot_build::{Functions, Options, Programs, programs_of};
use robot_codegen::Interpreter;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::LINK_PARAMETERS;
use robot_model::robot::Robot;
use serde_json::Value;

use robot_testing::{largest_difference, magnitude};

const ARMS: [&str; 6] = ["ur5", "panda", "iiwa", "puma560", "stanford", "scara"];

/// The project's files contain angles as multiples of π/2, while the URDF files have eleven digits.
const TOLERANCE: f64 = 1e-9;

/// A function, the names of the fixture's values for its inputs other than q and q̇, and those for its outputs.
type Held = (FunctionKind, &'static [(&'static str, &'static str)], &'static [&'static str]);

/// The functions whose outputs are values in the fixture.
const FUNCTIONS: [Held; 9] = [
    (FunctionKind::InverseDynamics(Effects::NONE), &[("qdd", "a")], &["tau"]),
    (FunctionKind::Gravity, &[], &["g"]),
    (FunctionKind::Bias, &[], &["nle"]),
    (FunctionKind::MassMatrix, &[], &["M"]),
    (FunctionKind::CoriolisMatrix, &[], &["C"]),
    (FunctionKind::ForwardDynamics(Effects::NONE), &[("tau", "aba_tau")], &["aba_a"]),
    (FunctionKind::Energies, &[], &["kinetic", "potential"]),
    (FunctionKind::InverseDynamicsDerivatives, &[("qdd", "a")], &["dtau_dq", "dtau_dv"]),
    (FunctionKind::ForwardDynamicsDerivatives, &[("tau", "aba_tau")], &["da_dq", "da_dv", "Minv"]),
];

/// The numbers of a value that is a list or a single number.
fn numbers(value: &Value) -> Vec<f64> {
    let number = |value: &Value| value.as_f64().unwrap();
    value.as_array().map_or_else(|| vec![number(value)], |list| list.iter().map(number).collect())
}

/// The name of the frame that [`with_frames`] adds to a link.
fn frame_at(link: &str) -> String {
    format!("at_{link}")
}

/// An arm of the project, with an additional frame on each of the given bodies that has none.
fn with_frames<'n>(name: &str, bodies: impl Iterator<Item = &'n String>) -> Robot {
    let known = robot_testing::robot(name).frames;
    let (_, mut text) =
        robot_testing::robot_files().into_iter().find(|(file, _)| file == name).unwrap();
    for body in bodies.filter(|body| known.iter().all(|frame| frame.name != **body)) {
        let frame = frame_at(body);
        text.push_str(&format!("\n[[frame]]\nname = \"{frame}\"\nparent = \"{body}\"\n"));
    }
    robot_testing::read(name, &text)
}

/// The programs of an arm and the states of its fixture.
struct Arm {
    name: &'static str,
    programs: Programs,
    fixture: Value,
    /// The largest error of each quantity.
    worst: BTreeMap<String, f64>,
}

impl Arm {
    fn new(name: &'static str) -> Arm {
        let path = format!("{}/tests/fixtures/oracle/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let fixture: Value = serde_json::from_str(&text).unwrap();
        let robot = with_frames(name, fixture["states"][0]["J"].as_object().unwrap().keys());
        let options = Options { functions: Functions::All, ..Options::default() };
        let programs = programs_of(robot, name, &options).unwrap();
        assert_eq!(fixture["states"].as_array().unwrap().len(), 8);
        Arm { name, programs, fixture, worst: BTreeMap::new() }
    }

    /// The outputs of a function in a state; `more` are its inputs other than q and q̇.
    fn call(&self, function: &str, state: &Value, more: &[(&str, &str)]) -> Vec<Vec<f64>> {
        let interpreter = Interpreter::new(&self.programs.module, &[]).unwrap();
        let inputs = &self.programs.module.function(function).unwrap().inputs;
        let names = [("q", "q"), ("qd", "v")];
        let keys = inputs.iter().map(|input| {
            let mut known = names.iter().chain(more);
            known.find(|(name, _)| *name == input.name).unwrap()
        });
        let given: Vec<(&str, Vec<f64>)> =
            keys.map(|(name, key)| (*name, numbers(&state[*key]))).collect();
        let given: Vec<(&str, &[f64])> =
            given.iter().map(|(name, values)| (*name, values.as_slice())).collect();
        let outputs = interpreter.call(function, &given).unwrap();
        outputs.into_iter().map(|output| output.values).collect()
    }

    /// Compares values with those of the fixture; the error is relative to the largest value, or to `least`.
    fn hold(&mut self, what: &str, found: &[f64], expected: &[f64], least: f64) {
        let error = largest_difference(found, expected) / magnitude(expected).max(least);
        assert!(error <= TOLERANCE, "{}: {what} is off by {error:e}", self.name);
        let worst = self.worst.entry(what.to_owned()).or_default();
        *worst = worst.max(error);
    }

    fn dynamics(&mut self, state: &Value) {
        for (kind, inputs, keys) in FUNCTIONS {
            let outputs = self.call(kind.name(), state, inputs);
            assert_eq!(outputs.len(), keys.len());
            for (output, key) in outputs.iter().zip(keys) {
                self.hold(key, output, &numbers(&state[*key]), 1e-3);
            }
        }
        // The columns of drives follow those of the links.
        let found = self.call("regressor", state, &[("qdd", "a")]).remove(0);
        let columns = LINK_PARAMETERS * self.programs.robot.links.len();
        let rows = self.programs.robot.degrees_of_freedom();
        let of_links = found.chunks(found.len() / rows).flat_map(|row| row[..columns].to_vec());
        self.hold("Y", &of_links.collect::<Vec<_>>(), &numbers(&state["Y"]), 1e-3);
    }

    /// Compares the poses of links and frames, and the Jacobians.
    fn kinematics(&mut self, state: &Value) {
        let robot = &self.programs.robot;
        let links: Vec<String> = robot.links.iter().map(|link| link.name.clone()).collect();
        let frames: Vec<String> = robot.frames.iter().map(|frame| frame.name.clone()).collect();
        let mut poses = 0;
        for (function, names) in [("forward_kinematics", &links), ("frame_poses", &frames)] {
            let outputs = self.call(function, state, &[]);
            for (index, name) in names.iter().enumerate() {
                let Some(expected) = state["poses"].get(name) else { continue };
                let (rotation, origin) = (&outputs[0][9 * index..], &outputs[1][3 * index..]);
                self.hold("poses", &rotation[..9], &numbers(&expected["R"]), 1.0);
                self.hold("poses", &origin[..3], &numbers(&expected["p"]), 1.0);
                poses += 1;
            }
        }
        assert!(poses >= links.len(), "{}: {poses} poses", self.name);
        for (body, expected) in state["J"].as_object().unwrap() {
            let frame = if frames.contains(body) { body.clone() } else { frame_at(body) };
            let jacobian = self.call(&format!("jacobian_{frame}"), state, &[]).remove(0);
            self.hold("J", &jacobian, &numbers(expected), 1.0);
            let drift = self.call(&format!("jacobian_dot_qd_{frame}"), state, &[]).remove(0);
            self.hold("Jdot_v", &drift, &numbers(&state["Jdot_v"][body]), 1.0);
        }
    }
}

#[test]
fn every_function_of_six_arms() {
    for name in ARMS {
        let mut arm = Arm::new(name);
        for state in arm.fixture["states"].as_array().unwrap().clone() {
            arm.dynamics(&state);
            arm.kinematics(&state);
        }
        for (what, worst) in &arm.worst {
            println!("{name}, {what}: worst error {worst:.1e}");
        }
    }
}
