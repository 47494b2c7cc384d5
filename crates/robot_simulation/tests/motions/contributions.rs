//! Joint torques along trajectories, divided into contributions.

use robot_build::{Functions, Options, Programs, Source};
use robot_codegen::Interpreter;
use robot_numeric::random::{Random, Recipe};
use robot_simulation::{
    RobotProgram, State, Table, TorqueContributions, TorqueLaw, Torques, Trajectory, plot,
    torque_contributions,
};

use crate::{motion, robot_file};

/// The programs for simulations and for contributions.
fn compiled(text: &str, friction: bool, wrench: bool) -> Programs {
    let source = Source { name: "robot.toml".to_owned(), text: text.to_owned() };
    let robot = robot_build::read(&source).unwrap().robot;
    of_robot(robot, friction, wrench)
}

fn of_robot(robot: robot_model::robot::Robot, friction: bool, wrench: bool) -> Programs {
    let kinds =
        [RobotProgram::functions(friction), TorqueContributions::functions(friction, wrench)]
            .concat();
    let options = Options { functions: Functions::Chosen(kinds), ..Options::default() };
    robot_build::programs_of(robot, "robot", &options).unwrap()
}

/// Asserts that the contributions along a simulated motion add up to the joint torques of the simulation.
fn assert_round_trip(programs: &Programs, start: &State, texts: &[String], friction: bool) {
    let program = RobotProgram::new(programs, &[], friction).unwrap();
    let robot = program.robot();
    let torques = Torques::from_expressions(robot, &[], texts).unwrap();
    let motion = motion(&program, &torques, start, 1.0, 1e-9, 0.05);
    let csv = motion.table(&motion.energies(&program).unwrap()).csv();
    let table = Table::read("motion.csv", &csv).unwrap();
    let trajectory = Trajectory::from_table(robot, "motion.csv", &table).unwrap();
    let contributions = torque_contributions(programs, &[], &trajectory, friction).unwrap();
    assert_eq!(contributions.t, motion.t);
    let size =
        motion.tau.iter().chain(&contributions.gravity).chain(&contributions.inertia).flatten();
    let size = size.fold(1.0_f64, |size, entry| size.max(entry.abs()));
    for (found, given) in contributions.total.iter().flatten().zip(motion.tau.iter().flatten()) {
        let name = &robot.name;
        assert!((found - given).abs() <= 1e-10 * size, "{name}: {found} is not {given}");
    }
}

#[test]
fn simulated_motions_give_back_their_torques() {
    let text = robot_file("planar_2r");
    let texts = ["1 = 20 - 5*qd1".to_owned(), "2 = sin(3*t)".to_owned()];
    let start = State { q: vec![0.3, -0.4], qd: vec![0.1, 0.2] };
    assert_round_trip(&compiled(&text, false, false), &start, &texts, false);

    // Prismatic joints, and load-dependent friction.
    let text = robot_file("trttr1").replace("friction = { ", "friction = { smoothing = 0.05, ");
    let texts = ["2 = 8*sin(3*t)".to_owned(), "5 = 2".to_owned(), "1 = 900".to_owned()];
    let start = State { q: vec![0.1, -0.7, 0.2, 0.3, 1.1], qd: vec![0.0; 5] };
    for friction in [false, true] {
        assert_round_trip(&compiled(&text, friction, false), &start, &texts, friction);
    }
}

/// Random trees with prismatic joints, drives, and joints that follow others.
#[test]
fn trees_and_joints_that_follow_move_as_well() {
    for seed in 0..8 {
        let recipe = Recipe { drives: true, mimic: true, ..Recipe::tree(2 + seed as usize % 4) };
        let robot = robot_numeric::robots::robot(&mut Random::new(seed), &recipe);
        let count = robot.degrees_of_freedom();
        let programs = of_robot(robot, false, false);
        let texts: Vec<String> = (1..=count)
            .map(|number| format!("tau{number} = cos({number}*t) - qd{number}"))
            .collect();
        let start = State { q: vec![0.2; count], qd: vec![0.0; count] };
        assert_round_trip(&programs, &start, &texts, false);

        let program = RobotProgram::new(&programs, &[], false).unwrap();
        let free = motion(&program, &Torques::none(count), &start, 1.0, 1e-9, 0.5);
        let energies = free.energies(&program).unwrap();
        let size = energies.kinetic.iter().copied().fold(0.0, f64::max);
        let change = energies.total.iter().map(|energy| (energy - energies.total[0]).abs());
        let change = change.fold(0.0, f64::max);
        assert!(change <= 1e-7 * size + 1e-12, "seed {seed}: {change:e} of {size}");
    }
}

