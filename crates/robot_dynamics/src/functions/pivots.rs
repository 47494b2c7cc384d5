//! Determines whether pivots of the mass matrix may become small, on which the method of forward dynamics depends.
//!
//! The pivot D of a coordinate in M = Lᵀ D L is its inertia if all joints farther outward are free. The decomposition
//! of M computes it by subtractions from the diagonal of M, so it loses digits if D is much smaller than the diagonal.
//! In most arms the loss is negligible; in a wrist with massless links, all digits are lost if the axes of the first
//! and the last joint are aligned. The articulated-body algorithm does not subtract anything that it has not added
//! before, and preserves the digits.

use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::Random;

use super::sampled::{Rows, SampledMassMatrix};
use super::{Derivation, Function, Output, forward_dynamics, mass_matrix};

/// Pivots below this fraction of the diagonal of M are small: two of sixteen digits are lost. The pivots of industrial
/// arms with up to eight joints are above 0.02 in all configurations.
const SMALL: f64 = 1e-2;
/// The corresponding limit for robots with at least [`MANY`] coordinates. The inner joints of long chains and of
/// humanoids have pivots down to 10⁻⁴ because the links that they carry are long; such robots are mostly solved by the
/// articulated-body algorithm anyway.
const SMALL_OF_MANY: f64 = 1e-5;
/// The number of coordinates from which [`SMALL_OF_MANY`] applies.
const MANY: usize = 9;
/// The maximum number of mass matrices to evaluate, times the square of the number of coordinates; this takes at most a
/// second in an unoptimized build.
const MAX_WORK: usize = 30_000;
/// The minimum number of mass matrices to evaluate.
const LEAST: usize = 60;
/// The number of configurations from which a descent to smaller pivots starts.
const DESCENTS: usize = 3;
/// The step of a descent at its beginning and its end, in rad or m.
const STEPS: [f64; 2] = [0.4, 1e-4];
const SEED: u64 = 1;

/// The function `pivots` of q: the pivots as in forward dynamics, and the diagonal of M. It is not a
/// [`super::FunctionKind`]; callers that evaluate forward dynamics use it to determine how many digits are correct.
pub(super) fn pivots<'g>(derivation: &Derivation<'_, 'g>) -> Function<'g> {
    let matrix = mass_matrix::matrix(derivation);
    let diagonal = (0..matrix.order()).map(|row| matrix.at(row, row)).collect();
    let output = |name, doc, values: Vec<_>| {
        let unit = derivation.unit_by_joint("kg m²", "kg");
        Output::new(name, doc, &unit, vec![values.len()], values)
    };
    Function {
        name: "pivots".to_owned(),
        doc: vec!["D of M = Lᵀ D L and the diagonal of M.".to_owned()],
        inputs: vec![derivation.coordinate_input(JointVariable::Position)],
        outputs: vec![
            output("pivots", "D", forward_dynamics::pivots(derivation)),
            output("diagonal", "The diagonal of M", diagonal),
        ],
    }
}

/// Whether a configuration is found in which a pivot of M is small, at the nominal parameters; parameters without a
/// value are set to 1.
///
/// A pivot is at least the inertia of the joint's own link and drive. If this bound does not suffice, mass matrices are
/// evaluated: in configurations in which one or two joint positions are multiples of π/2, where the axes of most wrists
/// are aligned, and the others are 0 or random, and in descents from the worst of these.
pub(super) fn may_be_small(robot: &Robot) -> bool {
    let matrix = SampledMassMatrix::new(robot);
    let small = small(matrix.order());
    !matrix.keeps_pivots_above(small) && Search::new(&matrix, small).finds_one()
}

/// The fraction of the diagonal below which pivots of a robot with this many coordinates are small.
fn small(coordinates: usize) -> f64 {
    if coordinates < MANY { SMALL } else { SMALL_OF_MANY }
}

/// A search for small pivots.
struct Search<'m> {
    matrix: &'m SampledMassMatrix,
    small: f64,
    /// The number of mass matrices that may still be evaluated.
    left: usize,
    /// The smallest ratios that were found, with their configurations.
    worst: Vec<(f64, Vec<f64>)>,
}

