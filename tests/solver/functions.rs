//! Compares every dynamic function with the numeric solver, for every robot file and for random chains and trees, with
//! random plans.

use robot_dynamics::economical::{Plan, Recursion};
use robot_dynamics::functions::{Derivation, Output, search_plan};
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::functions;
use robot_model::functions::{Effects, FrameRef, FunctionKind};
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::differentiate::{forward, reverse};
use robot_symbolic::{Expr, Graph, operations};

use robot_testing::place::{Layout, Off};
use robot_testing::plans::random_plan;
use robot_testing::solver::{expected, state};
use robot_testing::{evaluate, magnitude, robot_files, with_free_axes};

const STATES: usize = 12;
const TOLERANCE: f64 = 1e-11;

/// The functions that other files compare with the solver: `recursions.rs`, `regressor.rs`, `base_parameters.rs`.
const ELSEWHERE: [FunctionKind; 8] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::InverseDynamics(Effects::WRENCH),
    FunctionKind::InverseDynamics(Effects::FRICTION),
    FunctionKind::InverseDynamics(Effects::BOTH),
    FunctionKind::LinkWrenches,
    FunctionKind::Regressor,
    FunctionKind::RegressorBase,
    FunctionKind::BaseParameters,
];

/// The functions that are compared with the solver here: all others.
fn kinds() -> Vec<FunctionKind> {
    let kinds = FunctionKind::ALL.iter().copied();
    kinds.filter(|kind| !ELSEWHERE.contains(kind)).collect()
}

fn outputs<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Output<'g>> {
    let functions = derivation.functions(kind).into_iter();
    let outputs: Vec<_> = functions.flat_map(|function| function.outputs).collect();
    for output in &outputs {
        assert_eq!(output.values.len(), output.shape.iter().product::<usize>(), "{}", output.name);
    }
    outputs
}

fn values<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Expr<'g>> {
    outputs(derivation, kind).into_iter().flat_map(|output| output.values).collect()
}

/// Updates the largest error of each function, relative to its largest value over the states.
fn check(robot: &Robot, seed: u64, name: &str, worst: &mut [f64]) {
    let mut random = Random::new(seed);
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let states: Vec<State> = (0..STATES).map(|_| state(&mut random, &solver, robot)).collect();
    let graph = Graph::new();
    let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
    let drawn: Vec<Plan> = (0..3).map(|_| random_plan(&mut random, robot)).collect();
    let mut derivations = vec![derivation];
    derivations.extend(drawn.iter().map(|plan| derivations[0].with_plan(plan)).collect::<Vec<_>>());
    for (kind, worst) in kinds().into_iter().zip(worst) {
        if kind.missing_in(robot).is_some() {
            continue;
        }
        let expected: Vec<_> =
            states.iter().map(|state| expected(robot, &solver, kind, state)).collect();
        let size = magnitude(expected.iter().flatten()).max(1e-3);
        // The different ways of computing the derivatives have a separate test.
        let slow = kind == FunctionKind::InverseDynamicsDerivatives;
        let derivations = derivations.iter().take(if slow { 1 } else { usize::MAX });
        for (number, derivation) in derivations.enumerate() {
            let outputs = outputs(derivation, kind);
            let layout = Layout::of(robot, &outputs);
            let roots: Vec<_> = outputs.into_iter().flat_map(|output| output.values).collect();
            for (state, expected) in states.iter().zip(&expected) {
                let found = evaluate(robot, &roots, state);
                let off = Off::of(&layout, &found, expected, size);
                let function = kind.name();
                assert!(
                    off.error <= TOLERANCE,
                    "{name}, seed {seed}, plan {number}: {function} is {off}\n{drawn:?}"
                );
                *worst = worst.max(off.error);
            }
        }
    }
}

fn report(what: &str, worst: &[f64]) {
    for (kind, worst) in kinds().into_iter().zip(worst) {
        println!("{what}, {}: worst error {worst:.1e} of the largest value", kind.name());
    }
}

#[test]
fn functions_of_every_robot_file_agree_with_the_numeric_solver() {
    for (name, text) in robot_files() {
        let mut worst = vec![0.0; kinds().len()];
        check(&robot_testing::read(&name, &text), 3, &name, &mut worst);
        report(&name, &worst);
    }
}

