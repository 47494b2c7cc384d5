//! Files that commands read.

use std::io::Read;
use std::path::Path;

use robot_build::{missing, shown};

use crate::Terminal;
use crate::failure::Failure;

/// Tables of states and torques are smaller; a device may have no end.
const MAX_BYTES: u64 = 1 << 28;

/// Why a file cannot be read; of one that is not there, which one may be meant.
fn reason(path: &Path, error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => missing(path),
        _ => error.to_string(),
    }
}

/// The name of a file as messages show it, and its text; `-` is standard input.
pub(crate) fn read(path: &Path, terminal: &mut Terminal<'_>) -> Result<(String, String), Failure> {
    let (mut name, mut bytes) = (shown(path), vec![]);
    if name == "-" {
        name = "standard input".to_owned();
        let read = (&mut *terminal.input).take(MAX_BYTES + 1).read_to_end(&mut bytes);
        read.map_err(|error| Failure::input(format!("cannot read {name}: {error}")))?;
    } else {
        let read = std::fs::File::open(path)
            .and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| {
            Failure::input(format!("cannot read {name}: {}", reason(path, &error)))
        })?;
    }
    if bytes.len() as u64 > MAX_BYTES {
        return Err(Failure::input(format!("{name} has more than {} MiB", MAX_BYTES >> 20)));
    }
    let text = String::from_utf8(bytes)
        .map_err(|error| Failure::input(format!("{name} is not UTF-8 text: {error}")))?;
    Ok((name, text))
}
