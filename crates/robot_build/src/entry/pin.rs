//! Pinned plans next to robot files: `panda.plan` next to `panda.toml`.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use robot_dynamics::economical::mechanics;
use robot_dynamics::economical::pin::Pin;
use robot_dynamics::economical::search::Found;
use robot_model::robot::Robot;

use crate::driver::options::Options;
use crate::entry::files::{MARKER, is_marked};
use crate::entry::paths::RobotFile;
use crate::entry::system::system_reason;
use crate::error::{Error, Errors};

/// The largest number of bytes of a pinned plan; real ones have a few kilobytes.
const MAX_BYTES: u64 = 1 << 20;

/// The remedy for a plan that a search wrote.
const AGAIN: &str = "search for a plan again, or remove the file";

/// The path of a robot file's pinned plan, which is next to it. The ending `plan` replaces `toml` and is appended to
/// any other, so that `ur5.toml`, imported from `ur5.urdf`, has a plan of its own.
#[must_use]
pub fn pin_path(robot: &Path) -> PathBuf {
    match robot.extension().and_then(OsStr::to_str) {
        None | Some("toml") => robot.with_extension("plan"),
        Some(other) => robot.with_extension(format!("{other}.plan")),
    }
}

/// The files that are read for a robot: its file, and its pinned plan, which does not have to exist.
#[must_use]
pub fn robot_inputs(robot: &Path) -> [PathBuf; 2] {
    // A path that is not a link stays as it was given, for messages.
    let followed = if robot.is_symlink() { robot.canonicalize().ok() } else { None };
    [robot.to_owned(), pin_path(followed.as_deref().unwrap_or(robot))]
}

/// The text of the file with the plan that a search found for a robot.
#[must_use]
pub fn pin_text(robot: &Robot, found: &Found) -> String {
    let mut pin = Pin {
        fingerprint: fingerprint(robot),
        digest: String::new(),
        measure: found.measure,
        operations: found.operations,
        tuned: found.tuned,
        plan: found.plan.clone(),
    };
    pin.digest = digest(&pin.content());
    format!("# {MARKER}\n{}", pin.to_text())
}

impl RobotFile {
    /// Returns the options with the pinned plan of the file, if there is one and the options have
    /// none.
    ///
    /// # Errors
    ///
    /// [`Error::Pin`] if a pinned plan is stale, that is, made for [mechanics](mechanics()) other than those of the
    /// file, was edited, or cannot be read. If there is a pinned plan, also all errors in the robot file.
    pub fn with_pin(&self, options: &Options) -> Result<Options, Errors> {
        let path = pin_path(&self.path);
        // A symbolic link to a missing file counts as existing.
        if options.plan.is_some() || std::fs::symlink_metadata(&path).is_err() {
            return Ok(options.clone());
        }
        let failed = |reason: String| {
            let robot = self.source.name.clone();
            // A search does not replace a file that none wrote.
            let is_own = path.is_file() && is_marked(&path).unwrap_or_default();
            let remedy = if is_own { AGAIN } else { "move it away" };
            Errors::from(Error::Pin { path: pin_path(Path::new(&robot)), robot, reason, remedy })
        };
        let pin = read_pin(&path).map_err(failed)?;
        if pin.digest != digest(&pin.content()) {
            return Err(failed("the pinned plan was edited after the search wrote it".to_owned()));
        }
        let robot = crate::read_with(&self.source, options)?.robot;
        if pin.fingerprint != fingerprint(&robot) {
            return Err(failed(format!(
                "the pinned plan is stale: the robot's mechanics have changed since the search, \
                 when inverse dynamics took {} operations",
                pin.operations
            )));
        }
        if !pin.plan.fits(robot.links.len()) {
            return Err(failed(
                "the pinned plan does not match the links of this robot".to_owned(),
            ));
        }
        Ok(Options { plan: Some(pin.plan), ..options.clone() })
    }
}

/// Reads the pinned plan in a file; the error is the reason why it cannot be read.
fn read_pin(path: &Path) -> Result<Pin, String> {
    let found = std::fs::metadata(path).map_err(|error| match std::fs::read_link(path) {
        Ok(target) if error.kind() == ErrorKind::NotFound => {
            format!("the pinned plan is a link to `{}`, which does not exist", target.display())
        }
        _ => system_reason(&error),
    })?;
    if !found.is_file() {
        return Err("a pinned plan must be a regular file, and this one is not".to_owned());
    }
    let size = found.len();
    if size > MAX_BYTES {
        return Err(format!("the file has {size} bytes, too many for a pinned plan"));
    }
    let text = std::fs::read_to_string(path).map_err(|error| system_reason(&error))?;
    Pin::from_text(&text).map_err(|error| error.to_string())
}

fn fingerprint(robot: &Robot) -> String {
    digest(&mechanics(robot))
}

