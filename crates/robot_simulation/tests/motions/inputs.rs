//! Joint torques, and messages about wrong inputs.

use robot_simulation::{
    Cause, Error, RobotProgram, SimulationOptions, State, Table, TorqueLaw, Torques, from_fn,
    simulate,
};

use crate::{compiled, motion, rest, robot_file};

fn state() -> State {
    State { q: vec![0.5, -1.0], qd: vec![2.0, 3.0] }
}

#[test]
fn expressions_know_time_state_and_parameters() {
    let programs = compiled(&robot_file("planar_2r"), false);
    let robot = &programs.robot;
    let texts = ["2 = -5*qd1 + sin(t)*q2", "1 = m1*g*t"];
    let torques = Torques::from_expressions(robot, &[("m1", 2.0)], &texts).unwrap();
    let found = torques.torques(0.5, &state());
    assert_eq!(found, [2.0 * 9.81 * 0.5, -10.0 - 0.5_f64.sin()]);
    assert!(!torques.are_zero());
    let zero = Torques::from_expressions(robot, &[], &["1 = 0"]).unwrap();
    assert!(zero.are_zero() && Torques::none(2).are_zero());
    assert_eq!(zero.torques(1.0, &state()), [0.0, 0.0]);

    let texts = ["1 = sin(", "3 = 1", "1 = 2", "1 = 3", "2 = tau1", "7", "elbow = 1"];
    let shown = Torques::from_expressions(robot, &[], &texts).unwrap_err().to_string();
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(lines.len(), 6, "{shown}");
    assert!(lines[0].starts_with("torque `1 = sin(`: "), "{shown}");
    assert_eq!(
        lines[1..],
        [
            "torque `3` does not match a joint; the joints are 1 to 2, by name 1, 2",
            "torque `1` is given twice; leave one out",
            "torque `2 = tau1`: `tau1` is not known here; the known names are t, q1 …, qd1 … and the robot's \
             parameters",
            "torque `7` is not an assignment; write NAME = EXPRESSION",
            "torque `elbow` does not match a joint; the joints are 1 to 2, by name 1, 2",
        ]
    );
}

/// Such a table is what the computation of torques writes.
#[test]
fn contributions_in_a_table_are_ignored() {
    let programs = compiled(&robot_file("planar_2r"), false);
    let read = |columns: &str| {
        let text = format!("t,tau1,tau2,{columns}\n0,1,2,3,4\n1,1,2,3,4\n");
        let table = Table::read("a.csv", &text).unwrap();
        Torques::from_table(&programs.robot, "a.csv", &table, 1.0)
    };
    assert!(read("inertia1,wrench2").is_ok());
    let error = read("gravity,inertia").unwrap_err().to_string();
    assert!(error.contains("the column `gravity` does not match a coordinate"), "{error}");
}

#[test]
fn tables_are_linear_between_samples() {
    let programs = compiled(&robot_file("planar_2r"), false);
    let robot = &programs.robot;
    let table = Table::read("a.csv", "tau2,t,q1,tau1\n1,0,9,0\n3,1,9,0\n-1,3,9,0\n").unwrap();
    let torques = Torques::from_table(robot, "a.csv", &table, 3.0).unwrap();
    for (t, expected) in [(0.0, 1.0), (0.25, 1.5), (1.0, 3.0), (2.0, 1.0), (3.0, -1.0)] {
        assert_eq!(torques.torques(t, &state()), [0.0, expected], "{t}");
    }
    assert_eq!(torques.corners(), [0.0, 1.0, 3.0]);

    let table = Table::read("a.csv", "t,tau3,q1\n0,1,0\n2,1,0\n1,2,0\n").unwrap();
    let shown = Torques::from_table(robot, "a.csv", &table, 3.0).unwrap_err().to_string();
    let expected = [
        "a.csv: the time does not increase at row 3 below the header; in place of a jump, write a steep change",
        "a.csv: the torques cover 0 s to 2 s, but the motion covers 0 s to 3 s",
        "a.csv: there is no column tau1, tau2; add a column of zeros for a joint that is not driven",
        "a.csv: the column `tau3` does not match a coordinate",
    ];
    assert_eq!(shown.lines().collect::<Vec<_>>(), expected);
}

/// A step ends at a jump of the force: 1 kg is driven by a pulse of up to 1 N from 0.5 s to 0.501 s.
#[test]
fn no_step_goes_over_a_corner() {
    let mass = from_fn(1, |_, tau| tau.to_vec());
    let programs = compiled(crate::PENDULUM, false);
    let csv = "t,tau1\n0,0\n0.5,0\n0.5005,1\n0.501,0\n10,0\n";
    let table = Table::read("pulse", csv).unwrap();
    let pulse = Torques::from_table(&programs.robot, "pulse", &table, 10.0).unwrap();
    let options = SimulationOptions { step: 5.0, ..SimulationOptions::default() };
    let motion = simulate(&mass, &pulse, &rest(&[0.0]), &options, &mut |_| {}).unwrap();
    let velocity = motion.states.last().unwrap().qd[0];
    assert!((velocity - 0.0005).abs() < 1e-12, "{velocity}");
}

