//! Compares estimates with dense least squares, with the true parameters, and with themselves for other orders of
//! rows.

use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::Float64Type;
use nalgebra::{DMatrix, DVector};
use robot_query::identify::Estimate;
use robot_query::motion::Layout;

use super::support::{difference, files, generation, identified, log, robot, rows};

/// The stacked regressor and torques of a log.
fn stacked(folder: &std::path::Path, robot: &str, joints: usize) -> (DMatrix<f64>, DVector<f64>) {
    let query = format!("SELECT regressor_base('{robot}', q, qd, qdd), tau FROM log");
    let found = rows(1, &files(folder), &query).unwrap();
    let matrices = found.column(0).as_fixed_size_list();
    let entries = matrices.values().as_fixed_size_list().values().as_primitive::<Float64Type>();
    let count = found.num_rows() * joints;
    let regressor = DMatrix::from_row_slice(count, entries.len() / count, entries.values());
    let torques = found.column(1).as_fixed_size_list().values().as_primitive::<Float64Type>();
    (regressor, DVector::from_column_slice(torques.values()))
}

#[test]
fn the_estimate_is_that_of_dense_least_squares() {
    for name in ["ur5", "trttr1"] {
        let path = robot(name);
        let folder = log(&path, &generation(&path, 2000));
        let found = identified(2, &files(folder.path()), &path, ", 1.0").unwrap();
        let (regressor, torques) = stacked(folder.path(), &path, found.joints.len());
        let wanted = regressor.clone().svd(true, true).solve(&torques, 1e-12).unwrap();
        assert!(difference(&found.values, wanted.as_slice()) < 1e-9, "{name}");
        let left = &regressor * &wanted - &torques;
        let degrees = (regressor.nrows() - regressor.ncols()) as f64;
        let variance = left.norm_squared() / degrees;
        let covariance = (regressor.transpose() * &regressor).try_inverse().unwrap() * variance;
        assert!(difference(&found.covariance, covariance.as_slice()) < 1e-9, "{name}");
        assert!((found.scale - variance.sqrt()).abs() < 1e-9 * found.scale, "{name}");
        for (joint, residual) in found.joints.iter().enumerate() {
            let own = left.iter().skip(joint).step_by(found.joints.len());
            let mean = own.map(|one| one * one).sum::<f64>() / found.rows as f64;
            assert!((residual.rms - mean.sqrt()).abs() < 1e-9 * residual.rms, "{name}: {joint}");
        }
    }
}

#[test]
fn partitions_and_orders_give_the_same() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 20_000));
    let mut files = files(folder.path());
    let first = identified(1, &files, &path, "").unwrap();
    assert_eq!((first.rows, first.excluded, first.rank), (20_000, 0, 36));
    for threads in [1, 2, 3, 7] {
        files.rotate_left(1);
        files.swap(0, 2);
        let other = identified(threads, &files, &path, "").unwrap();
        let error = difference(&other.values, &first.values);
        assert!(error < 1e-12, "{threads} threads: {error}");
        let pairs = other.deviations.iter().zip(&first.deviations);
        for (other, first) in pairs.map(|(other, first)| (other.unwrap(), first.unwrap())) {
            assert!((other - first).abs() < 1e-10 * first);
        }
    }
}

/// The distance of an estimate from the true parameters in units of its covariance: χ² with one degree of freedom
/// for each parameter.
fn distance(estimate: &Estimate, truth: &[f64]) -> f64 {
    let count = truth.len();
    let covariance = DMatrix::from_column_slice(count, count, &estimate.covariance);
    let error = DVector::from_column_slice(&estimate.values) - DVector::from_column_slice(truth);
    error.dot(&covariance.cholesky().unwrap().solve(&error))
}

#[test]
fn the_truth_is_within_what_the_deviations_say() {
    let path = robot("ur5");
    let mut how = generation(&path, 20_000);
    how.noise = vec![2.0, 1.0, 0.5, 0.1, 0.05, 0.01];
    let mut all = 0.0;
    let mut beyond = 0;
    for seed in 0..8 {
        how.seed = seed;
        let folder = log(&path, &how);
        let found = identified(2, &files(folder.path()), &path, "").unwrap();
        let square = distance(&found, &found.nominal);
        // χ² with 36 degrees of freedom exceeds 85 with probability 10⁻⁵.
        assert!(square < 85.0, "seed {seed}: {square}");
        all += square;
        for place in 0..found.values.len() {
            let error = (found.values[place] - found.nominal[place]).abs();
            beyond += usize::from(error > 3.0 * found.deviations[place].unwrap());
        }
        for (joint, noise) in found.joints.iter().zip(&how.noise) {
            let estimated = joint.noise.unwrap();
            assert!((estimated / noise - 1.0).abs() < 0.05, "{}: {estimated}", joint.name);
        }
    }
    // χ² with 288 degrees of freedom has the standard deviation 24; 0.27 % of normal errors exceed three
    // deviations.
    assert!((all - 288.0).abs() < 5.0 * 24.0, "{all}");
    assert!(beyond <= 5, "{beyond} of 288");
}