/// Joints that follow others have no number, so a joint named `3` can be the second.
#[test]
fn numbers_and_names_of_joints_are_not_mixed_up() {
    let text = r#"
format = 1
[robot]
name = "named"
gravity = [0, -9.81, 0]
[[link]]
name = "2"
joint = { type = "revolute", axis = "z" }
mass = 1
center_of_mass = [0, 0, 0]
inertia = { zz = 1, unchecked = true }
[[link]]
name = "b"
joint = { type = "revolute", axis = "z" }
mass = 1
center_of_mass = [0, 0, 0]
inertia = { zz = 1, unchecked = true }
"#;
    let programs = compiled(text, false, false);
    let parse = |text: &str| Torques::from_expressions(&programs.robot, &[], &[text]);
    let shown = parse("2 = 1").unwrap_err().to_string();
    assert!(shown.contains("write tau1 for it, or tau2 for the joint with this number"), "{shown}");
    let state = State { q: vec![0.0; 2], qd: vec![0.0; 2] };
    for (text, expected) in [("tau1=1", [1.0, 0.0]), ("b = 1", [0.0, 1.0]), ("1=1", [1.0, 0.0])] {
        assert_eq!(parse(text).unwrap().torques(0.0, &state), expected);
    }
}

/// For a robot with friction and a wrench, the contributions add up to the result of a single function.
#[test]
fn all_contributions_add_up() {
    let programs = compiled(&robot_file("trttr1"), true, true);
    let texts = [
        "q1 = 0.3*sin(2*t)",
        "q2 = t^2 - 0.5",
        "q3 = 0.1*t",
        "q4 = 0.2*cos(t)",
        "q5 = sin(t)^3",
        "fx = 5",
        "fz = -20*t",
        "my = 0.7",
    ];
    let robot = &programs.robot;
    let trajectory = Trajectory::from_expressions(robot, &[], &texts, 1.0, 0.1).unwrap();
    let contributions = torque_contributions(&programs, &[], &trajectory, true).unwrap();
    let names: Vec<&str> = contributions.named().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["inertia", "coriolis", "gravity", "friction", "wrench", "total"]);
    let interpreter = Interpreter::new(&programs.module, &[]).unwrap();
    let wrenches = trajectory.wrenches.as_ref().unwrap();
    for (index, wrench) in wrenches.iter().enumerate() {
        let inputs = [
            ("q", &trajectory.q[index][..]),
            ("qd", &trajectory.qd[index]),
            ("qdd", &trajectory.qdd[index]),
            ("wrench", wrench),
        ];
        let name = "inverse_dynamics_wrench_friction";
        let expected = &interpreter.call(name, &inputs).unwrap()[0].values;
        for (found, expected) in contributions.total[index].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
        }
    }
    for (name, series) in contributions.named() {
        assert!(series.iter().flatten().any(|value| value.abs() > 1e-3), "{name} is 0");
    }
    let header = contributions.table().csv();
    assert!(header.starts_with("t,tau1,tau2,tau3,tau4,tau5,inertia1,"), "{header}");
}

/// Without velocity there is no Coriolis torque, and without force none of a wrench: not even one of rounding.
#[test]
fn what_does_not_act_has_no_torque() {
    let programs = compiled(&robot_file("puma560"), false, true);
    let rest = ["q1 = 0.3", "q2 = -0.7", "q3 = 1.1", "q4 = 0.2", "q5 = 0.9", "q6 = -0.4", "fx = 0"];
    let trajectory = Trajectory::from_expressions(&programs.robot, &[], &rest, 1.0, 0.5).unwrap();
    let found = torque_contributions(&programs, &[], &trajectory, false).unwrap();
    for series in [&found.coriolis, &found.inertia, found.wrench.as_ref().unwrap()] {
        assert!(series.iter().flatten().all(|torque| *torque == 0.0), "{series:?}");
    }
    assert!(found.gravity.iter().flatten().any(|torque| torque.abs() > 1.0));
}

/// The contributions for a pendulum are known: m l²/3 q̈, 0, m g l/2 cos q.
#[test]
fn expressions_are_differentiated() {
    let programs = compiled(crate::PENDULUM, false, false);
    let texts = ["q1 = g*t^2/4 + sin(2*t)"];
    let robot = &programs.robot;
    let trajectory = Trajectory::from_expressions(robot, &[("g", 2.0)], &texts, 2.0, 0.5).unwrap();
    let contributions = torque_contributions(&programs, &[("g", 2.0)], &trajectory, false).unwrap();
    for (index, t) in contributions.t.iter().enumerate() {
        let (q, qd) = (t * t / 2.0 + (2.0 * t).sin(), t + 2.0 * (2.0 * t).cos());
        let qdd = 1.0 - 4.0 * (2.0 * t).sin();
        assert!((trajectory.qd[index][0] - qd).abs() < 1e-12);
        assert!((contributions.inertia[index][0] - qdd / 3.0).abs() < 1e-12, "{t}");
        assert!((contributions.gravity[index][0] - q.cos()).abs() < 1e-12, "{t}");
        assert!(contributions.coriolis[index][0].abs() < 1e-15);
    }
}

