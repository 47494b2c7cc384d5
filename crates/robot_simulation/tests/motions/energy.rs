//! Without friction and joint torques the energy is constant.

use robot_simulation::{RobotProgram, Torques};

use crate::{PENDULUM, compiled, motion, rest, robot_file};

/// The largest change of the energy over 10 s, in units of the tolerance times the largest kinetic energy. Measured:
/// 4.7 for the pendulum, 3.5 for the double pendulum, 0.8 for the PUMA 560.
const BOUND: f64 = 10.0;

#[test]
fn energy_stays_within_the_tolerance() {
    let robots = [
        (PENDULUM.to_owned(), vec![1.5]),
        (robot_file("planar_2r"), vec![1.5, 0.5]),
        (robot_file("puma560"), vec![0.0, 0.5, -1.0, 0.3, 0.4, 0.0]),
        // An arm with a prismatic joint.
        (robot_file("stanford"), vec![0.0, 0.5, 1.0, 0.3, 0.4, 0.0]),
    ];
    for (text, q) in robots {
        let programs = compiled(&text, false);
        let program = RobotProgram::new(&programs, &[], false).unwrap();
        // With samples 1 s apart, the integrator chooses the steps.
        for (tolerance, step) in [(1e-6, 1.0), (1e-9, 1.0), (1e-12, 1.0), (1e-9, 0.01)] {
            let motion =
                motion(&program, &Torques::none(q.len()), &rest(&q), 10.0, tolerance, step);
            let energies = motion.energies(&program).unwrap();
            let size = energies.kinetic.iter().copied().fold(0.0, f64::max);
            // The arms fall and swing.
            assert!(size > 5.0, "{size}");
            let start = energies.total[0];
            let change =
                energies.total.iter().map(|energy| (energy - start).abs()).fold(0.0, f64::max);
            let name = &program.robot().name;
            assert!(change <= BOUND * tolerance * size, "{name}, {tolerance:e}: {change:e} J");
        }
    }
}

/// The solution of q̈ = −9.81 q is q = cos √9.81 t.
#[test]
fn an_oscillator_follows_its_solution() {
    use robot_simulation::{SimulationOptions, from_fn, simulate};
    let oscillator = from_fn(1, |state, tau| vec![tau[0] - 9.81 * state.q[0]]);
    let mut heard = vec![];
    let options =
        SimulationOptions { duration: 10.0, step: 0.3, tolerance: 1e-10, ..Default::default() };
    let motion = simulate(&oscillator, &Torques::none(1), &rest(&[1.0]), &options, &mut |t| {
        heard.push(t);
    })
    .unwrap();
    assert_eq!((motion.t.len(), motion.t.last()), (35, Some(&10.0)));
    for (t, state) in motion.t.iter().zip(&motion.states) {
        let phase = 9.81_f64.sqrt() * t;
        assert!((state.q[0] - phase.cos()).abs() < 1e-8, "{t}");
        assert!((state.qd[0] + 9.81_f64.sqrt() * phase.sin()).abs() < 3e-8, "{t}");
    }
    assert!(heard.is_sorted() && heard.len() <= motion.steps, "{}", heard.len());
    assert!((heard.last().unwrap() - 10.0).abs() < 1e-11);
}
