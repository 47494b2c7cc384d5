//! Compilation with the user's compiler.

mod folder;

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use robot_build::{system_reason, visible};

pub use self::folder::remove_temporary_folders;

use self::folder::Folder;
use crate::error::Error;
use crate::probe::{CRATE, Probe, ROOT_FILE};

/// The largest number of lines of the compiler's messages that are shown.
const SHOWN_LINES: usize = 12;

/// The compiler's message about a processor that it does not support.
const UNKNOWN_CPU: &str = "is not a recognized processor";

/// A profile of compilation, with the default settings of Cargo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// `cargo build`: no optimization, overflow checks, debug assertions.
    Dev,
    /// `cargo build --release`: opt-level 3.
    Release,
}

impl Profile {
    /// The name of the profile in Cargo.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Profile::Dev => "dev",
            Profile::Release => "release",
        }
    }

    /// The arguments for the compiler.
    #[must_use]
    pub fn flags(self) -> &'static [&'static str] {
        match self {
            Profile::Dev => &["-Copt-level=0", "-Cdebug-assertions=on", "-Coverflow-checks=on"],
            Profile::Release => &["-Copt-level=3"],
        }
    }
}

/// A compiler with its target.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Compiler {
    /// The path of the compiler; `None` for the variable `RUSTC` or, if it is not set, `rustc`.
    pub rustc: Option<PathBuf>,
    /// The target; `None` for the machine on which the compiler runs.
    pub target: Option<String>,
    /// The processor of the target; `None` for the most basic one.
    pub cpu: Option<String>,
}

impl Compiler {
    /// The description of the compiler, such as `rustc 1.95.0 (…) for x86_64-unknown-linux-gnu`.
    ///
    /// # Errors
    ///
    /// If the compiler cannot be started, or if the program is not a Rust compiler.
    pub fn description(&self) -> Result<String, Error> {
        let output = self.run(Command::new(self.path()).arg("-vV"))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() || !text.lines().any(|line| line.starts_with("host: ")) {
            let said = String::from_utf8_lossy(&output.stderr);
            let line =
                said.lines().chain(text.lines()).map(str::trim).find(|line| !line.is_empty());
            let line =
                line.map(|line| format!(" and says `{}`", visible(line))).unwrap_or_default();
            let answer = format!("ends with {}{line}", output.status);
            return Err(Error::OtherProgram { path: self.path(), answer });
        }
        let version = text.lines().next().unwrap_or_default();
        let host = text.lines().find_map(|line| line.strip_prefix("host: ")).unwrap_or_default();
        let target = self.target.as_deref().unwrap_or(host);
        let cpu = self.cpu.as_ref().map(|cpu| format!(", {cpu}")).unwrap_or_default();
        Ok(format!("{version} for {target}{cpu}"))
    }

    /// Compiles a crate and returns the object file.
    pub(crate) fn compile(&self, probe: &Probe, profile: Profile) -> Result<Vec<u8>, Error> {
        let folder = Folder::new(&probe.files)?;
        let object = folder.path().join(CRATE).with_extension("o");
        let mut command = Command::new(self.path());
        // The compiler's own temporary files are removed with the folder.
        for variable in ["TMPDIR", "TMP", "TEMP"] {
            command.env(variable, folder.path());
        }
        // With one codegen unit, all code is in one file.
        command.args([
            "--crate-type=lib",
            "--edition=2024",
            "-Ccodegen-units=1",
            "--cap-lints=allow",
        ]);
        command.args(["--crate-name", CRATE]).args(profile.flags());
        if probe.needs_std || self.dispatches() {
            command.args(["--cfg", "feature=\"std\""]);
        }
        if let Some(target) = &self.target {
            command.args(["--target", target]);
        }
        if let Some(cpu) = &self.cpu {
            command.arg(format!("-Ctarget-cpu={cpu}"));
        }
        // `--out-dir` would create the folder again if a signal has removed it.
        command.args(["--emit=obj", "-o"]).arg(&object);
        let output = self.run(command.arg(folder.path().join(ROOT_FILE)))?;
        // The compiler can ignore a processor that it does not know.
        let is_ignored = String::from_utf8_lossy(&output.stderr).contains(UNKNOWN_CPU);
        if !output.status.success() || is_ignored {
            return Err(self.refused(&output, folder.path()));
        }
        Ok(std::fs::read(object)?)
    }

