//! Errors, with their places and remedies.

use std::path::{Path, PathBuf};

use datafusion::error::DataFusionError;

/// The reason why a query has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A robot that cannot be read, or that lacks something that the query needs.
    #[error("robot `{robot}`: {reason}")]
    Robot {
        /// The robot as the query names it.
        robot: String,
        /// The reason and the remedy.
        reason: String,
    },
    /// Columns of a log that are missing or of another size than the robot needs.
    #[error("{0}")]
    Columns(String),
    /// A file that cannot be read or written.
    #[error("{}: {reason}", shown(path, *row_group))]
    File {
        /// The file.
        path: PathBuf,
        /// The row group of a Parquet file, from 0.
        row_group: Option<usize>,
        /// The reason and the remedy.
        reason: String,
    },
    /// Measurements that do not determine any parameter.
    #[error("{0}")]
    Identification(String),
    /// A query that cannot be computed.
    #[error("{0}")]
    Query(String),
    /// The engine's message about a query that it refuses, or that failed during its execution.
    #[error("{0}")]
    Engine(String),
}

/// The text of a path and its row group.
fn shown(path: &Path, row_group: Option<usize>) -> String {
    let path = path.display();
    row_group.map_or_else(|| path.to_string(), |group| format!("{path}, row group {group}"))
}

impl Error {
    /// An error about a file, with the reason.
    pub(crate) fn file(path: &Path, reason: impl std::fmt::Display) -> Error {
        Error::File { path: path.to_owned(), row_group: None, reason: reason.to_string() }
    }
}

/// The error about a worker that no longer responds.
fn lost(reason: &str) -> Error {
    Error::Query(format!(
        "a worker was lost while it computed ({reason}), so the query has no result; start the worker again, or \
         leave it out of --workers, and repeat the query"
    ))
}

impl From<Error> for DataFusionError {
    fn from(error: Error) -> DataFusionError {
        DataFusionError::External(Box::new(error))
    }
}

impl From<DataFusionError> for Error {
    fn from(error: DataFusionError) -> Error {
        match error.find_root() {
            DataFusionError::External(inner) => match inner.downcast_ref::<tonic::Status>() {
                Some(status) => lost(status.message()),
                None => Error::Query(inner.to_string()),
            },
            root if is_cancelled(root) => lost(&root.strip_backtrace()),
            _ => Error::Engine(error.strip_backtrace()),
        }
    }
}

/// Whether a task was canceled. Only a worker that shuts down cancels its tasks; it reports this as a text, which the
/// engine passes on in errors of several kinds.
fn is_cancelled(error: &DataFusionError) -> bool {
    let text = error.to_string();
    text.contains("Error joining spawned task") && text.contains("was cancelled")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_worker_that_shuts_down_is_lost() {
        let text = "Error joining spawned task: task 868 was cancelled";
        for error in [
            DataFusionError::Execution(text.to_owned()),
            DataFusionError::Context(
                "Parquet".to_owned(),
                Box::new(DataFusionError::Internal(text.to_owned())),
            ),
        ] {
            let message = Error::from(error).to_string();
            assert!(message.starts_with("a worker was lost"), "{message}");
        }
        let other =
            Error::from(DataFusionError::Execution("no such column".to_owned())).to_string();
        assert!(!other.contains("worker"), "{other}");
    }
}
