//! Compares every function that the numeric solver has, with the default plan and with random plans.

use robot_dynamics::economical::plan::{LinkPlan, Origin, Turn};
use robot_dynamics::economical::{Plan, Solver};
use robot_dynamics::functions::{Derivation, Output, undetermined};
use robot_dynamics::matrix::Pivots;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::{Bundle, Effects, FunctionKind, coupled};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Expr, Graph, operations, walk};

use crate::{STATES, TOLERANCE};
use robot_testing::place::{Layout, Off};
use robot_testing::plans::random_plan;
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, magnitude};

/// All functions except those of base parameters, which `base_parameters.rs` tests.
fn kinds(robot: &Robot) -> impl Iterator<Item = FunctionKind> {
    let over_base = [FunctionKind::RegressorBase, FunctionKind::BaseParameters];
    FunctionKind::of_robot(robot).into_iter().filter(move |kind| !over_base.contains(kind))
}

/// The outputs that the solver can compute; of the regressor, only the columns of the links.
pub(crate) fn outputs<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Output<'g>> {
    let functions = derivation.functions(kind).into_iter();
    let mut outputs: Vec<_> = functions.flat_map(|function| function.outputs).collect();
    if kind == FunctionKind::Regressor {
        let inertial = robot_model::robot::LINK_PARAMETERS * derivation.robot.links.len();
        for output in &mut outputs {
            let rows = output.values.chunks(output.shape[1]);
            output.values = rows.flat_map(|row| row[..inertial].to_vec()).collect();
            output.shape[1] = inertial;
        }
    }
    outputs
}

#[test]
fn functions_agree_with_the_numeric_solver() {
    for (name, robot, seed) in crate::robots() {
        let mut random = Random::new(seed);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let states: Vec<_> = (0..STATES).map(|_| state(&mut random, &solver, &robot)).collect();
        let graph = Graph::new();
        let usual = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let mut drawn: Vec<Plan> = (0..2).map(|_| random_plan(&mut random, &robot)).collect();
        // The file's frames, whose axes lie along any axis of the frame before.
        let file = LinkPlan { origin: Origin::File, turn: Turn::File, ..LinkPlan::DEFAULT };
        drawn.push(Plan::uniform(robot.links.len(), &file));
        let drawn: Vec<_> = drawn.iter().map(|plan| (usual.with_plan(plan), plan)).collect();
        for kind in kinds(&robot) {
            let expected: Vec<Vec<f64>> =
                states.iter().map(|state| expected(&robot, &solver, kind, state)).collect();
            let size = magnitude(expected.iter().flatten()).max(1e-3);
            let assert_agrees = |derivation: &Derivation<'_, '_>, plan: Option<&Plan>| {
                let outputs = outputs(derivation, kind);
                let layout = Layout::of(&robot, &outputs);
                let roots: Vec<Expr<'_>> =
                    outputs.into_iter().flat_map(|output| output.values).collect();
                for (state, expected) in states.iter().zip(&expected) {
                    let off = Off::of(&layout, &evaluate(&robot, &roots, state), expected, size);
                    assert!(off.error <= TOLERANCE, "{name}, {}: {off}\n{plan:?}", kind.name());
                }
            };
            assert_agrees(&usual, None);
            // The forms of the derivatives are compared by their operations, which takes long.
            if kind != FunctionKind::InverseDynamicsDerivatives {
                drawn.iter().for_each(|(derivation, plan)| assert_agrees(derivation, Some(plan)));
            }
        }
    }
}

