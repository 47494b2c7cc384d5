//! Every function of every robot as compiled code: `f64` is compared with the numeric solver, and `f32` and lanes of
//! `f64` and `f32` are compared with `f64`.
//!
//! `cargo test -p robots --test entry_points kinds -- --nocapture` prints the largest errors.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use robot_build::{Effects, FrameRef, FunctionKind, Functions, Options, programs_of};
use robot_codegen::backend::rust::{self, RustOptions};
use robot_codegen::module::Function;
use robot_dynamics::base_parameters::{BaseParameter, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::robot::LINK_PARAMETERS;
use robot_model::robot::Robot;
use robot_numeric::random::{Random, State};
use robot_symbolic::Graph;

use robot_testing::solver::{expected, inputs, state};
use robot_testing::{largest_difference, magnitude, robot_files};

use crate::package::{Package, dependency};

const STATES: usize = 4;
/// The tolerance relative to the largest value over the states.
const TOLERANCE: f64 = 1e-11;
/// The tolerance for lanes, which compute the same operations as plain code.
const LANES: f64 = 1e-15;
/// The tolerance for `f32` and its lanes, whose relative precision is 1.2·10⁻⁷.
const SINGLE: f64 = 1e-6;
/// The tolerance for functions that solve with M, which lose digits because of its condition number.
const SINGLE_SOLVED: f64 = 1e-5;

/// Code that runs the forms of a function in the states and prints the values of `f64`, followed by the largest errors
/// of `f32`, lanes of `f64` and lanes of `f32`, relative to the largest value.
const HARNESS: &str = r#"
use robot_runtime::{Lanes, lanes_from_states};

/// Appends entries as f64; of lanes the second.
trait Flat {
    fn flat(&self, into: &mut Vec<f64>);
}
impl Flat for f64 {
    fn flat(&self, into: &mut Vec<f64>) { into.push(*self); }
}
impl Flat for f32 {
    fn flat(&self, into: &mut Vec<f64>) { into.push((*self).into()); }
}
impl<T: Flat + robot_runtime::Scalar> Flat for Lanes<T, 2> {
    fn flat(&self, into: &mut Vec<f64>) { self.to_array()[1].flat(into); }
}
impl<F: Flat, const N: usize> Flat for [F; N] {
    fn flat(&self, into: &mut Vec<f64>) { self.iter().for_each(|entry| entry.flat(into)); }
}

fn values(parts: &[&dyn Flat]) -> Vec<f64> {
    let mut values = vec![];
    parts.iter().for_each(|part| part.flat(&mut values));
    values
}

fn show(exact: &[Vec<f64>], others: [&[Vec<f64>]; 3]) {
    let size = exact.iter().flatten().fold(1e-30_f64, |size, value| size.max(value.abs()));
    for values in exact { println!("{values:?}"); }
    let errors = others.map(|form| {
        let pairs = form.iter().flatten().zip(exact.iter().flatten());
        pairs.fold(0.0_f64, |worst, (a, b)| if (a - b).is_nan() { f64::INFINITY } else { worst.max((a - b).abs()) }) / size
    });
    println!("{errors:?}");
}

fn narrow<const N: usize>(entries: &[f64; N]) -> [f32; N] { entries.map(|x| x as f32) }
"#;

/// A robot whose functions are called.
struct Case {
    robot: Robot,
    /// The functions for each kind.
    kinds: Vec<(FunctionKind, Vec<Function>)>,
    code: String,
    states: Vec<State>,
}

impl Case {
    fn new(name: &str, text: &str) -> Case {
        let robot = robot_testing::read(name, text);
        let all = FunctionKind::of_robot(&robot);
        // The function for the base parameters has no inputs; it has a separate test.
        let called = |kind: &FunctionKind| *kind != FunctionKind::BaseParameters;
        let called: Vec<FunctionKind> = all.into_iter().filter(called).collect();
        let functions = Functions::Chosen(called.clone());
        let module = programs_of(robot.clone(), name, &Options { functions, ..Options::default() });
        let module = module.unwrap().module;
        let options = RustOptions { generic: true, ..RustOptions::default() };
        let code = rust::generate(&module, &options).unwrap().to_text();
        let mut functions = module.functions.into_iter();
        let kinds = called.into_iter().map(|kind| {
            let of_frames = matches!(kind, FunctionKind::Jacobian | FunctionKind::JacobianDotQd);
            let count = if of_frames { FrameRef::usual(&robot).len() } else { 1 };
            (kind, functions.by_ref().take(count).collect())
        });
        let kinds = kinds.collect();
        assert!(functions.next().is_none());
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let mut random = Random::new(17);
        let states = (0..STATES).map(|_| {
            let mut state = state(&mut random, &solver, &robot);
            // The inputs are exact in f32, so that errors are only those of the computation.
            let narrow = |x: &mut f64| *x = f64::from(*x as f32);
            let State { q, qd, qdd, tau, wrenches } = &mut state;
            [q, qd, qdd, tau].into_iter().flatten().for_each(narrow);
            for wrench in wrenches {
                wrench.force.iter_mut().chain(wrench.moment.iter_mut()).for_each(narrow);
            }
            state
        });
        let states = states.collect();
        Case { robot, kinds, code, states }
    }

    /// A block that calls all forms of all functions.
    fn block(&self) -> String {
        let module = self.robot.name.to_lowercase();
        let path = format!("{module}_case::{module}");
        let model = match self.robot.parameters.is_empty() {
            true => format!("{path}::Model::NOMINAL"),
            false => format!("{path}::Model::new(&{path}::Parameters::NOMINAL)"),
        };
        let mut text = format!("fn {module}_calls() {{\nlet m = {model};\n");
        for function in self.kinds.iter().flat_map(|(_, functions)| functions) {
            self.calls(&mut text, function);
        }
        text + "}\n"
    }

    fn calls(&self, text: &mut String, function: &Function) {
        let names = || function.inputs.iter().map(|input| input.name.clone());
        for (index, input) in function.inputs.iter().enumerate() {
            let entries: Vec<Vec<f64>> = self
                .states
                .iter()
                .map(|state| inputs(&self.robot, names(), state)[index].1.clone())
                .collect();
            let (name, count) = (&input.name, input.symbols.len());
            writeln!(text, "let {name}: [[f64; {count}]; {STATES}] = {entries:?};").unwrap();
        }
        let form = |suffix: &str, argument: &dyn Fn(&str) -> String| {
            let arguments: Vec<String> =
                function.inputs.iter().map(|input| argument(&input.name)).collect();
            let call = format!("m.{}{suffix}({})", function.name, arguments.join(", "));
            let parts: Vec<String> = match function.outputs.as_slice() {
                [_] => vec!["&r".to_owned()],
                several => several.iter().map(|output| format!("&r.{}", output.name)).collect(),
            };
            let parts = parts.join(", ");
            format!(
                "(0..{STATES}).map(|k| {{ let r = {call}; values(&[{parts}]) }}).collect::<Vec<_>>()"
            )
        };
        let plain = form("", &|name| format!("&{name}[k]"));
        let single = form("_generic", &|name| format!("&narrow(&{name}[k])"));
        let lanes =
            form("_generic", &|name| format!("&lanes_from_states(&[{name}[0], {name}[k]])"));
        let single_lanes = form("_generic", &|name| {
            format!("&lanes_from_states(&[narrow(&{name}[0]), narrow(&{name}[k])])")
        });
        writeln!(text, "show(&{plain}, [&{single}, &{lanes}, &{single_lanes}]);").unwrap();
    }

    /// The columns of the full regressor, for parameters of links, that a regressor contains.
    fn columns(&self, kind: FunctionKind) -> Option<Vec<usize>> {
        let inertial = 0..LINK_PARAMETERS * self.robot.links.len();
        match kind {
            FunctionKind::Regressor => Some(inertial.collect()),
            FunctionKind::RegressorBase => {
                let graph = Graph::new();
                let derivation =
                    Derivation::new(&self.robot, &graph, &MechanismOptions::ROUNDED, None);
                let base = base_parameters(&derivation).unwrap().base;
                let columns = base.iter().filter_map(BaseParameter::full_column);
                Some(columns.filter(|column| inertial.contains(column)).collect())
            }
            _ => None,
        }
    }

    /// Compares the printed lines of this robot with the solver.
    fn hold<'l>(&self, lines: &mut impl Iterator<Item = &'l str>, worst: &mut Worst) {
        let solver = robot_numeric::Mechanism::nominal(&self.robot).unwrap();
        for (kind, functions) in &self.kinds {
            let name = format!("{}, {}", self.robot.name, kind.name());
            let mut found: Vec<Vec<f64>> = vec![vec![]; STATES];
            for function in functions {
                for values in &mut found {
                    values.extend(numbers(lines.next().unwrap()));
                }
                let errors = numbers(lines.next().unwrap());
                let single = if solves(*kind) { SINGLE_SOLVED } else { SINGLE };
                for (error, most) in errors.iter().zip([single, LANES, single]) {
                    assert!(*error <= most, "{name}: {} is off by {errors:?}", function.name);
                }
                worst.note(*kind, &errors);
            }
            let columns = self.columns(*kind);
            if let Some(columns) = &columns {
                // The columns of drives follow those of the links.
                let inertial: Vec<usize> = match kind {
                    FunctionKind::Regressor => columns.clone(),
                    _ => (0..columns.len()).collect(),
                };
                let rows = self.robot.degrees_of_freedom();
                found = found.iter().map(|values| chosen(values, rows, &inertial)).collect();
            }
            let said = self.states.iter().map(|state| match &columns {
                None => expected(&self.robot, &solver, *kind, state),
                Some(columns) => {
                    let all = expected(&self.robot, &solver, FunctionKind::Regressor, state);
                    chosen(&all, self.robot.degrees_of_freedom(), columns)
                }
            });
            let said: Vec<Vec<f64>> = said.collect();
            let size = magnitude(said.iter().flatten()).max(1e-3);
            for (found, said) in found.iter().zip(&said) {
                let error = largest_difference(found, said) / size;
                assert!(error <= TOLERANCE, "{name}: f64 is off by {error:e}");
            }
        }
    }
}