    /// Whether the functions are compiled for several processors, as is the default on x86-64.
    fn dispatches(&self) -> bool {
        let target = self.target.as_deref();
        target.map_or(cfg!(target_arch = "x86_64"), |target| {
            target.starts_with("x86_64") && !target.contains("-none")
        })
    }

    fn path(&self) -> PathBuf {
        let variable = || std::env::var_os("RUSTC").filter(|value| !value.is_empty());
        let found = self.rustc.clone().or_else(|| variable().map(PathBuf::from));
        found.unwrap_or_else(|| PathBuf::from("rustc"))
    }

    fn run(&self, command: &mut Command) -> Result<Output, Error> {
        command.output().map_err(|error| {
            let path = self.path();
            let is_name = path.parent().is_some_and(|folder| folder.as_os_str().is_empty());
            let reason = match error.kind() {
                _ if path.is_dir() => "it is a folder".to_owned(),
                // A name without a folder is not that of a file in the current folder.
                ErrorKind::NotFound if is_name => "PATH has no program of this name".to_owned(),
                _ => system_reason(&error),
            };
            Error::NoCompiler { path, reason }
        })
    }

    fn refused(&self, output: &Output, folder: &Path) -> Error {
        let messages =
            String::from_utf8_lossy(&output.stderr).replace(&*folder.to_string_lossy(), "");
        let mut lines: Vec<&str> = messages.lines().collect();
        lines.dedup();
        let is_error = |line: &&&str| line.starts_with("error") || line.contains(UNKNOWN_CPU);
        let first = lines.iter().find(is_error).or(lines.first()).copied().unwrap_or_default();
        let first = if first.is_empty() { output.status.to_string() } else { first.to_owned() };
        let advice = self.advice(&messages);
        lines.truncate(SHOWN_LINES);
        Error::Compiler {
            path: self.path(),
            target: self.target.clone().unwrap_or_else(|| "this machine".to_owned()),
            first,
            advice,
            messages: lines.join("\n"),
        }
    }

    /// The remedy for messages with a known cause.
    fn advice(&self, messages: &str) -> Option<String> {
        let target = self.target.as_deref();
        if let Some(cpu) = self.cpu.as_deref().filter(|_| messages.contains(UNKNOWN_CPU)) {
            let of = target.map(|target| format!(" --target {target}")).unwrap_or_default();
            return Some(format!(
                "the target does not have the processor `{cpu}`: `rustc --print target-cpus{of}` \
                 lists its processors"
            ));
        }
        let target = target?;
        if messages.contains("could not find specification for target") {
            return Some(format!(
                "the target `{target}` is unknown: `rustc --print target-list` lists the known \
                 targets"
            ));
        }
        if messages.contains("can't find crate for `core`") {
            return Some(format!("install the target: `rustup target add {target}`"));
        }
        messages.contains("can't find crate for `std`").then(|| {
            format!(
                "{target} has no standard library, or it is not installed (`rustup target add \
                 {target}`): the option `trigonometry` with the value `polynomial` does not need \
                 one"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_compiler_is_an_error_with_a_remedy() {
        let compiler =
            Compiler { rustc: Some(PathBuf::from("/nowhere/rustc")), ..Compiler::default() };
        let message = compiler.description().unwrap_err().to_string();
        for part in ["/nowhere/rustc", "compiled with `rustc`", "the option `rustc`"] {
            assert!(message.contains(part), "{message}");
        }
        let compiler = Compiler { rustc: Some(PathBuf::from("no-rustc")), ..Compiler::default() };
        let message = compiler.description().unwrap_err().to_string();
        assert!(message.contains("PATH has no program of this name"), "{message}");
    }
}