/// From nine coordinates on, the mass matrix has the form with the fewest operations: at most seventeen for each entry
/// of chains about arbitrary axes, and fewer than forward dynamics for forty joints.
#[test]
fn mass_matrices_of_many_joints() {
    let recipes = [
        Recipe::serial(12),
        Recipe::serial(40),
        Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(16) },
        Recipe { drives: true, ..Recipe::tree(30) },
    ];
    for (seed, recipe) in (40..).zip(recipes) {
        let mut random = Random::new(seed);
        let robot = robots::robot(&mut random, &recipe);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let roots = |kind| -> Vec<Expr<'_>> {
            outputs(&derivation, kind).into_iter().flat_map(|output| output.values).collect()
        };
        for kind in [FunctionKind::MassMatrix, FunctionKind::MassMatrixLower] {
            let roots = roots(kind);
            for _ in 0..STATES {
                let state = state(&mut random, &solver, &robot);
                let expected = expected(&robot, &solver, kind, &state);
                let size = magnitude(expected.iter());
                let layout = Layout::of(&robot, &outputs(&derivation, kind));
                let off = Off::of(&layout, &evaluate(&robot, &roots, &state), &expected, size);
                assert!(off.error <= TOLERANCE, "seed {seed}, {}: {off}", kind.name());
            }
        }
        let cost = |kind| operations(&roots(kind), |_| false).flops();
        let lower = FunctionKind::MassMatrixLower;
        let (entries, cost_of_lower) = (roots(lower).len(), cost(lower));
        println!("{} joints: {entries} entries, {cost_of_lower} operations", recipe.joints);
        assert_eq!(cost_of_lower, cost(FunctionKind::MassMatrix));
        if recipe.joints == 40 {
            assert!(cost_of_lower <= 17 * entries, "{cost_of_lower}");
            let forward = cost(FunctionKind::ForwardDynamics(Effects::NONE));
            assert!(cost_of_lower < forward, "{cost_of_lower} {forward}");
        }
    }
}

/// The number of operations of forward dynamics is proportional to the length of a chain, because joints are eliminated
/// one by one. With the mass matrix, it would grow with the third power. If a coordinate moves two joints, elimination
/// is not possible.
#[test]
fn forward_dynamics_of_many_joints_is_linear_in_them() {
    let cost = |recipe: &Recipe| {
        let robot = robots::robot(&mut Random::new(7), recipe);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let outputs = outputs(&derivation, FunctionKind::ForwardDynamics(Effects::NONE));
        let roots: Vec<_> = outputs.into_iter().flat_map(|output| output.values).collect();
        operations(&roots, |_| false).flops()
    };
    let [some, many] = [16, 32].map(|joints| cost(&Recipe::serial(joints)));
    println!("{some} {many}");
    assert!(many < 5 * some / 2, "{some} {many}");
    assert!(many < 32 * 700, "{many}");
}

/// The pivots of more than sixteen joints are those of this elimination, with as many operations for each joint.
#[test]
fn pivots_of_many_joints_are_linear_in_them() {
    let cost = |joints: usize| {
        let robot = robots::robot(&mut Random::new(7), &Recipe::serial(joints));
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        operations(&derivation.pivots().outputs[0].values, |_| false).flops()
    };
    let [some, many] = [17, 34].map(cost);
    println!("{some} {many}");
    assert!(many < 5 * some / 2, "{some} {many}");
}

