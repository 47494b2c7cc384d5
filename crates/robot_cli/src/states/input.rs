//! The source of states: a file, or a stream that can be read only once.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Error, Read, Result, Seek, SeekFrom, Write};
use std::path::Path;

use robot_build::system_reason;
use robot_simulation::csv::{Lines, is_blank, not_utf8};

use super::exponents::Exponents;
use super::{Layout, Sink, State, csv, json};
use crate::failure::Failure;
use crate::files;

/// The number of bytes that are read at a time.
const CHUNK: usize = 1 << 16;
/// The largest number of bytes of a file that are examined to find its format, and that of the bytes of a state.
const MAX_BYTES: u64 = 1 << 20;
/// The number of bytes up to which a stream that is read twice is kept in memory; longer ones are kept on the disk.
const KEPT: usize = 1 << 20;
const MARK: &[u8] = "\u{feff}".as_bytes();

/// States that can be read, and read again if necessary.
pub(crate) struct Input<'t> {
    name: String,
    format: Format,
    /// The bytes up to the first line that is not blank, with at least a long part of this line.
    beginning: Vec<u8>,
    rest: Rest<'t>,
}

enum Rest<'t> {
    Stream(BufReader<Box<dyn Read + 't>>),
    /// A source that can be read again, with the position of the rest.
    Again(BufReader<Box<dyn Again>>, u64),
}

/// A source that can be read again.
trait Again: Read + Seek {}

impl<T: Read + Seek> Again for T {}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    JsonArray,
    /// A JSON object, which is not an array of states.
    JsonObject,
}

impl<'t> Input<'t> {
    /// Opens a file; `-` is standard input.
    pub(crate) fn open(
        path: &Path,
        standard: &'t mut dyn Read,
    ) -> std::result::Result<Input<'t>, Failure> {
        let (name, bytes) = files::open(path, standard)?;
        let mut rest = match bytes {
            files::Bytes::File(file) => Rest::again(file, 0),
            files::Bytes::Stream(stream) => Rest::Stream(BufReader::with_capacity(CHUNK, stream)),
        };
        let mut beginning = vec![];
        let read = rest.beginning(&mut beginning);
        read.map_err(|error| files::cannot_read(&name, &error))?;
        let format = Format::of(&beginning);
        Ok(Input { name, format, beginning, rest })
    }

    /// The name for messages.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Whether a state has a wrench that is not 0. If the states have to be read for this, they can be read again.
    pub(crate) fn has_wrench(&mut self, layout: &Layout) -> std::result::Result<bool, Failure> {
        if !self.may_have_wrench(layout).map_err(|error| files::cannot_read(&self.name, &error))? {
            return Ok(false);
        }
        let mut search = Search(false);
        self.read(layout, &mut search)?;
        Ok(search.0)
    }

    /// Whether the columns or the keys could be those of a wrench.
    fn may_have_wrench(&mut self, layout: &Layout) -> Result<bool> {
        if self.format == Format::Csv {
            let header = String::from_utf8_lossy(&self.beginning);
            if !csv::has_wrench(header.trim().trim_start_matches('\u{feff}'), layout) {
                return Ok(false);
            }
            self.rest.keep()?;
            return Ok(true);
        }
        self.rest.keep()?;
        // No other key contains a `w`, and in an escaped key there is a backslash.
        let hints = |bytes: &[u8]| bytes.contains(&b'w') || bytes.contains(&b'\\');
        let mut found = hints(&self.beginning);
        self.rest.rewind()?;
        let rest = self.rest.reader();
        while !found {
            let chunk = rest.fill_buf()?;
            if chunk.is_empty() {
                break;
            }
            found = hints(chunk);
            let length = chunk.len();
            rest.consume(length);
        }
        Ok(found)
    }

    /// Reads the states, a JSON array of objects or CSV with a header, and passes them and a message for each error to
    /// `sink`. One state is in memory at a time.
    ///
    /// # Errors
    ///
    /// An input that cannot be read or is not text.
    pub(crate) fn read<'l>(
        &mut self,
        layout: &'l Layout,
        sink: &mut dyn Sink<'l>,
    ) -> std::result::Result<(), Failure> {
        let name = &self.name;
        self.rest.rewind().map_err(|error| files::cannot_read(name, &error))?;
        if self.format == Format::Csv {
            let text = self.beginning.chain(self.rest.reader());
            return csv::read(&mut Lines::new(name, text), layout, sink);
        }
        let beginning = self.beginning.strip_prefix(MARK).unwrap_or(&self.beginning);
        let offset = (self.beginning.len() - beginning.len()) as u64;
        let budget = Budget::default();
        let text = beginning.chain(self.rest.reader());
        let exponents = Exponents::default();
        let text =
            Text { name, reader: text, offset, unchecked: vec![], exponents, budget: &budget };
        let is_array = self.format == Format::JsonArray;
        json::read(BufReader::with_capacity(CHUNK, text), is_array, &budget, layout, sink)
    }
}

impl Format {
    fn of(beginning: &[u8]) -> Format {
        let text = String::from_utf8_lossy(beginning);
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        match text.trim_start().chars().next() {
            Some('[') => Format::JsonArray,
            Some('{') => Format::JsonObject,
            _ => Format::Csv,
        }
    }
}

