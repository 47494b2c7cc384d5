//! The page about a watched robot.

use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use robot_build::{
    Errors, Options, Output, Ownership, Source, Writer, sealed, shown, system_reason,
};
use robot_report::{Compiled, Reloading, reloading};

use crate::commands::report::{PAGE, input};
use crate::failure::Failure;

/// A page that reloads itself, and the picture next to it that triggers the reload.
pub(super) struct Page {
    path: PathBuf,
    writer: Writer,
    last: Option<Last>,
}

/// The last texts that were written.
struct Last {
    /// The page without the part that reloads it.
    still: String,
    /// The picture.
    stamp: String,
}

impl Page {
    /// Prepares a page, after checking that its files may be written.
    pub(super) fn open(path: PathBuf, writer: Writer) -> Result<Page, Failure> {
        writer.check(&[(&path, Ownership::Edited)])?;
        PAGE.check(&path)?;
        let page = Page { path, writer, last: None };
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

    /// Makes the page of a robot.
    ///
    /// # Errors
    ///
    /// A robot for which a page cannot be made.
    pub(super) fn made(source: &Source, options: &Options) -> Result<Reloading, Errors> {
        let reason = "the page was made without a compiler, because `watch` wrote it.".to_owned();
        let compiled = Compiled::Unread { reason };
        // A page that reloads itself would lose the positions of its sliders.
        reloading(&input(source, options, &compiled, false))
    }

    /// Describes the file at the path if a page cannot be made.
    pub(super) fn described(&self) -> String {
        let path = shown(&self.path);
        match self.last {
            None => format!("the page {path} is not written yet"),
            Some(_) => {
                format!("no page can be made for this robot; {path} still shows the last one")
            }
        }
    }

    /// Writes the page, then the picture.
    pub(super) fn write(&mut self, made: Reloading) -> Result<(), Failure> {
        let Reloading { page, stamp, still } = made;
        // A page that was edited meanwhile is not replaced, unless forced to.
        let page = sealed(&page);
        self.writer.write(&[marked(&self.path, &page), marked(&self.picture(), &stamp)])?;
        self.last = Some(Last { still, stamp });
        Ok(())
    }

    /// Writes the last page without the part that reloads it, and removes the picture, even if the page cannot be
    /// written.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let Some(last) = &self.last else { return Ok(()) };
        let written = self.writer.write(&[marked(&self.path, &sealed(&last.still))]);
        let removed = remove(&self.picture(), &last.stamp);
        written?;
        removed
    }
}

/// Removes a file if it has this text. A file with another text was written by another watch or replaced by the user.
fn remove(path: &Path, text: &str) -> Result<(), Failure> {
    let is_regular = std::fs::metadata(path).is_ok_and(|found| found.is_file());
    if !is_regular || !std::fs::read(path).is_ok_and(|present| present == text.as_bytes()) {
        return Ok(());
    }
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(Failure::input(format!("cannot remove {}: {}", shown(path), system_reason(&error))))
        }
        _ => Ok(()),
    }
}

fn marked<'a>(path: &Path, text: &'a str) -> Output<'a> {
    Output { path: path.to_owned(), bytes: text.as_bytes(), ownership: Ownership::Marked }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture that cannot be removed is an error; a picture that no longer exists or that has another text is not.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_picture_that_cannot_be_removed_is_reported() {
        // Nobody may remove it.
        let path = Path::new("/proc/version");
        let text = std::fs::read_to_string(path).unwrap();
        let refused = remove(path, &text).unwrap_err();
        let Failure::Input(messages) = refused else { panic!("{refused:?}") };
        assert!(messages[0].starts_with("cannot remove /proc/version: "), "{messages:?}");
        assert!(remove(path, "another text").is_ok());
        assert!(remove(Path::new("/proc/none"), &text).is_ok());
        assert!(remove(Path::new("/proc"), "").is_ok());
    }
}
