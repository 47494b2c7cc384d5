//! Where states are read from: a file, or a stream that is read once.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Error, Read, Result, Seek, SeekFrom};
use std::path::Path;

use robot_simulation::csv::{Lines, is_blank, not_utf8};

use super::{Layout, Sink, State, csv, json};
use crate::failure::Failure;
use crate::files;

/// The bytes that are read at a time.
const CHUNK: usize = 1 << 16;
/// More of a file of states is not looked at to see what it is, and no state is longer.
const MAX_BYTES: u64 = 1 << 20;
/// A stream that is read twice is kept in memory up to so many bytes, then on the disk.
const KEPT: usize = 1 << 20;
const MARK: &[u8] = "\u{feff}".as_bytes();

/// States that can be read, and once more if need be.
pub(crate) struct Input<'t> {
    name: String,
    format: Format,
    /// The bytes up to the first line that is not blank, or many of it.
    beginning: Vec<u8>,
    rest: Rest<'t>,
}

enum Rest<'t> {
    Stream(BufReader<Box<dyn Read + 't>>),
    /// With the place of the rest.
    Again(BufReader<Box<dyn Again>>, u64),
}

/// What can be read again.
trait Again: Read + Seek {}

impl<T: Read + Seek> Again for T {}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    JsonArray,
    /// JSON, but not states.
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

    /// Whether a state has a wrench that is not 0; where this takes reading the states, they can be read again.
    pub(crate) fn is_loaded(&mut self, layout: &Layout) -> std::result::Result<bool, Failure> {
        if !self.may_be_loaded(layout).map_err(|error| files::cannot_read(&self.name, &error))? {
            return Ok(false);
        }
        let mut search = Search(false);
        self.read(layout, &mut search)?;
        Ok(search.0)
    }

    /// Whether the columns or the keys may be those of a wrench.
    fn may_be_loaded(&mut self, layout: &Layout) -> Result<bool> {
        if self.format == Format::Csv {
            let header = String::from_utf8_lossy(&self.beginning);
            if !csv::has_wrench(header.trim().trim_start_matches('\u{feff}'), layout) {
                return Ok(false);
            }
            self.rest.keep()?;
            return Ok(true);
        }
        self.rest.keep()?;
        // No other key has a `w`, unless it is written as an escape.
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

    /// Reads the states, a JSON array of objects or CSV with a header, and says everything that is wrong, a message
    /// each. One state is in memory at a time.
    ///
    /// # Errors
    ///
    /// What cannot be read, or is not text.
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
        let text = Text { name, reader: text, offset, unchecked: vec![], budget: &budget };
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

    /// Takes the bytes up to the first line that is not blank.
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

    /// Makes a stream something that can be read again.
    fn keep(&mut self) -> Result<()> {
        if let Rest::Stream(reader) = self {
            let mut kept = tempfile::SpooledTempFile::new(KEPT);
            std::io::copy(reader, &mut kept)?;
            *self = Rest::again(kept, 0);
        }
        Ok(())
    }

    /// Goes to the start of what can be read again.
    fn rewind(&mut self) -> Result<()> {
        match self {
            Rest::Stream(_) => Ok(()),
            Rest::Again(reader, start) => reader.seek(SeekFrom::Start(*start)).map(drop),
        }
    }
}

/// Whether any state has a wrench.
struct Search(bool);

impl<'l> Sink<'l> for Search {
    fn state(&mut self, state: &mut State<'l>) -> std::ops::ControlFlow<()> {
        self.0 = state.is_loaded();
        if self.0 { std::ops::ControlFlow::Break(()) } else { std::ops::ControlFlow::Continue(()) }
    }

    fn wrong(&mut self, _: String) {}

    fn none(&mut self, _: String) {}
}

/// The bytes that were read for one element of an array: more than a mebibyte have no end.
#[derive(Default)]
pub(super) struct Budget {
    element: Cell<usize>,
    read: Cell<u64>,
}

impl Budget {
    /// Begins an element of that number.
    pub(super) fn renew(&self, element: usize) {
        self.element.set(element);
        self.read.set(0);
    }
}

/// Bytes that are UTF-8.
struct Text<'i, R> {
    name: &'i str,
    reader: R,
    /// The place of the unchecked bytes in the file.
    offset: u64,
    /// The beginning of a character that has not been read to its end.
    unchecked: Vec<u8>,
    budget: &'i Budget,
}

impl<R: Read> Read for Text<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let name = self.name;
        let count = self.reader.read(buffer);
        let count = count.map_err(|error| match error.kind() {
            std::io::ErrorKind::Interrupted => error,
            _ => Error::other(format!("cannot read {name}: {error}")),
        })?;
        let read = self.budget.read.get() + count as u64;
        self.budget.read.set(read);
        if read > MAX_BYTES + 2 * CHUNK as u64 {
            let (number, limit) = (self.budget.element.get().max(1), MAX_BYTES >> 20);
            return Err(Error::other(format!("{name}: state {number} has more than {limit} MiB")));
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
        Ok(count)
    }
}
