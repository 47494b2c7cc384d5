//! Compiles and runs generated text with the `rustc` that Cargo uses.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Creates a separate folder for each test.
pub(crate) fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn rustc() -> Command {
    let mut command = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    command.args(["--edition", "2024"]);
    command
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}\n{errors}");
    assert!(!errors.contains("warning"), "{command:?}\n{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Compiles the runtime as a library, which generated code refers to as `::robot_runtime`.
fn runtime() -> &'static Path {
    static RUNTIME: OnceLock<PathBuf> = OnceLock::new();
    RUNTIME.get_or_init(|| {
        let folder = folder(&format!("runtime-{}", std::process::id()));
        for (path, text) in robot_runtime::SOURCES {
            let path = folder.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        let library = folder.join("librobot_runtime.rlib");
        run(rustc()
            .args(["--crate-name", "robot_runtime", "--crate-type", "rlib"])
            .args(["--cfg", "feature=\"std\"", "-O", "-o"])
            .arg(&library)
            .arg(folder.join("mod.rs")));
        library
    })
}

/// Compiles a text; warnings are failures. For programs without `--test`, the text contains `main`.
pub(crate) fn compile(test: &str, text: &str, flags: &[&str]) -> PathBuf {
    let folder = folder(test);
    let (source, program) = (folder.join("main.rs"), folder.join("program"));
    std::fs::write(&source, text).unwrap();
    let runtime = format!("robot_runtime={}", runtime().display());
    run(rustc().args(flags).args(["--extern", &runtime, "-o"]).arg(&program).arg(&source));
    program
}

/// Compiles a text with a `main`, runs it, and returns its output.
pub(crate) fn output_of(test: &str, text: &str, flags: &[&str]) -> String {
    run(&mut Command::new(compile(test, text, flags)))
}
