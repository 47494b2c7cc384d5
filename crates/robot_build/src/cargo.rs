//! What Cargo tells a build script, and what a build script tells Cargo.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use robot_dynamics::diagnostic::Diagnostics;

use crate::error::Error;

/// The folder of the package that is built.
pub(crate) fn package_dir() -> Result<PathBuf, Error> {
    variable(
        "CARGO_MANIFEST_DIR",
        "paths of robot files are relative to it; call this from a build script, or give the folder \
         with `package_dir`",
    )
}

/// The folder for generated files.
pub(crate) fn out_dir() -> Result<PathBuf, Error> {
    variable("OUT_DIR", "call this from a build script, or choose a folder with `out_dir`")
}

/// Variables are read when the build script runs, not when it is compiled.
fn variable(variable: &'static str, remedy: &'static str) -> Result<PathBuf, Error> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty());
    value.map(PathBuf::from).ok_or(Error::NotUnderCargo { variable, remedy })
}

/// Directives for Cargo, as lines of a build script's output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Directives(String);

impl Directives {
    pub(crate) fn rerun_if_changed(&mut self, path: &Path) {
        self.line("rerun-if-changed", &path.display().to_string());
    }

    /// A warning each, on one line: `robots/arm.toml:12:5: message`.
    pub(crate) fn warnings(&mut self, warnings: &Diagnostics) {
        for warning in warnings.iter() {
            let source = warnings.source();
            let place = warning.primary.as_ref().map(|label| source.position(label.span.start));
            let place = place.map(|(line, column)| format!(":{line}:{column}")).unwrap_or_default();
            let mut text = format!("{}{place}: {}", source.name, warning.message);
            for more in [&warning.why, &warning.help].into_iter().flatten() {
                // Writing to a string does not fail.
                let _ = write!(text, "; {more}");
            }
            self.line("warning", &text);
        }
    }

    #[cfg(test)]
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Tells Cargo, on standard output.
    pub(crate) fn print(&self) {
        // Nobody is listening where this fails.
        let _ = std::io::stdout().lock().write_all(self.0.as_bytes());
    }

    fn line(&mut self, directive: &str, value: &str) {
        let value = value.replace(['\n', '\r'], " ");
        let _ = writeln!(self.0, "cargo:{directive}={value}");
    }
}
