//! `watch` as a real process, with its page and its end.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use crate::{complaint, folder, robot};

/// The command while it watches a copy of the planar arm.
struct Watch {
    process: Child,
    lines: Receiver<String>,
    file: PathBuf,
    page: PathBuf,
}

impl Watch {
    fn new(test: &str) -> Watch {
        let folder = folder(test);
        let (file, page) = (folder.join("arm.toml"), folder.join("arm.html"));
        std::fs::copy(robot("planar_2r"), &file).unwrap();
        let mut process = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
            .arg("watch")
            .arg(&file)
            .arg("--report")
            .arg(&page)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let output = BufReader::new(process.stdout.take().unwrap());
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            output.lines().map_while(Result::ok).all(|line| sender.send(line).is_ok())
        });
        Watch { process, lines, file, page }
    }

    /// Waits for a line, for at most a minute.
    fn wait_for(&self, wanted: &str) {
        loop {
            let line = self.lines.recv_timeout(Duration::from_secs(60));
            if line.unwrap_or_else(|error| panic!("{wanted}: {error}")).contains(wanted) {
                return;
            }
        }
    }

    fn save(&self, from: &str, to: &str) {
        let text = std::fs::read_to_string(&self.file).unwrap();
        assert!(text.contains(from), "{from}");
        std::fs::write(&self.file, text.replace(from, to)).unwrap();
    }

    /// The picture that identifies the newest page, when it differs from the given one.
    fn picture(&self, earlier: Option<&str>) -> String {
        let path = self.page.with_extension("html.svg");
        for _ in 0..600 {
            if let Some(text) = read(&path).filter(|text| Some(text.as_str()) != earlier) {
                return text;
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        panic!("there is no other picture");
    }

    /// Sends Ctrl-C; returns the exit code.
    fn end(&mut self) -> Option<i32> {
        let kill = Command::new("kill").args(["-INT", &self.process.id().to_string()]).status();
        assert!(kill.unwrap().success());
        self.process.wait().unwrap().code()
    }
}

/// The text of a file that exists and is not empty.
fn read(path: &Path) -> Option<String> {
    std::fs::read_to_string(path).ok().filter(|text| !text.is_empty())
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.process.kill();
    }
}

#[test]
fn the_page_follows_the_file_and_stays_when_the_watch_ends() {
    let mut watch = Watch::new("watch");
    watch.wait_for("planar_2r: 2 coordinates");
    let first = watch.picture(None);
    assert!(read(&watch.page).unwrap().contains("data-page="));
    watch.save("m2 = { value = 3.0", "m2 = { value = 3.5");
    watch.wait_for("~ parameter m2: value 3 -> 3.5");
    let second = watch.picture(Some(&first));
    assert!(second.contains("\n<svg ") && second.ends_with("/>\n"), "{second}");
    watch.save("mass = \"m2\"", "mass = \"m3\"");
    watch.wait_for("the file has errors; the last valid robot, from save 1, is kept");
    watch.save("mass = \"m3\"", "mass = \"m2\"");
    watch.wait_for("gone: error[R0303]");
    watch.wait_for("no changes in the robot");
    assert_eq!(watch.end(), Some(0));
    let last = read(&watch.page).unwrap();
    assert!(!last.contains("data-page=") && !last.contains("img-src"));
    assert!(last.contains("3.5") && last.ends_with("</html>\n"));
    assert!(!watch.page.with_extension("html.svg").exists());
}

#[test]
fn a_watch_that_ends_without_a_robot_says_so() {
    let mut watch = Watch::new("watch_broken");
    watch.wait_for("planar_2r: 2 coordinates");
    std::fs::remove_file(&watch.file).unwrap();
    watch.wait_for("the file has errors; the last valid robot, from the start, is kept");
    assert_eq!(watch.end(), Some(1));
}

#[test]
fn a_file_that_never_was_is_not_waited_for() {
    assert!(complaint(1, &["watch", "none.toml"], "").contains("there is no such file"));
    assert!(complaint(2, &["watch"], "").contains("<FILE>"));
}