/// Whether the function solves with the mass matrix.
fn solves(kind: FunctionKind) -> bool {
    matches!(
        kind,
        FunctionKind::ForwardDynamics(Effects::NONE)
            | FunctionKind::ForwardDynamics(Effects::WRENCH)
            | FunctionKind::ForwardDynamics(Effects::FRICTION)
            | FunctionKind::ForwardDynamics(Effects::BOTH)
            | FunctionKind::ForwardDynamicsDerivatives
    )
}

/// The given columns of a matrix, row by row.
fn chosen(matrix: &[f64], rows: usize, columns: &[usize]) -> Vec<f64> {
    let rows = matrix.chunks(matrix.len() / rows);
    rows.flat_map(|row| columns.iter().map(|column| row[*column])).collect()
}

fn numbers(line: &str) -> Vec<f64> {
    let entries = line.trim_matches(['[', ']']).split(", ");
    entries.map(|entry| entry.parse().unwrap()).collect()
}

/// The largest errors of each kind.
#[derive(Default)]
struct Worst(BTreeMap<FunctionKind, [f64; 3]>);

impl Worst {
    fn note(&mut self, kind: FunctionKind, errors: &[f64]) {
        for (worst, error) in self.0.entry(kind).or_default().iter_mut().zip(errors) {
            *worst = worst.max(*error);
        }
    }
}

