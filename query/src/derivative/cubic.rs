//! Derivatives of sampled positions: polynomials are fitted to the samples around each sample (A. Savitzky, M. J.
//! E. Golay, 1964), at the actual times.

use nalgebra::{Matrix4, Vector4};

/// The minimum number of samples for a cubic.
pub(super) const LEAST: usize = 4;

/// The samples of an episode, in the order of their times.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Samples {
    /// The times, s.
    pub(crate) times: Vec<f64>,
    /// The positions: a column for each joint.
    pub(crate) positions: Vec<Vec<f64>>,
}

/// Returns the first and the second derivative of every column, by cubics over windows of the given number of
/// samples. At the ends, the first and the last whole window are used.
pub(crate) fn derivatives(samples: &Samples, window: usize) -> [Vec<Vec<f64>>; 2] {
    let count = samples.times.len();
    let window = window.min(count);
    let mut found = [(); 2].map(|()| vec![vec![0.0; count]; samples.positions.len()]);
    if window < LEAST {
        // There are too few samples for a cubic, so the derivatives are unknown.
        return found.map(|columns| columns.iter().map(|_| vec![f64::NAN; count]).collect());
    }
    for row in 0..count {
        let first = row.saturating_sub(window / 2).min(count - window);
        let range = first..first + window;
        let times = &samples.times[range.clone()];
        let middle = samples.times[row];
        let width = (times[window - 1] - times[0]) / 2.0;
        let powers: Vec<Vector4<f64>> = times
            .iter()
            .map(|time| (time - middle) / width)
            .map(|x| Vector4::new(1.0, x, x * x, x * x * x))
            .collect();
        let gram: Matrix4<f64> = powers.iter().map(|powers| powers * powers.transpose()).sum();
        let Some(root) = gram.cholesky() else {
            found.iter_mut().flatten().for_each(|column| column[row] = f64::NAN);
            continue;
        };
        for (joint, positions) in samples.positions.iter().enumerate() {
            let pairs = powers.iter().zip(&positions[range.clone()]);
            let moments: Vector4<f64> = pairs.map(|(powers, position)| powers * *position).sum();
            let fitted = root.solve(&moments);
            found[0][joint][row] = fitted[1] / width;
            found[1][joint][row] = 2.0 * fitted[2] / (width * width);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_exact_at_uneven_times_and_at_the_ends() {
        let times: Vec<f64> =
            (0..40).map(|i| 0.01 * f64::from(i) + 0.002 * f64::from(i % 3)).collect();
        let cubic = |t: f64| 1.0 - 2.0 * t + 3.0 * t * t - 4.0 * t * t * t;
        let positions = vec![times.iter().map(|t| cubic(*t)).collect()];
        let [first, second] = derivatives(&Samples { times: times.clone(), positions }, 11);
        for (row, t) in times.iter().enumerate() {
            assert!((first[0][row] - (-2.0 + 6.0 * t - 12.0 * t * t)).abs() < 1e-9);
            assert!((second[0][row] - (6.0 - 24.0 * t)).abs() < 1e-6, "{row}: {}", second[0][row]);
        }
    }

    #[test]
    fn too_few_samples_have_no_derivative() {
        let samples = Samples { times: vec![0.0, 1.0, 2.0], positions: vec![vec![0.0; 3]] };
        assert!(derivatives(&samples, 5).iter().flatten().flatten().all(|value| value.is_nan()));
    }
}