/// Compares with the solver the Jacobians of a robot's links, and those that the kind alone stands for if there are no
/// frames.
fn check_links(mut robot: Robot, name: &str) {
    let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
    let mut random = Random::new(5);
    let states: Vec<State> = (0..3).map(|_| state(&mut random, &solver, &robot)).collect();
    let links = (0..robot.links.len()).map(FrameRef::Link);
    let of_links = links
        .flat_map(|link| [FunctionKind::JacobianOf(link), FunctionKind::JacobianDotQdOf(link)]);
    let assert_agrees = |robot: &Robot, kind: FunctionKind| {
        let graph = Graph::new();
        let derivation = Derivation::new(robot, &graph, &MechanismOptions::ROUNDED, None);
        let outputs = outputs(&derivation, kind);
        let layout = Layout::of(robot, &outputs);
        let roots = values(&derivation, kind);
        for state in &states {
            let expected = expected(robot, &solver, kind, state);
            let found = evaluate(robot, &roots, state);
            let off = Off::of(&layout, &found, &expected, magnitude(&expected).max(1.0));
            assert!(off.error <= TOLERANCE, "{name}, {kind:?} is {off}");
        }
    };
    of_links.for_each(|kind| assert_agrees(&robot, kind));
    // Without named frames, the kind alone stands for the last link of each branch.
    robot.frames.clear();
    let last = FrameRef::usual(&robot);
    assert!(!last.is_empty(), "{name}");
    assert_agrees(&robot, FunctionKind::Jacobian);
    assert_agrees(&robot, FunctionKind::JacobianDotQd);
}

#[test]
fn jacobians_of_links_agree_with_the_numeric_solver() {
    for (name, text) in robot_files() {
        check_links(robot_testing::read(&name, &text), &name);
    }
    for seed in 0..12 {
        let recipe = Recipe { mimic: seed % 3 == 0, ..Recipe::tree(2 + seed as usize % 7) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check_links(robot, &format!("tree {seed}"));
    }
    // Robots for which the economical recursion cannot be set up.
    (0..3).for_each(|seed| check_links(with_free_axes(seed), "free axes"));
}

#[test]
fn every_name_of_a_function_gives_the_function_of_that_name() {
    for seed in 0..8 {
        let robot = robots::robot(&mut Random::new(seed), &Recipe::tree(5));
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let names = functions::names(&robot);
        assert!(names.len() > robot.links.len());
        for (name, kind) in names {
            assert_eq!(functions::named(&robot, &name), Ok(kind), "{name}");
            if kind.frame().is_some() {
                let functions = derivation.functions(kind);
                assert_eq!(functions.len(), 1, "{name}");
                assert_eq!(functions[0].name, name);
            }
        }
    }
}

#[test]
fn functions_of_random_chains_agree_with_the_numeric_solver() {
    let mut worst = vec![0.0; kinds().len()];
    for seed in 0..64 {
        let recipe = Recipe::serial(1 + seed as usize % 8);
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check(&robot, seed, "chain", &mut worst);
    }
    report("chains", &worst);
}

#[test]
fn functions_of_random_trees_agree_with_the_numeric_solver() {
    let mut worst = vec![0.0; kinds().len()];
    for seed in 1000..1040 {
        let joints = 2 + seed as usize % 9;
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check(&robot, seed, "tree", &mut worst);
    }
    report("trees", &worst);
}

#[test]
fn functions_of_robots_with_parameters_agree_with_the_numeric_solver() {
    let mut worst = vec![0.0; kinds().len()];
    for seed in 2000..2012 {
        let recipe = Recipe { fixed: true, ..Recipe::tree(1 + seed as usize % 6) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check(&robots::parameterized(&robot), seed, "parameters", &mut worst);
    }
    report("parameters", &worst);
}

/// A parameter can act by its sign alone: its axis is normalized.
#[test]
fn functions_of_a_robot_with_a_negative_axis_agree_with_the_numeric_solver() {
    let joint = |name: &str, axis: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = {axis} }}\n\
             origin = {{ xyz = [0.1, 0.3, 0] }}\nmass = 2\ncenter_of_mass = [0.1, 0.3, 0.2]\n\
             inertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n"
        )
    };
    let (one, two) = (joint("1", "[0, 0, \"s\"]"), joint("2", "[0, \"s\", \"2*s\"]"));
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\ns = {{ value = -1 }}\n{one}{two}[tip]\n\
         name = \"tip\"\nparent = \"2\"\n"
    );
    let robot = robot_testing::read("arm.toml", &text);
    let mut worst = vec![0.0; kinds().len()];
    (0..3).for_each(|seed| check(&robot, seed, "negative axis", &mut worst));
}

