//! Pinned plans beside robot files: `panda.plan` beside `panda.toml`.

use std::path::{Path, PathBuf};

use robot_dynamics::diagnostic::Source;
use robot_dynamics::economical::pin::Pin;
use robot_dynamics::economical::search::Found;
use sha2::{Digest, Sha256};

use crate::error::{Error, Errors};
use crate::options::Options;
use crate::paths::RobotFile;

/// A pin is a few kilobytes; a larger file is none.
const MAX_BYTES: u64 = 1 << 20;

/// Where the pin of a robot file lies: beside it, with the ending `plan`.
#[must_use]
pub fn pin_path(robot: &Path) -> PathBuf {
    robot.with_extension("plan")
}

/// The text of a pin of what a search found for a robot file.
#[must_use]
pub fn pin_text(source: &Source, options: &Options, found: &Found) -> String {
    let pin = Pin {
        fingerprint: fingerprint(source, options),
        operations: found.operations,
        plan: found.plan.clone(),
    };
    pin.to_text()
}

impl RobotFile {
    /// The options with the plan that is pinned beside the file, where one is and the options give
    /// none.
    ///
    /// # Errors
    ///
    /// A pin that is stale: made for another text of the file or another snapping tolerance; one
    /// that cannot be read.
    pub fn with_pin(&self, options: &Options) -> Result<Options, Errors> {
        let path = pin_path(&self.path);
        if options.plan.is_some() || !path.is_file() {
            return Ok(options.clone());
        }
        let failed = |reason: String| {
            let robot = self.source.name.clone();
            Errors::from(Error::Pin { path: pin_path(Path::new(&robot)), robot, reason })
        };
        let size = std::fs::metadata(&path).map_err(|error| failed(error.to_string()))?.len();
        if size > MAX_BYTES {
            return Err(failed(format!("the file has {size} bytes, which no pinned plan has")));
        }
        let text = std::fs::read_to_string(&path).map_err(|error| failed(error.to_string()))?;
        let pin = Pin::from_text(&text).map_err(|error| failed(error.to_string()))?;
        if pin.fingerprint != fingerprint(&self.source, options) {
            let reason = "the pinned plan is stale: it was searched for another text of the robot \
                          file or another snapping tolerance";
            return Err(failed(reason.to_owned()));
        }
        Ok(Options { plan: Some(pin.plan), ..options.clone() })
    }
}

fn fingerprint(source: &Source, options: &Options) -> String {
    let mut hash = Sha256::new();
    hash.update(source.text.as_bytes());
    hash.update(options.snap.to_bits().to_le_bytes());
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
