//! Periodic trajectories of all joints: finite Fourier series (J. Swevers et al., Optimal robot excitation and
//! identification, 1997).

use std::f64::consts::{PI, TAU};

use robot_model::robot::JointKind;
use robot_symbolic::{Random, Rational};

use crate::robots::Model;

/// The number of harmonics: multiples of the base frequency.
const HARMONICS: usize = 5;

/// The fraction of a joint's range that is used.
const RANGE: f64 = 0.9;

/// The limits of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The lowest and the highest position, rad or m.
    pub position: [f64; 2],
    /// The largest speed, rad/s or m/s.
    pub speed: f64,
}

/// The limits of the joints in the robot file; without limits in the file, half a turn or half a meter to both
/// sides.
#[must_use]
pub fn limits(model: &Model, speed: f64) -> Vec<Limits> {
    let coordinates = model.robot.coordinates.iter();
    let limits = coordinates.map(|coordinate| {
        let usual = match coordinate.kind {
            JointKind::Revolute => PI,
            JointKind::Prismatic => 0.5,
        };
        let given = coordinate.limits.as_ref();
        let position =
            given.map_or([-usual, usual], |limits| limits.each_ref().map(Rational::to_f64));
        Limits { position, speed }
    });
    limits.collect()
}

/// q_j(t) = c_j + Σ_h a_jh sin(2π f h t) + b_jh cos(2π f h t).
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// f, Hz: the inverse of the period.
    pub frequency: f64,
    /// c of each joint, rad or m.
    pub centers: Vec<f64>,
    /// a and b of each joint and harmonic, rad or m.
    pub coefficients: Vec<[[f64; 2]; HARMONICS]>,
}

impl Trajectory {
    /// Returns a random trajectory within the limits.
    #[must_use]
    pub fn random(limits: &[Limits], frequency: f64, random: &mut Random) -> Trajectory {
        let mut uniform = || random.uniform(-1.0, 1.0);
        let coefficients = limits.iter().map(|_| [(); HARMONICS].map(|()| [uniform(), uniform()]));
        let coefficients = coefficients.collect();
        let centers = vec![0.0; limits.len()];
        Trajectory { frequency, centers, coefficients }.within(limits)
    }

    /// Scales each joint's series so that its bounds are the limits.
    #[must_use]
    pub(super) fn within(mut self, limits: &[Limits]) -> Trajectory {
        for (joint, limits) in limits.iter().enumerate() {
            let sizes = self.coefficients[joint].map(|[a, b]| a.hypot(b));
            let reach: f64 = sizes.iter().sum();
            let rates =
                sizes.iter().zip(1..).map(|(size, h)| size * TAU * self.frequency * f64::from(h));
            let [lower, upper] = limits.position;
            let scale =
                (RANGE * (upper - lower) / 2.0 / reach).min(limits.speed / rates.sum::<f64>());
            // A joint that must not move has no series.
            let scale = if scale.is_finite() { scale } else { 0.0 };
            self.coefficients[joint] =
                self.coefficients[joint].map(|pair| pair.map(|one| one * scale));
            self.centers[joint] = (lower + upper) / 2.0;
        }
        self
    }

    /// Returns another trajectory within the same limits that is close to this one.
    #[must_use]
    pub(super) fn near(&self, limits: &[Limits], random: &mut Random) -> Trajectory {
        let mut next = self.clone();
        let joint = random.index(limits.len());
        let size: f64 =
            next.coefficients[joint].iter().map(|[a, b]| a.hypot(*b)).fold(0.0, f64::max);
        for pair in next.coefficients[joint].iter_mut().flatten() {
            *pair += 0.3 * size * random.uniform(-1.0, 1.0);
        }
        next.within(limits)
    }

    /// The period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        1.0 / self.frequency
    }

    /// Writes q, q̇ and q̈ of all joints at a time, in s: the columns of a row.
    pub fn at(&self, time: f64, row: &mut [f64]) {
        let joints = self.centers.len();
        let (sine, cosine) = (TAU * self.frequency * time).sin_cos();
        let mut waves = [(sine, cosine, TAU * self.frequency); HARMONICS];
        for h in 1..HARMONICS {
            let (s, c, rate) = waves[h - 1];
            waves[h] = (s * cosine + c * sine, c * cosine - s * sine, rate + waves[0].2);
        }
        for (joint, (center, coefficients)) in
            self.centers.iter().zip(&self.coefficients).enumerate()
        {
            let [mut q, mut qd, mut qdd] = [*center, 0.0, 0.0];
            for ([a, b], (s, c, rate)) in coefficients.iter().zip(&waves) {
                let value = a * s + b * c;
                q += value;
                qd += rate * (a * c - b * s);
                qdd -= rate * rate * value;
            }
            row[joint] = q;
            row[joints + joint] = qd;
            row[2 * joints + joint] = qdd;
        }
    }
}
