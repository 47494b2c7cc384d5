//! Files that commands read and write.

use std::path::Path;

use crate::Terminal;
use crate::failure::Failure;

/// Writes a file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    std::fs::write(path, bytes)
        .map_err(|error| Failure::input(format!("cannot write {}: {error}", path.display())))
}

/// The name of a file as messages show it, and its text; `-` is standard input.
pub(crate) fn read(path: &Path, terminal: &mut Terminal<'_>) -> Result<(String, String), Failure> {
    let (mut name, mut bytes) = (path.display().to_string(), vec![]);
    if name == "-" {
        name = "standard input".to_owned();
        terminal.input.read_to_end(&mut bytes)?;
    } else {
        bytes = std::fs::read(path)
            .map_err(|error| Failure::input(format!("cannot read {name}: {error}")))?;
    }
    let text = String::from_utf8(bytes)
        .map_err(|error| Failure::input(format!("{name} is not UTF-8 text: {error}")))?;
    Ok((name, text))
}
