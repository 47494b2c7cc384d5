//! Additional forms of functions as compiled code: generic functions with every scalar, batches, and multiply-adds.

use std::fmt::Write as _;

use robot_build::{Functions, Options, Source, Trigonometry, generate, programs};
use robot_codegen::Interpreter;
use robot_model::functions::{Effects, FunctionKind};
use robot_numeric::random::Random;

use crate::package::{Package, dependency};

/// More than two blocks of eight states, with a remainder.
const STATES: usize = 19;
/// The maximum error caused by a different order of operations, relative to the largest torque.
const TOLERANCE: f64 = 1e-12;
const SINGLE_TOLERANCE: f64 = 1e-4;

const UR5: &str = include_str!("../../robots/ur5.toml");
const TRTTR1: &str = include_str!("../../robots/trttr1.toml");
const PANDA: &str = include_str!("../../robots/panda.toml");

/// The options for every form of inverse dynamics, and for a batch of the mass matrix, which does not use the
/// velocities.
fn options(trigonometry: Trigonometry, fused: bool) -> Options {
    let functions = vec![FunctionKind::InverseDynamics(Effects::NONE), FunctionKind::MassMatrix];
    Options {
        functions: Functions::Chosen(functions),
        generic: true,
        batch: Some(8),
        fused,
        trigonometry,
        ..Options::default()
    }
}

fn source(robot: &str) -> Source {
    Source { name: "robot.toml".to_owned(), text: robot.to_owned() }
}

/// Positions, velocities and accelerations of the states.
fn states(dof: usize) -> [Vec<Vec<f64>>; 3] {
    let mut random = Random::new(3);
    std::array::from_fn(|_| {
        let state = |_| (0..dof).map(|_| random.uniform(-3.0, 3.0)).collect();
        (0..STATES).map(state).collect()
    })
}

/// The torques by the interpreter, in all states.
fn expected(robot: &str, dof: usize) -> Vec<Vec<f64>> {
    let programs = programs(&source(robot), &options(Trigonometry::Standard, false)).unwrap();
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let [q, qd, qdd] = states(dof);
    let torques = |state: usize| {
        let inputs = [("q", &q[state][..]), ("qd", &qd[state]), ("qdd", &qdd[state])];
        interpreter.call("inverse_dynamics", &inputs).unwrap().remove(0).values
    };
    (0..STATES).map(torques).collect()
}

/// Code that computes the same states stored in columns, some of which are short, and in a block. The results are
/// bitwise equal to those of the batch.
fn columns_text(dof: usize) -> String {
    format!(
        "let (cq, cqd, cqdd) = (columns(&q), columns(&qd), columns(&qdd));\n\
                 let mut ctau = columns(&[[0.0; {dof}]; {STATES}]);\n\
                 let count = m.inverse_dynamics_columns(slices(&cq), slices(&cqd), slices(&cqdd), \
                   ctau.each_mut().map(|column| &mut column[..]));\n\
                 assert_eq!(count, {STATES});\n\
                 show(\"columns\", &states::<{dof}>(&ctau));\n\
                 // The bits of a block do not depend on where its states come from.\n\
                 assert_eq!(states::<{dof}>(&ctau), tau);\n\
                 let mut short = slices(&cq);\n\
                 short[1] = &short[1][..11];\n\
                 ctau.iter_mut().for_each(|column| column.fill(0.0));\n\
                 let count = m.inverse_dynamics_columns(short, slices(&cqd), slices(&cqdd), \
                   ctau.each_mut().map(|column| &mut column[..]));\n\
                 assert_eq!(count, 11);\n\
                 assert_eq!(states::<{dof}>(&ctau)[..11], tau[..11]);\n\
                 assert_eq!(states::<{dof}>(&ctau)[11..], [[0.0; {dof}]; {STATES} - 11]);\n\
                 let block = |c: &[Vec<f64>; {dof}]| -> [[f64; 8]; {dof}] {{\n    \
                   core::array::from_fn(|d| *c[d].first_chunk().unwrap())\n\
                 }};\n\
                 let lanes = m.inverse_dynamics_block(&block(&cq), &block(&cqd), &block(&cqdd));\n\
                 for (state, tau) in tau[..8].iter().enumerate() {{\n    \
                   assert_eq!(lanes.map(|lanes| lanes[state]), *tau);\n\
                 }}"
    )
}

