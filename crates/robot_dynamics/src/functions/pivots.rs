//! Whether pivots of the mass matrix may become small, which decides how forward dynamics is solved.
//!
//! The pivot D of a coordinate in M = Lᵀ D L is the inertia that it shows where all joints farther out
//! are free. The decomposition of M takes it from the diagonal of M, so that it loses as many digits as
//! D is smaller than the diagonal: none to speak of in most arms, all of them in a wrist whose links have
//! no mass, where the axes of the first and the last joint come into line. Articulated bodies do not
//! subtract what they have not added, and keep the digits.

use nalgebra::DMatrix;

use super::{Derivation, Function, Output, forward_dynamics, mass_matrix};
use crate::model::Robot;
use crate::numeric::from_robot::nominal_value;
use crate::numeric::random::Random;
use crate::numeric::{JointKind, Mechanism};

/// Pivots below this part of the diagonal of M are small: two digits of sixteen are lost. Those of the arms
/// of industry with up to eight joints stay above 0.02 in any posture.
const SMALL: f64 = 1e-2;
/// The same from [`MANY`] coordinates on: the inner joints of long chains and of humanoids have pivots down
/// to 10⁻⁴ for the length of what they carry alone, and are solved by articulated bodies anyhow.
const SMALL_OF_MANY: f64 = 1e-5;
/// Coordinates from which on a robot has many.
const MANY: usize = 9;
/// Mass matrices that are looked at, times the square of the coordinates: a second at most where nothing
/// is optimised.
const MAX_WORK: usize = 30_000;
/// Mass matrices that are looked at in any case.
const LEAST: usize = 60;
/// Postures from which smaller pivots are looked for.
const DESCENTS: usize = 3;
/// The step, in rad or m, with which a descent begins, and the one below which it ends.
const STEPS: [f64; 2] = [0.4, 1e-4];
const SEED: u64 = 1;

/// The function `pivots` of q: the pivots as forward dynamics has them, and the diagonal of M. It is no
/// [`super::FunctionKind`]: what evaluates forward dynamics asks it how many digits are left.
pub(super) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let matrix = mass_matrix::matrix(derivation);
    let diagonal = (0..matrix.order()).map(|row| matrix.at(row, row)).collect();
    let output = |name, doc, values: Vec<_>| {
        let unit = derivation.coordinate_unit("kg m²", "kg");
        Output::new(name, doc, &unit, vec![values.len()], values)
    };
    Function {
        name: "pivots".to_owned(),
        doc: vec!["D of M = Lᵀ D L and the diagonal of M.".to_owned()],
        inputs: derivation.coordinate_inputs(["q"]),
        outputs: vec![
            output("pivots", "D", forward_dynamics::pivots(derivation)),
            output("diagonal", "The diagonal of M", diagonal),
        ],
    }
}

/// Whether a pivot of M is small in some posture, at nominal parameters; those without a value are 1.
///
/// A pivot is no smaller than the inertia of the joint's own link and drive. Where that bound is not
/// enough, mass matrices are looked at: in postures with joints at right angles, where axes come into line
/// in most wrists, in others at random, and from the worst of them downhill.
pub(super) fn may_be_small(robot: &Robot) -> bool {
    let value = |name: &str| match nominal_value(robot, name) {
        value if value.is_nan() => 1.0,
        value => value,
    };
    let Ok(mechanism) = Mechanism::from_robot(robot, &value) else { return true };
    let small = if mechanism.coordinates() < MANY { SMALL } else { SMALL_OF_MANY };
    !is_bounded(&mechanism, small) && Search::new(&mechanism, small).finds_one()
}

/// Whether the links' own inertias keep all pivots above a part of the diagonal of M.
fn is_bounded(mechanism: &Mechanism, part: f64) -> bool {
    let (mut least, mut most) =
        (vec![0.0; mechanism.coordinates()], vec![0.0; mechanism.coordinates()]);
    for link in mechanism.links() {
        let Some(coordinate) = link.joint.driver() else { continue };
        let own = match link.joint.kind {
            JointKind::Prismatic => link.mass,
            _ => link.joint.axis.dot(&(link.inertia_about_origin() * link.joint.axis)),
        };
        let ratio = link.joint.ratio * link.joint.ratio;
        least[coordinate] += ratio * (own + link.rotor_inertia);
        most[coordinate] += ratio * link.rotor_inertia;
    }
    let travel = reach(mechanism);
    for outer in mechanism.links() {
        let mut arm = outer.center_of_mass.norm();
        let mut next = Some(outer);
        while let Some(link) = next {
            if let Some(coordinate) = link.joint.driver() {
                let felt = match link.joint.kind {
                    JointKind::Prismatic => outer.mass,
                    _ => outer.inertia.trace() + outer.mass * arm * arm,
                };
                most[coordinate] += link.joint.ratio * link.joint.ratio * felt;
            }
            let slides = link.joint.kind == JointKind::Prismatic;
            arm += link.placement.translation.norm() + if slides { travel } else { 0.0 };
            next = link.parent.map(|parent| &mechanism.links()[parent]);
        }
    }
    least.iter().zip(&most).all(|(least, most)| *least > 0.0 && *least >= part * most)
}

