//! The book: its commands print the shown output, the targets of its links exist, its list of pages is complete.
//!
//! A block ```` ```sh run ```` is run in the folder that the blocks of a page share. A block after it that is marked
//! `output` or `errors` contains the output of the last run on this stream, in which a line `…` stands for any
//! lines. `code=1` states an exit code other than 0, `file=NAME` writes the block into a file, and with
//! `needs=TRIPLE` it is run only if this target is installed. If `UPDATE_SNAPSHOTS` is set, blocks without
//! `…` are rewritten.

use std::path::{Path, PathBuf};

use robot_testing::pages::{Block, blocks, pages_in};

use crate::shell::{Done, Shell};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The folders with the pages of the book. The pages of diagnostics are in the package that prints them.
const FOLDERS: [&str; 2] = ["docs", "crates/robot_model/diagnostics"];

/// All pages with their paths.
fn pages() -> Vec<(String, String)> {
    let root = root();
    let mut paths =
        FOLDERS.iter().flat_map(|folder| pages_in(&root.join(folder))).collect::<Vec<_>>();
    paths.extend(["README.md", "ARCHITECTURE.md"].map(|name| root.join(name)));
    let named = paths.into_iter().map(|path| {
        let name = path.strip_prefix(&root).unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read_to_string(path).unwrap())
    });
    named.collect()
}

/// Whether a text is as shown, where `…` stands for any lines.
fn matches(shown: &str, text: &str) -> bool {
    let Some((head, rest)) = shown.split_once("…\n") else { return shown == text };
    let Some(mut left) = text.strip_prefix(head) else { return false };
    let mut parts: Vec<&str> = rest.split("…\n").collect();
    let tail = parts.pop().unwrap_or_default();
    for part in parts {
        match left.find(part) {
            Some(place) => left = &left[place + part.len()..],
            None => return false,
        }
    }
    left.ends_with(tail)
}

#[test]
fn shown_output_is_compared() {
    assert!(matches("a\nb\n", "a\nb\n") && !matches("a\n", "a\nb\n"));
    assert!(matches("a\n…\nd\n", "a\nb\nc\nd\n") && matches("…\nc\n…\n", "a\nb\nc\nd\n"));
    assert!(!matches("a\n…\nc\n", "a\nb\nc\nd\n") && !matches("…\ne\n…\n", "a\nb\n"));
}

fn is_installed(target: &str) -> bool {
    let asked = ["--print", "target-libdir", "--target", target];
    let output = std::process::Command::new("rustc").args(asked).output().unwrap();
    Path::new(String::from_utf8(output.stdout).unwrap().trim()).is_dir()
}

/// Runs the blocks of a page; returns the blocks that differ from the output, with the output.
fn run(name: &str, page: &str) -> Vec<(Block, String)> {
    let shell = Shell::new();
    let (mut last, mut stale): (Option<Done>, _) = (None, vec![]);
    for block in blocks(page) {
        let place = format!("{name}:{}", block.line);
        if let Some(file) = block.value("file") {
            shell.write(file, &block.text);
        }
        if block.language() == "sh" {
            let run = block.is("run") && block.value("needs").is_none_or(is_installed);
            let commands = block.text.lines().any(|line| line.starts_with("robot-symbolic"));
            assert!(block.is("run") || !commands, "{place}: a command that is not run");
            last = run.then(|| shell.run(&block.text));
            if let Some(done) = &last {
                let code = block.value("code").map_or(0, |code| code.parse().unwrap());
                assert_eq!(done.code, Some(code), "{place}\n{}{}", done.output, done.errors);
            }
        }
        let Some(done) = &last else { continue };
        let printed = match (block.is("output"), block.is("errors")) {
            (true, _) => &done.output,
            (_, true) => &done.errors,
            _ => continue,
        };
        if !matches(&block.text, printed) {
            stale.push((block, printed.clone()));
        }
    }
    stale
}

/// The page with blocks replaced.
fn replaced(page: &str, stale: &[(Block, String)]) -> String {
    let lines: Vec<&str> = page.lines().collect();
    let (mut text, mut from) = (String::new(), 0);
    for (block, printed) in stale {
        text += &(lines[from..block.line].join("\n") + "\n" + printed);
        from = block.line + block.text.lines().count();
    }
    text + &lines[from..].join("\n") + "\n"
}

#[test]
fn the_commands_of_the_book_do_what_it_shows() {
    let mut count = 0;
    for (name, page) in pages() {
        let shown = page.matches("\n```sh run").count();
        if shown == 0 && !page.contains("```sh") {
            continue;
        }
        count += shown;
        let stale = run(&name, &page);
        let full = stale.iter().all(|(block, _)| !block.text.contains("…\n"));
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && full && !stale.is_empty() {
            std::fs::write(root().join(&name), replaced(&page, &stale)).unwrap();
        } else if let Some((block, printed)) = stale.first() {
            panic!("{name}:{} shows\n{}\nprinted is\n{printed}", block.line, block.text);
        }
    }
    assert!(count >= 5, "{count}");
}

/// All commands are in blocks that are run.
#[test]
fn no_command_stands_in_an_indented_block() {
    for (name, page) in pages() {
        for line in page.lines() {
            assert!(!line.starts_with("    robot-symbolic"), "{name}: {line}");
        }
    }
}

/// The name of a heading in a link.
fn anchor(heading: &str) -> String {
    let text: String = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

fn anchors(page: &str) -> Vec<String> {
    page.lines().filter(|line| line.starts_with('#')).map(anchor).collect()
}

/// The targets of the links of a page, outside of blocks.
fn links(page: &str) -> Vec<String> {
    let (mut text, mut inside) = (String::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            inside = !inside;
        } else if !inside {
            text += line;
            text.push('\n');
        }
    }
    let ends = text.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    let targets = ends.map(|(target, _)| target.to_owned());
    targets.filter(|target| !target.contains("://") && !target.contains(['\\', ' '])).collect()
}

#[test]
fn links_lead_somewhere() {
    let root = root();
    let mut count = 0;
    for (name, page) in pages() {
        let folder = root.join(&name).parent().unwrap().to_owned();
        for link in links(&page) {
            count += 1;
            let (file, heading) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { root.join(&name) } else { folder.join(file) };
            assert!(target.exists(), "{name}: {link}");
            if !heading.is_empty() {
                let target = std::fs::read_to_string(target).unwrap();
                assert!(anchors(&target).iter().any(|one| one == heading), "{name}: {link}");
            }
        }
    }
    assert!(count >= 60, "{count}");
}

#[test]
fn every_page_is_in_the_summary() {
    let root = root();
    let docs = root.join("docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    let listed: Vec<PathBuf> =
        links(&summary).iter().map(|link| found_at(&docs.join(link))).collect();
    for path in FOLDERS.iter().flat_map(|folder| pages_in(&root.join(folder))) {
        let times = listed.iter().filter(|page| **page == path).count();
        let is_page = usize::from(!path.ends_with("SUMMARY.md"));
        assert_eq!(times, is_page, "{} in docs/SUMMARY.md", path.display());
    }
}

/// A path without `..`; a path that does not exist is unchanged.
fn found_at(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