impl<'m> Search<'m> {
    fn new(matrix: &'m SampledMassMatrix, small: f64) -> Search<'m> {
        let n = matrix.order().max(1);
        Search { matrix, small, left: (MAX_WORK / (n * n)).max(LEAST), worst: vec![] }
    }

    fn finds_one(mut self) -> bool {
        self.look_around();
        let worst = std::mem::take(&mut self.worst);
        worst.iter().any(|(part, _)| *part < self.small)
            || worst.into_iter().any(|(part, q)| self.descend(part, q) < self.small)
    }

    /// Evaluates configurations with one or two joint positions at multiples of π/2 and the others at random, using
    /// half of the budget.
    fn look_around(&mut self) {
        let n = self.matrix.order();
        let mut random = Random::new(SEED);
        let half = self.left / 2;
        let mut q = vec![0.0; n];
        while self.left > half {
            for turned in 0..n {
                for quarters in 0..4 {
                    let mut configuration = q.clone();
                    configuration[turned] = f64::from(quarters) * std::f64::consts::FRAC_PI_2;
                    let part = self.smallest_part(&configuration);
                    self.worst.push((part, configuration));
                    if self.left <= half {
                        break;
                    }
                }
            }
            q = self.matrix.configuration(&mut random);
            let other = (random.uniform(0.0, n as f64) as usize).min(n.saturating_sub(1));
            if let Some(entry) = q.get_mut(other) {
                *entry =
                    (*entry / std::f64::consts::FRAC_PI_2).round() * std::f64::consts::FRAC_PI_2;
            }
        }
        self.worst.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.worst.truncate(DESCENTS);
    }

    /// The smallest ratio that a descent along single coordinates finds.
    fn descend(&mut self, mut part: f64, mut q: Vec<f64>) -> f64 {
        let [mut step, end] = STEPS;
        while step > end && part >= self.small {
            let before = part;
            for coordinate in 0..q.len() {
                for change in [step, -step] {
                    if self.left == 0 {
                        return part;
                    }
                    let mut configuration = q.clone();
                    configuration[coordinate] += change;
                    let found = self.smallest_part(&configuration);
                    if found < part {
                        (part, q) = (found, configuration);
                    }
                }
            }
            if part >= before {
                step /= 3.0;
            }
        }
        part
    }

    /// The smallest ratio of a pivot to the diagonal entry of M in a configuration.
    fn smallest_part(&mut self, q: &[f64]) -> f64 {
        self.left = self.left.saturating_sub(1);
        smallest_part(self.matrix.at(q))
    }
}

/// The smallest ratio of a pivot of M = Lᵀ D L to the diagonal entry of M; 0 if a pivot is not positive.
pub(super) fn smallest_part(mut matrix: Rows) -> f64 {
    let diagonal: Vec<f64> = (0..matrix.len()).map(|row| matrix[row][row]).collect();
    let mut smallest = 1.0_f64;
    while let Some(pivot_row) = matrix.pop() {
        let pivot = matrix.len();
        let value = pivot_row[pivot];
        if value.is_nan() || value <= 0.0 {
            return 0.0;
        }
        smallest = smallest.min(value / diagonal[pivot]);
        for (row, entries) in matrix.iter_mut().enumerate() {
            let factor = pivot_row[row] / value;
            for (column, entry) in entries.iter_mut().enumerate().take(row + 1) {
                *entry -= factor * pivot_row[column];
            }
        }
    }
    smallest
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_model::robot::Robot;
    use robot_testing::{read, robot};

    #[test]
    fn pivots_are_relative_to_the_diagonal() {
        assert_eq!(smallest_part(vec![vec![3.0, 0.0], vec![0.0, 5.0]]), 1.0);
        // 8 − 4²/4 = 4, half of 8.
        assert_eq!(smallest_part(vec![vec![8.0, 4.0], vec![4.0, 4.0]]), 0.5);
        // From the last: 2; 3 − 1 = 2 and 9 − 2² = 5 without the last, 1 between them; 5 − 1/2.
        let three = vec![vec![11.0, 3.0, 2.0], vec![3.0, 3.5, 1.0], vec![2.0, 1.0, 1.0]];
        let pivots = [1.0, 3.5 - 1.0, 11.0 - 4.0 - (3.0_f64 - 2.0).powi(2) / 2.5];
        assert_eq!(smallest_part(three), (pivots[2] / 11.0).min(pivots[1] / 3.5));
        for wrong in [0.0, -1.0, f64::NAN] {
            assert_eq!(smallest_part(vec![vec![1.0, 0.0], vec![0.0, wrong]]), 0.0);
        }
        assert_eq!(smallest_part(vec![vec![1.0, 2.0], vec![2.0, 1.0]]), 0.0);
    }

    /// A wrist of three joints whose axes meet, the outermost link with all of the inertia about its axis.
    fn wrist(turned: &str, own: f64) -> Robot {
        let link = |name: &str, axis: &str, mass: f64, own: f64| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = \"{axis}\" }}\n\
                 mass = {mass}\ncenter_of_mass = [0, 0, 0]\ninertia = {{ xx = {own}, yy = {own}, zz = {own} }}\n"
            )
        };
        let links =
            [link("a", "z", 1.0, own), link("b", turned, 1.0, own), link("c", "z", 1.0, 1.0)];
        read("wrist", &format!("format = 1\n[robot]\nname = \"wrist\"\n{}", links.concat()))
    }

    /// If the first axis is aligned with the last, the pivot of the first joint is only the small inertia of the first
    /// two links.
    #[test]
    fn a_small_pivot_is_found_where_axes_are_aligned() {
        assert!(may_be_small(&wrist("x", 1e-4)));
        assert!(!may_be_small(&wrist("x", 0.5)));
        // The pivot of the first joint is 2·10⁻³ of the diagonal; pivots below a hundredth count as small.
        assert!(may_be_small(&wrist("x", 1e-3)));
        for name in ["puma560", "scara", "planar_2r"] {
            assert!(!may_be_small(&robot(name)), "{name}");
        }
    }

    #[test]
    fn nine_coordinates_are_many() {
        assert_eq!([8, 9].map(small), [SMALL, SMALL_OF_MANY]);
    }
}