#[test]
fn every_function_of_every_robot() {
    let runtime = dependency("robot_runtime", "");
    // The build takes most of the time.
    let profile = "[profile.dev]\ndebug = false\nincremental = false\n";
    let package = Package::new("kinds", &format!("{profile}[dependencies]\n{runtime}"));
    let files = robot_files().into_iter();
    let cases: Vec<Case> = files.map(|(name, text)| Case::new(&name, &text)).collect();
    let mut text = format!("#![allow(dead_code)]\n{HARNESS}");
    let mut main = String::new();
    for case in &cases {
        let module = case.robot.name.to_lowercase();
        writeln!(text, "mod {module}_case {{\n{}\n}}\n{}", case.code, case.block()).unwrap();
        writeln!(main, "{module}_calls();").unwrap();
    }
    // A thread has 2 MB of stack, which must suffice for unoptimized code as well.
    let main = format!(
        "std::thread::Builder::new().stack_size(1 << 21).spawn(|| {{\n{main}}}).unwrap().join().unwrap();"
    );
    package.write("src/main.rs", &format!("{text}\nfn main() {{\n{main}}}\n"));
    let printed = package.run(&["run"]);
    let mut lines = printed.lines();
    let mut worst = Worst::default();
    for case in &cases {
        case.hold(&mut lines, &mut worst);
    }
    assert_eq!(lines.next(), None);
    println!("| function | f32 | lanes of f64 | lanes of f32 |\n|---|---|---|---|");
    for (kind, [single, lanes, single_lanes]) in &worst.0 {
        println!("| `{}` | {single:.1e} | {lanes:.1e} | {single_lanes:.1e} |", kind.name());
        // An error of 0 would indicate that the computation was in f64.
        assert!(*single > 1e-9, "{}", kind.name());
    }
}
