//! Long inputs of `eval` and `torques`: how much is in memory, and what remains after an error near the end.

use std::fs;
use std::io::{Read, Write};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use crate::{complaint, folder, output, output_beside_files, robot, run, run_with};

/// The numbers of lines that have been read and printed.
#[derive(Default)]
struct Lines {
    read: AtomicUsize,
    printed: AtomicUsize,
    /// The largest number of lines that were read but not yet printed.
    behind: AtomicUsize,
}

/// A header and lines of states, which are made when they are read.
struct States<'l> {
    lines: &'l Lines,
    count: usize,
    waiting: Vec<u8>,
}

impl Read for States<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let read = self.lines.read.load(Relaxed);
        if self.waiting.is_empty() && read <= self.count {
            self.waiting = match read {
                0 => b"q1,q2\n".to_vec(),
                _ => format!("0.{read},-1.{read}\n").into_bytes(),
            };
            self.lines.read.store(read + 1, Relaxed);
            let behind = (read + 1).saturating_sub(self.lines.printed.load(Relaxed));
            self.lines.behind.fetch_max(behind, Relaxed);
        }
        let length = self.waiting.len().min(buffer.len());
        buffer[..length].copy_from_slice(&self.waiting[..length]);
        self.waiting.drain(..length);
        Ok(length)
    }
}

/// A writer that only counts lines.
struct Printed<'l>(&'l Lines);

impl Write for Printed<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let lines = bytes.iter().filter(|byte| **byte == b'\n').count();
        self.0.printed.fetch_add(lines, Relaxed);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn few_states_are_in_memory() {
    let (lines, count) = (Lines::default(), 60_000);
    let (file, mut errors) = (robot("planar_2r"), vec![]);
    let arguments = [
        "robot-symbolic",
        "eval",
        &file,
        "--function",
        "gravity",
        "--states",
        "-",
        "--format",
        "csv",
    ];
    let mut terminal = robot_cli::Terminal {
        input: &mut States { lines: &lines, count, waiting: vec![] },
        output: &mut Printed(&lines),
        errors: &mut errors,
        colors: false,
        progress: false,
        screen: None,
    };
    assert_eq!(robot_cli::run(arguments, &mut terminal), 0);
    assert_eq!((lines.read.load(Relaxed), lines.printed.load(Relaxed)), (count + 1, count + 1));
    // At most a block of states, 64 KiB of input and 64 KiB of output are in memory.
    assert!(lines.behind.load(Relaxed) < 8000, "{}", lines.behind.load(Relaxed));
}

/// Many states, of which the last is invalid.
fn wrong_at_the_end() -> String {
    let states: String = (1..9000).map(|number| format!("{number}e-3,2\n")).collect();
    format!("q1,q2\n{states}1,x\n")
}

#[test]
fn an_error_near_the_end_leaves_no_file() {
    let (folder, file) = (folder("streams-errors"), robot("planar_2r"));
    let (states, path) = (folder.join("states.csv"), folder.join("torques.csv"));
    fs::write(&states, wrong_at_the_end()).unwrap();
    let (states, path) = (states.to_str().unwrap(), path.to_str().unwrap());
    let eval = ["eval", &file, "--function", "gravity", "--format", "csv", "--states", states];
    let shown = complaint(1, &[&eval[..], &["-o", path]].concat(), "");
    assert_eq!(shown, format!("error: {states}: line 9001: `q2` is `x`, not a number\n"));
    let times = |last: &str| {
        let lines: String = (0..3000).map(|row| format!("{row},0.1,{row}e-4,0,1,0,1\n")).collect();
        format!("t,q1,q2,qd1,qd2,qdd1,qdd2\n{lines}{last}")
    };
    for (last, message) in [
        ("3000,1,2,3,4,5,x\n", "line 3002: `qdd2` is `x`, not a number"),
        ("3000,1\n7,2\n", "line 3002: 2 entries, but the header has 7"),
        ("2999,1,2,3,4,5,6\n", "the time does not increase at row 3001 below the header"),
        ("3000,1,2e9,3,4,5,6\n", "at t = 3000 s torques do not have finite values"),
    ] {
        fs::write(states, times(last)).unwrap();
        let shown = complaint(1, &["torques", &file, "--trajectory", states, "-o", path], "");
        assert!(shown.contains(message), "{shown}");
    }
    let names = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.collect::<Vec<_>>(), ["states.csv"]);
}

