//! Files that an earlier build left in `OUT_DIR`, which a program could still include after its robot has changed.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::driver::generate::unnamed_header;
use crate::entry::files::{Output, Ownership, Writer, is_marked};
use crate::entry::system::system_reason;
use crate::error::{Error, Errors};

/// The file in `OUT_DIR` that lists the files of all builds, a path for each line after the first.
const LIST: &str = "robot_build.files";

/// The files that this process has written. A build script can call builders several times.
static WRITTEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Disables the files that an earlier build wrote to `OUT_DIR` and this process has not, for example because a robot
/// has another name now. If a program includes a Rust file of these, it no longer compiles; other files are removed.
pub(super) fn disable_earlier(folder: &Path, written: Vec<PathBuf>) -> Result<(), Errors> {
    let mut all = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
    all.extend(written);
    disable(folder, &all)
}

fn disable(folder: &Path, written: &BTreeSet<PathBuf>) -> Result<(), Errors> {
    let list = folder.join(LIST);
    let text = fs::read_to_string(&list).unwrap_or_default();
    let earlier = text.lines().skip(1).map(|line| folder.join(line));
    let earlier: BTreeSet<PathBuf> = earlier
        .filter(|path| !written.contains(path) && is_marked(path).unwrap_or_default())
        .collect();
    let is_rust = |path: &&PathBuf| path.extension().is_some_and(|extension| extension == "rs");
    for path in earlier.iter().filter(|path| !is_rust(path)) {
        fs::remove_file(path).map_err(|error| Error::File {
            action: "remove",
            path: path.clone(),
            reason: system_reason(&error),
        })?;
    }
    let here = written.iter().filter(|path| path.starts_with(folder));
    let names: Vec<String> = here.clone().filter(is_rust).map(|path| name(folder, path)).collect();
    let kept = || earlier.iter().filter(is_rust);
    let mut outputs: Vec<(PathBuf, String)> =
        kept().map(|path| (path.clone(), refusal(&name(folder, path), &names))).collect();
    let listed: BTreeSet<String> = here.chain(kept()).map(|path| name(folder, path)).collect();
    let listed: Vec<String> = listed.into_iter().collect();
    outputs.push((list, format!("// {}\n{}\n", unnamed_header(), listed.join("\n"))));
    let outputs: Vec<Output<'_>> = outputs
        .iter()
        .map(|(path, text)| Output {
            path: path.clone(),
            bytes: text.as_bytes(),
            ownership: Ownership::Marked,
        })
        .collect();
    Writer::new().write(&outputs)?;
    Ok(())
}

/// The path of a file in the folder.
fn name(folder: &Path, path: &Path) -> String {
    path.strip_prefix(folder).unwrap_or(path).to_string_lossy().into_owned()
}

/// A Rust file that does not compile: `old` is its name, `names` are those of the present files.
fn refusal(old: &str, names: &[String]) -> String {
    let names = names.join(", ");
    let message = format!(
        "{old} is from an earlier build; the build script no longer generates it. Include a file of this build: {names}"
    );
    format!("// {}\n\ncompile_error!({message:?});\n", unnamed_header())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_earlier_build_wrote_is_disabled() {
        let folder = std::env::temp_dir().join(format!("robot_build_old_{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("arm")).unwrap();
        let code = format!("// {}\n", unnamed_header());
        let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
        let read = |name: &str| fs::read_to_string(folder.join(name));
        let build = |names: &[&str]| {
            names.iter().for_each(|name| write(name, &code));
            let written = names.iter().map(|name| folder.join(name)).collect();
            disable(&folder, &written).unwrap();
        };
        // Files of others stay, even if they are generated code.
        write("copied.rs", &code);
        build(&["arm.rs", "arm/arm.h", "left.rs"]);
        build(&["left.rs", "wrist.rs"]);
        for name in ["left.rs", "wrist.rs", "copied.rs"] {
            assert_eq!(read(name).unwrap(), code, "{name}");
        }
        let refused = read("arm.rs").unwrap();
        assert!(refused.contains("compile_error!(\"arm.rs is from an earlier build;"), "{refused}");
        assert!(refused.contains("a file of this build: left.rs, wrist.rs\""), "{refused}");
        assert!(read("arm/arm.h").is_err());
        // It is still refused by the builds that follow, until one writes it again.
        build(&["left.rs"]);
        assert!(read("arm.rs").unwrap().contains("a file of this build: left.rs\""));
        build(&["left.rs", "arm.rs"]);
        assert_eq!(read("arm.rs").unwrap(), code);
        fs::remove_dir_all(&folder).unwrap();
    }
}