fn digest(text: &str) -> String {
    hmac_sha256::Hash::hash(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use robot_dynamics::economical::Plan;
    use robot_dynamics::economical::search::Measure;

    use super::*;

    const ROBOT: &str = "format = 1\n[robot]\nname = \"pendulum\"\n[[link]]\nname = \"1\"\n\
        joint = { type = \"revolute\", axis = \"y\" }\nmass = 2\n\
        center_of_mass = [0.5, 0, 0]\ninertia = { xx = 0, yy = 0, zz = 0 }\n";

    fn found(plan: Plan) -> Found {
        Found {
            plan,
            measure: Measure::Operations,
            operations: 7,
            instructions: 5,
            tried: 1,
            cut_short: false,
            tuned: false,
        }
    }

    #[test]
    fn a_robot_file_and_the_urdf_it_comes_from_have_pins_of_their_own() {
        let pin = |robot: &str| pin_path(Path::new(robot));
        assert_eq!(pin("arms/ur5.toml"), Path::new("arms/ur5.plan"));
        assert_eq!(pin("arms/ur5.urdf"), Path::new("arms/ur5.urdf.plan"));
        assert_eq!([pin("ur5"), pin("ur.5")], ["ur5.plan", "ur.5.plan"].map(PathBuf::from));
    }

    #[test]
    fn a_plan_that_no_search_wrote_is_refused() {
        let name = format!("robot_build_edited_pin_{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("pendulum.toml");
        std::fs::write(&path, ROBOT).unwrap();
        let file = RobotFile::read(&path).unwrap();
        let robot = crate::read(&file.source).unwrap().robot;
        let found = found(Plan::default_for(&robot));
        let text = pin_text(&robot, &found);
        let pinned = |text: &str| {
            std::fs::write(pin_path(&path), text).unwrap();
            file.with_pin(&Options::default())
        };
        let error = pinned(&text.replace("operations = 7", "operations = 6")).unwrap_err();
        let reason = "was edited after the search wrote it";
        assert!(error.to_string().contains(reason), "{error}");
        // A file can be too long for a plan.
        let filled = |bytes: u64| {
            let rest = usize::try_from(bytes).unwrap() - text.len();
            pinned(&format!("{text}#{}\n", "-".repeat(rest - 2)))
        };
        assert!(filled(MAX_BYTES).is_ok());
        let error = filled(MAX_BYTES + 1).unwrap_err().to_string();
        assert!(error.contains("has 1048577 bytes, too many for a pinned plan"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_pin_is_taken_and_a_stale_one_refused() {
        let folder = std::env::temp_dir().join(format!("robot_build_pin_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("pendulum.toml");
        std::fs::write(&path, ROBOT).unwrap();
        let options = Options::default();
        let file = RobotFile::read(&path).unwrap();
        assert_eq!(file.with_pin(&options).unwrap(), options);

        let robot = crate::read(&file.source).unwrap().robot;
        let plan = Plan { unit_length: Some((0, 1)), ..Plan::default_for(&robot) };
        let found = found(plan.clone());
        std::fs::write(pin_path(&path), pin_text(&robot, &found)).unwrap();
        assert_eq!(file.with_pin(&options).unwrap().plan, Some(plan));

        // A pin that was edited to a plan without links is an error.
        let empty = Plan { links: vec![], unit_length: None };
        let options_with_plan = Options { plan: Some(empty), ..options.clone() };
        assert!(crate::programs(&file.source, &options_with_plan).is_err());

        // A pin with the mechanics of this robot and the links of another.
        let longer = Found { plan: Plan { links: vec![], unit_length: None }, ..found.clone() };
        std::fs::write(pin_path(&path), pin_text(&robot, &longer)).unwrap();
        let error = file.with_pin(&options).unwrap_err().to_string();
        assert!(error.contains("does not match the links of this robot"), "{error}");
        // A folder at the path of the plan is a plan that cannot be read.
        std::fs::remove_file(pin_path(&path)).unwrap();
        std::fs::create_dir(pin_path(&path)).unwrap();
        let error = file.with_pin(&options).unwrap_err().to_string();
        assert!(error.contains("a pinned plan must be a regular file"), "{error}");
        std::fs::remove_dir(pin_path(&path)).unwrap();
        std::fs::write(pin_path(&path), pin_text(&robot, &found)).unwrap();

        // Remarks and other text that does not concern the mechanics do not make the pin stale.
        let remarked =
            ROBOT.replace("[robot]\n", "# a remark\n[robot]\ndescription = \"swings\"\n");
        std::fs::write(&path, remarked).unwrap();
        assert!(RobotFile::read(&path).unwrap().with_pin(&options).unwrap().plan.is_some());

        std::fs::write(&path, ROBOT.replace("mass = 2", "mass = 3")).unwrap();
        let changed = RobotFile::read(&path).unwrap();
        let error = changed.with_pin(&options).unwrap_err().to_string();
        let remedy = "search for a plan again";
        for part in ["stale", "took 7 operations", remedy] {
            assert!(error.contains(part), "{part} is not in {error}");
        }
        for format in [1, 2] {
            let earlier =
                pin_text(&robot, &found).replace("format = 3", &format!("format = {format}"));
            std::fs::write(pin_path(&path), earlier).unwrap();
            let error = changed.with_pin(&options).unwrap_err().to_string();
            assert!(
                error.contains(&format!("format {format}")) && error.contains(remedy),
                "{error}"
            );
        }
        std::fs::write(pin_path(&path), "format = 4").unwrap();
        assert!(changed.with_pin(&options).is_err());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
