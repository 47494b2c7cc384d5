//! Tests the conversion of recordings to logs.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{
    ArrayRef, AsArray, FixedSizeListArray, Float32Array, Int64Array, RecordBatch,
};
use datafusion::arrow::datatypes::{DataType, Field, Float64Type};
use datafusion::parquet::arrow::ArrowWriter;
use robot_query::convert::{Conversion, Converted, convert};
use robot_query::{Error, Robots};

use super::support::{robot, rows};

const STEP: f64 = 0.01;

fn usual() -> Conversion {
    Conversion { window: 11, topic: None, joints: None, degrees: false, tau: None }
}

/// The motion of a joint: its position, velocity and acceleration.
fn motion(joint: usize, time: f64) -> [f64; 3] {
    let rate = 1.0 + joint as f64;
    let (s, c) = (rate * time).sin_cos();
    [s, rate * c, -rate * rate * s]
}

/// A message with the joints of the planar arm, the second joint first.
fn message(row: usize, time: f64) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    let nanoseconds = (time * 1e9).round() as u64 + 5_000_000_000;
    bytes.extend(((nanoseconds / 1_000_000_000) as i32).to_le_bytes());
    bytes.extend(((nanoseconds % 1_000_000_000) as u32).to_le_bytes());
    let pad = |bytes: &mut Vec<u8>, size: usize| {
        let end = (bytes.len() - 4).next_multiple_of(size) + 4;
        bytes.resize(end, 0);
    };
    let text = |bytes: &mut Vec<u8>, text: &str| {
        pad(bytes, 4);
        bytes.extend((text.len() as u32 + 1).to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes.push(0);
    };
    text(&mut bytes, "base");
    pad(&mut bytes, 4);
    bytes.extend(2_u32.to_le_bytes());
    ["2", "1"].iter().for_each(|name| text(&mut bytes, name));
    let position = [motion(1, time)[0], motion(0, time)[0]];
    for values in [&position[..], &[], &[row as f64, -(row as f64)]] {
        pad(&mut bytes, 4);
        bytes.extend((values.len() as u32).to_le_bytes());
        for value in values {
            pad(&mut bytes, 8);
            bytes.extend(value.to_le_bytes());
        }
    }
    bytes
}

/// Writes a recording with messages at the given times, in chunks without compression.
fn recording(path: &Path, times: &[f64]) {
    compressed(path, times, None);
}

/// Writes a recording with messages at these times, in chunks that are compressed.
fn compressed(path: &Path, times: &[f64], compression: Option<mcap::Compression>) {
    let file = std::io::BufWriter::new(fs::File::create(path).unwrap());
    let options = mcap::WriteOptions::new().compression(compression).profile("ros2");
    let mut writer = options.create(file).unwrap();
    let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"").unwrap();
    let channel = writer.add_channel(schema, "/joint_states", "cdr", &BTreeMap::new()).unwrap();
    for (row, time) in times.iter().enumerate() {
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence: row as u32,
            log_time: row as u64,
            publish_time: row as u64,
        };
        writer.write_to_known_channel(&header, &message(row, *time)).unwrap();
    }
    writer.finish().unwrap();
}

fn converted(input: &Path, how: &Conversion, output: &Path) -> Result<Converted, Error> {
    let model = Robots::new().model(&robot("planar_2r")).unwrap();
    convert(&model, input, how, output)
}

/// The entries of a column of lists with two entries.
fn entries(batch: &RecordBatch, name: &str) -> Vec<f64> {
    let lists = batch.column_by_name(name).unwrap().as_fixed_size_list();
    lists.values().as_primitive::<Float64Type>().values().to_vec()
}

#[test]
fn a_recording_of_ros_is_a_log() {
    let folder = tempfile::TempDir::new().unwrap();
    let (input, output) = (folder.path().join("a.mcap"), folder.path().join("log.parquet"));
    let times: Vec<f64> = (0..500).map(|row| STEP * row as f64).collect();
    recording(&input, &times);
    let found = converted(&input, &usual(), &output).unwrap();
    assert_eq!(found, Converted { rows: 500, episodes: 1 });
    let log = rows(1, &[output], "SELECT * FROM log").unwrap();
    let [q, qd, qdd, tau] = ["q", "qd", "qdd", "tau"].map(|name| entries(&log, name));
    for (row, time) in times.iter().enumerate().skip(5).take(490) {
        for joint in 0..2 {
            let place = 2 * row + joint;
            let [position, velocity, acceleration] = motion(joint, *time);
            assert_eq!(q[place], position);
            assert!((qd[place] - velocity).abs() < 1e-3, "{row}");
            assert!((qdd[place] - acceleration).abs() < 0.03, "{row}");
        }
        // The message has the second joint first.
        assert_eq!([tau[2 * row], tau[2 * row + 1]], [-(row as f64), row as f64]);
    }
}

