//! The page about a robot that is watched.

use std::ffi::OsString;
use std::path::PathBuf;

use robot_build::{Options, Source};
use robot_report::{Compiled, Input, Reloading, reloading};

use crate::failure::Failure;
use crate::files;

/// A page that reloads itself, and the picture beside it that tells it when.
pub(super) struct Page {
    path: PathBuf,
    /// The page last written, without what reloads it.
    still: Option<String>,
}

impl Page {
    pub(super) fn new(path: PathBuf) -> Page {
        Page { path, still: None }
    }

    fn picture(&self) -> PathBuf {
        let mut name = OsString::from(&self.path);
        name.push(".svg");
        PathBuf::from(name)
    }

    /// Writes the page of a robot, then the picture.
    pub(super) fn write(&mut self, source: &Source, options: &Options) -> Result<(), Failure> {
        let reason = "no compiler was started while the file was watched.".to_owned();
        let compiled = Compiled::Unread { reason };
        let Reloading { page, stamp, still } =
            reloading(&Input { source, options, compiled: &compiled })?;
        files::write(&self.path, page.as_bytes())?;
        files::write(&self.picture(), stamp.as_bytes())?;
        self.still = Some(still);
        Ok(())
    }

    /// Writes the last page as one that stays, and takes the picture away.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let Some(still) = &self.still else { return Ok(()) };
        files::write(&self.path, still.as_bytes())?;
        let picture = self.picture();
        std::fs::remove_file(&picture).map_err(|error| {
            Failure::input(format!("cannot remove {}: {error}", picture.display()))
        })
    }
}
