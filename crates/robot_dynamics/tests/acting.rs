//! Functions do not depend on parameters that have no effect on them, so that such parameters cause no rounding errors.

#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;

use robot_dynamics::functions::{Derivation, Function};
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::read_toml;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots::{parameterized, robot};
use robot_numeric::{Loads, Mechanism};
use robot_symbolic::{Expr, Graph, Rational, walk};

fn robot_file(name: &str) -> Robot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    read_toml(name, &std::fs::read_to_string(path).unwrap()).unwrap().robot
}

/// Some robots of the project that have parameters, and random robots in which every value of a body is a parameter.
fn robots() -> Vec<(String, Robot)> {
    let files = ["trttr1.toml", "planar_2r.toml", "planar_3r.toml"];
    let mut robots: Vec<_> =
        files.iter().map(|name| ((*name).to_owned(), robot_file(name))).collect();
    for seed in 0..12 {
        let joints = 1 + seed as usize % 3;
        let recipe = if seed % 2 == 0 { Recipe::serial(joints) } else { Recipe::tree(joints) };
        let recipe = Recipe { drives: seed % 3 == 0, fixed: seed % 4 == 1, ..recipe };
        let random = robot(&mut Random::new(seed), &recipe);
        robots.push((format!("random {seed}"), parameterized(&random)));
    }
    robots
}

fn nominal(robot: &Robot, name: &str) -> Option<f64> {
    Some(robot.parameter(name)?.value.as_ref()?.to_f64())
}

/// The value of a symbol: the nominal value of a parameter, or otherwise a value that depends on the symbol's name.
fn value(robot: &Robot, name: &str) -> f64 {
    let seed = name.bytes().fold(7, |seed: u64, byte| seed.wrapping_mul(31) + u64::from(byte));
    nominal(robot, name).unwrap_or_else(|| Random::new(seed).uniform(-1.5, 1.5))
}

fn roots<'g>(function: &Function<'g>) -> Vec<Expr<'g>> {
    function.outputs.iter().flat_map(|output| output.values.iter().copied()).collect()
}

fn evaluated(robot: &Robot, roots: &[Expr<'_>], changed: &str, to: f64) -> Vec<f64> {
    evaluated_at(robot, roots, 1.0, changed, to)
}

/// The values with all joint velocities times `direction`.
fn evaluated_at(
    robot: &Robot,
    roots: &[Expr<'_>],
    direction: f64,
    changed: &str,
    to: f64,
) -> Vec<f64> {
    let velocities = robot.symbols(JointVariable::Velocity);
    walk::evaluate(roots, |symbol| {
        let name = roots[0].graph().symbol_name(symbol);
        match name == changed {
            true => to,
            false if velocities.contains(&name) => direction * value(robot, &name),
            false => value(robot, &name),
        }
    })
}

#[test]
fn every_parameter_of_a_function_acts_on_it() {
    let mut compared = 0;
    let mut left_out = 0;
    for (name, robot) in robots() {
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        for kind in FunctionKind::ALL.iter().filter(|kind| kind.missing_in(&robot).is_none()) {
            for function in derivation.functions(*kind) {
                let roots = roots(&function);
                let [forward, backward] =
                    [1.0, -1.0].map(|direction| evaluated_at(&robot, &roots, direction, "", 0.0));
                let symbols = walk::symbols(&roots);
                for parameter in &robot.parameters {
                    let used = graph
                        .find_symbol(&parameter.name)
                        .and_then(Expr::as_symbol)
                        .is_some_and(|symbol| symbols.contains(&symbol));
                    if !used {
                        left_out += 1;
                        continue;
                    }
                    // Dry friction may act in one direction only.
                    let acts = |direction: f64, usual: &[f64]| {
                        let changed = evaluated_at(&robot, &roots, direction, &parameter.name, 1e3);
                        // With inertias that no body can have, there may be no accelerations.
                        usual.iter().zip(&changed).any(|(a, b)| {
                            (a - b).abs() > 1e-9 * a.abs() || (b.is_nan() && !a.is_nan())
                        })
                    };
                    assert!(
                        acts(1.0, &forward) || acts(-1.0, &backward),
                        "{name}: {} reads {}, which does not act",
                        function.name,
                        parameter.name
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 1000 && left_out > 1000, "{compared} act, {left_out} do not");
}

#[test]
fn what_does_not_act_on_torques_leaves_no_bit_of_them() {
    let robot = robot_file("trttr1.toml");
    let graph = Graph::new();
    let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
    let of = |kind| roots(&derivation.functions(kind)[0]);
    let [torques, masses, accelerations] = [
        FunctionKind::InverseDynamics(Effects::NONE),
        FunctionKind::MassMatrix,
        FunctionKind::ForwardDynamics(Effects::NONE),
    ]
    .map(of);
    for roots in [torques, masses, accelerations] {
        let usual = evaluated(&robot, &roots, "", 0.0);
        for idle in ["Jx1", "Jy1", "Jz1", "Jx2", "Jy2", "Jx3", "Jy3", "Jx4", "Jy4"] {
            for to in [1e12, f64::NAN] {
                assert_eq!(evaluated(&robot, &roots, idle, to), usual, "{idle} = {to}");
            }
        }
        assert_ne!(evaluated(&robot, &roots, "Jz2", 1e12), usual);
    }
}

/// The torques of the numeric solver, with friction, with one parameter changed.
fn solved(robot: &Robot, state: &State, changed: &str, to: f64) -> Vec<f64> {
    let mechanism = Mechanism::from_robot(robot, &|name| {
        if name == changed { to } else { nominal(robot, name).unwrap_or(f64::NAN) }
    });
    let loads = Loads { friction: true, ..Loads::default() };
    let (mechanism, State { q, qd, qdd, .. }) = (mechanism.unwrap(), state);
    let torques = mechanism.inverse_dynamics_with(q, qd, qdd, &loads).unwrap();
    torques.iter().copied().collect()
}

/// Checks that no parameter with an effect is left out, also of those that act in one direction of motion only.
#[test]
fn torques_without_idle_parameters_are_those_of_the_solver() {
    for (name, robot) in robots() {
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let friction = Effects { friction: robot.has_friction(), ..Effects::NONE };
        let roots = roots(&derivation.functions(FunctionKind::InverseDynamics(friction))[0]);
        let state = Random::new(5).state(&Mechanism::nominal(&robot).unwrap());
        let backward = State { qd: state.qd.iter().map(|rate| -rate).collect(), ..state.clone() };
        let states = [&state, &backward];
        for (parameter, state) in robot.parameters.iter().flat_map(|one| states.map(|it| (one, it)))
        {
            let to = parameter.value.as_ref().map_or(0.0, Rational::to_f64) * 1.25 + 0.5;
            let expected = solved(&robot, state, &parameter.name, to);
            let found = walk::evaluate(&roots, |symbol| {
                let symbol = graph.symbol_name(symbol);
                let of = |prefix: &str, values: &[f64]| {
                    let number: usize = symbol.strip_prefix(prefix)?.parse().ok()?;
                    values.get(number - 1).copied()
                };
                let motion = of("qdd", &state.qdd).or_else(|| of("qd", &state.qd));
                let motion = motion.or_else(|| of("q", &state.q));
                if symbol == parameter.name {
                    to
                } else {
                    motion.unwrap_or_else(|| value(&robot, &symbol))
                }
            });
            let size = expected.iter().fold(1e-3_f64, |size, one| size.max(one.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found - expected).abs() <= 1e-11 * size,
                    "{name}, {} = {to}: {found} and {expected}",
                    parameter.name
                );
            }
        }
    }
}
