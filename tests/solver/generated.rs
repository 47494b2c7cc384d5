//! Compares the code with the numeric solver: the straight-line programs in the interpreter for hundreds of random
//! robots, and the Rust code printed from them, compiled, for every robot file and twenty random robots.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use nalgebra::DVector;
use robot_build::{Effects, FunctionKind, Functions, Options, Programs, programs_of};
use robot_codegen::backend::rust::{self, RustOptions};
use robot_codegen::{Interpreter, Scalar};
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;

use robot_testing::solver::{expected, inputs, state};
use robot_testing::{largest_difference, magnitude, robot_files};

const TOLERANCE: f64 = 1e-12;
pub(crate) const FUNCTIONS: [FunctionKind; 5] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::InverseDynamics(Effects::WRENCH),
    FunctionKind::InverseDynamics(Effects::FRICTION),
    FunctionKind::InverseDynamics(Effects::BOTH),
    FunctionKind::LinkWrenches,
];

/// A robot, its programs, and states with the numeric solver for comparison.
pub(crate) struct Case {
    name: String,
    programs: Programs,
    pub(crate) states: Vec<State>,
    solver: robot_numeric::Mechanism,
}

impl Case {
    fn new(name: &str, robot: Robot, seed: u64, states: usize) -> Case {
        Case::of(&FUNCTIONS, name, robot, seed, states)
    }

    pub(crate) fn of(
        kinds: &[FunctionKind],
        name: &str,
        robot: Robot,
        seed: u64,
        states: usize,
    ) -> Case {
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let mut random = Random::new(seed);
        let states = (0..states).map(|_| state(&mut random, &solver, &robot)).collect();
        let kinds = kinds.iter().copied().filter(|kind| kind.missing_in(&robot).is_none());
        let options =
            Options { functions: Functions::Chosen(kinds.collect()), ..Options::default() };
        let programs = programs_of(robot, name, &options).unwrap();
        Case { name: format!("{name}, seed {seed}"), programs, states, solver }
    }

    /// The inputs of a function in a state, by name.
    fn inputs(&self, kind: FunctionKind, state: &State) -> Vec<(String, Vec<f64>)> {
        let function = self.programs.module.function(kind.name()).unwrap();
        let names = function.inputs.iter().map(|input| input.name.clone());
        inputs(&self.programs.robot, names, state)
    }

    /// Compares values, one list for each state, with the solver; returns the largest error relative to the largest
    /// value.
    fn assert_agrees(&self, kind: FunctionKind, values: &[Vec<f64>]) -> f64 {
        let robot = &self.programs.robot;
        let expected: Vec<Vec<f64>> =
            self.states.iter().map(|state| expected(robot, &self.solver, kind, state)).collect();
        if kind == FunctionKind::ForwardDynamics(Effects::NONE) {
            return self.assert_accelerations_agree(values, &expected);
        }
        let size = magnitude(expected.iter().flatten());
        let errors = values.iter().zip(&expected).map(|(a, b)| largest_difference(a, b));
        let worst = errors.fold(0.0, f64::max) / size.max(f64::MIN_POSITIVE);
        assert!(worst <= TOLERANCE, "{}: {} is off by {worst:e}", self.name, kind.name());
        worst
    }

    /// Compares values like [`Case::assert_agrees`], but by the torques that correspond to the accelerations: the mass
    /// matrix of dozens of joints is ill-conditioned, so no solver can compute the accelerations themselves to the last
    /// digits.
    fn assert_accelerations_agree(&self, values: &[Vec<f64>], expected: &[Vec<f64>]) -> f64 {
        let mut worst = 0.0_f64;
        for ((state, values), expected) in self.states.iter().zip(values).zip(expected) {
            let mass = self.solver.mass_matrix(&state.q).unwrap();
            let [values, expected] = [values, expected].map(|v| DVector::from_column_slice(v));
            let size = (mass.abs() * expected.abs()).amax();
            worst = worst.max((&mass * (values - expected)).amax() / size);
        }
        assert!(worst <= TOLERANCE, "{}: accelerations are off by {worst:e}", self.name);
        worst
    }

    pub(crate) fn interpret(&self) -> f64 {
        let interpreter = Interpreter::new(&self.programs.module, &[]).unwrap();
        let mut worst = 0.0_f64;
        for &kind in &self.programs.functions {
            let run = |state: &State| -> Vec<f64> {
                let inputs = self.inputs(kind, state);
                let inputs: Vec<(&str, &[f64])> = inputs
                    .iter()
                    .map(|(name, values)| (name.as_str(), values.as_slice()))
                    .collect();
                let outputs = interpreter.call(kind.name(), &inputs).unwrap();
                outputs.into_iter().flat_map(|output| output.values).collect()
            };
            let values: Vec<Vec<f64>> = self.states.iter().map(run).collect();
            worst = worst.max(self.assert_agrees(kind, &values));
        }
        worst
    }
}

#[test]
fn the_programs_of_every_robot_file() {
    for (name, text) in robot_files() {
        let worst = Case::new(&name, robot_testing::read(&name, &text), 11, 50).interpret();
        println!("{name}: worst error {worst:.1e}");
    }
}