/// Standard output has the results before the error, in complete lines except for the last, and the exit code shows
/// that it is incomplete.
#[test]
fn an_error_near_the_end_is_told_after_the_output() {
    let file = robot("planar_2r");
    let eval = ["eval", &file, "--function", "gravity", "--format", "csv", "--states", "-"];
    let (wrong, right) = (wrong_at_the_end(), wrong_at_the_end().replace("1,x\n", ""));
    let (found, whole) = (run_with(&eval, wrong.as_bytes()), output(&eval, &right));
    assert_eq!(found.code, 1);
    assert_eq!(found.errors, "error: standard input: line 9001: `q2` is `x`, not a number\n");
    assert!(found.output.len() > 100_000 && found.output.len() < whole.len());
    assert!(whole.starts_with(&found.output));
    // Short output is printed completely or not at all.
    complaint(1, &eval, "q1,q2\n1,2\n3,x\n");
}

#[test]
fn a_file_has_what_standard_output_has() {
    let (folder, file) = (folder("streams-files"), robot("planar_2r"));
    let path = folder.join("gravity");
    let eval = ["eval", &file, "--function", "gravity", "--q", "1,2"];
    let into = [&eval[..], &["-o", path.to_str().unwrap()]].concat();
    for format in ["json", "csv"] {
        let format = ["--format", format];
        let printed = output(&[&eval[..], &format].concat(), "");
        fs::write(&path, "").unwrap();
        assert_eq!(output_beside_files(&[&into[..], &format].concat()), "");
        assert_eq!(fs::read_to_string(&path).unwrap(), printed);
        // A file with the same contents is not written again; another file with this name is not replaced.
        assert_eq!(output(&[&into[..], &format].concat(), ""), "");
        fs::write(&path, "mine").unwrap();
        let shown = complaint(1, &[&into[..], &format].concat(), "");
        assert!(shown.contains("is not replaced") && shown.contains("--force"), "{shown}");
        output_beside_files(&[&into[..], &format, &["--force"]].concat());
        assert_eq!(fs::read_to_string(&path).unwrap(), printed);
    }
    let states = ["--states", path.to_str().unwrap()];
    let shown = run(&[&eval[..4], &states, &["--force", "-o", states[1]]].concat());
    assert!(shown.code == 1 && shown.errors.contains("input"), "{}", shown.errors);
}

/// JSON and CSV have different printers.
#[test]
fn numbers_keep_their_bytes() {
    let file = robot("planar_2r");
    let states = "q1,q2\n0.1,0.2\n1.000007629394531,-3\n";
    for (format, expected) in [
        (
            "csv",
            "tau1,tau2\n64.93167088756252,11.246221149986633\n24.25286563305094,-4.8987988927492525\n",
        ),
        (
            "json",
            "[\n{\"tau\":[64.93167088756252,11.246221149986633]},\n\
             {\"tau\":[24.25286563305094,-4.8987988927492525]}\n]\n",
        ),
    ] {
        let eval = ["eval", &file, "--function", "gravity", "--states", "-", "--format", format];
        assert_eq!(output(&eval, states), expected);
    }
}

/// An empty selection of a log is a file with a header, and so is what is computed for it.
#[test]
fn no_states_have_a_header_and_a_note() {
    let file = robot("planar_2r");
    let note = "note: standard input has no states\n";
    for (format, output) in [("csv", "tau1,tau2\n"), ("json", "[]\n")] {
        let eval = ["eval", &file, "--function", "gravity", "--states", "-", "--format", format];
        for states in ["q1,q2\n", "[]"] {
            let done = run_with(&eval, states.as_bytes());
            assert_eq!((done.code, done.output.as_str(), done.errors.as_str()), (0, output, note));
        }
    }
}

