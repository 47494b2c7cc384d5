//! Tests columns with other names and units, and torques that are likely in another unit.

use std::path::Path;

use datafusion::arrow::array::{Array, AsArray};
use datafusion::arrow::datatypes::{DataType, Field, Float64Type, Schema};
use robot_model::variable::JointVariable;
use robot_query::Robots;
use robot_query::identify::Estimate;
use robot_query::log::{Answer, Finding, Log, Names, check, write};
use tempfile::TempDir;

use super::support::{difference, files, generation, log, robot, rows, session};

/// The columns of positions that are found for names, or the error.
fn found(columns: &[&str], names: &[&str]) -> Result<Vec<String>, String> {
    let model = Robots::new().model(&robot("planar_2r")).unwrap();
    let fields = columns.iter().map(|name| Field::new(*name, DataType::Float64, true));
    let schema = Schema::new(fields.collect::<Vec<_>>());
    let given = names.iter().map(|name| (*name).to_owned()).collect();
    let names = Names { variables: [Some(given), None, None, None], ..Names::default() };
    let found = names.columns(&schema, &[JointVariable::Position], &model);
    let found = found.map_err(|error| error.to_string())?;
    Ok(found.iter().map(|expr| expr.qualified_name().1).collect())
}

#[test]
fn columns_of_any_names_are_found() {
    let columns = ["actual_q_0", "actual_q_1", "a b", "B", "pos/1", "pos/2", "n0", "n1", "n2"];
    assert_eq!(found(&columns, &["actual_q"]).unwrap(), ["actual_q_0", "actual_q_1"]);
    assert_eq!(found(&columns, &["a b", "B"]).unwrap(), ["a b", "B"]);
    // The joints are called 1 and 2.
    assert_eq!(found(&columns, &["pos/{}"]).unwrap(), ["pos/1", "pos/2"]);
    // The columns can be numbered from 0 or from 1.
    let error = found(&columns, &["n"]).unwrap_err();
    assert!(error.contains("n0 to n2, one more than planar_2r has joints"), "{error}");
    for (names, wanted) in [
        (vec!["p"], "no column `p` with a list, nor p1 to p2"),
        (vec!["p{}"], "the log has not the columns p1, p2"),
        (vec!["B", "c"], "the log has no column `c`"),
        (vec!["B", "n1", "n2"], "--q names 3 columns"),
    ] {
        let error = found(&columns, &names).unwrap_err();
        assert!(error.contains(wanted) && error.contains("actual_q_0"), "{error}");
    }
}

#[test]
fn factors_bring_columns_into_other_units() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 2000));
    let files = files(folder.path());
    let thousand = "make_array(1000, 1000, 1000, 1000, 1000, 1000)";
    let back = "make_array(0.001, 0.001, 0.001, 0.001, 0.001, 0.001)";
    let other =
        "scaled(make_array(1, 2, 3, 4, 5, 6), tau[1], tau[2], tau[3], tau[4], tau[5], tau[6])";
    let query = format!(
        "SELECT tau, scaled({back}, scaled({thousand}, tau)), {other}, \
         scaled({back}, CASE WHEN t = 0 THEN NULL ELSE tau END) FROM log"
    );
    let found = rows(1, &files, &query).unwrap();
    let entries = |column: usize| {
        let column = found.column(column);
        let lists = column.as_fixed_size_list_opt().map(|lists| lists.values().clone());
        let values = lists.unwrap_or_else(|| column.as_list::<i32>().values().clone());
        values.as_primitive::<Float64Type>().values().to_vec()
    };
    assert!(difference(&entries(1), &entries(0)) < 1e-15);
    for (place, (found, tau)) in entries(2).iter().zip(entries(0)).enumerate() {
        assert_eq!(*found, (place % 6 + 1) as f64 * tau);
    }
    // Two episodes begin at t = 0.
    assert_eq!(found.column(3).null_count(), 2);
    for (call, wanted) in [
        ("scaled(make_array(1, 2), tau)", "6 entries are given, but scaled with 2 factors needs 2"),
        ("scaled('x', tau)", "neither a number nor a list"),
    ] {
        let error = rows(1, &files, &format!("SELECT {call} FROM log")).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
}

