//! Truncated angles: whichever tolerance snaps them to multiples of π/2, the code computes the robot with the snapped
//! angles, and no option of the recursion divides by the remaining differences.

use robot_build::{Effects, FunctionKind, Functions, Options, Source, programs, snapping};
use robot_codegen::Interpreter;
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::{LinkPlan, Origin, Turn};

use robot_testing::{largest_difference, magnitude};

const TOLERANCE: f64 = 1e-12;
const STATES: usize = 20;

/// A robot file with four revolute joints, in which some angles are placeholders.
const ARM: &str = r#"format = 1
[robot]
name = "truncated"
SNAP
[[link]]
name = "1"
joint = { type = "revolute", axis = "z" }
mass = 3
center_of_mass = [0.1, 0.02, -0.05]
inertia = { xx = 0.03, yy = 0.04, zz = 0.02, xy = 0.001 }
[[link]]
name = "2"
origin = { xyz = [0.1, 0, 0.3], rpy = [A, 0, 0] }
joint = { type = "revolute", axis = "z" }
mass = 2
center_of_mass = [0.2, 0.01, 0.03]
inertia = { xx = 0.02, yy = 0.05, zz = 0.04, yz = -0.002 }
[[link]]
name = "3"
origin = { xyz = [0.4, 0, 0], rpy = [B, 0, 0] }
joint = { type = "revolute", axis = "z" }
mass = 1.5
center_of_mass = [0.15, 0, 0.02]
inertia = { xx = 0.01, yy = 0.03, zz = 0.03 }
[[link]]
name = "4"
origin = { xyz = [0.3, 0.1, 0.05], rpy = [C, 0, 0.7] }
joint = { type = "revolute", axis = "z" }
mass = 0.8
center_of_mass = [0.02, 0.03, 0.06]
inertia = { xx = 0.004, yy = 0.003, zz = 0.002, xz = 0.0005 }
"#;

fn source(angles: [&str; 3]) -> Source {
    let [a, b, c] = angles;
    let text = ARM.replace("[A,", &format!("[{a},")).replace("[B,", &format!("[{b},"));
    let text = text.replace("[C,", &format!("[{c},")).replace("SNAP\n", "");
    Source { name: "truncated.toml".to_owned(), text }
}

/// The angles in the file, and the angles that result from each tolerance.
const WRITTEN: [&str; 3] = ["1.5708", "3.1416", "5e-12"];
const TAKEN: [(f64, [&str; 3], usize); 5] = [
    (0.0, WRITTEN, 0),
    (1e-12, WRITTEN, 0),
    (1e-9, ["1.5708", "3.1416", "0"], 1),
    // 1.5708 differs from π/2 by 3.7e-6, and 3.1416 from π by 7.3e-6.
    (5e-6, ["\"pi/2\"", "3.1416", "0"], 2),
    (1e-4, ["\"pi/2\"", "\"pi\"", "0"], 3),
];

/// Plans that use the directions and distances of joint axes.
fn plans() -> Vec<Option<Plan>> {
    let turns = [Turn::File, Turn::NextNormal, Turn::FirstMoment];
    let origins = [Origin::NextNormal, Origin::PreviousNormal, Origin::ZeroXz, Origin::ZeroYz];
    let links = turns.into_iter().flat_map(|turn| {
        origins.map(|origin| LinkPlan {
            turn,
            origin,
            angle_sum: true,
            column: true,
            moment: [true; 3],
            ..LinkPlan::BASIC
        })
    });
    let units = (0..4).flat_map(|link| (0..3).map(move |component| (link, component)));
    let lengths =
        units.map(|unit| Plan { unit_length: Some(unit), ..Plan::uniform(4, &LinkPlan::BASIC) });
    let given = links.map(|link| Plan::uniform(4, &link)).chain(lengths).map(Some);
    [None].into_iter().chain(given).collect()
}

#[test]
fn any_tolerance_gives_accurate_torques() {
    let written = source(WRITTEN);
    for (snap, taken, count) in TAKEN {
        let robot = robot_build::read(&source(taken)).unwrap().robot;
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let mut random = robot_numeric::random::Random::new(5);
        let states: Vec<_> = (0..STATES).map(|_| random.state(&solver)).collect();
        let expected: Vec<Vec<f64>> = states
            .iter()
            .map(|state| {
                let torques = solver.inverse_dynamics(&state.q, &state.qd, &state.qdd).unwrap();
                torques.iter().copied().collect()
            })
            .collect();
        let size = magnitude(expected.iter().flatten());
        let searched = Options { search: true, ..Options::default() };
        let plans = plans().into_iter().map(|plan| Options { plan, ..Options::default() });
        for options in plans.chain([searched]) {
            let options = Options {
                snap: Some(snap),
                functions: Functions::Chosen(vec![FunctionKind::InverseDynamics(Effects::NONE)]),
                ..options
            };
            let programs = programs(&written, &options).unwrap();
            assert_eq!(programs.snapped.len(), count, "{snap:e}");
            let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
            for (state, expected) in states.iter().zip(&expected) {
                let inputs = [("q", &state.q[..]), ("qd", &state.qd), ("qdd", &state.qdd)];
                let found = interpreter.call("inverse_dynamics", &inputs).unwrap().remove(0);
                let error = largest_difference(&found.values, expected) / size;
                assert!(error <= TOLERANCE, "{snap:e}, {:?}: off by {error:e}", options.plan);
            }
        }
    }
}

#[test]
fn the_report_says_what_was_changed_and_what_could_be_saved() {
    let robot = robot_build::read(&source(WRITTEN)).unwrap().robot;
    let report = snapping(&robot, None, None).unwrap();
    assert_eq!((report.taken.tolerance, report.taken.snapped.len()), (1e-9, 1));
    assert!((report.taken.largest().unwrap().change.abs() - 5e-12).abs() < 1e-20);
    let larger: Vec<_> =
        report.larger.iter().map(|one| (one.tolerance, one.snapped.len())).collect();
    assert_eq!(larger, [(1e-4, 3)]);
    assert!((report.larger[0].largest().unwrap().change.abs() - 7.346e-6).abs() < 1e-9);
    assert!(report.larger[0].operations < report.taken.operations);
}

#[test]
fn the_file_says_the_tolerance_and_an_option_overrides_it() {
    let text = ARM.replace("SNAP\n", "snap = 1e-4\n").replace("[A,", "[1.5708,");
    let text = text.replace("[B,", "[3.1416,").replace("[C,", "[5e-12,");
    let source = Source { name: "truncated.toml".to_owned(), text };
    let count = |snap| {
        let options = Options { snap, ..Options::default() };
        programs(&source, &options).unwrap().snapped.len()
    };
    assert_eq!([count(None), count(Some(1e-9)), count(Some(0.0))], [3, 1, 0]);
}
