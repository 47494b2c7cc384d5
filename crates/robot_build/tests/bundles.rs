//! Functions that the robot file chooses, and bundles.

#![allow(clippy::unwrap_used)]

use robot_build::{Bundle, Effects, FunctionKind, Functions, Options, Source, generate, programs};
use robot_codegen::Interpreter;

const ROBOT: &str = include_str!("../../../robots/trttr1.toml");

fn source(more: &str) -> Source {
    Source { name: "arm.toml".to_owned(), text: format!("{ROBOT}\n{more}") }
}

fn bundle(name: &str, functions: &[FunctionKind]) -> Bundle {
    Bundle { name: name.to_owned(), functions: functions.to_vec() }
}

fn names(source: &Source, options: &Options) -> Vec<String> {
    let functions = programs(source, options).unwrap().module.functions;
    functions.into_iter().map(|function| function.name).collect()
}

#[test]
fn the_file_chooses_where_the_caller_does_not() {
    let both = "bundles = { both = [\"mass_matrix\", \"bias\"] }\n";
    let singly = source("[code]\nfunctions = [\"bias\", \"gravity\"]\n");
    let together = source(&format!("[code]\nfunctions = [\"gravity\"]\n{both}"));
    let alone = source(&format!("[code]\n{both}"));
    let usual = Options::default();
    assert_eq!(names(&singly, &usual), ["bias", "gravity"]);
    assert_eq!(names(&together, &usual), ["gravity", "both"]);
    assert_eq!(names(&alone, &usual), ["both"]);
    assert!(names(&source("[code]\n"), &usual).contains(&"inverse_dynamics".to_owned()));

    let functions = Functions::Chosen(vec![FunctionKind::MassMatrix]);
    let named = Options { functions, ..Options::default() };
    assert_eq!(names(&together, &named), ["mass_matrix"]);
    let bundles = vec![bundle("one", &[FunctionKind::Gravity])];
    assert_eq!(names(&together, &Options { bundles, ..Options::default() }), ["one"]);
    let all = Options { functions: Functions::All, ..Options::default() };
    let of_file = source("[code]\nfunctions = [\"all\"]\n");
    assert_eq!(names(&of_file, &usual), names(&source(""), &all));
}

/// Bundles of functions, and the most operations that they may have, in percent of those of the separate functions.
const SETS: [(&[FunctionKind], usize); 6] = {
    use FunctionKind::{
        Bias, CoriolisMatrix, Energies, ForwardDynamics, Gravity, InverseDynamics,
        InverseDynamicsDerivatives, MassMatrix,
    };
    [
        (FunctionKind::ALL, 75),
        (&[MassMatrix, Bias, InverseDynamics(Effects::NONE)], 75),
        (&[CoriolisMatrix, Gravity, Bias], 85),
        (&[MassMatrix, Energies], 85),
        // 79 of 95 operations for this robot; the Coriolis matrix has too few operations to share more.
        (&[CoriolisMatrix, InverseDynamicsDerivatives], 84),
        (&[MassMatrix, Bias, ForwardDynamics(Effects::NONE)], 65),
    ]
};

#[test]
fn a_bundle_gives_what_its_functions_give_for_less() {
    let puma = include_str!("../../../robots/puma560.toml").to_owned();
    let puma = Source { name: "puma560.toml".to_owned(), text: puma };
    for source in [source(""), puma] {
        for (kinds, percent) in SETS {
            let robot = robot_build::read(&source).unwrap().robot;
            let has = |kind: &FunctionKind| kind.missing_in(&robot).is_none();
            let kinds: Vec<FunctionKind> = kinds.iter().copied().filter(has).collect();
            assert_bundle_agrees(&source, &kinds, percent);
        }
    }
}

