//! Dry friction with a sharp sign: rest, break-away, stops.

use std::fmt::Write as _;

use robot_build::Programs;
use robot_simulation::{
    Cause, Error, Motion, RobotProgram, SimulationOptions, State, Torques, simulate,
};

use crate::{compiled, rest, robot_file};

/// A slide of 1 kg along x, under gravity in x and y.
fn slide(gravity: [f64; 2], friction: &str) -> String {
    let [x, y] = gravity;
    format!(
        r#"
format = 1
[robot]
name = "slide"
gravity = [{x:?}, {y:?}, 0]
[[link]]
name = "1"
joint = {{ type = "prismatic", axis = "x" }}
mass = 1
center_of_mass = [0, 0, 0]
inertia = {{ zz = 1, unchecked = true }}
friction = {{ {friction} }}
"#
    )
}

/// The motion with friction under torques from expressions.
fn run(
    programs: &Programs,
    given: &[(&str, f64)],
    torques: &[&str],
    start: &State,
    options: &SimulationOptions,
) -> Result<Motion, Error> {
    let program = RobotProgram::new(programs, given, true)?;
    let torques = Torques::from_expressions(program.robot(), given, torques)?;
    simulate(&program, &torques, start, options, &mut |_| {})
}

/// The motion of one robot.
fn moved(text: &str, torques: &[&str], start: &State, duration: f64, step: f64) -> Motion {
    let options = SimulationOptions { duration, step, ..SimulationOptions::default() };
    run(&compiled(text, true), &[], torques, start, &options).unwrap()
}

