//! Help, its examples, manual pages and completions.

use std::collections::BTreeSet;

use crate::shell::Shell;
use crate::{URDF, complaint, folder, output};

/// The names of all commands, as the overview lists them.
pub(crate) fn commands() -> Vec<String> {
    let overview = output(&["--help"], "");
    let list = overview.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = list.lines().map(|line| line.split_whitespace().next().unwrap().to_owned());
    let names: Vec<String> = names.filter(|name| name != "help").collect();
    assert!(names.len() >= 14, "{names:?}");
    names
}

/// The lines of the example in the help of a command, `robot-symbolic` and what follows it.
fn example(command: &str) -> String {
    let help = output(&[command, "--help"], "");
    let after = help.split("Example:\n").nth(1).unwrap_or_else(|| panic!("no example:\n{help}"));
    let lines = after.lines().take_while(|line| line.starts_with("  "));
    let lines: Vec<&str> = lines.map(|line| line.strip_prefix("  ").unwrap()).collect();
    lines.join("\n") + "\n"
}

/// Examples that are shown with others' programs, targets that need not be installed.
const ELSEWHERE: [&str; 2] = ["cargo ", "--target"];

#[test]
fn the_examples_of_every_command_run() {
    for command in commands() {
        let example = example(&command);
        assert!(example.starts_with(&format!("robot-symbolic {command}")), "{example}");
        // A command each, with the lines that continue it and what it reads.
        let whole = example.replace("\\\n", " ");
        let mut scripts: Vec<String> = vec![];
        for line in whole.lines() {
            let starts = ["robot-symbolic", "cargo"].iter().any(|start| line.starts_with(start));
            match scripts.last_mut() {
                Some(last) if !starts => *last += &format!("{line}\n"),
                _ => scripts.push(format!("{line}\n")),
            }
        }
        let shell = Shell::new();
        for name in ["arm.urdf", "robots/arm.urdf"] {
            // What the examples need beside the robots of the project.
            shell.write(name, URDF);
        }
        shell.write("src/lib.rs", "");
        shell.write("docs/trttr1.printed", include_str!("../../../../docs/trttr1.printed"));
        let here = |script: &&String| ELSEWHERE.iter().all(|mark| !script.contains(mark));
        for script in scripts.iter().filter(here) {
            // A watch would go on until Ctrl-C.
            let end = if command == "watch" { " --saves 0\n" } else { "\n" };
            let done = shell.run(&(script.trim_end().to_owned() + end));
            let shown = format!("{script}\n{}{}", done.output, done.errors);
            // The answer to a check may be no.
            assert!(done.code == Some(0) || done.code == Some(1) && answers(&command), "{shown}");
        }
    }
}

/// Commands whose answer may be no, with the exit code 1.
fn answers(command: &str) -> bool {
    ["check", "compare", "diff"].contains(&command)
}

#[test]
fn exit_codes_are_told_in_the_help_and_the_book() {
    let help = output(&["--help"], "");
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/commands.md");
    let page = std::fs::read_to_string(page).unwrap();
    for code in 0..=2 {
        assert!(help.contains(&format!("\n  {code}  ")), "{help}");
        assert!(page.contains(&format!("\n| {code} |")), "{page}");
    }
    for command in commands() {
        assert!(page.contains(&format!("| `{command}")), "{command} is not in docs/commands.md");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = folder("man");
    let path = folder.to_str().unwrap();
    assert_eq!(crate::run(&["man", path]).code, 0);
    output(&["man", path, "--check"], "");
    let files: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let pages = commands().into_iter().map(|command| format!("robot-symbolic-{command}.1"));
    let wanted: BTreeSet<String> =
        pages.chain(std::iter::once("robot-symbolic.1".to_owned())).collect();
    assert_eq!(files, wanted);
    for file in &files {
        let page = std::fs::read_to_string(folder.join(file)).unwrap();
        assert!(page.starts_with(".ie") && page.contains(".SH SYNOPSIS"), "{file}: {page}");
        assert!(page.contains("Example"), "{file}: {page}");
    }
    let own = std::fs::read_to_string(folder.join("robot-symbolic.1")).unwrap();
    assert_eq!(own, output(&["man"], ""));
    assert!(own.contains("Exit codes"), "{own}");
    std::fs::remove_file(folder.join("robot-symbolic-eval.1")).unwrap();
    assert!(complaint(1, &["man", path, "--check"], "").contains("eval.1 is missing"));
}

#[test]
fn shells_complete_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = output(&["completions", shell], "");
        for command in commands() {
            assert!(script.contains(&command), "{shell} does not complete {command}");
        }
        assert!(script.contains("quantity"), "{shell} does not complete --quantity");
    }
    assert!(complaint(2, &["completions", "sh"], "").contains("possible values"));
}

#[test]
fn colours_are_for_terminals() {
    use robot_cli::colours;
    use std::ffi::OsStr;
    assert!(colours(true, None) && colours(true, Some(OsStr::new(""))));
    assert!(!colours(true, Some(OsStr::new("1"))) && !colours(false, None));
    let shell = Shell::new();
    shell.write("broken.toml", "format = 1\n[robot]\nnam = \"arm\"\n");
    // A pipe is no terminal.
    for script in
        ["robot-symbolic check broken.toml", "robot-symbolic stats", "robot-symbolic --help"]
    {
        let done = shell.run(script);
        let shown = done.output + &done.errors;
        assert!(!shown.is_empty() && !shown.contains('\x1b'), "{shown:?}");
    }
    assert_eq!(shell.run("robot-symbolic check broken.toml").code, Some(1));
}
