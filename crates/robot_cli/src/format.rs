//! The formats of results.

use std::path::Path;

use clap::ValueEnum;

use crate::failure::Failure;

/// For people, or for programs.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Format {
    Text,
    Json,
}

/// The error for a format that is not the one that the name of the file to write ends in.
pub(crate) fn contradicts_name(path: &Path) -> Failure {
    let extension = path.extension().unwrap_or_default();
    Failure::Usage(vec![format!(
        "--format contradicts the name of a file .{}; leave it out, or name the file otherwise",
        robot_build::shown(Path::new(extension))
    )])
}