/// Such a file does not hide what the function lacks.
#[test]
fn a_header_is_checked_without_states() {
    let arguments = ["eval", &robot("planar_2r"), "--function", "bias", "--states", "-"];
    let expected = "error: standard input: the header: `qd` is missing; bias needs it\n";
    assert_eq!(complaint(1, &arguments, "q1,q2\n"), expected);
}

/// The output of `simulate` is a file of states: its time and energies are not inputs of functions.
#[test]
fn a_simulated_motion_is_a_file_of_states() {
    let (folder, file) = (folder("streams-motion"), robot("planar_2r"));
    let motion = folder.join("motion.csv");
    let path = motion.to_str().unwrap();
    let simulated = ["simulate", &file, "--q0", "1,0.5", "--time", "0.05", "-o", path];
    assert_eq!(run_with(&simulated, b"").code, 0);
    let arguments = ["eval", &file, "--function", "regressor_base", "--states", path];
    let done = run_with(&arguments, b"");
    assert_eq!((done.code, done.output.matches("regressor").count()), (0, 6), "{}", done.errors);
    let misspelled = ["eval", &file, "--function", "gravity", "--states", "-"];
    assert!(run_with(&misspelled, b"t,q1,q3\n0,0,0\n").errors.contains("unknown column `q3`"));
}

/// A wrench at the last of many states determines the function for all of them, from a file and from a stream.
#[test]
fn a_wrench_at_the_end_counts_for_all() {
    let (folder, file) = (folder("streams-wrench"), robot("planar_2r"));
    let path = folder.join("states.csv");
    let line = "1,2,0,0,0,0,0,0\n";
    let states = format!("q1,q2,qd1,qd2,qdd1,qdd2,fx,fy,fz,mx,my,mz\n{}", {
        let still = format!("{},0,0,0,0\n", line.trim_end());
        format!("{}1,2,0,0,0,0,0,5,0,0,0,0\n", still.repeat(20_000))
    });
    fs::write(&path, &states).unwrap();
    let eval = |function: &'static str, states: &'static str| {
        ["eval", &file, "--function", function, "--format", "csv", "--states", states]
            .map(str::to_owned)
    };
    let called = |arguments: [String; 8]| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        output(&arguments, &states)
    };
    let stream = called(eval("inverse_dynamics", "-"));
    assert_eq!(stream, called(eval("inverse_dynamics_wrench", "-")));
    let mut of_file = eval("inverse_dynamics", "");
    of_file[7] = path.to_str().unwrap().to_owned();
    assert_eq!(stream, called(of_file));
    let lines: Vec<&str> = stream.lines().collect();
    assert_eq!((lines.len(), lines[1]), (20_002, lines[20_000]));
    assert_ne!(lines[1], lines[20_001]);
}

/// A trajectory that is computed in parts has the results of the whole.
#[test]
fn a_trajectory_in_parts_is_the_whole() {
    let (folder, file) = (folder("streams-parts"), robot("planar_2r"));
    let path = folder.join("motion.csv");
    let path = path.to_str().unwrap();
    output_beside_files(&[
        "simulate", &file, "--q0", "1,0.5", "--time", "3", "--step", "1e-3", "-o", path,
    ]);
    let motion = fs::read_to_string(path).unwrap();
    let (header, lines) = motion.split_once('\n').unwrap();
    let lines: Vec<&str> = lines.lines().collect();
    assert_eq!(lines.len(), 3001);
    let torques = ["torques", &file, "--trajectory", "-"];
    let whole = output(&torques, &motion);
    let mut parts = String::new();
    for part in lines.chunks(700) {
        let text = output(&torques, &format!("{header}\n{}\n", part.join("\n")));
        let rows = if parts.is_empty() { &text[..] } else { text.split_once('\n').unwrap().1 };
        parts.push_str(rows);
    }
    assert!(whole == parts, "{} bytes, {} in parts", whole.len(), parts.len());
}
