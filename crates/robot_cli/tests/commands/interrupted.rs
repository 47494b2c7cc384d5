//! The state of output files if the command is killed, the disk is full, or the output is not a file.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::{folder, robot};

const BINARY: &str = env!("CARGO_BIN_EXE_robot-symbolic");

/// Waits for a process, for at most a minute.
fn ended(mut child: Child) -> Output {
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("the command hangs");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}

fn bash(folder: &Path, script: &str) -> Output {
    let child = Command::new("bash")
        .args(["-c", script, BINARY])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    ended(child.unwrap())
}

/// The files below a folder, with their contents.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push((path.clone(), fs::read(&path).unwrap()));
        }
    }
    found.sort();
    found
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_written_and_not_read() {
    let folder = folder("interrupted-pipes");
    fs::copy(robot("planar_2r"), folder.join("arm.toml")).unwrap();
    let shown = |script: &str| {
        let output = bash(&folder, script);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{script}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(shown("\"$0\" generate arm.toml -o /dev/stdout | cat").contains("pub mod"));
    assert!(shown("\"$0\" generate arm.toml -o >(cat) | cat; wait").contains("pub mod"));
    let script = "mkfifo pipe; cat pipe & \"$0\" generate arm.toml -o pipe; wait; test -p pipe";
    assert!(shown(script).contains("pub mod"));
    shown("for f in null zero; do \"$0\" generate arm.toml -o /dev/$f && test -c /dev/$f; done");
    // A file to which a stream is redirected is appended to, not replaced.
    shown("echo mine > log; \"$0\" generate arm.toml -o /dev/stdout >> log");
    assert!(fs::read_to_string(folder.join("log")).unwrap().starts_with("mine\n//"));
    shown("\"$0\" generate arm.toml -o /dev/stdout > new");
    assert!(fs::read_to_string(folder.join("new")).unwrap().starts_with("//"));
    for (code, script) in [
        (1, "\"$0\" generate arm.toml -o /dev/full"),
        (1, "\"$0\" simulate arm.toml --time 0.1 -o /dev/full"),
        (2, "\"$0\" generate arm.toml > /dev/full"),
        (2, "\"$0\" diff arm.toml arm.toml --states 1 > /dev/full"),
        (2, "\"$0\" --help > /dev/full"),
        (1, "\"$0\" generate arm.toml --check -o /dev/zero"),
        (1, "\"$0\" generate arm.toml -o ."),
    ] {
        let output = bash(&folder, &format!("ulimit -v 8000000; {script}"));
        assert_eq!(output.status.code(), Some(code), "{script}");
        assert!(output.stderr.starts_with(b"error: "), "{script}");
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_leaves_what_was_there() {
    let folder = folder("interrupted-full");
    fs::copy(robot("planar_2r"), folder.join("arm.toml")).unwrap();
    let prepare = "\"$0\" generate arm.toml -o arm.rs && \"$0\" crate arm.toml -o old";
    assert_eq!(bash(&folder, prepare).status.code(), Some(0));
    let before = files(&folder);
    for command in [
        "generate arm.toml --function all -o arm.rs",
        "crate arm.toml --function all -o old",
        "crate arm.toml --function all -o new",
        "generate arm.toml --function all -o below/new.rs",
        "simulate arm.toml --time 1 -o new.csv --plot new.svg",
    ] {
        let output = bash(&folder, &format!("trap '' XFSZ; ulimit -f 4; \"$0\" {command}"));
        assert_eq!(output.status.code(), Some(1), "{command}");
        assert!(output.stderr.starts_with(b"error: cannot write "), "{command}");
        assert_eq!(files(&folder), before, "{command}");
        assert!(!folder.join("new").exists() && !folder.join("below").exists(), "{command}");
    }
}

/// Pseudo-random numbers (splitmix64).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % bound
    }
}

/// A command that writes one of two versions of an output.
struct Killed {
    robot: PathBuf,
    command: &'static str,
    output: PathBuf,
    /// The complete output in both versions: its files, with relative paths.
    whole: [Vec<(PathBuf, Vec<u8>)>; 2],
    /// The time that the command takes.
    time: Duration,
}

impl Killed {
    fn new(folder: &Path, command: &'static str, output: &str) -> Killed {
        let file = folder.join("planar_2r.toml");
        // The plan is present, so that no plan is searched.
        for extension in ["toml", "plan"] {
            let from = PathBuf::from(robot("planar_2r")).with_extension(extension);
            fs::copy(from, file.with_extension(extension)).unwrap();
        }
        let whole = [vec![], vec![]];
        let output = folder.join(output);
        let mut killed = Killed { robot: file, command, output, whole, time: Duration::ZERO };
        for version in [0, 1] {
            let start = Instant::now();
            assert!(ended(killed.spawn(version)).status.success());
            killed.time = start.elapsed();
            killed.whole[version] = killed.present();
        }
        assert_ne!(killed.whole[0], killed.whole[1]);
        killed
    }

    fn spawn(&self, version: usize) -> Child {
        let mut command = Command::new(BINARY);
        command.arg(self.command).arg(&self.robot).arg("-o").arg(&self.output);
        command.args(["--scalar", ["f64", "f32"][version]]);
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    }

    fn remove(&self) {
        let _ = fs::remove_dir_all(&self.output).or_else(|_| fs::remove_file(&self.output));
    }

    /// The files of the output, without temporary ones.
    fn present(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let relative = |path: &Path| path.strip_prefix(&self.output).unwrap().to_owned();
        let found = match fs::metadata(&self.output) {
            Ok(metadata) if metadata.is_dir() => files(&self.output),
            Ok(_) => vec![(self.output.clone(), fs::read(&self.output).unwrap())],
            Err(_) => vec![],
        };
        let found = found.into_iter().map(|(path, bytes)| (relative(&path), bytes));
        found.filter(|(path, _)| !is_temporary(path)).collect()
    }

    /// Kills the command at a random time; returns whether it was still running.
    fn kill(&self, version: usize, random: &mut Random) -> bool {
        let limit = u64::try_from(self.time.as_micros()).unwrap() * 5 / 4;
        let mut child = self.spawn(version);
        std::thread::sleep(Duration::from_micros(random.below(limit)));
        child.kill().unwrap();
        child.wait().unwrap().code().is_none()
    }
}

fn is_temporary(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_str().unwrap();
    name.starts_with('.') && name.contains(".robot-symbolic-tmp-")
}

/// The number of rounds; the variable `ROBOT_KILL_ROUNDS` sets another.
fn rounds() -> u64 {
    std::env::var("ROBOT_KILL_ROUNDS").map_or(50, |rounds| rounds.parse().unwrap())
}

/// The states that were found after the kills.
#[derive(Default)]
struct Tally {
    killed: u64,
    old: u64,
    new: u64,
    mixed: u64,
    leftovers: u64,
}

/// Kills a command repeatedly; every file must be one of the two versions.
fn kill_again_and_again(test: &str, command: &'static str, output: &str, is_there: bool) {
    let (folder, seed) = (folder(test), u64::from(std::process::id()));
    let killed = Killed::new(&folder, command, output);
    let (mut random, mut tally) = (Random(seed), Tally::default());
    for round in 0..rounds() {
        // The old state is version 0, or nothing.
        killed.remove();
        if is_there {
            assert!(ended(killed.spawn(0)).status.success());
        }
        tally.killed += u64::from(killed.kill(1, &mut random));
        tally.leftovers += u64::from(files(&folder).iter().any(|(path, _)| {
            path.ancestors().any(|path| path.file_name().is_some() && is_temporary(path))
        }));
        let present = killed.present();
        let old: &[_] = if is_there { &killed.whole[0] } else { &[] };
        match () {
            () if present == old => tally.old += 1,
            () if present == killed.whole[1] => tally.new += 1,
            // An existing folder changes file by file.
            () => {
                tally.mixed += 1;
                let place = format!("{command}, seed {seed}, round {round}");
                assert!(is_there && present.len() == killed.whole[0].len(), "{place}");
                for (index, file) in present.iter().enumerate() {
                    let whole = [&killed.whole[0][index], &killed.whole[1][index]];
                    assert!(whole.contains(&file), "{place}: {}", file.0.display());
                }
            }
        }
    }
    // Leftovers of killed processes do no harm, and the next run that changes the files removes them.
    for version in [0, 1] {
        assert!(ended(killed.spawn(version)).status.success());
        assert_eq!(killed.present(), killed.whole[version]);
    }
    let left: Vec<_> = files(&folder).into_iter().map(|(path, _)| path).collect();
    let left: Vec<_> = left.iter().filter(|path| path.ancestors().any(is_temporary)).collect();
    assert!(left.is_empty(), "{left:?}");
    let Tally { killed, old, new, mixed, leftovers } = tally;
    let rounds = rounds();
    println!(
        "{command} ({test}), seed {seed}: {rounds} rounds, {killed} killed in time; {old} old, {new} new, \
         {mixed} files of both; {leftovers} with leftovers"
    );
    assert!(killed > 0);
}

#[test]
fn a_module_is_old_or_new() {
    kill_again_and_again("interrupted-module", "generate", "arm.rs", true);
}

#[test]
fn a_crate_that_was_not_there_is_whole_or_not_there() {
    kill_again_and_again("interrupted-new-crate", "crate", "arm", false);
}

#[test]
fn each_file_of_a_crate_is_old_or_new() {
    kill_again_and_again("interrupted-crate", "crate", "arm", true);
}

#[cfg(unix)]
#[test]
fn a_compiler_that_is_interrupted_leaves_no_folder() {
    let folder = folder("interrupted-prove");
    let entries = || fs::read_dir(&folder).unwrap().count();
    for signal in ["-INT", "-TERM"] {
        let child = Command::new(BINARY)
            .args(["prove", &robot("planar_2r")])
            .env("TMPDIR", &folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let start = Instant::now();
        while entries() == 0 {
            assert!(start.elapsed() < Duration::from_secs(60), "nothing is compiled");
            std::thread::sleep(Duration::from_millis(1));
        }
        let id = child.id().to_string();
        assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
        assert_eq!(ended(child).status.code(), Some(130));
        assert_eq!(entries(), 0);
    }
}
