//! Lines of text from a reader.

use std::io::{BufRead, Read as _};

use robot_build::system_reason;

use crate::error::Error;

/// The largest number of bytes of a line. A longer one is an error, because a file without lines can be endless.
const MAX_BYTES: usize = 1 << 20;

/// The lines of a text that are not blank, read one by one; only one line is in memory.
#[derive(Debug)]
pub struct Lines<R> {
    source: String,
    reader: R,
    line: Vec<u8>,
    /// The number of lines that have been read, including blank ones.
    number: usize,
    /// The number of bytes before the current line.
    offset: u64,
}

impl<R: BufRead> Lines<R> {
    /// The lines of a reader; `source` is its name in messages. A byte order mark at the beginning is skipped.
    pub fn new(source: &str, reader: R) -> Lines<R> {
        Lines { source: source.to_owned(), reader, line: vec![], number: 0, offset: 0 }
    }

    /// Reads the next line that is not blank and returns it with its number, counted from 1, and its line end.
    ///
    /// # Errors
    ///
    /// If the reader fails, or if a line is not UTF-8 or has more than 1 MiB.
    pub fn next_line(&mut self) -> Result<Option<(usize, &str)>, Error> {
        loop {
            self.fill()?;
            if self.line.is_empty() {
                return Ok(None);
            }
            if !is_blank(&self.line) {
                break;
            }
        }
        let mark = if self.number == 1 { "\u{feff}" } else { "" };
        match str::from_utf8(&self.line) {
            Ok(line) => Ok(Some((self.number, line.strip_prefix(mark).unwrap_or(line)))),
            Err(error) => Err(Error::input(not_utf8(&self.source, self.offset, error))),
        }
    }

    /// Reads the next line into `self.line`, which is empty at the end.
    fn fill(&mut self) -> Result<(), Error> {
        self.offset += self.line.len() as u64;
        self.line.clear();
        let read =
            self.reader.by_ref().take(MAX_BYTES as u64 + 1).read_until(b'\n', &mut self.line);
        let source = &self.source;
        read.map_err(|error| {
            Error::input(format!("cannot read {source}: {}", system_reason(&error)))
        })?;
        self.number += 1;
        if self.line.len() > MAX_BYTES {
            let (number, limit) = (self.number, MAX_BYTES >> 20);
            return Err(Error::input(format!(
                "{source}: line {number} has more than {limit} MiB; write one state per line"
            )));
        }
        Ok(())
    }
}

/// The message for a text that is not UTF-8; `error` is the error of the part of the text after `offset` bytes.
#[must_use]
pub fn not_utf8(source: &str, offset: u64, error: std::str::Utf8Error) -> String {
    let at = offset + error.valid_up_to() as u64;
    format!("{source} is not UTF-8 text from byte {} on; save it as UTF-8", at + 1)
}

/// Whether a line contains only white space.
#[must_use]
pub fn is_blank(line: &[u8]) -> bool {
    let is_space = |byte: &u8| matches!(byte, b'\t'..=b'\r' | b' ');
    match line.iter().find(|byte| !is_space(byte)) {
        None => true,
        Some(byte) if byte.is_ascii() => false,
        Some(_) => str::from_utf8(line)
            .is_ok_and(|line| line.strip_prefix('\u{feff}').unwrap_or(line).trim().is_empty()),
    }
}
