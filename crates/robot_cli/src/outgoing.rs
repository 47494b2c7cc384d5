//! Output of long texts to standard output or to a file, with one piece at a time in memory.

use std::io::Write;
use std::path::Path;

use robot_build::Pending;
use robot_simulation::Table;

use crate::delivery::{named, size};
use crate::failure::Failure;

/// The length up to which text is held back, so that nothing is printed if the work fails early.
const HELD: usize = 1 << 16;

/// A text that is written piece by piece. A file is put in its place when it is complete; standard output gets a
/// piece as soon as it is long enough, and the last one at the end.
pub(crate) struct Outgoing<'t> {
    destination: Destination<'t>,
    errors: &'t mut dyn Write,
    text: String,
    /// Lines for standard error, which are printed before the waiting text.
    warnings: String,
}

enum Destination<'t> {
    Standard(&'t mut dyn Write),
    File(Pending, &'t Path),
}

impl<'t> Outgoing<'t> {
    /// Starts a text for a file, or for standard output if there is no file.
    pub(crate) fn new(
        file: Option<(Pending, &'t Path)>,
        output: &'t mut dyn Write,
        errors: &'t mut dyn Write,
    ) -> Outgoing<'t> {
        let standard = Destination::Standard(output);
        let destination = file.map_or(standard, |(file, path)| Destination::File(file, path));
        let (text, warnings) = (String::with_capacity(2 * HELD), String::new());
        Outgoing { destination, errors, text, warnings }
    }

    /// Appends the text that `write` appends.
    pub(crate) fn push(&mut self, write: impl FnOnce(&mut String)) -> Result<(), Failure> {
        write(&mut self.text);
        if self.text.len() >= HELD { self.write() } else { Ok(()) }
    }

    /// Appends the rows of a table; the first part has a header.
    pub(crate) fn push_table(&mut self, table: &Table, is_first: bool) -> Result<(), Failure> {
        if is_first {
            self.push(|text| text.push_str(&table.header()))?;
        }
        (0..table.rows()).try_for_each(|row| self.push(|text| table.push_row(row, text)))
    }

    /// Appends lines to standard error.
    pub(crate) fn warn(&mut self, lines: &str) {
        self.warnings.push_str(lines);
    }

    /// Writes the waiting text, and puts a file in its place. `others` writes other outputs: before the last piece is
    /// written to standard output, or when the file is complete but not yet in its place.
    pub(crate) fn end(
        mut self,
        others: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if let Destination::File(..) = self.destination {
            self.write()?;
        }
        others(self.errors)?;
        self.write()?;
        if let Destination::File(file, path) = self.destination
            && let Some(length) = file.put()?
        {
            writeln!(self.errors, "wrote {} ({})", named(path), size(length as usize))?;
        }
        Ok(())
    }

    fn write(&mut self) -> Result<(), Failure> {
        self.errors.write_all(self.warnings.as_bytes())?;
        match &mut self.destination {
            Destination::Standard(output) => output.write_all(self.text.as_bytes())?,
            Destination::File(file, _) => file.write(self.text.as_bytes())?,
        }
        self.warnings.clear();
        self.text.clear();
        Ok(())
    }
}
