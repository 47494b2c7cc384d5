//! With friction the energy decreases.

use robot_build::{Effects, FunctionKind, Functions, Options, Source, programs};
use robot_codegen::Interpreter;
use robot_simulation::{Dynamics as _, RobotProgram, State, Torques};

use crate::{PENDULUM, compiled, motion, rest, robot_file};

/// The pendulum with friction in its joint.
fn rubbing(friction: &str) -> String {
    format!("{PENDULUM}friction = {{ {friction} }}\n")
}

/// TRTTR1 with smoothing of all its dry friction, which depends on the load.
fn trttr1() -> String {
    let text = robot_file("trttr1");
    let smooth = text.replace("friction = { ", "friction = { smoothing = 0.05, ");
    assert_eq!(smooth.matches("smoothing").count(), 5);
    smooth
}

#[test]
fn energy_falls_at_every_sample() {
    let constant =
        "viscous = 0.1, coulomb_positive = 0.3, coulomb_negative = 0.2, smoothing = 0.01";
    let robots = [
        (rubbing("viscous = 0.2"), State { q: vec![1.0], qd: vec![-2.0] }),
        (rubbing(constant), rest(&[1.5])),
        (trttr1(), State { q: vec![0.0, 0.4, 0.1, 0.2, -0.3], qd: vec![0.5, 1.0, 0.4, -0.3, 2.0] }),
    ];
    for (text, start) in robots {
        let programs = compiled(&text, true);
        let program = RobotProgram::new(&programs, &[], true).unwrap();
        let torques = Torques::none(start.q.len());
        let motion = motion(&program, &torques, &start, 3.0, 1e-9, 0.01);
        let energies = motion.energies(&program).unwrap();
        let (first, last) = (energies.total[0], *energies.total.last().unwrap());
        let name = &program.robot().name;
        assert!(first - last > 0.5, "{name}: {first} to {last}");
        let rise = energies.total.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(rise <= 1e-9, "{name}: {rise:e} J");
    }
}

/// Load-dependent friction depends on the acceleration that it causes, and the two are consistent.
#[test]
fn friction_by_load_agrees_with_the_acceleration() {
    let text = trttr1();
    let source = Source { name: "trttr1.toml".to_owned(), text };
    let functions = Functions::Chosen(RobotProgram::functions(true));
    let programs = programs(&source, &Options { functions, ..Options::default() }).unwrap();
    let program = RobotProgram::new(&programs, &[], true).unwrap();
    let robot = program.robot();
    let driven = Torques::from_expressions(robot, &[], &["2 = 8*sin(3*t)", "5=2"]).unwrap();
    let start = rest(&[0.1, -0.7, 0.2, 0.3, 1.1]);
    let motion = motion(&program, &driven, &start, 1.0, 1e-8, 0.05);
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    for (index, state) in motion.states.iter().enumerate() {
        let (qdd, tau) = (&motion.qdd[index], &motion.tau[index]);
        let inputs = [("q", &state.q[..]), ("qd", &state.qd[..]), ("qdd", &qdd[..])];
        let name = FunctionKind::InverseDynamics(Effects::FRICTION).name();
        let found = &interpreter.call(name, &inputs).unwrap()[0].values;
        for (link, (found, given)) in robot.links.iter().zip(found.iter().zip(tau)) {
            let joint = &link.name;
            assert!(
                (found - given).abs() < 1e-8,
                "trttr1, joint `{joint}`, state {index} (q = {:?}, q̇ = {:?}): tau is {found}, not {given}",
                state.q,
                state.qd
            );
        }
    }
}

/// The programs of a robot with `forward_dynamics_friction`.
fn forward(text: &str) -> robot_build::Programs {
    let source = Source { name: "robot.toml".to_owned(), text: text.to_owned() };
    let functions = Functions::Chosen(vec![
        FunctionKind::ForwardDynamics(Effects::NONE),
        FunctionKind::ForwardDynamics(Effects::FRICTION),
        FunctionKind::InverseDynamics(Effects::FRICTION),
    ]);
    programs(&source, &Options { functions, ..Options::default() }).unwrap()
}

