//! Compares the regressor with that of the numeric solver, and its product with the parameters with the joint torques.

use robot_build::{BaseFrames, Functions, Options, programs_of};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::functions::FunctionKind;
use robot_model::robot::LINK_PARAMETERS;
use robot_model::robot::Robot;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::{Expr, Formula, Graph, Rational, operations};

use robot_testing::place::{Layout, Off};
use robot_testing::{evaluate, magnitude, robot_files, with_free_axes};

const STATES: usize = 8;
const TOLERANCE: f64 = 1e-11;
const OPTIONS: MechanismOptions = MechanismOptions::ROUNDED;

fn regressor<'g>(derivation: &Derivation<'_, 'g>) -> Vec<Expr<'g>> {
    let [function] = &derivation.functions(FunctionKind::Regressor)[..] else {
        panic!("one function");
    };
    let [output] = &function.outputs[..] else { panic!("one output") };
    assert_eq!(output.values.len(), output.shape.iter().product::<usize>());
    output.values.clone()
}

/// The parameters π in the order of the regressor's columns. Links that carry gyroscopic rotors include the locked
/// rotors.
fn parameters(robot: &Robot, state: &State) -> Vec<f64> {
    let mut locked = robot.clone();
    for link in &mut locked.links {
        link.drive.gyroscopic = false;
    }
    let links = robot_numeric::Mechanism::nominal(&locked).unwrap().parameters();
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &OPTIONS);
    let drives = mechanism.links.iter().flat_map(|link| {
        let friction = &link.friction;
        [
            link.reflected_inertia,
            friction.viscous,
            friction.coulomb_positive,
            friction.coulomb_negative,
            friction.offset,
            link.rotor_coupling,
        ]
    });
    let drives: Vec<Expr<'_>> = drives.filter(|column| !column.is_zero()).collect();
    let drives = if drives.is_empty() { vec![] } else { evaluate(robot, &drives, state) };
    [links.as_slice(), &drives].concat()
}

/// Compares the columns of the links with the solver's, and Y π with its joint torques.
fn check(robot: &Robot, seed: u64, name: &str) {
    let mut robot = robot.clone();
    for link in &mut robot.links {
        // Friction that depends on the contact force is not linear in the parameters.
        link.friction.coulomb = Formula::number(&Rational::ZERO);
    }
    let mut random = Random::new(seed);
    let solver = robot_numeric::Mechanism::nominal(&robot).unwrap();
    let graph = Graph::new();
    let roots = regressor(&Derivation::new(&robot, &graph, &OPTIONS, None));
    for _ in 0..STATES {
        let state = random.state(&solver);
        let (q, qd, qdd) = (&state.q, &state.qd, &state.qdd);
        let found = evaluate(&robot, &roots, &state);
        let parameters = parameters(&robot, &state);
        let rows = found.chunks(parameters.len());

        let inertial = LINK_PARAMETERS * robot.links.len();
        let of_links: Vec<f64> = rows.clone().flat_map(|row| row[..inertial].to_vec()).collect();
        // In the solver, gyroscopic rotors are additional links after those of the robot.
        let expected = solver.regressor(q, qd, qdd).unwrap().columns(0, inertial).transpose();
        let size = magnitude(&of_links).max(1e-3);
        let shape = [robot.degrees_of_freedom(), inertial];
        let layout = Layout::new(&robot, "columns of links", &shape);
        let off = Off::of(&layout, &of_links, expected.as_slice(), size);
        assert!(off.error <= TOLERANCE, "{name}, seed {seed}: {off}");

        let product = |row: &[f64]| row.iter().zip(&parameters).map(|(y, p)| y * p).sum::<f64>();
        let torques: Vec<f64> = rows.map(product).collect();
        let loads = robot_numeric::Loads { wrenches: vec![], friction: true };
        let expected = solver.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
        let size = magnitude(&expected).max(1e-3);
        let layout = Layout::per_joint(&robot, "Y π");
        let off = Off::of(&layout, &torques, expected.as_slice(), size);
        assert!(off.error <= TOLERANCE, "{name}, seed {seed}: {off}");
    }
}

#[test]
fn regressors_of_every_robot_file() {
    for (name, text) in robot_files() {
        check(&robot_testing::read(&name, &text), 3, &name);
    }
}

#[test]
fn regressors_of_random_chains() {
    for seed in 0..32 {
        let recipe = Recipe::serial(1 + seed as usize % 8);
        check(&robots::robot(&mut Random::new(seed), &recipe), seed, "chain");
    }
}

#[test]
fn regressors_of_random_trees_with_drives() {
    let mut gyroscopic = 0;
    for seed in 1000..1040 {
        let joints = 2 + seed as usize % 9;
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        gyroscopic += robot.links.iter().filter(|link| link.drive.gyroscopic).count();
        check(&robot, seed, "tree");
    }
    assert!(gyroscopic > 0);
}

#[test]
fn regressors_of_robots_with_parameters() {
    for seed in 2000..2012 {
        let recipe = Recipe { fixed: true, ..Recipe::tree(1 + seed as usize % 6) };
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        check(&robots::parameterized(&robot), seed, "parameters");
    }
}

/// If joint axes depend on parameters, working frames cannot be chosen.
#[test]
fn regressors_of_robots_with_free_axes() {
    for seed in 3000..3008 {
        let robot = with_free_axes(seed);
        check(&robot, seed, "free axes");
    }
}

/// Zero entries are the constant 0, and the others need few operations even without a search: the bounds are the
/// maximum number of multiplications and additions, and of entries.
#[test]
fn regressors_cost_little_without_a_search() {
    let budgets =
        [("puma560", 935, 184), ("ur5", 1045, 189), ("iiwa", 1391, 253), ("panda", 1410, 254)];
    for (name, flops, entries) in budgets {
        let robot = robot_testing::robot(name);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &OPTIONS, None);
        let regressor = regressor(&derivation);
        let count = operations(&regressor, |_| false).flops();
        assert!(count <= flops, "{name}: {count} operations");
        let count = regressor.iter().filter(|entry| !entry.is_zero()).count();
        assert!(count <= entries, "{name}: {count} entries");
    }
}

/// The maximum number of multiplications and additions of a call of `regressor_base`, over moments in
/// Denavit–Hartenberg frames and in the file's frames.
#[test]
fn base_regressors_cost_no_more_than_they_did() {
    let bounds =
        [("puma560", 614, 646), ("ur5", 493, 540), ("iiwa", 942, 1127), ("panda", 1040, 1150)];
    for (name, denavit_hartenberg, file) in bounds {
        let robot = robot_testing::robot(name);
        let most = [(BaseFrames::DenavitHartenberg, denavit_hartenberg), (BaseFrames::File, file)];
        for (frames, most) in most {
            let options = Options {
                functions: Functions::Chosen(vec![FunctionKind::RegressorBase]),
                base_frames: Some(frames),
                ..Options::default()
            };
            let module = programs_of(robot.clone(), name, &options).unwrap().module;
            let counts = module.counts(&module.functions[0]).call;
            let count = counts.mul + counts.add;
            assert_eq!(counts.operations(), count, "{name}: divisions");
            println!("{name}, {}: {count}", frames.name());
            assert!(count <= most, "{name}, {}: {count} operations", frames.name());
        }
    }
}
