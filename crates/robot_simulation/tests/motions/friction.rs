//! With friction the energy falls.

use robot_build::{FunctionKind, Functions, Options, Source, programs};
use robot_codegen::Interpreter;
use robot_simulation::{RobotProgram, State, Torques};

use crate::{PENDULUM, compiled, motion, rest, robot_file};

/// The pendulum with friction in its joint.
fn rubbing(friction: &str) -> String {
    format!("{PENDULUM}friction = {{ {friction} }}\n")
}

/// TRTTR1 with a smooth sign in every dry friction: there it grows with the load.
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

/// Friction by load depends on the acceleration that it brings about: the two agree.
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
        let name = FunctionKind::InverseDynamicsFriction.name();
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
