//! Bundles as compiled code: they give the values of their functions with fewer operations.

use std::fmt::Write as _;
use std::path::Path;

use robot_build::{Bundle, Effects, FunctionKind, Functions, Options, RobotFile, generate};

use crate::package::{Package, dependency};

/// The same sums computed in different ways differ by rounding errors.
const TOLERANCE: f64 = 1e-12;

const KINDS: [FunctionKind; 5] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::MassMatrix,
    FunctionKind::Bias,
    FunctionKind::ForwardDynamics(Effects::NONE),
    FunctionKind::Energies,
];

/// A program that prints the largest difference between a bundle and its functions, relative to the largest value.
const HARNESS: &str = r#"
/// Numbers between -2 and 2, by the golden ratio.
fn entries<const N: usize>(from: usize) -> [f64; N] {
    std::array::from_fn(|k| ((from + k) as f64 * 0.618_033_988_749_895).fract() * 4.0 - 2.0)
}

macro_rules! compare {
    ($robot:ident, $model:expr, $dof:literal) => {{
        let m = $model;
        let (mut size, mut worst) = (0.0_f64, 0.0_f64);
        let mut note_difference = |a: f64, b: f64| {
            size = size.max(b.abs());
            // NaN is not a small difference.
            worst = if (a - b).is_nan() { f64::INFINITY } else { worst.max((a - b).abs()) };
        };
        for state in 0..20 {
            let [q, qd, qdd, tau]: [[f64; $dof]; 4] = [0, 100, 200, 300].map(|from| entries(from + 7 * state));
            let all = m.everything(&q, &qd, &qdd, &tau);
            let energies = m.energies(&q, &qd);
            let (id, bias, fd) =
                (m.inverse_dynamics(&q, &qd, &qdd), m.bias(&q, &qd), m.forward_dynamics(&q, &qd, &tau));
            let mass = m.mass_matrix(&q);
            for i in 0..$dof {
                note_difference(all.inverse_dynamics[i], id[i]);
                note_difference(all.bias[i], bias[i]);
                note_difference(all.forward_dynamics[i], fd[i]);
                for j in 0..$dof { note_difference(all.mass_matrix[i][j], mass[i][j]); }
            }
            note_difference(all.kinetic, energies.kinetic);
            note_difference(all.potential, energies.potential);
        }
        println!("{} {:e}", stringify!($robot), worst / size);
    }};
}
"#;

#[test]
fn a_bundle_gives_what_its_functions_give() {
    let robots = [("trttr1", 5, true), ("puma560", 6, false), ("ur5", 6, false)];
    let runtime = dependency("robot_runtime", "");
    let package = Package::new("bundles", &format!("[dependencies]\n{runtime}"));
    let (mut head, mut body) = (HARNESS.to_owned(), String::new());
    for (name, coordinates, has_parameters) in robots {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("robots/{name}.toml"));
        let file = RobotFile::read(&path).unwrap();
        let bundle = Bundle { name: "everything".to_owned(), functions: KINDS.to_vec() };
        // The name of a type of the code.
        let named_as_a_type =
            Bundle { name: "Model".to_owned(), functions: vec![FunctionKind::Bias] };
        let options = Options {
            functions: Functions::Chosen(KINDS.to_vec()),
            bundles: vec![bundle, named_as_a_type],
            ..Options::default()
        };
        let options = file.with_pin(&options).unwrap();
        let generated = generate(&file.source, &options).unwrap();
        package.write(&format!("src/{name}_code.rs"), &generated.code);
        let counts = robot_build::programs(&file.source, &options).unwrap().module;
        let operations =
            |name: &str| counts.counts(counts.function(name).unwrap()).call.operations();
        let apart: usize = KINDS.iter().map(|kind| operations(kind.name())).sum();
        let together = operations("everything");
        println!("{name}: {together} operations together, {apart} apart");
        assert!(together < apart, "{name}: {together}, {apart}");
        let model = match has_parameters {
            true => format!(
                "{name}_code::{name}::Model::new(&{name}_code::{name}::Parameters::NOMINAL)"
            ),
            false => format!("{name}_code::{name}::Model::NOMINAL"),
        };
        writeln!(head, "mod {name}_code;").unwrap();
        writeln!(body, "compare!({name}, {model}, {coordinates});").unwrap();
    }
    package.write("src/main.rs", &format!("{head}\nfn main() {{\n{body}}}\n"));
    let printed = package.run(&["run", "--quiet"]);
    println!("{printed}");
    assert_eq!(printed.lines().count(), robots.len());
    for line in printed.lines() {
        let worst: f64 = line.split_once(' ').unwrap().1.parse().unwrap();
        assert!(worst < TOLERANCE, "{line}");
    }
}