#[test]
fn compressed_recordings_give_the_same_log() {
    let folder = tempfile::TempDir::new().unwrap();
    let times: Vec<f64> = (0..500).map(|row| STEP * row as f64).collect();
    let kinds = [None, Some(mcap::Compression::Zstd), Some(mcap::Compression::Lz4)];
    let (sizes, logs): (Vec<u64>, Vec<RecordBatch>) = kinds
        .into_iter()
        .enumerate()
        .map(|(place, compression)| {
            let file = |suffix: &str| folder.path().join(format!("{place}.{suffix}"));
            compressed(&file("mcap"), &times, compression);
            converted(&file("mcap"), &usual(), &file("parquet")).unwrap();
            let size = fs::metadata(file("mcap")).unwrap().len();
            (size, rows(1, &[file("parquet")], "SELECT * FROM log").unwrap())
        })
        .unzip();
    assert!(sizes[1] < sizes[0] && sizes[2] < sizes[0], "{sizes:?}");
    assert_eq!(logs[1], logs[0]);
    assert_eq!(logs[2], logs[0]);
}

#[test]
fn times_that_repeat_and_joints_that_are_missing_are_named() {
    let folder = tempfile::TempDir::new().unwrap();
    let (input, output) = (folder.path().join("a.mcap"), folder.path().join("log.parquet"));
    recording(&input, &[0.0, 0.01, 0.01, 0.02]);
    let error = converted(&input, &usual(), &output).unwrap_err().to_string();
    assert!(error.contains("a.mcap, message 3: time 0.01 s occurs twice"), "{error}");
    recording(&input, &[0.0, 0.01, 0.02, 0.03]);
    let joints = Some(vec!["1".to_owned(), "elbow".to_owned()]);
    let how = Conversion { joints, ..usual() };
    let error = converted(&input, &how, &output).unwrap_err().to_string();
    assert!(error.contains("it has no joint `elbow`; it has 2, 1"), "{error}");
    let how = Conversion { topic: Some("/other".to_owned()), ..usual() };
    let error = converted(&input, &how, &output).unwrap_err().to_string();
    assert!(error.contains("topics with joint states are /joint_states"), "{error}");
    assert!(!output.exists());
    let bytes = fs::read(&input).unwrap();
    fs::write(&input, &bytes[..bytes.len() / 2]).unwrap();
    let error = converted(&input, &usual(), &output).unwrap_err().to_string();
    assert!(error.contains("a.mcap: it cannot be read"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "something was left");
}

/// A data set of two episodes, in degrees.
fn data_set(folder: &Path, version: &str) {
    fs::create_dir_all(folder.join("meta")).unwrap();
    fs::create_dir_all(folder.join("data/chunk-000")).unwrap();
    let info = format!(
        r#"{{"codebase_version": "{version}", "fps": 100, "features": {{"observation.state":
        {{"dtype": "float32", "shape": [3], "names": ["1.pos", "2.pos", "gripper.pos"]}}}}}}"#
    );
    fs::write(folder.join("meta/info.json"), info).unwrap();
    let frame = |row: usize| (row / 200, STEP * (row % 200) as f64);
    let state = (0..400).flat_map(|row| {
        let (_, time) = frame(row);
        [motion(0, time)[0].to_degrees() as f32, motion(1, time)[0].to_degrees() as f32, 7.0]
    });
    let field = Arc::new(Field::new_list_field(DataType::Float32, true));
    let values = Arc::new(Float32Array::from_iter_values(state));
    let state = Arc::new(FixedSizeListArray::try_new(field, 3, values, None).unwrap());
    let time = Float32Array::from_iter_values((0..400).map(|row| frame(row).1 as f32));
    let episode = Int64Array::from_iter_values((0..400).map(|row| frame(row).0 as i64));
    let columns: [(&str, ArrayRef); 3] = [
        ("observation.state", state),
        ("timestamp", Arc::new(time)),
        ("episode_index", Arc::new(episode)),
    ];
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let file = fs::File::create(folder.join("data/chunk-000/file-000.parquet")).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

#[test]
fn a_data_set_of_lerobot_is_a_log() {
    let folder = tempfile::TempDir::new().unwrap();
    let (input, output) = (folder.path().join("set"), folder.path().join("log.parquet"));
    data_set(&input, "v3.0");
    let how = Conversion { degrees: true, ..usual() };
    let found = converted(&input, &how, &output).unwrap();
    assert_eq!(found, Converted { rows: 400, episodes: 2 });
    let log = rows(1, &[output], "SELECT * FROM log").unwrap();
    let [q, qd] = ["q", "qd"].map(|name| entries(&log, name));
    for row in 0..400 {
        for joint in 0..2 {
            let [position, velocity, _] = motion(joint, STEP * (row % 200) as f64);
            assert!((q[2 * row + joint] - position).abs() < 1e-6, "{row}");
            // Windows do not extend into the other episode.
            assert!((qd[2 * row + joint] - velocity).abs() < 0.02, "{row} {joint}");
        }
    }
}

#[test]
fn data_sets_of_other_versions_are_refused() {
    let folder = tempfile::TempDir::new().unwrap();
    data_set(folder.path(), "v2.1");
    let output = folder.path().join("log.parquet");
    let error = converted(folder.path(), &usual(), &output).unwrap_err().to_string();
    assert!(error.contains("the data set has version v2.1"), "{error}");
}