/// The findings in a log of the UR5 whose columns are computed by a query over another log.
fn checked(folder: &Path, columns: &str, names: &Names) -> Vec<Finding> {
    let model = Robots::new().model(&robot("ur5")).unwrap();
    let changed = TempDir::new().unwrap();
    let path = changed.path().join("changed.parquet");
    tokio::runtime::Runtime::new().unwrap().block_on(async {
        let session = session(1);
        let log = Log::open(&[folder.to_owned()]).unwrap();
        let table = session.table(&log).await.unwrap();
        session.context.register_table("log", table.into_view()).unwrap();
        let table = session.context.sql(&format!("SELECT {columns} FROM log")).await.unwrap();
        write(table, &Answer::at(&path).unwrap(), None).await.unwrap();
    });
    check(&Log::open(&[path]).unwrap(), &model, names, None, None).unwrap()
}

fn times(factor: &str) -> String {
    format!("make_array({})", [factor; 6].join(", "))
}

#[test]
fn torques_in_another_unit_are_noticed_and_converted() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 5000));
    let folder = folder.path();
    let usual = Names::default();
    assert_eq!(checked(folder, "*", &usual), []);
    let scaled = |factor: &str| format!("q, qd, qdd, scaled({}, tau) AS tau", times(factor));
    // The noise of 0.5 N m hides the small torques of the wrist's last joints.
    let found = checked(folder, &scaled("1000"), &usual);
    assert!(found.len() >= 3, "{found:?}");
    assert!(found.iter().all(|one| one.what.contains("times those of the model")), "{found:?}");
    assert!(found[0].what.contains("`shoulder_pan_joint`"), "{found:?}");
    let converted = Names { tau_factor: vec![0.001], ..Names::default() };
    assert_eq!(checked(folder, &scaled("1000"), &converted), []);
    assert!(!checked(folder, &scaled("0.001"), &usual).is_empty());
    let found = checked(folder, &scaled("-1"), &usual);
    assert!(found[0].what.contains("are opposite to those of the model"), "{found:?}");
    for (factor, wanted) in [
        ("1000", Some("1.00")),
        ("0.001", Some("times those of the model")),
        ("-1", Some("opposite")),
        ("1", None),
    ] {
        let query = format!(
            "SELECT identify('{path}', q, qd, qdd, scaled({}, tau)) FROM log",
            times(factor)
        );
        let answer = rows(2, &files(folder), &query).unwrap();
        let estimate = Estimate::from_array(answer.column(0), 0).unwrap().unwrap();
        match (estimate.unit(), wanted) {
            (Some(said), Some(wanted)) => assert!(said.contains(wanted), "{factor}: {said}"),
            (said, wanted) => assert_eq!(said.as_deref(), wanted, "{factor}"),
        }
    }
    let converted = Names { tau_factor: vec![-1.0; 6], ..Names::default() };
    assert_eq!(checked(folder, &scaled("-1"), &converted), []);
    let wrong = Names { tau_factor: vec![1.0; 5], ..Names::default() };
    let model = Robots::new().model(&path).unwrap();
    let error = check(&Log::open(&files(folder)).unwrap(), &model, &wrong, None, None);
    assert!(error.unwrap_err().to_string().contains("--tau-factor has 5 numbers"));
}

#[test]
fn angles_in_degrees_are_noticed_and_converted() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 3000));
    let degrees = times(&format!("{:.17}", 1_f64.to_degrees()));
    let columns = ["q", "qd", "qdd"].map(|name| format!("scaled({degrees}, {name}) AS {name}"));
    let columns = format!("{}, tau", columns.join(", "));
    let found = checked(folder.path(), &columns, &Names::default());
    assert!(found.iter().any(|one| one.what.contains("is it in radians")), "{found:?}");
    let converted = Names { degrees: true, ..Names::default() };
    assert_eq!(checked(folder.path(), &columns, &converted), []);
}
