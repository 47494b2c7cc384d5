//! Files that commands read.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use robot_build::{missing, shown, system_reason};
use robot_simulation::csv::not_utf8;

use crate::Terminal;
use crate::failure::Failure;

/// The largest number of bytes of a file. Tables of states and torques are smaller, but a device can be endless.
const MAX_BYTES: u64 = 1 << 28;

/// The failure to read a file; if the file does not exist, the message names a similar one.
fn cannot_open(path: &Path, name: &str, error: &std::io::Error) -> Failure {
    match error.kind() {
        std::io::ErrorKind::NotFound => {
            Failure::input(format!("cannot read {name}: {}", missing(path)))
        }
        _ => cannot_read(name, error),
    }
}

/// Reads a file; returns its name for messages and its text. `-` is standard input.
pub(crate) fn read(path: &Path, terminal: &mut Terminal<'_>) -> Result<(String, String), Failure> {
    let (mut name, mut bytes) = (shown(path), vec![]);
    if name == "-" {
        name = "standard input".to_owned();
        let read = (&mut *terminal.input).take(MAX_BYTES + 1).read_to_end(&mut bytes);
        read.map_err(|error| cannot_read(&name, &error))?;
    } else {
        let read =
            File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| cannot_open(path, &name, &error))?;
    }
    if bytes.len() as u64 > MAX_BYTES {
        let limit = MAX_BYTES >> 20;
        return Err(Failure::input(format!("{name} has more than {limit} MiB; split it")));
    }
    let text = String::from_utf8(bytes)
        .map_err(|error| Failure::input(not_utf8(&name, 0, error.utf8_error())))?;
    Ok((name, text))
}

/// The source of bytes.
pub(crate) enum Bytes<'t> {
    /// A regular file, which can be read again.
    File(File),
    Stream(Box<dyn Read + 't>),
}

/// A reader of a file or a stream.
pub(crate) type Reader<'t> = BufReader<Box<dyn Read + 't>>;

impl<'t> Bytes<'t> {
    pub(crate) fn reader(self) -> Reader<'t> {
        let bytes = match self {
            Bytes::File(file) => Box::new(file),
            Bytes::Stream(stream) => stream,
        };
        BufReader::with_capacity(1 << 16, bytes)
    }
}

/// Opens a file; returns its name for messages and its bytes. `-` is standard input.
pub(crate) fn open<'t>(
    path: &Path,
    standard: &'t mut dyn Read,
) -> Result<(String, Bytes<'t>), Failure> {
    let name = shown(path);
    if name == "-" {
        return Ok(("standard input".to_owned(), Bytes::Stream(Box::new(standard))));
    }
    let file = File::open(path).map_err(|error| cannot_open(path, &name, &error))?;
    let is_regular = file.metadata().is_ok_and(|metadata| metadata.is_file());
    let bytes = if is_regular { Bytes::File(file) } else { Bytes::Stream(Box::new(file)) };
    Ok((name, bytes))
}

pub(crate) fn cannot_read(name: &str, error: &std::io::Error) -> Failure {
    Failure::input(format!("cannot read {name}: {}", system_reason(error)))
}
