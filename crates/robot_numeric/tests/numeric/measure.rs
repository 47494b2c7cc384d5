//! Errors of comparisons, and the random mechanisms that are used for them.

use std::collections::BTreeMap;

use nalgebra::DMatrix;
use robot_numeric::Mechanism;
use robot_numeric::random::{Random, Recipe, State};

/// The largest error of each quantity that was compared, and the place where it occurred.
#[derive(Default)]
pub(crate) struct Worst {
    errors: BTreeMap<String, (f64, String)>,
}

impl Worst {
    /// Records an error; NaN counts as larger than any number.
    pub(crate) fn note(&mut self, what: &str, place: &str, error: f64) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        let entry = self.errors.entry(what.into()).or_insert((-1.0, String::new()));
        if error > entry.0 {
            *entry = (error, place.into());
        }
    }

    /// Records the largest difference between two lists of numbers, relative to the largest number of the second list,
    /// or to `scale` if that is larger.
    pub(crate) fn compare(
        &mut self,
        what: &str,
        place: &str,
        found: &[f64],
        expected: &[f64],
        scale: f64,
    ) {
        assert_eq!(found.len(), expected.len(), "{what}, {place}: lengths");
        let largest = expected.iter().fold(scale, |largest, x| largest.max(x.abs()));
        let difference = |(a, b): (&f64, &f64)| {
            let difference = (a - b).abs();
            if difference.is_nan() { f64::INFINITY } else { difference }
        };
        let error = found.iter().zip(expected).map(difference).fold(0.0, f64::max) / largest;
        self.note(what, place, error);
    }

    /// Panics if an error exceeds the limit for its name.
    pub(crate) fn check(&self, limit: impl Fn(&str) -> f64) {
        assert!(!self.errors.is_empty(), "nothing was compared");
        for (what, (error, place)) in &self.errors {
            println!("{what}: {error:.1e} ({place})");
        }
        for (what, (error, place)) in &self.errors {
            let limit = limit(what);
            assert!(*error <= limit, "{what}: {error:e} exceeds {limit:e}, first at {place}");
        }
    }
}

/// A random mechanism in a random state; its name contains the seed.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) recipe: Recipe,
    pub(crate) mechanism: Mechanism,
    pub(crate) state: State,
}

/// Chains and trees with 1 to 12 joints; every third has shared coordinates, fixed links, rotors and friction.
pub(crate) fn cases(count: u64) -> impl Iterator<Item = Case> {
    (0..count).map(|seed| {
        let every = seed % 3 == 2;
        let recipe = Recipe {
            joints: 1 + seed as usize % 12,
            branching: seed / 12 % 2 == 1,
            mimic: every,
            fixed: every,
            drives: every,
        };
        let mut random = Random::new(seed);
        let mechanism = random.mechanism(&recipe);
        let state = random.state(&mechanism);
        Case { name: format!("seed {seed}"), recipe, mechanism, state }
    })
}

/// The derivative at 0 of a vector-valued function of a scalar, by central differences of order 8. For motions of a few
/// rad/s, their truncation error with this step is far below the rounding error.
pub(crate) fn derivative(f: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    const STEP: f64 = 1.0 / 128.0;
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let mut sum = vec![0.0; f(0.0).len()];
    for (index, weight) in WEIGHTS.into_iter().enumerate() {
        let distance = STEP * (index + 1) as f64;
        for ((sum, after), before) in sum.iter_mut().zip(f(distance)).zip(f(-distance)) {
            *sum += weight * (after - before) / STEP;
        }
    }
    sum
}

/// The numbers plus `distance` times the direction.
pub(crate) fn moved(numbers: &[f64], direction: &[f64], distance: f64) -> Vec<f64> {
    numbers.iter().zip(direction).map(|(x, d)| x + d * distance).collect()
}

/// The numbers, with `distance` added to the number at `index`.
pub(crate) fn nudged(numbers: &[f64], index: usize, distance: f64) -> Vec<f64> {
    let mut numbers = numbers.to_vec();
    numbers[index] += distance;
    numbers
}

/// The elements of a matrix, row by row.
pub(crate) fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}
