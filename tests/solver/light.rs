//! Robots whose torques are far below the rounding error of a number near 1: what is given as numbers counts, however
//! small it is.

use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::{Inertia, Robot};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::robots;
use robot_symbolic::{Formula, Rational};

use crate::generated::{Case, FUNCTIONS};

/// What is compared besides the functions of `generated`.
const FURTHER: [FunctionKind; 3] =
    [FunctionKind::ForwardDynamics(Effects::NONE), FunctionKind::MassMatrix, FunctionKind::Gravity];

/// The robot with every mass, inertia and coefficient of friction times a factor.
fn scaled(mut robot: Robot, factor: &Rational) -> Robot {
    let scale = |formula: &mut Formula| {
        let value = formula.as_number().unwrap().as_rational().unwrap().clone();
        *formula = Formula::number(&(&value * factor));
    };
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
