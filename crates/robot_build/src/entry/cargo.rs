//! The environment that Cargo gives a build script, and the lines that a build script prints for Cargo.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use robot_model::diagnostic::Diagnostics;

use crate::error::{Error, Errors};

/// The folder of the package that is built.
pub(crate) fn package_dir() -> Result<PathBuf, Error> {
    variable(
        "CARGO_MANIFEST_DIR",
        "paths of robot files are relative to it; call this from a build script, or set the \
         folder with `package_dir`",
    )
}

/// The folder for generated files.
pub(crate) fn out_dir() -> Result<PathBuf, Error> {
    variable("OUT_DIR", "call this from a build script, or set a folder with `out_dir`")
}

/// Reads a variable when the build script runs, not when it is compiled.
fn variable(variable: &'static str, remedy: &'static str) -> Result<PathBuf, Error> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty());
    value.map(PathBuf::from).ok_or(Error::NotUnderCargo { variable, remedy })
}

/// Directives for Cargo: lines of a build script's output.
#[derive(Clone, Debug, Default)]
pub(crate) struct Directives(String);

impl Directives {
    /// Adds a path to watch. A path that is not UTF-8 is an error: Cargo would watch another path, which does not
    /// exist, and run the build script in every build.
    pub(crate) fn rerun_if_changed(&mut self, path: &Path) -> Result<(), Error> {
        let name = path.to_str().ok_or_else(|| Error::File {
            action: "watch",
            path: path.to_owned(),
            reason: "its path is not UTF-8, but Cargo's build scripts require it; rename it"
                .to_owned(),
        })?;
        self.line("cargo:rerun-if-changed", name);
        Ok(())
    }

    /// Adds a line for each error, with which the build fails.
    ///
    /// Adds nothing if the package declares that it builds with a Cargo that does not support `cargo::error`, because
    /// it would then get an error about this directive instead.
    pub(crate) fn errors(&mut self, errors: &Errors) {
        let declared = std::env::var("CARGO_PKG_RUST_VERSION").unwrap_or_default();
        for problem in errors.problems().iter().filter(|_| supports_errors(&declared)) {
            self.line("cargo::error", &problem.headline);
        }
    }

    pub(crate) fn warning(&mut self, text: &str) {
        self.line("cargo:warning", text);
    }

    /// Adds a line for each warning: `robots/arm.toml:12:5: message`.
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
            self.warning(&text);
        }
    }

    #[cfg(test)]
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Prints the lines on standard output.
    pub(crate) fn print(&self) {
        // If this fails, nobody reads the output.
        let _ = std::io::stdout().lock().write_all(self.0.as_bytes());
    }

    fn line(&mut self, directive: &str, value: &str) {
        let value = value.replace(['\n', '\r'], " ");
        let _ = writeln!(self.0, "{directive}={value}");
    }
}

/// Whether Cargo of a declared version, such as `1.84`, supports `cargo::error`; true if none is declared.
fn supports_errors(declared: &str) -> bool {
    let mut numbers = declared.split('.').map_while(|number| number.parse::<u32>().ok());
    match (numbers.next(), numbers.next()) {
        (Some(major), Some(minor)) => (major, minor) >= (1, 84),
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variable_that_is_not_set_is_an_error_with_a_remedy() {
        assert_eq!(variable("PATH", "").unwrap(), PathBuf::from(std::env::var_os("PATH").unwrap()));
        let error = variable("ROBOT_BUILD_IS_NOT_SET", "set it").unwrap_err().to_string();
        assert_eq!(error, "the environment variable ROBOT_BUILD_IS_NOT_SET is not set: set it");
    }

    #[test]
    fn old_packages_get_no_directive_that_they_refuse() {
        for (declared, supports) in [
            ("", true),
            ("1.84", true),
            ("1.95.0", true),
            ("2.0", true),
            ("1.83.9", false),
            ("1.70", false),
        ] {
            assert_eq!(supports_errors(declared), supports, "{declared}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_path_that_cargo_cannot_watch_is_refused() {
        use std::os::unix::ffi::OsStrExt as _;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"arms/l\xffft.toml"));
        let mut directives = Directives::default();
        let error = directives.rerun_if_changed(path).unwrap_err().to_string();
        assert!(error.contains("not UTF-8") && error.contains("rename it"), "{error}");
        assert_eq!(directives.text(), "");
    }
}
