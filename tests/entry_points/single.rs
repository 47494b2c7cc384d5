//! The accuracy of inverse dynamics in `f32`: plain code and lanes are compared with `f64` for every robot.
//!
//! `cargo test -p robots --test entry_points single -- --nocapture` prints the table of
//! docs/performance.md.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use robot_build::{Effects, FunctionKind, Functions, Options, RobotFile, Scalar, generate};

use crate::package::{Package, dependency};

/// The maximum error relative to the largest torque over the states; the relative precision of `f32` is 1.2·10⁻⁷.
const BOUND: f64 = 1e-6;

/// Code that prints, for each robot, the largest errors of `f32` code and of lanes of `f32`.
const HARNESS: &str = r#"
/// The worst error of plain code and of lanes, in units of the largest torque.
macro_rules! measure {
    ($robot:literal, $double:expr, $single:expr, $dof:literal) => {{
        let (double, single) = ($double, $single);
        let mut random = Random(7);
        let (mut size, mut worst) = (0.0_f64, [0.0_f64; 2]);
        for _ in 0..2000 {
            let q: [f64; $dof] = random.entries(3.0);
            let qd: [f64; $dof] = random.entries(2.0);
            let qdd: [f64; $dof] = random.entries(5.0);
            // The states are numbers of f32, so that the error is the computation's alone.
            let [q32, qd32, qdd32] = [q, qd, qdd].map(|x| x.map(|x| x as f32));
            let [q, qd, qdd] = [q32, qd32, qdd32].map(|x| x.map(f64::from));
            let exact = double.inverse_dynamics(&q, &qd, &qdd);
            let plain = single.inverse_dynamics(&q32, &qd32, &qdd32);
            let [a, b, c] = [q32, qd32, qdd32].map(|x| x.map(robot_runtime::F32x8::splat));
            let lanes = single.inverse_dynamics_generic(&a, &b, &c).map(|tau| tau.to_array()[5]);
            for i in 0..$dof {
                size = size.max(exact[i].abs());
                worst[0] = worst[0].max((f64::from(plain[i]) - exact[i]).abs());
                worst[1] = worst[1].max((f64::from(lanes[i]) - exact[i]).abs());
            }
        }
        println!("{} {:e} {:e}", $robot, worst[0] / size, worst[1] / size);
    }};
}

/// xorshift
struct Random(u64);

impl Random {
    fn entries<const N: usize>(&mut self, size: f64) -> [f64; N] {
        std::array::from_fn(|_| {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            size * ((self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
        })
    }
}
"#;

fn robot_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    files.sort();
    files
}

#[test]
fn single_precision_keeps_its_digits() {
    let runtime = dependency("robot_runtime", "");
    let package = Package::new("single", &format!("[dependencies]\n{runtime}"));
    let (mut cases, mut main) = (String::new(), "fn main() {\n".to_owned());
    let files = robot_files();
    for path in &files {
        let file = RobotFile::read(path).unwrap();
        let robot = robot_build::read(&file.source).unwrap().robot;
        let module = robot.name.to_lowercase();
        for (case, scalar) in [("double", Scalar::F64), ("single", Scalar::F32)] {
            let functions = Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]);
            let options = Options { functions, scalar, generic: true, ..Options::default() };
            let options = file.with_pin(&options).unwrap();
            let code = generate(&file.source, &options).unwrap().code;
            writeln!(cases, "mod {module}_{case} {{\n{code}\n}}").unwrap();
        }
        let model = |case: &str| {
            let path = format!("{module}_{case}::{module}");
            match robot.parameters.is_empty() {
                true => format!("{path}::Model::NOMINAL"),
                false => format!("{path}::Model::new(&{path}::Parameters::NOMINAL)"),
            }
        };
        let (double, single) = (model("double"), model("single"));
        let dof = robot.degrees_of_freedom();
        writeln!(main, "measure!(\"{module}\", {double}, {single}, {dof});").unwrap();
    }
    package.write("src/main.rs", &format!("#![allow(dead_code)]\n{HARNESS}\n{cases}\n{main}}}\n"));
    let shown = package.run(&["run"]);
    println!("| robot | f32 | lanes of f32 |\n|---|---|---|");
    for line in shown.lines() {
        let (robot, errors) = line.split_once(' ').unwrap();
        let errors: Vec<f64> = errors.split(' ').map(|error| error.parse().unwrap()).collect();
        println!("| {robot} | {:.1e} | {:.1e} |", errors[0], errors[1]);
        // An error of 0 would indicate that the computation was in f64.
        assert!(errors.iter().all(|error| (1e-9..BOUND).contains(error)), "{line}");
    }
    assert_eq!(shown.lines().count(), files.len());
}