fn at(q: f64, qd: f64) -> State {
    State { q: vec![q], qd: vec![qd] }
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn half_the_force_to_break_away_moves_nothing() {
    let motion =
        moved(&slide([0.0; 2], "coulomb_force = 10"), &["1 = 5"], &at(0.25, 0.0), 10.0, 0.5);
    assert_eq!(motion.t.len(), 21);
    for (state, qdd) in motion.states.iter().zip(&motion.qdd) {
        assert_eq!((state.q[0], state.qd[0], qdd[0]), (0.25, 0.0, 0.0));
    }
    assert!(motion.steps < 100, "{}", motion.steps);
}

#[test]
fn more_than_the_friction_accelerates_by_the_rest() {
    let motion =
        moved(&slide([0.0; 2], "coulomb_force = 10"), &["1 = -15"], &at(0.0, 0.0), 2.0, 0.5);
    for (t, (state, qdd)) in motion.t.iter().zip(motion.states.iter().zip(&motion.qdd)) {
        assert_near(qdd[0], -5.0, 1e-14);
        assert_near(state.qd[0], -5.0 * t, 1e-12);
        assert_near(state.q[0], -2.5 * t * t, 1e-12);
    }
}

/// v = 3 m/s against μ m g + b v: t = m/b ln(1 + b v/F), x = m/b (v − F t/m).
#[test]
fn a_block_stops_when_and_where_it_should_and_stays() {
    let weight = [0.0, -9.81];
    for (friction, viscous) in [("coulomb = 0.4", 0.0), ("coulomb = 0.4, viscous = 2", 2.0)] {
        let motion = moved(&slide(weight, friction), &[], &at(0.0, 3.0), 2.0, 0.7);
        let force: f64 = 0.4 * 9.81;
        let (stop, way) = match viscous > 0.0 {
            true => {
                let t = (1.0 + viscous * 3.0 / force).ln() / viscous;
                (t, (3.0 - force * t) / viscous)
            }
            false => (3.0 / force, 4.5 / force),
        };
        for (t, (state, qdd)) in motion.t.iter().zip(motion.states.iter().zip(&motion.qdd)) {
            if *t > stop {
                assert_near(state.q[0], way, 1e-9);
                assert_eq!((state.qd[0], qdd[0]), (0.0, 0.0));
            } else {
                assert!(state.qd[0] > 0.0 && qdd[0] < 0.0);
            }
        }
    }
}

/// A block that slides to the right under a force that grows to the left stops, sticks while the force is
/// below the friction, and turns.
#[test]
fn a_force_that_grows_breaks_away_at_its_time() {
    // q̈ = −t − 2 until v = 1 is used up at t² / 2 + 2 t = 1; away at t = 2, then q̇ = −(t − 2)² / 2.
    let motion = moved(&slide([0.0; 2], "coulomb_force = 2"), &["1 = -t"], &at(0.0, 1.0), 4.0, 0.1);
    let stop = 6.0_f64.sqrt() - 2.0;
    let way = stop - stop.powi(2) - stop.powi(3) / 6.0;
    for (t, state) in motion.t.iter().zip(&motion.states) {
        if *t < stop {
            assert_near(state.qd[0], 1.0 - 2.0 * t - t * t / 2.0, 1e-9);
        } else if *t < 2.0 - 1e-9 {
            assert_near(state.q[0], way, 1e-9);
            assert_eq!(state.qd[0], 0.0);
        } else {
            assert_near(state.q[0], way - (t - 2.0).powi(3) / 6.0, 1e-9);
            assert_near(state.qd[0], -(t - 2.0).powi(2) / 2.0, 1e-9);
        }
    }
    assert!(motion.steps < 300, "{}", motion.steps);
}

/// What a short push asks of the friction is not stepped over.
#[test]
fn a_short_push_between_samples_is_felt() {
    let push = ["1 = 5 + 9*(2/(2 + (10*(t - 3.3))^2))^2"];
    let motion = moved(&slide([0.0; 2], "coulomb_force = 10"), &push, &at(0.0, 0.0), 5.0, 5.0);
    assert!(motion.states[1].q[0] > 0.01, "{:?}", motion.states[1]);
    assert_eq!(motion.states[1].qd[0], 0.0);
}

/// By the load: a block slides down an incline of the angle α where tan α > μ.
#[test]
fn a_block_slides_down_an_incline_that_is_steeper_than_its_friction() {
    let friction: f64 = 0.3;
    for angle in [0.05, 0.29, 0.2914567, 0.2914569, 0.3, 1.2_f64] {
        let gravity = [9.81 * angle.sin(), -9.81 * angle.cos()];
        let text = slide(gravity, "coulomb = 0.3");
        let excess = 9.81 * (angle.sin() - friction * angle.cos());
        let down = moved(&text, &[], &at(0.0, 0.0), 1.0, 0.25);
        for (t, state) in down.t.iter().zip(&down.states) {
            assert_near(state.q[0], excess.max(0.0) * t * t / 2.0, 1e-9);
            assert_eq!(state.qd[0] == 0.0, angle.tan() < friction || *t == 0.0);
        }
        // Pushed upwards it stops, and comes back where it is steep.
        let up = moved(&text, &[], &at(0.0, -2.0), 3.0, 3.0);
        let against = 9.81 * (angle.sin() + friction * angle.cos());
        let (stop, top) = (2.0 / against, -2.0 / against);
        let expected = top + excess.max(0.0) * (3.0 - stop).powi(2) / 2.0;
        assert_near(up.states[1].q[0], expected, 1e-8);
    }
}

/// A mass on a spring whose other end moves at v: it sticks while the spring stretches, then swings
/// through and sticks again, with the period of the closed form.
#[test]
fn a_block_on_a_belt_sticks_and_slips() {
    let text = slide([0.0; 2], "coulomb_positive = 2, coulomb_negative = 2, offset = 0");
    let (k, v, limit): (f64, f64, f64) = (25.0, 0.1, 2.0);
    // Slip from rest with the spring at the limit: its deviation from v t is a swing about −v t + …;
    // with z = v t − q − F/k: z̈ = −k z, z = 0, ż = v at first: ż = v cos ω t, q̇ = v (1 − cos ω t):
    // at rest again after a period, as far on as the target.
    let away = limit / k / v;
    let period = 2.0 * std::f64::consts::PI / k.sqrt();
    let motion = moved(&text, &["1 = 25*(0.1*t - q1)"], &at(0.0, 0.0), 6.0, 0.01);
    for (t, state) in motion.t.iter().zip(&motion.states) {
        let slipping = (t - away).max(0.0);
        let omega = k.sqrt();
        let swing = v * slipping - v / omega * (omega * slipping).sin();
        assert_near(state.q[0], swing, 1e-8);
        if *t < away {
            assert_eq!(state.qd[0], 0.0);
        }
    }
    assert!(away + period < 6.0);
}

/// With a higher friction at rest by the load: a spring presses the block as it stretches. The
/// dissipation is the work of the torques less the gain of energy, at every sample.
#[test]
fn friction_only_takes_energy_from_trttr1() {
    let programs = compiled(&robot_file("trttr1"), true);
    let laws: [&[&str]; 3] = [
        &["1 = 10*sin(3*t)"],
        &[
            "1 = 60*sin(2*t)",
            "2 = 12*cos(3*t)",
            "3 = 301.2*cos(t)^2 + 60*sin(5*t)",
            "4 = 9*sin(t)",
            "5 = 0.7*sin(4*t)",
        ],
        &[],
    ];
    let starts = [
        rest(&[0.0; 5]),
        rest(&[0.1, -0.7, 0.2, 0.3, 1.1]),
        State { q: vec![0.0, 0.4, 0.1, 0.2, -0.3], qd: vec![0.5, 1.0, 0.4, -0.3, 2.0] },
    ];
    for (law, start) in laws.iter().zip(&starts) {
        let program = RobotProgram::new(&programs, &[], true).unwrap();
        let options =
            SimulationOptions { duration: 10.0, step: 0.002, ..SimulationOptions::default() };
        let motion = run(&programs, &[], law, start, &options).unwrap();
        assert!(motion.steps < 12_000, "{}", motion.steps);
        let energies = motion.energies(&program).unwrap();
        let power = |index: usize| -> f64 {
            motion.tau[index].iter().zip(&motion.states[index].qd).map(|(tau, qd)| tau * qd).sum()
        };
        let mut shown = String::new();
        let mut taken = 0.0;
        for index in 1..motion.t.len() {
            // The trapezoid's error of a smooth power.
            let work = (power(index - 1) + power(index)) * 0.001;
            let gain = energies.total[index] - energies.total[index - 1];
            taken += work - gain;
            if gain > work + 1e-5 * (1.0 + work.abs()) {
                writeln!(shown, "{}: {gain} > {work}", motion.t[index]).unwrap();
            }
        }
        assert_eq!(shown, "");
        assert!(taken > 0.0 || law.len() == 1, "{taken}");
    }
}

/// Of two coupled links one sticks while the other slips; the friction that holds it agrees with the
/// equations, and the sticking ends when it must.
#[test]
fn what_holds_a_joint_agrees_with_the_equations() {
    let programs = compiled(&robot_file("trttr1"), true);
    let program = RobotProgram::new(&programs, &[], true).unwrap();
    let options = SimulationOptions { duration: 3.0, ..SimulationOptions::default() };
    let law = ["1 = 14*sin(3*t)", "2 = 3*cos(2*t)", "3 = 301.2", "5 = 0.2"];
    let motion = run(&programs, &[], &law, &rest(&[0.0; 5]), &options).unwrap();
    let friction = robot_simulation::Dynamics::dry_friction(&program).unwrap();
    let (mut held, mut slid) = ([0; 5], [0; 5]);
    for (index, state) in motion.states.iter().enumerate() {
        let (qdd, tau) = (&motion.qdd[index], &motion.tau[index]);
        let directed = |sign: f64| {
            let qd = state.qd.iter().map(|qd| if *qd == 0.0 { sign * 1e-200 } else { *qd });
            let state = State { q: state.q.clone(), qd: qd.collect() };
            friction.driving_forces(&state, qdd, true).unwrap()
        };
        let (least, most) = (directed(-1.0), directed(1.0));
        for joint in 0..5 {
            let slack = 1e-7 * (1.0 + tau[joint].abs());
            assert!(least[joint] - slack <= tau[joint] && tau[joint] <= most[joint] + slack);
            if state.qd[joint] == 0.0 && qdd[joint] == 0.0 {
                held[joint] += 1;
            } else {
                slid[joint] += 1;
            }
        }
    }
    assert!(held.iter().filter(|count| **count > 10).count() >= 3, "{held:?}");
    assert!(slid.iter().filter(|count| **count > 10).count() >= 3, "{slid:?}");
}

#[test]
fn friction_of_any_size_ends_soon() {
    let programs = compiled(&robot_file("trttr1"), true);
    let start = State { q: vec![0.0, 0.4, 0.1, 0.2, -0.3], qd: vec![0.5, 1.0, 0.4, -0.3, 2.0] };
    let options = SimulationOptions { duration: 1.0, ..SimulationOptions::default() };
    for size in [0.0, 1e-300, 1e-12, 1e-3, 0.1, 0.5, 1.0, 10.0, 1e6, 1e300, f64::NAN] {
        let given = [("c1", size), ("c2", size), ("c3", size), ("c4", size), ("c5", size)];
        match run(&programs, &given, &["1 = 5"], &start, &options) {
            Ok(motion) => assert!(motion.steps < 3000, "{size}: {}", motion.steps),
            Err(Error::Stopped { cause, t }) => {
                println!("{size}: {t} {cause}");
                assert!(size > 0.1 || size.is_nan(), "{size}: {cause}");
                assert!(matches!(cause, Cause::Friction | Cause::Accelerations), "{size}: {cause}");
            }
            Err(other) => panic!("{size}: {other}"),
        }
    }
    let error = run(&programs, &[("c1", -1.0)], &[], &start, &options).unwrap_err().to_string();
    assert_eq!(error, "the dry friction of joint `1` is negative: it would drive it");
}
