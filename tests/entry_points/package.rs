//! Packages outside the workspace.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A package in a separate folder.
pub(crate) struct Package {
    folder: PathBuf,
}

impl Package {
    /// Creates an empty package `name`; `tables` are the `[…]` tables that follow its name in the manifest.
    ///
    /// The packages share a target folder, which keeps their dependencies between runs, and use the versions in this
    /// workspace's lock file, so that nothing is downloaded.
    pub(crate) fn new(name: &str, tables: &str) -> Package {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("entry-points").join(name);
        let _ = std::fs::remove_dir_all(&folder);
        let package = Package { folder };
        let head = format!(
            "[workspace]\n\n[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n"
        );
        package.write("Cargo.toml", &format!("{head}\n{tables}"));
        let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.lock");
        package.write("Cargo.lock", &std::fs::read_to_string(lock).unwrap());
        package
    }

    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    pub(crate) fn write(&self, file: &str, text: &str) {
        let path = self.path(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// Runs Cargo in the package with the given compiler flags.
    fn cargo(&self, arguments: &[&str], flags: &str) -> Output {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap());
        command.current_dir(&self.folder).args(arguments).arg("--offline");
        // The environment variables with which the test itself was built must not affect the package.
        for (variable, _) in std::env::vars_os() {
            let name = variable.to_string_lossy();
            if name.starts_with("CARGO") && !["CARGO", "CARGO_HOME"].contains(&&*name) {
                command.env_remove(&variable);
            }
        }
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("entry-points-target");
        command.env("CARGO_TARGET_DIR", target).env("RUSTFLAGS", flags).output().unwrap()
    }

    /// Runs the package's program and returns its output.
    pub(crate) fn run(&self, arguments: &[&str]) -> String {
        self.run_with(arguments, "")
    }

    /// Runs the program like [`Package::run`], built with compiler flags.
    pub(crate) fn run_with(&self, arguments: &[&str], flags: &str) -> String {
        let output = self.cargo(arguments, flags);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "cargo {arguments:?}\n{errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Whether a build has nothing to do.
    pub(crate) fn is_fresh(&self) -> bool {
        let output = self.cargo(&["build"], "");
        assert!(output.status.success());
        !String::from_utf8_lossy(&output.stderr).contains("Compiling")
    }

    /// Sets the time of a file to the current time, as `robot-symbolic search` does with the robot file.
    pub(crate) fn touch(&self, file: &str) {
        let file = std::fs::OpenOptions::new().append(true).open(self.path(file)).unwrap();
        file.set_modified(std::time::SystemTime::now()).unwrap();
    }

    /// Asserts that a plan beside `robots/arm.toml` is noticed when it is created after the first build and when it is
    /// removed, and that nothing is rebuilt in between.
    pub(crate) fn assert_notices_plans(&self) {
        self.run(&["build"]);
        assert!(self.is_fresh());
        // An invalid plan stops the build, which shows that the plan was read.
        self.write("robots/arm.plan", "no plan");
        self.touch("robots/arm.toml");
        let messages = self.failure(&["build"]);
        assert!(messages.contains("robots/arm.plan: line 1 is not that of a plan"), "{messages}");
        std::fs::remove_file(self.path("robots/arm.plan")).unwrap();
        self.run(&["build"]);
        assert!(self.is_fresh());
    }

    /// Runs Cargo, which must fail, and returns its messages.
    pub(crate) fn failure(&self, arguments: &[&str]) -> String {
        let output = self.cargo(arguments, "");
        assert!(!output.status.success());
        String::from_utf8(output.stderr).unwrap()
    }
}

/// The line `name = { path = "…" … }` for a crate of this workspace.
pub(crate) fn dependency(name: &str, more: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates").join(name);
    format!("{name} = {{ path = {folder:?}{more} }}\n")
}
