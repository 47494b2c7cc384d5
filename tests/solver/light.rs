//! Robots whose torques are far below the rounding error of a number near 1, or whose speeds are far above: what is given
//! as numbers counts, however small it is.

use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::{Inertia, JointKind, Move, Placement, Robot};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Formula, Rational};

use crate::generated::{Case, FUNCTIONS};

/// What is compared besides the functions of `generated`.
const FURTHER: [FunctionKind; 3] =
    [FunctionKind::ForwardDynamics(Effects::NONE), FunctionKind::MassMatrix, FunctionKind::Gravity];

/// What is compared for robots of other lengths.
const OF_SIZES: [FunctionKind; 5] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::InverseDynamics(Effects::WRENCH),
    FURTHER[0],
    FURTHER[1],
    FURTHER[2],
];

/// Multiplies a number of a robot by a factor.
fn scale(formula: &mut Formula, factor: &Rational) {
    let value = formula.as_number().unwrap().as_rational().unwrap().clone();
    *formula = Formula::number(&(&value * factor));
}

/// The robot with every mass, inertia and coefficient of friction times a factor.
fn scaled(mut robot: Robot, factor: &Rational) -> Robot {
    let scale = |formula: &mut Formula| scale(formula, factor);
    for link in &mut robot.links {
        for body in &mut link.bodies {
            scale(&mut body.mass);
            let Inertia { xx, yy, zz, xy, xz, yz } = &mut body.inertia;
            [xx, yy, zz, xy, xz, yz].into_iter().for_each(scale);
        }
        let (drive, friction) = (&mut link.drive, &mut link.friction);
        [&mut drive.armature, &mut drive.rotor_inertia].into_iter().for_each(scale);
        let dry = [&mut friction.coulomb_positive, &mut friction.coulomb_negative];
        dry.into_iter().for_each(scale);
        [&mut friction.viscous, &mut friction.offset].into_iter().for_each(scale);
    }
    robot
}

/// A robot of 10⁻⁹ to 10⁻¹⁰⁰ kg has the accelerations of one of a kilogram at torques that are as much smaller, and
/// torques that are as much smaller at the same accelerations.
#[test]
fn the_programs_of_light_robots() {
    let functions = [&FUNCTIONS[..], &FURTHER].concat();
    for exponent in [9, 13, 15, 16, 17, 18, 20, 25, 40, 100] {
        let factor = Rational::from_decimal(&format!("1e-{exponent}")).unwrap();
        let mut worst = 0.0_f64;
        for seed in 0..6 {
            let recipe = Recipe { drives: seed % 2 == 1, ..Recipe::serial(1 + seed as usize % 3) };
            let robot = scaled(robots::robot(&mut Random::new(seed), &recipe), &factor);
            let mut case = Case::of(&functions, &format!("1e-{exponent} kg"), robot, seed, 10);
            for state in &mut case.states {
                let factor = factor.to_f64();
                state.tau.iter_mut().for_each(|tau| *tau *= factor);
                for wrench in &mut state.wrenches {
                    (wrench.force, wrench.moment) = (wrench.force * factor, wrench.moment * factor);
                }
            }
            worst = worst.max(case.interpret());
        }
        println!("1e-{exponent} kg: worst error {worst:.1e}");
    }
}

/// The robot with every length times a factor, with joints that rotate.
fn shortened(mut robot: Robot, factor: &Rational) -> Robot {
    let shorten = |placement: &mut Placement| {
        for step in &mut placement.0 {
            if let Move::Translate(vector) = step {
                vector.iter_mut().for_each(|length| scale(length, factor));
            }
        }
    };
    let square = factor * factor;
    for link in &mut robot.links {
        link.joint.kind = JointKind::Revolute;
        shorten(&mut link.placement);
        for body in &mut link.bodies {
            shorten(&mut body.placement);
            let Inertia { xx, yy, zz, xy, xz, yz } = &mut body.inertia;
            [xx, yy, zz, xy, xz, yz].into_iter().for_each(|entry| scale(entry, &square));
        }
    }
    robot.frames.iter_mut().for_each(|frame| shorten(&mut frame.placement));
    robot
}

/// A robot whose links are f meters long instead of one moves as the longer one in a time that is √f as long, at torques
/// of f times the size: the speeds of a link of a nanometer are 3·10⁴ rad/s.
#[test]
fn the_programs_of_short_robots() {
    let mut pairs: Vec<(i32, i32)> = [3, 6, 7, 8, 9, 10, 12, 15, 20, 30]
        .iter()
        .flat_map(|length| [(*length, 0), (*length, 9), (*length, 20)])
        .collect();
    pairs.extend((1..8).flat_map(|length| (1..20).map(move |mass| (length, mass))));
    for (length, mass) in pairs {
        let factors = [length, mass].map(|exponent| format!("1e-{exponent}"));
        let worst = (0..6).map(|seed| of_size(&factors, seed)).fold(0.0, f64::max);
        println!("{} m, {} kg: worst error {worst:.1e}", factors[0], factors[1]);
    }
}

