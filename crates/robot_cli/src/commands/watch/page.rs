//! The page about a robot that is watched.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use robot_build::{Options, Output, Ownership, Source, Writer, shown};
use robot_report::{Compiled, Input, Reloading, reloading};

use crate::commands::report::judge;
use crate::failure::Failure;

/// A page that reloads itself, and the picture beside it that tells it when.
pub(super) struct Page {
    path: PathBuf,
    writer: Writer,
    /// The page last written, without what reloads it.
    still: Option<String>,
}

impl Page {
    /// A page that has been found to be free to be written.
    pub(super) fn open(path: PathBuf, writer: Writer) -> Result<Page, Failure> {
        let page = Page { path, writer, still: None };
        let picture = page.picture();
        let files = [&page.path, &picture].map(|path| (path.as_path(), Ownership::Marked));
        page.writer.check(&files)?;
        Ok(page)
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
            reloading(&Input { source, options, compiled: &compiled, judge })?;
        self.writer.write(&[marked(&self.path, &page), marked(&self.picture(), &stamp)])?;
        self.still = Some(still);
        Ok(())
    }

    /// Writes the last page as one that stays, and takes the picture away.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let Some(still) = &self.still else { return Ok(()) };
        self.writer.write(&[marked(&self.path, still)])?;
        let picture = self.picture();
        std::fs::remove_file(&picture)
            .map_err(|error| Failure::input(format!("cannot remove {}: {error}", shown(&picture))))
    }
}

fn marked<'a>(path: &Path, text: &'a str) -> Output<'a> {
    Output { path: path.to_owned(), bytes: text.as_bytes(), ownership: Ownership::Marked }
}
