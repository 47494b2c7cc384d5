//! The formats of results.

use clap::ValueEnum;

/// For people, or for programs.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Format {
    Text,
    Json,
}
