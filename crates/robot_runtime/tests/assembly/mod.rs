//! Compiles a few lines of code with the module's files and lists the instructions of each function.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// The instructions of one function, without labels and directives, each as operation and operands.
pub(crate) type Listing = Vec<(String, String)>;

/// The command `rustc` that Cargo would call.
fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Whether the standard library for `target` is installed; prints a line if it is not.
pub(crate) fn is_installed(target: &str) -> bool {
    let output = rustc().args(["--print", "target-libdir", "--target", target]).output();
    let folder = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    let installed = folder.is_ok_and(|folder| Path::new(&folder).is_dir());
    if !installed {
        println!("skipped: target {target} is not installed");
    }
    installed
}

/// Compiles `source`, a crate root in which the module is named `runtime`, for `target` with `options`;
/// returns its functions, which must have the attribute `#[unsafe(no_mangle)]`.
pub(crate) fn compile(
    name: &str,
    source: &str,
    target: &str,
    options: &[&str],
) -> BTreeMap<String, Listing> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let module = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/runtime/mod.rs");
    let (root, assembly) = (folder.join(format!("{name}.rs")), folder.join(format!("{name}.s")));
    let source = format!("#![no_std]\n#[path = {module:?}]\npub mod runtime;\n{source}");
    std::fs::write(&root, source).expect("the folder of temporary files is writable");
    let output = rustc()
        .args(["--crate-type=lib", "--edition=2024", "--crate-name", name, "--target", target])
        .args(["-Ccodegen-units=1", "--check-cfg", "cfg(feature, values(\"std\"))"])
        .args(options)
        .arg(format!("--emit=asm={}", assembly.display()))
        .arg(&root)
        .output()
        .expect("rustc starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    functions(&std::fs::read_to_string(assembly).expect("rustc wrote the assembly"))
}

fn functions(assembly: &str) -> BTreeMap<String, Listing> {
    let mut functions = BTreeMap::<String, Listing>::new();
    let mut current = String::new();
    for line in assembly.lines() {
        let line = line.trim_end();
        if let Some(label) = line.strip_suffix(':') {
            if !label.starts_with('.') {
                label.clone_into(&mut current);
            }
            continue;
        }
        let mut words = line.split_whitespace();
        if let Some(operation) = words.next().filter(|word| !word.starts_with(['.', '@', '#'])) {
            let operands = words.collect::<Vec<_>>().join(" ");
            functions.entry(current.clone()).or_default().push((operation.to_owned(), operands));
        }
    }
    functions
}
