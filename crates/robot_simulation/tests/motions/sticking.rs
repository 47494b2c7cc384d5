//! Dry friction without smoothing: rest, break-away, stops.

use std::fmt::Write as _;

use robot_build::Programs;
use robot_simulation::{
    Cause, Dynamics as _, Error, Motion, RobotProgram, SimulationOptions, State, Torques, simulate,
};

use crate::{compiled, rest, robot_file};

/// A prismatic joint along x with a body of 1 kg, under gravity in x and y.
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

/// The motion with friction under torques that are given by expressions.
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

/// A block with v = 3 m/s stops under μ m g + b v: t = m/b ln(1 + b v/F), x = m/b (v − F t/m).
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

/// A block slides to the right under a force that increases to the left. It stops, sticks as long as the force is below
/// the friction, and turns back.
#[test]
fn a_force_that_grows_breaks_away_at_its_time() {
    // q̈ = −t − 2 until v = 1 has become 0 at t²/2 + 2 t = 1. It breaks away at t = 2; then q̇ = −(t − 2)²/2.
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

/// No step misses a short push, which requires more than the friction can supply.
#[test]
fn a_short_push_between_samples_is_felt() {
    let push = ["1 = 5 + 9*(2/(2 + (10*(t - 3.3))^2))^2"];
    let motion = moved(&slide([0.0; 2], "coulomb_force = 10"), &push, &at(0.0, 0.0), 5.0, 5.0);
    assert!(motion.states[1].q[0] > 0.01, "{:?}", motion.states[1]);
    assert_eq!(motion.states[1].qd[0], 0.0);
}

/// With load-dependent friction, a block slides down an incline of the angle α if tan α > μ.
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
        // Pushed upward, it stops, and it comes back if the incline is steep enough.
        let up = moved(&text, &[], &at(0.0, -2.0), 3.0, 3.0);
        let against = 9.81 * (angle.sin() + friction * angle.cos());
        let (stop, top) = (2.0 / against, -2.0 / against);
        let expected = top + excess.max(0.0) * (3.0 - stop).powi(2) / 2.0;
        assert_near(up.states[1].q[0], expected, 1e-8);
    }
}