#[test]
fn what_is_wrong_with_a_trajectory_is_named() {
    let programs = compiled(&robot_file("planar_2r"), false, false);
    let robot = &programs.robot;
    let table =
        Table::read("a.csv", "t,q1,q2,qd1,qdd1,qdd2,tau1,energy,fx,x\n0,0,0,0,0,0,0,0,0,0\n");
    let error = Trajectory::from_table(robot, "a.csv", &table.unwrap()).unwrap_err().to_string();
    assert!(error.contains("a.csv: there is no column `qd2`"), "{error}");
    assert!(error.contains("a.csv: the column `x` is unknown"), "{error}");
    let texts = ["q1 = sin(q2)", "q3 = t", "q2 = t", "q2 = 1"];
    let error = Trajectory::from_expressions(robot, &[], &texts, 1.0, 0.1).unwrap_err();
    let shown = error.to_string();
    let lines: Vec<&str> = shown.lines().collect();
    assert!(lines[0].starts_with("`q1 = sin(q2)`: `q2` is not known here"), "{shown}");
    assert!(
        lines[1].starts_with("`q3` is not part of a trajectory; its parts are q1, q2"),
        "{shown}"
    );
    assert_eq!(lines[2], "`q2` is given twice; leave one out");
    // The expression for `q1` is wrong, but it is there.
    assert_eq!(lines.len(), 3, "{shown}");
    let error = Trajectory::from_expressions(robot, &[], &["q2 = t"], 1.0, 0.1).unwrap_err();
    assert!(error.to_string().starts_with("there is no expression for `q1`"), "{error}");
    let roots = ["q1 = sqrt(t)", "q2 = sqrt(0.6 - t)"];
    let error =
        Trajectory::from_expressions(robot, &[], &roots, 1.0, 0.25).unwrap_err().to_string();
    let lines: Vec<&str> = error.lines().collect();
    let first = "`q1`: the velocity is not finite at t = 0 s; look for";
    let second = "`q2`: the position is not finite at t = 0.75 s; look for";
    assert!(
        lines.len() == 2 && lines[0].starts_with(first) && lines[1].starts_with(second),
        "{error}"
    );
}

#[test]
fn figures_are_the_same_bytes_each_time() {
    let programs = compiled(&robot_file("stanford"), false, false);
    let program = RobotProgram::new(&programs, &[], false).unwrap();
    let start = State { q: vec![0.0, 0.5, 1.0, 0.3, 0.4, 0.0], qd: vec![0.0; 6] };
    let motion = motion(&program, &Torques::none(6), &start, 2.0, 1e-9, 0.01);
    let energies = motion.energies(&program).unwrap();
    let figure = plot::motion_figure(program.robot(), &motion, &energies, true);
    // Revolute and prismatic joints have separate panels; the arm is not driven, so there is none for torques.
    let labels: Vec<String> =
        figure.panels.iter().map(|panel| format!("{} {}", panel.quantity, panel.unit)).collect();
    let expected = [
        "position q rad",
        "position q m",
        "velocity q\u{307} rad/s",
        "velocity q\u{307} m/s",
        "energy J",
        "energy − start J",
    ];
    assert_eq!(labels, expected);
    let svg = figure.svg().unwrap();
    assert_eq!(svg, figure.svg().unwrap());
    for part in
        ["Motion of stanford", "velocity q\u{307} (m/s)", "potential", "t (s)", "width=\"900\""]
    {
        assert!(svg.contains(part), "{part}");
    }
    assert!(svg.len() < 150_000, "{}", svg.len());
    let png = figure.png().unwrap();
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
    assert_eq!(png, figure.png().unwrap());
}

/// Where the argument of `abs` or `sign` is 0, derivatives are limits, not those with sgn 0 = 0: `T` is the time from
/// there, at the start of the motion, within it and at its end.
#[test]
fn derivatives_at_zeros_of_absolute_values_are_limits() {
    let robot = robot_file("planar_2r");
    let robot = &compiled(&robot, false, false).robot;
    let at_zero = |text: &str, zero: f64| {
        let text = format!("q1 = {}", text.replace('T', &format!("(t - {zero})")));
        let found = Trajectory::from_expressions(robot, &[], &[text.as_str(), "q2 = 0"], 1.0, 0.25);
        let found = found.unwrap_or_else(|error| panic!("{text}: {error}"));
        let row = found.t.iter().position(|t| *t == zero).unwrap();
        [found.qd[row][0], found.qdd[row][0]]
    };
    for zero in [0.0, 0.5, 1.0] {
        for (text, expected) in [
            ("abs(T)^2", [0.0, 2.0]),
            ("abs(T^2)", [0.0, 2.0]),
            ("3*T + sign(T)*T*abs(T)", [3.0, 2.0]),
            ("abs(abs(T))^2 - T", [-1.0, 2.0]),
            ("0.1/(2 + abs(sin(T))^2)", [0.0, -0.05]),
            ("T^3 + abs(T + 2)", [1.0, 0.0]),
        ] {
            let found = at_zero(text, zero);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{text} at {zero}: {found}");
            }
        }
    }
    // The acceleration of T |T| jumps from -2 to 2.
    let jump = [0.0, 0.5, 1.0].map(|zero| at_zero("T*abs(T)", zero)[1]);
    assert_eq!(jump, [2.0, 0.0, -2.0]);
}
