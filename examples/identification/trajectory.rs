//! Periodic trajectories of all joints: finite Fourier series (J. Swevers et al., Optimal robot excitation
//! and identification, 1997).

use std::f64::consts::TAU;

use robot_numeric::random::Random;

/// The number of joints.
pub(crate) const JOINTS: usize = 6;
/// The number of harmonics: multiples of the base frequency.
const HARMONICS: usize = 5;
/// The base frequency, Hz; its inverse is the duration of the trajectory.
const FREQUENCY: f64 = 0.1;
/// The largest speed of each joint, rad/s.
const MAX_SPEED: f64 = 2.0;
/// The fraction of a joint's range that is used.
const RANGE: f64 = 0.9;

/// A position, velocity or acceleration of every joint, rad, rad/s, rad/s².
pub(crate) type Joints = [f64; JOINTS];

/// A trajectory: q_j(t) = q_j0 + Σ_h a_jh sin(2π f h t) + b_jh cos(2π f h t).
#[derive(Debug)]
pub(crate) struct Trajectory {
    centers: Joints,
    /// a and b of each joint and harmonic, rad.
    coefficients: [[(f64, f64); HARMONICS]; JOINTS],
}

impl Trajectory {
    /// Returns a random trajectory within the limits of positions, rad, and of the speed.
    pub(crate) fn random(limits: &[(f64, f64); JOINTS], random: &mut Random) -> Trajectory {
        let mut coefficients = [[(0.0, 0.0); HARMONICS]; JOINTS];
        for (of_joint, (lower, upper)) in coefficients.iter_mut().zip(limits) {
            for pair in of_joint.iter_mut() {
                *pair = (random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            }
            // These are bounds of the series and of its derivative.
            let sizes = of_joint.map(|(a, b)| f64::hypot(a, b));
            let reach: f64 = sizes.iter().sum();
            let rates = sizes.iter().zip(1..).map(|(size, h)| size * angular(h));
            let scale = (RANGE * (upper - lower) / 2.0 / reach).min(MAX_SPEED / rates.sum::<f64>());
            *of_joint = of_joint.map(|(a, b)| (a * scale, b * scale));
        }
        Trajectory { centers: limits.map(|(lower, upper)| (lower + upper) / 2.0), coefficients }
    }

    /// The period, s.
    pub(crate) fn period() -> f64 {
        1.0 / FREQUENCY
    }

    /// q, q̇ and q̈ at a time, s.
    pub(crate) fn at(&self, t: f64) -> [Joints; 3] {
        let mut state = [self.centers, [0.0; JOINTS], [0.0; JOINTS]];
        for (joint, of_joint) in self.coefficients.iter().enumerate() {
            for (&(a, b), harmonic) in of_joint.iter().zip(1..) {
                let rate = angular(harmonic);
                let (s, c) = (rate * t).sin_cos();
                state[0][joint] += a * s + b * c;
                state[1][joint] += rate * (a * c - b * s);
                state[2][joint] -= rate * rate * (a * s + b * c);
            }
        }
        state
    }
}

/// 2π f h, rad/s.
fn angular(harmonic: u32) -> f64 {
    TAU * FREQUENCY * f64::from(harmonic)
}