#[test]
fn the_programs_of_two_hundred_random_robots() {
    let mut worst = 0.0_f64;
    for seed in 0..200 {
        let recipe = Recipe {
            drives: seed % 4 == 1,
            fixed: seed % 4 == 2,
            mimic: seed % 8 == 3,
            ..Recipe::serial(1 + seed as usize % 8)
        };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        let robot = if seed % 5 == 0 { robots::parameterized(&robot) } else { robot };
        worst = worst.max(Case::new("random robot", robot, seed, 50).interpret());
    }
    println!("200 random robots × 50 states: worst error {worst:.1e}");
}

/// Chains with dozens of joints: rounding errors grow with every joint, and passes must not mistake small values for
/// rounding errors.
#[test]
fn the_programs_of_long_chains() {
    let kinds = [
        FunctionKind::InverseDynamics(Effects::NONE),
        FunctionKind::MassMatrix,
        FunctionKind::Bias,
        FunctionKind::Gravity,
        FunctionKind::ForwardDynamics(Effects::NONE),
        FunctionKind::Energies,
        FunctionKind::CoriolisMatrix,
        FunctionKind::Regressor,
    ];
    for joints in [12, 16, 24, 32, 48] {
        let robot = robots::robot(&mut Random::new(joints), &Recipe::serial(joints as usize));
        for kind in kinds {
            let worst = Case::of(&[kind], "long chain", robot.clone(), joints, 3).interpret();
            println!("{joints} joints, {}: worst error {worst:.1e}", kind.name());
        }
    }
}

#[test]
fn the_compiled_code_of_every_robot_file_and_of_twenty_random_robots() {
    let files = robot_files().into_iter();
    let files =
        files.map(|(name, text)| Case::new(&name, robot_testing::read(&name, &text), 11, 50));
    let random_cases = (500..520).map(|seed| {
        let recipe = Recipe { drives: seed % 2 == 0, ..Recipe::tree(1 + seed as usize % 8) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        let robot = if seed % 3 == 0 { robots::parameterized(&robot) } else { robot };
        Case::new("compiled robot", robot, seed, 50)
    });
    let cases: Vec<Case> = files.chain(random_cases).collect();
    let output = run(&cases);
    let mut lines = output.lines();
    let mut worst = 0.0_f64;
    for case in &cases {
        for &kind in &case.programs.functions {
            let values: Vec<Vec<f64>> = case
                .states
                .iter()
                .map(|_| {
                    let line = lines.next().expect("a line per state");
                    line.split(' ').map(|bits| f64::from_bits(bits.parse().unwrap())).collect()
                })
                .collect();
            worst = worst.max(case.assert_agrees(kind, &values));
        }
    }
    assert_eq!(lines.next(), None);
    println!("{} compiled robots × 50 states: worst error {worst:.1e}", cases.len());
}

/// Compiles the cases into one program that prints the bits of every output, and runs it.
fn run(cases: &[Case]) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("generated");
    let manifest = format!(
        "[package]\nname = \"generated\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n\
         [dependencies]\nrobot_runtime = {{ path = \"{}/crates/robot_runtime\" }}\n",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::create_dir_all(folder.join("src")).unwrap();
    write(folder.join("Cargo.toml"), &manifest);
    write(folder.join("src/main.rs"), &program(cases));
    // Cargo's default settings, as users build.
    let output = Command::new(env!("CARGO"))
        .args(["run", "--offline", "--quiet"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn write(path: PathBuf, text: &str) {
    if std::fs::read_to_string(&path).is_ok_and(|old| old == text) {
        return;
    }
    std::fs::write(path, text).unwrap();
}

fn program(cases: &[Case]) -> String {
    let mut text = String::from("#![deny(warnings)]\n");
    let mut main = String::from("fn main() {\n");
    for (index, case) in cases.iter().enumerate() {
        let options = RustOptions {
            runtime: "::robot_runtime".to_owned(),
            scalar: Scalar::F64,
            trigonometry: Options::default().trigonometry,
            ..RustOptions::default()
        };
        let code = rust::generate(&case.programs.module, &options).unwrap().to_text();
        let module = rust::identifier(&case.programs.module.name);
        writeln!(text, "mod case_{index} {{\n{code}\n}}").unwrap();
        let path = format!("case_{index}::{module}");
        if case.programs.module.parameters.is_empty() {
            writeln!(main, "    let m = {path}::Model::NOMINAL;").unwrap();
        } else {
            writeln!(main, "    let m = {path}::Model::new(&{path}::Parameters::NOMINAL);")
                .unwrap();
        }
        for &kind in &case.programs.functions {
            for state in &case.states {
                call(&mut main, case, kind, state);
            }
        }
    }
    text + &main
        + "}\n\nfn show(values: &[f64]) {\n    let bits: Vec<String> = values.iter().map(|v| v.to_bits().to_string()).collect();\n    println!(\"{}\", bits.join(\" \"));\n}\n"
}

fn call(main: &mut String, case: &Case, kind: FunctionKind, state: &State) {
    let inputs = case.inputs(kind, state);
    let arguments: Vec<String> = inputs.iter().map(|(_, values)| format!("&{values:?}")).collect();
    let call = format!("m.{}({})", kind.name(), arguments.join(", "));
    let line = match kind {
        FunctionKind::LinkWrenches => format!(
            "    let out = {call}; show(&[out.force.as_flattened(), out.moment.as_flattened()].concat());"
        ),
        _ => format!("    show(&{call});"),
    };
    writeln!(main, "{line}").unwrap();
}