/// Compares a bundle of functions with the separate functions.
fn assert_bundle_agrees(source: &Source, kinds: &[FunctionKind], percent: usize) {
    let functions = Functions::Chosen(kinds.to_vec());
    let bundles = vec![bundle("together", kinds)];
    let options = Options { functions, bundles, ..Options::default() };
    let module = programs(source, &options).unwrap().module;
    let interpreter = Interpreter::new(&module, &[]).unwrap();
    let (together, apart) = module.functions.split_last().unwrap();
    let entries = |input: usize, count: usize| -> Vec<f64> {
        (0..count).map(|entry| (1.7 * (entry + 5 * input) as f64 + 0.3).sin()).collect()
    };
    let inputs = together.inputs.iter().enumerate();
    let inputs: Vec<(&str, Vec<f64>)> = inputs
        .map(|(index, input)| (input.name.as_str(), entries(index, input.symbols.len())))
        .collect();
    let call = |function: &robot_codegen::module::Function| {
        let takes = |name: &str| function.inputs.iter().any(|input| input.name == name);
        let given = inputs.iter().filter(|(name, _)| takes(name));
        let given: Vec<(&str, &[f64])> =
            given.map(|(name, entries)| (*name, entries.as_slice())).collect();
        interpreter.call(&function.name, &given).unwrap()
    };
    let expected: Vec<_> = apart.iter().flat_map(call).collect();
    let found = call(together);
    assert_eq!((found.len(), apart.len()), (expected.len(), kinds.len()));
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.values.len(), expected.values.len());
        let size = expected.values.iter().fold(1e-3_f64, |size, value| size.max(value.abs()));
        for (value, expected) in found.values.iter().zip(&expected.values) {
            let error = (value - expected).abs() / size;
            assert!(error < 1e-11, "{}: {value} for {expected}", found.name);
        }
    }
    let operations = |function| module.counts(function).call.operations();
    let (sum, all): (usize, usize) = (apart.iter().map(operations).sum(), operations(together));
    assert!(all * 100 < sum * percent, "{kinds:?}: {all} together, {sum} apart");
}

