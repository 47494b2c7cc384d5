//! Tests results that are continued where an earlier run ended.

use std::fs;
use std::path::Path;

use robot_query::Error;
use robot_query::log::{Log, Question, Resumed, resume};
use tokio::runtime::Runtime;

use super::support::{files, generation, log, robot, session};

fn torques(log: &Log, folder: &Path, words: &str, limit: &str) -> Result<Resumed, Error> {
    let question = Question { words: words.to_owned(), filtered: false, threads: 2 };
    let path = robot("planar_2r");
    let query =
        format!("SELECT t, inverse_dynamics('{path}', q, qd, qdd) AS torque FROM log {limit}");
    Runtime::new().unwrap().block_on(async {
        resume(log, folder, &question, async |part| {
            let session = session(1);
            let table = session.table(&part).await?;
            session.context.register_table("log", table.into_view())?;
            Ok(session.context.sql(&query).await?)
        })
        .await
    })
}

#[test]
fn files_that_are_there_are_kept_and_the_others_computed() {
    let path = robot("planar_2r");
    let folder = log(&path, &generation(&path, 4000));
    let log = Log::open(&[folder.path().to_owned()]).unwrap();
    let answers = folder.path().join("answers");
    let found = torques(&log, &answers, "torques", "").unwrap();
    assert_eq!(found, Resumed { computed: 4000, kept: 0 });
    let bytes = |name: &str| fs::read(answers.join(name)).unwrap();
    let whole: Vec<Vec<u8>> =
        (0..4).map(|file| bytes(&format!("part-000{file}.parquet"))).collect();
    // An interrupted run: one file is missing, and one is incomplete.
    fs::remove_file(answers.join("part-0002.parquet")).unwrap();
    fs::write(answers.join("part-0002.parquet.incomplete"), "half").unwrap();
    let found = torques(&log, &answers, "torques", "").unwrap();
    assert_eq!(found, Resumed { computed: 1000, kept: 3000 });
    for (file, whole) in whole.iter().enumerate() {
        assert_eq!(&bytes(&format!("part-000{file}.parquet")), whole, "{file}");
    }
    assert_eq!(files(&answers).len(), 4);
}

#[test]
fn answers_to_other_questions_are_not_taken() {
    let path = robot("planar_2r");
    let folder = log(&path, &generation(&path, 4000));
    let logged = files(folder.path());
    let log = Log::open(&logged).unwrap();
    let answers = folder.path().join("answers");
    torques(&log, &answers, "torques", "").unwrap();
    let error = torques(&log, &answers, "torques of another robot", "").unwrap_err().to_string();
    assert!(error.contains("part-0000.parquet: it is the result of a different query"), "{error}");
    // The log has changed since: a file was replaced by another one of the same size.
    fs::copy(&logged[0], &logged[1]).unwrap();
    let error = torques(&log, &answers, "torques", "").unwrap_err().to_string();
    assert!(error.contains("part-0001.parquet: it is the result of a different query"), "{error}");
}

#[test]
fn an_answer_that_lacks_rows_is_not_kept() {
    let path = robot("planar_2r");
    let folder = log(&path, &generation(&path, 4000));
    let log = Log::open(&[folder.path().to_owned()]).unwrap();
    let answers = folder.path().join("answers");
    let error = torques(&log, &answers, "torques", "LIMIT 999").unwrap_err().to_string();
    assert!(error.contains("the result has 999 of the log's 1000 rows"), "{error}");
    assert_eq!(fs::read_dir(&answers).unwrap().count(), 0);
}