/// Compares the derivatives by composite quantities, and by forward and reverse differentiation of the torques;
/// [`FunctionKind::InverseDynamicsDerivatives`] is the one with the fewest operations.
#[test]
fn every_way_to_the_derivatives_agrees_with_the_numeric_solver() {
    for seed in 4000..4024 {
        let recipe = Recipe { mimic: true, ..Recipe::tree(1 + seed as usize % 7) };
        let mut random = Random::new(seed);
        let robot = robots::robot(&mut random, &recipe);
        let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
        let graph = Graph::new();
        let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED);
        let recursion = Recursion::new(&mechanism, &random_plan(&mut random, &robot)).unwrap();
        let torques = recursion.inverse_dynamics(false);
        let of = |prefix: &str| -> Vec<Expr<'_>> {
            (1..=torques.len()).map(|k| graph.symbol(&format!("{prefix}{k}"))).collect()
        };
        let composite = recursion.torque_derivatives();
        assert!(!composite.is_empty());
        let composite =
            composite.iter().map(|form| [form.positions.rows(), form.velocities.rows()].concat());
        let differentiated = [
            [forward(&torques, &of("q")).concat(), forward(&torques, &of("qd")).concat()].concat(),
            [reverse(&torques, &of("q")).concat(), reverse(&torques, &of("qd")).concat()].concat(),
        ];
        let ways: Vec<Vec<Expr<'_>>> = composite.chain(differentiated).collect();
        for _ in 0..STATES {
            let state = state(&mut random, &solver, &robot);
            let expected =
                expected(&robot, &solver, FunctionKind::InverseDynamicsDerivatives, &state);
            let size = magnitude(&expected).max(1e-3);
            for (way, roots) in ways.iter().enumerate() {
                let found = evaluate(&robot, roots, &state);
                let order = robot.degrees_of_freedom();
                let layout = Layout::new(&robot, "∂τ/∂q, then ∂τ/∂q̇", &[2, order, order]);
                let off = Off::of(&layout, &found, &expected, size);
                assert!(off.error <= TOLERANCE, "seed {seed}, way {way}: {off}");
            }
        }
    }
}

/// If joint axes depend on parameters, working frames cannot be chosen, and every function is derived from the links'
/// own frames.
#[test]
fn functions_of_robots_with_free_axes_agree_with_the_numeric_solver() {
    let mut worst = vec![0.0; kinds().len()];
    for seed in 3000..3008 {
        let robot = with_free_axes(seed);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        assert!(derivation.recursion.is_none());
        check(&robot, seed, "free axes", &mut worst);
    }
    report("free axes", &worst);
}

/// The maximum numbers of operations: multiplications and additions, and divisions.
#[test]
fn searched_plans_keep_the_operations_of_functions_low() {
    let budgets = [
        ("puma560", FunctionKind::MassMatrix, 138, 0),
        ("ur5", FunctionKind::MassMatrix, 102, 0),
        ("puma560", FunctionKind::ForwardDynamics(Effects::NONE), 495, 4),
        ("ur5", FunctionKind::ForwardDynamics(Effects::NONE), 390, 5),
    ];
    for (name, kind, flops, divisions) in budgets {
        let robot = robot_testing::robot(name);
        let options = MechanismOptions::ROUNDED;
        let found = search_plan(&robot, &options, &[kind]).unwrap();
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &options, Some(found.plan));
        let count = operations(&values(&derivation, kind), |_| false);
        assert_eq!(count.flops(), found.operations, "{name}, {}", kind.name());
        assert!(count.flops() <= flops, "{name}, {}: {} operations", kind.name(), count.flops());
        assert!(count.divisions <= divisions, "{name}: {} divisions", count.divisions);
    }
}
