//! Checks that the numbers of operations in the documents are those of the code.

use robot_build::{Bundle, Effects, FunctionKind, Functions, Options, RobotFile, programs};
use robot_codegen::Counts;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The cells of the rows in a document's tables.
pub(crate) fn rows(document: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(format!("{ROOT}/docs/{document}")).unwrap();
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.map(|row| row.split(" | ").map(str::to_owned).collect()).collect()
}

/// The operations of a call of each function of a robot, with its pinned plan.
fn costs(robot: &str, functions: Vec<FunctionKind>, bundles: Vec<Bundle>) -> Vec<Counts> {
    let file = RobotFile::read(format!("{ROOT}/robots/{robot}.toml").as_ref()).unwrap();
    let functions = Functions::Chosen(functions);
    let options = file.with_pin(&Options { functions, bundles, ..Options::default() }).unwrap();
    let module = programs(&file.source, &options).unwrap().module;
    module.functions.iter().map(|function| module.counts(function).call).collect()
}

#[test]
fn inverse_dynamics_of_the_page_about_performance() {
    let rows = rows("performance.md");
    for robot in ["puma560", "ur5", "stanford", "scara", "iiwa", "panda"] {
        let counts = costs(robot, vec![FunctionKind::InverseDynamics(Effects::NONE)], vec![])[0];
        let [mul, add] = [counts.mul, counts.add];
        let [sin, cos] = [counts.sin, counts.cos];
        let stated = format!("{robot} | {mul} | {add} | {} | {sin} + {cos}", mul + add);
        assert!(rows.iter().any(|row| row.join(" | ") == stated), "{stated}");
    }
}

#[test]
fn other_functions_of_the_page_about_performance() {
    let rows = rows("performance.md");
    let kinds = [
        FunctionKind::MassMatrix,
        FunctionKind::ForwardDynamics(Effects::NONE),
        FunctionKind::CoriolisMatrix,
        FunctionKind::InverseDynamicsDerivatives,
        FunctionKind::ForwardDynamicsDerivatives,
    ];
    for robot in ["puma560", "ur5", "stanford", "scara", "iiwa", "panda"] {
        // The functions are derived one by one, because in a common derivation the order of operands depends on the
        // preceding functions.
        let counts = kinds.map(|kind| {
            let counts = costs(robot, vec![kind], vec![])[0];
            (counts.mul + counts.add + counts.div).to_string()
        });
        let stated = [&[robot.to_owned()], &counts[..]].concat();
        assert!(rows.contains(&stated), "{}", stated.join(" | "));
    }
}

#[test]
fn bundles_of_the_page_about_generated_code() {
    let mut compared = 0;
    for row in rows("generated-code.md") {
        let names: Vec<&str> = row[0].split(", ").map(|name| name.trim_matches('`')).collect();
        let kinds: Option<Vec<FunctionKind>> =
            names.iter().map(|name| FunctionKind::from_name(name)).collect();
        let Some(kinds) = kinds.filter(|kinds| kinds.len() > 1) else { continue };
        for (robot, stated) in ["puma560", "ur5", "iiwa", "panda"].iter().zip(&row[1..]) {
            let bundle = Bundle { name: "together".to_owned(), functions: kinds.clone() };
            let counts = costs(robot, kinds.clone(), vec![bundle]);
            let sum = |counts: &[Counts]| -> usize {
                counts.iter().map(|counts| counts.mul + counts.add + counts.div).sum()
            };
            let (together, apart) = counts.split_last().unwrap();
            let found = format!("{} → {}", sum(apart), sum(&[*together]));
            assert_eq!(&found, stated, "{robot}: {}", row[0]);
            compared += 1;
        }
    }
    assert_eq!(compared, 7 * 4);
}