/// The largest difference between the joint torques and those that the accelerations from `forward_dynamics_friction`
/// require, relative to the largest joint torque.
fn forward_error(programs: &robot_build::Programs, given: &[(&str, f64)]) -> f64 {
    let interpreter = Interpreter::new(&programs.module, given).unwrap();
    let mut worst = 0.0_f64;
    for k in 0..40 {
        let entries = |shift: f64| -> Vec<f64> {
            let n = programs.robot.degrees_of_freedom();
            (0..n).map(|i| (1.3 * f64::from(k) + 2.7 * i as f64 + shift).sin()).collect()
        };
        let (q, qd) = (entries(0.0), entries(0.4));
        let tau: Vec<f64> = entries(1.9).iter().map(|tau| 100.0 * tau).collect();
        let call = |kind: FunctionKind, last: (&str, &[f64])| {
            let inputs = [("q", &q[..]), ("qd", &qd[..]), last];
            interpreter.call(kind.name(), &inputs).unwrap()[0].values.clone()
        };
        let qdd = call(FunctionKind::ForwardDynamics(Effects::FRICTION), ("tau", &tau));
        let found = call(FunctionKind::InverseDynamics(Effects::FRICTION), ("qdd", &qdd));
        let size = tau.iter().fold(0.0_f64, |size, tau| size.max(tau.abs()));
        for (found, tau) in found.iter().zip(&tau) {
            worst = worst.max((found - tau).abs() / size);
        }
    }
    worst
}

/// Without load-dependent friction, the error is a rounding error. With it, each iteration multiplies the error by
/// about the friction coefficient.
#[test]
fn forward_dynamics_with_friction_inverts_inverse_dynamics() {
    let constant = "coulomb_positive = 1, coulomb_negative = 2, viscous = 3, offset = 0.3";
    let smooth = format!("{constant}, smoothing = 0.1");
    for text in [rubbing(constant), rubbing(&smooth)] {
        let error = forward_error(&forward(&text), &[]);
        assert!(error < 1e-14, "{error:e}");
    }
    for text in [robot_file("trttr1"), trttr1()] {
        let programs = forward(&text);
        let nominal = forward_error(&programs, &[]);
        assert!(nominal < 1e-13, "{nominal:e}");
        for size in [0.0, 0.05, 0.1, 0.2_f64] {
            let given = [("c1", size), ("c2", size), ("c3", size), ("c4", size), ("c5", size)];
            let error = forward_error(&programs, &given);
            println!("{size}: {error:e}");
            assert!(error < 1e-14 + 2.0 * size.powi(9), "{size}: {error:e}");
        }
    }
}

/// `forward_dynamics_friction` gives the accelerations that simulations use.
#[test]
fn forward_dynamics_with_friction_is_that_of_simulations() {
    let text = robot_file("trttr1");
    let functions =
        [&RobotProgram::functions(true)[..], &[FunctionKind::ForwardDynamics(Effects::FRICTION)]];
    let functions = Functions::Chosen(functions.concat());
    let source = Source { name: "trttr1.toml".to_owned(), text };
    let programs = programs(&source, &Options { functions, ..Options::default() }).unwrap();
    let program = RobotProgram::new(&programs, &[], true).unwrap();
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let state = State { q: vec![0.1, -0.7, 0.2, 0.3, 1.1], qd: vec![0.5, -1.0, 0.0, -0.3, 2.0] };
    let tau = [40.0, -3.0, 300.0, 8.0, 0.5];
    let inputs = [("q", &state.q[..]), ("qd", &state.qd[..]), ("tau", &tau[..])];
    let name = FunctionKind::ForwardDynamics(Effects::FRICTION).name();
    let found = &interpreter.call(name, &inputs).unwrap()[0].values;
    let expected = program.accelerations(&state, &tau).unwrap();
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found}: {expected}");
    }
}
