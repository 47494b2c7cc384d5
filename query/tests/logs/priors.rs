//! Tests identification with priors.

use robot_query::Robots;
use robot_query::identify::Estimate;

use super::support::{difference, files, generation, identified, log, robot};

fn place(found: &Estimate, name: &str) -> usize {
    found.names.iter().position(|other| other == name).unwrap()
}

#[test]
fn a_ridge_moves_estimates_towards_the_robot_file() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 2000));
    let files = files(folder.path());
    let free = identified(1, &files, &path, ", 0.5").unwrap();
    assert_eq!(identified(1, &files, &path, ", 0.5, 'ridge=0'").unwrap(), free);
    // The distance that a ridge minimizes: each parameter is multiplied by the length of its column.
    let count = free.names.len();
    let mut squares = vec![0.0; count];
    let mut packed = free.triangle.iter();
    for row in 0..=count {
        for (column, entry) in (row..=count).zip(packed.by_ref()) {
            if let Some(square) = squares.get_mut(column) {
                *square += entry * entry;
            }
        }
    }
    let distance = |found: &Estimate| {
        let pairs = found.values.iter().zip(&found.nominal).zip(&squares);
        pairs.map(|((value, nominal), square)| (value - nominal).powi(2) * square).sum::<f64>()
    };
    let mut last = distance(&free);
    for ridge in ["0.01", "1", "100"] {
        let found = identified(1, &files, &path, &format!(", 0.5, 'ridge={ridge}'")).unwrap();
        let now = distance(&found);
        assert!(now < last, "{ridge}: {now} {last}");
        last = now;
        for (one, other) in found.deviations.iter().zip(&free.deviations) {
            assert!(one.unwrap() < other.unwrap());
        }
    }
    // The largest eigenvalue of 36 columns of length 1 is at most 36, hence (36/136)².
    assert!(last < 0.071 * distance(&free), "{last}");
}

#[test]
fn a_known_parameter_is_weighed_as_a_measurement() {
    // The formulas are those of one dimension: the estimate with a prior is that with one more row.
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 2000));
    let files = files(folder.path());
    let free = identified(1, &files, &path, ", 0.5").unwrap();
    let name = "ZZR_2";
    let place = place(&free, name);
    let (value, deviation) = (free.values[place], free.deviations[place].unwrap());
    // The prior is as accurate as the measurement and five deviations away, so the estimate is the mean of both.
    let told = value + 5.0 * deviation;
    let more = format!(", 0.5, '{name}={told}:{}'", deviation / free.scale);
    let found = identified(1, &files, &path, &more).unwrap();
    let moved = (found.values[place] - value) / deviation;
    assert!((moved - 2.5).abs() < 1e-6, "{moved}");
    // The residuals increase: χ² grows by 25/2 in 12000, and the scale with it.
    let ratio = found.deviations[place].unwrap() / deviation * free.scale / found.scale;
    assert!((ratio - 0.5_f64.sqrt()).abs() < 1e-9, "{ratio}");
    // The result does not depend on the partitioning.
    let again = identified(3, &files, &path, &more).unwrap();
    assert!(difference(&again.values, &found.values) < 1e-12);
}

#[test]
fn a_fixed_parameter_keeps_its_value() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 2000));
    let files = files(folder.path());
    let found = identified(2, &files, &path, ", 'ZZR_2=1.25:0, MX_3=:0'").unwrap();
    let [zz, mx] = ["ZZR_2", "MX_3"].map(|name| place(&found, name));
    assert_eq!(found.fixed, ["ZZR_2", "MX_3"]);
    assert_eq!((found.values[zz], found.deviations[zz]), (1.25, None));
    assert_eq!((found.values[mx], found.deviations[mx]), (found.nominal[mx], None));
    assert_eq!((found.rank, found.unidentifiable.len()), (34, 0));
    let free = identified(1, &files, &path, "").unwrap();
    let worse = found.joints[1].rms > 1.01 * free.joints[1].rms;
    assert!(worse, "{:?} {:?}", found.joints[1], free.joints[1]);
    let model = Robots::new().model(&path).unwrap();
    let consistent = found.consistent(&model).unwrap();
    assert!(consistent.base.iter().all(|value| value.is_finite()));
}

#[test]
fn what_the_log_leaves_open_is_identified_by_what_is_known() {
    let path = robot("ur5");
    let mut how = generation(&path, 2000);
    for limits in &mut how.limits[1..] {
        limits.position = [0.5, 0.5];
    }
    let folder = log(&path, &how);
    let files = files(folder.path());
    let open = identified(1, &files, &path, "").unwrap();
    let name = open.unidentifiable[0].name.clone();
    let found = identified(1, &files, &path, &format!(", '{name}=0.3:0.001'")).unwrap();
    assert_eq!(found.rank, open.rank + 1);
    let place = place(&found, &name);
    assert!((found.values[place] - 0.3).abs() < 0.005, "{}", found.values[place]);
    assert!(found.deviations[place].unwrap() < 0.0011);
}

#[test]
fn wrong_words_are_refused() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 1000));
    let files = files(folder.path());
    for (words, wanted) in [
        ("ZZR_9=1:1", "`ZZR_9` is not a base parameter; the base parameters are ZZR_1"),
        ("ZZR_2=1:1, ZZR_2=2:1", "`ZZR_2` is named twice"),
        ("ridge=much", "`ridge=much`: a ridge is a number, 0 or more"),
        ("ZZR_2", "`ZZR_2` is not a prior"),
    ] {
        let error = identified(1, &files, &path, &format!(", '{words}'")).unwrap_err().to_string();
        assert!(error.contains(wanted), "{words}: {error}");
    }
}
