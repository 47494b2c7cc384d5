//! Checks the rows of `conformance/`, which are URDF texts with a state and joint torques derived by hand, or with the
//! errors that they must cause; and the page that compares other programs with them.

use robot_build::{Effects, FunctionKind, Functions, Options, programs_of};
use robot_codegen::Interpreter;
use robot_model::description::{self, read_toml, read_urdf};
use robot_model::diagnostic::{Diagnostics, Severity};
use robot_model::robot::Robot;
use robot_numeric::Mechanism;
use toml::{Table, Value};

use robot_testing::largest_difference;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/conformance");
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/conformance.md");

fn rows() -> Vec<Table> {
    let mut rows = vec![];
    for file in ["inertia", "joints", "structure", "text"] {
        let text = std::fs::read_to_string(format!("{FOLDER}/{file}.toml")).unwrap();
        let file: Table = text.parse().unwrap();
        let of_file = file["row"].as_array().unwrap();
        rows.extend(of_file.iter().map(|row| row.as_table().unwrap().clone()));
    }
    assert!(rows.len() >= 40, "{}", rows.len());
    rows
}

fn text<'r>(row: &'r Table, key: &str) -> &'r str {
    row[key].as_str().unwrap()
}

fn texts(row: &Table, key: &str) -> Vec<String> {
    let list = row.get(key).and_then(Value::as_array);
    list.map(|list| list.iter().map(|one| one.as_str().unwrap().to_owned()).collect())
        .unwrap_or_default()
}

fn numbers(row: &Table, key: &str) -> Vec<f64> {
    row[key].as_array().unwrap().iter().map(|one| one.as_float().unwrap()).collect()
}

/// The codes of the diagnostics with the given severity, sorted and without repetitions.
fn codes(found: &Diagnostics, severity: Severity) -> Vec<String> {
    let of_it = found.iter().filter(|one| one.severity == severity);
    let mut codes: Vec<String> = of_it.map(|one| one.code.to_owned()).collect();
    codes.sort();
    codes.dedup();
    codes
}

/// The joint torques by the program from which code is printed, and by the numeric solver.
fn torques(robot: &Robot, row: &Table) -> [Vec<f64>; 2] {
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(row, key));
    let functions = Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]);
    let options = Options { functions, ..Options::default() };
    let programs = programs_of(robot.clone(), "row", &options).unwrap();
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let inputs: [(&str, &[f64]); 3] = [("q", &q), ("qd", &qd), ("qdd", &qdd)];
    let outputs = interpreter.call("inverse_dynamics", &inputs).unwrap();
    let solver = Mechanism::nominal(robot).unwrap();
    let solved = solver.inverse_dynamics(&q, &qd, &qdd).unwrap();
    [outputs[0].values.clone(), solved.as_slice().to_vec()]
}

/// Reads a row and compares the results with the row.
fn check(row: &Table) {
    let (name, urdf) = (text(row, "name"), text(row, "urdf"));
    let refused = texts(row, "refused");
    let described = match read_urdf("row.urdf", urdf) {
        Ok(described) => described,
        Err(found) => {
            assert_eq!(codes(&found, Severity::Error), refused, "{name}:\n{found}");
            return;
        }
    };
    assert!(refused.is_empty(), "{name} is read, but should not be");
    let warned = codes(&described.warnings, Severity::Warning);
    assert_eq!(warned, texts(row, "warned"), "{name}:\n{}", described.warnings);
    let robot = &described.robot;
    let joints: Vec<_> = robot.coordinates.iter().map(|one| one.joint.clone()).collect();
    assert_eq!(joints, texts(row, "joints"), "{name}");
    let expected = numbers(row, "tau");
    let found = torques(robot, row);
    for tau in &found {
        let error = largest_difference(tau, &expected);
        assert!(
            error <= 1e-12 * expected.iter().fold(1.0, |a: f64, b| a.max(b.abs())),
            "{name}: {tau:?}"
        );
    }
    // An import gives exactly the same torques, and importing its result again changes nothing.
    let import = |name: &str, text: &str| {
        let taken = description::Options::default();
        description::import(name, text, &taken).unwrap_or_else(|found| panic!("{name}\n{found}"))
    };
    let first = import("row.urdf", urdf).toml;
    assert_eq!(first, import("row.urdf", urdf).toml, "{name}");
    assert_eq!(first, import("row.toml", &first).toml, "{name}");
    let again = read_toml("row.toml", &first).unwrap_or_else(|found| panic!("{name}\n{found}"));
    assert_eq!(torques(&again.robot, row), found, "{name}");
}

#[test]
fn every_row_is_as_its_text_says() {
    let rows = rows();
    let mut names: Vec<&str> = rows.iter().map(|row| text(row, "name")).collect();
    rows.iter().for_each(check);
    for row in &rows {
        assert!(text(row, "why").len() > 5 && !text(row, "title").is_empty());
        assert!(row.contains_key("tau") != row.contains_key("refused"), "{}", text(row, "name"));
    }
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), rows.len());
}

/// A number with six digits and without trailing zeros, as on the page.
fn six(value: f64) -> String {
    if value.abs() < 5e-13 {
        return "0".to_owned();
    }
    let whole = value.abs().log10().floor() as i32;
    let decimals = usize::try_from(5 - whole).unwrap();
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The text of the column *here* for a row.
fn here(row: &Table) -> String {
    let refused = texts(row, "refused");
    if !refused.is_empty() {
        return format!("refuses, {}", refused.join(" "));
    }
    let tau: Vec<String> = numbers(row, "tau").into_iter().map(six).collect();
    let warned = texts(row, "warned");
    let warns =
        if warned.is_empty() { String::new() } else { format!(", warns {}", warned.join(" ")) };
    tau.join(", ") + &warns
}

#[test]
fn the_page_has_every_row_with_what_is_done_here() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let rows = rows();
    for row in &rows {
        let name = text(row, "name");
        let line = page.lines().find(|line| line.starts_with(&format!("| {name} |")));
        let line = line.unwrap_or_else(|| panic!("docs/conformance.md has no row {name}"));
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        assert_eq!(cells[2], text(row, "title"), "{name}");
        assert_eq!(cells[4], here(row), "{name}: run conformance/peers.py");
        assert!(cells[5..7].iter().all(|cell| !cell.is_empty()), "{line}");
    }
    let listed =
        page.lines().filter(|line| line.starts_with("| ") && line.matches('|').count() == 7);
    assert_eq!(listed.count(), rows.len() + 4, "one row each, and a head for each of four tables");
}
