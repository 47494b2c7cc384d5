//! The streams of the real command.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use crate::{complaint, robot};

#[test]
fn the_process_reads_and_writes_its_streams() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
        .args(["eval", &robot("planar_2r"), "--function", "inverse_dynamics", "--states", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let state = br#"[{"q": [0, 0], "qd": [0, 0], "qdd": [0, 0]}]"#;
    child.stdin.take().unwrap().write_all(state).unwrap();
    let mut shown = String::new();
    child.stdout.take().unwrap().read_to_string(&mut shown).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(shown.starts_with("[\n{\"tau\":["), "{shown}");
}

/// What is written into the pipe of one's own input waits forever, and a file that is only read belongs to others.
#[cfg(target_os = "linux")]
#[test]
fn standard_input_is_no_output() {
    let folder = std::env::temp_dir().join(format!("robot_symbolic_input_{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let (link, notes) = (folder.join("code.rs"), folder.join("notes.txt"));
    std::os::unix::fs::symlink("/dev/stdin", &link).unwrap();
    std::fs::write(&notes, "notes").unwrap();
    let paths = ["/dev/stdin", "/dev/fd/0", "/proc/self/fd/0", "/proc/thread-self/fd/0"];
    for path in paths.into_iter().chain(link.to_str()) {
        for input in [Stdio::piped(), std::fs::File::open(&notes).unwrap().into()] {
            let child = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
                .args(["generate", &robot("panda"), "--function", "all", "-o", path])
                .stdin(input)
                .stdout(Stdio::piped())
                .stderr(Stdio::piped())
                .spawn()
                .unwrap();
            let output = child.wait_with_output().unwrap();
            let errors = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(1), "{path}: {errors}");
            assert!(errors.contains("a stream that is open for reading only"), "{errors}");
        }
    }
    assert_eq!(std::fs::read_to_string(&notes).unwrap(), "notes");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn exit_codes_tell_wrong_files_from_wrong_usage() {
    for (argument, code) in [("none.toml", 1), ("--nothing", 2)] {
        let output = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
            .args(["stats", argument])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(code));
        assert!(!output.stderr.is_empty());
    }
    let shown = complaint(2, &["generate", &robot("planar_2r"), "--runtime", "a b"], "");
    assert!(shown.contains("the runtime path `a b` is not a Rust path"), "{shown}");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
        .args(["generate", &robot("panda")])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut errors = String::new();
    child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    assert_eq!((child.wait().unwrap().code(), errors.as_str()), (Some(0), ""));
}
