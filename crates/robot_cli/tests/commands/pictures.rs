//! The pictures in the README and the book are made from the current output of the command.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::shell::Shell;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn sum(text: &str) -> String {
    hmac_sha256::Hash::hash(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The source of a picture: the output of a command, or the tables of a page.
fn source(shell: &Shell, name: &str) -> String {
    if name.starts_with("robot-symbolic ") {
        let done = shell.run(name);
        assert_eq!(done.code, Some(0), "{name}\n{}", done.errors);
        return done.output;
    }
    let page = std::fs::read_to_string(root().join(name)).unwrap();
    page.lines().filter(|line| line.starts_with('|')).map(|line| format!("{line}\n")).collect()
}

/// The lines `SOURCE sha256 SUM` in the metadata of a picture.
fn sources(picture: &str) -> Vec<(String, String)> {
    let (_, rest) = picture.split_once("<metadata>\n").unwrap();
    let (lines, _) = rest.split_once("</metadata>").unwrap();
    let parts = lines.lines().map(|line| line.split_once(" sha256 ").unwrap());
    parts.map(|(name, sum)| (name.to_owned(), sum.to_owned())).collect()
}

/// This test finds outdated pictures without Typst.
#[test]
fn pictures_are_made_from_what_is_printed() {
    let (shell, mut sums, mut old) = (Shell::new(), BTreeMap::new(), vec![]);
    let mut count = 0;
    for entry in std::fs::read_dir(root().join("docs/pictures")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "svg") {
            continue;
        }
        count += 1;
        let picture = std::fs::read_to_string(&path).unwrap();
        for (name, total) in sources(&picture) {
            let today = sums.entry(name.clone()).or_insert_with(|| sum(&source(&shell, &name)));
            if *today != total {
                old.push(format!("{}: {name}", path.display()));
            }
        }
    }
    assert!(count >= 10, "{count}");
    assert!(
        old.is_empty(),
        "made from something else, docs/pictures/make makes them anew: {old:#?}"
    );
}

/// Pictures can be shown on a page of any color and in programs without fonts, and are small.
#[test]
fn pictures_need_nothing() {
    let (mut bytes, mut wrong) = (0, vec![]);
    for entry in std::fs::read_dir(root().join("docs/pictures")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "svg") {
            let picture = std::fs::read_to_string(&path).unwrap();
            bytes += picture.len();
            let outside = ["<text", "font-family", "<image", "url(", "<script", "<foreignObject"];
            let white = picture.contains("<path fill=\"#ffffff\" d=\"M0");
            if !white || outside.iter().any(|outside| picture.contains(outside)) {
                wrong.push(path);
            }
        }
    }
    assert!(wrong.is_empty() && bytes < 1_000_000, "{bytes} {wrong:?}");
}
