//! The window function `derivative`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use datafusion::arrow::array::{
    Array, ArrayRef, AsArray, FixedSizeListArray, Float64Array, Int64Array, ListArray, RecordBatch,
};
use datafusion::arrow::datatypes::{DataType, Field, Float64Type};
use datafusion::parquet::arrow::ArrowWriter;
use tempfile::TempDir;

use super::support::rows;

const STEP: f64 = 0.01;
const ROWS: usize = 200;

/// The rows of two episodes alternate, with later rows first. The positions of two joints are lists of both kinds
/// and a number.
fn recording(folder: &Path, time: impl Fn(usize) -> f64) -> PathBuf {
    let order: Vec<usize> = (0..2 * ROWS).rev().collect();
    let episode: ArrayRef =
        Arc::new(order.iter().map(|row| (row % 2) as i64).collect::<Int64Array>());
    let t: ArrayRef = Arc::new(order.iter().map(|row| time(row / 2)).collect::<Float64Array>());
    let position = |row: usize, joint: usize| {
        let phase = 1.0 + (row % 2) as f64;
        ((1.0 + joint as f64) * time(row / 2) + phase).sin()
    };
    let pairs: Vec<f64> =
        order.iter().flat_map(|row| [position(*row, 0), position(*row, 1)]).collect();
    let field = Arc::new(Field::new_list_field(DataType::Float64, true));
    let values: ArrayRef = Arc::new(Float64Array::from(pairs));
    let fixed: ArrayRef = Arc::new(FixedSizeListArray::try_new(field, 2, values, None).unwrap());
    let any = order.iter().map(|row| {
        // One row is null.
        (*row != 100).then(|| vec![Some(position(*row, 0)), Some(position(*row, 1))])
    });
    let any: ArrayRef = Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(any));
    let number: ArrayRef =
        Arc::new(order.iter().map(|row| position(*row, 1)).collect::<Float64Array>());
    let columns = [("episode", episode), ("t", t), ("q", fixed), ("any", any), ("number", number)];
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let path = folder.join("log.parquet");
    let file = std::fs::File::create(&path).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    path
}

fn asked(path: &Path, threads: usize, what: &str) -> Result<RecordBatch, robot_query::Error> {
    let over = "OVER (PARTITION BY episode ORDER BY t)";
    let query =
        format!("SELECT episode, t, derivative({what}) {over} AS d FROM log ORDER BY episode, t");
    rows(threads, &[path.to_owned()], &query)
}

#[test]
fn derivatives_of_lists_and_numbers_stay_within_their_episodes() {
    let folder = TempDir::new().unwrap();
    let path = recording(folder.path(), |row| STEP * row as f64);
    for threads in [1, 3] {
        for (what, order) in [("q, t, 1, 11", 1), ("q, t, 2, 11", 2)] {
            let answer = asked(&path, threads, what).unwrap();
            let times = answer.column(1).as_primitive::<Float64Type>().values();
            let lists = answer.column(2).as_fixed_size_list();
            let found = lists.values().as_primitive::<Float64Type>().values();
            for row in 0..2 * ROWS {
                for joint in 0..2 {
                    let rate = 1.0 + joint as f64;
                    let (s, c) = (rate * times[row] + 1.0 + (row / ROWS) as f64).sin_cos();
                    let (wanted, near) =
                        if order == 1 { (rate * c, 2e-3) } else { (-rate * rate * s, 0.2) };
                    let error = (found[2 * row + joint] - wanted).abs();
                    assert!(error < near, "{what}: row {row}, joint {joint}: {error}");
                }
            }
        }
    }
}

#[test]
fn numbers_have_the_derivatives_of_lists_and_nulls_have_none() {
    let folder = TempDir::new().unwrap();
    let path = recording(folder.path(), |row| STEP * row as f64);
    let lists = asked(&path, 1, "q, t, 1").unwrap();
    let lists = lists.column(2).as_fixed_size_list();
    let lists = lists.values().as_primitive::<Float64Type>().values().clone();
    let numbers = asked(&path, 1, "number, t, 1").unwrap();
    let numbers = numbers.column(2).as_primitive::<Float64Type>();
    assert_eq!(numbers.null_count(), 0);
    for row in 0..2 * ROWS {
        assert_eq!(numbers.value(row), lists[2 * row + 1]);
    }
    let any = asked(&path, 1, "any, t, 1").unwrap();
    let any = any.column(2).as_list::<i32>();
    assert_eq!((any.null_count(), any.is_null(50)), (1, true));
    let far = any.value(150);
    assert_eq!(far.as_primitive::<Float64Type>().values(), &lists[300..302]);
}

#[test]
fn calls_that_make_no_sense_are_refused() {
    let folder = TempDir::new().unwrap();
    let path = recording(folder.path(), |row| STEP * (row - row % 2) as f64);
    let error = asked(&path, 1, "q, t, 1").unwrap_err().to_string();
    assert!(error.contains("time 0 comes after time 0, and times must increase"), "{error}");
    for wrong in ["q, t, 3", "q, t", "q, t, 1, 3", "q, t, 1.5, x", "'q', t, 1"] {
        let error = asked(&path, 1, wrong).unwrap_err().to_string();
        let is_said = error.contains("derivative takes") || error.contains("No field named x");
        assert!(is_said, "{wrong}: {error}");
    }
    // Too few samples for a cubic are not an error: the derivatives are null.
    let query = "SELECT derivative(q, t, 1) OVER (PARTITION BY episode ORDER BY t) FROM log WHERE t < 0.001";
    let short = recording(folder.path(), |row| STEP * row as f64);
    let answer = rows(1, &[short], query).unwrap();
    assert_eq!((answer.num_rows(), answer.column(0).null_count()), (2, 2));
}
