//! LaTeX itself finds no line too long. Without pdflatex the test does nothing and reports it.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use robot_document::latex::{Layout, Page, document};
use robot_document::{EquationOptions, Form, robot};
use robot_model::description::read_toml;

/// Runs pdflatex once and returns its log, or `None` if the program does not exist.
fn log(folder: &Path, name: &str, latex: &str) -> Option<String> {
    std::fs::create_dir_all(folder).unwrap();
    std::fs::write(folder.join(format!("{name}.tex")), latex).unwrap();
    let mut command = Command::new("pdflatex");
    command.args(["-interaction=nonstopmode", "-halt-on-error", "-draftmode"]);
    command.arg(format!("{name}.tex")).current_dir(folder);
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).status().ok()?;
    let log = std::fs::read(folder.join(format!("{name}.log"))).unwrap();
    let log = String::from_utf8_lossy(&log).into_owned();
    assert!(status.success(), "{name}: {log}");
    Some(log)
}

#[test]
fn no_line_is_too_long() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("pdflatex");
    for name in ["trttr1", "ur5", "scara"] {
        let path = root.join(format!("../../robots/{name}.toml"));
        let text = std::fs::read_to_string(&path).unwrap();
        let model = read_toml(name, &text).unwrap().robot;
        let forms = [Form::Grouped, Form::Recursive];
        for (columns, has_arrays) in [(1, false), (2, false), (1, true), (2, true)] {
            let page = Page::with_columns(columns);
            let width = Layout::of_centimeters(page.width).width;
            let extras =
                robot::Extras { arrays: has_arrays.then_some(width), ..robot::Extras::default() };
            let options = EquationOptions::default();
            let described = robot::document(&model, &options, &forms, extras).unwrap();
            let latex = document(&described, page).unwrap();
            assert_eq!(latex.contains("bmatrix"), has_arrays, "{name}");
            let Some(log) = log(&folder, &format!("{name}{columns}{has_arrays}"), &latex) else {
                println!("there is no pdflatex here: nothing was tried");
                return;
            };
            let wide: Vec<&str> =
                log.lines().filter(|line| line.starts_with("Overfull \\hbox")).collect();
            assert!(wide.is_empty(), "{name}, {columns} columns: {wide:#?}");
        }
    }
}
