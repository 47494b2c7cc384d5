//! Packages outside of the workspace.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A package in a folder of its own.
pub(crate) struct Package {
    folder: PathBuf,
}

impl Package {
    /// An empty package `name` with the `[…]` tables of a manifest that follow its name.
    ///
    /// The packages share a target folder, which keeps their dependencies between runs, and the
    /// versions of this workspace's lock file, so that nothing is downloaded.
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

    /// Runs Cargo in the package, with flags for the compiler.
    fn cargo(&self, arguments: &[&str], flags: &str) -> Output {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap());
        command.current_dir(&self.folder).args(arguments).arg("--offline");
        // What the test itself was built with does not concern the package.
        for (variable, _) in std::env::vars_os() {
            let name = variable.to_string_lossy();
            if name.starts_with("CARGO") && !["CARGO", "CARGO_HOME"].contains(&&*name) {
                command.env_remove(&variable);
            }
        }
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("entry-points-target");
        command.env("CARGO_TARGET_DIR", target).env("RUSTFLAGS", flags).output().unwrap()
    }

    /// What the package's program prints.
    pub(crate) fn run(&self, arguments: &[&str]) -> String {
        self.run_with(arguments, "")
    }

    /// The same, built with flags for the compiler.
    pub(crate) fn run_with(&self, arguments: &[&str], flags: &str) -> String {
        let output = self.cargo(arguments, flags);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "cargo {arguments:?}\n{errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Whether a build finds nothing to do.
    pub(crate) fn is_fresh(&self) -> bool {
        let output = self.cargo(&["build"], "");
        assert!(output.status.success());
        !String::from_utf8_lossy(&output.stderr).contains("Compiling")
    }

    /// Sets the time of a file to now, as `robot-symbolic search` does with the robot file.
    pub(crate) fn touch(&self, file: &str) {
        let file = std::fs::OpenOptions::new().append(true).open(self.path(file)).unwrap();
        file.set_modified(std::time::SystemTime::now()).unwrap();
    }

    /// Asserts that a plan beside `robots/arm.toml` is noticed when it comes after the first build, and when it
    /// goes, and that nothing is built again meanwhile.
    pub(crate) fn assert_notices_plans(&self) {
        self.run(&["build"]);
        assert!(self.is_fresh());
        // A plan that stops the build shows that it was read.
        self.write("robots/arm.plan", "no plan");
        self.touch("robots/arm.toml");
        let messages = self.failure(&["build"]);
        assert!(messages.contains("robots/arm.plan: TOML parse error"), "{messages}");
        std::fs::remove_file(self.path("robots/arm.plan")).unwrap();
        self.run(&["build"]);
        assert!(self.is_fresh());
    }

    /// What Cargo says where it fails.
    pub(crate) fn failure(&self, arguments: &[&str]) -> String {
        let output = self.cargo(arguments, "");
        assert!(!output.status.success());
        String::from_utf8(output.stderr).unwrap()
    }
}

/// `name = { path = "…" … }` for a crate of this workspace.
pub(crate) fn dependency(name: &str, more: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates").join(name);
    format!("{name} = {{ path = {folder:?}{more} }}\n")
}
