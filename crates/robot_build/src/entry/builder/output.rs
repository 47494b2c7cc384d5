//! The files that a builder writes.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::driver::generate::{Generated, unnamed_header};
use crate::entry::files::{Output, Ownership, Writer};
use crate::error::{Error, Errors};

/// The name of the file that includes the modules of several robots.
pub(super) const INDEX: &str = "robots";

/// Names that Windows reserves for devices; files there must not have one of them before the first dot.
const DEVICES: [&str; 4] = ["aux", "con", "nul", "prn"];

/// The module of a robot file.
pub(super) struct Module {
    /// The path of the robot file as given.
    pub(super) path: String,
    pub(super) generated: Generated,
}

impl Module {
    fn name(&self) -> &str {
        &self.generated.module_name
    }

    /// The name of the module and the path of the robot file.
    pub(super) fn names(&self) -> (&str, &str) {
        (self.name(), &self.path)
    }

    /// The name of the robot file without its ending, if a Rust file can have this name.
    fn stem(&self) -> Option<&str> {
        Path::new(&self.path).file_stem().and_then(OsStr::to_str)
    }

    /// The warning if the file of the module cannot be created on some systems.
    pub(super) fn unportable(&self) -> Option<String> {
        let (path, name) = (&self.path, self.name());
        is_device(name).then(|| {
            format!(
                "{path}: Windows reserves the name `{name}` for a device, so `{name}.rs` cannot \
                 be written there; rename the robot if its package must build on Windows"
            )
        })
    }
}

/// Whether Windows reserves a name, such as `con` or `lpt1`, for a device.
fn is_device(name: &str) -> bool {
    let numbered = |prefix| {
        let rest = name.strip_prefix(prefix).unwrap_or_default();
        matches!(rest.as_bytes(), [b'1'..=b'9'])
    };
    DEVICES.contains(&name) || numbered("com") || numbered("lpt")
}

/// Reports all pairs of robots, given by names and paths, whose files would have the same name. The index also has a
/// name, if there is one.
pub(super) fn check_names<'n>(
    names: impl IntoIterator<Item = (&'n str, &'n str)>,
    index: Option<&'n str>,
    errors: &mut Vec<Error>,
) {
    let mut known: BTreeMap<&str, &str> = BTreeMap::new();
    known.extend(index.map(|index| (index, "the index of all robots")));
    for (name, path) in names {
        let Some(first) = known.insert(name, path) else { continue };
        errors.push(match first == path {
            true => Error::SameFile { path: first.to_owned() },
            false => Error::SameModule {
                module: name.to_owned(),
                first: first.to_owned(),
                second: path.to_owned(),
            },
        });
    }
}

/// Writes a file for each module and, if there are several, an index that includes them. `inputs` are the
/// robot files and their pinned plans.
///
/// With `stems`, a module whose name differs from that of its robot file is also written under the latter name, so
/// that a build that includes `lift.rs` for `lift.toml` finds it; not if a robot, another file or the index has this name.
/// Returns the paths of all files.
pub(super) fn write(
    modules: &[Module],
    inputs: impl Iterator<Item = PathBuf>,
    folder: &Path,
    stems: bool,
) -> Result<Vec<PathBuf>, Errors> {
    let mut index = format!("// {}\n\n", unnamed_header());
    let mut outputs = vec![];
    for module in modules {
        index.push_str(&format!("include!(\"{}.rs\");\n", module.name()));
        outputs.push(output(folder, module.name(), &module.generated.code));
        let second = second_name(module, modules).filter(|_| stems);
        outputs.extend(second.map(|name| output(folder, name, &module.generated.code)));
    }
    if modules.len() > 1 {
        outputs.push(output(folder, INDEX, &index));
    }
    Writer::new().inputs(inputs).write(&outputs)?;
    Ok(outputs.into_iter().map(|output| output.path).collect())
}

fn output<'a>(folder: &Path, name: &str, code: &'a str) -> Output<'a> {
    Output {
        path: folder.join(format!("{name}.rs")),
        bytes: code.as_bytes(),
        ownership: Ownership::Marked,
    }
}

/// The name of the robot file, if it differs from the name of the module and of all other files.
///
/// If the two names differ only by case, they can be the same file, which is harmless because both have the same text.
fn second_name<'m>(module: &'m Module, modules: &[Module]) -> Option<&'m str> {
    let stem = module.stem().filter(|stem| *stem != module.name())?;
    let is_stem = |name: &str| name.eq_ignore_ascii_case(stem);
    let is_taken = |other: &Module| is_stem(other.name()) || other.stem().is_some_and(is_stem);
    let others = modules.iter().filter(|other| other.name() != module.name());
    let is_free = others.into_iter().all(|other| !is_taken(other)) && !is_stem(INDEX);
    is_free.then_some(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_devices_are_known() {
        for name in ["aux", "con", "nul", "prn", "com1", "com9", "lpt1", "lpt9"] {
            assert!(is_device(name), "{name}");
        }
        for name in ["", "arm", "com", "com0", "com10", "lpt", "lpt0", "coma", "con1", "1", "xcom1"]
        {
            assert!(!is_device(name), "{name}");
        }
    }
}