/// The product of the pivots of M = Lᵀ D L is the determinant of M, and the outermost pivot is the last entry of the
/// diagonal.
#[test]
fn pivots_multiply_to_the_determinant() {
    let mut count = 0;
    for (name, robot, seed) in crate::robots() {
        let mut random = Random::new(seed);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let [pivots, diagonal] =
            derivation.pivots().outputs.try_into().map(|it: [Output<'_>; 2]| it).unwrap();
        for _ in 0..STATES {
            let state = state(&mut random, &solver, &robot);
            let matrix = solver.mass_matrix(&state.q).unwrap();
            let found = evaluate(&robot, &pivots.values, &state);
            let (product, determinant) = (found.iter().product::<f64>(), matrix.determinant());
            let size: f64 = matrix.diagonal().iter().product();
            assert!(
                (product - determinant).abs() <= 1e-9 * size,
                "{name}: {product} {determinant}"
            );
            let found = evaluate(&robot, &diagonal.values, &state);
            for (row, value) in found.iter().enumerate() {
                let expected = matrix[(row, row)];
                assert!((value - expected).abs() <= TOLERANCE * magnitude(found.iter()), "{name}");
            }
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

/// The forms of the torques' derivatives and of the Coriolis matrix differ in their operations, so no form is
/// redundant.
#[test]
fn forms_of_derivatives_differ() {
    let robot = robot_testing::robot("puma560");
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let recursion = derivation.recursion.as_ref().unwrap();
    let cost = |roots: &[Expr<'_>]| operations(roots, |_| false).flops();
    let forms = recursion.torque_derivatives();
    let rows = forms.iter().map(|form| [form.positions.rows(), form.velocities.rows()]);
    let mut costs: Vec<[usize; 2]> =
        rows.map(|rows| rows.each_ref().map(|rows| cost(rows))).collect();
    let mut coriolis: Vec<usize> =
        recursion.coriolis_matrix().iter().map(|form| cost(&form.rows())).collect();
    println!("{costs:?} {coriolis:?}");
    costs.sort_unstable();
    costs.dedup();
    coriolis.dedup();
    assert_eq!((costs.len(), coriolis.len()), (3, 2), "{costs:?} {coriolis:?}");
}

/// The lower triangle for a robot with two legs does not contain the entries that couple one leg with the other.
#[test]
fn entries_between_branches_are_left_out() {
    let mut robot = robots::robot(&mut Random::new(1), &Recipe::serial(4));
    robot.links[2].parent = None;
    assert_eq!(coupled(&robot), [[0, 0], [1, 0], [1, 1], [2, 2], [3, 2], [3, 3]]);
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let values = |kind: FunctionKind| outputs(&derivation, kind).remove(0).values;
    let (full, lower) = (values(FunctionKind::MassMatrix), values(FunctionKind::MassMatrixLower));
    let places = coupled(&robot);
    let of_full: Vec<_> = places.iter().map(|[row, column]| full[row * 4 + column]).collect();
    assert_eq!(lower, of_full);
    let zeros = (0..16).filter(|place| full[*place].is_zero()).count();
    assert_eq!(zeros, 8);
}

/// Functions that have others in a bundle are made from them if that is cheaper: a bundle costs no more than its functions
/// one by one, and with the same values.
#[test]
fn functions_of_a_bundle_share_their_work() {
    use FunctionKind::{
        Bias, CoriolisMatrix, Energies, ForwardDynamics, Gravity, InverseDynamics,
        InverseDynamicsDerivatives, MassMatrix,
    };
    let [torques, accelerations] = [InverseDynamics(Effects::NONE), ForwardDynamics(Effects::NONE)];
    let bundles = [
        vec![torques, InverseDynamicsDerivatives],
        vec![CoriolisMatrix, InverseDynamicsDerivatives],
        vec![CoriolisMatrix, Gravity, Bias],
        vec![MassMatrix, Bias, torques],
        vec![MassMatrix, Bias, accelerations],
        vec![MassMatrix, Energies],
    ];
    for name in ["puma560", "scara", "trttr1"] {
        let robot = robot_testing::robot(name);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let state =
            state(&mut Random::new(9), &robot_numeric::Mechanism::nominal(&robot).unwrap(), &robot);
        let cost = |roots: &[Expr<'_>]| operations(roots, |_| false).flops();
        for functions in &bundles {
            let bundle = Bundle { name: "several".to_owned(), functions: functions.clone() };
            let of_bundle: Vec<Expr<'_>> =
                derivation.bundle(&bundle).outputs.into_iter().flat_map(|one| one.values).collect();
            let apart: Vec<Expr<'_>> = functions
                .iter()
                .flat_map(|kind| outputs(&derivation, *kind))
                .flat_map(|one| one.values)
                .collect();
            let (values, expected) =
                (evaluate(&robot, &of_bundle, &state), evaluate(&robot, &apart, &state));
            let off = robot_testing::largest_difference(&values, &expected);
            assert!(off <= TOLERANCE * magnitude(&expected), "{name}, {functions:?}: {off}");
            let (shared, single) = (cost(&of_bundle), cost(&apart));
            println!("{name} {functions:?}: {shared} {single}");
            assert!(shared <= single, "{name}, {functions:?}: {shared} {single}");
            // What is made from the others has at least a tenth fewer.
            let is_made = functions.contains(&MassMatrix) || functions.contains(&CoriolisMatrix);
            if name == "puma560" && is_made && !functions.contains(&accelerations) {
                assert!(shared * 10 <= single * 9, "{name}, {functions:?}: {shared} {single}");
            }
        }
        // Of the forms of the derivatives the one that goes best with the torques; parameters would cost nothing.
        if !robot.parameters.is_empty() {
            continue;
        }
        let torques = outputs(&derivation, torques).remove(0).values;
        let forms = derivation.recursion.as_ref().unwrap().torque_derivatives();
        let least = forms.iter().map(|form| {
            cost(&[torques.clone(), form.positions.rows(), form.velocities.rows()].concat())
        });
        let bundle = Bundle { name: "both".to_owned(), functions: bundles[0].clone() };
        let found = derivation.bundle(&bundle).outputs.into_iter().flat_map(|one| one.values);
        let (found, least) = (cost(&found.collect::<Vec<_>>()), least.min().unwrap());
        println!("{name}: {found} {least}");
        assert!(found <= least, "{name}: {found} {least}");
    }
}

/// What the documentation says of digits and of pivots is what the code does: a decomposition that is checked for every
/// wrong pivot where it may have one, and articulated bodies where it would lose digits.
#[test]
fn forward_dynamics_says_how_it_solves() {
    let doc = |robot: &Robot| {
        let graph = Graph::new();
        let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
        let kinds = [
            FunctionKind::ForwardDynamics(Effects::NONE),
            FunctionKind::ForwardDynamicsDerivatives,
        ];
        kinds.map(|kind| derivation.functions(kind).remove(0).doc.join(" "))
    };
    for said in doc(&robot_testing::robot("puma560")) {
        assert!(said.contains("Digits are lost if a pivot of the mass matrix"), "{said}");
        assert!(said.contains("does not check for one"), "{said}");
    }
    let link = |name: &str, axis: &str, body: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\" }}\n{body}\n"
        )
    };
    // Where the axes of the first and the last joint are one, nothing is left of the pivot of the first.
    let hand = "mass = 0.8\ncenter_of_mass = [0.03, 0.02, 0.05]\ninertia = { xx = 0.004, yy = 0.003, zz = 0.002 }";
    let links = [
        link("roll", "z", "massless = true"),
        link("tilt", "y", "massless = true"),
        link("hand", "z", hand),
    ];
    let gimbals = format!("format = 1\n[robot]\nname = \"wrist\"\n{}", links.concat());
    for said in doc(&robot_testing::read("wrist", &gimbals)) {
        assert!(said.contains("Uses the articulated-body algorithm"), "{said}");
        assert!(said.contains("are NaN"), "{said}");
    }
}

/// A function takes the wrenches of the tips if its values depend on them, and all else on which they depend.
#[test]
fn functions_take_what_they_depend_on() {
    for name in ["scara", "stanford"] {
        let robot = robot_testing::robot(name);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let wrenches: Vec<&str> =
            robot.tips().flat_map(|(_, wrench)| wrench.components()).collect();
        let (mut with, mut without) = (0, 0);
        for function in
            FunctionKind::of_robot(&robot).iter().flat_map(|kind| derivation.functions(*kind))
        {
            let values: Vec<Expr<'_>> =
                function.outputs.iter().flat_map(|output| output.values.clone()).collect();
            let used: Vec<String> = walk::symbols(&values)
                .into_iter()
                .map(|symbol| graph.symbol_name(symbol))
                .collect();
            let taken: Vec<&String> =
                function.inputs.iter().flat_map(|input| &input.symbols).collect();
            for symbol in &used {
                let known = taken.contains(&symbol) || robot.parameter(symbol).is_some();
                assert!(known, "{name}, {}: {symbol}", function.name);
            }
            let uses_wrenches = used.iter().any(|symbol| wrenches.contains(&symbol.as_str()));
            let takes_wrenches = taken.iter().any(|symbol| wrenches.contains(&symbol.as_str()));
            assert_eq!(takes_wrenches, uses_wrenches, "{name}, {}", function.name);
            *(if takes_wrenches { &mut with } else { &mut without }) += 1;
        }
        assert!(with > 2 && without > 10, "{name}: {with} {without}");
    }
}

/// The joint torques do not determine the acceleration of a joint that moves no mass, nor those of two joints about one
/// axis with no mass between them.
#[test]
fn joints_whose_accelerations_are_not_determined() {
    let body = "mass = 0.8\ncenter_of_mass = [0.03, 0.02, 0.05]\ninertia = { xx = 0.004, yy = 0.003, zz = 0.002 }";
    let of = |links: &[(&str, &str)]| {
        let links = (1..).zip(links).map(|(number, (axis, body))| {
            let joint = format!("joint = {{ type = \"revolute\", axis = \"{axis}\" }}");
            format!("[[link]]\nname = \"link{number}\"\n{joint}\n{body}\n")
        });
        let text = format!("format = 1\n[robot]\nname = \"arm\"\n{}", links.collect::<String>());
        undetermined(&robot_testing::read("arm", &text))
    };
    let idle = "massless = true";
    assert_eq!(of(&[("z", body)]), [0; 0]);
    assert_eq!(of(&[("z", idle), ("y", body)]), [0; 0]);
    assert_eq!(of(&[("z", body), ("y", idle)]), [1]);
    assert_eq!(of(&[("y", body), ("z", idle), ("z", body)]), [1, 2]);
}

/// Outputs of a bundle have the names of their functions, of functions with several outputs the outputs' own, with the
/// function's before it where two have the same.
#[test]
fn outputs_of_a_bundle_have_names_of_their_own() {
    use FunctionKind::{Energies, ForwardKinematics, FramePoses, Gravity};
    let robot = robot_testing::robot("puma560");
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let names = |functions: &[FunctionKind]| -> Vec<String> {
        let bundle = Bundle { name: "several".to_owned(), functions: functions.to_vec() };
        derivation.bundle(&bundle).outputs.into_iter().map(|output| output.name).collect()
    };
    let own = |kind: FunctionKind| -> Vec<String> {
        derivation.functions(kind).remove(0).outputs.into_iter().map(|one| one.name).collect()
    };
    assert_eq!(names(&[Gravity, Energies]), [vec!["gravity".to_owned()], own(Energies)].concat());
    let prefixed = |kind: FunctionKind| -> Vec<String> {
        own(kind).iter().map(|name| format!("{}_{name}", kind.name())).collect()
    };
    assert_eq!(own(ForwardKinematics), own(FramePoses));
    let expected = [prefixed(ForwardKinematics), prefixed(FramePoses)].concat();
    assert_eq!(names(&[ForwardKinematics, FramePoses]), expected);
}

/// Each way of solving M q̈ = τ − C q̇ − g gives the solver's accelerations, whether pivots are checked or not; joint by joint
/// it applies if each coordinate moves one joint.
#[test]
fn every_way_of_solving_has_the_solvers_accelerations() {
    let kind = FunctionKind::ForwardDynamics(Effects::NONE);
    let (mut alone, mut shared) = (0, 0);
    for (name, robot, seed) in crate::robots() {
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let Some(recursion) = &derivation.recursion else { continue };
        let moved =
            |index: usize| robot.links.iter().filter(|link| link.joint.coordinate == index).count();
        let moves_one = (0..robot.degrees_of_freedom()).all(|index| moved(index) == 1);
        *(if moves_one { &mut alone } else { &mut shared }) += 1;
        let torques = robot.symbols(JointVariable::Torque);
        let torques: Vec<Expr<'_>> = torques.iter().map(|name| graph.symbol(name)).collect();
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let state = state(&mut Random::new(seed), &solver, &robot);
        let expected = expected(&robot, &solver, kind, &state);
        for method in [Solver::MassMatrix, Solver::ArticulatedBodies, Solver::SmallPivots] {
            for pivots in [Pivots::Checked, Pivots::Positive] {
                let found = recursion.forward_dynamics(&torques, false, method, pivots);
                let applies = moves_one || method == Solver::MassMatrix;
                assert_eq!(found.is_some(), applies, "{name}, {method:?}");
                let Some(found) = found else { continue };
                let values = evaluate(&robot, &found, &state);
                let off = robot_testing::largest_difference(&values, &expected);
                assert!(off <= TOLERANCE * magnitude(&expected), "{name}, {method:?}: {off}");
            }
        }
    }
    assert!(alone > 10 && shared > 3, "{alone} {shared}");
}