#[test]
fn a_badly_conditioned_log_keeps_its_digits() {
    let path = robot("ur5");
    let mut how = generation(&path, 2000);
    // These are small motions about one position with exact torques, so the true values are known to all digits.
    for limits in &mut how.limits {
        limits.position = [0.3, 0.3 + 2e-3];
    }
    how.noise = vec![0.0; 6];
    let folder = log(&path, &how);
    let found = identified(1, &files(folder.path()), &path, ", 1.0").unwrap();
    let (regressor, torques) = stacked(folder.path(), &path, 6);
    let normal = regressor.transpose() * &regressor;
    let squared = normal.lu().solve(&(regressor.transpose() * torques)).unwrap();
    assert_eq!(found.rank, 36, "condition {}", found.condition);
    let by_triangle = difference(&found.values, &found.nominal);
    let by_normal = difference(squared.as_slice(), &found.nominal);
    println!(
        "condition {:.3e}: {by_triangle:.3e}, by normal equations {by_normal:.3e}",
        found.condition
    );
    assert!(found.condition > 1e6, "{}", found.condition);
    assert!(
        by_triangle * 1e4 < by_normal,
        "{by_triangle:.3e}, by normal equations {by_normal:.3e}"
    );
}

#[test]
fn what_does_not_move_is_not_identified() {
    let path = robot("ur5");
    let mut how = generation(&path, 4000);
    for limits in &mut how.limits[1..] {
        limits.position = [0.5, 0.5];
    }
    let folder = log(&path, &how);
    let found = identified(2, &files(folder.path()), &path, "").unwrap();
    assert!(found.rank < 36 && found.rank + found.unidentifiable.len() == 36, "{}", found.rank);
    for parameter in &found.unidentifiable {
        let place = found.names.iter().position(|name| *name == parameter.name).unwrap();
        assert_eq!(found.deviations[place], None);
        assert_eq!(found.values[place], found.nominal[place]);
        assert!(parameter.with.iter().all(|other| found.names.contains(other)), "{parameter:?}");
    }
    // The other parameters still explain the torques.
    for joint in &found.joints {
        assert!((joint.rms - 0.5).abs() < 0.03, "{joint:?}");
    }
}

#[test]
fn rows_that_are_no_measurements_are_left_out_and_counted() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 3000));
    let files = files(folder.path());
    let good = "CASE WHEN t = 0.05 THEN NULL ELSE qd END";
    let nan = "CASE WHEN t = 0.07 THEN make_array(0, 0, 'NaN'::double, 0, 0, 0) ELSE q END";
    let query = format!("SELECT identify('{path}', {nan}, {good}, qdd, tau) FROM log");
    let answer = rows(2, &files, &query).unwrap();
    let found = Estimate::from_array(answer.column(0), 0).unwrap().unwrap();
    // There are three episodes, with a row at each of two times.
    assert_eq!((found.rows, found.excluded), (2994, 6));
    let query = format!(
        "SELECT identify('{path}', q, qd, qdd, tau) FROM log WHERE t <> 0.05 AND t <> 0.07"
    );
    let answer = rows(2, &files, &query).unwrap();
    let wanted = Estimate::from_array(answer.column(0), 0).unwrap().unwrap();
    assert!(difference(&found.values, &wanted.values) < 1e-12);
}

#[test]
fn groups_and_columns_are_identified_by_themselves() {
    let path = robot("planar_2r");
    let mut how = generation(&path, 4000);
    how.layout = Layout::Columns;
    let folder = log(&path, &how);
    let files = files(folder.path());
    let arguments = "q_1, q_2, qd_1, qd_2, qdd_1, qdd_2, tau_1, tau_2";
    let query = format!(
        "SELECT episode, identify('{path}', {arguments}) FROM log GROUP BY episode ORDER BY episode"
    );
    let answer = rows(2, &files, &query).unwrap();
    assert_eq!(answer.num_rows(), 4);
    for episode in 0..4 {
        let found = Estimate::from_array(answer.column(1), episode).unwrap().unwrap();
        assert_eq!(found.rows, 1000);
        let query =
            format!("SELECT identify('{path}', {arguments}) FROM log WHERE episode = {episode}");
        let alone = rows(1, &files, &query).unwrap();
        let alone = Estimate::from_array(alone.column(0), 0).unwrap().unwrap();
        assert!(difference(&found.values, &alone.values) < 1e-12);
    }
}

#[test]
fn too_few_rows_are_refused() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 1000));
    let query = format!("SELECT identify('{path}', q, qd, qdd, tau) FROM log WHERE t < 0.03");
    let error = rows(1, &files(folder.path()), &query).unwrap_err().to_string();
    assert!(error.contains("3 usable rows of 6 joints do not determine 36 parameters"), "{error}");
}