/// A parameter of 0 by which the base parameters are divided: the torques of the bundle are still those of the function.
#[test]
fn a_divisor_of_one_function_is_none_of_another() {
    let inertia = "inertia = { xx = 0.1, yy = 0.12, zz = 0.09 }";
    let text = format!(
        "format = 1
[robot]
name = \"skew\"
gravity = [0, 0, \"-g\"]
[parameters]
g = 9.81
ax = 0.6
ay = 0.8
az = 0.2
m1 = 2
m2 = 1
l = 0.4
[[link]]
name = \"one\"
mass = \"m1\"
joint = {{ type = \"revolute\", axis = [\"ax\", \"ay\", \"az\"] }}
center_of_mass = [0.1, 0.02, 0.03]
{inertia}
[[link]]
name = \"two\"
mass = \"m2\"
origin = {{ xyz = [\"l\", 0, 0] }}
joint = {{ type = \"revolute\", axis = [\"ax\", 0, \"az\"] }}
center_of_mass = [0.2, 0.01, 0.05]
{inertia}
"
    );
    let source = Source { name: "skew.toml".to_owned(), text };
    let kinds = [FunctionKind::InverseDynamics(Effects::NONE), FunctionKind::BaseParameters];
    let functions = Functions::Chosen(kinds[..1].to_vec());
    let options =
        Options { functions, bundles: vec![bundle("together", &kinds)], ..Options::default() };
    let module = programs(&source, &options).unwrap().module;
    let state: [(&str, &[f64]); 3] =
        [("q", &[0.1, 0.2]), ("qd", &[0.3, 0.4]), ("qdd", &[0.5, 0.6])];
    for zeros in [vec![], vec!["ay"], vec!["ax", "ay"], vec!["az"]] {
        let given: Vec<(&str, f64)> = zeros.iter().map(|name| (*name, 0.0)).collect();
        let interpreter = Interpreter::new(&module, &given).unwrap();
        let apart = interpreter.call("inverse_dynamics", &state).unwrap().remove(0).values;
        let mut together = interpreter.call("together", &state).unwrap();
        assert_eq!(together[1].values.iter().all(|value| value.is_finite()), zeros.is_empty());
        for (value, expected) in together.remove(0).values.iter().zip(&apart) {
            assert!((value - expected).abs() < 1e-12, "{zeros:?}: {value} for {expected}");
        }
    }
}

#[test]
fn outputs_of_one_name_are_told_apart() {
    let bundles = vec![bundle("everything", FunctionKind::ALL)];
    let options = Options { bundles, ..Options::default() };
    let module = programs(&source(""), &options).unwrap().module;
    let outputs = module.functions[0].outputs.iter();
    let fields: Vec<&str> = outputs.map(|output| output.name.as_str()).collect();
    for field in ["bias", "gravity", "force", "frame_poses_rotation", "forward_kinematics_position"]
    {
        assert!(fields.contains(&field), "{field} is not in {fields:?}");
    }
}

#[test]
fn budgets_hold_bundles_by_their_names() {
    let code = "[code]\nbundles = { bias_and_more = [\"bias\", \"mass_matrix\"] }\n";
    let budget = |function: &str, most: u64| {
        let text = format!("[[budget]]\nfunction = \"{function}\"\nmax_operations = {most}\n");
        source(&format!("{code}{text}"))
    };
    let module = programs(&source(code), &Options::default()).unwrap().module;
    let cost = module.counts(&module.functions[0]).call.operations() as u64;
    generate(&budget("bias_and_more", cost), &Options::default()).unwrap();
    // The bundle is not a form of the function whose name is the start of its own.
    generate(&budget("bias", 0), &Options::default()).unwrap();
    let error = generate(&budget("bias_and_more", cost - 1), &Options::default()).unwrap_err();
    let stated = format!("`bias_and_more` takes {cost} operations; its budget is {}", cost - 1);
    assert!(error.to_string().contains(&stated), "{error}");
}

#[test]
fn wrong_bundles_of_the_caller_are_errors() {
    let kinds = [FunctionKind::Bias];
    let bundles = vec![
        bundle("mass_matrix", &kinds),
        bundle("a-b", &kinds),
        bundle("twice", &kinds),
        bundle("Twice", &kinds),
        bundle("empty", &[]),
    ];
    let error = programs(&source(""), &Options { bundles, ..Options::default() }).unwrap_err();
    assert_eq!(error.as_slice().len(), 4, "{error}");
    for part in [
        "the bundle `mass_matrix`: the name is not allowed: it is reserved: the name of a function",
        "the bundle `a-b`: the name is not allowed",
        "the bundle `Twice`: the name is that of another bundle",
        "the bundle `empty`: it has no functions",
    ] {
        assert!(error.to_string().contains(part), "{part} is not in {error}");
    }
    let arm = include_str!("../../../robots/planar_2r.toml").to_owned();
    let arm = Source { name: "arm.toml".to_owned(), text: arm };
    let bundles = vec![bundle("load", &[FunctionKind::InverseDynamics(Effects::FRICTION)])];
    let error = programs(&arm, &Options { bundles, ..Options::default() }).unwrap_err();
    assert!(error.to_string().contains("has no function `inverse_dynamics_friction`"), "{error}");
}

/// A module states the places of the entries of `mass_matrix_lower` if it computes them, in a function or in a bundle.
#[test]
fn places_of_the_lower_half_are_stated_with_its_entries() {
    use FunctionKind::{Bias, MassMatrix, MassMatrixLower};
    let cases: [(&[FunctionKind], &[FunctionKind], bool); 6] = [
        (&[MassMatrix, Bias], &[], false),
        (&[MassMatrixLower], &[], true),
        (&[MassMatrix], &[MassMatrix, Bias], false),
        (&[MassMatrixLower], &[MassMatrix, Bias], true),
        (&[MassMatrix], &[MassMatrixLower], true),
        (&[MassMatrix], &[Bias, MassMatrixLower], true),
    ];
    for (functions, bundled, are_stated) in cases {
        let bundles = if bundled.is_empty() { vec![] } else { vec![bundle("together", bundled)] };
        let functions = Functions::Chosen(functions.to_vec());
        let options = Options { functions, bundles, ..Options::default() };
        let code = generate(&source(""), &options).unwrap().code;
        let found = code.contains("pub const MASS_MATRIX_LOWER:");
        assert_eq!(found, are_stated, "{:?}, {bundled:?}", options.functions);
    }
}