impl<'t> Rest<'t> {
    fn again(source: impl Again + 'static, start: u64) -> Rest<'t> {
        Rest::Again(BufReader::with_capacity(CHUNK, Box::new(source)), start)
    }

    fn reader(&mut self) -> &mut dyn BufRead {
        match self {
            Rest::Stream(reader) => reader,
            Rest::Again(reader, _) => reader,
        }
    }

    /// Reads the bytes up to the first line that is not blank.
    fn beginning(&mut self, beginning: &mut Vec<u8>) -> Result<()> {
        let mut left = MAX_BYTES;
        loop {
            let start = beginning.len();
            let read = self.reader().take(left).read_until(b'\n', beginning)? as u64;
            left -= read;
            if read == 0 || left == 0 || !is_blank(&beginning[start..]) {
                break;
            }
        }
        if let Rest::Again(_, start) = self {
            *start = beginning.len() as u64;
        }
        Ok(())
    }

    /// Stores a stream, so that it can be read again.
    fn keep(&mut self) -> Result<()> {
        if let Rest::Stream(reader) = self {
            let mut kept = tempfile::SpooledTempFile::new(KEPT);
            copy(reader, &mut kept)?;
            *self = Rest::again(kept, 0);
        }
        Ok(())
    }

    /// Returns to the start of a source that can be read again.
    fn rewind(&mut self) -> Result<()> {
        match self {
            Rest::Stream(_) => Ok(()),
            Rest::Again(reader, start) => reader.seek(SeekFrom::Start(*start)).map(drop),
        }
    }
}

/// Copies a stream to memory or, beyond [`KEPT`] bytes, to a temporary file.
///
/// # Errors
///
/// The stream cannot be read, or the temporary file cannot be written; the message then names its folder.
fn copy(stream: &mut dyn BufRead, kept: &mut tempfile::SpooledTempFile) -> Result<()> {
    loop {
        let block = stream.fill_buf()?;
        if block.is_empty() {
            return Ok(());
        }
        kept.write_all(block).map_err(|error| {
            let (folder, reason) = (std::env::temp_dir(), system_reason(&error));
            Error::other(format!(
                "it cannot be stored in a temporary file in {}: {reason}; write it to a file, or set another folder for \
                 temporary files (TMPDIR, on Windows TMP)",
                folder.display()
            ))
        })?;
        let length = block.len();
        stream.consume(length);
    }
}

/// A sink that finds out whether any state has a wrench.
struct Search(bool);

impl<'l> Sink<'l> for Search {
    fn state(&mut self, state: &mut State<'l>) -> std::ops::ControlFlow<()> {
        self.0 = state.has_wrench();
        if self.0 { std::ops::ControlFlow::Break(()) } else { std::ops::ControlFlow::Continue(()) }
    }

    fn error(&mut self, _: String) {}

    fn no_states(&mut self, _: String) {}
}

/// The number of bytes that were read for one element of an array, which must not exceed a mebibyte.
#[derive(Default)]
pub(super) struct Budget {
    element: Cell<usize>,
    read: Cell<u64>,
}

impl Budget {
    /// Starts the element with this number.
    pub(super) fn renew(&self, element: usize) {
        self.element.set(element);
        self.read.set(0);
    }
}

/// A reader that checks that bytes are UTF-8, and that no number is below the range of `f64`.
struct Text<'i, R> {
    name: &'i str,
    reader: R,
    /// The offset of the unchecked bytes in the file.
    offset: u64,
    /// The start of a character whose end has not been read yet.
    unchecked: Vec<u8>,
    exponents: Exponents,
    budget: &'i Budget,
}

impl<R: Read> Read for Text<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let name = self.name;
        let count = self.reader.read(buffer);
        let count = count.map_err(|error| match error.kind() {
            std::io::ErrorKind::Interrupted => error,
            _ => Error::other(format!("cannot read {name}: {}", system_reason(&error))),
        })?;
        let read = self.budget.read.get() + count as u64;
        self.budget.read.set(read);
        if read > MAX_BYTES + 2 * CHUNK as u64 {
            let (number, limit) = (self.budget.element.get().max(1), MAX_BYTES >> 20);
            let reason = format!("state {number} has more than {limit} MiB; is its array closed?");
            return Err(Error::other(format!("{name}: {reason}")));
        }
        self.unchecked.extend_from_slice(&buffer[..count]);
        match str::from_utf8(&self.unchecked) {
            Err(error) if error.error_len().is_some() || count == 0 => {
                return Err(Error::other(not_utf8(name, self.offset, error)));
            }
            checked => {
                let length = checked.map_or_else(|error| error.valid_up_to(), str::len);
                self.offset += length as u64;
                self.unchecked.drain(..length);
            }
        }
        match self.exponents.below_range(&buffer[..count]) {
            None => Ok(count),
            Some(number) => {
                let reason = format!("`{number}` is below the range of floating-point numbers");
                Err(Error::other(format!("{name}: {reason}")))
            }
        }
    }
}