/// Pulses of expressions that are far shorter than the output step: 1 kg gets their whole momentum, in a few steps.
#[test]
fn no_step_goes_over_a_pulse_of_an_expression() {
    let mass = from_fn(1, |_, tau| tau.to_vec());
    let programs = compiled(crate::PENDULUM, false);
    let options = SimulationOptions { duration: 5.0, step: 5.0, ..SimulationOptions::default() };
    for (text, expected) in [
        ("1 = 500*(sign(t - 2.3) - sign(t - 2.301))", 1.0),
        ("1 = 500*(sign(t - 2) - sign(t - 2 - 1e-6))*(1 + 0*q1)", 1e-3),
        ("1 = abs(t - 1) + abs(t - 1.01) - 2*abs(t - 1.005)", 5e-5),
        ("1 = (1 + sign(0.001 - abs(t - 4)))/2", 0.002),
        ("1 = 1/(1 + ((t - 2.5)/0.001)^2)", 0.001 * 2.0 * 2500.0_f64.atan()),
        ("1 = 1/(1 + ((t - 2.5)/0.05)^2)", 0.05 * 2.0 * 50.0_f64.atan()),
        ("1 = tanh((t - 4)/0.0001) - tanh((t - 4.001)/0.0001)", 0.002),
    ] {
        let pulse = Torques::from_expressions(&programs.robot, &[], &[text]).unwrap();
        let motion = simulate(&mass, &pulse, &rest(&[0.0]), &options, &mut |_| {}).unwrap();
        let velocity = motion.states.last().unwrap().qd[0];
        assert!((velocity - expected).abs() < 1e-8, "{text}: {velocity}, not {expected}");
        assert!(motion.steps < 500, "{text}: {} steps", motion.steps);
    }
    let slow = Torques::from_expressions(&programs.robot, &[], &["1 = sin(t)"]).unwrap();
    let motion = simulate(&mass, &slow, &rest(&[0.0]), &options, &mut |_| {}).unwrap();
    assert!(motion.steps < 30, "{}", motion.steps);
}

#[test]
fn options_and_states_are_checked_at_once() {
    let free = from_fn(2, |_, tau| tau.to_vec());
    let run = |start: &State, options: SimulationOptions| {
        simulate(&free, &Torques::none(2), start, &options, &mut |_| {}).unwrap_err().to_string()
    };
    let start = State { q: vec![0.0], qd: vec![f64::NAN, 0.0] };
    let options = SimulationOptions { tolerance: 0.0, ..SimulationOptions::default() };
    let expected = [
        "the tolerance is 0; it must be between 1e-14 and 0.1",
        "the initial state has 1 entry of q, not 2",
        "the initial state has entries of qd that are not finite",
    ];
    assert_eq!(run(&start, options).lines().collect::<Vec<_>>(), expected);
    let options = SimulationOptions { duration: 0.0, ..SimulationOptions::default() };
    assert_eq!(
        run(&rest(&[0.0; 2]), options),
        "the duration is 0 s; it must be positive and finite"
    );
}

#[test]
fn motions_that_cannot_go_on_say_why() {
    let stop = |law: fn(f64) -> f64, q: f64| {
        // A singular mass matrix at q = 1.
        let dynamics = from_fn(1, |state, tau| vec![tau[0] / (1.0 - state.q[0]).max(0.0).sqrt()]);
        let torques = move |t: f64, _: &State| vec![law(t)];
        let options = SimulationOptions { max_steps: 5000, ..SimulationOptions::default() };
        let error = simulate(&dynamics, &torques, &rest(&[q]), &options, &mut |_| {}).unwrap_err();
        let Error::Stopped { t, cause } = error else { panic!("{error}") };
        (t, cause)
    };
    assert_eq!(stop(|_| 1.0, 1.0), (0.0, Cause::Accelerations));
    assert_eq!(stop(|_| f64::NAN, 0.0), (0.0, Cause::Torques));
    let (t, cause) = stop(|t| 1.0 / (1.0_f64 - t).max(0.0).sqrt(), 0.0);
    assert!(t > 0.5 && t <= 1.0, "{t}");
    assert!(matches!(cause, Cause::Torques | Cause::Accelerations), "{cause}");
    let few = SimulationOptions { max_steps: 10, ..SimulationOptions::default() };
    let free = from_fn(1, |_, tau| tau.to_vec());
    let error = simulate(&free, &Torques::none(1), &rest(&[0.0]), &few, &mut |_| {}).unwrap_err();
    let Error::Stopped { cause, .. } = error else { panic!("{error}") };
    assert_eq!(cause, Cause::Steps(10));
    for (start, force, name) in [(1e300, 0.0, "qd1 = 1e300"), (0.0, 1e300, "qdd1 = 1e300")] {
        let start = State { q: vec![0.0], qd: vec![start] };
        let torques = move |_: f64, _: &State| vec![force];
        let error = simulate(&free, &torques, &start, &few, &mut |_| {}).unwrap_err().to_string();
        let expected = format!("the motion ends at t = 0 s: {name} is too large for a step");
        assert!(error.starts_with(&expected), "{error}");
    }
}

#[test]
fn programs_must_have_the_functions() {
    let programs = compiled(&robot_file("trttr1"), false);
    let error = RobotProgram::new(&programs, &[], true).unwrap_err().to_string();
    assert!(error.contains("inverse_dynamics_friction"), "{error}");
    assert!(RobotProgram::new(&programs, &[("M9", 1.0)], false).is_err());
    let program = RobotProgram::new(&programs, &[("M5", 1.0)], false).unwrap();
    motion(&program, &Torques::none(5), &rest(&[0.0; 5]), 0.1, 1e-6, 0.1);
}