/// A mass on a spring whose other end moves at v sticks while the spring is stretched, then slides and comes to rest
/// for an instant in each period of the exact solution.
#[test]
fn a_block_on_a_belt_sticks_and_slips() {
    let text = slide([0.0; 2], "coulomb_positive = 2, coulomb_negative = 2, offset = 0");
    let (k, v, limit): (f64, f64, f64) = (25.0, 0.1, 2.0);
    // It slips from rest with the spring at the limit. With z = v t − q − F/k: z̈ = −k z/m, z = 0 and ż = v at first.
    // So ż = v cos ω t and q̇ = v (1 − cos ω t): after a period it is at rest again and has moved as far as the end of
    // the spring.
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

/// The energy minus the work of the torques never increases.
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
            // The tolerance covers the error of the trapezoidal rule for a smooth power.
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

/// One of the coupled links sticks while others slip; the friction that holds it is consistent with the equations, and
/// it breaks away when it must.
#[test]
fn what_holds_a_joint_agrees_with_the_equations() {
    let programs = compiled(&robot_file("trttr1"), true);
    let program = RobotProgram::new(&programs, &[], true).unwrap();
    let options = SimulationOptions { duration: 3.0, ..SimulationOptions::default() };
    let law = ["1 = 14*sin(3*t)", "2 = 3*cos(2*t)", "3 = 301.2", "5 = 0.2"];
    let motion = run(&programs, &[], &law, &rest(&[0.0; 5]), &options).unwrap();
    let friction = program.dry_friction().unwrap();
    let (mut held, mut slid) = ([0; 5], [0; 5]);
    for (index, state) in motion.states.iter().enumerate() {
        let (qdd, tau) = (&motion.qdd[index], &motion.tau[index]);
        let directed = |sign: f64| {
            let qd = state.qd.iter().map(|qd| if *qd == 0.0 { sign * 1e-200 } else { *qd });
            let state = State { q: state.q.clone(), qd: qd.collect() };
            friction.joint_torques(&state, qdd, true).unwrap()
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

/// A chain of rods about z under gravity in −y, with constant dry friction in each joint.
fn chain(links: usize, friction: &str) -> String {
    let head = "format = 1\n[robot]\nname = \"chain\"\ngravity = [0, -9.81, 0]\n".to_owned();
    (0..links).fold(head, |mut text, index| {
        let origin = if index == 0 { 0.0 } else { 0.4 };
        writeln!(
            text,
            "[[link]]\nname = \"{}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n\
             origin = {{ xyz = [{origin:?}, 0, 0] }}\nmass = 1\ncenter_of_mass = [0.2, 0, 0]\n\
             inertia = {{ zz = 0.02, unchecked = true }}\nfriction = {{ {friction} }}",
            index + 1
        )
        .unwrap();
        text
    })
}

/// Two links, compared with impulses in small equal steps (Moreau's time stepping): M (v' − v) = h (τ − C v − g) − p
/// with
/// p| ≤ h c and p opposed to v', solved by the Gauss-Seidel method.
#[test]
fn two_joints_stick_and_slip_as_small_steps_say() {
    const STEP: f64 = 2e-5;
    let programs = compiled(&chain(2, "coulomb_torque = 2, viscous = 0.3"), true);
    let law = ["1 = 7 + 4*sin(4*t)", "2 = 2 + 3*sin(5*t)"];
    let program = RobotProgram::new(&programs, &[], true).unwrap();
    let friction = program.dry_friction().unwrap();
    let start = rest(&[-0.4, 0.3]);
    let options = SimulationOptions { duration: 2.0, step: 0.1, ..SimulationOptions::default() };
    let motion = run(&programs, &[], &law, &start, &options).unwrap();
    let (mut state, mut stuck) = (start, [0; 2]);
    for index in 0..100_000_u32 {
        let t = STEP * f64::from(index);
        if index % 5000 == 0 {
            let sample = &motion.states[index as usize / 5000];
            for (joint, stuck) in stuck.iter_mut().enumerate() {
                assert_near(sample.q[joint], state.q[joint], 5e-5);
                assert_near(sample.qd[joint], state.qd[joint], 3e-4);
                *stuck += usize::from(sample.qd[joint] == 0.0);
            }
        }
        let tau = [7.0 + 4.0 * (4.0 * t).sin(), 2.0 + 3.0 * (5.0 * t).sin()];
        let mass = friction.mass_matrix(&state.q).unwrap();
        let bias = friction.joint_torques(&state, &[0.0; 2], false).unwrap();
        let pushed = [0, 1].map(|i| {
            let gained = STEP * (tau[i] - bias[i] - 0.3 * state.qd[i]);
            mass[2 * i] * state.qd[0] + mass[2 * i + 1] * state.qd[1] + gained
        });
        for _ in 0..200 {
            for i in 0..2 {
                let free = pushed[i] - mass[2 * i + 1 - i] * state.qd[1 - i];
                let limit = STEP * 2.0;
                state.qd[i] = (free.abs() - limit).max(0.0) * free.signum() / mass[3 * i];
            }
        }
        for i in 0..2 {
            state.q[i] += STEP * state.qd[i];
        }
    }
    assert!(stuck.iter().all(|count| (3..18).contains(count)), "{stuck:?}");
}

#[test]
fn twenty_joints_fall_stick_and_stop_in_few_steps() {
    let options = SimulationOptions { duration: 0.5, step: 0.1, ..SimulationOptions::default() };
    let programs = compiled(&chain(20, "coulomb_torque = 8"), true);
    let motion = run(&programs, &[], &[], &rest(&[-0.1; 20]), &options).unwrap();
    let last = motion.states.last().unwrap();
    // The first joints give way, and the last ones hold.
    assert!(last.qd[0] != 0.0 && last.qd[19] == 0.0, "{last:?}");
    assert!(motion.steps < 2000, "{}", motion.steps);
    let programs = compiled(&chain(20, "coulomb_torque = 1e9"), true);
    let motion = run(&programs, &[], &[], &rest(&[-0.1; 20]), &options).unwrap();
    assert_eq!(motion.states.last().unwrap(), &rest(&[-0.1; 20]));
    // The joints stop practically at once from all velocities.
    let moving = State { q: vec![0.0; 20], qd: (0..20).map(|i| f64::from(i) - 9.5).collect() };
    let motion = run(&programs, &[], &[], &moving, &options).unwrap();
    assert!(motion.states[1..].iter().all(|state| state.qd == [0.0; 20]));
    assert!(motion.steps < 5000, "{}", motion.steps);
}

/// A joint without inertia is at rest as long as its friction holds it; after that, it has no finite acceleration.
#[test]
fn a_joint_without_inertia_is_held_or_ends_in_a_message() {
    let text = slide([0.0; 2], "coulomb_force = 10")
        .replace("mass = 1\n", "mass = \"m\"\n")
        .replace("[[link]]", "[parameters]\nm = { value = 1, unit = \"kg\" }\n[[link]]");
    let programs = compiled(&text, true);
    let options = SimulationOptions::default();
    let motion = run(&programs, &[("m", 0.0)], &["1 = 9*sin(t)"], &at(0.0, 0.0), &options).unwrap();
    assert_eq!(motion.states.last().unwrap(), &at(0.0, 0.0));
    let error =
        run(&programs, &[("m", 0.0)], &["1 = 11*sin(t)"], &at(0.0, 0.0), &options).unwrap_err();
    let Error::Stopped { t, cause } = error else { panic!("{error}") };
    assert_near(t, (10.0_f64 / 11.0).asin(), 1e-6);
    assert_eq!(cause, Cause::Accelerations);
}

/// If every acceleration would require more friction than there is, the motion has none and stops.
#[test]
fn friction_that_no_acceleration_agrees_with_is_named() {
    let programs = compiled(&robot_file("trttr1"), true);
    let start = State { q: vec![0.0, 0.4, 0.1, 0.2, -0.3], qd: vec![0.5, 1.0, 0.4, -0.3, 2.0] };
    let error =
        run(&programs, &[("c1", 50.0), ("c4", 50.0)], &[], &start, &SimulationOptions::default());
    let Err(Error::Stopped { t, cause }) = error else { panic!("{error:?}") };
    assert_eq!((t, cause), (0.0, Cause::Friction));
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
            Err(Error::Stopped { cause, .. }) => {
                assert!(size > 0.1 || size.is_nan(), "{size}: {cause}");
                assert!(matches!(cause, Cause::Friction | Cause::Accelerations), "{size}: {cause}");
            }
            Err(other) => panic!("{size}: {other}"),
        }
    }
    let error = run(&programs, &[("c1", -1.0)], &[], &start, &options).unwrap_err().to_string();
    assert_eq!(error, "the Coulomb friction of joint `1` is negative, which would drive the joint");
}
