//! Checks that the programs in `docs/records` are those that are generated, and that they need the operations that the
//! page states.
//!
//! `UPDATE_SNAPSHOTS=1` rewrites the programs and the states; `docs/records/check.py` counts operations and runs the
//! programs without using anything of this project.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use robot_build::{Effects, FunctionKind, Functions, Options, RobotFile, programs};
use robot_numeric::Mechanism;
use robot_numeric::random::Random;

use crate::operation_counts::rows;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const ROBOTS: [&str; 6] = ["puma560", "ur5", "stanford", "scara", "iiwa", "panda"];
const STATES: usize = 8;

/// The program of a robot's inverse dynamics, and states with the joint torques by the numeric solver.
fn record(robot: &str) -> [(String, String); 2] {
    let file = RobotFile::read(format!("{ROOT}/robots/{robot}.toml").as_ref()).unwrap();
    let functions = Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]);
    let options = file.with_pin(&Options { functions, ..Options::default() }).unwrap();
    let built = programs(&file.source, &options).unwrap();
    let mechanism = Mechanism::nominal(&built.robot).unwrap();
    let mut random = Random::new(1);
    let mut states = String::new();
    for _ in 0..STATES {
        let [q, qd, qdd] = [3.1, 2.0, 5.0].map(|size| -> Vec<f64> {
            (0..mechanism.coordinates()).map(|_| random.uniform(-size, size)).collect()
        });
        let tau = mechanism.inverse_dynamics(&q, &qd, &qdd).unwrap();
        for (name, values) in [("q", &q[..]), ("qd", &qd), ("qdd", &qdd), ("tau", tau.as_slice())] {
            let values: Vec<String> = values.iter().map(f64::to_string).collect();
            writeln!(states, "{name} {}", values.join(" ")).unwrap();
        }
    }
    let program = built.module.functions[0].to_string();
    [(format!("{robot}.program"), program), (format!("{robot}.states"), states)]
}

/// The multiplications, the additions, and the sines and cosines, counted in the text alone.
fn counts(program: &str) -> [usize; 3] {
    let mut counts = [0; 3];
    // A product 2 a counts as the sum a + a.
    let mut twos = BTreeSet::new();
    for line in program.lines() {
        if line.ends_with(':') {
            twos.clear();
        }
        let Some((name, value)) = line.split_once(" = ") else { continue };
        let is_value = name.strip_prefix('v').is_some_and(|index| index.parse::<usize>().is_ok());
        if !is_value {
            continue;
        }
        match value.split(' ').collect::<Vec<_>>().as_slice() {
            ["2" | "2.0"] => {
                twos.insert(name);
            }
            [a, "*", b] => counts[usize::from(twos.contains(a) || twos.contains(b))] += 1,
            [_, "+" | "-", _] => counts[1] += 1,
            [load] if load.starts_with("sin[") || load.starts_with("cos[") => counts[2] += 1,
            [_] => {}
            _ => panic!("an operation without a rule: {line}"),
        }
    }
    counts
}

#[test]
fn programs_of_the_records_are_generated() {
    let rows = rows("records.md");
    for robot in ROBOTS {
        for (name, text) in record(robot) {
            let path = Path::new(ROOT).join("docs/records").join(&name);
            if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
                std::fs::write(&path, &text).unwrap();
            }
            let committed = std::fs::read_to_string(&path).unwrap();
            assert!(committed == text, "{name} is not what is generated: UPDATE_SNAPSHOTS=1");
        }
        let path = format!("{ROOT}/docs/records/{robot}.program");
        let [mul, add, sines] = counts(&std::fs::read_to_string(path).unwrap());
        let stated =
            rows.iter().find(|row| row[0] == format!("[{robot}](records/{robot}.program)"));
        let found = [mul, add, mul + add, sines].map(|count| count.to_string());
        assert_eq!(stated.map(|row| &row[1..5]), Some(&found[..]), "{robot}");
    }
}