/// Code that computes the mass matrices in the same states: a batch agrees with single calls to within rounding errors,
/// and columns are bitwise equal to the batch.
fn masses_text(dof: usize) -> String {
    format!(
        "let mut masses = [[[0.0; {dof}]; {dof}]; {STATES}];\n\
                 assert_eq!(m.mass_matrix_batch(&q, &mut masses), {STATES});\n\
                 for (q, mass) in q.iter().zip(&masses) {{\n    \
                   for (row, batch) in m.mass_matrix(q).iter().zip(mass) {{\n        \
                     for (a, b) in row.iter().zip(batch) {{ assert!((a - b).abs() < 1e-9); }}\n    \
                   }}\n\
                 }}\n\
                 // Of matrices each entry is stored by itself, those that are always 0 are not.\n\
                 let mut cm: [[Vec<f64>; {dof}]; {dof}] = \
                   core::array::from_fn(|_| columns(&[[0.0; {dof}]; {STATES}]));\n\
                 let rows = cm.each_mut().map(|row| row.each_mut().map(|column| &mut column[..]));\n\
                 assert_eq!(m.mass_matrix_columns(slices(&cq), rows), {STATES});\n\
                 for (state, mass) in masses.iter().enumerate() {{\n    \
                   assert_eq!(cm.each_ref().map(|row| row.each_ref().map(|column| column[state])), *mass);\n\
                 }}"
    )
}

/// A program that prints the torques in all states by each form, one line for each state.
fn main_text() -> String {
    let mut text = "#![deny(warnings)]\nmod cases;\nuse robot_runtime::{F32x8, F64x4, Scalar};\n\
        fn show<const N: usize>(form: &str, tau: &[[f64; N]]) {\n    \
            for tau in tau { println!(\"{form} {tau:?}\"); }\n\
        }\n\
        fn wide<T: Scalar, const N: usize>(values: &[f64; N]) -> [T; N] { values.map(T::from_f64) }\n\
        fn columns<const N: usize>(states: &[[f64; N]]) -> [Vec<f64>; N] {\n    \
            core::array::from_fn(|d| states.iter().map(|state| state[d]).collect())\n\
        }\n\
        fn slices<const N: usize>(columns: &[Vec<f64>; N]) -> [&[f64]; N] { columns.each_ref().map(|c| &c[..]) }\n\
        fn states<const N: usize>(columns: &[Vec<f64>; N]) -> Vec<[f64; N]> {\n    \
            (0..columns[0].len()).map(|i| core::array::from_fn(|d| columns[d][i])).collect()\n\
        }\n\
        fn main() {\n"
        .to_owned();
    for (module, dof, model) in [
        ("ur5", 6, "Model::NOMINAL"),
        ("trttr1", 5, "Model::new(&cases::CASE::Parameters::NOMINAL)"),
    ] {
        for case in ["standard", "polynomial"] {
            let path = format!("{case}::{module}");
            let model = model.replace("CASE", &path);
            let [q, qd, qdd] = states(dof);
            let each = "q.iter().zip(&qd).zip(&qdd).map(|((q, qd), qdd)|";
            let collect = ").collect::<Vec<_>>()";
            let (columns, masses) = (columns_text(dof), masses_text(dof));
            writeln!(
                text,
                "{{ let m = cases::{path}::{model};\n\
                 let (q, qd, qdd) = ({q:?}, {qd:?}, {qdd:?});\n\
                 show(\"plain\", &{each} m.inverse_dynamics(q, qd, qdd){collect});\n\
                 show(\"f64\", &{each} m.inverse_dynamics_generic(q, qd, qdd){collect});\n\
                 show(\"f32\", &{each} m.inverse_dynamics_generic(&wide::<f32, {dof}>(q), &wide(qd), \
                   &wide(qdd)).map(f64::from){collect});\n\
                 show(\"lanes\", &{each} m.inverse_dynamics_generic(&wide::<F64x4, {dof}>(q), &wide(qd), \
                   &wide(qdd)).map(|tau| tau.to_array()[3]){collect});\n\
                 show(\"f32\", &{each} m.inverse_dynamics_generic(&wide::<F32x8, {dof}>(q), &wide(qd), \
                   &wide(qdd)).map(|tau| tau.to_array()[7].into()){collect});\n\
                 let mut tau = [[0.0; {dof}]; {STATES}];\n\
                 assert_eq!(m.inverse_dynamics_batch(&q, &qd, &qdd, &mut tau), {STATES});\n\
                 show(\"batch\", &tau);\n\
                 {columns}\n\
                 {masses} }}"
            )
            .unwrap();
        }
    }
    text.push_str("println!(\"fused {}\", robot_runtime::FUSED);\n}\n");
    text
}

/// The code of both robots, with both implementations of sines.
fn cases_text(fused: bool) -> String {
    let mut text = String::new();
    for (case, trigonometry) in
        [("standard", Trigonometry::Standard), ("polynomial", Trigonometry::Polynomial)]
    {
        let code = |robot| generate(&source(robot), &options(trigonometry, fused)).unwrap().code;
        writeln!(text, "pub mod {case} {{\n{}\n{}\n}}", code(UR5), code(TRTTR1)).unwrap();
    }
    text
}

