//! Commands as users type them: the built command in a shell, in a folder with the robots.

use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// A folder with the robot files in `robots` and the paper's equations in `docs`, and the path of the
/// built command.
pub(crate) struct Shell {
    folder: TempDir,
    path: std::ffi::OsString,
}

/// The result of a script.
pub(crate) struct Done {
    pub(crate) code: Option<i32>,
    pub(crate) output: String,
    pub(crate) errors: String,
}

impl Shell {
    /// Makes a new folder outside of this workspace, so that Cargo does not regard its packages as members.
    pub(crate) fn new() -> Shell {
        let folder = TempDir::new().unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let robots = root.join("robots");
        std::fs::create_dir(folder.path().join("robots")).unwrap();
        for entry in std::fs::read_dir(robots).unwrap() {
            let path = entry.unwrap().path();
            std::fs::copy(&path, folder.path().join("robots").join(path.file_name().unwrap()))
                .unwrap();
        }
        let printed = "docs/trttr1.printed";
        std::fs::create_dir(folder.path().join("docs")).unwrap();
        std::fs::copy(root.join(printed), folder.path().join(printed)).unwrap();
        let built = Path::new(env!("CARGO_BIN_EXE_robot-symbolic")).parent().unwrap().to_owned();
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders = std::iter::once(built).chain(std::env::split_paths(&path));
        Shell { folder, path: std::env::join_paths(folders).unwrap() }
    }

    /// Writes a file into the folder.
    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// Runs a script, which ends if a command fails. Cargo builds into a separate folder.
    pub(crate) fn run(&self, script: &str) -> Done {
        let output = Command::new("sh")
            .args(["-eu", "-c", script])
            .current_dir(&self.folder)
            .env("PATH", &self.path)
            .env("CARGO_TARGET_DIR", self.folder.path().join("target"))
            .env("CARGO_TERM_COLOR", "never")
            .stdin(Stdio::null())
            .output()
            .unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Done {
            code: output.status.code(),
            output: text(output.stdout),
            errors: text(output.stderr),
        }
    }
}