/// The sum of the arms, m: how far joints that slide are taken to go.
fn reach(mechanism: &Mechanism) -> f64 {
    mechanism.links().iter().map(|link| link.placement.translation.norm()).sum()
}

/// A look for small pivots.
struct Search<'m> {
    mechanism: &'m Mechanism,
    small: f64,
    /// Mass matrices that may still be looked at.
    left: usize,
    /// The smallest parts found, with their postures.
    worst: Vec<(f64, Vec<f64>)>,
}

impl<'m> Search<'m> {
    fn new(mechanism: &'m Mechanism, small: f64) -> Search<'m> {
        let n = mechanism.coordinates().max(1);
        Search { mechanism, small, left: (MAX_WORK / (n * n)).max(LEAST), worst: vec![] }
    }

    fn finds_one(mut self) -> bool {
        self.look_around();
        let worst = std::mem::take(&mut self.worst);
        worst.iter().any(|(part, _)| *part < self.small)
            || worst.into_iter().any(|(part, q)| self.descend(part, q) < self.small)
    }

    /// Postures with a joint or two at right angles and the others anywhere, half of what may be looked at.
    fn look_around(&mut self) {
        let n = self.mechanism.coordinates();
        let mut random = Random::new(SEED);
        let half = self.left / 2;
        let mut q = vec![0.0; n];
        while self.left > half {
            for turned in 0..n {
                for quarters in 0..4 {
                    let mut posture = q.clone();
                    posture[turned] = f64::from(quarters) * std::f64::consts::FRAC_PI_2;
                    let part = self.smallest_part(&posture);
                    self.worst.push((part, posture));
                    if self.left <= half {
                        break;
                    }
                }
            }
            q = random.state(self.mechanism).q;
            let other = (random.uniform(0.0, n as f64) as usize).min(n.saturating_sub(1));
            if let Some(entry) = q.get_mut(other) {
                *entry =
                    (*entry / std::f64::consts::FRAC_PI_2).round() * std::f64::consts::FRAC_PI_2;
            }
        }
        self.worst.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.worst.truncate(DESCENTS);
    }

    /// The smallest part of a descent, one coordinate after the other.
    fn descend(&mut self, mut part: f64, mut q: Vec<f64>) -> f64 {
        let [mut step, end] = STEPS;
        while step > end && part >= self.small {
            let before = part;
            for coordinate in 0..q.len() {
                for change in [step, -step] {
                    if self.left == 0 {
                        return part;
                    }
                    let mut posture = q.clone();
                    posture[coordinate] += change;
                    let found = self.smallest_part(&posture);
                    if found < part {
                        (part, q) = (found, posture);
                    }
                }
            }
            if part >= before {
                step /= 3.0;
            }
        }
        part
    }

    /// The smallest pivot in a posture, each as a part of the diagonal of M.
    fn smallest_part(&mut self, q: &[f64]) -> f64 {
        self.left = self.left.saturating_sub(1);
        self.mechanism.mass_matrix(q).map_or(1.0, smallest_part)
    }
}

/// The smallest pivot of M = Lᵀ D L, each as a part of the diagonal of M; 0 where one is not above 0.
fn smallest_part(mut matrix: DMatrix<f64>) -> f64 {
    let diagonal = matrix.diagonal();
    let mut smallest = 1.0_f64;
    for pivot in (0..matrix.nrows()).rev() {
        let value = matrix[(pivot, pivot)];
        if value.is_nan() || value <= 0.0 {
            return 0.0;
        }
        smallest = smallest.min(value / diagonal[pivot]);
        for row in 0..pivot {
            let factor = matrix[(pivot, row)] / value;
            for column in 0..=row {
                let change = factor * matrix[(pivot, column)];
                matrix[(row, column)] -= change;
            }
        }
    }
    smallest
}
