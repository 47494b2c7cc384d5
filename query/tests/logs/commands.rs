//! The command: what it refuses to write, and options that it refuses.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::support::{generation, log, robot};

fn command(folder: &Path, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_robot-query");
    Command::new(program).args(arguments).current_dir(folder).output().unwrap()
}

/// The message of a command that must fail.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = command(folder, arguments);
    assert!(!output.status.success(), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn files_that_exist_stay() {
    let robot = robot("planar_2r");
    let folder = log(&robot, &generation(&robot, 500));
    let own = tempfile::tempdir().unwrap();
    let mine = own.path().join("mine.csv");
    fs::write(&mine, "mine").unwrap();
    let path = mine.to_string_lossy().into_owned();
    for arguments in [
        &["torques", &robot, ".", "-o", &path][..],
        &["residual", &robot, ".", "-o", &path],
        &["residual", &robot, ".", "--plot", &path],
        &["identify", &robot, ".", "-o", &path],
        &["identify", &robot, ".", "--write-back", &path],
        &["excite", &robot, "-o", &path],
        &["sql", "SELECT 1", "-o", &path],
    ] {
        let output = command(folder.path(), arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains("it exists; remove it or choose another name"), "{message}");
        // The path is tried before the computation.
        assert!(output.stdout.is_empty() && !output.status.success(), "{arguments:?}");
        assert_eq!(fs::read_to_string(&mine).unwrap(), "mine");
    }
    let message = refused(folder.path(), &["excite", &robot, "-o", "/dev/null"]);
    assert!(message.contains("it is not a regular file"), "{message}");
}

#[test]
fn sql_only_reads() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("keep.csv"), "a\n1\n").unwrap();
    for query in [
        "COPY (SELECT 1) TO 'keep.csv'",
        "CREATE TABLE a AS SELECT 1",
        "CREATE EXTERNAL TABLE a STORED AS CSV LOCATION 'keep.csv'",
        "DROP TABLE a",
        "INSERT INTO 'keep.csv' VALUES (1)",
        "SET datafusion.execution.batch_size = 1",
    ] {
        let message = refused(folder.path(), &["sql", query]);
        assert!(message.contains("only queries that read can be run"), "{query}: {message}");
        assert_eq!(fs::read_to_string(folder.path().join("keep.csv")).unwrap(), "a\n1\n");
    }
    let output = command(folder.path(), &["sql", "SELECT a FROM 'keep.csv'"]);
    assert!(output.status.success() && String::from_utf8(output.stdout).unwrap().contains("| 1 |"));
}

#[test]
fn numbers_out_of_range_are_refused() {
    let robot = robot("planar_2r");
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &["generate", &robot, "--rows", "10", "--noise", "-1", "-o", "log"][..],
        &["generate", &robot, "--rows", "-5", "-o", "log"],
        &["generate", &robot, "--rows", "10", "--noise", "nan", "-o", "log"],
        &["identify", &robot, ".", "--noise", "nan"],
        &["identify", &robot, ".", "--noise", "0"],
        &["identify", &robot, ".", "--ridge", "-1"],
        &["excite", &robot, "--noise", "1,inf", "-o", "e.csv"],
        &["sql", "SELECT 1", "--threads", "0"],
        &["sql", "SELECT 1", "--memory", "0"],
    ] {
        let message = refused(folder.path(), arguments);
        assert!(message.contains("error: invalid value"), "{message}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

#[test]
fn paths_that_cannot_be_used_are_named_as_they_were_given() {
    let robot = robot("planar_2r");
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "mine").unwrap();
    for (arguments, wanted) in [
        (
            &["sql", "SELECT 1", "-o", "nowhere/a.csv"][..],
            "error: nowhere: there is no such folder; make it first\n",
        ),
        (
            &["generate", &robot, "--rows", "10", "-o", "file"],
            "error: file: it is not a folder; choose another name\n",
        ),
        (
            &["torques", &robot, "nowhere", "-o", "a.csv"],
            "error: nowhere: there is no such file or folder\n",
        ),
    ] {
        assert_eq!(refused(folder.path(), arguments), wanted);
        assert_eq!(fs::read_to_string(folder.path().join("file")).unwrap(), "mine");
    }
}

#[test]
fn a_check_without_times_says_so() {
    let robot = robot("planar_2r");
    let folder = log(&robot, &generation(&robot, 100));
    let message = |arguments: &[&str]| {
        let output = command(folder.path(), &[&["check", &robot, "."], arguments].concat());
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(message(&[]), "times are not checked; --time names their column\n");
    assert_eq!(message(&["--time", "t", "--episode", "episode"]), "");
}

#[test]
fn a_column_that_the_log_lacks_is_named() {
    let robot = robot("planar_2r");
    let folder = log(&robot, &generation(&robot, 100));
    let message =
        refused(folder.path(), &["torques", &robot, ".", "--columns", "t,nope", "-o", "t.csv"]);
    assert!(
        message.contains("the log has no column `nope`; its columns are episode, t,"),
        "{message}"
    );
}