/// Compares the printed values with those of the interpreter; returns whether the program used fused operations.
fn hold(printed: &str) -> bool {
    let mut lines = printed.lines();
    for (robot, dof) in [(UR5, 6), (TRTTR1, 5)] {
        let expected = expected(robot, dof);
        let size = expected.iter().flatten().fold(0.0_f64, |size, tau| size.max(tau.abs()));
        // Two implementations of sines with seven forms each.
        for _ in 0..2 * 7 {
            for expected in &expected {
                let (form, values) = lines.next().unwrap().split_once(' ').unwrap();
                let tolerance = if form == "f32" { SINGLE_TOLERANCE } else { TOLERANCE };
                let values = values.trim_matches(['[', ']']).split(", ");
                for (value, expected) in values.zip(expected) {
                    let error = (value.parse::<f64>().unwrap() - expected).abs() / size;
                    assert!(error <= tolerance, "{form} is off by {error:e}");
                }
            }
        }
    }
    lines.next() == Some("fused true")
}

/// Compiler flags that this machine supports, each with whether multiply-add is a single instruction.
fn builds() -> Vec<(&'static str, bool)> {
    let mut builds = vec![("", cfg!(target_arch = "aarch64"))];
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        builds.push(("-Ctarget-feature=+avx2,+fma", true));
    }
    builds
}

#[test]
fn every_form_agrees_with_or_without_fused_instructions() {
    let runtime = dependency("robot_runtime", ", features = [\"std\"]");
    let package = Package::new("forms", &format!("[dependencies]\n{runtime}"));
    package.write("src/main.rs", &main_text());
    for fused in [false, true] {
        let code = cases_text(fused);
        assert_eq!(code.contains("mul_add"), fused);
        package.write("src/cases.rs", &code);
        for (flags, fuses) in builds() {
            assert_eq!(hold(&package.run_with(&["run"], flags)), fuses, "{flags}");
        }
    }
}

/// A function with more entries than one loop stores: columns have the bits of the slices.
#[test]
fn entries_of_large_matrices_are_stored_by_several_loops() {
    let functions = Functions::Chosen(vec![FunctionKind::Regressor]);
    let options = Options { functions, batch: Some(8), ..Options::default() };
    let generated = generate(&source(PANDA), &options).unwrap().code;
    let lanes = generated.split("fn regressor_lanes_with").nth(1).unwrap();
    let body = lanes.split("fn ").next().unwrap();
    assert_eq!(body.matches("for lane in 0..8").count(), 2, "{body}");
    let package = Package::new(
        "several_loops",
        &format!("[dependencies]\n{}", dependency("robot_runtime", ", features = [\"std\"]")),
    );
    package.write("src/cases.rs", &generated);
    let [q, qd, qdd] = states(7);
    let main = format!(
        "mod cases;
        type Regressor<const N: usize> = [[f64; N]; 7];
        fn columns(states: &[[f64; 7]]) -> [Vec<f64>; 7] {{
            core::array::from_fn(|d| states.iter().map(|state| state[d]).collect())
        }}
        fn check<const N: usize>(
            batch: impl Fn(&mut [Regressor<N>]) -> usize,
            by_columns: impl Fn([[&mut [f64]; N]; 7]) -> usize,
        ) {{
            let mut states = vec![[[0.0; N]; 7]; {STATES}];
            assert_eq!(batch(&mut states), {STATES});
            let mut found: [[Vec<f64>; N]; 7] =
                core::array::from_fn(|_| core::array::from_fn(|_| vec![0.0; {STATES}]));
            let slices = found.each_mut().map(|row| row.each_mut().map(|column| &mut column[..]));
            assert_eq!(by_columns(slices), {STATES});
            for (state, regressor) in states.iter().enumerate() {{
                for (row, columns) in regressor.iter().zip(&found) {{
                    for (entry, column) in row.iter().zip(columns) {{
                        assert_eq!(entry.to_bits(), column[state].to_bits());
                    }}
                }}
            }}
            println!(\"{{}} entries\", 7 * N);
        }}
        fn main() {{
            let m = cases::panda::Model::NOMINAL;
            let (q, qd, qdd) = ({q:?}, {qd:?}, {qdd:?});
            let (cq, cqd, cqdd) = (columns(&q), columns(&qd), columns(&qdd));
            fn slices(columns: &[Vec<f64>; 7]) -> [&[f64]; 7] {{ columns.each_ref().map(|column| &column[..]) }}
            check(
                |states| m.regressor_batch(&q, &qd, &qdd, states),
                |regressor| m.regressor_columns(slices(&cq), slices(&cqd), slices(&cqdd), regressor),
            );
        }}"
    );
    package.write("src/main.rs", &main);
    let printed = package.run_with(&["run"], "");
    assert!(printed.contains("entries"), "{printed}");
}
