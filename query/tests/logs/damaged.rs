//! Tests damaged logs: they yield messages with file and row group, and never numbers.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, FixedSizeListArray, Float64Array, RecordBatch};
use datafusion::arrow::datatypes::{DataType, Field};
use datafusion::parquet::arrow::ArrowWriter;
use datafusion::parquet::file::properties::WriterProperties;
use robot_model::variable::JointVariable;
use robot_query::Robots;
use robot_query::log::{Answer, Log, Names, check};

use super::support::{files, generation, identified, log, robot};

#[test]
fn a_truncated_file_is_named() {
    let path = robot("ur5");
    let folder = log(&path, &generation(&path, 4000));
    let file = files(folder.path())[2].clone();
    let bytes = fs::read(&file).unwrap();
    for length in [0, 3, bytes.len() / 2, bytes.len() - 1] {
        fs::write(&file, &bytes[..length]).unwrap();
        let error = Log::open(&[folder.path().to_owned()]).unwrap_err().to_string();
        assert!(error.contains("part-0002.parquet: it is not a whole Parquet file"), "{error}");
    }
}

#[test]
fn a_damaged_row_group_is_named() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("log.parquet");
    write(&path, 400, |_, _| 0.5);
    let mut bytes = fs::read(&path).unwrap();
    // The headers of pages in the third of four row groups are damaged.
    let place = bytes.len() / 2 + 100;
    let end = place + bytes.len() / 8;
    bytes[place..end].fill(0xff);
    fs::write(&path, bytes).unwrap();
    let log = Log::open(std::slice::from_ref(&path)).unwrap();
    assert!(identified(1, log.files(), &robot("planar_2r"), "").is_err());
    let fault = log.fault().unwrap().to_string();
    assert!(fault.contains("log.parquet, row group 2: it cannot be read"), "{fault}");
}

/// A log of the planar arm in row groups of 100 rows; a function defines the value of each variable in each row.
fn write(path: &Path, rows: usize, value: impl Fn(&str, usize) -> f64) {
    let field = Arc::new(Field::new_list_field(DataType::Float64, true));
    let list = |name: &str| -> ArrayRef {
        let values: Vec<f64> = (0..2 * rows).map(|place| value(name, place / 2)).collect();
        let values = Arc::new(Float64Array::from(values));
        Arc::new(FixedSizeListArray::try_new(field.clone(), 2, values, None).unwrap())
    };
    let time: ArrayRef =
        Arc::new(Float64Array::from_iter_values((0..rows).map(|row| value("t", row))));
    let columns = JointVariable::ALL.map(|variable| (variable.name(), list(variable.name())));
    let columns = std::iter::once(("t", time)).chain(columns);
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let properties = WriterProperties::builder()
        .set_max_row_group_row_count(Some(100))
        .set_dictionary_enabled(false)
        .build();
    let file = fs::File::create(path).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), Some(properties)).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

#[test]
fn likely_mistakes_are_found_with_their_rows() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("log.parquet");
    let value = |name: &str, row: usize| match (name, row) {
        ("t", 150) => 1.49,
        ("t", 250) => 0.0,
        ("tau", 310) => f64::NAN,
        ("q", 50) => 90.0,
        ("t", row) => 0.01 * row as f64,
        // The torques have the size of the model's.
        ("tau", _) => 30.0,
        _ => 0.5,
    };
    write(&path, 400, value);
    let model = Robots::new().model(&robot("planar_2r")).unwrap();
    let log = Log::open(&[path]).unwrap();
    let found = check(&log, &model, &Names::default(), Some("t"), None).unwrap();
    let found: Vec<String> = found.iter().map(ToString::to_string).collect();
    let wanted = [
        "row group 0: a position is beyond 10 turns: is it in radians (see --degrees)?, 1 rows, the first is row 50",
        "row group 1: the time equals that of the previous row, 1 rows, the first is row 150",
        "row group 2: the time is before that of the previous row, 1 rows, the first is row 250",
        "row group 3: a value is NaN or infinite, 1 rows, the first is row 310",
    ];
    assert_eq!(found.len(), wanted.len(), "{found:#?}");
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(found.ends_with(wanted), "{found}");
    }
}

#[test]
fn positions_beyond_the_limits_of_the_robot_are_found() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("log.parquet");
    let text = fs::read_to_string(robot("planar_2r")).unwrap();
    let limited = text.replacen("type = \"revolute\"", "type = \"revolute\", limits = [-1, 3]", 1);
    assert_ne!(text, limited);
    // Positions within 10 % of the range beyond the limits are accepted; 45 is in degrees.
    let value = |name: &str, row: usize| match (name, row) {
        ("q", 120) => 3.3,
        ("q", 130) => 45.0,
        ("tau", _) => 30.0,
        _ => 0.5,
    };
    write(&path, 400, value);
    let model = Robots::new().model(&limited).unwrap();
    let log = Log::open(&[path]).unwrap();
    let found = check(&log, &model, &Names::default(), None, None).unwrap();
    let found: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert_eq!(found.len(), 1, "{found:#?}");
    assert!(found[0].contains("beyond the limits of the robot file"), "{found:#?}");
    assert!(found[0].ends_with("1 rows, the first is row 130"), "{found:#?}");
}

#[test]
fn a_log_in_csv_is_said_to_be_none_that_is_checked() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("log.csv");
    fs::write(&path, "t,q1,q2\n0,1,2\n").unwrap();
    let model = Robots::new().model(&robot("planar_2r")).unwrap();
    let log = Log::open(&[path]).unwrap();
    let error = check(&log, &model, &Names::default(), None, None).unwrap_err().to_string();
    assert!(error.contains("log.csv: `check` reads Parquet files"), "{error}");
}

#[test]
fn files_of_other_columns_are_refused() {
    let folder = tempfile::TempDir::new().unwrap();
    write(&folder.path().join("a.parquet"), 10, |_, _| 0.5);
    let batch =
        RecordBatch::try_from_iter([("t", Arc::new(Float64Array::from(vec![0.0])) as ArrayRef)]);
    let batch = batch.unwrap();
    let file = fs::File::create(folder.path().join("b.parquet")).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    let error = Log::open(&[folder.path().to_owned()]).unwrap_err().to_string();
    assert!(error.contains("b.parquet: its columns are not those of"), "{error}");
}

#[test]
fn an_answer_replaces_nothing() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("answer.csv");
    fs::write(&path, "mine").unwrap();
    let answer = Answer::at(&path).unwrap();
    let runtime = tokio::runtime::Runtime::new().unwrap();
    let written = runtime.block_on(async {
        let table = super::support::session(1).context.sql("SELECT 1 AS one").await.unwrap();
        robot_query::log::write(table, &answer, None).await
    });
    assert!(written.unwrap_err().to_string().contains("it exists"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
}