/// Robots of random sizes. `ROBOT_SIZES` is the number of robots, `ROBOT_SIZES_SEED` that of the first.
#[test]
fn the_programs_of_robots_of_random_sizes() {
    let number = |name: &str, usual: u64| {
        std::env::var(name).map_or(usual, |number| number.parse().unwrap())
    };
    let (first, count) = (number("ROBOT_SIZES_SEED", 1000), number("ROBOT_SIZES", 60));
    let mut worst = 0.0_f64;
    for seed in first..first + count {
        let mut random = Random::new(seed);
        let mut factor = |least: f64, most: f64| {
            let exponent = random.uniform(least, most);
            format!("{}e{}", 1 + random.bits() % 9, exponent.round())
        };
        let factors = [factor(-20.0, 0.0), factor(-20.0, 3.0)];
        println!("seed {seed}: {} m, {} kg", factors[0], factors[1]);
        worst = worst.max(of_size(&factors, seed));
    }
    println!("{count} robots from seed {first}: worst error {worst:.1e}");
}

/// Compares the functions of a random robot whose lengths and masses are multiplied by these factors with the solver, in
/// motion at its natural speeds, and at rest without torques, so that gravity alone moves it.
fn of_size(factors: &[String; 2], seed: u64) -> f64 {
    let [length_factor, mass_factor] =
        [0, 1].map(|index| Rational::from_decimal(&factors[index]).unwrap());
    let name = format!("{} m, {} kg", factors[0], factors[1]);
    let robot = robots::robot(&mut Random::new(seed), &Recipe::serial(1 + seed as usize % 4));
    let robot = scaled(shortened(robot, &length_factor), &mass_factor);
    let [length, mass] = [&length_factor, &mass_factor].map(Rational::to_f64);
    let mut case = Case::of(&OF_SIZES, &name, robot, seed, 10);
    for state in &mut case.states {
        state.qd.iter_mut().for_each(|speed| *speed /= length.sqrt());
        state.qdd.iter_mut().for_each(|acceleration| *acceleration /= length);
        state.tau.iter_mut().for_each(|tau| *tau *= mass * length);
        for wrench in &mut state.wrenches {
            wrench.force *= mass;
            wrench.moment *= mass * length;
        }
    }
    let moving = case.interpret();
    for state in &mut case.states {
        [&mut state.qd, &mut state.tau].into_iter().for_each(|values| values.fill(0.0));
    }
    moving.max(case.interpret())
}

/// A robot of 16 µm and 15 ng at rest, for which sizes that show the terms of one sum hide those of another.
#[test]
fn the_programs_of_a_robot_of_micrometers() {
    const TEXT: &str = r#"format = 1
[robot]
name = "micrometers"
gravity = [0, 0, -9.81]
[[link]]
name = "l0"
joint = { type = "revolute", axis = [-0.4789, 0.9929, 0.1799] }
origin = { xyz = [-1.51366e-05, -1.01307e-05, 9.15022e-06] }
mass = 2.814697e-12
center_of_mass = [-1.25076e-05, -8.91683e-06, 1.13817e-05]
inertia = { xx = 2.43529e-22, yy = 2.43529e-22, zz = 2.43529e-22 }
[[link]]
name = "l1"
parent = "l0"
joint = { type = "revolute", axis = [-0.1852, 0.6517, 0.5913] }
origin = { xyz = [-1.18596e-05, -4.37618e-06, -1.42175e-06] }
mass = 4.170746e-12
center_of_mass = [1.69506e-06, 1.57727e-05, -1.55104e-05]
inertia = { xx = 4.56596e-22, yy = 2.71743e-22, zz = 5.48017e-22 }
[[link]]
name = "l2"
parent = "l1"
joint = { type = "revolute", axis = [-0.1705, -0.7105, 0.8394] }
origin = { xyz = [1.01546e-05, 1.54762e-05, 9.56467e-06] }
mass = 2.380004e-12
center_of_mass = [8.01236e-06, -1.27687e-05, 5.32614e-06]
inertia = { xx = 3.81372e-22, yy = 2.31294e-22, zz = 2.43130e-22 }
[[link]]
name = "l3"
parent = "l2"
joint = { type = "revolute", axis = [0.2613, -0.5126, 0.1063] }
origin = { xyz = [-1.28664e-05, -9.72746e-06, -4.22507e-06] }
mass = 5.743569e-12
center_of_mass = [-1.12493e-05, 3.11000e-06, -1.20600e-06]
inertia = { xx = 3.21761e-22, yy = 4.87653e-22, zz = 3.10053e-22 }
"#;
    let robot = robot_testing::read("micrometers.toml", TEXT);
    let forward = FunctionKind::ForwardDynamics(Effects::NONE);
    let mut case = Case::of(&[forward], "micrometers", robot, 3, 20);
    for state in &mut case.states {
        // Torques of size one would be larger than those of gravity by a factor of 10¹⁵, and hide their errors.
        state.qd.fill(0.0);
        state.tau.fill(0.0);
    }
    println!("micrometers: worst error {:.1e}", case.interpret());
}
